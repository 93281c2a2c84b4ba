//! Findings in sentences, with advice.

use super::moved::{keeps_from_bending, listed, movement, not_needed, ran_on};
use super::place::point;
use crate::pdf::way_to_sheets;
use sheetwright::check::{Finding, FindingKind, SeamCause, TooTight};
use sheetwright::math::{Point3, to_deg};
use sheetwright::measure::SHARP_CREASE_DEG;
use sheetwright::tolerance::Tolerance;

/// A finding in words with units, and advice: one sentence or more for each kind.
pub fn finding_text(finding: &Finding) -> String {
    use FindingKind as Kind;
    match &finding.kind {
        Kind::WarpTooLarge { largest, count, of, limit, sheet } => format!(
            "The surface twists by up to {} along its rulings; the limit for {} is {}. {} \
             the limit. Move the boundary there, or divide the panel.",
            degrees(*largest),
            or_any_sheet(sheet),
            degrees(*limit),
            match count {
                1 => format!("1 of {of} rulings exceeds"),
                count => format!("{count} of {of} rulings exceed"),
            }
        ),
        Kind::WarpHigh { largest, limit, sheet } => format!(
            "The surface twists by up to {} along its rulings, so bending needs force. The limit \
             for {} is {}.",
            degrees(*largest),
            or_any_sheet(sheet),
            degrees(*limit)
        ),
        Kind::CoarseSamples { largest } => format!(
            "Along its rungs the surface turns by up to {}. The samples are too coarse to tell \
             bending from twist. Use more samples.",
            degrees(*largest)
        ),
        Kind::RadiusTooSmall { least_mm, limit_mm, sheet } => format!(
            "The smallest bend radius of the panel is {least_mm:.1} mm; the limit for {sheet} is \
             {limit_mm:.1} mm. Choose a thinner sheet, or draw the boundary rounder."
        ),
        Kind::Points { count, turn, too_tight } => points(*count == 1, *turn, too_tight.as_ref()),
        Kind::SelfCrossing => "The surface passes through itself in space. Choose a supporting \
                               plane, or change the boundary."
            .to_owned(),
        Kind::Overlap => "Laid flat, the pattern overlaps itself, so it can't be cut from one \
                          sheet. Divide the panel."
            .to_owned(),
        Kind::RungWithoutPlane { count } => format!(
            "{} along the boundary itself, where the surface has no tangent plane. Every surface \
             of this boundary has such rungs. More samples may help.",
            counted(*count, "One rung runs", "rungs run"),
        ),
        Kind::BetterWithoutPlane { with, without } => format!(
            "The boundary projects onto its supporting plane without crossing itself, so the \
             surface lies over that plane. A surface that may wrap round or hang over bends \
             better: its price is {:.0} % of this one. To get it, set the plane to \"none\".",
            100.0 * without / with
        ),
        Kind::NotProven { gap, cut_short } => not_proven(*gap, *cut_short),
        Kind::Folds { count, sharpest, stiff } => format!(
            "The surface has {count} sharp {} of up to {}, where it can't bend smoothly. {}",
            if *count == 1 { "fold" } else { "folds" },
            degrees(*sharpest),
            match stiff {
                Some(sheet) =>
                    format!("{} does not fold; move the boundary there.", first_up(sheet)),
                None if *count == 1 => "The pattern marks it to be scored.".to_owned(),
                None => "The pattern marks them to be scored.".to_owned(),
            }
        ),
        Kind::Creases { count, sharpest, stiff } => format!(
            "The mesh has sharp creases of up to {} along {count} of its sides. {}",
            degrees(*sharpest),
            match stiff {
                Some(sheet) => format!("{} does not fold; divide the mesh there.", first_up(sheet)),
                None => "The pattern marks them to be scored.".to_owned(),
            }
        ),
        Kind::BendLines { count, sharpest } => bend_lines(*count, *sharpest),
        Kind::LengthError { largest, closes_holes: true } => format!(
            "Lengths in the pattern differ from those on the surface by up to {}. This lets the \
             holes close when the panel is laid flat.",
            percent(*largest)
        ),
        Kind::LengthError { largest, closes_holes: false } => format!(
            "Lengths in the pattern differ from those on the surface by up to {:.3} %.",
            100.0 * largest
        ),
        Kind::WindowGap { widest_mm } => format!(
            "Laid flat, the panel has a gap of {widest_mm:.2} mm at a hole. Closing the gap would \
             change lengths by more than {} %, so the pattern is cut there from edge to edge.",
            Tolerance::STRETCH.share() * 100.0
        ),
        Kind::Seams { count, length_mm, why } => format!(
            "{} along {}, {length_mm:.1} mm {}. Join the sides that have the same mark.",
            cut_open(*why),
            counted(*count, "a seam", "seams"),
            if *count == 1 { "long" } else { "in total" }
        ),
        Kind::StretchTooLarge { largest, limit, sheet, cut, has_creases, .. } => format!(
            "{} {}. {}, or choose a sheet that stretches more.",
            must_stretch(*largest),
            takes(sheet.as_ref(), *limit),
            divided(*cut, *has_creases)
        ),
        Kind::StretchHigh { largest, limit, sheet } => {
            format!("{} {}.", must_stretch(*largest), takes(sheet.as_ref(), *limit))
        }
        Kind::Stretch { largest } => must_stretch(*largest),
        Kind::BorderNotTrue { largest } => format!(
            "The border can't keep its lengths: they differ by up to {}. Cut the panel open, or \
             divide it.",
            percent(*largest)
        ),
        Kind::Flipped { count } => format!(
            "Laid flat, {} upside down: the pattern is folded over itself there. Divide the panel.",
            counted(*count, "a triangle lies", "triangles lie")
        ),
        Kind::TrianglesLeftOut { count } => format!(
            "{} left out: two of the corners lie in one place, so there is no area.",
            counted(*count, "A triangle of the file is", "triangles of the file are")
        ),
        Kind::PartsLeftOut { count } => format!(
            "{} smaller than 1e-6 mm, or narrower than 1e-12 times the size of the file.",
            counted(
                *count,
                "A part of the mesh is left out: it is",
                "parts of the mesh are left out: each is"
            )
        ),
        Kind::PointContacts { count } => format!(
            "Parts of the mesh meet only in {}, which can't hold them together. They are \
             separated there.",
            counted(*count, "a point", "points")
        ),
        Kind::RoundedCorner { curve, turn } => format!(
            "The points of the curve '{curve}' turn by up to {:.0}°, and the spline rounds this \
             turn. If it is a corner, mark it as one.",
            to_deg(*turn)
        ),
        Kind::JointsSmoothed { count, deviation_mm } => format!(
            "The boundary is smoothed at {} where joined panels meet. It lies up to \
             {deviation_mm:.2} mm from the boundaries of those panels.",
            counted(*count, "one place", "places")
        ),
        Kind::RanOn { bulges_mm, bends } => ran_on(&finding.kind, *bulges_mm, *bends),
        Kind::StayedStraight { cause } => format!(
            "The rails can't run on: with the ends that this gives, {cause}. The ends of the \
             panel stay straight."
        ),
        Kind::TurnedRound { panels, first } => format!(
            "{} faced the other way, and {} turned round to face as '{first}' does.",
            listed(panels),
            if panels.len() == 1 { "was" } else { "were" }
        ),
        Kind::Moved { movement: moved, ended, hindrance } => {
            format!("{}; {ended}.{}", movement(moved), keeps_from_bending(*hindrance))
        }
        Kind::NotMoved { movement: moved, wanted, is_above, hindrance } => {
            format!("{}{}", movement(moved), not_needed(*wanted, *is_above, *hindrance))
        }
        Kind::WarpNotReached { movement: moved, wanted, ended } => format!(
            "{}. The goal of {} is not reached within the limits: {ended}. Let the boundary move \
             farther, or draw it with less twist.",
            movement(moved),
            degrees(*wanted)
        ),
        Kind::Refold { error_mm, limit_mm } => format!(
            "Folded up again, the written pattern differs from the surface by {error_mm:.3} mm; \
             the limit is {limit_mm:.2e} mm. {FAULT}"
        ),
        Kind::NotReadBack { cause } => format!("{}. {FAULT}", first_up(cause)),
        Kind::QuadsOffBoundary { off_mm } => format!(
            "To make all quads planar, their vertices leave the boundary by up to {} mm. Moving \
             them along the boundary is not enough: the panel is not quite developable.",
            short(*off_mm)
        ),
        Kind::QuadsNotPlanar { uneven_mm, off_mm: Some(off_mm) } => format!(
            "The quads are not planar: their diagonals are up to {} mm apart. Planar quads need \
             vertices {} mm off the boundary; the limit is a thousandth of the size.",
            short(*uneven_mm),
            short(*off_mm)
        ),
        Kind::QuadsNotPlanar { uneven_mm, off_mm: None } => format!(
            "The quads can't be made planar: their diagonals are up to {} mm apart.",
            short(*uneven_mm)
        ),
        Kind::PdfReduced { sheets, scale, most, is_full } => {
            reduced(*sheets, *scale, *most, *is_full)
        }
    }
}

