//! What is measured on sheets, as the pattern and space colour and mark it.

use crate::engine::shown::{Shown, ShownRung, ShownStrain};
use crate::scene::Scene;
use crate::theme::Theme;
use crate::views::SurfaceView;
use eframe::egui::Color32;
use sheetwright::math::{Vec3, unit};
use sheetwright::pattern::{PathKind, Role};
use std::collections::{BTreeMap, BTreeSet};

/// Length errors below it are rounding: the pattern is exact.
pub(crate) const EXACT: f64 = 1e-9;

/// Less than what is shown as 0.1°, degrees.
pub(crate) const NO_TWIST: f64 = 0.05;

/// What colours a sheet, and the largest of it on the scale.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Quantity {
    /// The warp angle along rungs, degrees.
    Warp(f64),
    /// The relative length error along sides.
    LengthError(f64),
    /// The strain in the plane of the sheet at rest, as a share; more is shown as the largest.
    Strain(f64),
}

impl Quantity {
    /// What a view colours by, with a scale for all panels alike.
    pub(crate) fn of<'a>(
        view: SurfaceView,
        panels: impl Iterator<Item = &'a Shown>,
    ) -> Option<Self> {
        let most = |of: fn(&Shown) -> f64| panels.map(of).fold(0.0, f64::max);
        match view {
            SurfaceView::Warp => {
                Some(Self::Warp(most(|shown| shown.warp_limit_deg.max(twist_max(shown)))))
            }
            SurfaceView::LengthError => Some(Self::LengthError(most(|s| s.length_error_max))),
            SurfaceView::Strain => Some(Self::Strain(most(strain_top))),
            _ => None,
        }
    }

    /// Where a value is on the scale, 0 ..= 1.
    pub(crate) fn share(self, value: f64) -> f64 {
        let most = match self {
            Self::Warp(most) | Self::Strain(most) => most,
            Self::LengthError(most) if most < EXACT => return 0.0,
            Self::LengthError(most) => most,
        };
        if most > 0.0 { (value / most).clamp(0.0, 1.0) } else { 0.0 }
    }
}

/// The strain that decides of a panel, or its limit where that is larger; 0 where it is unknown.
fn strain_top(shown: &Shown) -> f64 {
    shown.strain.as_ref().map_or(0.0, |strain| strain.decides.max(strain.limit))
}

/// The triangles of the sheet at rest, if that is what colours the panel, each with its place on
/// the scale.
pub(crate) fn strained(
    shown: &Shown,
    by: Option<Quantity>,
) -> Option<(&ShownStrain, impl Iterator<Item = ([u32; 3], f64)>)> {
    let (Some(quantity @ Quantity::Strain(_)), Some(strain)) = (by, &shown.strain) else {
        return None;
    };
    let shares = strain.strains.iter().map(move |&value| quantity.share(value));
    Some((strain, strain.triangles.iter().copied().zip(shares)))
}

/// How much of a colour shows where the sampling may explain it: the sheet's own shines through.
/// The shader has it too.
pub(crate) const PALE: f32 = 0.35;

/// Added to a value that the sampling may explain.
pub(crate) const UNSURE: f32 = 2.0;

/// The warp angle of a rung, degrees; 0 if the sampling may explain it.
pub(crate) fn twist(rung: &ShownRung) -> f64 {
    if rung.is_unsure { 0.0 } else { rung.warp_deg }
}

/// The largest twist of a panel, degrees.
pub(crate) fn twist_max(shown: &Shown) -> f64 {
    shown.rungs.iter().map(twist).fold(0.0, f64::max)
}

/// The largest warp angle of a panel that the sampling may explain, degrees; 0 if there is none
/// worth saying.
pub(crate) fn unsure_max(shown: &Shown) -> f64 {
    let unsure = shown.rungs.iter().filter(|rung| is_pale(rung));
    unsure.map(|rung| rung.warp_deg).fold(0.0, f64::max)
}

/// Whether a rung seems to twist, and the sampling may explain it.
fn is_pale(rung: &ShownRung) -> bool {
    rung.is_unsure && rung.warp_deg > NO_TWIST
}

/// The rung that twists most, by its number; `None` if none does that the sampling does not
/// explain.
pub(crate) fn worst(shown: &Shown) -> Option<usize> {
    let all = 0..shown.rungs.len();
    let worst = all.max_by(|&a, &b| twist(&shown.rungs[a]).total_cmp(&twist(&shown.rungs[b])));
    worst.filter(|&n| twist(&shown.rungs[n]) > NO_TWIST)
}

