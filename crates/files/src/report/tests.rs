mod samples;

use super::*;
use crate::quads::PanelQuads;
use samples::*;
use sheetwright::check::Checked;
use sheetwright::design::{Design, Divide, DivideJoint, SheetForm, Stock, StockSheet};
use sheetwright::make::{Made, make};
use sheetwright::template::template;
use sheetwright::watch::Unwatched;
use std::path::Path;

fn all() -> Vec<Made> {
    let bent = [quarter(), coarse_quarter(), cone(), helicoid(), moved(), tight()];
    [hull(40, "steel-5mm"), concave(), triangle()].into_iter().chain(bent).collect()
}

fn checks(made: &Made) -> (Vec<f64>, Vec<Checked>) {
    let errors = made.parts.iter().map(|_| 2e-10).collect();
    (errors, made.parts.iter().map(|p| p.checked.clone()).collect())
}

/// No quads for any panel.
fn none(made: &Made) -> Vec<Option<PanelQuads>> {
    vec![None; made.parts.len()]
}

/// The page of a made design for which this was found.
fn page_of(made: &Made, errors: &[f64], checked: &[Checked], form: ReportForm) -> String {
    let patterns = &made.cut_list();
    let written = Written { patterns, checked, refold_errors_mm: errors };
    String::from_utf8(report_html(made, &written, form, None)).unwrap()
}

fn html(made: &Made) -> String {
    let (errors, checked) = checks(made);
    page_of(made, &errors, &checked, ReportForm::Auto)
}

fn json_text(made: &Made, errors: &[f64], checked: &[Checked]) -> String {
    let patterns = &made.cut_list();
    let written = Written { patterns, checked, refold_errors_mm: errors };
    String::from_utf8(report_json(made, &written, &none(made)).unwrap()).unwrap()
}

fn json(made: &Made) -> serde_json::Value {
    let (errors, checked) = checks(made);
    serde_json::from_str(&json_text(made, &errors, &checked)).unwrap()
}

/// The inline pictures of a page.
fn pictures(page: &str) -> Vec<&str> {
    page.match_indices("<svg")
        .map(|(from, _)| {
            let to = page[from..].find("</svg>").unwrap();
            &page[from..from + to + "</svg>".len()]
        })
        .collect()
}

/// The contract's fields of a panel, in its order.
const PANEL_FIELDS: [&str; 32] = [
    "name",
    "method",
    "goal",
    "proven_optimal",
    "samples",
    "triangles",
    "rungs",
    "fold",
    "price_total",
    "twist_total",
    "crease_max_deg",
    "warp_max_deg",
    "warp_mean_deg",
    "length_error_max",
    "length_error_mean",
    "area_space_mm2",
    "area_flat_mm2",
    "refold_error_mm",
    "overlaps",
    "self_intersects",
    "moved_max_mm",
    "moved_total_mm",
    "verdict",
    "findings",
    "bend_radius_min_mm",
    "warp_limit_deg",
    "gap",
    "strain_p95",
    "strain_limit",
    "outer_fibre",
    "outer_fibre_limit",
    "hold_moment_n",
];

#[test]
fn the_json_has_the_fields_of_the_contract_in_their_order() {
    let made = hull(40, "steel-5mm");
    let (errors, checked) = checks(&made);
    let text = json_text(&made, &errors, &checked);
    let place =
        |field: &str| text.find(&format!("\"{field}\":")).unwrap_or_else(|| panic!("{field}"));
    let places: Vec<usize> = PANEL_FIELDS.iter().skip(1).take(23).map(|f| place(f)).collect();
    assert!(places.is_sorted(), "{places:?}");
    assert!(place("sheetwright") < place("name") && place("name") < place("units"));
    let panel = &json(&made)["panels"][2];
    assert!(PANEL_FIELDS.iter().all(|f| panel.get(f).is_some()));
    assert_eq!(panel["samples"], made.parts[2].found().unwrap().boundary.len());
    assert_eq!(panel["rungs"], made.parts[2].measures.rungs.len());
    assert_eq!(panel["moved_max_mm"], 0.0);
    assert_eq!(panel["refold_error_mm"], 2e-10);
    let deg = sheetwright::math::to_deg(made.parts[2].measures.warp_max);
    assert!(text.contains(&format!("\"warp_max_deg\": {deg},")), "in full precision");
}

