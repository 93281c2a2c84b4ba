//! Findings in sentences, with advice.

use super::bends::{folds_mitred, sheet_too_thick};
use super::divided::{by, not_divided, piece_of};
use super::healed::{healed, two_skins};
use super::marks::marked;
use super::moved::{keeps_from_bending, listed, movement, not_needed, ran_on};
use super::nets::{no_effect, piece_too_large};
use super::parted::{bends_divided, divided_in_vain};
use super::place::point;
use super::points::points;
use super::read::read_note_text;
use super::trims::trimmed;
use crate::pdf::way_to_sheets;
use crate::wording::share_beyond_words;
use sheetwright::check::{Finding, FindingKind, SeamCause, Verdict};
use sheetwright::elastic::Basis;
use sheetwright::math::{Point3, to_deg};
use sheetwright::measure::SHARP_CREASE_DEG;
use sheetwright::nets::{MEANT_DEG, MOST_FACETS};
use sheetwright::tolerance::Tolerance;

/// Above this share of the radius from which a sheet keeps its bend, it keeps little of it, and the
/// computed radius hardly tells whether it does.
const NEAR_YIELD: f64 = 0.8;
/// A moment below it, N, is not told: no hand feels it.
const LEAST_MOMENT_N: f64 = 0.001;

/// A finding in words with units, and advice: one sentence or more for each kind.
pub fn finding_text(finding: &Finding) -> String {
    use FindingKind as Kind;
    match &finding.kind {
        Kind::Read { note } => read_note_text(note),
        Kind::Trimmed { note } => trimmed(note),
        Kind::Marked { note } => marked(note),
        Kind::StrainTooLarge { strain, limit, sheet, thickest_mm, basis } => format!(
            "{}. {}.{} {} a sheet that stretches more.",
            must_strain(*strain, *basis),
            takes(sheet.as_ref(), &percent_fine(*limit)),
            would_take(*thickest_mm),
            match basis {
                Basis::Pattern => "Divide the panel, or choose",
                _ => "Move the boundary, or choose",
            }
        ),
        Kind::NeedsForce { .. } => needs_force(&finding.kind),
        Kind::Roll { radius_mm, from_mm, sheet } => format!(
            "The sheet is bent to {radius_mm:.0} mm, up to a twentieth of it more tightly. Below \
             {from_mm:.0} mm, {sheet} keeps its bend: roll or form it. Bent by hand it springs back \
             {}.",
            if *radius_mm > NEAR_YIELD * from_mm {
                "nearly all the way, since that is near the limit"
            } else {
                "in part"
            }
        ),
        Kind::CantTell { strain, limit, sheet, basis } => format!(
            "The sheet must stretch by {} to {}, {}. {}, which lies between.",
            percent_fine(strain[0]),
            percent_fine(strain[1]),
            match basis {
                Basis::Computed | Basis::Screen => "by two computations that disagree",
                Basis::NoNet =>
                    "by a formula: its outline can't be divided into triangles, so no sheet was \
                     computed",
                Basis::NoRest => "by a formula: the computed sheet did not come to rest",
                Basis::TooTight =>
                    "by a formula: it is bent more tightly than a computed sheet can tell",
                Basis::Pattern => "by the lengths of the pattern: no sheet could be computed",
            },
            takes(sheet.as_ref(), &percent_fine(*limit))
        ),
        Kind::FoldsNotNeeded { count, sharpest } => format!(
            "The surface that fits best has {count} sharp {} of up to {}, which the sheet does \
             not need: it bends smoothly there. The pattern does not mark {} to be scored.",
            if *count == 1 { "fold" } else { "folds" },
            degrees(*sharpest),
            if *count == 1 { "it" } else { "them" }
        ),
        Kind::RadiusTooSmall { least_mm, limit_mm, sheet, thickest_mm } => format!(
            "The sheet is bent to {least_mm:.1} mm; the limit for {sheet} is {limit_mm:.1} mm.{} \
             Choose a thinner sheet, or draw the boundary rounder.",
            would_take(*thickest_mm)
        ),
        Kind::SheetTooThick { drawn_mm, inside_mm, thickness_mm } => {
            sheet_too_thick(*drawn_mm, *inside_mm, *thickness_mm)
        }
        Kind::RadiusUnsure { least_mm, limit_mm, is_coarse: false, sheet } => format!(
            "The sheet is bent to {least_mm:.1} mm, and the limit for {sheet} is {limit_mm:.1} mm. \
             That is too near to tell. Choose a slightly thinner sheet, or draw the boundary \
             rounder."
        ),
        Kind::RadiusUnsure { least_mm, limit_mm, is_coarse: true, sheet } => format!(
            "The samples are too coarse to tell how tightly the sheet is bent: by them to \
             {least_mm:.1} mm, where the limit for {sheet} is {limit_mm:.1} mm. Use more samples."
        ),
        Kind::Points { count, turn, reach, too_tight } => {
            let reach =
                reach.map(|reach| ([short(reach.reach_mm), short(reach.limit_mm)], reach.folds));
            points(*count == 1, &degrees(*turn), reach, too_tight.as_ref())
        }
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
        Kind::StrainNotReached { wanted, reached } => format!(
            "The strain is {:.0} % of what the sheet takes, and the goal of {:.0} % is not reached \
             within the limits. Let the boundary move farther, or choose a thinner sheet.",
            100.0 * reached,
            100.0 * wanted
        ),
        Kind::BendsDivided { parts, way, strain, verdict } => {
            bends_divided(*parts, *way, &percent_fine(*strain), phrase(*verdict))
        }
        Kind::DividedInVain { most } => divided_in_vain(*most),
        Kind::TwoSurfaces { apart_mm, is_one_pattern: true, .. } => format!(
            "Two surfaces fit this boundary about as well, up to {apart_mm:.1} mm apart, with one \
             pattern: the sheet goes either way."
        ),
        Kind::TwoSurfaces { apart_mm, other, .. } => format!(
            "Two surfaces fit this boundary about as well, up to {apart_mm:.1} mm apart, and the \
             pattern is that of one. The other {}. Only you know which is meant: set the side to \
             \"other\", or name a point that the surface passes near.",
            phrase(*other)
        ),
        Kind::NoOtherSurface => "No other surface fits this boundary about as well: this is the \
                                 only one. Leave the side out."
            .to_owned(),
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
        Kind::FoldedFacets { mountains, valleys, sharpest, stiff } => format!(
            "The net has {} of up to {}. {}",
            folds(*mountains, *valleys),
            degrees(*sharpest),
            match stiff {
                Some(sheet) => format!("{} does not fold.", first_up(sheet)),
                None if *valleys == 0 => "The pattern has them dashed.".to_owned(),
                None => "The pattern dashes mountains; valleys have dashes and dots.".to_owned(),
            }
        ),
        Kind::FacetsMeant { facets, turn, overlaps } => format!(
            "As one surface the mesh would {}. It has {facets} facets, of {MOST_FACETS} at the \
             most, and along half of the lines between them it turns by {} or more, where \
             {MEANT_DEG:.0}° are enough: its facets are meant, and are folded.",
            if *overlaps { "overlap itself on the flat" } else { "not bend" },
            degrees(*turn)
        ),
        Kind::FacetsFew { facets } => format!(
            "Folded between its {facets} facets, the mesh takes its shape without stretching."
        ),
        Kind::NoEffect { settings, is_net } => no_effect(settings, *is_net),
        Kind::PieceTooLarge { size_mm, within_mm, is_facet, is_trimmed } => {
            piece_too_large([*size_mm, *within_mm], *is_facet, *is_trimmed)
        }
        Kind::BendLines { count, sharpest } => bend_lines(*count, *sharpest),
        Kind::LengthError { largest, closes_holes: true } => format!(
            "Lengths in the pattern differ from those on the surface by {}. This lets the \
             holes close when the panel is laid flat.",
            up_to(*largest)
        ),
        Kind::LengthError { largest, closes_holes: false } => format!(
            "Lengths in the pattern differ from those on the surface by {}.",
            share_beyond_words(*largest)
                .map_or_else(|| format!("up to {:.3} %", 100.0 * largest), str::to_owned)
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
        Kind::Divide { cut, has_creases, .. } => {
            format!("{}.", divided(*cut, *has_creases))
        }
        Kind::Stretch { stretch, shrink } => must_stretch(*stretch, *shrink),
        Kind::BorderNotTrue { largest } => format!(
            "The border can't keep its lengths: they differ by {}. Cut the panel open, or \
             divide it.",
            up_to(*largest)
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
        Kind::Healed { damage, count } => healed(*damage, *count),
        Kind::TwoSkins { count, bodies, thickness_mm, laid } => {
            two_skins([*count, *bodies], *thickness_mm, *laid)
        }
        Kind::NotTwoSkins => "One skin of a plate was to be laid flat alone, and the mesh is no \
                              closed plate with two skins. All of it is laid flat."
            .to_owned(),
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
        Kind::UnfairLine { curve, at, fair } => unfair_line(curve, *at, *fair),
        Kind::SplineBulge { curve, at, by_mm } => format!(
            "The spline '{curve}' swings {by_mm:.1} mm beyond its points near {}, where they only \
             rise or only fall. Add a point there, or make one of the two beside it a corner.",
            point(*at)
        ),
        Kind::OffTolerance { .. } => off_tolerance(&finding.kind),
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
        Kind::LinesClose { count, nearest_mm, least_mm } => format!(
            "{} nearer to the one before than half the die opening, {least_mm:.1} mm: as near as \
             {nearest_mm:.1} mm. Take a narrower die or fewer lines, or roll the sheet there.",
            counted(*count, "A bend line comes", "bend lines come"),
        ),
        Kind::LinesLong { count, longest_mm, most_mm } => format!(
            "{} longer than the brake, {most_mm:.0} mm: up to {longest_mm:.0} mm. Divide the part, \
             or take a longer brake.",
            counted(*count, "A bend line is", "bend lines are"),
        ),
        Kind::FlangeShort { count, shortest_mm, least_mm } => format!(
            "Beyond {} the sheet reaches less far than half the die opening, {least_mm:.1} mm: as \
             little as {shortest_mm:.1} mm. It falls into the die. Take a narrower die, or bend a \
             wider sheet and trim it.",
            counted(*count, "a bend line", "bend lines"),
        ),
        Kind::FoldsMitred { count, of, why } => folds_mitred(*count, *of, *why),
        Kind::TooLarge { size_mm, room_mm } => format!(
            "It is {}, and the largest sheet takes {}. Divide it, or take a larger sheet.",
            by(*size_mm),
            by(*room_mm)
        ),
        Kind::NoSheet { is_too_large: true } => {
            "It fits none of the sheets as parts may lie on them. Take another sheet, or a smaller \
             margin."
                .to_owned()
        }
        Kind::NoSheet { is_too_large: false } => {
            "No sheet is left for it. Take more sheets.".to_owned()
        }
        Kind::Divided { piece, division } => piece_of(*piece, division),
        Kind::Strap { joint, width_mm } => format!(
            "A strap, {width_mm:.0} mm wide, that lies behind the butt joint {joint}. The line on \
             it is where the pieces meet."
        ),
        Kind::NotDivided { fault } => {
            format!("It is larger than every sheet and can't be divided: {}", not_divided(*fault))
        }
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
    if let Some(beyond) = share_beyond_words(share) {
        return beyond.to_owned();
    }
    let percent = 100.0 * share;
    format!("{percent:.*} %", decimals_of(percent))
}

/// By how much lengths differ at the most, with two significant digits.
fn up_to(share: f64) -> String {
    let up_to = if share_beyond_words(share).is_some() { "" } else { "up to " };
    format!("{up_to}{}", percent(share))
}

/// A share in per cent, with three significant digits, for what is compared with a limit.
fn percent_fine(share: f64) -> String {
    if let Some(beyond) = share_beyond_words(share) {
        return beyond.to_owned();
    }
    let percent = 100.0 * share;
    format!("{percent:.*} %", decimals_of(percent) + 1)
}

/// A length with two significant digits, down to a picometre.
fn short(mm: f64) -> String {
    format!("{mm:.*}", decimals_of(mm))
}

/// The thickest sheet that would take the shape, if one was found.
fn would_take(thickest_mm: Option<f64>) -> String {
    let words = |mm: f64| format!(" In {} mm it would take the shape.", short_down(mm));
    thickest_mm.map_or(String::new(), words)
}

/// A length with two significant digits, rounded down; one that has two already stays.
fn short_down(mm: f64) -> String {
    let decimals = decimals_of(mm);
    let scale = (0..decimals).fold(1.0, |scale, _| scale * 10.0);
    format!("{:.*}", decimals, (mm * scale * (1.0 + 1e-12)).floor() / scale)
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
            "The sheet bends by {limit} ({sharpest}) at one ruling. Bend it along the bend lines of \
             the pattern."
        ),
        count => format!(
            "The sheet bends by {limit} (up to {sharpest}) at {count} rulings. Bend it along the \
             bend lines of the pattern."
        ),
    };
    format!("{lines} More samples spread the bend over more rulings.")
}

/// The folds of a net, of which there is one.
fn folds(mountains: usize, valleys: usize) -> String {
    let mountain = counted(mountains, "1 mountain fold", "mountain folds");
    let valley = counted(valleys, "1 valley fold", "valley folds");
    match (mountains, valleys) {
        (_, 0) => mountain,
        (0, _) => valley,
        _ => format!("{mountain} and {valley}"),
    }
}

fn cut_open(why: SeamCause) -> &'static str {
    match why {
        SeamCause::NotFlat => "In one piece the panel does not lie flat, so it is cut open",
        SeamCause::Closed => "The panel is closed, so it is cut open",
        SeamCause::Chosen => "As you chose, the panel is cut",
        SeamCause::Darts => "To stretch less, the panel is cut",
        SeamCause::Facets => "So that its facets lie flat, the net is cut open",
    }
}

