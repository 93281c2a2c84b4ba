//! Sparse systems of linear equations: the only file that names the sparse-algebra crate.
//!
//! A symmetric positive definite matrix of B × B blocks, one row of blocks a node, is factored into
//! L·Lᵀ (Cholesky) and solved, in three separate steps: [`elimination_order`] by approximate
//! minimum degree \[Amestoy1996\], once a graph; [`Plan`], the places of the entries of L, once a
//! graph and block size; [`Matrix::factor`], the numbers.
//!
//! Of the crate `faer` only the orders and places of a simplicial factor and its triangular
//! solutions are used, which are scalar. The numbers of the factor are computed here (`factor`):
//! plain products, differences, quotients and square roots, in an order that the graph alone
//! decides, so that the bits are the same on every platform. The crate's supernodal factorisation
//! multiplies dense blocks in vector registers of the processor's width, with fused multiply-adds
//! where there are any, which changes bits.

mod factor;

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::SymbolicSparseColMatRef;
use faer::sparse::linalg::amd;
use faer::sparse::linalg::cholesky::simplicial;
use faer::{Conj, Mat, Par};

/// A matrix that is too large for the memory, or for numbers of 32 bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TooLarge;

/// An order of the nodes of a graph in which elimination makes few new entries.
///
/// # Errors
/// [`TooLarge`].
///
/// # Panics
/// If a pair joins a node with itself, or names one that is not below `nodes`.
pub fn elimination_order(nodes: usize, pairs: &[[usize; 2]]) -> Result<Vec<usize>, TooLarge> {
    let identity: Vec<usize> = (0..nodes).collect();
    let graph = Columns::new(&identity, pairs, 1)?;
    let entries = graph.rows.len();
    let (mut order, mut place) = (vec![0u32; nodes], vec![0u32; nodes]);
    let mut memory = memory(amd::order_maybe_unsorted_scratch::<u32>(nodes, entries))?;
    amd::order_maybe_unsorted(
        &mut order,
        &mut place,
        graph.symbolic(),
        amd::Control::default(),
        MemStack::new(&mut memory),
    )
    .map_err(|_| TooLarge)?;
    Ok(order.into_iter().map(|node| node as usize).collect())
}

/// The upper triangle of a matrix of B × B blocks, column after column, in the order of
/// elimination.
struct Columns {
    size: usize,
    starts: Vec<u32>,
    rows: Vec<u32>,
    /// How many blocks lie above the diagonal in each column of blocks.
    above: Vec<u32>,
    /// The column of blocks of each pair, which block of it is the pair's, and whether that column
    /// is of the pair's first node.
    pairs: Vec<(u32, u32, bool)>,
}

impl Columns {
    fn new(place: &[usize], pairs: &[[usize; 2]], block: usize) -> Result<Self, TooLarge> {
        let nodes = place.len();
        // The entries of the upper triangle with those on the diagonal, at most.
        let entries = (nodes + pairs.len()) * block * block;
        if entries > i32::MAX as usize || nodes * block >= i32::MAX as usize {
            return Err(TooLarge);
        }
        // Pairs by their later place, then by the earlier one.
        let mut sorted: Vec<(u32, u32, u32)> = pairs
            .iter()
            .enumerate()
            .map(|(n, &[a, b])| {
                assert!(a != b, "a pair of two nodes");
                let (row, column) = (place[a].min(place[b]), place[a].max(place[b]));
                (column as u32, row as u32, n as u32)
            })
            .collect();
        sorted.sort_unstable();
        let mut above = vec![0u32; nodes];
        let mut of_pairs = vec![(0, 0, false); pairs.len()];
        let mut starts = Vec::with_capacity(nodes * block + 1);
        let mut rows = Vec::with_capacity(entries);
        starts.push(0);
        let mut at = 0;
        for column in 0..nodes {
            let from = at;
            while at < sorted.len() && sorted[at].0 as usize == column {
                let pair = sorted[at].2 as usize;
                let is_first = place[pairs[pair][0]] == column;
                of_pairs[pair] = (column as u32, (at - from) as u32, is_first);
                at += 1;
            }
            above[column] = (at - from) as u32;
            for within in 0..block {
                for &(_, row, _) in &sorted[from..at] {
                    rows.extend((0..block).map(|r| row * block as u32 + r as u32));
                }
                rows.extend((0..=within).map(|r| (column * block + r) as u32));
                starts.push(rows.len() as u32);
            }
        }
        Ok(Self { size: nodes * block, starts, rows, above, pairs: of_pairs })
    }

