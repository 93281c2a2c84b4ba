//! Bytes as text for the browser's local storage, which keeps nothing else and counts its limit in
//! units of 16 bits: 15 bits of ours go into each, so that a design takes little more than half of
//! what it would take as characters of one byte each.

/// The first character that is used; the last, 2¹⁵ further, comes before the surrogates.
const FIRST: u32 = 0x20;

/// The bytes as text.
pub(super) fn packed(bytes: &[u8]) -> String {
    let mut text = String::with_capacity(bytes.len() * 8 / 5 + 4);
    let (mut held, mut bits) = (0_u32, 0);
    let mut push = |value: u32| text.extend(char::from_u32(FIRST + value));
    for &byte in bytes {
        held = held << 8 | u32::from(byte);
        bits += 8;
        if bits >= 15 {
            bits -= 15;
            push(held >> bits);
            held &= (1 << bits) - 1;
        }
    }
    // A one marks where the bytes end, so that nothing has to be counted.
    push((held << 1 | 1) << (14 - bits));
    text
}

/// The bytes of [`packed`] text; `None` if it is none.
pub(super) fn unpacked(text: &str) -> Option<Vec<u8>> {
    let mut bytes = Vec::with_capacity(text.len());
    let (mut held, mut bits) = (0_u32, 0);
    let mut values = text.chars().map(|c| (c as u32).checked_sub(FIRST).filter(|v| *v < 1 << 15));
    let mut value = values.next()??;
    loop {
        let next = values.next();
        let mut count = 15;
        if next.is_none() {
            let zeros = value.trailing_zeros();
            count = 14_u32.checked_sub(zeros)?;
            value >>= zeros + 1;
        }
        held = held << count | value;
        bits += count;
        while bits >= 8 {
            bits -= 8;
            bytes.push((held >> bits) as u8);
            held &= (1 << bits) - 1;
        }
        match next {
            Some(next) => value = next?,
            // Whatever was packed fills its last byte.
            None => return (bits == 0).then_some(bytes),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_come_back() {
        let mut state = 1_u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 33) as u8
        };
        for length in (0..40).chain([1000, 4096]) {
            let bytes: Vec<u8> = (0..length).map(|_| random()).collect();
            for bytes in [bytes, vec![0; length], vec![255; length]] {
                let text = packed(&bytes);
                assert_eq!(text.chars().count(), length * 8 / 15 + 1);
                assert!(text.chars().all(|c| c.len_utf16() == 1));
                assert_eq!(unpacked(&text).as_ref(), Some(&bytes));
            }
        }
    }

    #[test]
    fn other_text_is_refused() {
        for text in ["", "\u{1}", "a\u{ffff}b", " ", "\u{10000}"] {
            assert_eq!(unpacked(text), None, "{text:?}");
        }
    }
}
