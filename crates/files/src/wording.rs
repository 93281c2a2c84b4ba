//! Numbers and verdicts in words.

use sheetwright::check::Verdict;

/// A verdict in a word or three.
pub fn verdict_word(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Bends => "Bends",
        Verdict::BendsAndFolds => "Bends and folds",
        Verdict::BendsWithForce => "Bends with force",
        Verdict::Roll => "Roll or form it",
        Verdict::Undecided => "Can't tell",
        Verdict::WillNotBend => "Will not bend",
    }
}

/// A verdict in a sentence, on a part whose surface was found or on a mesh.
pub fn verdict_sentence(verdict: Verdict, is_mesh: bool) -> &'static str {
    match verdict {
        Verdict::Bends if is_mesh => {
            "Laid flat, every length changes by less than the sheet takes with ease."
        }
        Verdict::BendsAndFolds if is_mesh => {
            "The sheet takes this shape with its creases folded along scored lines."
        }
        Verdict::BendsWithForce | Verdict::Roll | Verdict::Undecided if is_mesh => {
            "The sheet must stretch to take this shape. The stretch is within the limit."
        }
        Verdict::Bends => "The sheet takes this shape by bending alone.",
        Verdict::BendsAndFolds => {
            "The sheet takes this shape by bending, and by sharp folds along scored lines."
        }
        Verdict::BendsWithForce => {
            "The sheet takes this shape when it is clamped. It must stretch a little."
        }
        Verdict::Roll => "The sheet takes this shape when it is rolled or formed, and keeps it.",
        Verdict::Undecided => {
            "The sheet must stretch by about as much as it takes: no one can tell whether it bends."
        }
        Verdict::WillNotBend => "The sheet does not take this shape.",
    }
}

/// Digits in groups of three, with narrow blanks that do not break.
fn grouped(digits: &str) -> String {
    let (whole, rest) = digits.split_once('.').unwrap_or((digits, ""));
    let mut out = String::new();
    for (n, c) in whole.chars().enumerate() {
        let left = whole.len() - n;
        if n > 0 && left.is_multiple_of(3) && whole.len() > 4 && !out.ends_with('-') {
            out.push('\u{202f}');
        }
        out.push(c);
    }
    if !rest.is_empty() {
        out.push('.');
        out.push_str(rest);
    }
    out
}

/// A number with this many decimals, its minus sign a real one.
pub(crate) fn decimal(x: f64, decimals: usize) -> String {
    let text = format!("{x:.decimals$}");
    let is_zero = text.chars().all(|c| "-0.".contains(c));
    let text = if is_zero { text.trim_start_matches('-') } else { &text };
    grouped(text).replace('-', "−")
}

/// A length: tenths of a millimetre below a metre, whole ones above.
pub(crate) fn millimetres(mm: f64) -> String {
    format!("{}\u{a0}mm", decimal(mm, if mm.abs() < 1000.0 { 1 } else { 0 }))
}

/// A length that may be short: hundredths of a millimetre below ten.
pub(crate) fn millimetres_fine(mm: f64) -> String {
    if mm.abs() < 10.0 { format!("{}\u{a0}mm", decimal(mm, 2)) } else { millimetres(mm) }
}

/// A small length with two significant digits; `none` below a nanometre.
pub(crate) fn millimetres_small(mm: f64) -> String {
    if mm < 1e-6 {
        return "none".to_owned();
    }
    let shifted = std::iter::successors(Some(mm), |x| Some(x * 10.0));
    let digits = shifted.take_while(|x| *x < 10.0).count();
    format!("{}\u{a0}mm", decimal(mm, digits))
}

/// A round length, in metres from one metre on.
pub(crate) fn length_short(mm: f64) -> String {
    let plain = |x: f64| {
        let text = format!("{x:.3}");
        grouped(text.trim_end_matches('0').trim_end_matches('.'))
    };
    if mm >= 1000.0 {
        format!("{}\u{a0}m", plain(mm / 1000.0))
    } else if mm >= 0.001 {
        format!("{}\u{a0}mm", plain(mm))
    } else {
        format!("{}\u{a0}nm", plain(mm * 1e6))
    }
}

/// An area, in the unit that gives about three digits.
pub(crate) fn area(mm2: f64) -> String {
    let with_digits = |x: f64, unit: &str| {
        let decimals = if x < 10.0 {
            3
        } else if x < 100.0 {
            2
        } else {
            1
        };
        format!("{}\u{a0}{unit}", decimal(x, decimals))
    };
    if mm2.abs() >= 1e5 {
        with_digits(mm2 / 1e6, "m²")
    } else if mm2.abs() >= 1e3 {
        with_digits(mm2 / 1e2, "cm²")
    } else {
        with_digits(mm2, "mm²")
    }
}

/// An angle in degrees.
pub(crate) fn degrees(deg: f64) -> String {
    let decimals = if deg.abs() < 10.0 { 2 } else { 1 };
    format!("{}°", decimal(deg, decimals))
}

/// Lengths that change by a larger share have no digits: no sheet does that, whatever the number.
const MOST_SHARE: f64 = 10.0;

/// How a strain or an error of lengths is told that is above 1000 %; `None` of a smaller one.
pub fn share_beyond_words(share: f64) -> Option<&'static str> {
    (share > MOST_SHARE).then_some("more than 1000 %")
}

/// A relative error as a share in per cent; `none` below 1e-8, which no workshop can measure.
pub(crate) fn per_cent(share: f64) -> String {
    match share_beyond_words(share) {
        Some(beyond) => beyond.to_owned(),
        None if share < 1e-8 => "none".to_owned(),
        None => format!("{}\u{a0}%", decimal(100.0 * share, 4)),
    }
}

