//! `brake.csv`: the plan for the press brake, or for plate rolls, of all parts of a design.
//!
//! Angles are in degrees, lengths in mm, both with three decimals. `docs/press-brake.md` says what
//! each column is for.

use crate::table::{guarded, quoted};
use sheetwright::bend::{Brake, BrakeFault, DIE_THICKNESSES, Hit, Reference, hits};
use sheetwright::make::{CutItem, Made, Part};
use sheetwright::math::to_deg;
use std::fmt::Write as _;

/// What is known of the machine, and which plan it needs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BrakeSettings {
    /// The opening of the die, mm. Default: eight thicknesses of the sheet, if its thickness is
    /// known.
    pub die_mm: Option<f64>,
    /// The longest line that the brake bends, mm. Default: any.
    pub length_mm: Option<f64>,
    /// Whether the plan is for plate rolls: the radius at each line, and no hits.
    pub rolls: bool,
}

impl BrakeSettings {
    /// The hits of each part of a made design.
    pub(crate) fn plans(&self, made: &Made) -> Vec<Vec<Hit>> {
        let usual_mm = made.thickness_mm.map(|thickness| DIE_THICKNESSES * thickness);
        // Rolls have no die, and take a sheet in at any place.
        let (die_mm, length_mm) =
            if self.rolls { (None, None) } else { (self.die_mm.or(usual_mm), self.length_mm) };
        let brake = Brake { die_mm, length_mm };
        let of_part = |part: &Part| hits(&part.blank(), &brake);
        made.parts.iter().map(of_part).collect()
    }

    /// The bytes of `brake.csv`. `plans` has the hits of each part; those of the parts whose
    /// patterns are cut are listed.
    pub(crate) fn table(&self, made: &Made, plans: &[Vec<Hit>], patterns: &[CutItem]) -> Vec<u8> {
        let columns: &[Column] = if self.rolls { &ROLLS } else { &BRAKE };
        let mut out = columns.iter().map(|column| column.name).collect::<Vec<_>>().join(",");
        out.push_str("\r\n");
        for first in patterns.iter().map(CutItem::first) {
            let part = &made.parts[first];
            for (n, hit) in plans[first].iter().enumerate() {
                let cells = columns.iter().map(|column| quoted(&(column.cell)(part, n, hit)));
                // Writing to a string does not fail.
                let _ = write!(out, "{}\r\n", cells.collect::<Vec<_>>().join(","));
            }
        }
        out.into_bytes()
    }
}

/// A column of the plan.
pub(crate) struct Column {
    /// Its name.
    pub(crate) name: &'static str,
    /// What it says of the hit of a part with this number, from 0.
    pub(crate) cell: fn(&Part, usize, &Hit) -> String,
}

const PART: Column = Column { name: "part", cell: |part, _, _| guarded(&part.name) };
const ORDER: Column = Column { name: "order", cell: |_, n, _| (n + 1).to_string() };
const KIND: Column = Column {
    name: "kind",
    cell: |_, _, hit| if hit.line.is_fold { "fold" } else { "bend" }.to_owned(),
};
const DIRECTION: Column = Column {
    name: "direction",
    cell: |_, _, hit| if hit.line.is_up() { "up" } else { "down" }.to_owned(),
};
const LEFT_X: Column = Column { name: "x1_mm", cell: |_, _, hit| mm(hit.line.ends[0].x) };
const LEFT_Y: Column = Column { name: "y1_mm", cell: |_, _, hit| mm(hit.line.ends[0].y) };
const RIGHT_X: Column = Column { name: "x2_mm", cell: |_, _, hit| mm(hit.line.ends[1].x) };
const RIGHT_Y: Column = Column { name: "y2_mm", cell: |_, _, hit| mm(hit.line.ends[1].y) };
const LENGTH: Column = Column { name: "length_mm", cell: |_, _, hit| mm(hit.line.length_mm()) };
const LEFT_RADIUS: Column =
    Column { name: "radius_left_mm", cell: |_, _, hit| mm(hit.line.radius_mm()[0]) };
