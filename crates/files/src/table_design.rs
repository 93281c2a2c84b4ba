//! Curve tables as designs: which of their curves are rails, outlines and holes.

use crate::linework::says_rail;
use crate::names::{refused_for_file, shown};
use crate::reading::{InputError, ReadOptions, display_name, stem};
use crate::table::{TableCurve, read_table};
use sheetwright::cost::PriceOptions;
use sheetwright::curve::CurveKind;
use sheetwright::design::{
    CurveUse, Design, DesignCurve, DesignPanel, FEWEST_ON_RAIL, PanelShape, ReadNote,
};

/// A table as a design of one panel: two open curves that are named rails are its rails; else its
/// outer loop is the first curve and its holes are the others.
///
/// # Errors
/// A table that can't be read; rails that are not two; a file whose name no panel may have.
pub(crate) fn read_as_design(
    text: &str,
    name: &str,
    options: &ReadOptions,
) -> Result<Design, InputError> {
    let table = read_table(text, name, options.units.unwrap_or_default())?;
    let called = stem(name);
    if let Some(why) = refused_for_file(&called) {
        let message = format!("the name of the panel would be {}, which {why}", shown(&called));
        let hint = "Rename the file: the panel and its output files are named after it.";
        return Err(InputError::at(display_name(name), message, hint));
    }
    // Closed curves are loops, whatever their names.
    if table.iter().any(is_open) {
        return design_of_curves(table, &called, display_name(name), options);
    }
    Ok(design_of_loops(&table, &called, options))
}

/// The curves of a panel as a design: two that are named rails are its rails; else the first is its
/// outline and the others are holes. `place` is where they stand, for messages.
///
/// # Errors
/// Several curves, of which some are named rails and not just two.
pub(crate) fn design_of_curves(
    curves: Vec<TableCurve>,
    called: &str,
    place: &str,
    options: &ReadOptions,
) -> Result<Design, InputError> {
    let rails = curves.iter().filter(|curve| says_rail(&curve.name)).count();
    // One curve alone is closed, whatever its name.
    if rails == 0 || curves.len() < 2 {
        return Ok(design_of_loops(&curves, called, options));
    }
    let count = curves.len();
    match <[TableCurve; 2]>::try_from(curves) {
        Ok(two) if rails == 2 => {
            let mut design = design_of_rails(&two, called, options);
            if two.iter().all(is_open) {
                let names = two.map(|rail| rail.name);
                design.notes.push(ReadNote::TakenForRails { names });
            }
            Ok(design)
        }
        _ => {
            let called = shown(called);
            let message = format!("{rails} of the {count} curves of the panel {called} are rails");
            let hint = "Give a panel two rails and nothing else, or name its curves otherwise.";
            Err(InputError::at(place, message, hint))
        }
    }
}

/// Whether the last point of a curve does not repeat its first.
pub(crate) fn is_open(curve: &TableCurve) -> bool {
    let ends = [curve.points.first(), curve.points.last()].map(|end| end.map(|point| point.at));
    ends[0] != ends[1]
}

/// Some closed curves as a design: one panel of this name, whose outer loop is the first curve and
/// whose holes are the others.
fn design_of_loops(table: &[TableCurve], called: &str, options: &ReadOptions) -> Design {
    // Rows are the samples themselves unless the caller sets a number of samples.
    let kind = options.samples.map(|_| CurveKind::Spline);
    let curves: Vec<DesignCurve> = table
        .iter()
        .map(|curve| DesignCurve {
            name: curve.name.clone(),
            kind,
            closed: true,
            points: curve.curve_points(true),
        })
        .collect();
    let whole = |curve: &DesignCurve| vec![CurveUse { name: curve.name.clone(), reversed: false }];
    let shape = PanelShape::Loops {
        outer: curves.first().map(whole).unwrap_or_default(),
        holes: curves.iter().skip(1).map(whole).collect(),
    };
    let samples = options.samples.or(curves.first().map(|curve| curve.points.len()));
    design_of(curves, DesignPanel::new(called, shape, samples.unwrap_or(0)), options)
}

