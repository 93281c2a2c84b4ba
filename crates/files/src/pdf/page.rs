//! One page: lines and text in millimetres from its lower left corner.

use super::text::{encoded, width};
use pdf_writer::{Buf, Content, Name, Str};
use sheetwright::math::{Point2, Vec2};
use sheetwright::predicate::Box2;

/// The margin of a page, mm: few printers leave a wider edge blank.
pub(super) const MARGIN_MM: f64 = 10.0;
/// The strip above the window for the name of the page and the scale bar, mm.
pub(super) const HEADER_MM: f64 = 16.0;

/// The name of Helvetica on a page.
pub(super) const REGULAR: Name<'static> = Name(b"F1");
/// The name of Helvetica Bold on a page.
pub(super) const BOLD: Name<'static> = Name(b"F2");

/// A length in PDF points, 1/72 inch, from mm. PDF coordinates have about seven digits, which is
/// 1e-5 mm on a page.
pub(super) fn points(mm: f64) -> f32 {
    (mm * (72.0 / 25.4)) as f32
}

/// How a line is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pen {
    width_mm: f64,
    /// 0 is black, 1 is white.
    grey: f32,
    /// Lengths of a dash and of a gap in turn, mm; none of a solid line.
    dash_mm: &'static [f64],
}

impl Pen {
    pub(super) const CUT: Self = Self { width_mm: 0.35, grey: 0.0, dash_mm: &[] };
    pub(super) const SCORE: Self = Self { width_mm: 0.25, grey: 0.0, dash_mm: &[3.0, 1.5] };
    /// A fold towards the viewer; one away from the viewer is drawn as every score.
    pub(super) const VALLEY: Self =
        Self { width_mm: 0.25, grey: 0.0, dash_mm: &[4.0, 1.5, 0.3, 1.5] };
    pub(super) const ENGRAVE: Self = Self { width_mm: 0.2, grey: 0.25, dash_mm: &[] };
    pub(super) const NOTE: Self = Self { width_mm: 0.1, grey: 0.7, dash_mm: &[] };
    /// Crosses, check squares and scale bars.
    pub(super) const MARK: Self = Self { width_mm: 0.15, grey: 0.0, dash_mm: &[] };
    /// The frame of the part that a page shows.
    pub(super) const FRAME: Self = Self { width_mm: 0.1, grey: 0.6, dash_mm: &[] };
    /// Where sheets meet.
    pub(super) const SEAM: Self = Self { width_mm: 0.1, grey: 0.5, dash_mm: &[0.5, 1.5] };
}

/// The point of a text that lies at the given place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

/// How a text is set.
#[derive(Clone, Copy, Debug)]
pub(super) struct Type {
    pub(super) size_pt: f64,
    pub(super) bold: bool,
    pub(super) anchor: Anchor,
    /// Whether it runs upwards.
    pub(super) upwards: bool,
}

impl Type {
    pub(super) const fn new(size_pt: f64) -> Self {
        Self { size_pt, bold: false, anchor: Anchor::Start, upwards: false }
    }

    pub(super) const fn bold(self) -> Self {
        Self { bold: true, ..self }
    }

    pub(super) const fn at(self, anchor: Anchor) -> Self {
        Self { anchor, ..self }
    }

    pub(super) const fn upwards(self) -> Self {
        Self { upwards: true, ..self }
    }
}

/// A page that is being drawn.
pub(super) struct PdfPage {
    size: Vec2,
    /// Whether it is turned by a quarter when it is finished.
    turned: bool,
    content: Content,
    /// The pen that the page's content has set last.
    pen: Option<Pen>,
}

impl PdfPage {
    /// An empty page of a size, mm.
    pub(super) fn new(size: Vec2) -> Self {
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
    pub(super) fn size(&self) -> Vec2 {
        self.size
    }

    /// Width and height as printed, mm, and the content.
    pub(super) fn finish(self) -> (Vec2, Buf) {
        let Vec2 { x, y } = self.size;
        let printed = if self.turned { Vec2::new(y, x) } else { self.size };
        (printed, self.content.finish())
    }

    fn take(&mut self, pen: Pen) {
        if self.pen == Some(pen) {
            return;
        }
        self.pen = Some(pen);
        self.content.set_line_width(points(pen.width_mm)).set_stroke_gray(pen.grey);
        self.content.set_dash_pattern(pen.dash_mm.iter().copied().map(points), 0.0);
    }

    /// Draws polylines.
    pub(super) fn lines(&mut self, lines: &[Vec<Point2>], pen: Pen) {
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
    pub(super) fn line(&mut self, from: Point2, to: Point2, pen: Pen) {
        self.lines(&[vec![from, to]], pen);
    }

    /// Draws a rectangle.
    pub(super) fn rectangle(&mut self, around: Box2, pen: Pen) {
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

    /// Calls `draw`, and clips its drawing to a rectangle.
    pub(super) fn clipped(&mut self, to: Box2, draw: impl FnOnce(&mut Self)) {
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
    pub(super) fn text(&mut self, at: Point2, text: &str, set: Type) {
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
    pub(super) fn fitted_text(&mut self, at: Point2, text: &str, set: Type, most_mm: f64) {
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
