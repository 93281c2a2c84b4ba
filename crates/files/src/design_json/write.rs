//! A kernel design as JSON: one block per curve, one line per point and per panel.

use super::bends;
use super::drawing::DrawingFile;
use super::grammar::{GoalName, KindName, MethodName, SideName, SmoothName};
use super::{VERSION, marks, material, mesh, sheets, thickness, trims, vary};
use crate::json::json;
use crate::materials::file_of;
use crate::units::Units;
use sheetwright::boundary::{Continuity, PlaneChoice, Within};
use sheetwright::curve::{CurveKind, CurvePoint};
use sheetwright::design::{
    CurveUse, Design, DesignCurve, DesignPanel, PanelMethod, PanelShape, SampleTolerance,
};
use sheetwright::triangulate::{Goal, WhichSurface};

/// The bytes of a design's file, in millimetres. They have every default except those of rare
/// fields (`goal`, `run_on`, `slide`, `cut`, `vary`, `match_seams`, `preset`, `dxf`, `formats`) and
/// of `samples`, and read back equal. A tolerance of the design stands in its panels.
pub fn write_design(design: &Design) -> Vec<u8> {
    write_with(design, None)
}

/// The bytes of a design's file, in millimetres, with its drawing where that differs from the
/// default.
pub(super) fn write_with(design: &Design, drawing: Option<&DrawingFile>) -> Vec<u8> {
    write(design, drawing, Some(Units::Millimetres), |curve| self::curve(curve, Units::Millimetres))
}

/// The bytes of a design's file, in `units`; without them in millimetres, and the table may name
/// its own unit. The points of curves that are `in_table` stay in the table `table`.
pub(crate) fn write_design_of_table(
    design: &Design,
    table: &str,
    units: Option<Units>,
    in_table: impl Fn(&DesignCurve) -> bool,
) -> Vec<u8> {
    write(design, None, units, |curve| {
        if !in_table(curve) {
            return self::curve(curve, units.unwrap_or_default());
        }
        format!(
            "    {}: {{ \"kind\": {}, \"closed\": {}, \"table\": {}, \"curve\": {} }}",
            json(&curve.name),
            json(&kind(curve)),
            curve.closed,
            json(&table),
            json(&curve.name)
        )
    })
}

fn write(
    design: &Design,
    drawing: Option<&DrawingFile>,
    units: Option<Units>,
    curve: impl Fn(&DesignCurve) -> String,
) -> Vec<u8> {
    let mut fields = vec![
        format!("  \"sheetwright\": {VERSION}"),
        format!("  \"name\": {}", json(&design.name)),
    ];
    fields.extend(units.map(|units| format!("  \"units\": {}", json(&units))));
    let units = units.unwrap_or_default();
    let (material, own) = material::written(design);
    fields.extend(material.map(|name| format!("  \"material\": {}", json(&name))));
    if !own.is_empty() {
        let own: Vec<String> =
            own.iter().map(|m| format!("    {}: {}", json(&m.name), json(&file_of(m)))).collect();
        fields.push(format!("  \"materials\": {{\n{}\n  }}", own.join(",\n")));
    }
    let curves: Vec<String> = design.curves.iter().map(curve).collect();
    fields.push(format!("  \"curves\": {{\n{}\n  }}", curves.join(",\n")));
    if let Some(vary) = design.vary.iter().find(|vary| vary.panels.len() != 1) {
        fields.push(format!("  \"vary\": {}", json(&vary::written(vary, false))));
    }
    if design.match_seams {
        fields.push("  \"match_seams\": true".to_owned());
    }
    fields.extend(design.preset.iter().map(|name| format!("  \"preset\": {}", json(name))));
    fields.extend(design.dxf.iter().map(|name| format!("  \"dxf\": {}", json(name))));
    fields.extend(design.arcs_mm.map(|mm| format!("  \"arcs\": {}", json(&mm))));
    if !design.formats.is_empty() {
        fields.push(format!("  \"formats\": {}", json(&design.formats)));
    }
    fields.extend(thickness::written(design));
    fields.extend(bends::written(&design.bends).map(|bends| format!("  {bends}")));
    let of_panel = |p: &DesignPanel| {
        let own = design.vary.iter().find(|vary| vary.panels == [p.name.as_str()]);
        panel(p, own.map(|vary| json(&vary::written(vary, true))))
    };
    let panels: Vec<String> = design.panels.iter().map(of_panel).collect();
    fields.push(format!("  \"panels\": [\n{}\n  ]", panels.join(",\n")));
    let thickness_mm = design.sheet_thickness_mm();
    let (trade, own) = trims::written(design.trade.as_deref(), &design.trims, thickness_mm);
    fields.extend(trade.map(|trade| format!("  \"for\": {}", json(&trade))));
    if !own.is_empty() {
        let own: Vec<String> = own.iter().map(|trim| format!("    {}", json(trim))).collect();
        fields.push(format!("  \"trims\": [\n{}\n  ]", own.join(",\n")));
    }
    let marks: Vec<String> =
        marks::written(&design.marks, units).iter().map(|m| format!("    {}", json(m))).collect();
    if !marks.is_empty() {
        fields.push(format!("  \"marks\": [\n{}\n  ]", marks.join(",\n")));
    }
    let stock = sheets::written(design.stock.as_ref(), units);
    fields.extend(stock.map(|sheets| format!("  \"sheets\": {sheets}")));
    fields.extend(drawing.map(|drawing| format!("  \"drawing\": {}", json(drawing))));
    format!("{{\n{}\n}}\n", fields.join(",\n")).into_bytes()
}

