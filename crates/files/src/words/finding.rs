//! What was found, in sentences, with what to do.

use super::moved::{keeps_from_bending, listed, movement, not_needed, ran_on};
use super::place::point;
use crate::pdf::way_to_sheets;
use sheetwright::check::{Finding, FindingKind, SeamCause, TooTight};
use sheetwright::math::{Point3, to_deg};
use sheetwright::measure::SHARP_CREASE_DEG;
use sheetwright::tolerance::Tolerance;

/// What is so, in words with units, and what to do: a sentence or more for each kind.
pub fn finding_text(finding: &Finding) -> String {
    use FindingKind as Kind;
    match &finding.kind {
        Kind::WarpTooLarge { largest, count, of, limit, sheet } => format!(
            "The surface twists by up to {} along its rulings, at {count} of {of} of them by more \
             than the {} that {} takes. Move the boundary there, or divide the panel.",
            degrees(*largest),
            degrees(*limit),
            or_a_sheet(sheet)
        ),
        Kind::WarpHigh { largest, limit, sheet } => format!(
            "The surface twists by up to {} along its rulings, and {} takes {}: it needs force.",
            degrees(*largest),
            or_a_sheet(sheet),
            degrees(*limit)
        ),
        Kind::CoarseSamples { largest } => format!(
            "Rungs turn by up to {}, which may be the bend from one sample to the next or twist: \
             these samples are too coarse to tell. Ask for more.",
            degrees(*largest)
        ),
        Kind::RadiusTooSmall { least_mm, limit_mm, sheet } => format!(
            "The panel is bent to a radius of {least_mm:.1} mm, and {sheet} takes {limit_mm:.1} mm. \
             Take a thinner sheet, or a rounder boundary."
        ),
        Kind::Points { count, turn, too_tight } => points(*count == 1, *turn, too_tight.as_ref()),
        Kind::SelfCrossing => "The surface passes through itself in space. Ask for a supporting \
                               plane, or change the boundary."
            .to_owned(),
        Kind::Overlap => "Laid flat, the pattern overlaps itself, so it can't be cut from one \
                          sheet. Divide the panel."
            .to_owned(),
        Kind::RungWithoutPlane { count } => format!(
            "{} along the boundary's own direction, where no tangent plane is given, and no \
             surface does without {}. More samples may help.",
            counted(*count, "One rung runs", "rungs run"),
            if *count == 1 { "it" } else { "them" }
        ),
        Kind::BetterWithoutPlane { with, without } => format!(
            "Seen along its normal the boundary is a simple outline, so the surface was laid over \
             that plane. Where it may wrap round or hang over, there is one that bends better, at \
             {:.0} % of the price: ask for the plane \"none\".",
            100.0 * without / with
        ),
        Kind::NotProven { gap, cut_short } => not_proven(*gap, *cut_short),
        Kind::Folds { count, sharpest, stiff } => format!(
            "The surface has {count} sharp {}, of up to {}, where it can't bend smoothly. {}",
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
            "The mesh has sharp creases, of up to {}, along {count} of its sides. {}",
            degrees(*sharpest),
            match stiff {
                Some(sheet) => format!("{} does not fold: divide it there.", first_up(sheet)),
                None => "The pattern marks them to be scored.".to_owned(),
            }
        ),
        Kind::BendLines { count, sharpest } => bend_lines(*count, *sharpest),
        Kind::LengthError { largest, closes_holes: true } => format!(
            "Lengths of the pattern differ from the surface by up to {}, so that its holes close \
             when it is laid flat.",
            percent(*largest)
        ),
        Kind::LengthError { largest, closes_holes: false } => format!(
            "Lengths of the pattern differ from the surface by up to {:.3} %.",
            100.0 * largest
        ),
        Kind::WindowGap { widest_mm } => format!(
            "Round a hole the panel lies flat but for a gap of {widest_mm:.2} mm. Closing it would \
             change lengths by more than {} %, so the pattern is cut from edge to edge there.",
            Tolerance::STRETCH.share() * 100.0
        ),
        Kind::Seams { count, length_mm, why } => format!(
            "{} along {}, {length_mm:.1} mm long{}. Join the sides that have the same mark.",
            cut_open(*why),
            counted(*count, "a seam", "seams"),
            if *count == 1 { "" } else { " together" }
        ),
        Kind::StretchTooLarge { largest, limit, sheet, cut, has_creases, .. } => format!(
            "{} {}. {}, or take a sheet that stretches more.",
            must_stretch(*largest),
            takes(sheet.as_ref(), *limit),
            divided(*cut, *has_creases)
        ),
        Kind::StretchHigh { largest, limit, sheet } => {
            format!("{} {}.", must_stretch(*largest), takes(sheet.as_ref(), *limit))
        }
        Kind::Stretch { largest } => must_stretch(*largest),
        Kind::BorderNotTrue { largest } => format!(
            "The border was to keep its lengths, and could not: they differ by up to {}. Cut the \
             panel open, or divide it.",
            percent(*largest)
        ),
        Kind::Flipped { count } => format!(
            "Laid flat, {} upside down: the pattern is folded over itself there. Divide the panel.",
            counted(*count, "a triangle lies", "triangles lie")
        ),
        Kind::TrianglesLeftOut { count } => format!(
            "{} of the file with two corners in one place, without area, {} left out.",
            counted(*count, "A triangle", "triangles"),
            if *count == 1 { "was" } else { "were" }
        ),
        Kind::PartsLeftOut { count } => format!(
            "{} left out: smaller than 1e-6 mm, or narrower than 1e-12 of the size of the file.",
            counted(*count, "A part of the mesh was", "parts of the mesh were")
        ),
        Kind::PointContacts { count } => format!(
            "Parts of the mesh meet in {} alone, where nothing would hold them: they are taken \
             apart there.",
            counted(*count, "a point", "points")
        ),
        Kind::RoundedCorner { curve, turn } => format!(
            "The points of the curve '{curve}' turn by up to {:.0}°, and the spline runs round \
             there. If that is a corner, mark it as one.",
            to_deg(*turn)
        ),
        Kind::JointsSmoothed { count, deviation_mm } => format!(
            "The boundary was made smooth at {} where joined panels meet, and lies up to \
             {deviation_mm:.2} mm from theirs.",
            counted(*count, "one place", "places")
        ),
        Kind::RanOn { bulges_mm, bends } => ran_on(&finding.kind, *bulges_mm, *bends),
        Kind::StayedStraight { cause } => format!(
            "The rails can't run on: with the ends that they would get, {cause}. The ends of the \
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
            "{}. The {} that were asked for are not reached within the limits: {ended}. Let the \
             boundary move farther, or draw it with less twist.",
            movement(moved),
            degrees(*wanted)
        ),
        Kind::Refold { error_mm, limit_mm } => format!(
            "Folded up again, the written pattern misses the surface by {error_mm:.3} mm \
             ({limit_mm:.2e} mm is allowed). {FAULT}"
        ),
        Kind::NotReadBack { cause } => format!("{}. {FAULT}", first_up(cause)),
        Kind::QuadsOffBoundary { off_mm } => format!(
            "So that all quads are planar, their vertices leave the boundary by up to {} mm. \
             Sliding along it alone did not do: the panel is not quite developable.",
            short(*off_mm)
        ),
        Kind::QuadsNotPlanar { uneven_mm, off_mm: Some(off_mm) } => format!(
            "The quads are not planar: diagonals are up to {} mm apart. They would be with \
             vertices {} mm off the boundary, which is more than a thousandth of the size.",
            short(*uneven_mm),
            short(*off_mm)
        ),
        Kind::QuadsNotPlanar { uneven_mm, off_mm: None } => format!(
            "The quads could not be made planar: diagonals are up to {} mm apart.",
            short(*uneven_mm)
        ),
        Kind::PdfReduced { sheets, scale, most, is_full } => {
            reduced(*sheets, *scale, *most, *is_full)
        }
    }
}

