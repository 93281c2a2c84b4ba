//! Edits: from a document to the next one, or why not, in words. The geometry is the kernel's
//! (`sheetwright::draw`); here it is applied to all that a document holds.

use super::{Document, Edit, Mirror, Plan, PointRef, Selection, curves_of};
use crate::words::sentence;
use sheetwright::curve::{CurveKind, CurvePoint};
use sheetwright::design::{
    Allowance, Corner, CurveUse, Design, DesignCurve, LOOP_SAMPLES, PanelShape, SampleTolerance,
    Trim, TrimKind, TrimOn,
};
use sheetwright::draw::edit::{
    EditError, curve_leg, free_name, insert_point, nearest, remove_point, set_corner, straighten,
};
use sheetwright::draw::join;
use sheetwright::draw::mirror::{closed_by_mirror, mirror_partner, mirrored};
use sheetwright::draw::panels::{PanelChange, Proposal, panels_of_drawing, without_curve};
use sheetwright::draw::round::circle;
use sheetwright::draw::settle::{point_at, settled};
use sheetwright::draw::stroke::{StrokeOptions, stroke};
use sheetwright::math::{Point2, Point3};
use sheetwright_files::{material_named, trims_for};

/// What came of an edit.
pub struct Edited {
    /// The document.
    pub document: Document,
    /// What is to be selected, if that changes.
    pub select: Option<Selection>,
    /// What is to be said.
    pub said: Option<String>,
}

impl Edited {
    fn of(document: Document) -> Self {
        Self { document, select: None, said: None }
    }
}

type Outcome = Result<Edited, String>;

/// How far a curve may be off the stroke, as a share of its length: half of what the paper allows,
/// which people see on round shapes.
const TOLERANCE_SHARE: f64 = 0.005;
/// The ends of a stroke meet where they are this near, as a share of its length: most who draw want
/// an outline.
const CLOSE_SHARE: f64 = 0.12;

/// The document after an edit.
pub fn edited(document: &Document, edit: &Edit) -> Outcome {
    match edit {
        Edit::Stroke { places, grain_mm } => drawn(document, places, *grain_mm),
        Edit::Corners { corners, closed } => cornered(document, corners, *closed),
        Edit::InsertPoint { curve, at } => inserted(document, *curve, *at),
        Edit::ToggleStraight { curve, span } => toggled_side(document, *curve, *span),
        Edit::RenameCurve { curve, name } => renamed_curve(document, *curve, name),
        Edit::RenamePanel { panel, name } => {
            let others = &document.design.panels;
            let is_taken = others.iter().enumerate().any(|(n, p)| n != *panel && p.name == *name);
            if is_taken {
                return Err(format!("There is a panel {name} already."));
            }
            let mut next = document.clone();
            let Some(of) = next.design.panels.get_mut(*panel) else {
                return Err("The panel is gone.".to_owned());
            };
            let was = std::mem::replace(&mut of.name, name.clone());
            for on in next.design.trims.iter_mut().flat_map(|trim| &mut trim.on) {
                if let TrimOn::Edge { part: Some(part), .. } = on
                    && *part == was
                {
                    part.clone_from(name);
                }
            }
            readable(next)
        }
        Edit::SetPanel { panel, to } => {
            let mut next = document.clone();
            let Some(of) = next.design.panels.get_mut(*panel) else {
                return Err("The panel is gone.".to_owned());
            };
            *of = (**to).clone();
            Ok(Edited::of(next))
        }
        Edit::SetTrade(name) => {
            let mut next = document.clone();
            retrimmed(&mut next.design, name.as_deref(), document.design.sheet_thickness_mm())?;
            next.design.trade.clone_from(name);
            Ok(Edited::of(next))
        }
        Edit::SetAllowance { curve, width_mm } => allowed(document, *curve, *width_mm),
        Edit::SetTrims { curve, kinds } => trimmed(document, *curve, kinds),
        Edit::SetPreset(name) => {
            let mut next = document.clone();
            next.design.preset.clone_from(name);
            Ok(Edited::of(next))
        }
        Edit::SetStock(stock) => {
            let mut next = document.clone();
            next.design.stock = stock.as_deref().cloned();
            Ok(Edited::of(next))
        }
        Edit::SetSheet { thickness_mm, dimensions, bend_radius_mm } => {
            let mut next = document.clone();
            (next.design.thickness_mm, next.design.dimensions) = (*thickness_mm, *dimensions);
            next.design.bend_radius_mm = *bend_radius_mm;
            with_sheet(document, next)
        }
        Edit::SetMaterial(name) => {
            let mut next = document.clone();
            next.design.material = match name {
                None => None,
                Some(name) => {
                    let found = material_named(name, &next.design.materials);
                    Some(found.ok_or_else(|| format!("There is no material {name}."))?)
                }
            };
            with_sheet(document, next)
        }
        Edit::Scale(factor) => super::size::scaled(document, *factor).map(Edited::of),
        Edit::SetDrawing(drawing) => {
            Ok(Edited::of(Document { drawing: (**drawing).clone(), ..document.clone() }))
        }
    }
}

