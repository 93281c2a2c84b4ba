//! The published hull of the UBC series fishing vessel \[ZB18\], whose table is in feet.

use sheetwright::curve::{CurveKind, CurvePoint};
use sheetwright::design::{CurveUse, Design, DesignCurve, DesignPanel, PanelShape};
use sheetwright::math::Point3;

const TABLE: &str = include_str!("../../../examples/ubc-fishing-vessel.csv");
const FOOT_MM: f64 = 304.8;

/// Its four curves, splines in mm: main deck, upper and lower chine, profile.
///
/// # Panics
/// If a row of `examples/ubc-fishing-vessel.csv` is not a name and three numbers.
pub fn curves() -> Vec<DesignCurve> {
    let mut curves: Vec<DesignCurve> = Vec::new();
    for row in TABLE.lines().skip(1) {
        let mut cells = row.split(',');
        let name = cells.next().unwrap_or_default();
        let [x, y, z] = [(); 3].map(|()| {
            let feet = cells.next().and_then(|cell| cell.parse::<f64>().ok());
            feet.expect("the table of the hull is numbers") * FOOT_MM
        });
        let point = CurvePoint::smooth(Point3::new(x, y, z));
        match curves.last_mut() {
            Some(curve) if curve.name == name => curve.points.push(point),
            _ => {
                let (name, kind) = (name.to_owned(), Some(CurveKind::Spline));
                curves.push(DesignCurve { name, kind, closed: false, points: vec![point] });
            }
        }
    }
    curves
}

/// Its three planks, named after their lower curves, with this many samples on each rail and this
/// weight of the fold price.
pub fn planks(samples: usize, fold: f64) -> Design {
    let curves = curves();
    let on = |curve: &DesignCurve| CurveUse { name: curve.name.clone(), reversed: false };
    let plank = |pair: &[DesignCurve]| DesignPanel {
        fold,
        ..DesignPanel::new(
            pair[1].name.clone(),
            PanelShape::Rails([on(&pair[0]), on(&pair[1])]),
            samples,
        )
    };
    let panels = curves.windows(2).map(plank).collect();
    Design { name: "hull".to_owned(), curves, panels, ..Design::default() }
}
