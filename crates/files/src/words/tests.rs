use super::*;
use sheetwright::check::{Finding, FindingKind, Place, PointReach, TooTight};
use sheetwright_shapes::findings::one_of_each;
use std::collections::BTreeSet;

/// The lines of a table of findings in a page of the docs: the code and the severities.
fn tabled(page: &str) -> Vec<(&str, &str)> {
    let rows = page.lines().filter_map(|line| line.strip_prefix("| `"));
    let cells = rows.filter_map(|row| {
        let (code, rest) = row.split_once("` | ")?;
        Some((code, rest.split(" | ").next()?))
    });
    cells.collect()
}

#[test]
fn every_code_and_severity_is_in_the_docs() {
    let report = include_str!("../../../../docs/report.md");
    let report = report.split("## The findings").nth(1).unwrap();
    let meshes = include_str!("../../../../docs/meshes.md");
    let rows: Vec<(&str, &str)> =
        [report, meshes].into_iter().flat_map(tabled).filter(|(code, _)| *code != "code").collect();
    let all = one_of_each();
    for finding in &all {
        let (code, severity) = (finding.code(), finding.severity().name());
        let mut of_code = rows.iter().filter(|row| row.0 == code);
        assert!(of_code.any(|row| row.1.contains(severity)), "{code}: {severity}");
    }
    let codes: BTreeSet<&str> = all.iter().map(Finding::code).collect();
    for (code, severity) in rows {
        let is_severity = ["error", "warning", "note"].iter().any(|s| severity.starts_with(s));
        assert!(!is_severity || codes.contains(code), "{code}");
    }
}

#[test]
fn sentences_are_whole_and_places_are_named() {
    for finding in one_of_each() {
        let (text, place) = (finding_text(&finding), finding_place(&finding));
        assert!(text.ends_with('.') && !text.contains("  ") && !text.contains(".."), "{text}");
        assert!(
            text.starts_with(|c: char| c.is_uppercase() || c.is_numeric() || c == '\''),
            "{text}"
        );
        assert_eq!(place.is_empty(), finding.place == Place::Whole, "{text}");
    }
}

