//! `report.html` of meshes: what flattening stretches, and where.

use super::form::{ReportForm, Row, short};
use super::gauss_picture::mesh_gauss_picture;
use super::html::{card, document, numbers, summary};
use super::json::{aim_name, steps_length};
use super::mesh_picture::{NO_ERROR, heat_picture, mesh_picture, meshes_picture};
use super::verdict::{findings, verdict};
use super::wording::{
    area, decimal, degrees, millimetres, millimetres_fine, per_cent, plain_per_cent, refold,
    steradians,
};
use maud::{Markup, PreEscaped, html};
use sheetwright::check::{Checked, Verdict, seam_length};
use sheetwright::flatten::Aim;
use sheetwright::index::VertexIndex;
use sheetwright::make::{MadeMesh, MadeMeshes};
use sheetwright::material::{Material, stretch_limit};
use sheetwright::math::{Point3, Vec3, to_deg};
use sheetwright::measure::gauss_area_of_mesh;
use sheetwright::mesh::crease_angles;
use sheetwright::pattern::seam_mark;

const SUMMARY: [&str; 6] = [
    "Flat size",
    "Area",
    "Length error, largest",
    "Length error, mean",
    "Stretch, least / most",
    "Seams",
];

/// `report.html` of meshes. `written_error_mm` and `checked` have one entry a panel; an error that
/// is not finite says that the written pattern could not be read back.
///
/// # Panics
/// Unless there is one entry a panel.
pub fn mesh_report_html(
    made: &MadeMeshes,
    written_error_mm: &[f64],
    checked: &[Checked],
    form: ReportForm,
) -> Vec<u8> {
    assert_eq!(made.panels.len(), written_error_mm.len(), "one error a panel");
    assert_eq!(made.panels.len(), checked.len(), "one verdict a panel");
    let each = || made.panels.iter().zip(checked).enumerate();
    document(
        &made.name,
        html! {
            h1 { (made.name) }
            p.sub { (subtitle(made)) }
            @if !form.is_short(made.panels.len()) {
                ul.cards {
                    @for (n, (panel, checked)) in each() { (card(n + 1, &panel.name, checked)) }
                }
            }
            @if made.panels.len() > 1 {
                figure.whole {
                    (PreEscaped(meshes_picture(made).inline()))
                    figcaption { "All panels in space, with their borders and seams." }
                }
            }
            @if form.is_short(made.panels.len()) {
                (short(&SUMMARY, each().map(|(_, (panel, checked))| row(panel, checked)).collect()))
            } @else {
                (summary(&SUMMARY, made.panels.iter().map(|p| (&p.name[..], values(p)))))
                @for (n, (panel, checked)) in each() {
                    (section(made, n, panel, written_error_mm[n], checked))
                }
            }
        },
    )
}

fn subtitle(made: &MadeMeshes) -> String {
    let panels = match made.panels.len() {
        1 => "1 mesh panel".to_owned(),
        n => format!("{n} mesh panels"),
    };
    let limit = plain_per_cent(stretch_limit(made.material.as_ref()));
    match &made.material {
        Some(m) => format!("{panels} of {}: takes {limit} of stretch", m.title),
        None => format!("{panels}, no material named: {limit} of stretch is accepted"),
    }
}

fn row<'a>(panel: &'a MadeMesh, checked: &'a Checked) -> Row<'a> {
    Row { name: &panel.name, piece: &panel.piece, checked, values: values(panel) }
}

fn values(panel: &MadeMesh) -> Vec<String> {
    let (measures, size) = (&panel.measures, panel.piece.size);
    vec![
        format!("{} × {}", millimetres(size.x), millimetres(size.y)),
        area(measures.area_flat_mm2),
        per_cent(measures.length_error_max),
        per_cent(measures.length_error_mean),
        format!("{} / {}", decimal(measures.stretch_min, 4), decimal(measures.stretch_max, 4)),
        panel.sheet.seams.len().to_string(),
    ]
}

