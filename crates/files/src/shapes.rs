//! The shapes in SVG and DXF files of a piece: its paths, its texts as strokes, and beside it a
//! square of 100 mm by which a shop checks the scale.

use crate::stroke_font::strokes;
use sheetwright::math::{Point2, Vec2, unit2};
use sheetwright::pattern::{LabelKind, PathKind, PatternLabel, Piece, Role};
use sheetwright::predicate::Box2;
use sheetwright::rung::Rung;

/// The side of the reference square, mm.
pub(crate) const REFERENCE_MM: f64 = 100.0;
/// The gap between the piece with its dimensions and the reference square, mm.
const REFERENCE_GAP_MM: f64 = 20.0;
/// The height of the letters in the reference square, mm.
const CAPTION_MM: f64 = 8.0;

/// The kind of a shape.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum What {
    Outline,
    Hole,
    Net,
    /// A round hole.
    Drill {
        centre: Point2,
        radius_mm: f64,
    },
    Notch,
    /// A tick inside an edge, to match edges by.
    TrimTick,
    Rung(Rung),
    Crease,
    Fold {
        mountain: bool,
    },
    Bend {
        up: bool,
    },
    BendTick,
    SeamTick,
    LapEnd,
    Dimension,
    Station,
    Grain,
    OnFold,
    Arrow,
    Leader,
    /// The edge of a sheet that parts lie on.
    SheetEdge,
    /// A text; the lines of the shape are its strokes.
    Label(String),
    /// The reference square.
    Reference,
}

/// Lines of one role that together draw one item.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Shape {
    pub(crate) role: Role,
    pub(crate) what: What,
    /// Polylines, mm.
    pub(crate) lines: Vec<Vec<Point2>>,
    /// Whether each of them ends where it begins.
    pub(crate) closed: bool,
}

/// A line as a file has it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct FileLine {
    /// Its corners, mm; of a circle, its centre.
    pub(crate) points: Vec<Point2>,
    pub(crate) form: Form,
    /// The bulge of the side from each corner to the next: the tangent of a quarter of the angle of
    /// an arc, positive counter-clockwise, 0 of a straight side. Empty if all are straight.
    pub(crate) bulges: Vec<f64>,
}

/// How a line of a file runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Form {
    Open,
    /// From the last corner to the first one, too.
    Closed,
    /// A whole circle.
    Circle {
        radius_mm: f64,
    },
}

impl FileLine {
    pub(crate) fn polyline(points: Vec<Point2>, closed: bool) -> Self {
        let form = if closed { Form::Closed } else { Form::Open };
        Self { points, form, bulges: Vec::new() }
    }

    pub(crate) fn circle(centre: Point2, radius_mm: f64) -> Self {
        Self { points: vec![centre], form: Form::Circle { radius_mm }, bulges: Vec::new() }
    }

    /// A closed line that runs along an open one and back.
    pub(crate) fn there_and_back(line: &[Point2]) -> Self {
        let back = line.iter().rev().skip(1).take(line.len().saturating_sub(2));
        Self::polyline(line.iter().chain(back).copied().collect(), true)
    }

    /// A rectangle along each side of a line, so that the line is as wide as this when all are
    /// filled.
    pub(crate) fn areas(line: &[Point2], closed: bool, width_mm: f64) -> Vec<Self> {
        let sides = line.len() - usize::from(!closed && line.len() > 1);
        let area = |n: usize| {
            let (from, to) = (line[n], line[(n + 1) % line.len()]);
            // A dot has no direction.
            let along = unit2(to - from).unwrap_or(Vec2::X) * (0.5 * width_mm);
            let across = along.perp();
            let (before, beyond) = (from + -along, to + along);
            let corners = [before + -across, beyond + -across, beyond + across, before + across];
            Self::polyline(corners.to_vec(), true)
        };
        (0..sides).map(area).collect()
    }

    /// The number of corners and the form, without sizes: what two lines have in common that are
    /// to be one.
    pub(crate) fn is_like(&self, other: &Self) -> bool {
        let same = std::mem::discriminant(&self.form) == std::mem::discriminant(&other.form);
        same && self.points.len() == other.points.len()
    }