/// Gives a design the trims of a trade in place of those that it has from one; `before_mm` is the
/// thickness of the sheet for which it has them.
fn retrimmed(
    design: &mut Design,
    trade: Option<&str>,
    before_mm: Option<f64>,
) -> Result<(), String> {
    let now_mm = design.sheet_thickness_mm();
    let trims = trims_for(design, trade, [before_mm, now_mm]);
    design.trims = trims.ok_or_else(|| "There is no such trade.".to_owned())?;
    Ok(())
}

/// The document with another sheet than `before`: some widths are thicknesses of it.
fn with_sheet(before: &Document, mut next: Document) -> Outcome {
    if next.design.dimensions.is_some() && next.design.sheet_thickness_mm().is_none() {
        return Err("Name a material or a thickness: a face is that of a sheet.".to_owned());
    }
    let trade = next.design.trade.clone();
    retrimmed(&mut next.design, trade.as_deref(), before.design.sheet_thickness_mm())?;
    Ok(Edited::of(next))
}

/// Where what is done along a curve stands: on its edge of every panel.
fn along(curve: &str) -> TrimOn {
    TrimOn::Edge { part: None, edge: curve.to_owned() }
}

/// Whether a trim is along the whole of this edge and nowhere else, so that fields show it.
fn is_along(trim: &Trim, on: &TrimOn) -> bool {
    trim.on == std::slice::from_ref(on) && trim.span == [0.0, 1.0]
}

fn is_allowance(kind: &TrimKind) -> bool {
    matches!(kind, TrimKind::Allowance(_))
}

/// The width of the allowance along a curve, mm, that [`Edit::SetAllowance`] has set; else 0.
pub fn allowance_mm(design: &Design, curve: &str) -> f64 {
    let on = along(curve);
    let own = design.trims.iter().filter(|trim| is_along(trim, &on));
    own.fold(0.0, |width, trim| match &trim.kind {
        TrimKind::Allowance(allowance) => allowance.width[0],
        _ => width,
    })
}

/// What else is done along a curve, that [`Edit::SetTrims`] has set.
pub fn trims_along(design: &Design, curve: &str) -> Vec<TrimKind> {
    let on = along(curve);
    let own = design.trims.iter().filter(|trim| is_along(trim, &on) && !is_allowance(&trim.kind));
    own.map(|trim| trim.kind.clone()).collect()
}

/// An allowance takes the place of all that moves the cut line there.
fn allowed(document: &Document, curve: usize, width_mm: f64) -> Outcome {
    let on = along(&curve_of(document, curve)?.name);
    let mut next = document.clone();
    let trims = &mut next.design.trims;
    let has_one = width_mm > 0.0;
    let gives_way = |kind: &TrimKind| is_allowance(kind) || (has_one && kind.moves_the_cut());
    trims.retain(|trim| !(is_along(trim, &on) && gives_way(&trim.kind)));
    if has_one {
        let kind = Allowance { width: [width_mm; 2], corner: Corner::ByLength };
        trims.push(Trim::new([on], TrimKind::Allowance(kind)));
    }
    Ok(Edited::of(next))
}

