//! How a design is drawn: the field `drawing` of its file, which making it passes over.

use super::source::Source;
use crate::drawing::{Drawing, Mirror, Plan, Reference};
use crate::json::Object;
use crate::reading::InputError;
use crate::table::in_range_mm;
use crate::units::Units;
use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use sheetwright::math::Point2;

/// How a design is drawn in the editor. Nothing in it changes what is made.
#[derive(Debug, Default, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct DrawingFile {
    /// The unit that lengths are shown in. Default: that of the points.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    units: Option<Units>,
    /// The plane that is drawn on. Default: top.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    plan: Option<PlanName>,
    /// The line that both sides are alike of.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Option<MirrorFile>")]
    mirror: Option<Object<MirrorFile>>,
    /// The distance of the lines of the grid, mm. Default: 50.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0))]
    grid_mm: Option<f64>,
    /// Whether points settle on the grid. Default: false.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    snap_to_grid: bool,
    /// A picture to draw after.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Option<ReferenceFile>")]
    reference: Option<Object<ReferenceFile>>,
}

/// The plane that is drawn on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
enum PlanName {
    /// Seen from above: x and y.
    Top,
    /// Seen from the front: x and z.
    Front,
    /// Seen from the right side: y and z.
    Side,
}

/// A line of the plan that both sides are alike of.
#[derive(Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct MirrorFile {
    /// Whether the line runs upwards on the plan; else it runs to the right.
    upright: bool,
    /// Where it stands on the axis that it crosses, mm.
    at_mm: f64,
}

/// A picture under the plan.
#[derive(Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct ReferenceFile {
    /// The name of the file that it came from.
    name: String,
    /// Where its middle lies on the plan, mm.
    centre: [f64; 2],
    /// The size of a pixel, mm.
    mm_per_pixel: f64,
    /// How much of it shows, from 0 to 1.
    #[schemars(range(min = 0, max = 1))]
    opacity: f64,
    /// The bytes of that file, PNG or JPEG, in base64.
    data: String,
}

/// How a design is drawn, of what its file says of it.
pub(super) fn read(
    file: Option<Object<DrawingFile>>,
    units: Units,
    source: &Source<'_>,
) -> Result<Drawing, InputError> {
    let Some(Object(file)) = file else { return Ok(Drawing::in_units(units)) };
    let usual = Drawing::in_units(file.units.unwrap_or(units));
    let in_range = |path: &str, mm: f64| {
        in_range_mm(mm, Units::Millimetres).ok_or_else(|| {
            let path = format!("drawing.{path}");
            source.error(&path, "the number is out of range", "Write a length in mm.")
        })
    };
    let positive = |path: &str, mm: f64| match in_range(path, mm)? {
        mm if mm > 0.0 => Ok(mm),
        _ => {
            let path = format!("drawing.{path}");
            Err(source.error(&path, "the length is not above 0", "Write a length in mm above 0."))
        }
    };
    let mirror = match file.mirror {
        None => None,
        Some(Object(mirror)) => {
            let at_mm = in_range("mirror.at_mm", mirror.at_mm)?;
            Some(Mirror { upright: mirror.upright, at_mm })
        }
    };
    let reference = match file.reference {
        None => None,
        Some(Object(picture)) => {
            let bytes = BASE64_STANDARD.decode(&picture.data).map_err(|_| {
                let hint = "Add the picture again in the editor, or leave `reference` out.";
                source.error("drawing.reference.data", "the text is not base64", hint)
            })?;
            Some(Reference {
                name: picture.name,
                bytes: bytes.into(),
                centre: Point2::new(
                    in_range("reference.centre[0]", picture.centre[0])?,
                    in_range("reference.centre[1]", picture.centre[1])?,
                ),
                mm_per_pixel: positive("reference.mm_per_pixel", picture.mm_per_pixel)?,
                opacity: picture.opacity.clamp(0.0, 1.0),
            })
        }
    };
    Ok(Drawing {
        units: file.units.unwrap_or(units),
        plan: match file.plan {
            None | Some(PlanName::Top) => Plan::Top,
            Some(PlanName::Front) => Plan::Front,
            Some(PlanName::Side) => Plan::Side,
        },
        mirror,
        grid_mm: file.grid_mm.map_or(Ok(usual.grid_mm), |mm| positive("grid_mm", mm))?,
        snap_to_grid: file.snap_to_grid,
        reference,
    })
}