const RIGHT_RADIUS: Column =
    Column { name: "radius_right_mm", cell: |_, _, hit| mm(hit.line.radius_mm()[1]) };

/// The columns of a plan for the press brake: a row a hit.
pub(crate) const BRAKE: [Column; 22] = [
    PART,
    ORDER,
    KIND,
    DIRECTION,
    Column { name: "angle_deg", cell: |_, _, hit| deg(hit.line.angle.abs()) },
    Column { name: "running_deg", cell: |_, _, hit| deg(-hit.running) },
    LEFT_X,
    LEFT_Y,
    RIGHT_X,
    RIGHT_Y,
    LENGTH,
    Column { name: "reference", cell: |part, _, hit| guarded(&reference(part, hit)) },
    Column { name: "finger_left_mm", cell: |_, _, hit| mm(hit.fingers_mm[0]) },
    Column { name: "finger_right_mm", cell: |_, _, hit| mm(hit.fingers_mm[1]) },
    Column { name: "gauge_left_mm", cell: |_, _, hit| mm(hit.gauges_mm[0]) },
    Column { name: "gauge_right_mm", cell: |_, _, hit| mm(hit.gauges_mm[1]) },
    Column { name: "inside_radius_mm", cell: |_, _, hit| inside_radius(hit) },
    LEFT_RADIUS,
    RIGHT_RADIUS,
    Column { name: "pitch_left_mm", cell: |_, _, hit| mm(hit.line.pitch_mm[0]) },
    Column { name: "pitch_right_mm", cell: |_, _, hit| mm(hit.line.pitch_mm[1]) },
    Column { name: "warning", cell: |_, _, hit| warning(hit) },
];

/// The columns of a plan for plate rolls: a row a station.
pub(crate) const ROLLS: [Column; 13] = [
    PART,
    Column { name: "station", ..ORDER },
    KIND,
    DIRECTION,
    LEFT_X,
    LEFT_Y,
    RIGHT_X,
    RIGHT_Y,
    LENGTH,
    Column { name: "along_left_mm", cell: |_, _, hit| mm(hit.line.along_mm[0]) },
    Column { name: "along_right_mm", cell: |_, _, hit| mm(hit.line.along_mm[1]) },
    LEFT_RADIUS,
    RIGHT_RADIUS,
];

/// How the reference of a hit is called.
pub(crate) fn reference(part: &Part, hit: &Hit) -> String {
    match hit.reference {
        Reference::Edge(edge) => part.edges[edge].name.clone(),
        Reference::BaseLine => "base line".to_owned(),
    }
}

/// What the brake can't do at a hit, in words.
pub(crate) fn warning(hit: &Hit) -> String {
    let words = |fault: &BrakeFault| match *fault {
        BrakeFault::Close { to, apart_mm, least_mm } => {
            let number = to + 1;
            format!("{apart_mm:.1} mm from line {number}; half the die opening is {least_mm:.1} mm")
        }
        BrakeFault::Long { length_mm, most_mm } => {
            format!("{length_mm:.0} mm long; the brake is {most_mm:.0} mm")
        }
        BrakeFault::Short { beyond_mm, least_mm } => format!(
            "the sheet ends {beyond_mm:.1} mm beyond; half the die opening is {least_mm:.1} mm"
        ),
    };
    hit.faults.iter().map(words).collect::<Vec<_>>().join("; ")
}

/// The inner radius of the tool that a sharp fold has its allowance for, mm; empty where there is
/// none.
fn inside_radius(hit: &Hit) -> String {
    hit.line.inside_radius_mm.map(mm).unwrap_or_default()
}

pub(crate) fn mm(length: f64) -> String {
    // Adding 0 turns −0 into 0.
    format!("{:.3}", (length * 1e3).round() / 1e3 + 0.0)
}

fn deg(angle: f64) -> String {
    mm(to_deg(angle))
}