/// What moves the cut line takes the place of an allowance, and the last of several that of the
/// others.
fn trimmed(document: &Document, curve: usize, kinds: &[TrimKind]) -> Outcome {
    let on = along(&curve_of(document, curve)?.name);
    let mut next = document.clone();
    let trims = &mut next.design.trims;
    let last = kinds.iter().rposition(TrimKind::moves_the_cut);
    let stays = |trim: &Trim| is_allowance(&trim.kind) && last.is_none();
    trims.retain(|trim| !is_along(trim, &on) || stays(trim));
    let kept = kinds.iter().enumerate();
    let kept = kept.filter(|(n, kind)| !kind.moves_the_cut() || last == Some(*n));
    trims.extend(kept.map(|(_, kind)| Trim::new([on.clone()], kind.clone())));
    Ok(Edited::of(next))
}

/// A document whose file would read back: names are refused where files refuse them.
fn readable(document: Document) -> Outcome {
    match super::file::read("untitled.sheet.json", &super::file::written(&document)) {
        Ok(_) => Ok(Edited::of(document)),
        Err(error) => Err(format!("{}. {}", error.message, error.hint)),
    }
}

/// Every handle of every curve.
pub fn all(document: &Document) -> Selection {
    let curves = document.design.curves.iter().enumerate();
    let points = curves
        .flat_map(|(curve, of)| (0..of.points.len()).map(move |point| PointRef { curve, point }));
    Selection { points: points.collect(), ..Selection::default() }
}

/// Where a mirror shows a place of space.
fn image(plan: Plan, mirror: Mirror, p: Point3) -> Point3 {
    plan.space(mirror.image(plan.flat(p)), plan.lift(p))
}

/// The document with points moved; with them go points of other curves that were on the same spots
/// `before` they began to move, so that chained curves stay chained and none is picked up on the
/// way, and their images where there is a mirror.
pub fn moved(document: &Document, before: &Document, moved: &[(PointRef, Point3)]) -> Document {
    let moved = &with_those_on_the_spot(before, moved)[..];
    let mut next = document.clone();
    let curves = &mut next.design.curves;
    let mut put = |r: PointRef, to: Point3| {
        if let Some(point) = curves.get_mut(r.curve).and_then(|c| c.points.get_mut(r.point)) {
            point.at = to;
        }
    };
    let plan = document.drawing.plan;
    for &(r, to) in moved {
        let Some(mirror) = document.drawing.mirror else {
            put(r, to);
            continue;
        };
        match partner(document, mirror, r) {
            // On the mirror it stays there.
            Some(partner) if partner == r => {
                let mut flat = plan.flat(to);
                *(if mirror.upright { &mut flat.x } else { &mut flat.y }) = mirror.at_mm;
                put(r, plan.space(flat, plan.lift(to)));
            }
            Some(partner) => {
                put(r, to);
                if !moved.iter().any(|(other, _)| *other == partner) {
                    put(partner, image(plan, mirror, to));
                }
            }
            None => put(r, to),
        }
    }
    next
}

fn with_those_on_the_spot(
    document: &Document,
    moved: &[(PointRef, Point3)],
) -> Vec<(PointRef, Point3)> {
    let curves = &document.design.curves;
    let mut all = moved.to_vec();
    for &(r, to) in moved {
        let Some(here) = curves.get(r.curve).and_then(|c| c.points.get(r.point)) else { continue };
        for (curve, of) in curves.iter().enumerate().filter(|(n, _)| *n != r.curve) {
            let on_it = of.points.iter().enumerate().filter(|(_, p)| p.at == here.at);
            let others = on_it.map(|(point, _)| PointRef { curve, point });
            for other in others {
                if !all.iter().any(|(known, _)| *known == other) {
                    all.push((other, to));
                }
            }
        }
    }
    all
}

/// The point that is the image of another: itself if it lies on the mirror.
fn partner(document: &Document, mirror: Mirror, r: PointRef) -> Option<PointRef> {
    let plan = document.drawing.plan;
    let curves = &document.design.curves;
    let here = curves.get(r.curve)?.points.get(r.point)?.at;
    let there = image(plan, mirror, here);
    let within = 1e-6 * (1.0 + here.to_vec().length());
    if here.distance(there) <= within {
        return Some(r);
    }
    // Its own curve first: two that meet have points on one spot.
    let order = std::iter::once(r.curve).chain((0..curves.len()).filter(|&n| n != r.curve));
    order
        .filter_map(|curve| {
            let reflect = |p: Point3| image(plan, mirror, p);
            let of = &curves[r.curve];
            let point = mirror_partner(of, r.point, &curves[curve], reflect, within)?;
            Some(PointRef { curve, point })
        })
        .next()
}

