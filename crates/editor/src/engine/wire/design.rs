//! A design, bit by bit as it is drawn, also while it is none that a file could hold.

use super::{Wire, fields, kinds};
use sheetwright::boundary::{Continuity, PlaneChoice, Within};
use sheetwright::curve::{CurveKind, CurvePoint};
use sheetwright::design::{
    CurveUse, Design, DesignCurve, DesignPanel, Join, MovedBy, PanelMesh, PanelMethod, PanelShape,
    Triangles, Vary, VaryGoal,
};
use sheetwright::flatten::Aim;
use sheetwright::material::{Grain, GrainBending, KFactor, KFactors, Material, Sourced};
use sheetwright::triangulate::{Goal, WhichSurface};

fields!(Design { name, material, materials, curves, panels, vary, match_seams });
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
    grain
});
fields!(KFactors { rows, source });
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
    method,
    goal,
    plane,
    run_on,
    fold,
    effort,
    cut,
    which,
    near
});
fields!(CurveUse { name, reversed });
fields!(Join { parts, smooth, within, keep_parts });
fields!(Vary { panels, curves, goal, limit_mm, budget_mm, by, leave_developable });
fields!(Triangles { positions, triangles, left_out });
fields!(PanelMesh { triangles, aim, split_creases, darts, skin, facets, pieces_within_mm });
kinds!(Aim { Mean, Max, Seams });
kinds!(CurveKind { Polyline, Spline, BSpline });
kinds!(PanelMethod { Optimal, Bridge, Rails });
kinds!(Goal { Price, WorstWarp });
kinds!(WhichSurface { Cheapest, Other });
kinds!(MovedBy { Points, Samples });
kinds!(Continuity { G0, G1, G2 });

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