/// The panel and the rung that twist most of all.
pub(crate) fn worst_of_all(scene: &Scene<'_>) -> Option<(usize, usize)> {
    let of = |(n, shown): (usize, &Shown)| {
        let rung = worst(shown)?;
        Some((twist(&shown.rungs[rung]), (n, rung)))
    };
    let worst = scene.made().filter_map(of).max_by(|a, b| a.0.total_cmp(&b.0));
    worst.map(|(_, found)| found)
}

/// Two numbers in order, to find a side by.
pub(crate) fn sorted([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

/// The three sides of a triangle.
pub(crate) fn sides([a, b, c]: [u32; 3]) -> [[u32; 2]; 3] {
    [[a, b], [b, c], [c, a]]
}

/// The rungs of a panel, by their ends in order.
pub(crate) fn rungs_by_ends(shown: &Shown) -> BTreeMap<[u32; 2], usize> {
    shown.rungs.iter().enumerate().map(|(n, rung)| (sorted(rung.ends), n)).collect()
}

/// The value of a quantity along each side of each triangle, 0 ..= 1; more by [`UNSURE`] where the
/// sampling may explain it, and negative where there is none.
pub(crate) fn values(shown: &Shown, by: Option<Quantity>) -> Vec<[f32; 3]> {
    let none = [-1.0; 3];
    match by {
        // Strain has triangles of its own.
        None | Some(Quantity::Strain(_)) => vec![none; shown.triangles.len()],
        Some(quantity @ Quantity::Warp(_)) => {
            let rungs = rungs_by_ends(shown);
            let of_rung = |rung: &ShownRung| match is_pale(rung) {
                true => UNSURE + quantity.share(rung.warp_deg) as f32,
                false => quantity.share(twist(rung)) as f32,
            };
            let of = |side| rungs.get(&sorted(side)).map_or(-1.0, |&n| of_rung(&shown.rungs[n]));
            shown.triangles.iter().map(|&t| sides(t).map(of)).collect()
        }
        Some(quantity @ Quantity::LengthError(_)) => {
            let errors: BTreeMap<[u32; 2], f64> =
                shown.sides.iter().map(|&(ends, error)| (sorted(ends), error)).collect();
            let of = |side| match errors.get(&sorted(side)) {
                Some(&error) => quantity.share(error) as f32,
                None => -1.0,
            };
            shown.flat_triangles.iter().map(|&t| sides(t).map(of)).collect()
        }
    }
}

/// Whether each rung is a fold, which the pattern scores.
pub(super) fn folds(shown: &Shown) -> Vec<bool> {
    let scored: BTreeSet<[u32; 2]> = shown
        .piece
        .paths
        .iter()
        .filter(|path| path.role == Role::Score)
        .filter_map(|path| match path.kind {
            PathKind::Rung(rung) => Some(sorted(rung.ends().map(|end| end.get() as u32))),
            _ => None,
        })
        .collect();
    shown.rungs.iter().map(|rung| scored.contains(&sorted(rung.flat_ends))).collect()
}

/// The normal of every triangle; zero where it has none.
pub(crate) fn triangle_normals(shown: &Shown) -> Vec<Vec3> {
    let at = |n: u32| shown.positions.get(n as usize).copied().unwrap_or_default();
    let normal = |t: &[u32; 3]| {
        let [a, b, c] = t.map(at);
        unit((b - a).cross(c - a)).unwrap_or(Vec3::ZERO)
    };
    shown.triangles.iter().map(normal).collect()
}

/// The colour of the worst rung: that of a no beyond what the sheet takes.
pub(crate) fn worst_colour(shown: &Shown, rung: usize, theme: &Theme) -> Color32 {
    let beyond = shown.rungs.get(rung).is_some_and(|r| r.warp_deg > shown.warp_limit_deg);
    if beyond { theme.verdicts[2] } else { theme.ink }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::tests::saddles;
    use sheetwright::make::make;
    use sheetwright::watch::Unwatched;

    #[test]
    fn what_the_sampling_may_explain_has_values_of_its_own() {
        let made = make(&saddles(1, 24, 40.0), &mut Unwatched).unwrap();
        let mut shown = Shown::new(&made.parts[0], None);
        for (n, rung) in shown.rungs.iter_mut().enumerate() {
            (rung.warp_deg, rung.is_unsure) = (2.0, n % 2 == 0);
        }
        let by = Quantity::Warp(4.0);
        let values = values(&shown, Some(by));
        let rungs = rungs_by_ends(&shown);
        for (triangle, values) in shown.triangles.iter().zip(values) {
            for (side, value) in sides(*triangle).into_iter().zip(values) {
                let wanted = match rungs.get(&sorted(side)) {
                    None => -1.0,
                    Some(n) if n % 2 == 0 => UNSURE + 0.5,
                    Some(_) => 0.5,
                };
                assert_eq!(value, wanted);
            }
        }
        assert_eq!((twist_max(&shown), unsure_max(&shown)), (2.0, 2.0));
    }
}