/// The advice where a written file is wrong.
const FAULT: &str = "Do not cut the pattern. This is a fault of the program: please report it.";

fn degrees(angle: f64) -> String {
    format!("{:.1}°", to_deg(angle))
}

/// The number of decimals that shows two significant digits of `x`, at most nine.
fn decimals_of(x: f64) -> usize {
    let shifted = std::iter::successors(Some(x), |x| Some(x * 10.0));
    shifted.take(9).take_while(|x| *x < 10.0).count()
}

/// A share in per cent, with two significant digits.
fn percent(share: f64) -> String {
    let percent = 100.0 * share;
    format!("{percent:.*} %", decimals_of(percent))
}

/// A length with two significant digits, down to a picometre.
fn short(mm: f64) -> String {
    format!("{mm:.*}", decimals_of(mm))
}

/// `one` for a count of 1, else the count and `more`.
fn counted(count: usize, one: &str, more: &str) -> String {
    if count == 1 { one.to_owned() } else { format!("{count} {more}") }
}

fn first_up(text: &str) -> String {
    let mut chars = text.chars();
    chars.next().map_or_else(String::new, |c| c.to_uppercase().chain(chars).collect())
}

fn or_any_sheet(sheet: &Option<String>) -> &str {
    sheet.as_deref().unwrap_or("a sheet of no named material")
}