#[test]
fn what_was_moved_stands_beside_what_was_before() {
    let made = moved();
    let change = made.parts[0].change().unwrap();
    let panel = &json(&made)["panels"][0];
    assert_eq!(panel["moved_max_mm"], change.moved_max_mm());
    assert_eq!(panel["moved_total_mm"], change.moved_total_mm());
    assert!(change.moved_max_mm() > 0.0 && change.moved_max_mm() <= 5.0 * (1.0 + 1e-9));
    let before = &panel["before"];
    assert_eq!(before["twist_total"], change.before.measures.twist_total);
    assert!(before["twist_total"].as_f64() > panel["twist_total"].as_f64());
    assert_eq!(before["verdict"], change.before.checked.verdict.name());
    let page = html(&made);
    assert!(page.contains("Before and after the boundary was moved"));
    assert!(page.contains("times enlarged") && page.contains("Warp before."));
    assert!(json(&helicoid())["panels"][0]["before"].is_null());
    assert!(!html(&helicoid()).contains("Before and after"));
}

#[test]
fn what_has_no_number_is_null() {
    let made = concave();
    let checked = vec![made.parts[0].checked.clone()];
    let value: serde_json::Value =
        serde_json::from_str(&json_text(&made, &[f64::NAN], &checked)).unwrap();
    let panel = &value["panels"][0];
    assert!(panel["refold_error_mm"].is_null() && panel["bend_radius_min_mm"].is_null());
    assert_eq!(panel["name"], ODD_NAME);
}

/// The file is written anew by `SHEETWRIGHT_REWRITE=1 cargo test -p sheetwright-files`.
#[test]
fn the_schema_in_the_docs_is_that_of_the_code() {
    let schema = String::from_utf8(report_schema().unwrap()).unwrap();
    crate::json::assert_schema_in_docs("report.schema.json", &schema);
}

/// Walks a value along its schema: the very fields, and the kind of each.
fn agrees(value: &serde_json::Value, schema: &serde_json::Value, root: &serde_json::Value) {
    if let Some(path) = schema.get("$ref").and_then(|r| r.as_str()) {
        return agrees(value, root.pointer(path.trim_start_matches('#')).unwrap(), root);
    }
    if let Some(either) = schema.get("anyOf").and_then(|list| list.as_array()) {
        let of_null = |one: &&serde_json::Value| one["type"] == "null";
        let fitting = either.iter().find(|one| value.is_null() == of_null(one));
        return agrees(value, fitting.unwrap(), root);
    }
    let kinds: Vec<&str> = match &schema["type"] {
        serde_json::Value::Array(list) => list.iter().filter_map(|k| k.as_str()).collect(),
        one => one.as_str().into_iter().collect(),
    };
    let kind = match value {
        serde_json::Value::Null => "null",
        serde_json::Value::Bool(_) => "boolean",
        serde_json::Value::Number(n) if n.is_u64() && kinds.contains(&"integer") => "integer",
        serde_json::Value::Number(_) => "number",
        serde_json::Value::String(_) => "string",
        serde_json::Value::Array(_) => "array",
        serde_json::Value::Object(_) => "object",
    };
    assert!(kinds.contains(&kind), "{value} is not {kinds:?}");
    if let Some(allowed) = schema.get("enum") {
        assert!(allowed.as_array().unwrap().contains(value), "{value} is not in {allowed}");
    }
    if let Some(list) = value.as_array() {
        list.iter().for_each(|item| agrees(item, &schema["items"], root));
    }
    if let Some(fields) = value.as_object() {
        let names: std::collections::BTreeSet<&str> = fields.keys().map(String::as_str).collect();
        let required = schema["required"].as_array().unwrap();
        assert_eq!(names, required.iter().map(|n| n.as_str().unwrap()).collect());
        assert_eq!(schema["additionalProperties"], false);
        for (name, field) in fields {
            agrees(field, &schema["properties"][name], root);
        }
    }
}

#[test]
fn every_report_agrees_with_the_schema() {
    let schema: serde_json::Value = serde_json::from_slice(&report_schema().unwrap()).unwrap();
    for made in all() {
        agrees(&json(&made), &schema, &schema);
    }
}