#[test]
fn a_finding_reads_well() {
    let all = one_of_each();
    let said = |code: &str| {
        let of_code = all.iter().filter(|finding| finding.code() == code);
        let said = of_code.map(|f| format!("{} ({})", finding_text(f), finding_place(f)));
        said.collect::<Vec<_>>()
    };
    assert_eq!(
        said("no-effect")[1],
        "The mesh is folded between its facets and stretched nowhere, so the aim of flattening, the \
         angle of creases that divide it and cuts where it would stretch have no effect. ()"
    );
    assert_eq!(
        said("piece-too-large")[1],
        "With what is added along its edges, this facet by itself is 300 × 186.3 mm, and a piece \
         may have 277 × 190 mm. Add less along its edges, make the model smaller, or divide the \
         facet. ()"
    );
    assert_eq!(
        said("trim")[..3],
        [
            "There is room for full tabs along 20 % of the joint of fox-1/J3 with fox-2/J3, on \
             either side. Make the tabs narrower, or glue it edge to edge. ()",
            "There is room for full tabs along 20 % of the seam fox-1/S12, on either side. Make the \
             tabs narrower, or glue it edge to edge. ()",
            "There is room for full tabs along less than half of 10 joints, on either side, and \
             along 20 % of the worst: fox-1/S1, fox-1/S2, fox-1/S3, fox-1/S4, fox-1/S5, fox-1/S6 and \
             4 more. Make the tabs narrower, or glue them edge to edge. ()",
        ]
    );
    assert_eq!(
        said("strain-too-large")[0],
        "To take this shape, the sheet must stretch by 0.210 % within its plane. The limit for mild \
         steel, 1 mm is 0.120 %. In 0.63 mm it would take the shape. Move the boundary, or \
         choose a sheet that stretches more. (at (12.0, -3.5, 0.3) mm)"
    );
    assert_eq!(
        said("bends-divided"),
        [
            "Divided straight across into 2 panels of equal \
             length, it takes its shape. Computed by itself, 95 % of each panel stretches by less \
             than 0.0210 %, and it bends and folds. Draw them as panels of their own: each has another pattern than \
             its piece of this one. (along the line from (0.0, -3.5, 0.3) mm to (2.0, -3.5, 0.3) mm)",
            "Divided lengthwise into 3 panels of equal width, it takes its \
             shape. Computed by itself, 95 % of each panel stretches by less than 0.0210 %, and it \
             must be rolled. \
             Draw them as panels of their own: each has another pattern than its piece of this one. \
             (along the lines from (0.0, -3.5, 0.3) mm to (2.0, -3.5, 0.3) mm, from (3.0, -3.5, 0.3) \
             mm to (5.0, -3.5, 0.3) mm)"
        ]
    );
    assert_eq!(
        said("needs-force"),
        [
            "Bending needs force. To take this shape, the sheet must stretch by 0.0510 % within its \
             plane. The limit for mild steel, 1 mm is 0.120 %. To hold it takes a moment of about 83 \
             N·m for each metre of edge. (at (12.0, -3.5, 0.3) mm)",
            "Bending needs force. Its outer fibre stretches by 0.40 %; the limit for mild steel, 1 \
             mm is 0.50 %. (at (12.0, -3.5, 0.3) mm)",
            "Forming needs force. Its outer fibre stretches by 0.40 %; the limit for mild steel, 1 \
             mm is 0.50 %. To form it takes a moment of about 14 N·m for each metre of edge. (at \
             (12.0, -3.5, 0.3) mm)"
        ]
    );
    assert_eq!(
        said("divide")[0],
        "Cut it from the border at (7.0, 8.0, 9.0) mm to (0.0, 2.0, 3.3) mm, or \
         divide it along its sharp creases, or divide it into more panels in the program that \
         exported it. (at (0.0, 2.0, 3.3) mm)"
    );
    assert!(said("length-error").contains(
        &"From the pattern to the surface, lengths grow by up to 250 % and shrink by up to 4.7 %. \
          (at (0.0, 2.0, 3.3) mm)"
            .to_owned()
    ));
    assert_eq!(
        said("warp-not-reached"),
        [
            "'rim' and 'chine' moved by up to 1.50 mm (0.300 % of the size), 40.0 mm over all samples: \
          the largest warp angle goes from 9.00° to 5.00°, the total twist from 3.000e-1 to \
          1.000e-1. The goal of 4.0° is not reached within the limits: 1 rung stays \
          above 4.0°: within the limits, the largest warp angle comes down from 9.0° to 5.0°. Let \
          the boundary move farther, or draw it with less twist. (rung 4)"
        ]
    );
    assert_eq!(
        said("divided")[..2],
        [
            "Piece 1 of 4: the part is 22.14 m long and the largest sheet takes 5.98 × 2.38 m, so \
             it is divided by 3 scarfs of 96 mm. What is said of its bending is said of the whole \
             part. ()",
            "Piece 2 of 4, divided as the first says. ()"
        ]
    );
    assert!(said("not-proven")[0].contains("a greater \"effort\" of the panel allows more"));
    let places = |code: &str| {
        let of_code = all.iter().filter(|finding| finding.code() == code);
        of_code.map(finding_place).collect::<Vec<_>>()
    };
    assert_eq!(
        places("overlap"),
        [
            "edges from sample 3 to 4 and from 10 to 1",
            "the border at (0.0, 2.0, 3.3) mm and at (7.0, 8.0, 9.0) mm"
        ]
    );
    assert_eq!(places("self-crossing"), ["triangles at samples 1, 2, 10 and 5, 6, 7"]);
    assert_eq!(places("point"), ["sample 3", "samples 3, 5, 9"]);
    assert_eq!(
        places("seam"),
        [
            "S1 from sample 1 to 8, S2 from sample 2 to 9, S3 from sample 3 to 10, S4 from sample 4 \
             to 11, S5 from sample 5 to 12, S6 from sample 6 to 13 and 2 more",
            "S1",
            "S1 to S2",
            "S1 to S3",
            "S1 to S40"
        ]
    );
    assert_eq!(places("rounded-corner"), ["point 3 and 1 more of 'rim'"]);
    assert_eq!(places("joint-smoothed"), ["around samples 4, 10"]);
    let left_out = ["at (0.0, 2.0, 3.3) mm", "the first at (0.0, 2.0, 3.3) mm", ""];
    assert_eq!(places("left-out"), left_out);
}

#[test]
fn one_and_several_read_well() {
    let said = |kind| finding_text(&Finding::of_whole(kind));
    let folds = |count, stiff: Option<&str>| {
        let stiff = stiff.map(str::to_owned);
        said(FindingKind::Folds { count, sharpest: 0.5, stiff })
    };
    assert!(folds(1, None).ends_with("smoothly. The pattern marks it to be scored."));
    assert!(folds(2, None).ends_with("smoothly. The pattern marks them to be scored."));
    let ply = "plywood, 4 mm";
    assert!(folds(2, Some(ply)).ends_with("Plywood, 4 mm does not fold; move the boundary there."));
    let too_tight = TooTight { sheet: ply.to_owned(), limit_mm: 380.0, needed_mm: 12.0 };
    let points = FindingKind::Points {
        count: 1,
        turn: 0.5,
        reach: Some(PointReach { reach_mm: 760.0, limit_mm: 380.0, folds: false }),
        too_tight: Some(too_tight),
    };
    assert!(said(points).contains(
        "there. Within 760 mm of it the sheet would be bent to less than 380 mm, its limit: \
             there it breaks, or stands off. Rounded off, the bend radius there is 12.0 mm; the \
             limit for plywood, 4 mm is 380.0"
    ));
    let turned = |names: &[&str]| {
        let panels = names.iter().map(|&name| name.to_owned()).collect();
        said(FindingKind::TurnedRound { panels, first: "a".to_owned() })
    };
    assert!(turned(&["b"]).starts_with("'b' faced the other way, and was turned round"));
    assert!(turned(&["b", "c"]).starts_with("'b' and 'c' faced the other way, and were turned"));
}
