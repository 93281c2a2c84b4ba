//! The kinds of findings, each with its numbers. Code and severity follow from the kind (`code`);
//! `files` writes the sentences.

use super::numbers::{
    Bend, CutWay, Division, Hindrance, MeshSetting, Movement, PointReach, SeamCause, TooTight,
};
use super::verdict::Verdict;
use crate::bend::Mitred;
use crate::design::ReadNote;
use crate::divide::DivideFault;
use crate::elastic::Basis;
use crate::fair::Ended;
use crate::mark::MarkNote;
use crate::mesh::{Damage, Skin};
use crate::trim::TrimNote;
use sheetwright_geometry::math::Point3;

/// The kind of a finding. Angles are in radians; errors and limits of lengths are shares without
/// unit.
/// `sheet` is the title of the material.
#[derive(Clone, Debug, PartialEq)]
pub enum FindingKind {
    /// The sheet must stretch by more than its limit.
    StrainTooLarge {
        /// The strain in the plane that 95 % of the area stays below.
        strain: f64,
        /// The strain that the sheet takes.
        limit: f64,
        /// The sheet, if one is named.
        sheet: Option<String>,
        /// The thickest sheet of its kind that takes the shape, mm, if one does and it was looked
        /// for.
        thickest_mm: Option<f64>,
        /// How the strain was found.
        basis: Basis,
    },
    /// The sheet takes its shape with force.
    NeedsForce {
        /// The strain in the plane that 95 % of the area stays below.
        strain: f64,
        /// The strain that the sheet takes.
        limit: f64,
        /// The strain of the outer fibre that 95 % of the area stays below, and that which the
        /// sheet takes, if that is known.
        outer_fibre: Option<[f64; 2]>,
        /// The sheet, if one is named.
        sheet: Option<String>,
        /// The moment that holds or forms a metre of edge, N·m/m, if the stiffness is known.
        moment_n: Option<f64>,
        /// Whether the sheet yields, so that it is formed and keeps its bend.
        is_formed: bool,
        /// How the strain was found.
        basis: Basis,
    },
    /// The sheet keeps its bend: it is rolled or formed.
    Roll {
        /// The radius that 95 % of the area stays above, mm.
        radius_mm: f64,
        /// The radius from which the sheet keeps its bend, mm.
        from_mm: f64,
        /// The sheet.
        sheet: String,
    },
    /// The strain is too close to the limit to tell whether the sheet takes its shape.
    CantTell {
        /// The strain in the plane is between these.
        strain: [f64; 2],
        /// The strain that the sheet takes.
        limit: f64,
        /// The sheet, if one is named.
        sheet: Option<String>,
        /// How the strain was found.
        basis: Basis,
    },
    /// The best surface has sharp folds that the sheet does not need.
    FoldsNotNeeded {
        /// How many.
        count: usize,
        /// The largest crease.
        sharpest: f64,
    },
    /// The bend radius is below the limit of the sheet.
    RadiusTooSmall {
        /// The bend radius that decides, mm: 95 % of the area is bent less tightly, but for narrow
        /// bends and tight patches.
        least_mm: f64,
        /// The smallest bend radius that the sheet takes, mm.
        limit_mm: f64,
        /// The sheet.
        sheet: String,
        /// The thickest sheet of its kind that takes the shape, mm, if one was found.
        thickest_mm: Option<f64>,
    },
    /// A smooth bend is so tight that the inner face of the sheet has no radius left.
    SheetTooThick {
        /// The smallest radius of the drawn face at such a bend, mm.
        drawn_mm: f64,
        /// How far inside of that face the inner one lies there, mm.
        inside_mm: f64,
        /// How thick the sheet is, mm.
        thickness_mm: f64,
    },
    /// Whether the sheet is bent too tightly can't be told.
    RadiusUnsure {
        /// The smallest bend radius that was measured or computed, mm.
        least_mm: f64,
        /// The smallest bend radius that the sheet takes, mm.
        limit_mm: f64,
        /// Whether the samples are too coarse to measure it; else it is too near to the limit.
        is_coarse: bool,
        /// The sheet.
        sheet: String,
    },
    /// Bend lines meet in points.
    Points {
        /// How many points.
        count: usize,
        /// The largest angle by which the sheet turns at one.
        turn: f64,
        /// How far the points reach where they are largest; `None` without a material.
        reach: Option<PointReach>,
        /// The sheet that can't be rolled so tightly; `None` where it takes the points.
        too_tight: Option<TooTight>,
    },
    /// The surface passes through itself in space.
    SelfCrossing,
    /// The pattern overlaps itself.
    Overlap,
    /// Rungs run along the boundary itself, where the surface has no tangent plane.
    RungWithoutPlane {
        /// How many.
        count: usize,
    },
    /// A surface that need not lie over the supporting plane has a much lower price.
    BetterWithoutPlane {
        /// The price over the plane.
        with: f64,
        /// The price without it.
        without: f64,
    },
    /// Moving the boundary does not bring the strain within the share that was wanted.
    StrainNotReached {
        /// The wanted share of the strain that the sheet takes.
        wanted: f64,
        /// The share that is left.
        reached: f64,
    },
    /// A panel that will not bend would as several, divided along lines across it.
    BendsDivided {
        /// How many.
        parts: usize,
        /// How the lines run, at even distances.
        way: CutWay,
        /// The largest strain in the plane of a part, of which 95 % of its area stays below.
        strain: f64,
        /// The worst verdict on a part.
        verdict: Verdict,
    },
    /// A panel that will not bend would not as several either.
    DividedInVain {
        /// Largest number of parts that was tried, both ways.
        most: usize,
    },
    /// Another surface fits the boundary about as well.
    TwoSurfaces {
        /// How far both are apart, mm.
        apart_mm: f64,
        /// Whether both have one pattern, so that the sheet goes either way.
        is_one_pattern: bool,
        /// The verdict on the other one.
        other: Verdict,
    },
    /// The other surface was asked for, and there is none.
    NoOtherSurface,
    /// A better surface may exist.
    NotProven {
        /// The largest share by which its price may be lower, if that is known.
        gap: Option<f64>,
        /// Whether the search ended at the limit of its work.
        cut_short: bool,
    },
    /// The surface has sharp folds.
    Folds {
        /// How many.
        count: usize,
        /// The largest crease.
        sharpest: f64,
        /// The sheet that does not fold; `None` where it folds.
        stiff: Option<String>,
    },
    /// The mesh has sharp creases.
    Creases {
        /// Along how many of its sides.
        count: usize,
        /// The largest crease.
        sharpest: f64,
        /// The sheet that does not fold; `None` where it folds.
        stiff: Option<String>,
    },
    /// The net of a mesh is folded between its facets.
    FoldedFacets {
        /// Along how many lines.
        mountains: usize,
        /// Along how many lines.
        valleys: usize,
        /// The largest fold, radians.
        sharpest: f64,
        /// The sheet that does not fold; `None` where it folds.
        stiff: Option<String>,
    },
    /// The facets of a mesh are meant, so that it is folded without being asked for.
    FacetsMeant {
        /// How many there are.
        facets: usize,
        /// The angle by which it turns at half of the length of the lines between them, radians.
        turn: f64,
        /// Whether as one surface it would bend, but its pattern overlap itself.
        overlaps: bool,
    },
    /// A mesh would not bend as one surface, or its pattern would overlap itself. It has few
    /// facets, which can be folded.
    FacetsFew {
        /// How many there are.
        facets: usize,
    },
    /// Settings have no effect on the way in which a mesh is laid flat.
    NoEffect {
        /// Which.
        settings: Vec<MeshSetting>,
        /// Whether it is folded between its facets; else it is laid flat as a surface.
        is_net: bool,
    },
    /// A piece of a net is larger than it may be.
    PieceTooLarge {
        /// Its width and height as it is cut, mm.
        size_mm: [f64; 2],
        /// What it may have, mm.
        within_mm: [f64; 2],
        /// Whether it is one facet, which nothing divides.
        is_facet: bool,
        /// Whether it would be small enough without what is added along its edges.
        is_trimmed: bool,
    },
    /// The sheet bends at single rulings so much that they are bend lines.
    BendLines {
        /// How many.
        count: usize,
        /// The largest crease.
        sharpest: f64,
    },
    /// Lengths in the pattern differ from those on the surface.
    LengthError {
        /// The largest relative length error.
        largest: f64,
        /// Whether they differ so that holes close when the panel is laid flat.
        closes_holes: bool,
    },
    /// Laid flat, the panel has a small gap at a hole and is cut there.
    WindowGap {
        /// The widest gap, mm.
        widest_mm: f64,
    },
    /// The pattern is cut open along seams.
    Seams {
        /// How many.
        count: usize,
        /// Their total length, mm.
        length_mm: f64,
        /// Why the pattern has seams.
        why: SeamCause,
    },
    /// A mesh that does not take its shape may do so when it is cut or divided.
    Divide {
        /// A cut that would help: its end inside, and that on the border.
        cut: Option<[Point3; 2]>,
        /// Whether cuts to the worst points were made.
        has_darts: bool,
        /// Whether the mesh has sharp creases along which it may be divided.
        has_creases: bool,
    },
    /// Triangles of a mesh have other lengths on the pattern than in space.
    Stretch {
        /// By how much the sheet stretches from the pattern to the shape, where that is most.
        stretch: f64,
        /// By how much it shrinks, where that is most.
        shrink: f64,
    },
    /// The border of a mesh does not keep its lengths, as the aim demands.
    BorderNotTrue {
        /// The largest relative length error of the border.
        largest: f64,
    },
    /// Triangles of a mesh lie upside down on the pattern.
    Flipped {
        /// How many.
        count: usize,
    },
    /// Triangles of a file without area were left out.
    TrianglesLeftOut {
        /// How many.
        count: usize,
    },
    /// Parts of a mesh that are too small to be sheet were left out.
    PartsLeftOut {
        /// How many.
        count: usize,
    },
    /// The triangles of a file were damaged, and are healed.
    Healed {
        /// What was wrong.
        damage: Damage,
        /// In how many places.
        count: usize,
    },
    /// A mesh is a plate with two skins, or several.
    TwoSkins {
        /// How many plates.
        count: usize,
        /// How many bodies the mesh has, plates among them.
        bodies: usize,
        /// How far the skins of the first are apart, mm.
        thickness_mm: f64,
        /// The skin that is laid flat alone, if one is.
        laid: Option<Skin>,
    },
    /// One skin was to be laid flat, and a mesh is no plate with two.
    NotTwoSkins,
    /// Parts of a mesh meet only in points.
    PointContacts {
        /// In how many.
        count: usize,
    },
    /// The points of a spline turn sharply where no corner is marked.
    RoundedCorner {
        /// The curve.
        curve: String,
        /// The largest angle by which they turn.
        turn: f64,
    },
    /// A point of a spline stands out of its line, as a slip in a table of offsets does.
    UnfairLine {
        /// The curve.
        curve: String,
        /// Where the point is, mm.
        at: Point3,
        /// Where it would be on the line of its neighbours, mm.
        fair: Point3,
    },
    /// A spline swings beyond its points where they only rise or only fall.
    SplineBulge {
        /// The curve.
        curve: String,
        /// Where it does so most, mm.
        at: Point3,
        /// By how much, mm.
        by_mm: f64,
    },
    /// The polygon through the samples is farther from the curves than the tolerance.
    OffTolerance {
        /// How far the curves lie from it at most, mm.
        distance_mm: f64,
        /// By how much it is shorter along the edge that loses most, mm.
        shorter_mm: f64,
        /// The tolerance, mm.
        tolerance_mm: f64,
        /// The number of samples, of each rail or of the outline.
        samples: usize,
        /// Whether it is that of each rail.
        is_rails: bool,
        /// Whether the tolerance is the usual one, of a panel that gives none.
        is_usual: bool,
        /// Whether a tolerance gives no more.
        is_most: bool,
    },
    /// A boundary was made smooth where joined panels meet.
    JointsSmoothed {
        /// At how many places.
        count: usize,
        /// How far it lies from the boundaries of the panels at most, mm.
        deviation_mm: f64,
    },
    /// The rails of a panel run on.
    RanOn {
        /// How far the end where the first rail begins, and that where it ends, bulge from the
        /// straight line, mm; `None` of an end that stays straight.
        bulges_mm: [Option<f64>; 2],
        /// How the panel bends as it is and with straight ends, if that can be made.
        bends: Option<[Bend; 2]>,
    },
    /// The rails of a panel can't run on.
    StayedStraight {
        /// Why not: the error of the panel with the new ends, in words.
        cause: String,
    },
    /// Joined panels were turned round to face as the first does.
    TurnedRound {
        /// Which.
        panels: Vec<String>,
        /// The first.
        first: String,
    },
    /// The boundary was moved.
    Moved {
        /// How far, and the change of warp and twist.
        movement: Movement,
        /// How it ended.
        ended: Ended,
        /// What keeps the panel from bending all the same.
        hindrance: Option<Hindrance>,
    },
    /// Nothing needed to move.
    NotMoved {
        /// The warp and twist, which did not change.
        movement: Movement,
        /// The warp angle that was asked for.
        wanted: Option<f64>,
        /// Whether a warp angle is above that, which the samples explain by bending.
        is_above: bool,
        /// What keeps the panel from bending all the same.
        hindrance: Option<Hindrance>,
    },
    /// The warp angle that was asked for is not reached.
    WarpNotReached {
        /// How far the boundary was moved, and the change of warp and twist.
        movement: Movement,
        /// The warp angle that was asked for.
        wanted: f64,
        /// How it ended.
        ended: Ended,
    },
    /// The written pattern does not fold back onto the surface.
    Refold {
        /// The refold error, mm.
        error_mm: f64,
        /// The limit, mm.
        limit_mm: f64,
    },
    /// The written pattern is not the one that was laid flat.
    NotReadBack {
        /// Why not: the error of reading it, in words.
        cause: String,
    },
    /// Vertices of the quads leave the boundary so that all are planar.
    QuadsOffBoundary {
        /// The largest distance, mm.
        off_mm: f64,
    },
    /// The quads are not planar.
    QuadsNotPlanar {
        /// The largest distance between the two diagonals of a quad, mm.
        uneven_mm: f64,
        /// The largest distance of a vertex from the boundary if all quads were planar, mm; `None`
        /// if no such quads were found.
        off_mm: Option<f64>,
    },
    /// Bend lines come nearer to one another than half the die opening of the press brake.
    LinesClose {
        /// How many come too near to the one before.
        count: usize,
        /// The nearest, mm.
        nearest_mm: f64,
        /// Half the die opening, mm.
        least_mm: f64,
    },
    /// Bend lines are longer than the press brake.
    LinesLong {
        /// How many.
        count: usize,
        /// The longest, mm.
        longest_mm: f64,
        /// How long the brake is, mm.
        most_mm: f64,
    },
    /// Beyond its first or last bend line the sheet reaches less far than half the die opening.
    FlangeShort {
        /// How many such lines there are.
        count: usize,
        /// The shortest reach, mm.
        shortest_mm: f64,
        /// Half the die opening, mm.
        least_mm: f64,
    },
    /// The faces at some folds meet as mitred boards do, without what the bend of a tool takes.
    FoldsMitred {
        /// How many of them.
        count: usize,
        /// How many folds there are.
        of: usize,
        /// Why.
        why: Mitred,
    },
    /// The PDF shows the panel smaller than it is.
    PdfReduced {
        /// About how many sheets of paper it takes at true scale.
        sheets: u64,
        /// The scale, as 400 of 1:400.
        scale: f64,
        /// The most sheets of a PDF.
        most: usize,
        /// Whether the panels before it leave too few sheets.
        is_full: bool,
    },
    /// The part is larger than every sheet.
    TooLarge {
        /// Its width and height, mm.
        size_mm: [f64; 2],
        /// The room of the largest sheet, its longer side first, mm.
        room_mm: [f64; 2],
    },
    /// No sheet of the design has the part on it.
    NoSheet {
        /// Whether it fits none; else those that it fits are used up.
        is_too_large: bool,
    },
    /// The part is a piece of one that was divided, since that is larger than every sheet.
    Divided {
        /// The number of the piece, from 1.
        piece: usize,
        /// How.
        division: Division,
    },
    /// The part is a strap behind a butt joint of one that was divided.
    Strap {
        /// The mark of the joint.
        joint: String,
        /// How wide it is, mm.
        width_mm: f64,
    },
    /// The part is larger than every sheet and can't be divided.
    NotDivided {
        /// Why not.
        fault: DivideFault,
    },
    /// Something is to be said about how a drawing was read.
    Read {
        /// What.
        note: ReadNote,
    },
    /// Something is to be said about what is done along the edges.
    Trimmed {
        /// What.
        note: TrimNote,
    },
    /// A mark on the face was not made as it was asked for.
    Marked {
        /// What.
        note: MarkNote,
    },
}
