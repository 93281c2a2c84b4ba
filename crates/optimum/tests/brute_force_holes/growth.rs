//! All triangulations of a domain with holes, grown side by side.
//!
//! An uncovered side is picked, every third corner is tried, and a partial triangulation that can't
//! be completed is given up. So every triangulation is found exactly once.

use std::collections::BTreeSet;

/// The numbers of its samples, counter-clockwise.
pub(crate) type Triangle = [usize; 3];

/// The prices of triangles, with half the price of each of their rungs: every rung has two.
pub(crate) struct Costs {
    m: usize,
    /// Infinite for a triangle that may not be used.
    of_triangles: Vec<f64>,
    /// The least third of the cost of a triangle that lies to the left of a side.
    least_thirds: Vec<f64>,
}

impl Costs {
    pub(crate) fn new(m: usize, cost: impl Fn(Triangle) -> f64) -> Self {
        let mut of_triangles = vec![f64::INFINITY; m * m * m];
        let mut least_thirds = vec![f64::INFINITY; m * m];
        for a in 0..m {
            for b in 0..m {
                for c in 0..m {
                    if a != b && b != c && c != a {
                        let cost = cost([a, b, c]);
                        of_triangles[(a * m + b) * m + c] = cost;
                        least_thirds[a * m + b] = least_thirds[a * m + b].min(cost / 3.0);
                    }
                }
            }
        }
        Self { m, of_triangles, least_thirds }
    }

    pub(crate) fn of(&self, [a, b, c]: Triangle) -> f64 {
        self.of_triangles[(a * self.m + b) * self.m + c]
    }
}

/// The state of a side, from one sample to another, in a growing triangulation.
#[derive(Clone, Copy, PartialEq)]
enum State {
    /// Not a side yet, in either direction.
    Free,
    /// A triangle must lie to its left, and none does yet.
    Open,
    /// No further triangle may lie to its left.
    Done,
}

/// The triangulations of loops of given sizes, as they grow.
pub(crate) struct Growth<'a> {
    after: Vec<usize>,
    before: Vec<usize>,
    holes: usize,
    sides: Vec<Vec<State>>,
    /// on[v][x]: the corner that follows x round v, in the triangle v, x, on[v][x]; back[v] is the
    /// inverse of on[v].
    on: Vec<Vec<Option<usize>>>,
    back: Vec<Vec<Option<usize>>>,
    of_sample: Vec<usize>,
    triangles: Vec<Triangle>,
    price: f64,
    costs: &'a Costs,
}

impl<'a> Growth<'a> {
    pub(crate) fn new(sizes: &[usize], costs: &'a Costs) -> Self {
        let m: usize = sizes.iter().sum();
        let (mut after, mut before) = (vec![0; m], vec![0; m]);
        let mut sides = vec![vec![State::Free; m]; m];
        let mut start = 0;
        for &size in sizes {
            for i in 0..size {
                let (a, b) = (start + i, start + (i + 1) % size);
                (after[a], before[b]) = (b, a);
                (sides[a][b], sides[b][a]) = (State::Open, State::Done);
            }
            start += size;
        }
        Self {
            after,
            before,
            holes: sizes.len() - 1,
            sides,
            on: vec![vec![None; m]; m],
            back: vec![vec![None; m]; m],
            of_sample: vec![0; m],
            triangles: Vec::new(),
            price: 0.0,
            costs,
        }
    }

    fn triangles_wanted(&self) -> usize {
        self.after.len() + 2 * self.holes - 2
    }

    /// The open side with the fewest triangles to choose from, and those triangles' third corners;
    /// `None` if no side is open.
    fn next_side(&self) -> Option<(usize, usize, Vec<usize>)> {
        let m = self.after.len();
        let mut best: Option<(usize, usize, Vec<usize>)> = None;
        for a in 0..m {
            for b in 0..m {
                if self.sides[a][b] != State::Open {
                    continue;
                }
                let corners: Vec<usize> = (0..m).filter(|&c| self.fits(a, b, c)).collect();
                if best.as_ref().is_none_or(|(_, _, least)| corners.len() < least.len()) {
                    let forced = corners.len() < 2;
                    best = Some((a, b, corners));
                    if forced {
                        return best;
                    }
                }
            }
        }
        best
    }