fn sentence(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Bends => "Laid flat, no length changes by more than the sheet takes with ease.",
        Verdict::BendsAndFolds => {
            "The sheet takes this shape with its creases folded along scored lines."
        }
        Verdict::BendsWithForce | Verdict::Undecided => {
            "The sheet has to stretch to take this shape, by less than it bears."
        }
        Verdict::WillNotBend => "The sheet does not take this shape.",
    }
}

fn section(
    made: &MadeMeshes,
    n: usize,
    panel: &MadeMesh,
    written_error_mm: f64,
    checked: &Checked,
) -> Markup {
    html! {
        section.panel id={ "panel-" (n + 1) } {
            h2 { (panel.name) }
            p { (verdict(checked)) }
            p { (sentence(checked.verdict)) }
            (findings(checked))
            div.figures {
                div.column {
                    figure.first {
                        (PreEscaped(mesh_picture(panel).inline()))
                        figcaption { (space_caption(panel)) }
                    }
                    @if let Some(gauss) = mesh_gauss_picture(panel) {
                        figure.third {
                            (PreEscaped(gauss.inline()))
                            figcaption { (gauss_caption(panel)) }
                        }
                    }
                }
                div.column {
                    figure.second {
                        (PreEscaped(heat_picture(panel, made.material.as_ref()).inline()))
                        figcaption { (flat_caption(panel, made.material.as_ref())) }
                    }
                }
            }
            (seams(panel))
            (joints(made, panel))
            (all_numbers(made, panel, written_error_mm))
        }
    }
}

fn space_caption(panel: &MadeMesh) -> Markup {
    let size = box_of(panel.mesh.positions());
    html! {
        strong { "In space. " }
        "Blue is the side that the pattern shows, brown the other. "
        @if !panel.sheet.seams.is_empty() { "The green lines are the cuts. " }
        "It fills a box of " (millimetres(size.x)) " × " (millimetres(size.y)) " × "
        (millimetres(size.z)) " (x, y, z)."
    }
}

fn gauss_caption(panel: &MadeMesh) -> Markup {
    html! {
        strong { "Which way it faces. " }
        "Every direction is a point on a ball; the directions at both ends of each side of the mesh \
         are joined. A curve: it lies flat without stretching. A net: it must stretch, the more the more it covers. \
         Its area here is " (steradians(gauss_area_of_mesh(&panel.mesh))) ", of 12.57\u{a0}sr that the \
         whole ball has."
    }
}

fn box_of(points: &[Point3]) -> Vec3 {
    let start = [Vec3::INFINITY, Vec3::NEG_INFINITY];
    let [least, most] =
        points.iter().fold(start, |[least, most], p| [least.min(p.to_vec()), most.max(p.to_vec())]);
    most - least
}

fn flat_caption(panel: &MadeMesh, material: Option<&Material>) -> Markup {
    let measures = &panel.measures;
    html! {
        strong { "Laid flat. " }
        @if measures.length_error_max < NO_ERROR {
            "Every length is as in space."
        } @else {
            "Each triangle has the colour of the largest relative difference among the lengths of its \
             sides, flat against space. The largest of all is "
            (per_cent(measures.length_error_max)) " (ringed), the mean "
            (per_cent(measures.length_error_mean)) ", weighed by area "
            (per_cent(measures.length_error_mean_by_area)) "."
        }
        @if measures.length_error_max > stretch_limit(material) {
            " The dashed line in the scale is what "
            (material.map_or("a sheet of no named material", |m| &m.title)) " takes."
        }
        @if panel.sheet.seams.len() == 1 {
            " Join the two sides that are marked " b { (seam_mark(0)) } "."
        } @else if !panel.sheet.seams.is_empty() {
            " Join the sides that have the same mark, " b { (seam_mark(0)) } " to "
            b { (seam_mark(panel.sheet.seams.len() - 1)) } "."
        }
    }
}

