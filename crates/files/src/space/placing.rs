//! Where projected points lie in a picture that shows all of them.

use sheetwright::math::Point2;

/// The scale and the place of what a picture shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Placing {
    left: f64,
    high: f64,
    scale: f64,
    shift: f64,
    top: f64,
    /// The height of what it shows with the margins above and below, in units of the picture.
    pub(crate) height: f64,
}

impl Placing {
    /// Projected points in a picture of a width, centred between its margins and no higher than
    /// `most_height`, in units of the picture.
    pub(crate) fn new<'a>(
        projected: impl Iterator<Item = &'a Point2>,
        width: f64,
        margin: f64,
        most_height: f64,
    ) -> Self {
        let start = [[f64::INFINITY, f64::NEG_INFINITY]; 2];
        let [[left, right], [low, high]] = projected.fold(start, |bounds, p| {
            [(bounds[0], p.x), (bounds[1], p.y)]
                .map(|([least, most], x)| [least.min(x), most.max(x)])
        });
        // A plate that is seen edge on still has a scale.
        let (wide, tall) = ((right - left).max(1e-12), (high - low).max(1e-12));
        let scale = ((width - 2.0 * margin) / wide).min(most_height / tall);
        let shift = 0.5 * (width - scale * wide);
        Self { left, high, scale, shift, top: margin, height: 2.0 * margin + scale * tall }
    }

    /// Everything that much further down.
    pub(crate) fn moved(self, down: f64) -> Self {
        Self { top: self.top + down, ..self }
    }

    /// Where a projected point lies.
    pub(crate) fn place(&self, p: Point2) -> Point2 {
        Point2::new(
            self.shift + self.scale * (p.x - self.left),
            self.top + self.scale * (self.high - p.y),
        )
    }

    /// Units of the picture in a millimetre.
    pub(crate) fn scale(&self) -> f64 {
        self.scale
    }

    /// A length in space, mm, from one in the picture.
    pub(crate) fn millimetres(&self, length: f64) -> f64 {
        length / self.scale
    }
}
