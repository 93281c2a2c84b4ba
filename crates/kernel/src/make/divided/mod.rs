//! Parts that are larger than every sheet of the design, divided into pieces.
//!
//! This comes after everything that is found and judged of a part, and before its mates, trims and
//! marks: pieces are parts, so all of that is made on them as on others. The sides of a cut are
//! edges, `divide-1a` and `divide-1b`, which are mates; what joins them is a trim on both.

mod cutout;
mod knobs;
mod lines;
mod piece;
mod strap;

use super::part::{Origin, Part};
use crate::check::{Division, Finding, FindingKind};
use crate::design::{
    Allowance, Corner, Design, Divide, DivideJoint, Puzzle, SheetForm, Stock, StockSheet, Trim,
    TrimKind, TrimOn, Turn,
};
use crate::divide::{DivideFault, Fitting, Hindrance, divide};
use crate::edge::EdgeSource;
use crate::pattern::{PathKind, PatternPath, joint_mark};
use cutout::{Cutout, divisions, sides_of, whole_sheet};
use piece::Making;
use sheetwright_geometry::math::{Point2, Vec2, unit2};
use std::collections::BTreeSet;
use strap::Behind;

/// A strap reaches so many thicknesses to either side of a butt joint.
const STRAP_THICKNESSES: f64 = 12.0;
/// How much wider sockets are than knobs, mm.
const CLEARANCE_MM: f64 = 0.6;

/// Pieces leave this share of the room of a sheet, more than fitting allows for rounding.
const TIGHT: f64 = 4e-9;
/// Parts longer than this are not cut from one roll, mm.
const LONGEST_MM: f64 = 1e5;

/// What a joint through these costs beside one that is as long as the part is wide.
const OF_HOLE: f64 = 10.0;
const OF_FOLD: f64 = 3.0;
const OF_MARK: f64 = 1.0;
/// All bend lines of a part together, by their angles.
const OF_BENDS: f64 = 4.0;

/// What joins the pieces of a design, in mm.
#[derive(Clone, Copy, Debug)]
struct Seaming {
    joint: DivideJoint,
    /// How far laps or straps reach to either side of a cut, if there are any.
    lap_mm: Option<f64>,
}

impl Seaming {
    fn new(divide: &Divide, thickness_mm: Option<f64>) -> Result<Self, DivideFault> {
        let lap_mm = match divide.joint {
            DivideJoint::Scarf => {
                Some(0.5 * divide.ratio * thickness_mm.ok_or(DivideFault::NoThickness)?)
            }
            DivideJoint::Overlap => Some(0.5 * divide.overlap_mm),
            DivideJoint::Butt => {
                Some(STRAP_THICKNESSES * thickness_mm.ok_or(DivideFault::NoThickness)?)
            }
            DivideJoint::Puzzle => None,
        };
        Ok(Self { joint: divide.joint, lap_mm })
    }

    /// How far the material of a joint reaches beyond the cut, mm.
    fn reach_mm(&self) -> f64 {
        match self.joint {
            DivideJoint::Puzzle => knobs::REACH * knobs::KNOB_MM,
            DivideJoint::Butt => 0.0,
            _ => self.lap_mm.unwrap_or(0.0),
        }
    }

    /// How far pieces lie over one another, mm, if they do.
    fn overlap_mm(&self) -> Option<f64> {
        let is_lap = matches!(self.joint, DivideJoint::Scarf | DivideJoint::Overlap);
        self.lap_mm.filter(|_| is_lap).map(|reach| 2.0 * reach)
    }

    /// What is done along the two sides of a cut, which are edges; knobs are of this width.
    fn trim(&self, sides: [TrimOn; 2], knob_mm: f64) -> Option<Trim> {
        let kind = match (self.joint, self.lap_mm) {
            (DivideJoint::Butt, _) => return None,
            (DivideJoint::Puzzle, _) => {
                let pitch = knobs::PITCH * knob_mm;
                TrimKind::Puzzle(Puzzle { pitch, width: knob_mm, clearance: CLEARANCE_MM })
            }
            (_, Some(reach)) => {
                TrimKind::Allowance(Allowance { width: [reach; 2], corner: Corner::ByLength })
            }
            (_, None) => return None,
        };
        Some(Trim::new(sides, kind))
    }
}

