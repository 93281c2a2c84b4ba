//! The warp along the panel: one bar per rung, at the place of the rung on the pattern.

use super::canvas::{Anchor, PathData, Picture, WIDTH, circle, line, rectangle, round_below, text};
use super::flat_picture::{LEFT, RIGHT, scale_of};
use crate::wording::decimal;
use sheetwright::make::Part;
use sheetwright::material::{Material, warp_limit_deg};
use sheetwright::math::{Point2, Vec2, from_deg, to_deg};

const TOP: f64 = 14.0;
const HEIGHT: f64 = 170.0;
const FOOT: f64 = 50.0;
/// The limit stands at this share of the height, unless the worst rung needs more room.
const LIMIT_SHARE: f64 = 0.78;
/// Bars stand on a grid of columns of this width; rungs in one column share its highest bar.
const COLUMN: f64 = 2.0;
/// The most rungs whose bars have heads.
const HEADS: usize = 60;
/// A band lower than this has no room for its name.
const BAND_FOR_TEXT: f64 = 20.0;

/// The warp angle of every rung over its middle's place along the flat pattern, against the
/// material's limit. A bar above it that may come from the sampling looks unsure. `None` without
/// rungs.
pub fn warp_chart(panel: &Part, material: Option<&Material>) -> Option<Picture> {
    if panel.measures.rungs.is_empty() {
        return None;
    }
    let limit = warp_limit_deg(material);
    let most = to_deg(panel.measures.warp_max);
    let top = (limit / LIMIT_SHARE).max(1.08 * most);
    let chart = Chart { panel, limit, top, across: runs_across(panel) };
    let [band, name] = chart.band();
    let mut body = band + &chart.axes() + &chart.bars() + &name;
    body += &chart.limit_line();
    if let Some(worst) = chart.worst_over() {
        body += &circle("ring", chart.place(worst), 6.0);
    }
    Some(Picture::new(
        WIDTH,
        TOP + HEIGHT + FOOT,
        format!("{}: warp of each ruling along the panel", panel.name),
        body,
    ))
}

/// Whether the rungs follow one another across the pattern rather than along it, as on a tube that
/// is longer than wide.
fn runs_across(panel: &Part) -> bool {
    let spread = |of: fn(Point2) -> f64| {
        let places = (0..panel.measures.rungs.len()).map(|rung| of(middle(panel, rung)));
        let (least, most) = places.fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), x| {
            (least.min(x), most.max(x))
        });
        most - least
    };
    spread(|p| p.y) > spread(|p| p.x)
}

/// The middle of a rung, by its number, on the pattern, mm.
fn middle(panel: &Part, rung: usize) -> Point2 {
    let [a, b] = panel.sheet.rung_ends()[rung].map(|s| panel.flat.points[s.get()]);
    a.lerp(b, 0.5)
}

/// The bar of a column.
#[derive(Clone, Copy)]
struct Bar {
    /// The highest head of its rungs.
    head: Point2,
    /// Whether one of them is known to twist by more than the limit.
    is_over: bool,
}

struct Chart<'a> {
    panel: &'a Part,
    /// Degrees.
    limit: f64,
    /// The top of the scale, degrees.
    top: f64,
    /// Whether places are counted across the pattern, from its lower side.
    across: bool,
}