/// The position of the point that lies exactly at a place of the plan, if there is one: what was
/// drawn onto it shares it.
fn shared(document: &Document, place: Point2) -> Option<Point3> {
    let plan = document.drawing.plan;
    let points = document.design.curves.iter().flat_map(|curve| &curve.points);
    point_at(points.map(|point| point.at), place, |p| plan.flat(p), |p| plan.lift(p))
}

/// A stroke becomes a curve.
fn drawn(document: &Document, places: &[Point2], grain_mm: f64) -> Outcome {
    let ends = [places.first(), places.last()].map(|place| shared(document, *place?));
    // From one point to another it is not meant to be closed.
    let is_between = matches!(ends, [Some(start), Some(end)] if start != end);
    let options = StrokeOptions {
        tolerance_share: TOLERANCE_SHARE,
        close_share: if is_between { 0.0 } else { CLOSE_SHARE },
        smallest_mm: 6.0 * grain_mm,
        grain_mm,
        ..StrokeOptions::default()
    };
    let found = stroke(places, &options).map_err(|error| sentence(&error))?;
    let plan = document.drawing.plan;
    let points = found.points.iter().map(|p| CurvePoint {
        at: plan.space(p.at, 0.0),
        corner: p.corner,
        move_mm: 0.0,
    });
    let what = if found.closed { "outline" } else { "curve" };
    let curve = DesignCurve {
        name: what.to_owned(),
        kind: Some(CurveKind::Spline),
        closed: found.closed,
        points: points.collect(),
    };
    let curve = settled(&curve, ends, |p| plan.flat(p)).map_err(|error| sentence(&error))?;
    with_curve(document, what, curve.points, found.closed)
}

/// Corners put one by one become a curve; it shares those that lie on points.
fn cornered(document: &Document, corners: &[Point2], closed: bool) -> Outcome {
    let plan = document.drawing.plan;
    let at = |p: Point2| shared(document, p).unwrap_or(plan.space(p, 0.0));
    let points = corners.iter().map(|&p| CurvePoint::corner(at(p))).collect();
    with_curve(document, if closed { "outline" } else { "curve" }, points, closed)
}

/// Half the height of a rectangle that is put on the plan, and the radius of a circle, which then
/// is a hole in it, in steps of the grid.
const SHAPES: [f64; 2] = [4.0, 2.0];

/// The document with one more outline of four corners, in the middle of the plan.
pub fn with_rectangle(document: &Document) -> Outcome {
    let half = SHAPES[0] * document.drawing.grid_mm;
    let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    let corners = corners.map(|[x, y]| Point2::new(1.5 * half * x, half * y));
    with_shape(document, "outline", &corners, CurvePoint::corner)
}

/// The document with one more round outline, in the middle of the plan.
pub fn with_circle(document: &Document) -> Outcome {
    let radius = SHAPES[1] * document.drawing.grid_mm;
    with_shape(document, "circle", &circle(Point2::default(), radius), CurvePoint::smooth)
}

/// The document with one more closed curve that lies on the plan.
fn with_shape(
    document: &Document,
    base: &str,
    places: &[Point2],
    point: fn(Point3) -> CurvePoint,
) -> Outcome {
    let plan = document.drawing.plan;
    let points = places.iter().map(|&p| point(plan.space(p, 0.0))).collect();
    let done = with_curve(&free_of_mirror(document), base, points, true)?;
    Ok(with_mirror_of(document, done))
}

/// A shape in the middle is drawn once, whatever the mirror.
fn free_of_mirror(document: &Document) -> Document {
    let mut free = document.clone();
    free.drawing.mirror = None;
    free
}

fn with_mirror_of(document: &Document, mut done: Edited) -> Edited {
    done.document.drawing.mirror = document.drawing.mirror;
    done
}