/// A part that was divided, as it was before.
#[derive(Clone, Debug, PartialEq)]
pub struct DividedPart {
    /// Its name.
    pub name: String,
    /// How and why it was divided.
    pub division: Division,
    /// The name of each piece, and its loops on the pattern of the whole, mm, its outline first.
    pub pieces: Vec<(String, Vec<Vec<Point2>>)>,
}

/// Divides the parts of a design that are larger than every sheet, if it says so; else notes on
/// them that they are. Returns what was divided, and the trims that join the pieces, to be made
/// after all others.
pub(super) fn divide_parts(
    parts: &mut Vec<Part>,
    design: &Design,
) -> (Vec<DividedPart>, Vec<Trim>) {
    let Some(stock) = &design.stock else { return Default::default() };
    let beyond_mm = beyond_mm(&design.trims);
    let rooms = rooms(stock, beyond_mm);
    let tight: Vec<[f64; 2]> = rooms
        .iter()
        .map(|&[width, height]| [width, height].map(|side| side - TIGHT * (width + height)))
        .collect();
    // What is wrong with a mark is said when it is made.
    let marks = super::marked::drawn(parts, &design.marks).unwrap_or_default();
    let hindrances = hindrances(parts, &marks);
    let mut names = Names::of(design, parts);
    let mut known = parts.iter().filter_map(Part::given).flat_map(|given| &given.joints);
    let mut next_mark = known.by_ref().map(|joint| &joint.mark).collect::<BTreeSet<_>>().len();
    let (mut made, mut trims) = (Vec::with_capacity(parts.len()), Vec::new());
    let mut divided_parts = Vec::new();
    // Where each part begins in the new list.
    let mut begins = Vec::with_capacity(parts.len());
    for (n, (mut part, hindrances)) in
        std::mem::take(parts).into_iter().zip(&hindrances).enumerate()
    {
        begins.push(made.len());
        let grain = grain(marks.get(n).map_or(&[], |paths| paths), stock.turn);
        let whole = Fitting { rooms: &rooms, grain, reach_mm: 0.0, hindrances };
        if rooms.is_empty() || whole.fits_whole(&part.flat.points) {
            made.push(part);
            continue;
        }
        let length_mm = part.piece.size.x;
        let largest = largest(&rooms);
        let Some(asked) = &stock.divide else {
            let size_mm = [part.piece.size.x, part.piece.size.y];
            let kind = FindingKind::TooLarge { size_mm, room_mm: largest };
            part.checked.add(Finding::of_whole(kind));
            made.push(part);
            continue;
        };
        let divided = Seaming::new(asked, design.sheet_thickness_mm()).and_then(|seaming| {
            let fitting = Fitting { rooms: &tight, reach_mm: seaming.reach_mm(), ..whole.clone() };
            let pieces = pieces(&part, &fitting, &seaming, &mut names, next_mark)?;
            Ok((pieces, seaming))
        });
        match divided {
            Ok((pieces, seaming)) => {
                next_mark += pieces.joints.len();
                let count = pieces.loops.len();
                let division = Division {
                    pieces: count,
                    joints: pieces.joints.len(),
                    joint: seaming.joint,
                    lap_mm: seaming.overlap_mm(),
                    length_mm,
                    room_mm: largest,
                };
                let names = pieces.parts.iter().map(|part| part.name.clone());
                divided_parts.push(DividedPart {
                    name: part.name,
                    division,
                    pieces: names.zip(pieces.loops).collect(),
                });
                trims.extend(pieces.joints.iter().filter_map(|joint| {
                    let sides = joint.sides.clone();
                    seaming.trim(sides, joint.knob_mm)
                }));
                for (n, mut part) in pieces.parts.into_iter().enumerate() {
                    // A strap says which joint it lies behind.
                    if n >= count {
                        made.push(part);
                        continue;
                    }
                    part.checked
                        .add(Finding::of_whole(FindingKind::Divided { piece: n + 1, division }));
                    made.push(part);
                }
            }
            Err(fault) => {
                part.checked.add(Finding::of_whole(FindingKind::NotDivided { fault }));
                made.push(part);
            }
        }
    }
    *parts = made;
    renumber(parts, &begins);
    (divided_parts, trims)
}

