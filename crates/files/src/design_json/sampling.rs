//! How finely a panel is sampled: the fields `samples` and `tolerance`.

use super::source::Source;
use crate::reading::{InputError, TOLERANCES, is_tolerance};
use crate::units::Units;
use sheetwright::boundary::MAX_SAMPLES;
use sheetwright::design::DesignPanel;

/// Both fields as they stand in a panel.
pub(super) struct Sampling {
    pub(super) samples: Option<u64>,
    pub(super) tolerance: Option<f64>,
}

impl Sampling {
    /// The panel with a number of samples or a tolerance: that of the caller, that of the panel,
    /// then the tolerance of the design, mm. A number comes before a tolerance.
    pub(super) fn of(
        &self,
        panel: DesignPanel,
        of_design_mm: Option<f64>,
        units: Units,
        path: &str,
        source: &Source<'_>,
    ) -> Result<DesignPanel, InputError> {
        let number = self.samples.map(|written| number(written, path, source)).transpose()?;
        let tolerance_path = format!("{path}.tolerance");
        let own = self.tolerance.map(|it| tolerance_mm(it, units, &tolerance_path, source));
        let own = own.transpose()?.or(of_design_mm);
        let options = source.options;
        Ok(match (options.samples, options.tolerance_mm, number, own) {
            (Some(samples), ..) | (None, None, Some(samples), _) => {
                DesignPanel { samples, tolerance: None, ..panel }
            }
            (None, Some(mm), ..) | (None, None, None, Some(mm)) => panel.within_mm(mm),
            (None, None, None, None) => panel,
        })
    }
}

fn number(written: u64, path: &str, source: &Source<'_>) -> Result<usize, InputError> {
    let within = usize::try_from(written).ok().filter(|&n| n <= MAX_SAMPLES);
    within.ok_or_else(|| {
        let message = format!("the number of samples is {written}");
        let hint = format!("The limit is {MAX_SAMPLES}; a few hundred are enough for most panels.");
        source.error(&format!("{path}.samples"), message, hint)
    })
}

/// A tolerance that stands at `path`, mm.
pub(super) fn tolerance_mm(
    written: f64,
    units: Units,
    path: &str,
    source: &Source<'_>,
) -> Result<f64, InputError> {
    let mm = written * units.in_mm();
    if is_tolerance(mm) {
        return Ok(mm);
    }
    Err(source.error(path, format!("the tolerance is {written}"), TOLERANCES))
}