/// A new curve, on both sides of the mirror if there is one, and the panels that it bounds.
fn with_curve(document: &Document, base: &str, points: Vec<CurvePoint>, closed: bool) -> Outcome {
    let mut next = document.clone();
    let plan = document.drawing.plan;
    let mut curve = DesignCurve {
        name: free_name(&next.design, base),
        kind: Some(CurveKind::Spline),
        closed,
        points,
    };
    let mut twin = None;
    if let Some(mirror) = document.drawing.mirror {
        let reflect = |p: Point3| image(plan, mirror, p);
        let onto = |p: Point3| {
            let mut flat = plan.flat(p);
            *(if mirror.upright { &mut flat.x } else { &mut flat.y }) = mirror.at_mm;
            plan.space(flat, plan.lift(p))
        };
        // Half an outline is one whole, if it begins and ends near the mirror.
        let size =
            curve.points.iter().map(|p| p.at.distance(curve.points[0].at)).fold(0.0, f64::max);
        match closed_by_mirror(&curve, reflect, onto, 0.15 * size) {
            Ok(whole) => {
                curve = whole;
                curve.name = free_name(&next.design, "outline");
            }
            Err(_) if crosses(&curve, plan, mirror) => {}
            Err(_) => twin = Some(mirrored(&curve, reflect)),
        }
    }
    next.design.curves.push(curve);
    if let Some(mut twin) = twin {
        twin.name = free_name(&next.design, base);
        next.design.curves.push(twin);
    }
    let number = document.design.curves.len();
    let select = Selection { curve: Some(number), ..Selection::default() };
    let mut edited = with_panels(next)?;
    edited.select = Some(select);
    if !edited.document.design.curves[number].closed {
        edited.said = Some("The curve is open. Draw on, or choose Join or close (J).".to_owned());
    }
    Ok(edited)
}

/// Whether a curve lies on both sides of a mirror.
fn crosses(curve: &DesignCurve, plan: Plan, mirror: Mirror) -> bool {
    let side = |p: &CurvePoint| {
        let flat = plan.flat(p.at);
        (if mirror.upright { flat.x } else { flat.y }) > mirror.at_mm
    };
    curve.points.iter().any(side) && !curve.points.iter().all(side)
}

/// Panels that are drawn have as many samples as the usual tolerance takes.
fn proposal(document: &Document) -> Proposal {
    let plan = document.drawing.plan;
    let mut proposal = panels_of_drawing(&document.design, |p| plan.flat(p), LOOP_SAMPLES);
    for change in &mut proposal.changes {
        if let PanelChange::Panel(panel) = change {
            panel.tolerance = Some(SampleTolerance::USUAL);
        }
    }
    proposal
}

/// Closed curves that bound nothing yet become panels, or holes in those that contain them.
fn with_panels(mut document: Document) -> Outcome {
    let found = proposal(&document);
    document.design = found.applied(&document.design);
    Ok(Edited { document, select: None, said: unbound(&found) })
}

/// Why a closed curve bounds no panel, if one is kept from it, and what helps.
fn unbound(found: &Proposal) -> Option<String> {
    let crossing = found.crossing.first().map(|[a, b]| {
        format!(
            "{a} and {b} cross on the plan, or touch with one inside the other. Move handles until \
             they don't: then a panel is made."
        )
    });
    let crossing_itself = found.crossing_itself.first().map(|curve| {
        format!(
            "{curve} crosses itself on the plan, so it bounds no panel. Move its handles until it \
             doesn't."
        )
    });
    crossing.or(crossing_itself)
}

/// Why there is no panel though something is drawn, and what helps.
pub fn why_no_panel(document: &Document) -> String {
    let open = || "No outline is closed yet. Join the ends of a curve to close it.".to_owned();
    why_unbound(document).unwrap_or_else(open)
}

/// Why a closed curve bounds no panel, if one does not, and what helps.
pub fn why_unbound(document: &Document) -> Option<String> {
    unbound(&proposal(document))
}