/// The room on each sheet for the net of a part, mm, along its grain and across it. What fits an
/// offcut of any outline is not known before parts are laid out, so offcuts don't count.
fn rooms(stock: &Stock, beyond_mm: f64) -> Vec<[f64; 2]> {
    let inset = stock.margin_mm + beyond_mm + 0.5 * stock.kerf_mm;
    let room = |[along, across]: [f64; 2]| {
        let inside = [along - 2.0 * inset, across - 2.0 * inset];
        inside.iter().all(|&side| side > 0.0).then_some(inside)
    };
    let of_sheet = |sheet: &StockSheet| match sheet.form {
        SheetForm::Rectangle { size: [width, height] } => {
            room([width.max(height), width.min(height)])
        }
        SheetForm::Roll { width } => room([LONGEST_MM, width]),
        SheetForm::Outline { .. } => None,
    };
    stock.sheets.iter().filter_map(of_sheet).collect()
}

/// How far the trims of a design reach beyond the net at the most, mm: pieces leave room for that.
fn beyond_mm(trims: &[Trim]) -> f64 {
    let reach = |trim: &Trim| match &trim.kind {
        TrimKind::Allowance(allowance) => allowance.width[0].max(allowance.width[1]),
        TrimKind::Hem(hem) => hem.width + hem.turn,
        TrimKind::Flange(flange) => flange.width,
        TrimKind::Tabs(tabs) => tabs.width,
        TrimKind::Fingers(fingers) => fingers.depth,
        TrimKind::Slots(slots) => slots.depth.max(slots.thickness + slots.clearance + slots.beyond),
        TrimKind::Puzzle(puzzle) => knobs::REACH * puzzle.width,
        TrimKind::Notches(notches) if notches.form.is_outward() => notches.depth,
        TrimKind::Holes(_) | TrimKind::Notches(_) | TrimKind::Ticks(_) => 0.0,
    };
    trims.iter().map(reach).fold(0.0, f64::max)
}

/// The room of the sheet with the largest area, its longer side first, mm.
fn largest(rooms: &[[f64; 2]]) -> [f64; 2] {
    let area = |[width, height]: &[f64; 2]| width * height;
    let found = rooms.iter().copied().reduce(|a, b| if area(&b) > area(&a) { b } else { a });
    let [width, height] = found.unwrap_or_default();
    [width.max(height), width.min(height)]
}

/// The direction of a part that lies along the grain of the sheet: that of its grain arrow, which
/// is among its marks; without one x, where the stock asks for a grain.
fn grain(marks: &[PatternPath], turn: Turn) -> Option<Vec2> {
    let arrow = marks.iter().find(|path| path.kind == PathKind::Grain);
    let of_arrow = arrow.and_then(|path| unit2(path.points[1] - path.points[0]));
    let of_stock = match turn {
        Turn::Grain | Turn::OneWay => Some(Vec2::X),
        Turn::Free | Turn::Steps { .. } => None,
    };
    of_arrow.or(of_stock)
}

/// What the joints of each part keep away from: its holes, folds and bends, and stations and holes
/// that are marked on it.
fn hindrances(parts: &[Part], marks: &[Vec<PatternPath>]) -> Vec<Vec<Hindrance>> {
    let of_part = |(n, part): (usize, &Part)| {
        let holes = part.piece.net_loops().skip(1).map(|line| (line.to_vec(), OF_HOLE));
        let turned: f64 = part.piece.bends.iter().map(|line| line.angle.abs()).sum();
        let bends = part.piece.bends.iter().map(|line| {
            let weight = if line.is_fold { OF_FOLD } else { OF_BENDS * line.angle.abs() / turned };
            (line.ends.to_vec(), weight)
        });
        let marks = marks.get(n).into_iter().flatten().filter_map(|path| match path.kind {
            PathKind::Station => Some((path.points.clone(), OF_MARK)),
            PathKind::Drill { .. } => Some((path.points.clone(), OF_HOLE)),
            _ => None,
        });
        let all = holes.chain(bends).chain(marks);
        all.map(|(points, weight)| Hindrance { points, weight }).collect()
    };
    parts.iter().enumerate().map(of_part).collect()
}

/// The names that are taken, in lower case: files are named after parts.
struct Names(BTreeSet<String>);

impl Names {
    fn of(design: &Design, parts: &[Part]) -> Self {
        let panels = design.panels.iter().map(|panel| panel.name.to_lowercase());
        Self(panels.chain(parts.iter().map(|part| part.name.to_lowercase())).collect())
    }

    /// Names for the pieces of a part.
    fn take(&mut self, whole: &str, count: usize) -> Vec<String> {
        let numbered = (1..).map(|n| format!("{whole}-{n}"));
        let names: Vec<String> =
            numbered.filter(|name| !self.0.contains(&name.to_lowercase())).take(count).collect();
        self.0.extend(names.iter().map(|name| name.to_lowercase()));
        names
    }
}

