//! Things that are known to be one: disjoint sets, joined pair by pair.

/// The numbers from 0 on in disjoint sets, each of which its lowest member stands for.
#[derive(Clone, Debug)]
pub struct DisjointSets {
    parent: Vec<usize>,
}

impl DisjointSets {
    /// So many sets of one member each.
    pub fn new(count: usize) -> Self {
        Self { parent: (0..count).collect() }
    }

    /// The lowest member of the set that a number is in. Shortens the way to it for the next time.
    pub fn first(&mut self, mut n: usize) -> usize {
        while self.parent[n] != n {
            self.parent[n] = self.parent[self.parent[n]];
            n = self.parent[n];
        }
        n
    }

    /// Joins the sets of two numbers; whether they were two sets.
    pub fn join(&mut self, a: usize, b: usize) -> bool {
        let (a, b) = (self.first(a), self.first(b));
        // The lower one leads, so that the outcome does not depend on the order.
        self.parent[a.max(b)] = a.min(b);
        a != b
    }

    /// The lowest member of the set of every number.
    pub fn all_first(mut self) -> Vec<usize> {
        (0..self.parent.len()).map(|n| self.first(n)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_lowest_member_stands_for_a_set_in_whatever_order_it_was_joined() {
        for pairs in [[[3, 5], [5, 1], [4, 2]], [[1, 5], [2, 4], [5, 3]]] {
            let mut sets = DisjointSets::new(6);
            assert!(pairs.iter().all(|&[a, b]| sets.join(a, b)));
            assert!(!sets.join(1, 3));
            assert_eq!(sets.first(5), 1);
            assert_eq!(sets.all_first(), [0, 1, 2, 1, 2, 1]);
        }
    }
}
