//! Which tiles of the table may have finite entries, as far as the samples of their rows and
//! columns tell.

use super::near::Band;
use crate::cost::{LANES, Segment, TwistForm};
use crate::triangulate::Terms;
use crate::triangulate::span::Span;

/// So many tiles beside one another are first looked at as one. With 8 or 16 of them the table of
/// *wavy* with 50,000 samples takes 0.91 times as long where folds cost nothing, and 0.97 times
/// else.
const LONG: usize = 16;

/// Which tiles may have finite entries.
pub(super) struct Open<'a> {
    /// Only those with rungs of the band.
    pub(super) band: Option<&'a Band>,
    /// What the samples of the tiles have in common; empty where that tells nothing.
    spans: Vec<Span>,
    /// The least that rungs between [`LONG`] rows of tiles and as many columns can cost, on and
    /// above the diagonal; empty where spans tell nothing.
    of_long: Vec<Vec<f64>>,
    /// Entries above it are infinite; a multiple of the quantum.
    pub(super) bound: f64,
    samples: usize,
}

impl<'a> Open<'a> {
    pub(super) fn new(terms: &Terms<'_>, bound: f64, band: Option<&'a Band>) -> Self {
        let m = terms.prices.len();
        let tells = bound < f64::INFINITY
            && terms.prices.in_order()
            && terms.prices.options().form == TwistForm::Normalised;
        let spans_of = |length: usize| -> Vec<Span> {
            let starts = (0..if tells { m } else { 0 }).step_by(length);
            starts.map(|start| Span::of(terms, start..m.min(start + length))).collect()
        };
        let long = spans_of(LONG * LANES);
        let of_row = |row: usize| long[row..].iter().map(|to| long[row].least(to)).collect();
        let of_long = (0..long.len()).map(of_row).collect();
        Self { band, spans: spans_of(LANES), of_long, bound, samples: m }
    }

    /// Tells every tile open that the band does not close: no spans are known.
    #[cfg(test)]
    pub(super) fn without_spans(self) -> Self {
        Self { spans: vec![], of_long: vec![], ..self }
    }

    /// Whether the tile of these rows and columns has edges of the boundary.
    pub(super) fn has_edges(&self, row: usize, column: usize) -> bool {
        row + 1 >= column || (row, column) == (0, (self.samples - 1) / LANES)
    }

    /// No rung of the tile of these rows and columns costs less, as far as spans tell.
    pub(super) fn least(&self, row: usize, column: usize) -> f64 {
        if self.has_edges(row, column) || self.spans.is_empty() {
            return 0.0;
        }
        let of_long = self.of_long[row / LONG][column / LONG - row / LONG];
        if of_long > self.bound {
            return of_long;
        }
        self.spans[row].least(&self.spans[column])
    }

    /// Whether the tile of these rows and columns may have finite entries.
    pub(super) fn is_open(&self, row: usize, column: usize) -> bool {
        let is_dear = self.least(row, column) > self.bound;
        let run = |at: usize| at * LANES..self.samples.min((at + 1) * LANES);
        let is_near = |band: &Band| band.has(run(row), run(column));
        !is_dear && (self.has_edges(row, column) || self.band.is_none_or(is_near))
    }

    /// Where the samples of a column of tiles lie, if spans tell.
    pub(super) fn segment(&self, column: usize) -> Option<Segment> {
        self.spans.get(column).map(Span::segment)
    }
}
