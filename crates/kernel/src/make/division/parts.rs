//! What the boundaries of parts have in common, however a panel is divided.

use crate::check::CutWay;
use sheetwright_geometry::boundary::OnOutline;
use sheetwright_geometry::curve::Sample;
use sheetwright_geometry::math::{Point3, unit};

/// A panel as it can be divided: by lines at even distances, one way or the other.
pub(super) trait Divisible {
    /// The loops of samples around the `n`-th part from 0, which run as those of the whole, the
    /// outer one first. `None` where that division has no such part.
    fn around(&self, way: CutWay, parts: usize, n: usize) -> Option<Vec<Vec<Sample>>>;

    /// So many places on each line of a division, from end to end, mm.
    fn lines(&self, way: CutWay, parts: usize, count: usize) -> Vec<Vec<Point3>>;

    /// How many samples the first rail of a part has; `None` where parts have no rails.
    fn of_first_rail(&self) -> Option<usize>;
}

/// The samples of a loop of stretches, each of which begins where the one before it ends. The
/// joints are corners.
pub(super) fn chained(stretches: &[Vec<OnOutline>]) -> Vec<Sample> {
    let mut samples = Vec::new();
    for (n, stretch) in stretches.iter().enumerate() {
        let before = &stretches[if n == 0 { stretches.len() } else { n } - 1];
        let (Some(end), Some((first, rest))) = (before.last(), stretch.split_first()) else {
            continue;
        };
        let OnOutline { position, tangent } = *first;
        samples.push(Sample { position, tangent_in: end.tangent, tangent_out: tangent });
        let inner = rest.split_last().map_or(&[][..], |(_, inner)| inner);
        samples.extend(inner.iter().map(|&OnOutline { position, tangent }| Sample {
            position,
            tangent_in: tangent,
            tangent_out: tangent,
        }));
    }
    samples
}

/// A straight stretch from one place to another in so many steps; `None` where both are one place
/// but for rounding.
pub(super) fn straight([from, to]: [Point3; 2], steps: usize) -> Option<Vec<OnOutline>> {
    let tangent = unit(to - from).filter(|_| apart(from, to))?;
    let at = |n: usize| OnOutline { position: from.lerp(to, n as f64 / steps as f64), tangent };
    Some((0..=steps).map(at).collect())
}

/// Whether two places are apart by more than rounding.
fn apart(a: Point3, b: Point3) -> bool {
    a.distance(b) > 1e-9 * a.to_vec().length().max(1.0)
}

/// A place at a share of the way from one number to the other.
pub(super) fn between([from, to]: [f64; 2], share: f64) -> f64 {
    from + (to - from) * share
}