    fn fits(&self, a: usize, b: usize, c: usize) -> bool {
        c != a
            && c != b
            && self.sides[b][c] != State::Done
            && self.sides[c][a] != State::Done
            && self.costs.of([a, b, c]).is_finite()
            && self.link_stays_a_path(a, b, c)
            && self.link_stays_a_path(b, c, a)
            && self.link_stays_a_path(c, a, b)
    }

    /// Whether the corners round `v` may come to be one path when `y` follows `x`.
    fn link_stays_a_path(&self, v: usize, x: usize, y: usize) -> bool {
        // On from y: back to x would be a ring of triangles round v.
        let mut end = y;
        let mut steps = 1;
        while let Some(next) = self.on[v][end] {
            (end, steps) = (next, steps + 1);
        }
        if end == x {
            return false;
        }
        // Back from x: a path from the next sample of the loop to the previous one is all there is.
        let mut start = x;
        while let Some(earlier) = self.back[v][start] {
            (start, steps) = (earlier, steps + 1);
        }
        !(start == self.after[v] && end == self.before[v]) || steps == self.of_sample[v] + 1
    }

    /// Lower bound on the price that all triangulations grown from here add: a triangle lies at
    /// three open sides at the most.
    fn least_to_come(&self) -> f64 {
        let m = self.costs.m;
        let open = |&side: &usize| self.sides[side / m][side % m] == State::Open;
        let thirds: f64 = (0..m * m).filter(open).map(|side| self.costs.least_thirds[side]).sum();
        // Thirds are rounded; prices are not.
        thirds * (1.0 - 1e-9)
    }

    /// Calls `found` with every triangulation, and its price, that is cheaper than `bound`, which
    /// `found` may lower.
    pub(crate) fn grow(
        &mut self,
        bound: &mut f64,
        found: &mut dyn FnMut(&[Triangle], f64, &mut f64),
    ) {
        if self.price + self.least_to_come() >= *bound {
            return;
        }
        let Some((a, b, corners)) = self.next_side() else {
            if self.triangles.len() == self.triangles_wanted() && self.is_connected() {
                found(&self.triangles, self.price, bound);
            }
            return;
        };
        if self.triangles.len() == self.triangles_wanted() {
            return;
        }
        for c in corners {
            let price = self.price;
            let sides = [(a, b), (b, c), (c, a)];
            let states = sides.map(|(x, y)| (self.sides[x][y], self.sides[y][x]));
            for (x, y) in sides {
                if self.sides[x][y] == State::Free {
                    self.sides[y][x] = State::Open;
                }
                self.sides[x][y] = State::Done;
            }
            for (v, x, y) in [(a, b, c), (b, c, a), (c, a, b)] {
                (self.on[v][x], self.back[v][y]) = (Some(y), Some(x));
                self.of_sample[v] += 1;
            }
            self.triangles.push([a, b, c]);
            self.price += self.costs.of([a, b, c]);
            self.grow(bound, found);
            self.price = price;
            self.triangles.pop();
            for (v, x, y) in [(a, b, c), (b, c, a), (c, a, b)] {
                (self.on[v][x], self.back[v][y]) = (None, None);
                self.of_sample[v] -= 1;
            }
            for ((x, y), (there, back)) in sides.into_iter().zip(states) {
                (self.sides[x][y], self.sides[y][x]) = (there, back);
            }
        }
    }

    fn is_connected(&self) -> bool {
        let mut reached = BTreeSet::from([0]);
        loop {
            let before = reached.len();
            for t in &self.triangles {
                if t.iter().any(|v| reached.contains(v)) {
                    reached.extend(t);
                }
            }
            if reached.len() == before {
                return before == self.after.len();
            }
        }
    }
}

/// All triangulations of loops of these sizes, without a plane.
pub(crate) fn all_triangulations(sizes: &[usize]) -> Vec<Vec<Triangle>> {
    let free = Costs::new(sizes.iter().sum(), |_| 0.0);
    let mut all = Vec::new();
    Growth::new(sizes, &free).grow(&mut { f64::INFINITY }, &mut |triangles, _, _| {
        all.push(triangles.to_vec());
    });
    all
}
