//! Bytes with a head that tells whether they are whole.
//!
//! Renaming a file puts it there whole or not at all, but disks and browsers have their own ideas
//! of what they have written; what was cut off or mixed up must not come back as somebody's work.

/// `SWR1`, the length, and a check sum of what follows.
const MARK: [u8; 4] = *b"SWR1";
const HEAD: usize = MARK.len() + 16;

/// The bytes with their head.
pub(crate) fn sealed(bytes: &[u8]) -> Vec<u8> {
    let mut all = Vec::with_capacity(HEAD + bytes.len());
    all.extend(MARK);
    all.extend((bytes.len() as u64).to_le_bytes());
    all.extend(sum(bytes).to_le_bytes());
    all.extend(bytes);
    all
}

/// The bytes without their head; `None` if they are not whole.
pub(crate) fn opened(all: &[u8]) -> Option<&[u8]> {
    let rest = all.strip_prefix(&MARK)?;
    let (length, rest) = rest.split_first_chunk::<8>()?;
    let (expected, bytes) = rest.split_first_chunk::<8>()?;
    let whole = u64::from_le_bytes(*length) == bytes.len() as u64
        && u64::from_le_bytes(*expected) == sum(bytes);
    whole.then_some(bytes)
}

/// FNV-1a: no secret, but any single change shows.
fn sum(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |sum: u64, &byte| {
        (sum ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_is_whole_is_opened() {
        for bytes in [&b""[..], b"a", b"a design, or part of one"] {
            let all = sealed(bytes);
            assert_eq!(opened(&all), Some(bytes));
            for n in 0..all.len() {
                assert_eq!(opened(&all[..n]), None, "cut off after {n}");
                let mut changed = all.clone();
                changed[n] ^= 1;
                assert_eq!(opened(&changed), None, "changed at {n}");
            }
            assert_eq!(opened(&[&all[..], b"x"].concat()), None, "longer");
        }
    }
}
