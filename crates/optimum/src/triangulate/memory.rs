//! How much memory tables may take: the limit of the caller, and that of the system.
//!
//! Tables grow piece by piece, and a failed allocation would end the program. So before a large
//! table is begun, its memory is reserved and released again.

/// Tables up to this size are begun without that test, bytes.
const UNASKED: u64 = 64 << 20;
/// The share of the available memory that tables may take; the rest is for other data.
const SHARE: f64 = 0.75;
/// Resolution of the search for the available memory, bytes.
const STEP: u64 = 16 << 20;

/// The memory limit of tables that need up to `needed` bytes: `limit`, if the system has as much as
/// they may take, else [`SHARE`] of what it has; bytes.
pub(super) fn obtainable(limit: u64, needed: u64) -> u64 {
    let most = limit.min(needed);
    // In a browser, memory is never released.
    if most <= UNASKED || cfg!(target_family = "wasm") || can_be_had(most) {
        return limit;
    }
    let (mut had, mut not) = (0, most);
    while not - had > STEP {
        let middle = had + (not - had) / 2;
        *(if can_be_had(middle) { &mut had } else { &mut not }) = middle;
    }
    (had as f64 * SHARE) as u64
}

fn can_be_had(bytes: u64) -> bool {
    let Ok(bytes) = usize::try_from(bytes) else { return false };
    let mut memory: Vec<u8> = Vec::new();
    let is_had = memory.try_reserve_exact(bytes).is_ok();
    // Without this, the compiler may leave out an allocation that is not used.
    std::hint::black_box(&memory);
    is_had
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_can_not_be_had_lowers_the_limit() {
        assert_eq!(obtainable(1 << 20, 1 << 10), 1 << 20);
        assert_eq!(obtainable(1 << 62, 1 << 10), 1 << 62, "little is needed");
        let most = obtainable(1 << 62, 1 << 62);
        assert!(most > UNASKED && most < 1 << 50, "{most}");
    }
}
