//! Reads written patterns back and folds them up again.

use crate::dxf::dxf_lines;
use crate::read_back::{Lines, PatternReadError, ReadPattern, overlapping_pattern, pattern};
use crate::svg::{svg_lines, write_svg};
use sheetwright::check::{Finding, refolding};
use sheetwright::flatten::{RefoldError, refold};
use sheetwright::make::{Found, Origin, Part};
use sheetwright::math::Point2;
use sheetwright::pattern::{PathKind, PatternPath, Piece};
use sheetwright::rung::Rung;
use sheetwright::tolerance::Tolerance;
use std::fmt;

/// Why a written pattern could not be folded up again.
#[derive(Clone, Debug, PartialEq)]
pub enum RefoldFileError {
    /// It can't be read.
    Read(PatternReadError),
    /// Its outline and holes are not those of the panel.
    Lines,
    /// A point of its outline or of a hole is not where it was laid.
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
                write!(
                    f,
                    "the outline or the holes of the written pattern differ from those of the panel"
                )
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
/// found surface it folds the pattern up and compares vertices in space. A stretched pattern does
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
    match &part.origin {
        Origin::Found(found) => folded_error_mm(part, found, svg, dxf),
        Origin::Given(_) => {
            let overlaps = part.flat.overlap.is_some();
            let by_mm = read_back_error_mm(&part.piece, overlaps, svg, dxf)?;
            let is_off = by_mm > Tolerance::REFOLD.length_mm(part.piece.size.length());
            if is_off { Err(RefoldFileError::Moved { by_mm }) } else { Ok(by_mm) }
        }
    }
}

fn folded_error_mm(
    part: &Part,
    found: &Found,
    svg: Option<&[u8]>,
    dxf: Option<&[u8]>,
) -> Result<f64, RefoldFileError> {
    let rungs = part.sheet.rungs();
    let overlapping = part.flat.overlap.map(|_| &rungs[..]);
    let read = read_patterns(&part.piece, overlapping, svg, dxf)?;
    read.iter().try_fold(0.0, |worst: f64, pattern| {
        let lines = std::iter::once(&pattern.outline).chain(&pattern.holes).map(Vec::len);
        if !lines.eq(part.sheet.loops().iter().map(Vec::len)) {
            return Err(RefoldFileError::Lines);
        }
        let off = |(read, laid): (&Point2, &Point2)| read.distance(*laid);
        let by_mm = pattern.points().iter().zip(&part.flat.points).map(off).fold(0.0, f64::max);
        let error_mm = refold(&part.sheet, &pattern.points(), &pattern.rungs)
            .map_err(RefoldFileError::Fold)?;
        // Closing windows allows a larger refold error, which must not hide a moved point.
        let allowed_mm = Tolerance::REFOLD.length_mm(found.boundary.size());
        if by_mm > allowed_mm && error_mm <= known_miss_mm(part) + allowed_mm {
            return Err(RefoldFileError::Moved { by_mm });
        }
        // Unlike `max`, this keeps NaN.
        Ok(if error_mm > worst || error_mm.is_nan() { error_mm } else { worst })
    })
}

/// The finding that the written files of a part differ from its surface; `None` if `error_mm` is
/// within the tolerance.
pub(crate) fn refold_finding(part: &Part, error_mm: f64) -> Option<Finding> {
    refolding(error_mm, part.found()?.boundary.size(), known_miss_mm(part))
}

/// The largest distance of the points of the outline and holes, read back, from the flat pattern,
/// mm: over the given files, or of an SVG in memory. `overlaps` says whether the pattern is known
/// to overlap itself.
///
/// # Errors
/// A file that can't be read, or has other lines than the piece.
fn read_back_error_mm(
    piece: &Piece,
    overlaps: bool,
    svg: Option<&[u8]>,
    dxf: Option<&[u8]>,
) -> Result<f64, RefoldFileError> {
    let mut worst = 0.0f64;
    for pattern in read_patterns(piece, overlaps.then_some(&[][..]), svg, dxf)? {
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
    Ok(worst)
}

/// The patterns of the files of a piece, read back. For a pattern that overlaps itself,
/// `overlapping` has the rungs to look for, since its lines alone do not tell outline, holes and
/// rungs apart.
fn read_patterns(
    piece: &Piece,
    overlapping: Option<&[Rung]>,
    svg: Option<&[u8]>,
    dxf: Option<&[u8]>,
) -> Result<Vec<ReadPattern>, RefoldFileError> {
    let mut files = Vec::new();
    if let Some(svg) = svg {
        files.push(svg_lines(svg));
    }
    if let Some(dxf) = dxf {
        files.push(dxf_lines(dxf));
    }
    if files.is_empty() {
        files.push(svg_lines(&write_svg(piece)));
    }
    let laid: Vec<Point2> = piece.net_loops().flatten().copied().collect();
    let read = files.into_iter().map(|lines| {
        let lines = without_drilled(lines.map_err(RefoldFileError::Read)?, piece)?;
        let read = match overlapping {
            Some(rungs) => overlapping_pattern(lines, &laid, rungs),
            None => pattern(lines),
        };
        read.map_err(RefoldFileError::Read)
    });
    read.collect()
}

/// The lines of a file without the drilled holes of its piece, which are the last to be cut. All
/// its lines to cut and of its net must be there.
fn without_drilled(mut lines: Lines, piece: &Piece) -> Result<Lines, RefoldFileError> {
    let count = |is: fn(&PatternPath) -> bool| piece.paths.iter().filter(|path| is(path)).count();
    let cuts = count(|path| path.closed && path.role.is_cut());
    let slits = count(|path| !path.closed && path.role.is_cut());
    let net = count(|path| path.kind == PathKind::Net);
    if (lines.cuts.len(), lines.slits.len(), lines.net.len()) != (cuts, slits, net) {
        return Err(RefoldFileError::Lines);
    }
    lines.cuts.truncate(piece.loops().count());
    Ok(lines)
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