/// A point that stands out of its line: where, by how much, and the value that would be fair.
fn unfair_line(curve: &str, at: Point3, fair: Point3) -> String {
    let off = at - fair;
    let axes = [("x", at.x, off.x), ("y", at.y, off.y), ("z", at.z, off.z)];
    let largest = axes.into_iter().max_by(|a, b| a.2.abs().total_cmp(&b.2.abs()));
    let (axis, is, off) = largest.unwrap_or(axes[0]);
    format!(
        "The line '{curve}' is not fair at x = {:.1} mm: its {axis} there is {is:.1} mm, and the \
         points around lead to about {:.1} mm, {:.1} mm {}. Check this value; a table has slips.",
        at.x + 0.0,
        is - off + 0.0,
        off.abs(),
        if off > 0.0 { "less" } else { "more" }
    )
}

/// How far the outline lies from its curves, beside its tolerance.
fn off_tolerance(kind: &FindingKind) -> String {
    let FindingKind::OffTolerance {
        distance_mm,
        shorter_mm,
        tolerance_mm,
        samples,
        is_rails,
        is_usual,
        is_most,
    } = kind
    else {
        return String::new();
    };
    let most = match (*is_most, *is_usual) {
        (true, true) => ", the most that a panel gets unless it says how many",
        (true, false) => ", the most that a tolerance gives",
        (false, _) => "",
    };
    let advice = if *is_usual {
        "a ten-thousandth of its size would be {tolerance}. Set a tolerance or a number of samples \
         if that is too far."
    } else {
        "the tolerance is {tolerance}. Set a larger one or a number of samples, or divide the panel."
    };
    format!(
        "The outline is a polygon through {samples} samples{}{most}. Its curves lie up to {} mm from \
         it, and along an edge it is up to {} mm shorter; {}",
        if *is_rails { " of each rail" } else { "" },
        short(*distance_mm),
        short(*shorter_mm),
        advice.replace("{tolerance}", &format!("{} mm", short(*tolerance_mm))),
    )
}

