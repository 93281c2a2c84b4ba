//! One page: lines and text in millimetres from its lower left corner.

use super::text::{encoded, width};
use pdf_writer::{Buf, Content, Name, Str};
use sheetwright::math::{Point2, Vec2};
use sheetwright::predicate::{Box2, signed_area_doubled};

/// The margin of a page, mm: few printers leave a wider edge blank.
pub(super) const MARGIN_MM: f64 = 10.0;
/// The strip above the window for the name of the page and the scale bar, mm.
pub(super) const HEADER_MM: f64 = 16.0;

/// The name of Helvetica on a page.
pub(crate) const REGULAR: Name<'static> = Name(b"F1");
/// The name of Helvetica Bold on a page.
pub(crate) const BOLD: Name<'static> = Name(b"F2");

/// A length in PDF points, 1/72 inch, from mm. PDF coordinates have about seven digits, which is
/// 1e-5 mm on a page.
pub(crate) fn points(mm: f64) -> f32 {
    (mm * (72.0 / 25.4)) as f32
}

/// A colour of lines.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Ink {
    /// 0 is black, 1 is white.
    Grey(f32),
    /// Red, green and blue, from 0 to 1.
    Colour([f32; 3]),
}

/// How a line is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pen {
    width_mm: f64,
    ink: Ink,
    /// Lengths of a dash and of a gap in turn, mm; none of a solid line.
    dash_mm: &'static [f64],
}

impl Pen {
    pub(crate) const CUT: Self = Self { width_mm: 0.35, ink: Ink::Grey(0.0), dash_mm: &[] };
    pub(crate) const SCORE: Self =
        Self { width_mm: 0.25, ink: Ink::Grey(0.0), dash_mm: &[3.0, 1.5] };
    /// A fold towards the viewer; one away from the viewer is drawn as every score.
    pub(crate) const VALLEY: Self =
        Self { width_mm: 0.25, ink: Ink::Grey(0.0), dash_mm: &[4.0, 1.5, 0.3, 1.5] };
    /// The outline of the finished piece, below the folds and cuts that run along it.
    pub(crate) const NET: Self = Self { width_mm: 0.15, ink: Ink::Grey(0.5), dash_mm: &[] };
    pub(crate) const ENGRAVE: Self = Self { width_mm: 0.2, ink: Ink::Grey(0.25), dash_mm: &[] };
    pub(crate) const NOTE: Self = Self { width_mm: 0.1, ink: Ink::Grey(0.7), dash_mm: &[] };
    /// Crosses, check squares and scale bars.
    pub(crate) const MARK: Self = Self { width_mm: 0.15, ink: Ink::Grey(0.0), dash_mm: &[] };
    /// The frame of the part that a page shows.
    pub(crate) const FRAME: Self = Self { width_mm: 0.1, ink: Ink::Grey(0.6), dash_mm: &[] };
    /// The outline of a part in space, and of one that stands back.
    pub(crate) const OUTLINE: Self = Self { width_mm: 0.3, ink: Ink::Grey(0.05), dash_mm: &[] };
    pub(crate) const FAINT: Self = Self { width_mm: 0.15, ink: Ink::Grey(0.55), dash_mm: &[] };
    /// An outline behind other parts.
    pub(crate) const HIDDEN: Self =
        Self { width_mm: 0.2, ink: Ink::Grey(0.05), dash_mm: &[1.2, 1.0] };
    /// An edge that is joined.
    pub(crate) const JOINED: Self =
        Self { width_mm: 0.8, ink: Ink::Colour([0.78, 0.25, 0.0]), dash_mm: &[] };
    /// A distance to measure in space.
    pub(crate) const MEASURE: Self =
        Self { width_mm: 0.3, ink: Ink::Colour([0.78, 0.25, 0.0]), dash_mm: &[2.0, 1.0] };
    /// Lines of tables, and lines to write on.
    pub(crate) const RULE: Self = Self { width_mm: 0.15, ink: Ink::Grey(0.75), dash_mm: &[] };
    /// Where sheets meet.
    pub(crate) const SEAM: Self = Self { width_mm: 0.1, ink: Ink::Grey(0.5), dash_mm: &[0.5, 1.5] };
}

