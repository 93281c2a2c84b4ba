//! Reads written patterns back and folds them up again.

use crate::dxf::dxf_lines;
use crate::read_back::{PatternReadError, ReadPattern, overlapping_pattern, pattern};
use crate::svg::{svg_lines, write_svg};
use sheetwright::check::{Finding, refolding};
use sheetwright::flatten::{RefoldError, refold};
use sheetwright::make::{Found, Origin, Part};
use sheetwright::math::Point2;
use sheetwright::pattern::Piece;
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

/// How far the written files of a part come from what it is when they are read back, mm: the worse
/// of those that are given. Without any, an SVG is written in memory, so that the answer always
/// rests on a file. Where the surface was found, the pattern is folded up, and vertices are
/// compared in space; what is stretched does not fold up again, so of a mesh the outline and the
/// holes are compared with where they were laid.
///
/// # Errors
/// A file that can't be read or folded, or that has a point elsewhere.
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
        // Where closing holes lets folding miss, that must not hide a point that has moved.
        let allowed_mm = Tolerance::REFOLD.length_mm(found.boundary.size());
        if by_mm > allowed_mm && error_mm <= known_miss_mm(part) + allowed_mm {
            return Err(RefoldFileError::Moved { by_mm });
        }
        // Unlike `max`, this keeps NaN.
        Ok(if error_mm > worst || error_mm.is_nan() { error_mm } else { worst })
    })
}

/// The finding that the written files of a part are not what was made, where they miss it by so
/// much; `None` where they are.
pub(crate) fn refold_finding(part: &Part, error_mm: f64) -> Option<Finding> {
    refolding(error_mm, part.found()?.boundary.size(), known_miss_mm(part))
}

/// How far the points of the written outline and holes of a piece come from where they were laid
/// when they are read back, mm: the worse of the files that are given, or of an SVG in memory.
/// `overlaps` says that the pattern is known to overlap itself.
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
        let mut laid = piece.loops();
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

/// What was written of a piece, read back. A pattern that overlaps itself is given with the rungs
/// that are looked for in it: its lines alone do not tell what they are.
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
    let laid: Vec<Point2> = piece.loops().flatten().copied().collect();
    let read = files.into_iter().map(|lines| {
        let read = lines.and_then(|lines| match overlapping {
            Some(rungs) => overlapping_pattern(lines, &laid, rungs),
            None => pattern(lines),
        });
        read.map_err(RefoldFileError::Read)
    });
    read.collect()
}

/// How far the pattern of a part comes from its surface before it is written, mm, where closing its
/// windows may have changed lengths; 0 where there are none. What the written files may miss by
/// without being wrong: that the lengths are right is measured by themselves.
fn known_miss_mm(part: &Part) -> f64 {
    if part.sheet.loops().len() == 1 {
        return 0.0;
    }
    // What can't be folded before it is written can't be afterwards, and is told then.
    refold(&part.sheet, &part.flat.points, &part.sheet.rungs()).unwrap_or(0.0)
}
