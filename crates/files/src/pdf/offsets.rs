//! A piece that is too large for sheets: one drawing to a stated scale, and a table of offsets.
//!
//! Boat builders never had paper patterns of planks. They set off stations along a base line,
//! measure the heights of the edges at each, and bend a batten through the points.

use super::drawn::cut_around as around;
use super::page::{Anchor, HEADER_MM, MARGIN_MM, PdfPage, Pen, Type};
use super::piece::{Detail, PaperView, draw};
use super::sheets::header;
use super::{Paper, Reduced, way_to_sheets};
use sheetwright::math::{Point2, Vec2, angle_between, from_deg};
use sheetwright::pattern::{LabelKind, Piece};
use sheetwright::predicate::Box2;

/// The drawing is no higher than this, mm; the rest of the page is for the table.
const DRAWING_MM: f64 = 90.0;
/// The gap between the piece and its frame, mm on the page.
const AIR_MM: f64 = 2.0;
/// The height of a row of the table, mm.
const ROW_MM: f64 = 4.3;
/// The least step between stations is the length of the piece divided by this.
const MAX_STATIONS: f64 = 30.0;
/// Where the outline turns by more than this, degrees, its corner is listed.
const CORNER_DEG: f64 = 15.0;
/// The most corners in the list: as many as the table has rows.
const MAX_CORNERS: usize = 30;
/// Heights that differ by less than this are listed as one, mm: half of the last printed digit.
const SAME_HEIGHT_MM: f64 = 0.05;

/// The denominator of the scale of the drawing, such as 400 for 1:400: the largest usual scale at
/// which the piece fits.
pub(super) fn scale(piece: &Piece, paper: Paper) -> f64 {
    let box_of = around(piece);
    let size = box_of.max - box_of.min;
    let room =
        Vec2::new(paper.overview_mm().x - 2.0 * MARGIN_MM, DRAWING_MM) - Vec2::splat(2.0 * AIR_MM);
    round_up((size.x / room.x).max(size.y / room.y), &[1.0, 2.0, 2.5, 4.0, 5.0])
}

/// The least product of one of `steps` and a power of ten that is not below `x`, and at least the
/// first step.
fn round_up(x: f64, steps: &[f64]) -> f64 {
    let powers = std::iter::successors(Some(1.0), |power| Some(power * 10.0));
    // Every finite number is below the last of them.
    let rounded = powers.take(310).flat_map(|power| steps.iter().map(move |step| step * power));
    rounded.into_iter().find(|&step| step >= x).unwrap_or(f64::INFINITY)
}

/// The page of a piece.
pub(super) fn page(piece: &Piece, reduced: &Reduced, paper: Paper) -> PdfPage {
    let mut page = PdfPage::new(paper.overview_mm());
    let size = page.size();
    let scale = reduced.scale;
    let Box2 { min, max } = around(piece);
    let air = Vec2::splat(AIR_MM * scale);
    let rounded = |p: Point2| {
        let digits = |x: f64| (x * 1000.0).round() / 1000.0;
        Point2::new(digits(p.x), digits(p.y))
    };
    let shown = Box2 { min: rounded(min + -air), max: rounded(max + air) };
    let height_mm = (shown.max.y - shown.min.y) / scale;
    let top = size.y - MARGIN_MM - HEADER_MM;
    let corner = Point2::new(MARGIN_MM, top - height_mm);
    let view = PaperView { shown, corner, scale };
    header(&mut page, &piece.name, "reduced", "drawn smaller than it is", &view);

    let step = round_up((max.x - min.x) / MAX_STATIONS, &[1.0, 2.0, 2.5, 5.0]);
    let stations: Vec<f64> = stations(min.x, max.x, step);
    for (n, &x) in stations.iter().enumerate() {
        let (below, above) = (Point2::new(x, shown.min.y), Point2::new(x, shown.max.y));
        page.line(view.place(below), view.place(above), Pen::NOTE);
        if n % 5 == 0 {
            let at = view.place(below) + Vec2::new(0.0, -3.0);
            page.text(at, &format!("{x:.0}"), Type::new(6.5).at(Anchor::Middle));
        }
    }
    draw(&mut page, piece, &view, Detail::Lines);
    for edge in piece.labels.iter().filter(|label| label.kind == LabelKind::Edge) {
        page.text(view.place(edge.at), &edge.text, Type::new(6.5).at(Anchor::Middle));
    }
    page.rectangle(view.frame(), Pen::FRAME);
    table(&mut page, piece, &stations, corner.y - 11.0, reduced);
    page
}

/// The x of the stations, mm: every multiple of `step`, and the end.
fn stations(from: f64, to: f64, step: f64) -> Vec<f64> {
    let first = (from / step).ceil();
    let whole = (0..=MAX_STATIONS as u32).map(|n| (first + f64::from(n)) * step);
    whole.take_while(|&x| x < to).chain([to]).collect()
}

