//! Progress out, stop in: how a long stage talks with its caller.

/// The stages of the main job, in order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Curves become samples.
    Sample,
    /// Samples become a triangulation.
    Solve,
    /// Samples move within their limits.
    Vary,
    /// The surface is laid flat.
    Flatten,
    /// Quantities are measured and findings made.
    Check,
    /// Parts are laid out on sheets.
    Nest,
}

/// Watches a stage at work, and may stop it.
///
/// The kernel reads no clock: a caller that wants times notes them in [`Watch::begin`].
pub trait Watch {
    /// A stage begins, for the panels of these names: one, or all that move together.
    fn begin(&mut self, _panels: &[&str], _stage: Stage) {}

    /// The share of the current stage that is done: 0 at its beginning, 1 at its end.
    fn progress(&mut self, _done: f64) {}

    /// Whether the stage should end now. Asked often; once true it must stay true.
    fn stop(&self) -> bool {
        false
    }
}

/// No watching: no progress, no stop.
#[derive(Clone, Copy, Debug, Default)]
pub struct Unwatched;

impl Watch for Unwatched {}
