//! Reads written patterns back and folds them up again.

use crate::arcs::Arcs;
use crate::dxf::dxf_lines;
use crate::preset::{Layer, Preset};
use crate::read_back::{
    Lines, PatternReadError, ReadLine, ReadPattern, overlapping_pattern, pattern,
};
use crate::shapes::{FileLine, Form, Shape, What, shapes};
use crate::svg::{svg_lines, write_svg_for};
use sheetwright::check::{Finding, refolding};
use sheetwright::design::BendMarks;
use sheetwright::flatten::{RefoldError, refold};
use sheetwright::make::{Found, Origin, Part};
use sheetwright::math::Point2;
use sheetwright::pattern::{PatternPath, Piece, Role};
use sheetwright::predicate::Box2;
use sheetwright::rung::Rung;
use sheetwright::tolerance::Tolerance;
use std::fmt;

/// Why a written pattern could not be folded up again.
#[derive(Clone, Debug, PartialEq)]
pub enum RefoldFileError {
    /// It can't be read.
    Read(PatternReadError),
    /// Its lines are not those of the panel.
    Lines,
    /// A point is not where it was laid.
    Moved {
        /// By how much, mm.
        by_mm: f64,
    },
    /// It can't be folded.
    Fold(RefoldError),
}

impl fmt::Display for RefoldFileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Read(error) => write!(f, "the written pattern can't be read: {error}"),
            Self::Lines => {
                write!(f, "the lines of the written pattern differ from those of the panel")
            }
            Self::Moved { by_mm } => {
                write!(f, "the written pattern has a point that is {by_mm:.6} mm off")
            }
            Self::Fold(error) => write!(f, "the written pattern can't be folded: {error}"),
        }
    }
}

impl std::error::Error for RefoldFileError {}

/// The refold error of the written files of a part, mm: the largest of the given files. Without a
/// file it writes an SVG in memory and reads that, so that the answer always rests on a file. For a
/// found surface it folds the pattern up, along the rungs of the surface, of which the pattern must
/// show those that it is to show, and compares vertices in space. A stretched pattern does
/// not fold up again, so for a mesh it compares the outline and the holes with the flat pattern.
///
/// # Errors
/// A file that can't be read or folded, or that has a point off its place by more than the
/// tolerance.
pub fn refold_error_mm(
    part: &Part,
    svg: Option<&[u8]>,
    dxf: Option<&[u8]>,
) -> Result<f64, RefoldFileError> {
    let preset = Preset::generic();
    refold_files_error_mm(part, &PatternFiles { svg, dxf, preset, arcs_mm: None })
}

/// The files of a pattern that were written.
#[derive(Clone, Copy, Debug)]
pub struct PatternFiles<'a> {
    /// The bytes of its SVG.
    pub svg: Option<&'a [u8]>,
    /// The bytes of its DXF.
    pub dxf: Option<&'a [u8]>,
    /// The preset that both are written for.
    pub preset: &'static Preset,
    /// How near the arcs of the DXF stay to the cut lines, mm, if it has arcs.
    pub arcs_mm: Option<f64>,
}

/// As [`refold_error_mm`], for the files of any preset.
///
/// # Errors
/// See [`refold_error_mm`].
pub fn refold_files_error_mm(
    part: &Part,
    files: &PatternFiles<'_>,
) -> Result<f64, RefoldFileError> {
    refold_piece_error_mm(part, &part.piece, files)
}

/// As [`refold_files_error_mm`], where the pattern was written with more texts than that of the
/// part.
pub(crate) fn refold_piece_error_mm(
    part: &Part,
    piece: &Piece,
    files: &PatternFiles<'_>,
) -> Result<f64, RefoldFileError> {
    match &part.origin {
        Origin::Found(found) => folded_error_mm(part, piece, found, files),
        Origin::Given(_) => {
            let overlaps = part.flat.overlap.is_some();
            let [error_mm, others_mm] = read_back_error_mm(piece, overlaps, files)?;
            let by_mm = error_mm.max(others_mm);
            let is_off = by_mm > Tolerance::REFOLD.length_mm(part.piece.size.length());
            if is_off { Err(RefoldFileError::Moved { by_mm }) } else { Ok(error_mm) }
        }
    }
}

