//! A set of unordered pairs of samples, a bit for each.

/// Bits of a word.
pub(super) const BITS: usize = u64::BITS as usize;

/// The row of the lower sample begins with the word of its own bit and has a bit for each higher
/// sample. Bits of that word for lower samples are undefined, and so are those beyond the last
/// sample.
#[derive(Clone, Debug)]
pub(super) struct PairSet {
    words: Vec<u64>,
    samples: usize,
}

/// How many words the rows before that of sample `i` have, of `m` samples.
#[inline(always)]
fn words_before(i: u64, m: u64) -> u64 {
    let bits = BITS as u64;
    let (block, of_first) = (i / bits, m.div_ceil(bits));
    // Blocks have as many rows as a word has bits, each a word shorter than in the block before.
    let in_blocks = bits * (block * of_first - block * block.saturating_sub(1) / 2);
    in_blocks + i % bits * (of_first - block)
}

impl PairSet {
    pub(super) fn new(m: usize) -> Self {
        let mut pairs = Self { words: Vec::new(), samples: m };
        pairs.words = vec![0; pairs.row(m)];
        pairs
    }

    /// Memory for so many samples, bytes.
    pub(super) fn bytes_of(m: usize) -> u64 {
        words_before(m as u64, m as u64) * size_of::<u64>() as u64
    }

    /// Memory, bytes.
    pub(super) fn bytes(&self) -> u64 {
        Self::bytes_of(self.samples)
    }

    /// Where the row of a sample begins.
    #[inline(always)]
    fn row(&self, i: usize) -> usize {
        words_before(i as u64, self.samples as u64) as usize
    }

    /// The words of the row of a sample.
    pub(super) fn row_mut(&mut self, i: usize) -> &mut [u64] {
        let row = self.row(i)..self.row(i + 1);
        &mut self.words[row]
    }

    /// The word of sample `i` that has the bit of sample `j`, which is no lower.
    #[inline(always)]
    fn word(&self, i: usize, j: usize) -> usize {
        debug_assert!(i <= j, "{i} {j}");
        self.row(i) + j / BITS - i / BITS
    }

    pub(super) fn insert(&mut self, i: usize, j: usize) {
        let (i, j) = (i.min(j), i.max(j));
        let word = self.word(i, j);
        self.words[word] |= 1 << (j % BITS);
    }

    pub(super) fn contains(&self, i: usize, j: usize) -> bool {
        let (i, j) = (i.min(j), i.max(j));
        self.words[self.word(i, j)] >> (j % BITS) & 1 == 1
    }

    /// Which of the 16 samples from `first` on, a multiple of 16, are in a pair with sample `i`, a
    /// lower one: one bit each, the lowest for the first.
    #[inline(always)]
    pub(super) fn sixteen(&self, i: usize, first: usize) -> u16 {
        (self.words[self.word(i, first)] >> (first % BITS)) as u16
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_pair_has_a_bit_of_its_own() {
        for m in [2, 63, 64, 65, 128, 150, 200] {
            let all = || (0..m).flat_map(move |j| (0..=j).map(move |i| (i, j)));
            let mut pairs = PairSet::new(m);
            for (n, (i, j)) in all().enumerate() {
                assert!(!pairs.contains(j, i), "{m}: {i} {j}");
                if n % 3 == 0 {
                    pairs.insert(j, i);
                }
            }
            for (n, (i, j)) in all().enumerate() {
                assert_eq!(pairs.contains(i, j), n % 3 == 0, "{m}: {i} {j}");
            }
            let of_rows = (0..m).map(|i| m.div_ceil(BITS) - i / BITS).sum::<usize>();
            assert_eq!(pairs.words.len(), of_rows, "{m}");
            assert_eq!(PairSet::bytes_of(m), 8 * of_rows as u64, "{m}");
        }
    }
}
