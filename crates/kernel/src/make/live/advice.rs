//! Where to divide the panels of a design that is edited: looked for once all is settled.

use super::Live;
use crate::check::Finding;
use crate::make::MOST_ADVISED;
use crate::make::division::{Looked, Search, look_on, may_help};
use crate::make::part::Part;
use sheetwright_geometry::watch::{Stage, Watch};

/// What is known of where to divide a panel.
#[derive(Clone, Debug)]
pub(super) enum Advice {
    /// It is looked for, or nobody has asked yet.
    Open(Search),
    /// The finding; `None` where none is looked for.
    Known(Option<Finding>),
}

impl Default for Advice {
    fn default() -> Self {
        Self::Open(Search::default())
    }
}

impl Live {
    /// Looks on for what [`Made::advise`] would add, once all is settled: by a step, which takes an
    /// elastic sheet, a tenth of a second or so. Returns whether there is more to look for, so call
    /// it again and again. If the watcher asks to stop, the next call takes the step again.
    ///
    /// [`Made::advise`]: crate::make::Made::advise
    pub fn advise(&mut self, watch: &mut dyn Watch) -> bool {
        let numbers = self.to_advise.take().unwrap_or_else(|| self.helped());
        let is_open = |n: &&usize| matches!(self.panels[**n].advice, Advice::Open(_));
        let next = numbers.iter().find(is_open).copied();
        self.to_advise = Some(numbers);
        let Some(panel) = next.map(|n| &mut self.panels[n]) else { return false };
        if let (Ok([part]), Advice::Open(search)) = (panel.made.as_deref(), &mut panel.advice) {
            watch.begin(&[&panel.name], Stage::Check);
            let material = self.design.material.as_ref();
            if let Ok(Looked::Over(finding)) = look_on(part, search, material, watch) {
                panel.advice = Advice::Known(finding);
            }
        }
        true
    }

    /// The finding on where to divide a part of this design, as far as [`Self::advise`] has come;
    /// none on pieces of a part that is larger than the sheet.
    pub fn advice_on(&self, part: &Part) -> Option<&Finding> {
        let n = self.panels.iter().position(|panel| panel.name == part.panel)?;
        // A panel that was looked at once may stand behind others now.
        if self.to_advise.as_ref().is_some_and(|numbers| !numbers.contains(&n)) {
            return None;
        }
        let panel = &self.panels[n];
        let Ok([whole]) = panel.made.as_deref() else { return None };
        match &panel.advice {
            Advice::Known(finding) if helps(part, whole) => finding.as_ref(),
            _ => None,
        }
    }

    /// The numbers of the panels for which a division is looked for.
    fn helped(&self) -> Vec<usize> {
        let trimmed = self.trimmed();
        let is_helped = |n: &usize| {
            let panel = &self.panels[*n];
            let (true, Ok([whole])) = (panel.is_settled(), panel.made.as_deref()) else {
                return false;
            };
            match &trimmed {
                None => may_help(whole),
                Some(all) => matches!(all[*n].as_deref(), Ok([part]) if helps(part, whole)),
            }
        };
        (0..self.panels.len()).filter(is_helped).take(MOST_ADVISED).collect()
    }
}

/// Whether dividing may help a part as it was finished: pieces of the whole have other names.
fn helps(part: &Part, whole: &Part) -> bool {
    part.name == whole.name && may_help(part)
}
