//! What follows from the kind of a finding: its severity, its name and the settings that help.

use super::kind::FindingKind;
use super::remedy::Remedy;
use super::severity::Severity;
use crate::design::{ReadNote, Unused};
use crate::mark::MarkNote;
use crate::trim::TrimNote;
use sheetwright_geometry::tolerance::Tolerance;

impl FindingKind {
    /// Its severity.
    pub fn severity(&self) -> Severity {
        let unless =
            |is_fine: bool, bad: Severity, fine: Severity| if is_fine { fine } else { bad };
        match self {
            Self::StrainTooLarge { .. }
            | Self::RadiusTooSmall { .. }
            | Self::SheetTooThick { .. }
            | Self::SelfCrossing
            | Self::Overlap
            | Self::Flipped { .. }
            | Self::Refold { .. }
            | Self::NotReadBack { .. } => Severity::Error,
            Self::NeedsForce { .. }
            | Self::Roll { .. }
            | Self::CantTell { .. }
            | Self::RadiusUnsure { .. }
            | Self::RungWithoutPlane { .. }
            | Self::NoOtherSurface
            | Self::StrainNotReached { .. }
            | Self::WindowGap { .. }
            | Self::NotTwoSkins
            | Self::NoEffect { .. }
            | Self::PieceTooLarge { .. }
            | Self::Divide { .. }
            | Self::BorderNotTrue { .. }
            | Self::RoundedCorner { .. }
            | Self::UnfairLine { .. }
            | Self::SplineBulge { .. }
            | Self::StayedStraight { .. }
            | Self::WarpNotReached { .. }
            | Self::LinesClose { .. }
            | Self::LinesLong { .. }
            | Self::FlangeShort { .. }
            | Self::FoldsMitred { .. }
            | Self::TooLarge { .. }
            | Self::NoSheet { .. }
            | Self::NotDivided { .. }
            | Self::QuadsNotPlanar { .. } => Severity::Warning,
            Self::BetterWithoutPlane { .. }
            | Self::NotProven { .. }
            | Self::BendLines { .. }
            | Self::FacetsMeant { .. }
            | Self::FacetsFew { .. }
            | Self::FoldsNotNeeded { .. }
            | Self::BendsDivided { .. }
            | Self::DividedInVain { .. }
            | Self::Seams { .. }
            | Self::Stretch { .. }
            | Self::TrianglesLeftOut { .. }
            | Self::PartsLeftOut { .. }
            | Self::Healed { .. }
            | Self::TwoSkins { .. }
            | Self::PointContacts { .. }
            | Self::JointsSmoothed { .. }
            | Self::TurnedRound { .. }
            | Self::Moved { .. }
            | Self::NotMoved { .. }
            | Self::QuadsOffBoundary { .. }
            | Self::Divided { .. }
            | Self::Strap { .. }
            | Self::PdfReduced { .. } => Severity::Note,
            // An open line among closed ones is mostly an outline that should be closed.
            Self::Read { note: ReadNote::NotUsed { what: Unused::Open, .. } } => Severity::Warning,
            Self::Read { .. } => Severity::Note,
            Self::Trimmed { note: TrimNote::NotProved { .. } } => Severity::Error,
            Self::Marked { note: MarkNote::CurvedFrame { .. } } => Severity::Note,
            Self::Trimmed { .. } | Self::Marked { .. } => Severity::Warning,
            Self::TwoSurfaces { is_one_pattern, .. } => {
                unless(*is_one_pattern, Severity::Warning, Severity::Note)
            }
            Self::OffTolerance { is_usual, .. } => {
                unless(*is_usual, Severity::Warning, Severity::Note)
            }
            Self::Points { too_tight, .. } => {
                unless(too_tight.is_none(), Severity::Warning, Severity::Note)
            }
            Self::Folds { stiff, .. } | Self::Creases { stiff, .. } => {
                unless(stiff.is_none(), Severity::Error, Severity::Warning)
            }
            Self::FoldedFacets { stiff, .. } => {
                unless(stiff.is_none(), Severity::Error, Severity::Note)
            }
            // Closing holes changes lengths by less than cutting does, mostly.
            Self::LengthError { largest, closes_holes } => {
                let is_unseen = *closes_holes && *largest <= Tolerance::STRETCH.share();
                unless(is_unseen, Severity::Warning, Severity::Note)
            }
            Self::RanOn { .. } => {
                unless(!self.is_worse_than_straight(), Severity::Warning, Severity::Note)
            }
        }
    }

