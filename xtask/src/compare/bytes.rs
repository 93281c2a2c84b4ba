//! Where two files first differ, for one who looks for the cause.

/// So many bytes before and after the place are shown.
const SHOWN: usize = 30;

/// The first place where two files differ, by line and byte from 1 and 0, and what is there.
pub(super) fn first_difference(a: &[u8], b: &[u8]) -> String {
    let at = a.iter().zip(b).take_while(|(a, b)| a == b).count();
    let line = 1 + a[..at].iter().filter(|&&byte| byte == b'\n').count();
    let [a, b] = [a, b].map(|file| around(file, at));
    format!("line {line}, byte {at}: {a:?} and {b:?}")
}

/// The part of a line around a byte.
fn around(file: &[u8], at: usize) -> String {
    let is_end = |byte: &u8| *byte == b'\n';
    let from = at.saturating_sub(SHOWN);
    let from = from + file[from..at].iter().rposition(is_end).map_or(0, |end| end + 1);
    let rest = &file[at..file.len().min(at + SHOWN)];
    let to = at + rest.iter().position(is_end).unwrap_or(rest.len());
    String::from_utf8_lossy(&file[from..to]).into_owned()
}

#[cfg(test)]
mod tests {
    use super::first_difference;

    #[test]
    fn the_first_place_is_named() {
        let lines = |last: &str| format!("v 1 2\nv 0.25 {last}\nend\n").into_bytes();
        let found = first_difference(&lines("0.5"), &lines("0.75"));
        assert_eq!(found, "line 2, byte 15: \"v 0.25 0.5\" and \"v 0.25 0.75\"");
        let long = [b'x'; 100];
        let found = first_difference(&long, &[&long[..], b"y"].concat());
        let xs = "x".repeat(30);
        assert_eq!(found, format!("line 1, byte 100: {xs:?} and \"{xs}y\""));
    }
}