impl Chart<'_> {
    /// The length of the range of places, mm.
    fn span(&self) -> f64 {
        let size = self.panel.piece.size;
        if self.across { size.y } else { size.x }
    }

    fn x(&self, place: f64) -> f64 {
        if self.across {
            return LEFT + (WIDTH - LEFT - RIGHT) / self.span().max(1e-12) * place;
        }
        // As in the picture of the pattern above it.
        let piece = &self.panel.piece;
        LEFT + scale_of(piece) * (place - piece.corner.x)
    }

    fn y(&self, deg: f64) -> f64 {
        TOP + HEIGHT * (1.0 - deg / self.top)
    }

    /// The head of a rung's bar.
    fn place(&self, rung: usize) -> Point2 {
        let measured = &self.panel.measures.rungs[rung];
        let middle = middle(self.panel, rung);
        let x = self.x(if self.across { middle.y } else { middle.x });
        Point2::new(x, self.y(to_deg(measured.warp)))
    }

    /// Whether a rung is known to twist by more than the limit.
    fn is_over(&self, rung: usize) -> bool {
        self.panel.measures.rungs[rung].warp_beyond_sampling() > from_deg(self.limit)
    }

    /// The rung with the largest warp among those above the limit; `None` if there are none.
    fn worst_over(&self) -> Option<usize> {
        let rungs = &self.panel.measures.rungs;
        (0..rungs.len())
            .filter(|&n| self.is_over(n))
            .reduce(|best, n| if rungs[n].warp > rungs[best].warp { n } else { best })
    }

    /// The class of a bar.
    fn class_of(&self, bar: &Bar) -> &'static str {
        if bar.is_over {
            "over"
        } else if bar.head.y < self.y(self.limit) {
            "unsure"
        } else {
            ""
        }
    }

    /// The band above what thick plate takes, and its name, which lies over everything.
    fn band(&self) -> [String; 2] {
        let (right, left) = (WIDTH - RIGHT, LEFT);
        let (low, high) = (self.y(self.limit), self.y(self.top));
        let size = Vec2::new(right - left, low - high);
        let body = rectangle("beyond", Point2::new(left, high), size);
        let at = Point2::new(left + 7.0, 0.5 * (low + high) + 5.0);
        let has_room = size.y >= BAND_FOR_TEXT;
        let name = text("halo band", Anchor::Start, at, "too much for thick plate");
        [body, if has_room { name } else { String::new() }]
    }

    fn axes(&self) -> String {
        let (left, right, bottom) = (LEFT, WIDTH - RIGHT, TOP + HEIGHT);
        let at = Point2::new;
        let mut lines = PathData::default();
        let mut body = String::new();
        let step = round_below(self.top / 3.0);
        let decimals = usize::from(step < 1.0);
        let mut n = 0.0;
        while n * step <= self.top {
            let y = self.y(n * step);
            lines.line([at(left - 5.0, y), at(left, y)]);
            let words = format!("{}°", decimal(n * step, decimals));
            body += &text("", Anchor::End, at(left - 8.0, y + 5.0), &words);
            n += 1.0;
        }
        lines.line([at(left, TOP), at(left, bottom), at(right, bottom)]);
        let length = self.span();
        let (unit, unit_mm) = if length >= 3000.0 { ("m", 1000.0) } else { ("mm", 1.0) };
        let step = round_below(length / 3.0);
        let decimals = usize::from(step < unit_mm);
        let mut n = 0.0;
        while n * step <= length {
            let x = self.x(n * step);
            lines.line([at(x, bottom), at(x, bottom + 5.0)]);
            let words = decimal(n * step / unit_mm, decimals);
            body += &text("", Anchor::Middle, at(x, bottom + 20.0), &words);
            n += 1.0;
        }
        let title = if self.across {
            format!("place across the flat pattern, from below, {unit}")
        } else {
            format!("place along the flat pattern, {unit}")
        };
        let middle = at(0.5 * (left + right), bottom + 41.0);
        lines.element("axis") + &body + &text("quiet", Anchor::Middle, middle, &title)
    }

    fn bars(&self) -> String {
        let bottom = TOP + HEIGHT;
        let rungs = self.panel.measures.rungs.len();
        let mut columns = std::collections::BTreeMap::<i64, Bar>::new();
        for n in 0..rungs {
            let bar = Bar { head: self.place(n), is_over: self.is_over(n) };
            let column = ((bar.head.x - LEFT) / COLUMN).floor() as i64;
            let highest = columns.entry(column).or_insert(bar);
            highest.is_over |= bar.is_over;
            if bar.head.y < highest.head.y {
                highest.head = bar.head;
            }
        }
        let mut body = String::new();
        for class in ["", "unsure", "over"] {
            let mut path = PathData::default();
            for (column, bar) in columns.iter().filter(|(_, bar)| self.class_of(bar) == class) {
                let x = LEFT + COLUMN * (*column as f64 + 0.5);
                // A rung without warp still shows that it is there.
                path.line([Point2::new(x, bottom), Point2::new(x, bar.head.y.min(bottom - 1.0))]);
            }
            body += &path.element(format!("bar {class}").trim_end());
        }
        if rungs <= HEADS {
            for bar in columns.values() {
                let class = format!("head {}", self.class_of(bar));
                body += &circle(class.trim_end(), bar.head, 3.0);
            }
        }
        body
    }

    fn limit_line(&self) -> String {
        let (left, right, y) = (LEFT, WIDTH - RIGHT, self.y(self.limit));
        let words = format!("limit {}°", decimal(self.limit, 1));
        line("limit", &[Point2::new(left, y), Point2::new(right, y)])
            + &text("halo", Anchor::End, Point2::new(right - 5.0, y - 6.0), &words)
    }
}