/// The document with the panels of closed curves that crossed something `before` and don't any
/// more; `None` if there are none.
pub fn with_freed(before: &Document, now: &Document) -> Option<Document> {
    let Proposal { crossing, crossing_itself, .. } = proposal(before);
    let barred: Vec<String> = crossing.into_iter().flatten().chain(crossing_itself).collect();
    if barred.is_empty() {
        return None;
    }
    let mut found = proposal(now);
    found.changes.retain(|change| match change {
        PanelChange::Hole { curve, .. } => barred.contains(curve),
        PanelChange::Panel(panel) => curves_of(panel).iter().any(|u| barred.contains(&u.name)),
    });
    let design = found.applied(&now.design);
    (!found.changes.is_empty()).then(|| Document { design, ..now.clone() })
}

fn inserted(document: &Document, curve: usize, at: Point2) -> Outcome {
    let plan = document.drawing.plan;
    let of = curve_of(document, curve)?;
    let place = nearest(of, at, |p| plan.flat(p)).map_err(|error| sentence(&error))?;
    let (to, point) = insert_point(of, &place).map_err(|error| sentence(&error))?;
    let mut next = document.clone();
    next.design.curves[curve] = to;
    let mut edited = Edited::of(next);
    edited.select = Some(Selection::of_point(PointRef { curve, point }));
    Ok(edited)
}

fn curve_of(document: &Document, curve: usize) -> Result<&DesignCurve, String> {
    document.design.curves.get(curve).ok_or_else(|| "The curve is gone.".to_owned())
}

fn toggled_side(document: &Document, curve: usize, span: usize) -> Outcome {
    let of = curve_of(document, curve)?;
    let to = match curve_leg(of, span) {
        Err(EditError::NotStraight) => straighten(of, span, (span + 1) % of.points.len()),
        bent => bent.map(|(to, _)| to),
    };
    let mut next = document.clone();
    next.design.curves[curve] = to.map_err(|error| sentence(&error))?;
    Ok(Edited::of(next))
}

/// The sides that begin at the selected handles become straight, or can be bent again.
pub fn with_sides_toggled(document: &Document, selection: &Selection) -> Outcome {
    let Some(first) = selection.points.first() else {
        return Err("Select a handle first.".to_owned());
    };
    // The last first, so that numbers stay right where points are put in or taken out.
    let curve = first.curve;
    let mut edited = Edited::of(document.clone());
    for r in selection.points.iter().rev().filter(|r| r.curve == curve) {
        edited = toggled_side(&edited.document, r.curve, r.point)?;
    }
    Ok(edited)
}

/// The selected handles become corners; or smooth, if they are all corners.
pub fn with_corners_toggled(document: &Document, selection: &Selection) -> Outcome {
    let mut next = document.clone();
    let is_corner = |r: &PointRef| {
        let point = document.design.curves.get(r.curve).and_then(|c| c.points.get(r.point));
        point.is_some_and(|point| point.corner)
    };
    let to = !selection.points.iter().all(is_corner);
    for r in with_partners(document, &selection.points) {
        let of = curve_of(&next, r.curve)?;
        let set = set_corner(of, r.point, to).map_err(|error| sentence(&error))?;
        next.design.curves[r.curve] = set;
    }
    Ok(Edited::of(next))
}

/// Points, and their images if there is a mirror; each once.
fn with_partners(document: &Document, points: &[PointRef]) -> Vec<PointRef> {
    let mut all = points.to_vec();
    if let Some(mirror) = document.drawing.mirror {
        all.extend(points.iter().filter_map(|&r| partner(document, mirror, r)));
    }
    all.sort_unstable();
    all.dedup();
    all
}

/// The document without the selected handles; without any, without the selected curve. A curve that
/// would have too few handles goes.
pub fn deleted(document: &Document, selection: &Selection) -> Outcome {
    let mut next = document.clone();
    let mut gone: Vec<String> = Vec::new();
    for r in with_partners(document, &selection.points).into_iter().rev() {
        let of = curve_of(&next, r.curve)?;
        match remove_point(of, r.point) {
            Ok(to) => next.design.curves[r.curve] = to,
            Err(_) => gone.push(of.name.clone()),
        }
    }
    if selection.points.is_empty() {
        let curve = selection.curve.and_then(|n| document.design.curves.get(n));
        gone.extend(curve.map(|curve| curve.name.clone()));
    }
    gone.sort();
    gone.dedup();
    for name in &gone {
        next.design = without_curve(&next.design, name);
    }
    let said = (!gone.is_empty()).then(|| format!("{} is gone.", gone.join(", ")));
    Ok(Edited { document: next, select: Some(Selection::default()), said })
}

