//! The parts that were divided to fit the sheets, in `report.html`: a picture each, with its joints
//! and the names of its pieces.

use super::canvas::{Anchor, PathData, Picture, WIDTH, text};
use crate::words::division_sentence;
use maud::{Markup, PreEscaped, html};
use sheetwright::make::{DividedPart, Made};
use sheetwright::math::{Point2, Vec2};
use sheetwright::predicate::Box2;

/// The most parts with a picture.
const MOST_PICTURES: usize = 24;
/// No picture is higher than this, in its units.
const MOST_HIGH: f64 = 320.0;
/// The room around a part in its picture.
const AROUND: f64 = 10.0;
/// The height of letters, and their width as a share of it.
const LETTERS: f64 = 12.0;
const LETTER: f64 = 0.62;

/// The section about divided parts; nothing where there are none.
pub(super) fn divided(made: &Made) -> Markup {
    let count = made.divided.len();
    html! {
        @if count > 0 {
            section.divided {
                h2 { "Divided parts" }
                div.panel {
                    @for part in made.divided.iter().take(MOST_PICTURES) {
                        figure {
                            (PreEscaped(picture(part).inline()))
                            figcaption { (part.name) " " (division_sentence(&part.division)) }
                        }
                    }
                }
                @if count > MOST_PICTURES {
                    p.sub { "Of " (count) " parts, the first " (MOST_PICTURES) " are shown." }
                }
            }
        }
    }
}

/// A part as it was, with its pieces. A piece that has no room for its name has its number.
fn picture(part: &DividedPart) -> Picture {
    let loops = || part.pieces.iter().flat_map(|(_, loops)| loops);
    let around = Box2::of_points(loops().flatten().copied());
    let (low, high) = around.map_or_else(Default::default, |around| (around.min, around.max));
    let size = high - low;
    let across = (WIDTH - 2.0 * AROUND) / size.x.max(1e-9);
    let scale = across.min((MOST_HIGH - 2.0 * AROUND) / size.y.max(1e-9));
    let (width, height) = (WIDTH, scale * size.y + 2.0 * AROUND);
    let left = 0.5 * (width - scale * size.x);
    let place = |p: &Point2| {
        Point2::new(left + scale * (p.x - low.x), height - AROUND - scale * (p.y - low.y))
    };
    let mut lines = PathData::default();
    loops().for_each(|line| lines.ring(line.iter().map(place)));
    let mut body = lines.element("sheet") + &lines.element("cut thin");
    for (n, (name, loops)) in part.pieces.iter().enumerate() {
        let Some(outline) = loops.first() else { continue };
        let Some(around) = Box2::of_points(outline.iter().copied()) else { continue };
        let at = place(&centroid(outline));
        let room = scale * (around.max.x - around.min.x);
        let wide = LETTER * LETTERS * name.chars().count() as f64;
        let name = if wide <= room { name.clone() } else { (n + 1).to_string() };
        body += &text("", Anchor::Middle, Point2::new(at.x, at.y + 0.35 * LETTERS), &name);
    }
    Picture::new(width, height, format!("{} with its pieces", part.name), body)
}

/// The centroid of what a closed line goes around.
fn centroid(line: &[Point2]) -> Point2 {
    let Some(&first) = line.first() else { return Point2::default() };
    let (mut sum, mut area) = (Vec2::ZERO, 0.0);
    for pair in line.windows(2) {
        let [a, b] = [pair[0] - first, pair[1] - first];
        let doubled = a.perp_dot(b);
        (sum, area) = (sum + (a + b) * doubled, area + doubled);
    }
    if area == 0.0 { first } else { first + sum * (1.0 / (3.0 * area)) }
}