/// By how much the sheet must stretch to take its shape; a sentence without its end.
fn must_strain(strain: f64, basis: Basis) -> String {
    let how = match basis {
        Basis::Computed | Basis::Pattern => "must",
        Basis::Screen => "probably must",
        Basis::NoNet | Basis::NoRest | Basis::TooTight => {
            "must, by a formula that is true within a factor of 2.2,"
        }
    };
    let strain = percent_fine(strain);
    format!("To take this shape, the sheet {how} stretch by {strain} within its plane")
}

fn needs_force(kind: &FindingKind) -> String {
    let FindingKind::NeedsForce { strain, limit, outer_fibre, sheet, moment_n, is_formed, basis } =
        kind
    else {
        return String::new();
    };
    // The larger of both shares decides.
    let bend = match outer_fibre {
        Some([bent, most]) if bent / most > strain / limit => Some((*bent, *most)),
        _ => None,
    };
    let why = match bend {
        Some((bent, most)) => format!(
            "Its outer fibre stretches by {}{}; the limit for {} is {}",
            if bent > most { "about " } else { "" },
            percent(bent),
            or_any_sheet(sheet),
            percent(most)
        ),
        None => {
            format!(
                "{}. {}",
                must_strain(*strain, *basis),
                takes(sheet.as_ref(), &percent_fine(*limit))
            )
        }
    };
    let moment = moment_n.filter(|&moment| moment >= LEAST_MOMENT_N);
    let (bending, hold) = if *is_formed { ("Forming", "form") } else { ("Bending", "hold") };
    let moment = moment.map_or(String::new(), |moment| {
        let moment = short(moment);
        format!(" To {hold} it takes a moment of about {moment} N·m for each metre of edge.")
    });
    format!("{bending} needs force. {why}.{moment}")
}