/// The curves that a selection is on, each once.
fn curves_in(selection: &Selection) -> Vec<usize> {
    let mut curves: Vec<usize> = selection.points.iter().map(|r| r.curve).collect();
    curves.extend(selection.curve);
    curves.sort_unstable();
    curves.dedup();
    curves
}

/// One open curve is closed, or two become one.
pub fn joined(document: &Document, selection: &Selection) -> Outcome {
    let mut next = document.clone();
    match curves_in(selection)[..] {
        [one] => {
            let of = curve_of(document, one)?;
            next.design.curves[one] =
                join::close(of, meeting(document)).map_err(|error| sentence(&error))?;
        }
        [one, other] => {
            let (a, b) = (curve_of(document, one)?, curve_of(document, other)?);
            let name = b.name.clone();
            next.design.curves[one] =
                join::join(a, b, meeting(document)).map_err(|error| sentence(&error))?;
            next.design = without_curve(&next.design, &name);
        }
        _ => return Err("Select one open curve to close it, or two to join them.".to_owned()),
    }
    with_panels(next)
}

/// Ends this near are meant to meet, mm: a hundredth of all that is drawn.
fn meeting(document: &Document) -> f64 {
    let points = || document.design.curves.iter().flat_map(|curve| &curve.points);
    let Some(first) = points().next() else { return 0.0 };
    0.01 * points().map(|p| p.at.distance(first.at)).fold(0.0, f64::max)
}

/// The selected curves, run from their ends to their beginnings.
pub fn reversed(document: &Document, selection: &Selection) -> Outcome {
    let mut next = document.clone();
    for n in curves_in(selection) {
        let of = curve_of(document, n)?;
        let to = sheetwright::draw::edit::reversed(of);
        for panel in &mut next.design.panels {
            turn_uses(&mut panel.shape, &of.name);
        }
        next.design.curves[n] = to;
    }
    Ok(Edited { document: next, select: Some(Selection::default()), said: None })
}

/// Panels run along a curve that was turned round as they did before.
fn turn_uses(shape: &mut PanelShape, name: &str) {
    let turn = |part: &mut CurveUse| {
        if part.name == name {
            part.reversed = !part.reversed;
        }
    };
    match shape {
        PanelShape::Rails(rails) => rails.iter_mut().for_each(turn),
        PanelShape::Loops { outer, holes } => {
            outer.iter_mut().chain(holes.iter_mut().flatten()).for_each(turn);
        }
        PanelShape::Join(_) | PanelShape::Mesh(_) => {}
    }
}

fn renamed_curve(document: &Document, curve: usize, name: &str) -> Outcome {
    let of = curve_of(document, curve)?.name.clone();
    let is_taken = |other: &DesignCurve| other.name == name && other.name != of;
    if document.design.curves.iter().any(is_taken) {
        return Err(format!("There is a curve {name} already."));
    }
    let mut next = document.clone();
    let Design { curves, panels, vary, trims, .. } = &mut next.design;
    curves[curve].name = name.to_owned();
    let rename = |part: &mut CurveUse| {
        if part.name == of {
            part.name = name.to_owned();
        }
    };
    for panel in panels {
        match &mut panel.shape {
            PanelShape::Rails(rails) => rails.iter_mut().for_each(rename),
            PanelShape::Loops { outer, holes } => {
                outer.iter_mut().chain(holes.iter_mut().flatten()).for_each(rename);
            }
            PanelShape::Join(_) | PanelShape::Mesh(_) => {}
        }
    }
    let of_vary = vary.iter_mut().flat_map(|vary| &mut vary.curves);
    let of_trims = trims.iter_mut().flat_map(|trim| &mut trim.on).filter_map(|on| match on {
        TrimOn::Edge { edge, .. } => Some(edge),
        _ => None,
    });
    for named in of_vary.chain(of_trims) {
        if *named == of {
            *named = name.to_owned();
        }
    }
    readable(next)
}

/// Whether a curve bounds some panel.
pub fn is_used(design: &Design, curve: &str) -> bool {
    design.panels.iter().any(|panel| curves_of(panel).iter().any(|part| part.name == curve))
}