/// The pieces of a part, and what joins them.
struct Pieces {
    /// The pieces, and then the straps.
    parts: Vec<Part>,
    /// The loops of each piece on the pattern of the whole, mm.
    loops: Vec<Vec<Vec<Point2>>>,
    joints: Vec<Joined>,
}

/// A joint between two pieces.
struct Joined {
    sides: [TrimOn; 2],
    /// The width of its knobs, mm, if it is a puzzle.
    knob_mm: f64,
}

fn pieces(
    whole: &Part,
    fitting: &Fitting<'_>,
    seaming: &Seaming,
    names: &mut Names,
    next_mark: usize,
) -> Result<Pieces, DivideFault> {
    if !whole.sheet.seams().is_empty() {
        return Err(DivideFault::Seams);
    }
    let mut dividing = whole_sheet(whole);
    let numbers = divide(&mut dividing, 0, fitting)?;
    let cutouts = numbers.iter().map(|&piece| Cutout::new(&dividing, piece));
    let cutouts: Vec<Cutout<'_>> = cutouts.collect::<Result<_, _>>()?;
    let divisions = divisions(&cutouts);
    let marks: Vec<String> = (0..divisions.len()).map(|n| joint_mark(next_mark + n)).collect();
    let sides = sides_of(&divisions);
    let (divisions_of, lap_mm) = (&divisions[..], seaming.lap_mm);
    let making = Making {
        whole,
        sides: &sides,
        divisions: divisions_of,
        marks: &marks,
        lap_mm,
        strap: None,
    };
    let mut parts = Vec::with_capacity(cutouts.len());
    for (name, cutout) in names.take(&whole.name, cutouts.len()).iter().zip(&cutouts) {
        let part = making.made(name, cutout)?;
        if part.piece.size.x.min(part.piece.size.y) < seaming.reach_mm() {
            return Err(DivideFault::TooThin);
        }
        parts.push(part);
    }
    let joints = divisions.iter().enumerate().map(|(n, division)| {
        let [first, second] = division.pieces;
        let side = |piece: usize, second: bool| {
            let source = EdgeSource::Division { number: n, second };
            let edge = parts[piece].edges.iter().position(|edge| edge.source == source);
            edge.map(|edge| (&parts[piece], edge)).ok_or(DivideFault::Pinched)
        };
        let sides = [side(first, false)?, side(second, true)?];
        let knob_mm = match seaming.joint {
            DivideJoint::Puzzle => knobs::knob_mm(sides).ok_or(DivideFault::TooThin)?,
            _ => 0.0,
        };
        let named = |(part, edge): (&Part, usize)| TrimOn::Edge {
            part: Some(part.name.clone()),
            edge: part.edges[edge].name.clone(),
        };
        Ok(Joined { sides: sides.map(named), knob_mm })
    });
    let joints = joints.collect::<Result<Vec<_>, DivideFault>>()?;
    if let (DivideJoint::Butt, Some(reach_mm)) = (seaming.joint, seaming.lap_mm) {
        let stem = format!("{}-strap", whole.name);
        let behind = Behind { whole, dividing: &dividing, cutouts: &cutouts, fitting, reach_mm };
        for (division, mark) in divisions.iter().zip(&marks) {
            for cut in behind.straps(division)? {
                let name = names.take(&stem, 1).concat();
                let mut part = cut.made(whole, &name)?;
                let kind = FindingKind::Strap { joint: mark.clone(), width_mm: 2.0 * reach_mm };
                part.checked.add(Finding::of_whole(kind));
                parts.push(part);
            }
        }
    }
    let loops = cutouts.iter().map(lines::loops).collect();
    Ok(Pieces { parts, loops, joints })
}

/// Numbers the parts that parts of meshes meet anew: of a part that was divided, its first piece.
fn renumber(parts: &mut [Part], begins: &[usize]) {
    let now = |before: usize| begins.get(before).copied().unwrap_or(before);
    for part in parts {
        for edge in &mut part.edges {
            if let EdgeSource::Part { with } = &mut edge.source {
                *with = now(*with);
            }
        }
        if let Origin::Given(given) = &mut part.origin {
            given.joints.iter_mut().for_each(|joint| joint.with = now(joint.with));
        }
    }
}