fn must_stretch(stretch: f64, shrink: f64) -> String {
    if stretch.is_infinite() {
        return "From the pattern to the surface, no stretch is enough: a triangle of the pattern \
                has no area, or lies upside down."
            .to_owned();
    }
    let ways = [("grow", stretch), ("shrink", shrink)].into_iter();
    let seen = ways.filter(|(_, share)| *share > 1e-6);
    let said: Vec<String> = seen.map(|(way, share)| format!("{way} by {}", up_to(share))).collect();
    format!("From the pattern to the surface, lengths {}.", said.join(" and "))
}

/// The limit of a sheet, in per cent; a sentence without its end.
fn takes(sheet: Option<&String>, limit: &str) -> String {
    match sheet {
        Some(sheet) => format!("The limit for {sheet} is {limit}"),
        None => format!("The limit without a named material is {limit}"),
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
    first_up(&advice.join(", or "))
}

fn reduced(sheets: u64, scale: f64, most: usize, is_full: bool) -> String {
    let too_many = if is_full {
        format!("; the panels before it leave fewer of the {most} that one PDF may have")
    } else if sheets > most as u64 {
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

/// What the other of two surfaces does.
fn phrase(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Bends => "bends",
        Verdict::BendsWithForce => "bends with force",
        Verdict::Roll => "must be rolled",
        Verdict::BendsAndFolds => "bends and folds",
        Verdict::Undecided => "may bend or not",
        Verdict::WillNotBend => "will not bend",
    }
}