/// The point of a text that lies at the given place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Anchor {
    Start,
    Middle,
    End,
}

/// How a text is set.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Type {
    pub(crate) size_pt: f64,
    pub(crate) bold: bool,
    pub(crate) anchor: Anchor,
    /// Whether it runs upwards.
    pub(crate) upwards: bool,
}

impl Type {
    pub(crate) const fn new(size_pt: f64) -> Self {
        Self { size_pt, bold: false, anchor: Anchor::Start, upwards: false }
    }

    pub(crate) const fn bold(self) -> Self {
        Self { bold: true, ..self }
    }

    pub(crate) const fn at(self, anchor: Anchor) -> Self {
        Self { anchor, ..self }
    }

    pub(crate) const fn upwards(self) -> Self {
        Self { upwards: true, ..self }
    }
}

/// A page that is being drawn.
pub(crate) struct PdfPage {
    size: Vec2,
    /// Whether it is turned by a quarter when it is finished.
    turned: bool,
    content: Content,
    /// The pen that the page's content has set last.
    pen: Option<Pen>,
}

impl PdfPage {
    /// An empty page of a size, mm.
    pub(crate) fn new(size: Vec2) -> Self {
        let mut content = Content::new();
        // Mitred joins would draw spikes where an outline turns sharply.
        content
            .set_line_join(pdf_writer::types::LineJoinStyle::RoundJoin)
            .set_line_cap(pdf_writer::types::LineCapStyle::RoundCap);
        Self { size, turned: false, content, pen: None }
    }

    /// An empty page of a size, mm, that is turned by a quarter when it is finished: its left side
    /// is then below.
    pub(super) fn turned(size: Vec2) -> Self {
        let mut page = Self::new(size);
        page.turned = true;
        page.content.transform([0.0, 1.0, -1.0, 0.0, points(size.y), 0.0]);
        page
    }

    /// An empty page of a size, mm, turned or not.
    pub(super) fn of(size: Vec2, turned: bool) -> Self {
        if turned { Self::turned(size) } else { Self::new(size) }
    }

    /// Width and height, mm.
    pub(crate) fn size(&self) -> Vec2 {
        self.size
    }

    /// Width and height as printed, mm, and the content.
    pub(crate) fn finish(self) -> (Vec2, Buf) {
        let Vec2 { x, y } = self.size;
        let printed = if self.turned { Vec2::new(y, x) } else { self.size };
        (printed, self.content.finish())
    }

    fn take(&mut self, pen: Pen) {
        if self.pen == Some(pen) {
            return;
        }
        self.pen = Some(pen);
        self.content.set_line_width(points(pen.width_mm));
        match pen.ink {
            Ink::Grey(grey) => self.content.set_stroke_gray(grey),
            Ink::Colour([r, g, b]) => self.content.set_stroke_rgb(r, g, b),
        };
        self.content.set_dash_pattern(pen.dash_mm.iter().copied().map(points), 0.0);
    }

    /// Draws polylines.
    pub(crate) fn lines(&mut self, lines: &[Vec<Point2>], pen: Pen) {
        if lines.is_empty() {
            return;
        }
        self.take(pen);
        for line in lines {
            for (n, point) in line.iter().enumerate() {
                let (x, y) = (points(point.x), points(point.y));
                if n == 0 {
                    self.content.move_to(x, y)
                } else {
                    self.content.line_to(x, y)
                };
            }
            self.content.stroke();
        }
    }

    /// Draws one straight line.
    pub(crate) fn line(&mut self, from: Point2, to: Point2, pen: Pen) {
        self.lines(&[vec![from, to]], pen);
    }

    /// Draws a rectangle.
    pub(crate) fn rectangle(&mut self, around: Box2, pen: Pen) {
        self.take(pen);
        self.path(around);
        self.content.stroke();
    }

    fn path(&mut self, around: Box2) {
        let size = around.max - around.min;
        self.content.rect(
            points(around.min.x),
            points(around.min.y),
            points(size.x),
            points(size.y),
        );
    }