/// The heights at which the outline and the holes pass a station, mm, the lowest first.
fn heights<'a>(loops: impl Iterator<Item = &'a [Point2]>, x: f64) -> Vec<f64> {
    let mut heights: Vec<f64> = Vec::new();
    let edges = |line: &'a [Point2]| {
        line.iter().enumerate().map(move |(n, a)| (a, line[(n + 1) % line.len()]))
    };
    for (a, b) in loops.flat_map(edges) {
        if a.x.min(b.x) <= x && x <= a.x.max(b.x) {
            if a.x == b.x {
                heights.extend([a.y, b.y]);
            } else {
                heights.push(a.lerp(b, (x - a.x) / (b.x - a.x)).y);
            }
        }
    }
    heights.sort_by(f64::total_cmp);
    heights.dedup_by(|a, b| *a - *b < SAME_HEIGHT_MM);
    heights
}

/// The points where a loop turns by more than `CORNER_DEG`, mm.
pub(crate) fn corners(outline: &[Point2]) -> Vec<Point2> {
    let m = outline.len();
    let turns = |n: &usize| {
        let (before, at, after) = (outline[(n + m - 1) % m], outline[*n], outline[(n + 1) % m]);
        let turn = angle_between((at - before).extend(0.0), (after - at).extend(0.0));
        turn > from_deg(CORNER_DEG)
    };
    (0..m).filter(turns).map(|n| outline[n]).collect()
}

fn table(page: &mut PdfPage, piece: &Piece, stations: &[f64], top: f64, reduced: &Reduced) {
    let left = MARGIN_MM;
    let right_column = page.size().x - MARGIN_MM - 55.0;
    let told = format!(
        "At 1:1 this piece takes about {} sheets. Mark it out by these offsets instead: x \
         along a base line, y square to it, in mm.",
        reduced.sheets
    );
    let most_mm = page.size().x - 2.0 * left;
    page.fitted_text(Point2::new(left, top), &told, Type::new(9.0), most_mm);
    let top = top - 4.6;
    let way = way_to_sheets(reduced.sheets, reduced.file_full)
        .unwrap_or("SVG and DXF are true to scale.".to_owned());
    page.fitted_text(Point2::new(left, top), &way, Type::new(9.0), most_mm);
    let head = Type::new(9.0).bold();
    let first_row = top - 7.0;
    let end = |x: f64| left + 18.0 + x;
    page.text(Point2::new(end(0.0), first_row), "station x", head.at(Anchor::End));
    page.text(Point2::new(end(6.0), first_row), "edges at y", head);
    page.text(Point2::new(right_column, first_row), "corners at x, y", head);
    let number = Type::new(8.5).at(Anchor::End);
    // Counts the heights that do not fit beside the corners; most stations of a plank have two.
    let fit = ((right_column - end(0.0)) / 20.0) as usize - 1;
    for (n, &x) in stations.iter().enumerate() {
        let y = first_row - ROW_MM * (n + 1) as f64;
        page.text(Point2::new(end(0.0), y), &format!("{x:.1}"), number);
        let heights = heights(piece.loops(), x);
        for (column, height) in heights.iter().take(fit).enumerate() {
            let at = Point2::new(end(20.0 * (column + 1) as f64), y);
            page.text(at, &format!("{height:.1}"), number);
        }
        if heights.len() > fit {
            let at = Point2::new(end(20.0 * fit as f64 + 3.0), y);
            page.text(at, &format!("and {} more", heights.len() - fit), Type::new(8.5));
        }
    }
    let corners: Vec<Point2> = piece.loops().flat_map(corners).collect();
    for (n, corner) in corners.iter().take(MAX_CORNERS).enumerate() {
        let y = first_row - ROW_MM * (n + 1) as f64;
        page.text(Point2::new(right_column + 20.0, y), &format!("{:.1}", corner.x), number);
        page.text(Point2::new(right_column + 42.0, y), &format!("{:.1}", corner.y), number);
    }
    if corners.len() > MAX_CORNERS {
        let y = first_row - ROW_MM * (MAX_CORNERS + 1) as f64;
        let more = format!("and {} more, see SVG or DXF", corners.len() - MAX_CORNERS);
        page.text(Point2::new(right_column, y), &more, Type::new(8.5));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stations_and_scales_are_round() {
        assert_eq!(round_up(372.0, &[1.0, 2.0, 2.5, 4.0, 5.0]), 400.0);
        assert_eq!(round_up(0.2, &[1.0, 2.0, 5.0]), 1.0);
        assert_eq!(round_up(f64::NAN, &[1.0]), f64::INFINITY);
        assert_eq!(stations(0.0, 5200.0, 2500.0), [0.0, 2500.0, 5000.0, 5200.0]);
        assert_eq!(stations(0.0, 5000.0, 2500.0), [0.0, 2500.0, 5000.0]);
    }

    #[test]
    fn offsets_are_the_heights_of_the_edges() {
        let outline: Vec<Point2> = [(0.0, 1.0), (4.0, 0.0), (4.0, 3.0), (0.0, 2.0)]
            .iter()
            .map(|&(x, y)| Point2::new(x, y))
            .collect();
        assert_eq!(heights(std::iter::once(&outline[..]), 0.0), [1.0, 2.0]);
        assert_eq!(heights(std::iter::once(&outline[..]), 2.0), [0.5, 2.5]);
        assert_eq!(corners(&outline).len(), 4);
    }
}