/// What stands in a file, if it differs from what is usual.
pub(super) fn file_of(drawing: &Drawing) -> Option<DrawingFile> {
    let usual = Drawing::in_units(drawing.units);
    if *drawing == Drawing::default() {
        return None;
    }
    let plan = match drawing.plan {
        Plan::Top => PlanName::Top,
        Plan::Front => PlanName::Front,
        Plan::Side => PlanName::Side,
    };
    Some(DrawingFile {
        // Points are written in mm.
        units: (drawing.units != Units::Millimetres).then_some(drawing.units),
        plan: (drawing.plan != usual.plan).then_some(plan),
        mirror: drawing.mirror.map(|m| Object(MirrorFile { upright: m.upright, at_mm: m.at_mm })),
        grid_mm: (drawing.grid_mm != usual.grid_mm).then_some(drawing.grid_mm),
        snap_to_grid: drawing.snap_to_grid,
        reference: drawing.reference.as_ref().map(|picture| {
            Object(ReferenceFile {
                name: picture.name.clone(),
                centre: [picture.centre.x, picture.centre.y],
                mm_per_pixel: picture.mm_per_pixel,
                opacity: picture.opacity,
                data: BASE64_STANDARD.encode(&picture.bytes),
            })
        }),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design_json::{read_drawn, write_drawn};
    use crate::reading::ReadOptions;
    use sheetwright::design::Design;

    fn drawn() -> (Design, Drawing) {
        let design = crate::template_call::design_from_template("cone", &[]).unwrap();
        let reference = Reference {
            name: "plan.png".to_owned(),
            bytes: vec![1, 2, 255].into(),
            centre: Point2::new(3.5, -4.0),
            mm_per_pixel: 0.25,
            opacity: 0.5,
        };
        let drawing = Drawing {
            units: Units::Inches,
            plan: Plan::Front,
            mirror: Some(Mirror { upright: false, at_mm: 12.5 }),
            grid_mm: 25.4,
            snap_to_grid: true,
            reference: Some(reference),
        };
        (design, drawing)
    }

    #[test]
    fn what_is_drawn_reads_back_equal_and_makes_the_same() {
        let (design, drawing) = drawn();
        for drawing in [drawing, Drawing::default()] {
            let bytes = write_drawn(&design, &drawing);
            let back = read_drawn(&bytes, "cone.sheet.json", None).unwrap();
            assert_eq!(back, (design.clone(), drawing));
            let options = ReadOptions::default();
            let text = std::str::from_utf8(&bytes).unwrap();
            assert_eq!(super::super::read(text, "cone.sheet.json", None, &options), Ok(back.0));
        }
        assert_eq!(write_drawn(&design, &Drawing::default()), crate::write_design(&design));
    }

    #[test]
    fn a_grid_that_no_file_names_is_round_in_the_units_shown() {
        for (units, mm) in [("mm", 50.0), ("ft", 50.8), ("in", 50.8)] {
            let text =
                format!(r#"{{"sheetwright":1,"units":"{units}","curves":{{}},"panels":[]}}"#);
            let (design, drawing) = read_drawn(text.as_bytes(), "a.sheet.json", None).unwrap();
            assert_eq!(drawing.grid_mm, mm, "{units}");
            // A grid that the user has set stays, whether or not it is round.
            for grid_mm in [mm, 50.0, 50.8] {
                let drawing = Drawing { grid_mm, ..drawing.clone() };
                let bytes = write_drawn(&design, &drawing);
                assert_eq!(read_drawn(&bytes, "a.sheet.json", None).unwrap().1, drawing, "{units}");
            }
        }
    }

    #[test]
    fn units_of_the_points_are_those_that_are_shown() {
        let text = r#"{"sheetwright":1,"units":"ft","curves":{},"panels":[]}"#;
        let (_, drawing) = read_drawn(text.as_bytes(), "a.sheet.json", None).unwrap();
        assert_eq!(drawing.units, Units::Feet);
    }

    #[test]
    fn what_can_not_be_drawn_on_is_refused_by_its_path() {
        for (field, path) in [
            (r#""grid_mm":0"#, "drawing.grid_mm"),
            (r#""grid_mm":-1"#, "drawing.grid_mm"),
            (r#""mirror":{"upright":true,"at_mm":1e300}"#, "drawing.mirror.at_mm"),
            (
                r#""reference":{"name":"a","centre":[0,0],"mm_per_pixel":1,"opacity":1,"data":"§"}"#,
                "drawing.reference.data",
            ),
        ] {
            let text =
                format!(r#"{{"sheetwright":1,"curves":{{}},"panels":[],"drawing":{{{field}}}}}"#);
            let error = read_drawn(text.as_bytes(), "a.sheet.json", None).unwrap_err();
            assert_eq!(error.place, Some(format!("a.sheet.json: {path}")), "{field}");
            // The command line says the same.
            let options = ReadOptions::default();
            assert_eq!(super::super::read(&text, "a.sheet.json", None, &options), Err(error));
        }
    }
}
