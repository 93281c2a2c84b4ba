//! The answer to the question whether a part bends.

/// Will it bend?
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// It takes its shape by bending alone.
    Bends,
    /// It takes its shape with some force: it must stretch a little.
    BendsWithForce,
    /// It takes its shape when it is rolled or formed, and keeps it.
    Roll,
    /// It takes its shape by bending and by sharp folds along scored lines.
    BendsAndFolds,
    /// The strain is too close to the limit to tell.
    Undecided,
    /// It does not take its shape.
    WillNotBend,
}

impl Verdict {
    /// Every verdict, the best first.
    pub const ALL: [Self; 6] = [
        Self::Bends,
        Self::BendsWithForce,
        Self::Roll,
        Self::BendsAndFolds,
        Self::Undecided,
        Self::WillNotBend,
    ];
}