fn points(is_one: bool, turn: f64, too_tight: Option<&TooTight>) -> String {
    let begin = match (too_tight, is_one) {
        (None, true) => "Bend lines meet in a corner",
        (None, false) => "Bend lines meet in corners",
        (Some(_), true) => "Bend lines meet in a point",
        (Some(_), false) => "Bend lines meet in points",
    };
    let advice = match too_tight {
        Some(TooTight { sheet, limit_mm, needed_mm }) => format!(
            "The bend radius there is {needed_mm:.1} mm; the limit for {sheet} is {limit_mm:.1} \
             mm. Cut the point off, or move the boundary there."
        ),
        None => format!(
            "Bend the {} in steps. The smallest bend radius leaves {} out.",
            if is_one { "corner" } else { "corners" },
            if is_one { "it" } else { "them" }
        ),
    };
    format!("{begin} and turn the sheet by up to {} there. {advice}", degrees(turn))
}

fn not_proven(gap: Option<f64>, cut_short: bool) -> String {
    let better = match gap {
        Some(gap) => {
            format!("A better one may exist; its price is at most {:.2} % lower", 100.0 * gap)
        }
        None => "A better one may exist; how much lower its price is is not known".to_owned(),
    };
    let how = if cut_short {
        " The search ended at the limit of its work; a greater \"effort\" of the panel allows more."
    } else {
        ""
    };
    format!("This is the best surface found. {better}. The pattern is exact for this surface.{how}")
}

fn bend_lines(count: usize, sharpest: f64) -> String {
    let (limit, sharpest) = (format!("more than {SHARP_CREASE_DEG:.0}°"), degrees(sharpest));
    let lines = match count {
        1 => format!(
            "The sheet bends by {limit} ({sharpest}) at one ruling. The pattern marks it as a bend \
             line."
        ),
        count => format!(
            "The sheet bends by {limit} (up to {sharpest}) at {count} rulings. The pattern marks \
             them as bend lines."
        ),
    };
    format!("{lines} More samples spread the bend over more rulings.")
}

fn cut_open(why: SeamCause) -> &'static str {
    match why {
        SeamCause::NotFlat => "In one piece the panel does not lie flat, so it is cut open",
        SeamCause::Closed => "The panel is closed, so it is cut open",
        SeamCause::Darts => "To stretch less, the panel is cut",
    }
}

fn must_stretch(largest: f64) -> String {
    format!(
        "Laid flat, lengths differ from those on the surface by up to {}: the sheet must stretch \
         by that much.",
        percent(largest)
    )
}

fn takes(sheet: Option<&String>, limit: f64) -> String {
    match sheet {
        Some(sheet) => format!("The limit for {sheet} is {}", percent(limit)),
        None => format!("The limit without a named material is {}", percent(limit)),
    }
}

/// How a mesh is cut or divided so that it stretches less; a sentence without its end.
fn divided(cut: Option<[Point3; 2]>, has_creases: bool) -> String {
    let mut advice = Vec::new();
    if let Some([inside, border]) = cut {
        advice.push(format!("cut it from the border at {} to {}", point(border), point(inside)));
    }
    if has_creases {
        advice.push("divide it along its sharp creases".to_owned());
    }
    advice.push("divide it into more panels in the program that exported it".to_owned());
    first_up(&advice.join(", "))
}

fn reduced(sheets: usize, scale: f64, most: usize, is_full: bool) -> String {
    let too_many = if is_full {
        format!("; the panels before it leave fewer of the {most} that one PDF may have")
    } else if sheets > most {
        format!("; the limit of one PDF is {most}")
    } else {
        String::new()
    };
    let way = way_to_sheets(sheets, is_full).unwrap_or_else(|| {
        "For a pattern that is true to scale, divide the panel, or print the SVG on a roll."
            .to_owned()
    });
    format!(
        "True to scale, this panel takes about {sheets} sheets of paper{too_many}. Therefore \
         pattern.pdf shows it at 1:{scale}, with a table of offsets for marking it out. {way} SVG \
         and DXF are true to scale."
    )
}