fn folded_error_mm(
    part: &Part,
    piece: &Piece,
    found: &Found,
    files: &PatternFiles<'_>,
) -> Result<f64, RefoldFileError> {
    let rungs = part.sheet.rungs();
    let shown = rungs_to_show(part);
    let overlapping = part.flat.overlap.map(|_| &shown[..]);
    let read = read_patterns(piece, overlapping, files)?;
    read.iter().try_fold(0.0, |worst: f64, (pattern, off_mm)| {
        let lines = std::iter::once(&pattern.outline).chain(&pattern.holes).map(Vec::len);
        if !lines.eq(part.sheet.loops().iter().map(Vec::len)) {
            return Err(RefoldFileError::Lines);
        }
        let off = |(read, laid): (&Point2, &Point2)| read.distance(*laid);
        let by_mm = pattern.points().iter().zip(&part.flat.points).map(off).fold(*off_mm, f64::max);
        // A bend line may lie on a rung that is not drawn as one.
        if !shown.iter().all(|rung| pattern.rungs.binary_search(rung).is_ok()) {
            return Err(RefoldFileError::Fold(RefoldError::Rungs));
        }
        let error_mm =
            refold(&part.sheet, &pattern.points(), &rungs).map_err(RefoldFileError::Fold)?;
        // Closing windows allows a larger refold error, which must not hide a moved point.
        let allowed_mm = Tolerance::REFOLD.length_mm(found.boundary.size());
        if by_mm > allowed_mm && error_mm <= known_miss_mm(part) + allowed_mm {
            return Err(RefoldFileError::Moved { by_mm });
        }
        // Unlike `max`, this keeps NaN.
        Ok(if error_mm > worst || error_mm.is_nan() { error_mm } else { worst })
    })
}

/// The rungs of the sheet that the pattern is to show, in increasing order: where it is scored, or
/// all of them.
fn rungs_to_show(part: &Part) -> Vec<Rung> {
    if part.bends.marks == BendMarks::Rulings {
        return part.sheet.rungs();
    }
    let cut: Vec<Rung> = part.sheet.seams().iter().map(|seam| part.sheet.seam_rung(seam)).collect();
    let measured = part.sheet.rung_ends().iter().zip(&part.measures.rungs);
    let scored = measured.filter(|(_, rung)| rung.is_scored && !cut.contains(&rung.rung));
    let mut rungs: Vec<Rung> = scored.map(|(&[a, b], _)| Rung::new(a.get(), b.get())).collect();
    rungs.sort_unstable();
    rungs
}

/// The finding that the written files of a part differ from its surface; `None` if `error_mm` is
/// within the tolerance.
pub(crate) fn refold_finding(part: &Part, error_mm: f64) -> Option<Finding> {
    refolding(error_mm, part.found()?.boundary.size(), known_miss_mm(part))
}

/// The largest distance of the points of the outline and holes, read back, from the flat pattern,
/// mm: over the given files, or of an SVG in memory. Then that of other lines from where the piece
/// has them. `overlaps` says whether the pattern is known to overlap itself.
///
/// # Errors
/// A file that can't be read, or has other lines than the piece.
fn read_back_error_mm(
    piece: &Piece,
    overlaps: bool,
    files: &PatternFiles<'_>,
) -> Result<[f64; 2], RefoldFileError> {
    let (mut worst, mut others_mm) = (0.0f64, 0.0f64);
    for (pattern, off_mm) in read_patterns(piece, overlaps.then_some(&[][..]), files)? {
        others_mm = others_mm.max(off_mm);
        let lines = std::iter::once(&pattern.outline).chain(&pattern.holes);
        let mut laid = piece.net_loops();
        for line in lines {
            let of_piece = laid.next().filter(|laid| laid.len() == line.len());
            let of_piece = of_piece.ok_or(RefoldFileError::Lines)?;
            let off = line.iter().zip(of_piece).map(|(read, laid)| read.distance(*laid));
            worst = off.fold(worst, f64::max);
        }
        if laid.next().is_some() {
            return Err(RefoldFileError::Lines);
        }
    }
    Ok([worst, others_mm])
}

/// Checks that files have the lines of a piece, each within the tolerance of its place, whatever
/// its outline folds up to.
///
/// # Errors
/// A file that can't be read, that has other lines, or one whose lines are off.
pub(crate) fn check_lines(piece: &Piece, files: &PatternFiles<'_>) -> Result<(), RefoldFileError> {
    let [lines_mm, others_mm] = read_back_error_mm(piece, true, files)?;
    let by_mm = lines_mm.max(others_mm);
    let is_off = by_mm > Tolerance::REFOLD.length_mm(piece.size.length());
    if is_off { Err(RefoldFileError::Moved { by_mm }) } else { Ok(()) }
}

/// The lines of a file, or why it can't be read.
type LinesOfFile = Result<Vec<ReadLine>, PatternReadError>;

