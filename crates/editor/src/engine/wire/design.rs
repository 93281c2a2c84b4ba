//! A design, bit by bit as it is drawn, also while it is none that a file could hold.

use super::{Wire, fields, kinds, variants};
use sheetwright::boundary::{Continuity, PlaneChoice, Within};
use sheetwright::curve::{CurveKind, CurvePoint};
use sheetwright::design::{
    Allowance, Axis, BendMarks, BendRule, Bends, Corner, CurveUse, Design, DesignCurve,
    DesignPanel, Dimensions, Divide, DivideJoint, Fingers, Flange, Hem, Holes, Join, Mark, MarkAt,
    MarkKind, MarkOn, MarkWay, MovedBy, NotchForm, Notches, PanelMesh, PanelMethod, PanelShape,
    Places, Puzzle, ReadNote, SampleTolerance, SheetForm, Slots, StationPlaces, StationPlane,
    Stock, StockSheet, Tabs, Ticks, Triangles, Trim, TrimKind, TrimOn, Turn, Unused, Vary,
    VaryGoal,
};
use sheetwright::flatten::Aim;
use sheetwright::material::{
    Deduction, Deductions, Grain, GrainBending, KFactor, KFactors, Material, Sourced,
};
use sheetwright::triangulate::{Goal, WhichSurface};

fields!(Design {
    name,
    material,
    materials,
    curves,
    panels,
    vary,
    match_seams,
    trade,
    trims,
    marks,
    preset,
    dxf,
    arcs_mm,
    formats,
    bends,
    dimensions,
    thickness_mm,
    bend_radius_mm,
    stock,
    notes
});
variants!(ReadNote {
    NotUsed { what, count, names, at },
    GapsClosed { count, widest_mm, at },
    TakenForRails { names },
    TakenForRing { names },
    Smoothed { names },
    NoUnit { unit_mm }
});
kinds!(Unused {
    Open,
    Closed,
    NotNamed,
    Doubled,
    Marks,
    Hidden,
    Text,
    Image,
    Hatch,
    Dimension,
    Point,
    Surface,
    Lines,
    Page,
    Other
});
fields!(Stock {
    sheets,
    gap_mm,
    margin_mm,
    kerf_mm,
    turn,
    grain_tolerance,
    may_turn_over,
    together,
    has_common_lines,
    has_file_each,
    effort,
    divide
});
fields!(Divide { joint, ratio, overlap_mm });
fields!(StockSheet { name, form, count, cost });
variants!(SheetForm { Rectangle { size }, Roll { width }, Outline { points } });
variants!(Turn { Free {}, Steps { angle }, Grain {}, OneWay {} });
fields!(Mark { on, kind });
variants!(MarkOn { All {}, Part { name } });
variants!(MarkKind {
    Stations { axis, at },
    Grain { way, length },
    Fold { edge },
    Face { text, toward, length },
    Drill { at, diameter },
    Text { at, text, height }
});
kinds!(Axis { X, Y, Z });
kinds!(DivideJoint { Scarf, Butt, Puzzle, Overlap });
variants!(StationPlaces { Listed { planes }, Every { pitch, from } });
fields!(StationPlane { at, name });
variants!(MarkAt { Space { at, within }, Flat { at } });
variants!(MarkWay { Space { way }, Edge { edge }, Angle { angle } });
fields!(Trim { on, span, kind });
variants!(TrimOn { All {}, Free {}, Joined {}, Cuts {}, Holes {}, Edge { part, edge } });
fields!(Allowance { width, corner });
fields!(Hem { width, turn });
fields!(Flange { width, angle, relief });
fields!(Tabs { width, angle, tolerance });
fields!(Holes { pitch, end_pitch, end_length, ends, inset, diameter });
fields!(Notches { at, form, depth, width, count, gap });
fields!(Ticks { at, length, numbered });
fields!(Fingers { width, depth, clearance });
fields!(Puzzle { pitch, width, clearance });
fields!(Slots { pitch, width, depth, thickness, clearance, beyond, dogbone });
kinds!(Corner {
    ByLength,
    ByIntersection,
    FirstEdgeSymmetry,
    SecondEdgeSymmetry,
    FirstEdgeRightAngle,
    SecondEdgeRightAngle
});
kinds!(NotchForm { Slit, T, V, VOut, U, Castle });
kinds!(Dimensions { Inside, Mean, Outside });
fields!(Bends { rule, marks });
kinds!(BendMarks { Ticks, Lines, Rulings, None });
fields!(Material {
    name,
    title,
    thickness_mm,
    bend_radius_mm,
    warp_limit_deg,
    stretch_limit,
    modulus_n_per_mm2,
    poisson,
    yield_strain,
    density_kg_per_m3,
    k_factors,
    deductions,
    grain
});
fields!(KFactors { rows, source });
fields!(Deductions { rows, source });
fields!(Deduction { radius_mm, angle_deg, deduction_mm });
fields!(KFactor { radius_per_thickness, k });
fields!(Grain { along, across });
fields!(GrainBending { modulus_n_per_mm2, bend_radius_mm });
fields!(Sourced { value, source });
fields!(DesignCurve { name, kind, closed, points });
fields!(CurvePoint { at, corner, move_mm });
fields!(DesignPanel {
    name,
    shape,
    samples,
    tolerance,
    method,
    goal,
    plane,
    run_on,
    slides,
    fold,
    effort,
    cut,
    which,
    near,
    bends,
    count,
    mirrored
});
fields!(CurveUse { name, reversed });
fields!(Join { parts, smooth, within, keep_parts });
fields!(Vary { panels, curves, goal, limit_mm, budget_mm, by, leave_developable });
fields!(Triangles { positions, triangles, left_out });
fields!(PanelMesh { triangles, aim, split_creases, darts, skin, facets, pieces_within_mm, seams });
kinds!(Aim { Mean, Max, Seams });
kinds!(CurveKind { Polyline, Spline, BSpline });
kinds!(PanelMethod { Optimal, Bridge, Rails });
kinds!(Goal { Price, WorstWarp });
kinds!(WhichSurface { Cheapest, Other });
kinds!(MovedBy { Points, Samples });
kinds!(Continuity { G0, G1, G2 });

