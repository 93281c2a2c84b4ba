//! What is found on a panel, and the verdict that it comes to. A finding names what may be set
//! against it as a value: the command shows that as an option, another program as it sets it.

/// How bad a finding is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// Good to know.
    Note,
    /// Look at it before cutting.
    Warning,
    /// Do not cut.
    Error,
}

impl Severity {
    /// How reports name it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Note => "note",
            Self::Warning => "warning",
            Self::Error => "error",
        }
    }
}

/// One thing found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// How bad it is.
    pub severity: Severity,
    /// A name that scripts may rely on.
    pub code: &'static str,
    /// What is so, in words with units, and what to do.
    pub text: String,
    /// Where: `rungs 41–47`, `samples 3 and 12`; empty where it is the whole panel.
    pub place: String,
    /// What may be set against it, beside what its text says.
    pub remedies: Vec<Remedy>,
}

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

/// Will it bend?
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// It takes its shape by bending alone.
    Bends,
    /// It takes its shape by bending and by sharp folds along scored lines.
    BendsAndFolds,
    /// It takes its shape with some force: it must stretch a little.
    BendsWithForce,
    /// The sampling is too coarse to tell bending from twist.
    Undecided,
    /// It does not take its shape.
    WillNotBend,
}

impl Verdict {
    /// Every verdict, the best first.
    pub const ALL: [Self; 5] = [
        Self::Bends,
        Self::BendsAndFolds,
        Self::BendsWithForce,
        Self::Undecided,
        Self::WillNotBend,
    ];

    /// How reports name it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Bends => "bends",
            Self::BendsAndFolds => "bends-and-folds",
            Self::BendsWithForce => "bends-with-force",
            Self::Undecided => "undecided",
            Self::WillNotBend => "will-not-bend",
        }
    }
}

/// The verdict on a panel and what it rests on, the worst first.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Checked {
    /// Will it bend?
    pub verdict: Verdict,
    /// What was found.
    pub findings: Vec<Finding>,
}

impl Checked {
    /// Adds a finding in its place: the worst first.
    pub fn add(&mut self, finding: Finding) {
        let place = self.findings.partition_point(|other| other.severity >= finding.severity);
        self.findings.insert(place, finding);
    }
}