    /// How far it is from a line that is like it and moved by `to_other`, mm.
    pub(crate) fn off_mm(&self, other: &Self, to_other: Vec2) -> f64 {
        let off = |(a, b): (&Point2, &Point2)| (*a + to_other).distance(*b);
        let corners = self.points.iter().zip(&other.points).map(off);
        let radii = match (self.form, other.form) {
            (Form::Circle { radius_mm: a }, Form::Circle { radius_mm: b }) => (a - b).abs(),
            _ => 0.0,
        };
        // An arc rises over half of its chord by its bulge.
        let bulge = |line: &Self, n: usize| line.bulges.get(n).copied().unwrap_or(0.0);
        let rises = (0..self.points.len()).map(|n| {
            let half_mm = 0.5 * self.points[n].distance(self.points[(n + 1) % self.points.len()]);
            (bulge(self, n) - bulge(other, n)).abs() * half_mm
        });
        corners
            .chain(rises)
            .fold(radii, |worst, off| if off > worst || off.is_nan() { off } else { worst })
    }
}

/// The mean of the corners of a closed line.
fn middle(points: &[Point2]) -> Point2 {
    let sum: Vec2 = points.iter().map(|p| p.to_vec()).sum();
    Point2::default() + sum * (1.0 / points.len().max(1) as f64)
}

/// Everything that a file of the piece shows, in the coordinates of the piece.
pub(crate) fn shapes(piece: &Piece) -> Vec<Shape> {
    let mut shapes: Vec<Shape> = piece
        .paths
        .iter()
        .map(|path| Shape {
            role: path.role,
            what: match path.kind {
                PathKind::Outline => What::Outline,
                PathKind::Hole => What::Hole,
                PathKind::Net => What::Net,
                PathKind::Drill { diameter_mm } => {
                    What::Drill { centre: middle(&path.points), radius_mm: 0.5 * diameter_mm }
                }
                PathKind::Notch => What::Notch,
                PathKind::TrimFold { mountain } => What::Fold { mountain },
                PathKind::TrimTick => What::TrimTick,
                PathKind::Rung(rung) => What::Rung(rung),
                PathKind::Crease => What::Crease,
                PathKind::Fold { mountain } => What::Fold { mountain },
                PathKind::Bend { up } => What::Bend { up },
                PathKind::BendTick => What::BendTick,
                PathKind::SeamTick => What::SeamTick,
                PathKind::LapEnd => What::LapEnd,
                PathKind::Dimension => What::Dimension,
                PathKind::Station => What::Station,
                PathKind::Grain => What::Grain,
                PathKind::OnFold => What::OnFold,
                PathKind::Arrow => What::Arrow,
                PathKind::Leader => What::Leader,
                PathKind::SheetEdge => What::SheetEdge,
            },
            lines: vec![path.points.clone()],
            closed: path.closed,
        })
        .collect();
    shapes.extend(piece.labels.iter().map(label));
    let around = extent(&shapes);
    // Whole millimetres, so that its sides are 100 mm in every digit.
    let x = (around.max.x + REFERENCE_GAP_MM).ceil();
    let y = around.min.y.floor();
    shapes.extend(reference(Point2::new(x, y)));
    shapes
}

fn label(label: &PatternLabel) -> Shape {
    Shape {
        role: label.role,
        what: What::Label(label.text.clone()),
        lines: strokes(&label.text, label.at, label.along, label.height_mm),
        closed: false,
    }
}

/// The reference square, with its lower left corner at `corner`, and its caption.
fn reference(corner: Point2) -> [Shape; 2] {
    let side = REFERENCE_MM;
    let square = [(0.0, 0.0), (side, 0.0), (side, side), (0.0, side)];
    let square = square.map(|(x, y)| corner + Vec2::new(x, y)).to_vec();
    let caption = PatternLabel {
        kind: LabelKind::Length,
        role: Role::Note,
        at: corner + Vec2::new(0.5 * side, 0.5 * (side - CAPTION_MM)),
        along: Vec2::X,
        height_mm: CAPTION_MM,
        text: format!("{side} × {side} mm"),
    };
    let square =
        Shape { role: Role::Note, what: What::Reference, lines: vec![square], closed: true };
    [square, label(&caption)]
}

/// The box around all lines, mm.
pub(crate) fn extent<'a>(shapes: impl IntoIterator<Item = &'a Shape>) -> Box2 {
    let points = shapes.into_iter().flat_map(|shape| shape.lines.iter().flatten().copied());
    Box2::of_points(points).unwrap_or(Box2 { min: Point2::default(), max: Point2::default() })
}

/// A coordinate in the fewest digits that give the same number back, without an exponent.
pub(crate) fn digits(x: f64) -> String {
    // Adding 0 turns −0 into 0.
    format!("{}", x + 0.0)
}