impl Wire for TrimKind {
    fn put(&self, out: &mut Vec<u8>) {
        match self {
            Self::Allowance(kind) => tagged(0, kind, out),
            Self::Hem(kind) => tagged(1, kind, out),
            Self::Flange(kind) => tagged(2, kind, out),
            Self::Tabs(kind) => tagged(3, kind, out),
            Self::Holes(kind) => tagged(4, kind, out),
            Self::Notches(kind) => tagged(5, kind, out),
            Self::Ticks(kind) => tagged(6, kind, out),
            Self::Fingers(kind) => tagged(7, kind, out),
            Self::Puzzle(kind) => tagged(8, kind, out),
            Self::Slots(kind) => tagged(9, kind, out),
        }
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        Some(match u8::take(from)? {
            0 => Self::Allowance(Wire::take(from)?),
            1 => Self::Hem(Wire::take(from)?),
            2 => Self::Flange(Wire::take(from)?),
            3 => Self::Tabs(Wire::take(from)?),
            4 => Self::Holes(Wire::take(from)?),
            5 => Self::Notches(Wire::take(from)?),
            6 => Self::Ticks(Wire::take(from)?),
            7 => Self::Fingers(Wire::take(from)?),
            8 => Self::Puzzle(Wire::take(from)?),
            9 => Self::Slots(Wire::take(from)?),
            _ => return None,
        })
    }
}

fn tagged(tag: u8, value: &impl Wire, out: &mut Vec<u8>) {
    out.push(tag);
    value.put(out);
}

