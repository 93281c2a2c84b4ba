//! Pictures as SVG text: numbers, paths, letters, and the picture that they make.

use super::style;
use sheetwright::math::{Point2, Vec2};
use std::fmt::Write as _;

/// The width of every picture of a panel, in its own units. A page shows it at 350 to 560 pixels.
pub(super) const WIDTH: f64 = 480.0;
/// The margin of a picture, in its units.
pub(super) const MARGIN: f64 = 16.0;

/// A drawing with a size of its own; its look comes from the classes of the style sheet.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Width in its own units.
    pub width: f64,
    /// Height in its own units.
    pub height: f64,
    /// Its description, for screen readers.
    pub title: String,
    /// SVG elements.
    body: String,
}

impl Picture {
    pub(super) fn new(width: f64, height: f64, title: String, body: String) -> Self {
        Self { width, height, title, body }
    }

    /// The SVG element, for a page that has the style sheet.
    pub fn inline(&self) -> String {
        self.element("", "")
    }

    /// A complete SVG file, with the style sheet and a background of paper, since its page may be
    /// light while the reader's theme is dark.
    pub fn standalone(&self) -> String {
        let size = format!(r#" width="{}" height="{}""#, number(self.width), number(self.height));
        let paper = rectangle("paper", Point2::default(), Vec2::new(self.width, self.height));
        let style = format!("<style>{}</style>{paper}", style::picture_style());
        format!("{}\n", self.element(&size, &style))
    }

    fn element(&self, size: &str, style: &str) -> String {
        format!(
            concat!(
                r#"<svg xmlns="http://www.w3.org/2000/svg" class="pic" role="img"{}"#,
                r#" viewBox="0 0 {} {}" aria-label="{}">{}{}</svg>"#
            ),
            size,
            number(self.width),
            number(self.height),
            escaped(&self.title),
            style,
            self.body
        )
    }
}

/// The gap between pictures that are put together.
const GAP: f64 = 16.0;

/// Several pictures in a row, centred on one line.
pub fn side_by_side(title: &str, pictures: &[Picture]) -> Picture {
    let height = pictures.iter().map(|p| p.height).fold(0.0, f64::max);
    let mut body = String::new();
    let mut left = 0.0;
    for picture in pictures {
        body += &moved(picture, left, 0.5 * (height - picture.height));
        left += picture.width + GAP;
    }
    Picture::new((left - GAP).max(0.0), height, title.to_owned(), body)
}

/// Several pictures in a column, flush on the left.
pub fn stacked(title: &str, pictures: &[Picture]) -> Picture {
    let width = pictures.iter().map(|p| p.width).fold(0.0, f64::max);
    let mut body = String::new();
    let mut top = 0.0;
    for picture in pictures {
        body += &moved(picture, 0.0, top);
        top += picture.height + GAP;
    }
    Picture::new(width, (top - GAP).max(0.0), title.to_owned(), body)
}

fn moved(picture: &Picture, x: f64, y: f64) -> String {
    format!(r#"<g transform="translate({} {})">{}</g>"#, number(x), number(y), picture.body)
}

/// A coordinate with two decimals at the most.
pub(super) fn number(x: f64) -> String {
    debug_assert!(x.is_finite(), "a coordinate of a picture is {x}");
    let text = format!("{x:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// Text escaped for an element or a quoted attribute.
pub(super) fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            // XML does not allow control characters, even escaped.
            c if c.is_control() => out.push(' '),
            c => out.push(c),
        }
    }
    out
}

/// Steps of an SVG path.
#[derive(Clone, Debug, Default)]
pub(super) struct PathData(String);

impl PathData {
    pub(super) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// An open line through some points.
    pub(super) fn line(&mut self, points: impl IntoIterator<Item = Point2>) {
        for (n, p) in points.into_iter().enumerate() {
            let _ = write!(self.0, "{}{}", if n == 0 { 'M' } else { 'L' }, number(p.x));
            let y = number(p.y);
            if !y.starts_with('-') {
                self.0.push(' ');
            }
            self.0.push_str(&y);
        }
    }

    /// A closed line through some points.
    pub(super) fn ring(&mut self, points: impl IntoIterator<Item = Point2>) {
        self.line(points);
        self.0.push('Z');
    }

    /// The path as an element of a class; nothing if it has no steps.
    pub(super) fn element(&self, class: &str) -> String {
        if self.is_empty() {
            return String::new();
        }
        format!(r#"<path class="{class}" d="{}"/>"#, self.0)
    }
}

/// A path element through some points.
pub(super) fn line(class: &str, points: &[Point2]) -> String {
    let mut path = PathData::default();
    path.line(points.iter().copied());
    path.element(class)
}

/// A circle.
pub(super) fn circle(class: &str, at: Point2, radius: f64) -> String {
    let (x, y, r) = (number(at.x), number(at.y), number(radius));
    format!(r#"<circle class="{class}" cx="{x}" cy="{y}" r="{r}"/>"#)
}

/// A rectangle.
pub(super) fn rectangle(class: &str, corner: Point2, size: Vec2) -> String {
    let (x, y, w, h) = (number(corner.x), number(corner.y), number(size.x), number(size.y));
    format!(r#"<rect class="{class}" x="{x}" y="{y}" width="{w}" height="{h}"/>"#)
}

/// Where a text stands relative to its place.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

/// A line of text; its class begins with the anchor's.
pub(super) fn text(class: &str, anchor: Anchor, at: Point2, words: &str) -> String {
    let anchor = match anchor {
        Anchor::Start => "ts",
        Anchor::Middle => "tm",
        Anchor::End => "te",
    };
    let space = if class.is_empty() { "" } else { " " };
    let (x, y) = (number(at.x), number(at.y));
    format!(r#"<text class="{anchor}{space}{class}" x="{x}" y="{y}">{}</text>"#, escaped(words))
}

/// The largest of 1, 2 or 5 times a power of ten that is not above `most`, which is positive.
pub(super) fn round_below(most: f64) -> f64 {
    let mut power = 1.0;
    while power * 10.0 <= most {
        power *= 10.0;
    }
    while power > most {
        power /= 10.0;
    }
    [5.0, 2.0].into_iter().map(|n| n * power).find(|&x| x <= most).unwrap_or(power)
}

/// A horizontal bar of a length with ticks at its ends and its label above.
pub(super) fn scale_bar(right: Point2, length: f64, label: &str) -> String {
    let at = |x: f64, y: f64| Point2::new(x, right.y + y);
    let (a, b) = (right.x - length, right.x);
    let bar = [at(a, -4.0), at(a, 0.0), at(b, 0.0), at(b, -4.0)];
    line("axis", &bar) + &text("", Anchor::Middle, at(0.5 * (a + b), -6.0), label)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        let list = [0.0, -0.001, 1.5, 10.0, -3.256, 100.0];
        assert_eq!(list.map(number), ["0", "0", "1.5", "10", "-3.26", "100"]);
    }

    #[test]
    fn scales_are_round() {
        let list = [0.07, 1.0, 1.99, 4.0, 5.0, 9999.0];
        assert_eq!(list.map(round_below), [0.05, 1.0, 1.0, 2.0, 5.0, 5000.0]);
    }

    #[test]
    fn paths_drop_the_blank_before_a_sign() {
        let mut path = PathData::default();
        path.ring([Point2::new(0.0, -1.0), Point2::new(2.0, 3.25)]);
        assert_eq!(path.element("e"), r#"<path class="e" d="M0-1L2 3.25Z"/>"#);
    }
}
