//! What may be set against findings: the command shows it as an option, another program as it sets
//! it.

/// Something to set that helps against a finding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Remedy {
    /// More work for the search of a panel with holes: its effort.
    Effort,
    /// Cuts of a mesh from its border to the points where it would have to stretch the most.
    Darts,
    /// Dividing a mesh along its sharp creases.
    SplitCreases,
    /// Another unit of the coordinates of a file that does not say its own.
    Units,
    /// So many sheets of paper for a pattern.
    Sheets(usize),
}