impl Wire for Places {
    fn put(&self, out: &mut Vec<u8>) {
        match self {
            Self::Shares(shares) => tagged(0, shares, out),
            Self::Lengths(lengths) => tagged(1, lengths, out),
            Self::Every(every) => tagged(2, every, out),
        }
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        Some(match u8::take(from)? {
            0 => Self::Shares(Wire::take(from)?),
            1 => Self::Lengths(Wire::take(from)?),
            2 => Self::Every(Wire::take(from)?),
            _ => return None,
        })
    }
}

impl Wire for BendRule {
    fn put(&self, out: &mut Vec<u8>) {
        match self {
            Self::Auto => out.push(0),
            Self::Angle(angle) => tagged(1, angle, out),
            Self::Number(number) => tagged(2, number, out),
            Self::Chord(mm) => tagged(3, mm, out),
            Self::Pitch(mm) => tagged(4, mm, out),
        }
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        Some(match u8::take(from)? {
            0 => Self::Auto,
            1 => Self::Angle(f64::take(from)?),
            2 => Self::Number(usize::take(from)?),
            3 => Self::Chord(f64::take(from)?),
            4 => Self::Pitch(f64::take(from)?),
            _ => return None,
        })
    }
}

impl Wire for PanelShape {
    fn put(&self, out: &mut Vec<u8>) {
        match self {
            Self::Rails(rails) => {
                out.push(0);
                rails.put(out);
            }
            Self::Loops { outer, holes } => {
                out.push(1);
                outer.put(out);
                holes.put(out);
            }
            Self::Join(join) => {
                out.push(2);
                join.put(out);
            }
            Self::Mesh(mesh) => {
                out.push(3);
                mesh.put(out);
            }
        }
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        Some(match u8::take(from)? {
            0 => Self::Rails(Wire::take(from)?),
            1 => Self::Loops { outer: Vec::take(from)?, holes: Vec::take(from)? },
            2 => Self::Join(Join::take(from)?),
            3 => Self::Mesh(PanelMesh::take(from)?),
            _ => return None,
        })
    }
}

impl Wire for PlaneChoice {
    fn put(&self, out: &mut Vec<u8>) {
        match self {
            Self::Auto => out.push(0),
            Self::None => out.push(1),
            Self::Normal(normal) => {
                out.push(2);
                normal.put(out);
            }
        }
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        Some(match u8::take(from)? {
            0 => Self::Auto,
            1 => Self::None,
            2 => Self::Normal(Wire::take(from)?),
            _ => return None,
        })
    }
}

impl Wire for VaryGoal {
    fn put(&self, out: &mut Vec<u8>) {
        match self {
            Self::Price => out.push(0),
            Self::Warp { largest } => {
                out.push(1);
                largest.put(out);
            }
            Self::Strain { share } => {
                out.push(2);
                share.put(out);
            }
        }
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        Some(match u8::take(from)? {
            0 => Self::Price,
            1 => Self::Warp { largest: f64::take(from)? },
            2 => Self::Strain { share: f64::take(from)? },
            _ => return None,
        })
    }
}

impl Wire for SampleTolerance {
    fn put(&self, out: &mut Vec<u8>) {
        match self {
            Self::Mm(mm) => tagged(0, mm, out),
            Self::Share(share) => tagged(1, share, out),
        }
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        Some(match u8::take(from)? {
            0 => Self::Mm(f64::take(from)?),
            1 => Self::Share(f64::take(from)?),
            _ => return None,
        })
    }
}

impl Wire for Within {
    fn put(&self, out: &mut Vec<u8>) {
        let (kind, value) = match self {
            Self::Mm(mm) => (0, mm),
            Self::Share(share) => (1, share),
        };
        out.push(kind);
        value.put(out);
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        let (kind, value) = (u8::take(from)?, f64::take(from)?);
        match kind {
            0 => Some(Self::Mm(value)),
            1 => Some(Self::Share(value)),
            _ => None,
        }
    }
}