/// Two open curves as a design: one panel of this name between them, each a spline through its rows
/// with as many samples as the longer one has rows, unless the caller sets another number.
fn design_of_rails(rails: &[TableCurve; 2], called: &str, options: &ReadOptions) -> Design {
    let curves: Vec<DesignCurve> = rails
        .iter()
        .map(|rail| DesignCurve {
            name: rail.name.clone(),
            kind: Some(CurveKind::Spline),
            closed: false,
            points: rail.curve_points(false),
        })
        .collect();
    let whole = |rail: &TableCurve| CurveUse { name: rail.name.clone(), reversed: false };
    let shape = PanelShape::Rails([whole(&rails[0]), whole(&rails[1])]);
    let rows = rails[0].points.len().max(rails[1].points.len());
    let samples = options.samples.unwrap_or(rows.max(FEWEST_ON_RAIL));
    design_of(curves, DesignPanel::new(called, shape, samples), options)
}

fn design_of(curves: Vec<DesignCurve>, panel: DesignPanel, options: &ReadOptions) -> Design {
    let panel = DesignPanel {
        method: options.method.unwrap_or_default(),
        which: options.which.unwrap_or_default(),
        plane: options.plane.unwrap_or_default(),
        slides: options.slides.unwrap_or_default(),
        fold: options.fold.unwrap_or(PriceOptions::default().fold),
        effort: options.effort.unwrap_or(1.0),
        ..panel
    };
    let vary = options.vary.applied(Vec::new());
    Design { name: panel.name.clone(), curves, panels: vec![panel], vary, ..Design::default() }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)] // tests panic
    use super::*;

    #[test]
    fn rows_are_samples_unless_a_number_is_asked_for() {
        let text = "x,y,z\n0,0,0\n1,0,0\n1,1,0\n0,0,0\n";
        let design = read_as_design(text, "a/leaf.csv", &ReadOptions::default()).unwrap();
        assert_eq!((design.name.as_str(), design.panels[0].name.as_str()), ("leaf", "leaf"));
        assert_eq!((design.curves[0].kind, design.panels[0].samples), (None, 3));
        let options = ReadOptions { samples: Some(50), ..ReadOptions::default() };
        let design = read_as_design(text, "leaf.csv", &options).unwrap();
        assert_eq!(design.curves[0].kind, Some(CurveKind::Spline));
        assert_eq!(design.panels[0].samples, 50);
        let error = read_as_design(text, "con.csv", &ReadOptions::default()).unwrap_err();
        assert!(error.message.contains("device on Windows"));
    }

    #[test]
    fn open_curves_that_are_named_rails_are_rails() {
        let read = |text: &str| read_as_design(text, "plank.csv", &ReadOptions::default());
        let rows = |name: &str, y: f64, last: &str| {
            format!("{name},0,{y},0\n{name},1,{y},1\n{name},2,{y},0\n{last}")
        };
        let table = |curves: &[String]| format!("curve,x,y,z\n{}", curves.concat());
        let two = [rows("rail-unten", 0.0, ""), rows("Rail oben", 1.0, "")];
        let design = read(&table(&two)).unwrap();
        let PanelShape::Rails([first, second]) = &design.panels[0].shape else { panic!() };
        assert_eq!([&first.name[..], &second.name[..]], ["rail-unten", "Rail oben"]);
        assert!(design.curves.iter().all(|curve| !curve.closed && curve.points.len() == 3));
        let names = ["rail-unten", "Rail oben"].map(str::to_owned);
        assert_eq!(design.notes, [ReadNote::TakenForRails { names }]);
        // Closed curves, and those of other names, are an outline and its hole.
        let closed = [rows("rail 1", 0.0, "rail 1,0,0,0\n"), rows("rail 2", 1.0, "rail 2,0,1,0\n")];
        for two in [closed, [rows("railing", 0.0, ""), rows("handrail", 1.0, "")]] {
            let design = read(&table(&two)).unwrap();
            let PanelShape::Loops { outer, holes } = &design.panels[0].shape else { panic!() };
            assert_eq!((outer.len(), holes.len(), design.notes.len()), (1, 1, 0));
        }
        let error = read(&table(&[rows("rail", 0.0, ""), rows("hole", 1.0, "")])).unwrap_err();
        assert_eq!(error.message, "1 of the 2 curves of the panel 'plank' are rails");
    }
}