/// The patterns of the files of a piece, read back. For a pattern that overlaps itself,
/// `overlapping` has the rungs to look for, since its lines alone do not tell outline, holes and
/// rungs apart. Rungs that the preset does not draw as lines are those of the piece. With each
/// pattern comes how far its other lines are off, mm.
fn read_patterns(
    piece: &Piece,
    overlapping: Option<&[Rung]>,
    files: &PatternFiles<'_>,
) -> Result<Vec<(ReadPattern, f64)>, RefoldFileError> {
    let preset = files.preset;
    let mut read: Vec<(LinesOfFile, Option<f64>)> = Vec::new();
    read.extend(files.svg.map(|bytes| (svg_lines(bytes, preset), None)));
    read.extend(files.dxf.map(|bytes| (dxf_lines(bytes, preset), files.arcs_mm)));
    if read.is_empty() {
        read.push((svg_lines(&write_svg_for(piece, preset), preset), None));
    }
    let laid: Vec<Point2> = piece.net_loops().flatten().copied().collect();
    let shapes = shapes(piece);
    let is_hidden = |path: &&PatternPath| !preset.draws_lines(path.role);
    let hidden = piece.paths.iter().filter(is_hidden).filter_map(PatternPath::rung);
    let hidden: Vec<Rung> = hidden.collect();
    let pattern_of = |(lines, arcs_mm): (LinesOfFile, _)| {
        let lines = lines.map_err(RefoldFileError::Read)?;
        let arcs = Option::map(arcs_mm, |mm| Arcs::of(&shapes, mm));
        let (lines, off_mm) = sorted(&lines, &shapes, preset, arcs.as_ref())?;
        let read = match overlapping {
            Some(rungs) => overlapping_pattern(lines, &laid, rungs),
            None => pattern(lines),
        };
        let mut read = read.map_err(RefoldFileError::Read)?;
        read.rungs.extend(&hidden);
        read.rungs.sort_unstable();
        read.rungs.dedup();
        Ok((read, off_mm))
    };
    read.into_iter().map(pattern_of).collect()
}

/// The lines of a file, each with the shape that it draws, told apart into outline, holes, net and
/// segments, in the order of the piece. Every line of the piece must be there, on its layer and in
/// the order of the preset, and nothing else. Also how far lines are off that are not folded up,
/// mm: where cut lines have arcs, those of the file must be the ones that are fitted to the piece,
/// and the line of the piece, from which they were fitted within the tolerance, is folded up.
fn sorted(
    read: &[ReadLine],
    shapes: &[Shape],
    preset: &Preset,
    arcs: Option<&Arcs>,
) -> Result<(Lines, f64), RefoldFileError> {
    let fitted = |shape: &Shape, line| match arcs {
        Some(arcs) => arcs.fitted(shape, line),
        None => line,
    };
    let drawn =
        preset.lines(shapes).map(|(layer, shape, line)| (layer, shape, fitted(shape, line)));
    let drawn: Vec<(&Layer, &Shape, FileLine)> = drawn.collect();
    let is_like = |(read, (layer, _, line)): (&ReadLine, &(&Layer, &Shape, FileLine))| {
        read.layer == *layer && read.line.is_like(line)
    };
    if read.len() != drawn.len() || !read.iter().zip(&drawn).all(is_like) {
        return Err(RefoldFileError::Lines);
    }
    let corner = |points: &mut dyn Iterator<Item = Point2>| {
        Box2::of_points(points).map_or(Point2::default(), |around| around.min)
    };
    let to_piece = corner(&mut drawn.iter().flat_map(|(.., line)| line.points.iter().copied()))
        - corner(&mut read.iter().flat_map(|read| read.line.points.iter().copied()));
    let mut lines = Lines::default();
    let moved = |line: &Vec<Point2>| line.iter().map(|p| *p + -to_piece).collect();
    for what in [What::Outline, What::Hole, What::Net] {
        let of_kind = read.iter().zip(&drawn).filter(|(_, (_, shape, _))| shape.what == what);
        let points = of_kind.flat_map(|(read, (_, shape, _))| match arcs {
            Some(_) if what != What::Net => shape.lines.iter().map(moved).collect(),
            _ => vec![read.line.points.clone()],
        });
        if what == What::Net { &mut lines.net } else { &mut lines.cuts }.extend(points);
    }
    if !preset.shows(Role::Net) {
        // The net of the piece, where the file would have it.
        let net = shapes.iter().filter(|shape| shape.what == What::Net).flat_map(|s| &s.lines);
        lines.net.extend(net.map(moved));
    }
    let has_net = !lines.net.is_empty();
    let mut off_mm = 0.0f64;
    for (read, (layer, shape, line)) in read.iter().zip(&drawn) {
        if let (Form::Open, false, &[from, to]) =
            (read.line.form, layer.is_cut(), &read.line.points[..])
        {
            lines.segments.push([from, to]);
        }
        let is_folded = match shape.what {
            What::Outline | What::Hole => !has_net && arcs.is_none(),
            What::Net => true,
            What::Rung(_) => layer.filled_mm.is_none(),
            _ => false,
        };
        if !is_folded {
            let off = read.line.off_mm(line, to_piece);
            off_mm = if off.is_nan() { f64::INFINITY } else { off_mm.max(off) };
        }
    }
    Ok((lines, off_mm))
}

/// The refold error of the pattern in memory, mm, of a part with windows, whose closing may change
/// lengths; 0 without windows. The written files may have this error too without being wrong, since
/// length errors are measured separately.
fn known_miss_mm(part: &Part) -> f64 {
    if part.sheet.loops().len() == 1 {
        return 0.0;
    }
    // A pattern that can't be folded here can't be folded from its file, where that is an error.
    refold(&part.sheet, &part.flat.points, &part.sheet.rungs()).unwrap_or(0.0)
}