/// A share in per cent with two or three significant digits.
pub(crate) fn plain_per_cent(share: f64) -> String {
    if let Some(beyond) = share_beyond_words(share) {
        return beyond.to_owned();
    }
    let percent = 100.0 * share;
    let shifted = std::iter::successors(Some(percent.abs()), |x| Some(x * 10.0));
    let digits = shifted.take(9).take_while(|x| *x > 0.0 && *x < 10.0).count();
    let text = decimal(percent, digits);
    let text =
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    format!("{text}\u{a0}%")
}

/// The refold error: the largest distance from the surface to the pattern folded up again, mm.
pub(crate) fn refold(error_mm: f64) -> String {
    if !error_mm.is_finite() {
        "not read back".to_owned()
    } else if error_mm < 0.001 {
        "below 0.001\u{a0}mm".to_owned()
    } else {
        format!("{}\u{a0}mm", decimal(error_mm, 3))
    }
}

/// A bend radius; `flat` from 10 km on.
pub(crate) fn radius(mm: f64) -> String {
    if mm.is_finite() && mm < 1e7 { millimetres(mm) } else { "flat".to_owned() }
}

/// A solid angle: `0.013 sr`; below 0.001 sr with its power of ten.
pub(crate) fn steradians(area_sr: f64) -> String {
    let number = if area_sr < 1e-3 { scientific(area_sr) } else { decimal(area_sr, 3) };
    format!("{number}\u{a0}sr")
}

/// A small or large number with its power of ten: `2.1 × 10⁻¹³`.
pub(crate) fn scientific(x: f64) -> String {
    if x == 0.0 {
        return "0".to_owned();
    }
    if !x.is_finite() {
        return "not known".to_owned();
    }
    let text = format!("{x:.1e}");
    let (digits, power) = text.split_once('e').unwrap_or((&text, "0"));
    if power == "0" {
        return digits.to_owned();
    }
    let raised: String = power.chars().map(superscript).collect();
    format!("{}\u{a0}×\u{a0}10{raised}", digits.replace('-', "−"))
}

fn superscript(c: char) -> char {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    c.to_digit(10).map_or('⁻', |d| DIGITS[d as usize])
}

/// About `most` of a list, evenly, the first and the last among them; all if there are no more.
pub(crate) fn thinned(list: &[usize], most: usize) -> Vec<usize> {
    if list.len() <= most || most < 2 {
        return list.to_vec();
    }
    (0..most).map(|n| list[n * (list.len() - 1) / (most - 1)]).collect()
}

/// Marks such as `S1` in the order of their numbers, each once; of those that follow one another,
/// the first and the last.
pub(crate) fn mark_ranges(mut marks: Vec<String>) -> String {
    marks.sort_by(|a, b| (a.len(), a).cmp(&(b.len(), b)));
    marks.dedup();
    let parsed = |mark: &str| -> Option<(String, usize)> {
        let letters = mark.trim_end_matches(|c: char| c.is_ascii_digit());
        Some((letters.to_owned(), mark[letters.len()..].parse().ok()?))
    };
    let mut runs: Vec<(String, String)> = Vec::new();
    let mut before: Option<(String, usize)> = None;
    for mark in &marks {
        let now = parsed(mark);
        let follows = matches!((&before, &now),
            (Some((a, n)), Some((b, m))) if a == b && n + 1 == *m);
        match runs.last_mut().filter(|_| follows) {
            Some(run) => run.1 = mark.clone(),
            None => runs.push((mark.clone(), mark.clone())),
        }
        before = now;
    }
    let said = runs
        .into_iter()
        .map(|(first, last)| if first == last { first } else { format!("{first}–{last}") });
    said.collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_read_well() {
        assert_eq!(decimal(-0.001, 2), "0.00");
        assert_eq!(decimal(-1234567.0, 0), "−1\u{202f}234\u{202f}567");
        assert_eq!(millimetres(36_102.4), "36\u{202f}102\u{a0}mm");
        assert_eq!(millimetres(5301.0), "5301\u{a0}mm");
        assert_eq!(millimetres_small(0.0685), "0.069\u{a0}mm");
        assert_eq!(millimetres_small(12.3), "12\u{a0}mm");
        assert_eq!(millimetres_small(3e-13), "none");
        assert_eq!(length_short(5000.0), "5\u{a0}m");
        assert_eq!(length_short(0.2), "0.2\u{a0}mm");
        assert_eq!(area(812_345.6), "0.812\u{a0}m²");
        assert_eq!(area(2500.0), "25.00\u{a0}cm²");
        assert_eq!(degrees(0.4), "0.40°");
        assert_eq!(per_cent(0.0123), "1.2300\u{a0}%");
        assert_eq!(plain_per_cent(9.87), "987\u{a0}%");
        for beyond in [674_731.807, f64::INFINITY] {
            assert_eq!([per_cent(beyond), plain_per_cent(beyond)], ["more than 1000 %"; 2]);
        }
        assert_eq!(scientific(2.1e-13), "2.1\u{a0}×\u{a0}10⁻¹³");
        assert_eq!(scientific(1.5), "1.5");
        assert_eq!(radius(f64::INFINITY), "flat");
        assert_eq!(refold(f64::NAN), "not read back");
    }

    #[test]
    fn thinning_keeps_both_ends() {
        let list: Vec<usize> = (0..100).collect();
        let few = thinned(&list, 7);
        assert_eq!((few.len(), few[0], few[6]), (7, 0, 99));
        assert_eq!(thinned(&list[..5], 7), [0, 1, 2, 3, 4]);
    }
}