/// What is to be done where a written file is wrong.
const FAULT: &str = "Do not cut it; this is a fault of the program.";

fn degrees(angle: f64) -> String {
    format!("{:.1}°", to_deg(angle))
}

/// A number with this many decimals that show two digits of it, and no more than nine.
fn decimals_of(x: f64) -> usize {
    let shifted = std::iter::successors(Some(x), |x| Some(x * 10.0));
    shifted.take(9).take_while(|x| *x < 10.0).count()
}

/// A share in per cent, with two digits that count.
fn percent(share: f64) -> String {
    let percent = 100.0 * share;
    format!("{percent:.*} %", decimals_of(percent))
}

/// A length with two digits that count, down to a picometre.
fn short(mm: f64) -> String {
    format!("{mm:.*}", decimals_of(mm))
}

/// One thing, or how many of them.
fn counted(count: usize, one: &str, more: &str) -> String {
    if count == 1 { one.to_owned() } else { format!("{count} {more}") }
}

fn first_up(text: &str) -> String {
    let mut chars = text.chars();
    chars.next().map_or_else(String::new, |c| c.to_uppercase().chain(chars).collect())
}

fn or_a_sheet(sheet: &Option<String>) -> &str {
    sheet.as_deref().unwrap_or("a sheet")
}

fn points(is_one: bool, turn: f64, too_tight: Option<&TooTight>) -> String {
    let begin = match (too_tight, is_one) {
        (None, true) => "Bend the corner in steps: bend lines run together in it",
        (None, false) => "Bend the corners in steps: bend lines run together in them",
        (Some(_), true) => "Bend lines run together in a point",
        (Some(_), false) => "Bend lines run together in points",
    };
    let advice = match too_tight {
        Some(TooTight { sheet, limit_mm, needed_mm }) => format!(
            "{} takes a radius of {limit_mm:.1} mm, and there it would have to take \
             {needed_mm:.1} mm. Cut the point off, or move the boundary there.",
            first_up(sheet)
        ),
        None => format!(
            "The bend radius in this report leaves {} out.",
            if is_one { "it" } else { "them" }
        ),
    };
    format!("{begin} and turn the sheet by up to {} there. {advice}", degrees(turn))
}

