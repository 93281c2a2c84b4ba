//! Settings that help against findings. Each program names them in its own way, the command as
//! options.

/// A setting that helps against a finding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Remedy {
    /// A greater effort: more work for the search in a panel with holes.
    Effort,
    /// The other of two surfaces that fit a boundary about as well.
    OtherSurface,
    /// Cuts of a mesh from its border to the points that would stretch most.
    Darts,
    /// Dividing a mesh along its sharp creases.
    SplitCreases,
    /// Laying one of two skins flat alone.
    OneSkin,
    /// Folding a mesh between its facets.
    Facets,
    /// Laying a mesh flat as a smooth surface, not folding it between its facets.
    NoFacets,
    /// Another unit of the coordinates, for a file that does not state its own.
    Units,
    /// Dividing parts that are larger than the sheet.
    Divide,
    /// A larger number of sheets of paper for a pattern: this one.
    Sheets(u64),
}
