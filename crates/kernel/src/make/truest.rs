//! The strain of the sheet of a mesh, and the pattern that its sheet follows best.
//!
//! Lengths of sides alone make a pattern whose errors a sheet may feel everywhere, as where it is a
//! little too wide between edges that are held. Where least mean errors are the aim and the sheet
//! would need force, the pattern is fitted to the sheet at rest, again and again while the sheet is
//! strained less. So a surface has one verdict however it was divided into triangles.

use super::MakeCause;
use super::laid::Laid;
use crate::elastic::{Elastic, Predicted, predict_given};
use crate::flatten::{Aim, RelaxError, Relaxed, laid_at};
use crate::material::Material;
use crate::measure::distortion;
use sheetwright_geometry::watch::Watch;

/// The pattern is fitted so often at the most.
const MOST_FITS: usize = 12;

/// The sheet as it was laid, or fitted to its sheet at rest; with the prediction of its strain.
pub(super) fn truest(
    laid: Laid,
    aim: Aim,
    material: Option<&Material>,
    watch: &mut dyn Watch,
) -> Result<(Laid, Predicted), MakeCause> {
    let mut judged = |fits: usize| {
        let Laid { sheet, relaxed, distortion } = &laid;
        let predicted = predict_given(sheet, &relaxed.flat, distortion, material, fits, watch);
        predicted.ok_or(MakeCause::Relax(RelaxError::Stopped))
    };
    let predicted = judged(if aim == Aim::Mean { MOST_FITS } else { 0 })?;
    let points = &laid.relaxed.flat.points;
    let fit = |at_rest: &Elastic| at_rest.fitted(points);
    let Some(points) = predicted.at_rest.as_ref().and_then(fit) else {
        return Ok((laid, predicted));
    };
    let (flat, flipped) = laid_at(laid.sheet.mesh().topology(), &points);
    if flipped > laid.relaxed.flipped || flat.overlap.is_some() {
        // A pattern that folds over is no better to cut.
        let predicted = judged(0)?;
        return Ok((laid, predicted));
    }
    let distortion = distortion(laid.sheet.mesh(), &flat.points);
    let Laid { sheet, relaxed, .. } = laid;
    let relaxed = Relaxed { flat, flipped, ..relaxed };
    Ok((Laid { sheet, relaxed, distortion }, predicted))
}
