//! Findings on a panel, and the verdict that follows from them. A finding is a value: programs that
//! show it write its sentence and name its remedies, the command as options.

use super::kind::FindingKind;
use super::place::Place;
use super::remedy::Remedy;
use super::severity::Severity;
use super::verdict::Verdict;

/// A finding: its kind and its place.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// Its kind, with its numbers.
    pub kind: FindingKind,
    /// Its place.
    pub place: Place,
}

impl Finding {
    /// A finding at a place.
    pub fn new(kind: FindingKind, place: Place) -> Self {
        Self { kind, place }
    }

    /// A finding about the whole part.
    pub fn of_whole(kind: FindingKind) -> Self {
        Self::new(kind, Place::Whole)
    }

    /// How bad it is.
    pub fn severity(&self) -> Severity {
        self.kind.severity()
    }

    /// A name that scripts may rely on.
    pub fn code(&self) -> &'static str {
        self.kind.code()
    }

    /// Settings that help against it, beside the advice of its sentence.
    pub fn remedies(&self) -> Vec<Remedy> {
        self.kind.remedies()
    }
}

impl Verdict {
    /// The verdict that follows from findings.
    fn of(findings: &[Finding]) -> Self {
        use FindingKind as Kind;
        let has = |is_it: fn(&Kind) -> bool| findings.iter().any(|f| is_it(&f.kind));
        if has(|kind| kind.is_of_bending() && kind.severity() == Severity::Error) {
            Self::WillNotBend
        } else if has(|kind| matches!(kind, Kind::CantTell { .. } | Kind::RadiusUnsure { .. })) {
            Self::Undecided
        } else if has(|kind| {
            matches!(kind, Kind::Folds { .. } | Kind::Creases { .. } | Kind::FoldedFacets { .. })
        }) {
            Self::BendsAndFolds
        } else if has(|kind| matches!(kind, Kind::Roll { .. })) {
            Self::Roll
        } else if has(|kind| matches!(kind, Kind::NeedsForce { .. })) {
            Self::BendsWithForce
        } else {
            Self::Bends
        }
    }

    /// Its name in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Bends => "bends",
            Self::Roll => "roll",
            Self::BendsAndFolds => "bends-and-folds",
            Self::BendsWithForce => "bends-with-force",
            Self::Undecided => "undecided",
            Self::WillNotBend => "will-not-bend",
        }
    }
}

/// The verdict on a panel, and its findings.
#[derive(Clone, Debug, PartialEq)]
pub struct Checked {
    /// Will it bend?
    pub verdict: Verdict,
    /// The findings, the worst first.
    pub findings: Vec<Finding>,
}

impl Checked {
    /// The verdict that follows from these findings, and the findings, the worst first.
    pub(super) fn of(findings: Vec<Finding>) -> Self {
        let mut checked = Self { verdict: Verdict::of(&findings), findings };
        checked.sort();
        checked
    }

    /// Adds a finding on how the sheet bends, which the verdict follows from, too.
    pub(crate) fn add_of_bending(&mut self, finding: Finding) {
        let mut findings = std::mem::take(&mut self.findings);
        findings.push(finding);
        *self = Self::of(findings);
    }

    /// Adds a finding in its place: the worst first. The verdict stays.
    pub fn add(&mut self, finding: Finding) {
        let severity = finding.severity();
        let place = self.findings.partition_point(|other| other.severity() >= severity);
        self.findings.insert(place, finding);
    }

    /// Puts the worst first; those that are as bad stay in their order.
    pub fn sort(&mut self) {
        self.findings.sort_by_key(|finding| std::cmp::Reverse(finding.severity()));
    }
}