    /// A name that scripts may rely on.
    pub fn code(&self) -> &'static str {
        match self {
            Self::StrainTooLarge { .. } => "strain-too-large",
            Self::NeedsForce { .. } => "needs-force",
            Self::Roll { .. } => "roll",
            Self::CantTell { .. } | Self::RadiusUnsure { .. } => "cant-tell",
            Self::FoldsNotNeeded { .. } => "fold-not-needed",
            Self::RadiusTooSmall { .. } => "radius-too-small",
            Self::SheetTooThick { .. } => "sheet-too-thick",
            Self::Points { .. } => "point",
            Self::SelfCrossing => "self-crossing",
            Self::Overlap => "overlap",
            Self::RungWithoutPlane { .. } => "rung-without-plane",
            Self::BetterWithoutPlane { .. } => "better-without-plane",
            Self::StrainNotReached { .. } => "strain-not-reached",
            Self::BendsDivided { .. } => "bends-divided",
            Self::DividedInVain { .. } => "divided-in-vain",
            Self::TwoSurfaces { .. } => "two-surfaces",
            Self::NoOtherSurface => "no-other-surface",
            Self::NotProven { .. } => "not-proven",
            Self::Folds { .. } | Self::Creases { .. } => "folds",
            Self::FoldedFacets { .. } => "folds",
            Self::FacetsMeant { .. } | Self::FacetsFew { .. } => "facets",
            Self::NoEffect { .. } => "no-effect",
            Self::PieceTooLarge { .. } => "piece-too-large",
            Self::BendLines { .. } => "bend-lines",
            Self::LengthError { .. } | Self::Stretch { .. } => "length-error",
            Self::WindowGap { .. } => "window-gap",
            Self::Seams { .. } => "seam",
            Self::Divide { .. } => "divide",
            Self::BorderNotTrue { .. } => "border-not-true",
            Self::Flipped { .. } => "flipped",
            Self::TrianglesLeftOut { .. } | Self::PartsLeftOut { .. } => "left-out",
            Self::Healed { .. } => "healed",
            Self::TwoSkins { .. } | Self::NotTwoSkins => "two-skins",
            Self::PointContacts { .. } => "point-contact",
            Self::RoundedCorner { .. } => "rounded-corner",
            Self::UnfairLine { .. } => "unfair-line",
            Self::SplineBulge { .. } => "spline-bulge",
            Self::OffTolerance { .. } => "off-tolerance",
            Self::JointsSmoothed { .. } => "joint-smoothed",
            Self::RanOn { .. } | Self::StayedStraight { .. } => "ran-on",
            Self::TurnedRound { .. } => "turned-round",
            Self::Moved { .. } => "moved",
            Self::NotMoved { .. } => "not-moved",
            Self::WarpNotReached { .. } => "warp-not-reached",
            Self::Refold { .. } | Self::NotReadBack { .. } => "refold",
            Self::QuadsOffBoundary { .. } => "quads-off-boundary",
            Self::QuadsNotPlanar { .. } => "quads-not-planar",
            Self::PdfReduced { .. } => "pdf-reduced",
            Self::TooLarge { .. } => "too-large",
            Self::NoSheet { .. } => "no-sheet",
            Self::Divided { .. } | Self::Strap { .. } => "divided",
            Self::NotDivided { .. } => "not-divided",
            Self::Read { note: ReadNote::NotUsed { .. } } => "not-used",
            Self::Read { .. } => "drawing",
            Self::Trimmed { .. } => "trim",
            Self::Marked { .. } => "mark",
            Self::LinesClose { .. } => "bend-lines-close",
            Self::LinesLong { .. } => "bend-lines-long",
            Self::FlangeShort { .. } => "flange-short",
            Self::FoldsMitred { .. } => "folds-mitred",
        }
    }

    /// Settings that help against it.
    pub fn remedies(&self) -> Vec<Remedy> {
        let listed = |list: &[(bool, Remedy)]| {
            let helps = list.iter().filter(|(helps, _)| *helps);
            helps.map(|(_, remedy)| *remedy).collect()
        };
        match self {
            Self::TwoSurfaces { is_one_pattern, .. } => {
                listed(&[(!is_one_pattern, Remedy::OtherSurface)])
            }
            Self::NotProven { cut_short, .. } => listed(&[(*cut_short, Remedy::Effort)]),
            Self::Divide { cut, has_darts, has_creases, .. } => listed(&[
                (cut.is_some() && !has_darts, Remedy::Darts),
                (*has_creases, Remedy::SplitCreases),
            ]),
            Self::TooLarge { .. } => vec![Remedy::Divide],
            Self::FacetsMeant { .. } => vec![Remedy::NoFacets],
            Self::FacetsFew { .. } => vec![Remedy::Facets],
            Self::NoEffect { is_net: true, .. } => vec![Remedy::NoFacets],
            Self::NoEffect { is_net: false, .. } => vec![Remedy::Facets],
            Self::Creases { stiff, .. } => listed(&[(stiff.is_some(), Remedy::SplitCreases)]),
            Self::TwoSkins { laid: None, .. } => vec![Remedy::OneSkin],
            Self::PdfReduced { sheets, most, is_full, .. } => {
                listed(&[(*sheets <= *most as u64 && !is_full, Remedy::Sheets(*sheets))])
            }
            _ => Vec::new(),
        }
    }

    /// Whether rails that were let run on bend the panel worse than straight ends do: both the
    /// largest warp and the smallest bend radius are worse.
    pub fn is_worse_than_straight(&self) -> bool {
        let Self::RanOn { bends: Some([now, straight]), .. } = self else { return false };
        now.warp > straight.warp && now.radius_mm < straight.radius_mm
    }

    /// Whether it is about how the part bends, so that as an error it keeps it from bending.
    pub(super) fn is_of_bending(&self) -> bool {
        matches!(
            self,
            Self::StrainTooLarge { .. }
                | Self::RadiusTooSmall { .. }
                | Self::SheetTooThick { .. }
                | Self::SelfCrossing
                | Self::Folds { .. }
                | Self::Creases { .. }
                | Self::FoldedFacets { .. }
        )
    }
}
