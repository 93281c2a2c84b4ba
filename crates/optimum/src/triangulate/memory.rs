//! How much memory tables may take: what the caller allows, and what the system gives.
//!
//! Tables grow piece by piece, and a piece that can't be had would end the program. So it is found
//! out before a large table is begun, by asking for memory and giving it back.

/// Tables that take no more are begun without a question, bytes.
const UNASKED: u64 = 64 << 20;
/// The share of what can be had that tables may take; the rest is for what grows beside them.
const SHARE: f64 = 0.75;
/// How finely it is found out what can be had, bytes.
const STEP: u64 = 16 << 20;

/// The most memory that tables may take which need no more than this, bytes: `limit`, if it can be
/// had.
pub(super) fn obtainable(limit: u64, needed: u64) -> u64 {
    let most = limit.min(needed);
    // In a browser, memory that was asked for is never given back.
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
    // Memory that is not looked at need not be asked for.
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