#[test]
fn pictures_are_well_formed_and_every_class_has_a_rule() {
    let css = style::picture_style();
    for made in all() {
        let page = html(&made);
        let found = pictures(&page);
        assert!(found.len() >= 2 * made.parts.len());
        for picture in found {
            let document = roxmltree::Document::parse(picture).unwrap();
            let root = document.root_element();
            assert!(root.attribute("viewBox").is_some() && root.attribute("aria-label").is_some());
            let classes = document.descendants().filter_map(|node| node.attribute("class"));
            for class in classes.flat_map(str::split_whitespace) {
                let rule = css.match_indices(&format!(".{class}")).any(|(at, dotted)| {
                    !css[at + dotted.len()..].starts_with(|c: char| c.is_ascii_alphanumeric())
                });
                assert!(rule, "no rule for {class}");
            }
        }
    }
}

/// Every drawn point lies in its picture, and every number is finite.
#[test]
fn pictures_stay_in_their_frames() {
    for made in all() {
        let page = html(&made);
        for picture in pictures(&page) {
            let document = roxmltree::Document::parse(picture).unwrap();
            let frame: Vec<f64> = document
                .root_element()
                .attribute("viewBox")
                .unwrap()
                .split(' ')
                .map(|n| n.parse().unwrap())
                .collect();
            for node in document.descendants().filter(|n| n.has_tag_name("path")) {
                for point in node.attribute("d").unwrap().split(['M', 'L', 'Z']) {
                    let point = point.replace('-', " -");
                    let numbers: Vec<f64> =
                        point.split_whitespace().map(|n| n.parse().unwrap()).collect();
                    if let [x, y] = numbers[..] {
                        assert!((0.0..=frame[2]).contains(&x), "{x} in {}", made.name);
                        assert!((0.0..=frame[3]).contains(&y), "{y} in {}", made.name);
                    } else {
                        assert!(numbers.is_empty(), "{point}");
                    }
                }
            }
        }
    }
}