fn seams(panel: &MadeMesh) -> Markup {
    let at = |v: VertexIndex| panel.flat.points[v.get()];
    let length = |side: &Vec<VertexIndex>| -> f64 {
        side.windows(2).map(|pair| at(pair[0]).distance(at(pair[1]))).sum()
    };
    html! {
        @if !panel.sheet.seams.is_empty() {
            h3 { "Seams" }
            table.summary {
                thead {
                    tr {
                        th scope="col" { "Seam" }
                        th scope="col" { "In space" }
                        th scope="col" { "One side, flat" }
                        th scope="col" { "Other side, flat" }
                    }
                }
                tbody {
                    @for (n, seam) in panel.sheet.seams.iter().enumerate() {
                        tr {
                            th scope="row" { (seam_mark(n)) }
                            td data-label="In space" {
                                (millimetres_fine(seam_length(&panel.sheet.mesh, seam)))
                            }
                            td data-label="One side, flat" {
                                (millimetres_fine(length(&seam.sides[0])))
                            }
                            td data-label="Other side, flat" {
                                (millimetres_fine(length(&seam.sides[1])))
                            }
                        }
                    }
                }
            }
        }
    }
}

fn joints(made: &MadeMeshes, panel: &MadeMesh) -> Markup {
    html! {
        @if !panel.joints.is_empty() {
            h3 { "Joined to other panels" }
            table.summary {
                thead {
                    tr {
                        th scope="col" { "Mark" }
                        th scope="col" { "With" }
                        th scope="col" { "In space" }
                        th scope="col" { "Flat" }
                    }
                }
                tbody {
                    @for joint in &panel.joints {
                        tr {
                            th scope="row" { (joint.mark) }
                            td data-label="With" { (made.panels[joint.with].name) }
                            td data-label="In space" { (millimetres_fine(joint.length_mm)) }
                            td data-label="Flat" {
                                (millimetres_fine(steps_length(panel, &joint.steps)))
                            }
                        }
                    }
                }
            }
        }
    }
}

fn all_numbers(made: &MadeMeshes, panel: &MadeMesh, written_error_mm: f64) -> Markup {
    let (measures, sheet) = (&panel.measures, &panel.sheet.mesh);
    let crease = crease_angles(sheet).into_iter().fold(0.0, f64::max);
    let aim = match made.aim {
        Aim::Mean => "mean length error",
        Aim::Max => "largest length error",
        Aim::Seams => "border kept exact",
    };
    let mut rows = vec![
        ("Triangles", sheet.triangles().len().to_string()),
        ("Vertices", panel.mesh.positions().len().to_string()),
        ("Method", "mesh".to_owned()),
        ("Aim", format!("{} ({aim})", aim_name(made.aim))),
        ("Holes of the pattern", (sheet.loops().len() - 1).to_string()),
        ("Largest crease", degrees(to_deg(crease))),
        ("Area of the Gauss image", steradians(gauss_area_of_mesh(&panel.mesh))),
        ("Length error, largest", per_cent(measures.length_error_max)),
        ("Length error, mean", per_cent(measures.length_error_mean)),
        ("Length error, by area", per_cent(measures.length_error_mean_by_area)),
        ("Stretch, most", decimal(measures.stretch_max, 6)),
        ("Stretch, least", decimal(measures.stretch_min, 6)),
        ("Area in space", area(measures.area_space_mm2)),
        ("Area of the pattern", area(measures.area_flat_mm2)),
        ("Read back", refold(written_error_mm)),
    ];
    if let Some(rebuilt) = &panel.rebuilt {
        rows.push(("From its border, largest", millimetres_fine(rebuilt.distance_max_mm)));
        rows.push(("From its border, mean", millimetres_fine(rebuilt.distance_mean_mm)));
    }
    numbers(&rows)
}