fn not_proven(gap: Option<f64>, cut_short: bool) -> String {
    let better = match gap {
        Some(gap) => {
            format!("A better one may exist, with a price up to {:.2} % lower", 100.0 * gap)
        }
        None => "A better one may exist; how much lower its price may be is not known".to_owned(),
    };
    let how = if cut_short {
        " The search ended with the work that it may do; a greater \"effort\" of the panel allows \
         more."
    } else {
        ""
    };
    format!(
        "This is the best surface that was found. {better}; the pattern is exact for this one.{how}"
    )
}

fn bend_lines(count: usize, sharpest: f64) -> String {
    let (limit, sharpest) = (format!("more than {SHARP_CREASE_DEG:.0}°"), degrees(sharpest));
    let lines = match count {
        1 => format!(
            "One ruling turns by {limit} ({sharpest}); the pattern marks it as a line to bend along."
        ),
        count => format!(
            "{count} rulings turn by {limit} (up to {sharpest}); the pattern marks them as lines to \
             bend along."
        ),
    };
    format!("{lines} More samples divide the bend more finely.")
}

fn cut_open(why: SeamCause) -> &'static str {
    match why {
        SeamCause::NotFlat => "In one piece it does not lie flat, so it is cut open",
        SeamCause::Closed => "It is closed, so it is cut open",
        SeamCause::Darts => "To stretch less, it is cut",
    }
}

fn must_stretch(largest: f64) -> String {
    format!(
        "Laid flat, lengths differ from the surface by up to {}: by so much the sheet must stretch.",
        percent(largest)
    )
}

fn takes(sheet: Option<&String>, limit: f64) -> String {
    match sheet {
        Some(sheet) => format!("{} takes {}", first_up(sheet), percent(limit)),
        None => format!("Without a material that is named, {} is accepted", percent(limit)),
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
    advice.push("divide it into more panels in the program that it is from".to_owned());
    first_up(&advice.join(", "))
}

fn reduced(sheets: usize, scale: f64, most: usize, is_full: bool) -> String {
    let too_many = if is_full {
        format!(", for which the panels before it leave no room among the {most} of one PDF")
    } else if sheets > most {
        format!("; {most} are the most that a PDF takes")
    } else {
        String::new()
    };
    let way = way_to_sheets(sheets, is_full).unwrap_or_else(|| {
        "For a pattern at true size, divide the panel, or print the SVG on a roll.".to_owned()
    });
    format!(
        "True to scale, this panel would take about {sheets} sheets of paper{too_many}. So \
         pattern.pdf shows it at 1:{scale} with a table of offsets to mark it out by. {way} SVG and \
         DXF are true to scale."
    )
}