fn kind(curve: &DesignCurve) -> KindName {
    match curve.kind {
        None => KindName::Samples,
        Some(CurveKind::Polyline) => KindName::Polyline,
        Some(CurveKind::Spline) => KindName::Spline,
        Some(CurveKind::BSpline) => KindName::BSpline,
    }
}

fn curve(curve: &DesignCurve, units: Units) -> String {
    let points: Vec<String> =
        curve.points.iter().map(|point| format!("        {}", self::point(point, units))).collect();
    format!(
        "    {}: {{\n      \"kind\": {},\n      \"closed\": {},\n      \"points\": [\n{}\n      ]\n    }}",
        json(&curve.name),
        json(&kind(curve)),
        curve.closed,
        points.join(",\n")
    )
}

fn point(point: &CurvePoint, units: Units) -> String {
    let at = json(&[point.at.x, point.at.y, point.at.z].map(|mm| units.number(mm)));
    let corner = if point.corner { ",\"corner\":true" } else { "" };
    match point.move_mm {
        0.0 if corner.is_empty() => at,
        0.0 => format!("{{\"at\":{at}{corner}}}"),
        mm => format!("{{\"at\":{at}{corner},\"move\":{}}}", json(&units.number(mm))),
    }
}

fn panel(panel: &DesignPanel, vary: Option<String>) -> String {
    let names = |uses: &[CurveUse]| -> Vec<String> {
        let name = |u: &CurveUse| format!("{}{}", if u.reversed { "-" } else { "" }, u.name);
        uses.iter().map(name).collect()
    };
    let mut fields = vec![format!("\"name\": {}", json(&panel.name))];
    match &panel.shape {
        PanelShape::Rails(rails) => fields.push(format!("\"rails\": {}", json(&names(rails)))),
        PanelShape::Loops { outer, holes } => {
            fields.push(format!("\"boundary\": {}", json(&names(outer))));
            if !holes.is_empty() {
                let holes: Vec<Vec<String>> = holes.iter().map(|hole| names(hole)).collect();
                fields.push(format!("\"holes\": {}", json(&holes)));
            }
        }
        PanelShape::Mesh(given) => {
            fields.extend(mesh::fields(given));
            fields.extend(panel.bends.as_ref().map(bends::written_of_panel));
            fields.extend(counts(panel));
            return format!("    {{ {} }}", fields.join(", "));
        }
        PanelShape::Join(join) => {
            fields.push(format!("\"join\": {}", json(&join.parts)));
            let smooth = match join.smooth {
                Continuity::G0 => SmoothName::None,
                Continuity::G1 => SmoothName::G1,
                Continuity::G2 => SmoothName::G2,
            };
            fields.push(format!("\"smooth\": {}", json(&smooth)));
            // Readers refuse `within` where nothing is made smooth.
            if smooth != SmoothName::None {
                fields.push(match join.within {
                    Within::Mm(mm) => format!("\"within\": {}", json(&mm)),
                    Within::Share(share) => format!("\"within\": {{\"share\": {}}}", json(&share)),
                });
            }
            fields.push(format!("\"keep_parts\": {}", join.keep_parts));
        }
    }
    match panel.tolerance {
        Some(SampleTolerance::Mm(mm)) => fields.push(format!("\"tolerance\": {}", json(&mm))),
        Some(SampleTolerance::Share(_)) => {}
        None => fields.push(format!("\"samples\": {}", panel.samples)),
    }
    let method = match panel.method {
        PanelMethod::Optimal => MethodName::Optimal,
        PanelMethod::Bridge => MethodName::Bridge,
        PanelMethod::Rails => MethodName::Rails,
    };
    fields.push(format!("\"method\": {}", json(&method)));
    match panel.goal {
        Goal::Price => {}
        Goal::WorstWarp => fields.push(format!("\"goal\": {}", json(&GoalName::WorstWarp))),
    }
    if panel.run_on {
        fields.push("\"run_on\": true".to_owned());
    }
    if panel.slides {
        fields.push("\"slide\": true".to_owned());
    }
    fields.push(match panel.plane {
        PlaneChoice::Auto => "\"plane\": \"auto\"".to_owned(),
        PlaneChoice::None => "\"plane\": \"none\"".to_owned(),
        PlaneChoice::Normal(normal) => {
            format!("\"plane\": {}", json(&[normal.x, normal.y, normal.z]))
        }
    });
    fields.push(format!("\"fold\": {}", json(&panel.fold)));
    if panel.effort != 1.0 {
        fields.push(format!("\"effort\": {}", json(&panel.effort)));
    }
    for (name, points) in [("cut", &panel.cut), ("near", &panel.near)] {
        if !points.is_empty() {
            let points: Vec<[f64; 3]> = points.iter().map(|p| [p.x, p.y, p.z]).collect();
            fields.push(format!("\"{name}\": {}", json(&points)));
        }
    }
    match panel.which {
        WhichSurface::Cheapest => {}
        WhichSurface::Other => fields.push(format!("\"side\": {}", json(&SideName::Other))),
    }
    fields.extend(vary.map(|vary| format!("\"vary\": {vary}")));
    fields.extend(panel.bends.as_ref().map(bends::written_of_panel));
    fields.extend(counts(panel));
    format!("    {{ {} }}", fields.join(", "))
}

/// How many of a panel are cut, where that is not one as it is.
fn counts(panel: &DesignPanel) -> impl Iterator<Item = String> {
    let counts = [("count", panel.count, 1), ("mirrored", panel.mirrored, 0)];
    let said = counts.into_iter().filter(|(_, number, usual)| number != usual);
    said.map(|(name, number, _)| format!("\"{name}\": {number}"))
}
