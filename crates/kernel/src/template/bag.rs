//! Bags of leather or cloth.

use super::sketch::{Drawn, Sketch};
use super::{Parameter, Template, TemplateError, Values, length};
use crate::math::Point3;

/// A tote: two walls and one gusset that runs round them.
pub(super) const BAG: Template = Template {
    name: "bag",
    title: "Bag: front, back and one gusset round sides and bottom",
    who: "Leather workers and bag makers sew it as a tote or a handbag (of 2 mm leather unless \
          material says otherwise); the back is the front cut once more.",
    words: &[
        "bag",
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
    build: bag,
};

const PARAMETERS: [Parameter; 6] = [
    length("width", "of the front at the mouth", 100.0, 1000.0, 380.0),
    length("bottom-width", "of the front at the bottom, between the corners", 80.0, 1000.0, 320.0),
    length("height", "of the bag, upright", 80.0, 1000.0, 330.0),
    length("depth", "of the gusset at the bottom", 20.0, 500.0, 120.0),
    length("mouth-depth", "of the gusset at the mouth", 10.0, 500.0, 80.0),
    length("corner", "how far round corners reach along the bottom and up", 20.0, 300.0, 90.0),
];

/// Corners reach along at most this share of the bottom and of the height each: the two of a bottom
/// leave a straight piece between them.
const LARGEST_CORNER: f64 = 0.45;
/// The walls lean by at most this much of their height, so that they still stand: 45°.
const LARGEST_LEAN: f64 = 1.0;

/// The seam is a curve in the upright plane of the front, pushed forward by half of the depth at
/// its height. The back has its mirror image, and so all straight lines of the gusset run across:
/// it is a cylinder.
fn bag(values: &Values) -> Drawn {
    let (mouth, bottom) = (values.number("width"), values.number("bottom-width"));
    let (height, corner) = (values.number("height"), values.number("corner"));
    let (depth, mouth_depth) = (values.number("depth"), values.number("mouth-depth"));
    let room = LARGEST_CORNER * bottom.min(height);
    if corner > room {
        return Err(TemplateError::together(
            "corner",
            format!("round corners of {corner} mm do not fit the bottom and the height"),
            format!("Take {room:.0} mm or less."),
        ));
    }
    for (parameter, lean) in [
        ("bottom-width", (mouth - bottom).abs() / 2.0),
        ("mouth-depth", (depth - mouth_depth).abs() / 2.0),
    ] {
        if lean > LARGEST_LEAN * height {
            return Err(TemplateError::together(
                parameter,
                format!("a wall leans over {lean:.0} mm and is {height} mm high"),
                "Bring the sizes at mouth and bottom nearer together, or make the bag higher.",
            ));
        }
    }

    let outline = outline([mouth / 2.0, height], bottom / 2.0, corner);
    let half_depth = |z: f64| (depth + (mouth_depth - depth) * z / height) / 2.0;
    let seam = |side: f64| -> Vec<Point3> {
        outline.iter().map(|&[x, z]| Point3::new(x, side * half_depth(z), z)).collect()
    };
    let (front, back) = (seam(-1.0), seam(1.0));
    let mut sketch = Sketch::default();
    sketch.bspline("front-seam", &front);
    sketch.bspline("back-seam", &back);
    sketch.polyline("mouth", &[front[front.len() - 1], front[0]]);
    sketch.patch("front", &["front-seam", "mouth"], 200);
    sketch.strip("gusset", ["back-seam", "front-seam"], 200);
    sketch.sheet("leather-2mm");
    Ok(sketch)
}

/// Control points of the seam in the plane of x and height, from the left end of the mouth to the
/// right. Where four in a row lie on a line, a cubic B-spline runs straight; round a corner with its
/// neighbours `reach` away on both sides, it leaves the line there.
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