    fn symbolic(&self) -> SymbolicSparseColMatRef<'_, u32> {
        SymbolicSparseColMatRef::new_unsorted_checked(
            self.size,
            self.size,
            &self.starts,
            None,
            &self.rows,
        )
    }
}

fn memory(needed: faer::dyn_stack::StackReq) -> Result<MemBuffer, TooLarge> {
    MemBuffer::try_new(needed).map_err(|_| TooLarge)
}

/// Where the entries of a matrix of B × B blocks and of its factor lie.
pub struct Plan<const B: usize> {
    place: Vec<usize>,
    columns: Columns,
    symbolic: simplicial::SymbolicSimplicialCholesky<u32>,
}

impl<const B: usize> Plan<B> {
    /// The plan for matrices over some nodes, in this order of elimination, whose blocks off the
    /// diagonal belong to pairs of different nodes, each pair once.
    ///
    /// # Errors
    /// [`TooLarge`].
    ///
    /// # Panics
    /// Unless `order` has every node once, and pairs are of two of them.
    pub fn new(order: &[usize], pairs: &[[usize; 2]]) -> Result<Self, TooLarge> {
        let mut place = vec![usize::MAX; order.len()];
        for (n, &node) in order.iter().enumerate() {
            place[node] = n;
        }
        let columns = Columns::new(&place, pairs, B)?;
        let n = columns.size;
        let (mut tree, mut counts) = (vec![0i32; n], vec![0u32; n]);
        let mut memory = memory(
            simplicial::prefactorize_symbolic_cholesky_scratch::<u32>(n, columns.rows.len())
                .or(simplicial::factorize_simplicial_symbolic_cholesky_scratch::<u32>(n)),
        )?;
        let tree = simplicial::prefactorize_symbolic_cholesky(
            &mut tree,
            &mut counts,
            columns.symbolic(),
            MemStack::new(&mut memory),
        );
        // The starts of columns of the factor must fit 32 bits.
        if counts.iter().map(|&count| u64::from(count)).sum::<u64>() > i32::MAX as u64 {
            return Err(TooLarge);
        }
        let symbolic = simplicial::factorize_simplicial_symbolic_cholesky(
            columns.symbolic(),
            tree,
            &counts,
            MemStack::new(&mut memory),
        )
        .map_err(|_| TooLarge)?;
        Ok(Self { place, columns, symbolic })
    }

    /// The matrix of this plan that is zero.
    pub fn zero(&self) -> Matrix<'_, B> {
        Matrix { plan: self, values: vec![0.0; self.columns.rows.len()] }
    }
}

/// A symmetric matrix.
pub struct Matrix<'a, const B: usize> {
    plan: &'a Plan<B>,
    values: Vec<f64>,
}

impl<'a, const B: usize> Matrix<'a, B> {
    /// Adds a symmetric block to that of a node with itself.
    pub fn add_diagonal(&mut self, node: usize, block: [[f64; B]; B]) {
        let column = self.plan.place[node];
        self.add(column, self.plan.columns.above[column] as usize, block, true);
    }

    /// Adds a block to that of a pair, by its number: rows of the pair's first node, columns of its
    /// second.
    pub fn add_pair(&mut self, pair: usize, block: [[f64; B]; B]) {
        let (column, which, is_first) = self.plan.columns.pairs[pair];
        let turned = || std::array::from_fn(|r| std::array::from_fn(|c| block[c][r]));
        let block = if is_first { turned() } else { block };
        self.add(column as usize, which as usize, block, false);
    }

    fn add(&mut self, column: usize, which: usize, block: [[f64; B]; B], upper: bool) {
        for c in 0..B {
            let start = self.plan.columns.starts[column * B + c] as usize + which * B;
            let rows = if upper { c + 1 } else { B };
            for r in 0..rows {
                self.values[start + r] += block[r][c];
            }
        }
    }

    /// The largest entry of the diagonal.
    pub fn diagonal_max(&self) -> f64 {
        let ends = self.plan.columns.starts[1..].iter();
        ends.map(|&end| self.values[end as usize - 1]).fold(0.0, f64::max)
    }

