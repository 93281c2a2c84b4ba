//! The universal cover of a band: places, walks round it, and the grids that are searched.

/// A pair of places on the cover: an outer and an inner one.
pub(super) type Pair = (usize, i64);

/// A set of starts: outer places and inner places on the cover, both ends included.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Starts {
    pub(super) outer: (usize, usize),
    pub(super) inner: (i64, i64),
}

impl Starts {
    pub(super) fn contain(&self, (p, a): Pair) -> bool {
        (self.outer.0..=self.outer.1).contains(&p) && (self.inner.0..=self.inner.1).contains(&a)
    }

    /// Two sets, one with each of two different pairs.
    pub(super) fn halved(self, one: Pair, other: Pair) -> [Self; 2] {
        let mut halves = [self, self];
        if one.1 == other.1 {
            let middle = usize::midpoint(one.0, other.0);
            halves[0].outer.1 = middle;
            halves[1].outer.0 = middle + 1;
        } else {
            let middle = one.1.min(other.1) + (one.1 - other.1).abs() / 2;
            halves[0].inner.1 = middle;
            halves[1].inner.0 = middle + 1;
        }
        halves
    }
}

/// A walk from a start to the image of an end.
pub(super) struct BandWalk {
    pub(super) price: f64,
    /// The pairs from the start to the one before the last step, which jumps over the edge before
    /// o along the chain with m places.
    pub(super) pairs: Vec<Pair>,
    /// Where the last step arrives, less one round.
    pub(super) end: Pair,
    pub(super) m: usize,
    pub(super) k: i64,
}

impl BandWalk {
    pub(super) fn start(&self) -> Pair {
        self.pairs[0]
    }

    pub(super) fn closes(&self) -> bool {
        self.start() == self.end
    }

    /// All pairs, the end included, on the cover.
    pub(super) fn steps(&self) -> impl Iterator<Item = [Pair; 2]> + '_ {
        let last = (self.end.0 + self.m, self.end.1 + self.k);
        let next = self.pairs[1..].iter().copied().chain(std::iter::once(last));
        self.pairs.iter().copied().zip(next).map(|(from, to)| [from, to])
    }

    /// Whether a closed walk uses no rung twice.
    pub(super) fn is_simple(&self) -> bool {
        let count = self.steps().fold(Count::START, |count, [from, to]| {
            count.after(if from.1 == to.1 { Along::Outer } else { Along::Inner })
        });
        count.is_simple()
    }
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Along {
    Outer,
    Inner,
}

/// The steps of a walk along both chains, up to three, and its turns from one to the other, up to
/// four or five. A walk begins after a step along the outer chain, its last.
#[derive(Clone, Copy)]
pub(super) struct Count {
    pub(super) outer: usize,
    pub(super) inner: usize,
    pub(super) turns: usize,
}

impl Count {
    pub(super) const START: Self = Self { outer: 0, inner: 0, turns: 0 };
    pub(super) const ALL: usize = 4 * 4 * 6;

    pub(super) fn after(self, along: Along) -> Self {
        let last = if self.turns.is_multiple_of(2) { Along::Outer } else { Along::Inner };
        let turns = match self.turns + usize::from(along != last) {
            6 => 4,
            turns => turns,
        };
        match along {
            Along::Outer => Self { outer: (self.outer + 1).min(3), turns, ..self },
            Along::Inner => Self { inner: (self.inner + 1).min(3), turns, ..self },
        }
    }

    pub(super) fn is_simple(self) -> bool {
        self.outer == 3 && self.inner == 3 && self.turns >= 4
    }

    pub(super) fn number(self) -> usize {
        (self.outer * 4 + self.inner) * 6 + self.turns
    }

    pub(super) fn of_number(number: usize) -> Self {
        Self { outer: number / 24, inner: number / 6 % 4, turns: number % 6 }
    }
}

/// The counts from which one step leads to a count, with the chain that the step runs along.
pub(super) fn before(count: Count) -> impl Iterator<Item = (usize, Along)> {
    (0..Count::ALL).flat_map(move |number| {
        let from = Count::of_number(number);
        [Along::Outer, Along::Inner]
            .into_iter()
            .filter(move |&along| from.after(along).number() == count.number())
            .map(move |along| (number, along))
    })
}

/// The part of the cover that paths from some starts pass.
pub(super) struct Grid {
    pub(super) first: Pair,
    pub(super) columns: usize,
    pub(super) rows: usize,
}

impl Grid {
    pub(super) fn new(starts: &Starts, m: usize, k: i64) -> Self {
        Self {
            first: (starts.outer.0, starts.inner.0),
            columns: m - starts.outer.0,
            rows: (starts.inner.1 - starts.inner.0 + k + 1) as usize,
        }
    }

    pub(super) fn pair(&self, c: usize, r: usize) -> Pair {
        (self.first.0 + c, self.first.1 + r as i64)
    }

    pub(super) fn row_of(&self, a: i64) -> usize {
        (a - self.first.1) as usize
    }

    pub(super) fn cells(&self) -> usize {
        self.columns * self.rows
    }

    pub(super) fn cell(&self, (c, r): (usize, usize)) -> usize {
        c * self.rows + r
    }
}

/// The least price of a path to each pair, by rows and by columns.
pub(super) struct Least {
    pub(super) rows: Vec<f64>,
    pub(super) columns: Vec<f64>,
}

impl Least {
    pub(super) fn new(grid: &Grid) -> Self {
        Self { rows: vec![f64::INFINITY; grid.cells()], columns: vec![f64::INFINITY; grid.cells()] }
    }

    pub(super) fn set(&mut self, grid: &Grid, (c, r): (usize, usize), price: f64) {
        self.rows[r * grid.columns + c] = price;
        self.columns[c * grid.rows + r] = price;
    }

    pub(super) fn at(&self, grid: &Grid, (c, r): (usize, usize)) -> f64 {
        self.columns[c * grid.rows + r]
    }

    pub(super) fn row(&self, grid: &Grid, r: usize) -> &[f64] {
        &self.rows[r * grid.columns..][..grid.columns]
    }

    pub(super) fn column(&self, grid: &Grid, c: usize) -> &[f64] {
        &self.columns[c * grid.rows..][..grid.rows]
    }
}