    /// Fills polygons in a colour, red, green and blue from 0 to 255, as one path. A thin line of
    /// the colour closes the gap that readers leave to the next path.
    pub(crate) fn fill<'a>(&mut self, polygons: impl Iterator<Item = &'a [Point2]>, rgb: [f64; 3]) {
        const GAP_MM: f64 = 0.12;
        let [r, g, b] = rgb.map(|part| (part / 255.0) as f32);
        self.pen = None;
        self.content.set_fill_rgb(r, g, b).set_stroke_rgb(r, g, b);
        self.content.set_line_width(points(GAP_MM)).set_dash_pattern([], 0.0);
        for polygon in polygons {
            // All run one way, so that those that overlap do not leave a hole.
            let is_left = signed_area_doubled(polygon) >= 0.0;
            let corner = |n: usize| polygon[if is_left { n } else { polygon.len() - 1 - n }];
            for n in 0..polygon.len() {
                // A hundredth of a point, which keeps pictures small.
                let rounded = |mm: f64| (points(mm) * 100.0).round() / 100.0;
                let (x, y) = (rounded(corner(n).x), rounded(corner(n).y));
                if n == 0 {
                    self.content.move_to(x, y)
                } else {
                    self.content.line_to(x, y)
                };
            }
            self.content.close_path();
        }
        self.content.fill_nonzero_and_stroke();
        // Letters are filled too, and are black.
        self.content.set_fill_gray(0.0);
    }

    /// Calls `draw`, and clips its drawing to a rectangle.
    pub(crate) fn clipped(&mut self, to: Box2, draw: impl FnOnce(&mut Self)) {
        let pen = self.pen;
        self.content.save_state();
        self.path(to);
        self.content.clip_nonzero().end_path();
        draw(self);
        self.content.restore_state();
        self.pen = pen;
    }

    /// Writes a line of text. `at` is the start, the middle or the end of its base line, as `set`
    /// says.
    pub(crate) fn text(&mut self, at: Point2, text: &str, set: Type) {
        let encoded = encoded(text);
        // Bold letters are wider than those of the table, by less than a tenth.
        let length_mm = width(&encoded) * set.size_pt * (25.4 / 72.0);
        let back = match set.anchor {
            Anchor::Start => 0.0,
            Anchor::Middle => 0.5 * length_mm,
            Anchor::End => length_mm,
        };
        let along = if set.upwards { Vec2::Y } else { Vec2::X };
        let start = at + along * -back;
        let (c, s) = (along.x as f32, along.y as f32);
        self.content
            .begin_text()
            .set_font(if set.bold { BOLD } else { REGULAR }, set.size_pt as f32)
            .set_text_matrix([c, s, -s, c, points(start.x), points(start.y)])
            .show(Str(&encoded))
            .end_text();
    }

    /// Writes a line of text no longer than `most_mm`, in smaller letters if need be.
    pub(crate) fn fitted_text(&mut self, at: Point2, text: &str, set: Type, most_mm: f64) {
        let length_mm = width(&encoded(text)) * set.size_pt * (25.4 / 72.0);
        let size_pt = set.size_pt * (most_mm / length_mm).min(1.0);
        self.text(at, text, Type { size_pt, ..set });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pen_is_taken_once_and_only_where_something_is_drawn() {
        let at = Point2::new;
        let mut page = PdfPage::new(Vec2::new(210.0, 297.0));
        page.lines(&[], Pen::NOTE);
        page.line(at(0.0, 0.0), at(1.0, 0.0), Pen::CUT);
        page.clipped(Box2 { min: at(0.0, 0.0), max: at(9.0, 9.0) }, |page| {
            page.line(at(0.0, 1.0), at(1.0, 1.0), Pen::CUT);
            page.line(at(0.0, 2.0), at(1.0, 2.0), Pen::SCORE);
        });
        // After the clip, the pen from before it is set again.
        page.line(at(0.0, 3.0), at(1.0, 3.0), Pen::CUT);
        page.line(at(0.0, 4.0), at(1.0, 4.0), Pen::SCORE);
        let (_, content) = page.finish();
        let content = String::from_utf8(content.to_vec()).unwrap();
        let greys: Vec<&str> = content.lines().filter(|line| line.ends_with(" G")).collect();
        assert_eq!(greys, ["0 G", "0 G", "0 G"]);
        assert_eq!(content.matches("] 0 d").count(), 3);
    }
}