    /// The factor L of the matrix; `None` unless it is positive definite beyond rounding.
    ///
    /// # Errors
    /// [`TooLarge`].
    pub fn factor(&self) -> Result<Option<Factor<'a, B>>, TooLarge> {
        let plan = self.plan;
        let upper = factor::Columns { starts: &plan.columns.starts, rows: &plan.columns.rows };
        let lower = plan.symbolic.factor();
        let lower = factor::Columns { starts: lower.col_ptr(), rows: lower.row_idx() };
        let values = factor::factored::<B>(upper, &self.values, lower)?;
        let finite = values.filter(|values| values.iter().all(|value| value.is_finite()));
        Ok(finite.map(|values| Factor { plan, values }))
    }
}

/// The factor of a matrix.
pub struct Factor<'a, const B: usize> {
    plan: &'a Plan<B>,
    values: Vec<f64>,
}

impl<const B: usize> Factor<'_, B> {
    /// The solutions for these right sides, each of one block a node.
    pub fn solve<const K: usize>(&self, right: [&[[f64; B]]; K]) -> [Vec<[f64; B]>; K] {
        let (plan, n) = (self.plan, self.plan.columns.size);
        let mut x = Mat::<f64>::zeros(n, K);
        for (k, side) in right.iter().enumerate() {
            for (node, block) in side.iter().enumerate() {
                for c in 0..B {
                    x[(plan.place[node] * B + c, k)] = block[c];
                }
            }
        }
        simplicial::SimplicialLltRef::<u32, f64>::new(&plan.symbolic, &self.values)
            .solve_in_place_with_conj(Conj::No, x.as_mut(), Par::Seq, MemStack::new(&mut []));
        std::array::from_fn(|k| {
            let block = |&place: &usize| std::array::from_fn(|c| x[(place * B + c, k)]);
            plan.place.iter().map(block).collect()
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use faer::linalg::cholesky::llt::factor::LltRegularization;
    use faer::sparse::SparseColMatRef;

    /// A grid of springs, some stiffer than others, held at one node.
    fn grid(side: usize) -> (usize, Vec<[usize; 2]>) {
        let at = |i: usize, j: usize| i * side + j;
        let mut pairs = Vec::new();
        for i in 0..side {
            for j in 0..side {
                if i + 1 < side {
                    pairs.push([at(i + 1, j), at(i, j)]);
                }
                if j + 1 < side {
                    pairs.push([at(i, j), at(i, j + 1)]);
                }
            }
        }
        (side * side, pairs)
    }

    #[test]
    fn what_is_solved_fulfils_the_equations() {
        let (nodes, pairs) = grid(9);
        let order = elimination_order(nodes, &pairs).unwrap();
        let mut seen = order.clone();
        seen.sort_unstable();
        assert_eq!(seen, (0..nodes).collect::<Vec<_>>());
        let plan = Plan::<2>::new(&order, &pairs).unwrap();
        let mut matrix = plan.zero();
        let mut dense = vec![vec![0.0; 2 * nodes]; 2 * nodes];
        let mut add = |a: usize, b: usize, block: [[f64; 2]; 2], sign: f64| {
            for r in 0..2 {
                for c in 0..2 {
                    dense[2 * a + r][2 * b + c] += sign * block[r][c];
                }
            }
        };
        for (n, &[a, b]) in pairs.iter().enumerate() {
            let k = 1.0 + (n % 7) as f64;
            let block = [[k + 0.5, 0.3], [0.3, 2.0]];
            matrix.add_diagonal(a, block);
            matrix.add_diagonal(b, block);
            let [[p, q], [r, s]] = [[k, 0.5], [0.1, 1.5]];
            matrix.add_pair(n, [[-p, -q], [-r, -s]]);
            add(a, a, block, 1.0);
            add(b, b, block, 1.0);
            add(a, b, [[p, q], [r, s]], -1.0);
            add(b, a, [[p, r], [q, s]], -1.0);
        }
        matrix.add_diagonal(0, [[1.0, 0.0], [0.0, 1.0]]);
        add(0, 0, [[1.0, 0.0], [0.0, 1.0]], 1.0);
        let right: Vec<[f64; 2]> = (0..nodes).map(|n| [n as f64, (n % 5) as f64]).collect();
        let [x] = matrix.factor().unwrap().unwrap().solve([&right]);
        for n in 0..nodes {
            for c in 0..2 {
                let sum: f64 = (0..2 * nodes).map(|k| dense[2 * n + c][k] * x[k / 2][k % 2]).sum();
                assert!((sum - right[n][c]).abs() < 1e-9, "{sum} {:?}", right[n]);
            }
        }
    }

    #[test]
    fn the_bits_are_those_of_every_platform() {
        let (nodes, pairs) = grid(40);
        let order = elimination_order(nodes, &pairs).unwrap();
        let plan = Plan::<1>::new(&order, &pairs).unwrap();
        let mut matrix = plan.zero();
        for (n, &[a, b]) in pairs.iter().enumerate() {
            let k = 1.0 / (1.0 + n as f64);
            matrix.add_diagonal(a, [[k]]);
            matrix.add_diagonal(b, [[k]]);
            matrix.add_pair(n, [[-k]]);
        }
        matrix.add_diagonal(7, [[0.1]]);
        let right: Vec<[f64; 1]> = (0..nodes).map(|n| [(n % 11) as f64 - 5.0]).collect();
        let [x] = matrix.factor().unwrap().unwrap().solve([&right]);
        // FNV-1a over the bits: a fused multiply-add or another order of sums would change it.
        let hash = x.iter().fold(0xcbf2_9ce4_8422_2325u64, |hash, value| {
            (hash ^ value[0].to_bits()).wrapping_mul(0x0100_0000_01b3)
        });
        assert_eq!(hash, 0x2ff8_e2b9_def6_266d, "{hash:#x}");
    }

    /// The crate's own numbers, one column after the other.
    fn factored_plainly<const B: usize>(matrix: &Matrix<'_, B>) -> Vec<f64> {
        let plan = matrix.plan;
        let mut values = vec![0.0; plan.symbolic.len_val()];
        let n = plan.columns.size;
        let scratch = simplicial::factorize_simplicial_numeric_llt_scratch::<u32, f64>(n);
        simplicial::factorize_simplicial_numeric_llt::<u32, f64>(
            &mut values,
            SparseColMatRef::new(plan.columns.symbolic(), &matrix.values),
            LltRegularization::default(),
            &plan.symbolic,
            MemStack::new(&mut memory(scratch).unwrap()),
        )
        .unwrap();
        values
    }

    /// Blocks on random graphs, the diagonal heavy.
    fn compared_with_the_crate<const B: usize>(seed: u64) {
        let mut state = seed;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 11) as f64 / (1u64 << 53) as f64
        };
        let nodes = 1 + (60.0 * random()) as usize;
        let share = 0.3 * random();
        let all = (0..nodes).flat_map(|a| (0..a).map(move |b| [a, b]));
        let pairs: Vec<[usize; 2]> = all.filter(|_| random() < share).collect();
        let order = elimination_order(nodes, &pairs).unwrap();
        let plan = Plan::<B>::new(&order, &pairs).unwrap();
        let mut matrix = plan.zero();
        for node in 0..nodes {
            let mut block = [[0.1; B]; B];
            (0..B).for_each(|r| block[r][r] = (B * nodes) as f64 + random());
            matrix.add_diagonal(node, block);
        }
        for pair in 0..pairs.len() {
            let block = std::array::from_fn(|_| std::array::from_fn(|_| random() - 0.5));
            matrix.add_pair(pair, block);
        }
        let bits = |values: &[f64]| values.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
        let ours = matrix.factor().unwrap().unwrap().values;
        assert_eq!(bits(&ours), bits(&factored_plainly(&matrix)), "{seed}");
    }

    #[test]
    fn the_factor_has_the_bits_of_one_column_after_the_other() {
        for seed in 0..200 {
            compared_with_the_crate::<1>(seed);
            compared_with_the_crate::<2>(seed);
            compared_with_the_crate::<3>(seed);
        }
    }

    #[test]
    fn what_is_not_positive_definite_has_no_factor() {
        let plan = Plan::<1>::new(&[0, 1], &[[0, 1]]).unwrap();
        let mut matrix = plan.zero();
        matrix.add_diagonal(0, [[1.0]]);
        matrix.add_diagonal(1, [[1.0]]);
        matrix.add_pair(0, [[2.0]]);
        assert!(matrix.factor().unwrap().is_none());
    }
}
