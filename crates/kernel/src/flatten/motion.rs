//! Motions of the plane that lay one figure on another.

use sheetwright_geometry::math::{Point2, Vec2};

/// A turn and a shift of the plane.
#[derive(Clone, Copy)]
pub(crate) struct Motion {
    from: Point2,
    to: Point2,
    turn: Vec2,
}

impl Motion {
    /// The motion that lays some points on others, one on one, as near as can be: the sum of the
    /// squared distances is the least. One point alone, or none, is not turned.
    pub(crate) fn laying(pairs: &[[Point2; 2]]) -> Self {
        let middle = |n: usize| {
            let sum: Vec2 = pairs.iter().map(|pair| pair[n] - pairs[0][n]).sum();
            pairs.first().map_or(Point2::default(), |pair| pair[n] + sum / pairs.len() as f64)
        };
        let [from, to] = [middle(0), middle(1)];
        let turn = |&[p, q]: &[Point2; 2]| {
            let (u, v) = (p - from, q - to);
            Vec2::new(u.dot(v), u.perp_dot(v))
        };
        let turn: Vec2 = pairs.iter().map(turn).sum();
        let length = turn.length();
        let turn = if length > 0.0 { turn / length } else { Vec2::X };
        Self { from, to, turn }
    }

    /// Where a point comes to lie.
    pub(crate) fn moved(&self, p: Point2) -> Point2 {
        self.to + self.turn.rotate(p - self.from)
    }
}
