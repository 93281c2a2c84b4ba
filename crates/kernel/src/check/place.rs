//! Places of findings, which a pane can select and a pattern can mark.

use crate::measure::RungMeasures;
use crate::sheet::{Seam, Sheet};
use sheetwright_geometry::index::SampleIndex;
use sheetwright_geometry::math::{Point2, Point3};

/// The place of a finding. All numbers count from 0.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Place {
    /// The whole part.
    #[default]
    Whole,
    /// Rungs of the surface, by their numbers in increasing order.
    Rungs {
        /// Their numbers.
        numbers: Vec<usize>,
    },
    /// Samples of the boundary.
    Samples {
        /// Their numbers.
        numbers: Vec<SampleIndex>,
    },
    /// Triangles of the surface.
    Triangles {
        /// The corners of each.
        corners: Vec<[SampleIndex; 3]>,
    },
    /// Sides of the border of the pattern.
    Sides {
        /// Each by its ends.
        sides: Vec<BorderSide>,
    },
    /// Seams of the sheet, some of them.
    Seams {
        /// Each by its number and its ends.
        seams: Vec<SeamPlace>,
    },
    /// Points in space.
    Points {
        /// Where they are, mm.
        at: Vec<Point3>,
    },
    /// Lines across the part.
    Lines {
        /// From end to end.
        lines: Vec<LinePlace>,
    },
    /// Points of a curve.
    CurvePoints {
        /// The curve, by name.
        curve: String,
        /// The numbers of the points.
        numbers: Vec<usize>,
    },
}

/// A side of the border of a pattern.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BorderSide {
    /// Its ends, by corners of the sheet laid flat.
    pub corners: [usize; 2],
    /// The samples that these are. Both sides of a cut may begin at one sample.
    pub samples: [SampleIndex; 2],
}

/// A seam of a sheet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SeamPlace {
    /// Its number, which its mark shows.
    pub number: usize,
    /// The samples that it runs between; `None` of a mesh.
    pub ends: Option<[SampleIndex; 2]>,
}

/// A line across a part, which may lie beside its sheet.
#[derive(Clone, Debug, PartialEq)]
pub struct LinePlace {
    /// Points of the line, mm.
    pub at: Vec<Point3>,
    /// The points of the part that are nearest to points along the line, as it was drawn and on its
    /// pattern, mm.
    pub on_part: Vec<(Point3, Point2)>,
}

impl Place {
    /// The rungs for which `is_so`.
    pub(super) fn rungs(rungs: &[RungMeasures], is_so: impl Fn(&RungMeasures) -> bool) -> Self {
        Self::Rungs { numbers: (0..rungs.len()).filter(|&n| is_so(&rungs[n])).collect() }
    }

    /// The seams for which `is_so`.
    pub(super) fn seams(sheet: &Sheet, is_so: impl Fn(&Seam) -> bool) -> Self {
        let seams = sheet.seams().iter().enumerate().filter(|(_, seam)| is_so(seam));
        let place = |(number, seam): (usize, &Seam)| {
            let ends = sheet.has_rungs().then(|| sheet.seam_rung(seam).ends());
            SeamPlace { number: sheet.first_seam() + number, ends }
        };
        Self::Seams { seams: seams.map(place).collect() }
    }

    /// One point in space.
    pub(super) fn at(point: Point3) -> Self {
        Self::Points { at: vec![point] }
    }
}