#[test]
fn names_are_escaped() {
    let page = html(&concave());
    assert!(!page.contains("<b>\""), "the name became an element");
    assert!(page.contains("<h2>&lt;b&gt;&quot;&amp;é</h2>"));
    assert!(page.contains(r#"aria-label="&lt;b&gt;&quot;&amp;é laid flat""#));
}

#[test]
fn a_page_refers_to_nothing_outside_itself() {
    for made in all() {
        let page = html(&made);
        let without = page.replace(r#"xmlns="http://www.w3.org/2000/svg""#, "");
        assert_eq!(page.matches("http-equiv").count(), 1);
        let without = without.replace("http-equiv", "");
        for word in ["http", "//", "url(", "@import", "<script", "<img", "<link", "src="] {
            assert!(!without.contains(word), "{word} in {}", made.name);
        }
    }
}

/// The policy comes before anything that a browser could fetch or run.
#[test]
fn a_page_lets_a_browser_do_nothing_but_show_it() {
    let page = html(&concave());
    let policy = page.find("Content-Security-Policy").unwrap();
    assert!(policy < page.find("<style").unwrap() && policy < page.find("<title").unwrap());
    assert!(page.contains(r#"content="default-src 'none'; style-src 'unsafe-inline';"#));
}

/// The page of a design of many panels is a table, by default and by option.
#[test]
fn the_short_form_shows_every_panel_in_a_few_kilobytes() {
    let mut made = facade(101);
    let mut bad = helicoid().parts[0].clone();
    bad.checked.verdict = sheetwright::check::Verdict::WillNotBend;
    made.parts[70] = bad;
    let page = html(&made);
    assert_eq!(pictures(&page).len(), 1 + 101, "the whole, and a thumbnail a panel");
    let told = page.find("Of 101 panels").map_or("nothing", |at| &page[at..at + 90]);
    assert!(
        told.starts_with("Of 101 panels 100 bend, 1 will not bend.</strong> Do not cut 1 of"),
        "{told}"
    );
    assert!(page.contains("choose the long form") && !page.contains("class=\"numbers\""));
    let first = page.find("<th scope=\"row\">").unwrap();
    assert!(page[first..].starts_with("<th scope=\"row\">ramp<"), "what needs a look is first");
    assert!(page.len() < 101 * 4000, "{} bytes", page.len());
    made.parts.truncate(100);
    assert!(html(&made).contains("class=\"numbers\""));
    let (errors, checked) = checks(&made);
    let short = page_of(&made, &errors, &checked, ReportForm::Short);
    assert!(short.contains("Of 100 panels"));
}

/// Bends that are too tight are seen in space and flat, with a legend; twice as wide they are none.
#[test]
fn bends_that_are_too_tight_stand_out() {
    let made = tight();
    let least = made.material.as_ref().unwrap().bend_radius_mm.value;
    assert!(made.parts[0].measures.bend_radius_min_mm < least);
    let page = html(&made);
    let shown = pictures(&page).iter().filter(|p| p.contains(r#"class="t""#)).count();
    assert!(shown >= 2, "in space and flat");
    let legends = page.matches("bend radius below the limit").count();
    assert_eq!(legends, 2, "in space and flat");
    assert!(!page.contains("warp above the limit"));
    assert!(!html(&concave()).contains("bend radius below"));
    assert_eq!(html(&helicoid()).matches("largest warp").count(), 2);
}

/// How many lines a picture has of a class.
fn lines(picture: &str, class: &str) -> usize {
    let of_class = format!(r#"<path class="{class}" d=""#);
    picture.split(&of_class).skip(1).map(|d| d[..d.find('"').unwrap()].matches('M').count()).sum()
}

/// The pictures of the first panel in space and laid flat.
fn space_and_flat(made: &Made) -> [String; 2] {
    let panel = &made.parts[0];
    [space_picture(panel, made.material.as_ref()), flat_picture(panel, made.material.as_ref())]
        .map(|p| p.inline())
}

#[test]
fn rulings_are_drawn_where_the_sheet_bends() {
    for picture in space_and_flat(&concave()) {
        assert_eq!(["r", "turn", "score"].map(|class| lines(&picture, class)), [0; 3], "a plate");
    }
    let wide = Made { material: None, ..quarter() };
    for picture in space_and_flat(&wide) {
        assert!(lines(&picture, "r") > 10 && lines(&picture, "turn") == 0, "{picture}");
    }
    for picture in space_and_flat(&coarse_quarter()) {
        let few = lines(&picture, "turn");
        assert!((6..=7).contains(&few), "each of 90° / 7: {few}");
    }
}

#[test]
fn divided_parts_have_pictures_with_their_pieces() {
    assert!(!html(&quarter()).contains("Divided parts"));
    let values = template("dinghy").unwrap().defaults();
    let form = SheetForm::Rectangle { size: [1220.0, 2440.0] };
    let stock = Stock {
        sheets: vec![StockSheet { name: None, form, count: None, cost: None }],
        divide: Some(Divide::by(DivideJoint::Puzzle)),
        ..Stock::default()
    };
    let design = Design { stock: Some(stock), ..values.design().unwrap() };
    let made = make(&design, &mut Unwatched).unwrap();
    let divided: Vec<&str> = made.divided.iter().map(|part| &part.name[..]).collect();
    assert_eq!(divided, ["bottom", "side"]);
    let page = html(&made);
    let from = page.find("Divided parts").unwrap();
    let section = &page[from..from + page[from..].find("</section>").unwrap()];
    let pictures = pictures(section);
    assert_eq!(pictures.len(), 2);
    for (part, picture) in made.divided.iter().zip(pictures) {
        assert!(picture.contains(&format!("{} with its pieces", part.name)));
        for (name, loops) in &part.pieces {
            assert!(picture.contains(&format!(">{name}<")), "{picture}");
            assert_eq!(loops.len(), 1);
        }
    }
    assert!(section.contains(" m long and the largest sheet takes 2.43 × 1.21 m, so"), "{section}");
}

#[test]
fn a_page_speaks_of_rulings_where_there_are_any() {
    for (made, bends) in [(concave(), false), (quarter(), true)] {
        let checked = [made.parts[0].checked.clone()];
        let page = page_of(&made, &[0.0], &checked, ReportForm::Long);
        for words in ["The thin lines are rulings", "Lay a straightedge"] {
            assert_eq!(page.contains(words), bends, "{words}");
        }
    }
}

#[test]
fn a_picture_in_space_shows_where_the_sheet_is_cut_open() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/reducer.sheet.json");
    let mut design = crate::read_input(&path, &crate::ReadOptions::default()).unwrap();
    design.panels[0].samples = 60;
    let made = make(&design, &mut Unwatched).unwrap();
    assert_eq!(made.parts[0].sheet.seams().len(), 1);
    let [space, flat] = space_and_flat(&made);
    let both = (lines(&space, "seam"), lines(&flat, "seam"));
    assert_eq!(both, (2, 0), "with the legend; flat, the outline shows it");
    assert!(space.contains("cut open on the pattern") && !flat.contains("cut open"));
    assert!(!space_and_flat(&quarter())[0].contains("cut open"));
}

#[test]
fn no_number_fails_to_be_one() {
    let mut pages: Vec<String> = all().iter().map(html).collect();
    let made = quarter();
    let checked = vec![made.parts[0].checked.clone()];
    let unread = page_of(&made, &[f64::NAN], &checked, ReportForm::Auto);
    assert!(unread.contains("not read back"));
    pages.push(unread);
    for page in pages {
        let words = page.split(|c: char| !c.is_ascii_alphanumeric());
        for word in words {
            assert!(!["nan", "inf", "infinity"].contains(&word.to_lowercase().as_str()), "{word}");
        }
    }
}

#[test]
fn the_same_design_gives_the_same_bytes() {
    for (once, again) in all().iter().zip(&all()) {
        assert_eq!(html(once), html(again));
        assert_eq!(json(once), json(again));
    }
}

#[test]
fn charts_show_the_limit_and_what_is_beyond_it() {
    let page = html(&quarter());
    assert!(page.contains(r#"<path class="limit""#) && page.contains(">limit 6.0°<"));
    assert!(page.contains("what thick plate takes of plywood, 4 mm; thin"));
    assert!(!page.contains("bar over"));
    let mut unnamed = quarter();
    unnamed.material = None;
    assert!(html(&unnamed).contains("what thick plate takes of any sheet; thin"));
    // The ramp warps beyond it: its worst ruling stands out in space, flat and on the chart.
    let page = html(&helicoid());
    assert!(page.contains("bar over"));
    let worst = pictures(&page).iter().filter(|p| p.contains(r#"class="w""#)).count();
    assert_eq!(worst, 3, "in space, flat and on the sphere");
}

#[test]
fn the_chart_is_unsure_where_samples_are_coarse() {
    let made = coarse_quarter();
    assert!(made.parts[0].measures.warp_max > sheetwright::math::from_deg(6.0));
    let page = html(&made);
    assert!(page.contains("Dashed bars may be bending"));
    assert!(page.contains(r#"<path class="bar unsure""#));
    for known in ["bar over", "head over", r#"class="ring""#, r#"class="w""#] {
        assert!(!page.contains(known), "{known}");
    }
    assert!(!html(&quarter()).contains("Dashed bars"));
}

#[test]
fn a_panel_without_rulings_has_no_chart() {
    let page = html(&triangle());
    assert_eq!(pictures(&page).len(), 2);
    assert!(page.contains("A single triangle is flat"));
}

#[test]
fn an_error_is_not_hidden_behind_a_good_verdict() {
    let made = helicoid();
    let mut checked = made.parts[0].checked.clone();
    checked.verdict = sheetwright::check::Verdict::Bends;
    checked.findings.retain(|f| f.code() == "overlap");
    assert_eq!(checked.findings.len(), 1);
    let page = page_of(&made, &[0.0], &[checked], ReportForm::Auto);
    assert!(page.contains("Bends, but do not cut it"));
    assert!(page.contains(r#"class="card error""#));
}

#[test]
fn the_page_of_a_hull_stays_small() {
    let bytes = html(&hull(200, "steel-5mm")).len();
    assert!(bytes < 400_000, "{bytes} bytes");
}

/// Sixteen times as many panels take about sixteen times as long, for all of them in one picture
/// too: a bound that a busy machine keeps, and that work on every pair of panels does not.
#[test]
fn the_time_of_a_report_grows_with_the_panels_and_no_faster() {
    let planks = hull(40, "steel-5mm");
    let time = |count: usize| {
        let mut made = planks.clone();
        made.parts = (0..count).map(|n| planks.parts[n % 3].clone()).collect();
        made.wanted = (0..count).map(|n| planks.wanted[n % 3]).collect();
        let took = || {
            let start = std::time::Instant::now();
            assert!(!html(&made).is_empty());
            start.elapsed().as_secs_f64()
        };
        (0..3).map(|_| took()).fold(f64::INFINITY, f64::min)
    };
    let (few, many) = (time(110), time(16 * 110));
    assert!(many < 4.0 * 16.0 * few, "{few} s and {many} s");
}

/// The picture of many panels is no larger than what can be seen in it.
#[test]
fn the_picture_of_many_panels_stays_small() {
    let bytes = design_picture(&facade(1500)).inline().len();
    assert!(bytes < 1_300_000, "{bytes} bytes");
}

/// A mesh of the corpus, made.
fn mesh(file: &str) -> Made {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../corpus/good").join(file);
    let design = crate::read_input(&path, &crate::ReadOptions::default()).unwrap();
    make(&design, &mut Unwatched).unwrap()
}

#[test]
fn the_few_directions_of_a_mesh_are_dots_and_many_are_a_net() {
    let image = |file| gauss_picture(&mesh(file).parts[0], None).unwrap().inline();
    let dots = |body: &str| body.matches(r#"class="head""#).count();
    let plate = image("mesh-plate-with-crumbs.stl");
    assert_eq!((dots(&plate), plate.contains("few")), (1, false), "it faces one way");
    // Of six sides those that are seen: that at the eye, and the four of the rim.
    let cube = image("mesh-cube.obj");
    assert!(dots(&cube) >= 3 && cube.contains(r#"class="curve few""#), "{cube}");
    let tube = image("mesh-tube.stl");
    let steps = tube.split(r#"class="curve few" d=""#).nth(1).unwrap();
    let steps = &steps[..steps.find('"').unwrap()];
    assert!(steps.matches('M').count() < 100, "each line is drawn once: {steps}");
    let cap = image("mesh-cap.ply");
    assert!(dots(&cap) == 0 && cap.contains(r#"class="net""#));
}

#[test]
fn a_mesh_has_an_outline_where_it_turns_away() {
    let outline = |file| {
        let picture = space_picture(&mesh(file).parts[0], None);
        picture.inline().contains(r#"class="e thin""#)
    };
    assert!(outline("mesh-tube.stl"));
    assert!(!outline("mesh-plate-with-crumbs.stl"));
}

#[test]
fn planar_quads_have_their_border_beside_their_sides() {
    let made = quarter();
    let panel = &made.parts[0];
    let body = quads_picture(panel, &PanelQuads::new(panel.found().unwrap()).planar.mesh).inline();
    assert!(body.contains(r#"class="r""#) && body.contains(r#"class="e""#), "{body}");
}

#[test]
fn pictures_in_a_row_are_one_file() {
    let made = hull(40, "steel-5mm");
    let panel = &made.parts[0];
    let row =
        [space_picture(panel, made.material.as_ref()), flat_picture(panel, made.material.as_ref())];
    let text = side_by_side("A plank & its pattern", &row).standalone();
    let document = roxmltree::Document::parse(&text).unwrap();
    assert_eq!(document.root_element().attribute("width"), Some("976"));
    assert_eq!(document.descendants().filter(|n| n.has_tag_name("style")).count(), 1);
}

#[test]
fn strain_in_space_has_the_colours_and_the_places_of_that_on_the_pattern() {
    let path =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/square-to-round.sheet.json");
    let mut design = crate::read_input(&path, &crate::ReadOptions::default()).unwrap();
    design.panels[0].samples = 60;
    let made = make(&design, &mut Unwatched).unwrap();
    let flat = heat_picture::strain_picture(&made.parts[0]).unwrap().inline();
    let space = strain_in_space::strain_in_space(&made.parts[0]).unwrap().inline();
    let rings = |picture: &str| picture.matches(r#"class="here""#).count();
    assert_eq!((rings(&flat), rings(&space)), (3, 3));
    let sheet = made.parts[0].predicted.as_ref().unwrap().at_rest.as_ref().unwrap();
    let most = crate::wording::plain_per_cent(sheet.strain_at(1.0));
    assert!(flat.contains(&most) && space.contains(&most), "{most}");
    // Scales agree: the darkest colour on the pattern is in space, too.
    let darkest = (0..style::HEATS).rev().find(|n| flat.contains(&format!(r#"class="k{n}" d"#)));
    assert!(space.contains(&format!(r#"class="k{}" d"#, darkest.unwrap())));
    // A sheet that stays flat has nothing to name.
    assert!(strain_in_space::strain_in_space(&concave().parts[0]).is_none());
    let page = html(&made);
    assert!(page.contains("in space, coloured by its strain"));
}
