//! Bags of leather or cloth.

use super::sketch::{Drawn, Sketch};
use super::{Parameter, Template, TemplateError, Values, angle, length, number};
use sheetwright_geometry::math::{Point3, cos, sin};

/// A tote: two walls and one gusset that runs round them.
pub(super) const BAG: Template = Template {
    name: "bag",
    title: "Bag: front, back and one gusset round sides and bottom",
    who: "Leather workers and bag makers sew it as a tote or a handbag (of 2 mm leather unless \
          material says otherwise); the front and the back are cut by one pattern.",
    words: &[
        "tote",
        "handbag",
        "satchel",
        "shoulder bag",
        "gusset",
        "leather bag",
        "sewing pattern",
        "leathercraft",
    ],
    parameters: &PARAMETERS,
    sheet: Some("leather-2mm"),
    trade: Some("leather"),
    build: bag,
};

const PARAMETERS: [Parameter; 6] = [
    length("width", "width of the front at the mouth", 200.0, 1000.0, 380.0),
    length("height", "height of the bag, upright", 120.0, 800.0, 330.0),
    length("depth", "width of the gusset at the bottom", 60.0, 400.0, 120.0),
    angle("taper", "how far the sides lean outwards from bottom to mouth", -10.0, 15.0, 5.0),
    angle("lean", "how far front and back lean towards one another", -10.0, 8.0, 3.5),
    number(
        "corner",
        "how far round corners reach, as a share of the bottom's width or the height",
        0.15,
        0.45,
        0.28,
    ),
];

/// Least width of the bottom of a front, mm; that of the gusset at the mouth is a third of it. Less
/// can't be sewn.
const NARROWEST: f64 = 30.0;
/// Largest distance of samples of the gusset, as a share of the reach of a corner: the radius of
/// its tightest bend is a third of that reach, so it turns by 5° from one sample to the next.
const SAMPLE: f64 = 0.03;
/// Limits of the samples of the gusset.
const SAMPLES: [f64; 2] = [200.0, 1600.0];

/// The seam is a curve in the upright plane of the front, pushed forward by half of the depth at
/// its height. The seam of the back is its mirror image, so all straight lines of the gusset run
/// across: it is a cylinder.
fn bag(values: &Values) -> Drawn {
    let (mouth, height) = (values.number("width"), values.number("height"));
    let (depth, lean) = (values.number("depth"), slope(values.radians("lean")));
    let bottom = mouth - 2.0 * height * slope(values.radians("taper"));
    if bottom < NARROWEST {
        return Err(TemplateError::together(
            "taper",
            format!(
                "the sides come together at the bottom, which is {:.0} mm wide",
                bottom.max(0.0)
            ),
            "Let them lean less, or make the bag wider or lower.",
        ));
    }
    if depth - 2.0 * height * lean < NARROWEST / 3.0 {
        return Err(TemplateError::together(
            "lean",
            "front and back come together below the mouth",
            "Let them lean less, or make the bag deeper or lower.",
        ));
    }

    let reach = values.number("corner") * bottom.min(height);
    let outline = outline([mouth / 2.0, height], bottom / 2.0, reach);
    let half_depth = |z: f64| depth / 2.0 - z * lean;
    let seam = |side: f64| -> Vec<Point3> {
        outline.iter().map(|&[x, z]| Point3::new(x, side * half_depth(z), z)).collect()
    };
    let (front, back) = (seam(-1.0), seam(1.0));
    let mut sketch = Sketch::default();
    sketch.bspline("front-seam", &front);
    sketch.bspline("back-seam", &back);
    sketch.polyline("mouth", &[front[front.len() - 1], front[0]]);
    sketch.polyline("back-mouth", &[back[0], back[back.len() - 1]]);
    sketch.patch("front", &["front-seam", "mouth"], 400);
    sketch.patch("back", &["-back-seam", "back-mouth"], 400);
    let [least, most] = SAMPLES;
    let samples = ((bottom + 2.0 * height) / (reach * SAMPLE)).clamp(least, most) as usize;
    sketch.strip("gusset", ["back-seam", "front-seam"], samples);
    Ok(sketch)
}

/// Control points of the seam in the plane of x and height, from the left end of the mouth to the
/// right. Where four in a row lie on a line, a cubic B-spline runs straight; round a corner with
/// its neighbours `reach` away on both sides, it leaves the line there.
fn outline(mouth: [f64; 2], bottom: f64, reach: f64) -> Vec<[f64; 2]> {
    let [half_mouth, height] = mouth;
    let (run, rise) = (half_mouth - bottom, height);
    let side = (run * run + rise * rise).sqrt();
    let up = |distance: f64| [-bottom - run * distance / side, rise * distance / side];
    let straight = side - 2.0 * reach;
    let mut half = vec![[-half_mouth, height]];
    if straight > 0.0 {
        half.extend([up(2.0 * reach + straight / 2.0), up(2.0 * reach)]);
    }
    half.extend([up(reach), [-bottom, 0.0], [reach - bottom, 0.0]]);
    if bottom > 2.0 * reach {
        half.push([2.0 * reach - bottom, 0.0]);
    }
    let mirrored: Vec<[f64; 2]> = half.iter().rev().map(|&[x, z]| [-x, z]).collect();
    half.extend(mirrored);
    half
}

/// The tangent of an angle below a right one.
fn slope(angle: f64) -> f64 {
    sin(angle) / cos(angle)
}
