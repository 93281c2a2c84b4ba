//! Sizes in SVG: lengths with their units, and the view boxes that scale what is drawn.

use super::super::segment::Affine;
use roxmltree::Node;
use sheetwright::math::Vec3;
use svgtypes::{Align, AspectRatio, Length, LengthUnit, ViewBox};

/// A pixel, as CSS defines it: 1/96 inch, mm.
pub(super) const PIXEL_MM: f64 = 25.4 / 96.0;

/// The side of the page that a percentage is of.
#[derive(Clone, Copy)]
pub(super) enum Side {
    Width,
    Height,
    Diagonal,
}

/// The size of the surrounding page in its own units, for percentages.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lengths {
    pub(super) width: f64,
    pub(super) height: f64,
}

impl Lengths {
    /// The length in an attribute in the units of the page; `None` without it, or where it is
    /// `auto`.
    pub(super) fn of(
        &self,
        node: Node<'_, '_>,
        name: &str,
        side: Side,
    ) -> Result<Option<f64>, String> {
        let Some(text) = node.attribute(name).map(str::trim) else { return Ok(None) };
        if text == "auto" || text.is_empty() {
            return Ok(None);
        }
        let length: Length =
            text.parse().map_err(|_| format!("its {name} is '{text}', which is no length"))?;
        Ok(Some(match length.unit {
            LengthUnit::Percent => {
                let whole = match side {
                    Side::Width => self.width,
                    Side::Height => self.height,
                    Side::Diagonal => {
                        (0.5 * (self.width * self.width + self.height * self.height)).sqrt()
                    }
                };
                whole * length.number / 100.0
            }
            _ => length.number * pixels(length.unit),
        }))
    }
}

/// A unit in pixels; of the sizes of letters those of the usual 16 pixels.
fn pixels(unit: LengthUnit) -> f64 {
    match unit {
        LengthUnit::None | LengthUnit::Px | LengthUnit::Percent => 1.0,
        LengthUnit::In => 96.0,
        LengthUnit::Cm => 96.0 / 2.54,
        LengthUnit::Mm => 96.0 / 25.4,
        LengthUnit::Pt => 96.0 / 72.0,
        LengthUnit::Pc => 16.0,
        LengthUnit::Em => 16.0,
        LengthUnit::Ex => 8.0,
    }
}

/// The page of a drawing.
pub(super) struct Page {
    /// From the units inside to millimetres, y upwards from the lower edge.
    pub(super) map: Affine,
    pub(super) lengths: Lengths,
    /// Whether its size is in millimetres, inches or the like.
    pub(super) has_unit: bool,
}

/// The page of the outermost element. With `unit_mm`, its units are of this length, whatever it
/// says of its size.
pub(super) fn page(root: Node<'_, '_>, unit_mm: Option<f64>) -> Result<Page, String> {
    let view = view_box(root)?;
    let none = Lengths { width: 0.0, height: 0.0 };
    // A percentage is one of the window that a program shows it in, which says nothing.
    let is_percent = |name: &str| root.attribute(name).is_some_and(|it| it.trim().ends_with('%'));
    let side = |name: &str, side| match is_percent(name) {
        true => Ok(None),
        false => none.of(root, name, side),
    };
    let (width, height) = (side("width", Side::Width)?, side("height", Side::Height)?);
    let is_physical = |name: &str| {
        let unit = root.attribute(name).and_then(|it| it.trim().parse::<Length>().ok());
        unit.is_some_and(|length| {
            use LengthUnit as U;
            matches!(length.unit, U::In | U::Cm | U::Mm | U::Pt | U::Pc)
        })
    };
    let has_unit = unit_mm.is_some() || is_physical("width") || is_physical("height");
    let inside =
        view.unwrap_or(ViewBox::new(0.0, 0.0, width.unwrap_or(0.0), height.unwrap_or(0.0)));
    let lengths = Lengths { width: inside.w, height: inside.h };
    let ratio = if inside.w > 0.0 { inside.h / inside.w } else { 1.0 };
    let size = match (width, height) {
        (Some(width), Some(height)) => [width, height],
        (Some(width), None) => [width, width * ratio],
        (None, Some(height)) if ratio > 0.0 => [height / ratio, height],
        _ => [inside.w, inside.h],
    };
    let fitted = match (view, unit_mm) {
        (Some(view), None) => fit(root, view, size),
        (Some(view), Some(_)) => Affine::translation(Vec3::new(-view.x, -view.y, 0.0)),
        (None, _) => Affine::IDENTITY,
    };
    let pixel_mm = unit_mm.unwrap_or(PIXEL_MM);
    let tall = if unit_mm.is_some() { inside.h } else { size[1] };
    let upwards = Affine {
        origin: Vec3::new(0.0, tall * pixel_mm, 0.0),
        ..Affine::scale(Vec3::new(pixel_mm, -pixel_mm, 1.0))
    };
    Ok(Page { map: upwards.after(&fitted), lengths, has_unit })
}

/// The view box of an element with a width and a height, if it has one.
pub(super) fn view_box(node: Node<'_, '_>) -> Result<Option<ViewBox>, String> {
    let Some(text) = node.attribute("viewBox") else { return Ok(None) };
    let view: Option<ViewBox> = text.parse().ok();
    let view = view.filter(|view| view.w > 0.0 && view.h > 0.0);
    match view {
        Some(view) => Ok(Some(view)),
        None => Err(format!("its viewBox is '{text}', which is no rectangle")),
    }
}

/// The map that fits a view box into a rectangle at the origin, as `preserveAspectRatio` says.
pub(super) fn fit(node: Node<'_, '_>, view: ViewBox, [width, height]: [f64; 2]) -> Affine {
    let ratio = node.attribute("preserveAspectRatio").and_then(|text| text.parse().ok());
    let ratio = ratio.unwrap_or(AspectRatio { defer: false, align: Align::XMidYMid, slice: false });
    let (mut sx, mut sy) = (width / view.w, height / view.h);
    if ratio.align != Align::None {
        let both = if ratio.slice { sx.max(sy) } else { sx.min(sy) };
        (sx, sy) = (both, both);
    }
    let [x, y] = match ratio.align {
        Align::None | Align::XMinYMin => [0.0, 0.0],
        Align::XMidYMin => [0.5, 0.0],
        Align::XMaxYMin => [1.0, 0.0],
        Align::XMinYMid => [0.0, 0.5],
        Align::XMidYMid => [0.5, 0.5],
        Align::XMaxYMid => [1.0, 0.5],
        Align::XMinYMax => [0.0, 1.0],
        Align::XMidYMax => [0.5, 1.0],
        Align::XMaxYMax => [1.0, 1.0],
    };
    let left = Vec3::new((width - sx * view.w) * x, (height - sy * view.h) * y, 0.0);
    let scaled = Affine::scale(Vec3::new(sx, sy, 1.0));
    let corner = Affine::translation(Vec3::new(-view.x, -view.y, 0.0));
    Affine::translation(left).after(&scaled.after(&corner))
}
