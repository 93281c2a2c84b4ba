//! A piece that a part was divided into, as a part of its own.
//!
//! What is judged is the whole part: a joint that is well made bends as the sheet does. So a piece
//! has the verdict, the strain and the measures of bending of the whole, but its own areas, and of
//! the rungs those that it has, with their own measures.

use super::cutout::{Cutout, Division, in_sheet};
use super::lines::{bends, lap_ends, loops};
use crate::check::{Checked, Finding, Place, Severity};
use crate::divide::DivideFault;
use crate::edge::{Edge, PieceStep, edges_of_piece};
use crate::flatten::{Flattened, posed};
use crate::make::part::{Found, Given, Joint, Origin, Part};
use crate::measure::{Apex, CutFrom, Measures, RungMeasures, area_flat, area_space};
use crate::measure::{distortion, measures};
use crate::mesh::Mesh;
use crate::pattern::{EdgeMark, PathKind, PatternOptions, PatternPath, Role, piece_bent};
use crate::sheet::Sheet;
use crate::surface::{Connectivity, Hinge, Surface};
use sheetwright_geometry::boundary::{Boundary, Outline};
use sheetwright_geometry::curve::Sample;
use sheetwright_geometry::index::{SampleIndex, VertexIndex};
use sheetwright_geometry::math::{Point2, Point3, Vec3, unit};
use sheetwright_geometry::predicate::first_overlap_of_loops;
use sheetwright_optimum::rung::Rung;
use sheetwright_optimum::triangulate::Triangulation;
use std::collections::BTreeMap;

/// A finding names no more places in space than this.
const MOST_PLACES: usize = 12;

/// What a piece is made from.
pub(super) struct Making<'a> {
    pub(super) whole: &'a Part,
    /// The sides of cuts by steps of the border.
    pub(super) sides: &'a BTreeMap<[usize; 2], (usize, bool)>,
    pub(super) divisions: &'a [Division],
    /// The marks of those.
    pub(super) marks: &'a [String],
    /// How far laps or straps reach to either side of a cut, mm, if there are any.
    pub(super) lap_mm: Option<f64>,
    /// Of a strap, the line on the pattern of the whole along which the pieces meet.
    pub(super) strap: Option<Vec<Point2>>,
}

impl Making<'_> {
    /// The piece of this name.
    pub(super) fn made(&self, name: &str, cutout: &Cutout<'_>) -> Result<Part, DivideFault> {
        let whole = self.whole;
        let of_whole = loops(cutout);
        let mut bends = bends(&whole.piece.bends, &of_whole);
        let mut laps = self.laps(cutout, &of_whole);
        let flat = laid(cutout, &mut bends, &mut laps);
        let (sheet, origin, measures) = match &whole.origin {
            Origin::Found(found) => self.found(cutout, found, &flat)?,
            Origin::Given(given) => self.given(cutout, given, &flat)?,
        };
        let edges = self.edges(cutout, &sheet, &flat.points);
        let is_net = whole.given().is_some_and(|given| given.is_net);
        let options = PatternOptions { bends: whole.bends, is_net, is_bare: false };
        let marks = self.marks(cutout, &origin);
        let mut piece =
            piece_bent(name, &sheet, &flat, &edges, &measures, &marks, (bends, &options));
        piece.paths.extend(laps.into_iter().map(|points| PatternPath {
            role: Role::Engrave,
            kind: PathKind::LapEnd,
            points,
            closed: false,
        }));
        let predicted = whole.predicted.clone().map(|predicted| {
            let numbers = self.rungs(cutout, &sheet);
            let is_scored =
                |n: &usize| numbers[*n].is_some_and(|of| predicted.scored.contains(&of));
            let scored = (0..numbers.len()).filter(is_scored).collect();
            // The sheet at rest is that of the whole.
            crate::elastic::Predicted { scored, at_rest: None, ..predicted }
        });
        Ok(Part {
            name: name.to_owned(),
            panel: whole.panel.clone(),
            checked: self.checked(cutout, &sheet),
            sheet,
            flat,
            measures,
            predicted,
            piece,
            thick: whole.thick,
            bends: whole.bends,
            edges,
            origin,
        })
    }

    /// Where laps end on it, on the pattern of the whole.
    fn laps(&self, cutout: &Cutout<'_>, of_whole: &[Vec<Point2>]) -> Vec<Vec<Point2>> {
        if let Some(line) = &self.strap {
            return vec![line.clone()];
        }
        let Some(reach_mm) = self.lap_mm else { return Vec::new() };
        let all = self.cuts_of(cutout);
        let ends = |steps: &Vec<[usize; 2]>| {
            let [from, to] = [steps.first()?[0], steps.last()?[1]];
            Some([from, to].map(|v| cutout.vertex(v).flat))
        };
        let cuts = all.iter().filter_map(|(_, steps)| ends(steps));
        cuts.flat_map(|cut| lap_ends(cut, reach_mm, of_whole)).map(Vec::from).collect()
    }

    /// The cuts along its border: the number of each, and its steps by vertices of the piece.
    fn cuts_of(&self, cutout: &Cutout<'_>) -> Vec<(usize, Vec<[usize; 2]>)> {
        let number: BTreeMap<usize, usize> =
            (0..cutout.vertices().count()).map(|n| (cutout.side([n, n])[0], n)).collect();
        let mut found = Vec::new();
        for (n, division) in self.divisions.iter().enumerate() {
            let forth = division.steps.clone();
            let back: Vec<[usize; 2]> = division.steps.iter().rev().map(|&[a, b]| [b, a]).collect();
            for steps in [forth, back] {
                let is_of_it = |step: &[usize; 2]| cutout.border().steps().any(|own| own == *step);
                if steps.first().is_some_and(is_of_it) {
                    found.push((n, steps.iter().map(|step| step.map(|v| number[&v])).collect()));
                }
            }
        }
        found
    }

    fn edges(&self, cutout: &Cutout<'_>, sheet: &Sheet, flat: &[Point2]) -> Vec<Edge> {
        let of_whole = edge_numbers(&self.whole.edges);
        let step = |ends: [VertexIndex; 2]| {
            if self.strap.is_some() {
                return PieceStep::Free;
            }
            let ends = ends.map(VertexIndex::get);
            let cut = self
                .sides
                .get(&cutout.side(ends))
                .map(|&(n, second)| PieceStep::Division(n, second));
            let edge = || Some(PieceStep::Edge(*of_whole.get(&cutout.whole_side(ends)?)?));
            cut.or_else(edge).unwrap_or(PieceStep::Free)
        };
        edges_of_piece(sheet, flat, &self.whole.edges, step)
    }

    fn marks(&self, cutout: &Cutout<'_>, origin: &Origin) -> Vec<EdgeMark> {
        let of_cut = |(n, steps): (usize, Vec<[usize; 2]>)| {
            let first = self.sides.get(&cutout.side(steps[0])).is_some_and(|&(_, second)| !second);
            let steps = steps.into_iter().map(|step| step.map(in_sheet)).collect();
            EdgeMark { mark: self.marks[n].clone(), steps, first }
        };
        let mut marks: Vec<EdgeMark> = self.cuts_of(cutout).into_iter().map(of_cut).collect();
        if let Origin::Given(given) = origin {
            marks.extend(given.joints.iter().map(|joint| EdgeMark {
                mark: joint.mark.clone(),
                steps: joint.steps.clone(),
                first: !given.is_net,
            }));
        }
        marks
    }

    /// For each rung of a sheet of the piece, the number of the rung of the whole that it is of;
    /// `None` of one inside a triangle.
    fn rungs(&self, cutout: &Cutout<'_>, sheet: &Sheet) -> Vec<Option<usize>> {
        let of_whole: BTreeMap<[usize; 2], usize> = self
            .whole
            .sheet
            .rung_ends()
            .iter()
            .enumerate()
            .map(|(n, &[a, b])| ([a.min(b).get(), a.max(b).get()], n))
            .collect();
        let ends = sheet.rung_ends().iter().map(|ends| ends.map(VertexIndex::get));
        ends.map(|ends| of_whole.get(&cutout.whole_side(ends)?).copied()).collect()
    }

    fn found(
        &self,
        cutout: &Cutout<'_>,
        found: &Found,
        flat: &Flattened,
    ) -> Result<(Sheet, Origin, Measures), DivideFault> {
        let boundary = boundary(cutout, found)?;
        let triangles = sorted(cutout.triangles());
        let too_thin = |_| DivideFault::TooThin;
        let connectivity =
            Connectivity::new(boundary.loops(), triangles.clone()).map_err(too_thin)?;
        let surface = Surface::new(connectivity.clone(), boundary.positions());
        let sheet = Sheet::whole(&Surface::new(connectivity.clone(), cutout.space()));
        let of_whole = edge_numbers(&self.whole.edges);
        let chord = |step: [usize; 2]| {
            let side = cutout.whole_side(step)?;
            let is_cut = self.sides.contains_key(&cutout.side(step));
            let [a, b] = side.map(VertexIndex::new).map(|v| self.whole.sheet.mesh().position(v));
            let [from, to] = step.map(|v| cutout.vertex(v).space);
            // A side of the border begins at the sample whose step it is.
            let from_sample =
                if found.boundary.next(side[0]) == side[1] { side[0] } else { side[1] };
            let share = from.distance(to) / a.distance(b);
            (!is_cut && of_whole.contains_key(&side)).then_some((from_sample, share))
        };
        let next = |n: usize| [n, boundary.next(n)];
        let steps: Vec<Option<(usize, f64)>> =
            (0..boundary.len()).map(|n| chord(next(n))).collect();
        let rungs: Vec<Rung> = connectivity.hinges().iter().map(|hinge| hinge.rung).collect();
        let measures = self.measures_of_found(cutout, &surface, &sheet, flat);
        let found = Found {
            method: found.method,
            goal: found.goal,
            fold: found.fold,
            slides: found.slides,
            ends: Vec::new(),
            outline: Outline::through(&boundary),
            chords: found.chords.divided(&steps),
            tolerance_mm: found.tolerance_mm,
            plane: found.plane.clone(),
            triangulation: Triangulation { rungs, triangles, ..found.triangulation.clone() },
            boundary,
            surface,
            change: None,
            other: None,
        };
        Ok((sheet, Origin::Found(Box::new(found)), measures))
    }

    fn measures_of_found(
        &self,
        cutout: &Cutout<'_>,
        surface: &Surface,
        sheet: &Sheet,
        flat: &Flattened,
    ) -> Measures {
        let whole = &self.whole.measures;
        let of_whole = self.rungs(cutout, sheet);
        let rung = |(hinge, of_whole): (&Hinge, Option<usize>)| {
            let [a, b] = hinge.rung.ends().map(|sample| surface.position(sample));
            let (rung, middle) = (hinge.rung, a.lerp(b, 0.5));
            let flat = || {
                let normal = surface.normal(hinge.triangles[0]).unwrap_or(Vec3::ZERO);
                RungMeasures {
                    rung,
                    twist: 0.0,
                    warp: 0.0,
                    resolution: 0.0,
                    has_ruling_beside: true,
                    crease: 0.0,
                    is_fold: false,
                    is_scored: false,
                    bend_radius_mm: f64::INFINITY,
                    normals: [normal; 2],
                    middle,
                }
            };
            of_whole.map_or_else(flat, |n| RungMeasures { rung, middle, ..whole.rungs[n] })
        };
        let hinges = surface.connectivity().hinges().iter();
        let numbers = cutout.numbers();
        let apex = |apex: &Apex| {
            let sample = SampleIndex::new(*numbers.get(&apex.sample.get())?);
            Some(Apex { sample, ..*apex })
        };
        Measures {
            rungs: hinges.zip(of_whole).map(rung).collect(),
            apexes: whole.apexes.iter().filter_map(apex).collect(),
            area_space_mm2: area_space(sheet),
            area_flat_mm2: area_flat(sheet, flat),
            ..whole.clone()
        }
    }

    fn given(
        &self,
        cutout: &Cutout<'_>,
        given: &Given,
        flat: &Flattened,
    ) -> Result<(Sheet, Origin, Measures), DivideFault> {
        let triangles = cutout.triangles().iter().map(|corners| corners.map(in_sheet)).collect();
        let mesh = Mesh::new(cutout.space(), triangles).map_err(|_| DivideFault::TooThin)?;
        let origin = (0..mesh.positions().len()).map(in_sheet).collect();
        let sheet = Sheet::new(mesh.clone(), origin, Vec::new());
        let of_piece = distortion(sheet.mesh(), &flat.points);
        let measures = Measures {
            gauss_area_sr: self.whole.measures.gauss_area_sr,
            crease_max: self.whole.measures.crease_max,
            length_error_max: self.whole.measures.length_error_max,
            length_error_mean: self.whole.measures.length_error_mean,
            ..measures(CutFrom::Mesh(&mesh, of_piece), &sheet, flat)
        };
        let joints = given.joints.iter().filter_map(|joint| joint_of(joint, cutout)).collect();
        let (aim, ended) = (given.aim, given.ended);
        let (flipped, is_net) = (given.flipped, given.is_net);
        let given = Given { mesh, aim, ended, flipped, joints, rebuilt: None, is_net };
        Ok((sheet, Origin::Given(Box::new(given)), measures))
    }

    /// The verdict of the whole, and its findings at their places on the piece.
    fn checked(&self, cutout: &Cutout<'_>, sheet: &Sheet) -> Checked {
        let whole = &self.whole.checked;
        let rungs = self.rungs(cutout, sheet);
        let numbers = cutout.numbers();
        let placed = |finding: &Finding| {
            let place = self.place(&finding.place, &rungs, &numbers);
            Finding::new(finding.kind.clone(), place)
        };
        // A strap says what it is, and of a piece, notes on what lies elsewhere say nothing.
        let is_elsewhere = |finding: &Finding, now: &Finding| {
            let is_named = matches!(now.place, Place::Points { .. }) && now.place != finding.place;
            is_named && now.severity() == Severity::Note
        };
        let all = whole.findings.iter().filter(|_| self.strap.is_none());
        let now = all.map(|finding| (finding, placed(finding)));
        let kept = now.filter(|(finding, now)| !is_elsewhere(finding, now));
        Checked { verdict: whole.verdict, findings: kept.map(|(_, now)| now).collect() }
    }

    /// The place of a finding on the piece; what lies elsewhere is named by points in space.
    fn place(
        &self,
        place: &Place,
        rungs: &[Option<usize>],
        numbers: &BTreeMap<usize, usize>,
    ) -> Place {
        let drawn = self.whole.positions();
        let points = |at: Vec<Point3>| {
            let step = at.len().div_ceil(MOST_PLACES).max(1);
            Place::Points { at: at.into_iter().step_by(step).collect() }
        };
        match place {
            Place::Rungs { numbers } => {
                let is_on = |n: &usize| rungs[*n].is_some_and(|of| numbers.contains(&of));
                let on_piece: Vec<usize> = (0..rungs.len()).filter(is_on).collect();
                if on_piece.is_empty() {
                    let middle = |&n: &usize| self.whole.measures.rungs[n].middle;
                    return points(numbers.iter().map(middle).collect());
                }
                Place::Rungs { numbers: on_piece }
            }
            Place::Samples { numbers: samples } => {
                let on_piece: Vec<SampleIndex> = samples
                    .iter()
                    .filter_map(|s| numbers.get(&s.get()).copied().map(SampleIndex::new))
                    .collect();
                if on_piece.is_empty() {
                    return points(samples.iter().map(|s| drawn[s.get()]).collect());
                }
                Place::Samples { numbers: on_piece }
            }
            Place::Triangles { corners } => {
                points(corners.iter().map(|corners| drawn[corners[0].get()]).collect())
            }
            Place::Sides { sides } => {
                points(sides.iter().map(|side| drawn[side.samples[0].get()]).collect())
            }
            other => other.clone(),
        }
    }
}

/// The edges by the sides of the whole sheet that they run along, lower end first.
fn edge_numbers(edges: &[Edge]) -> BTreeMap<[usize; 2], usize> {
    let of_edge = |(n, edge): (usize, &Edge)| {
        let steps = edge.run.windows(2).map(|pair| [pair[0].min(pair[1]), pair[0].max(pair[1])]);
        steps.map(|step| (step, n)).collect::<Vec<_>>()
    };
    edges.iter().enumerate().flat_map(of_edge).collect()
}

/// A piece laid flat: in the rectangle of least area around it, with its lines.
fn laid(
    cutout: &Cutout<'_>,
    bends: &mut [crate::bend::BendLine],
    laps: &mut [Vec<Point2>],
) -> Flattened {
    let mut all = cutout.flat();
    let count = all.len();
    all.extend(bends.iter().flat_map(|line| line.ends));
    all.extend(laps.iter().flatten());
    let loops = cutout.loops();
    let outline = loops.first().cloned().unwrap_or_default();
    let mut points = posed(&all, &outline);
    let mut lines = points.split_off(count).into_iter();
    for end in bends.iter_mut().flat_map(|line| &mut line.ends) {
        *end = lines.next().unwrap_or(*end);
    }
    for point in laps.iter_mut().flatten() {
        *point = lines.next().unwrap_or(*point);
    }
    let on_border = loops.last().map_or(0, |range| range.end);
    let overlap = first_overlap_of_loops(&points[..on_border], &loops);
    Flattened { points, overlap }
}

/// Triangles as those of a triangulation stand: the lowest corner first, in increasing order.
fn sorted(triangles: &[[usize; 3]]) -> Vec<[SampleIndex; 3]> {
    let turned = |&[a, b, c]: &[usize; 3]| match a.min(b).min(c) {
        lowest if lowest == a => [a, b, c],
        lowest if lowest == b => [b, c, a],
        _ => [c, a, b],
    };
    let mut triangles: Vec<[usize; 3]> = triangles.iter().map(turned).collect();
    triangles.sort_unstable();
    triangles.into_iter().map(|corners| corners.map(SampleIndex::new)).collect()
}

/// The boundary of a piece of a surface that was found: samples of the whole keep their tangents,
/// and along a cut the border is straight from vertex to vertex.
fn boundary(cutout: &Cutout<'_>, found: &Found) -> Result<Boundary, DivideFault> {
    let drawn = cutout.drawn();
    let loops = cutout.loops().into_iter().map(|range| {
        let sample = |n: usize| {
            let before = if n == range.start { range.end - 1 } else { n - 1 };
            let after = if n + 1 == range.end { range.start } else { n + 1 };
            let way = |from: usize, to: usize| unit(drawn[to] - drawn[from]).unwrap_or(Vec3::X);
            let of_whole = cutout.whole_vertex(n).map(|v| found.boundary.samples()[v]);
            let is_of_border = |a: usize, b: usize| {
                cutout.whole_side([a, b]).is_some_and(|[low, high]| {
                    found.boundary.next(low) == high || found.boundary.next(high) == low
                })
            };
            let straight = (way(before, n), way(n, after));
            let (tangent_in, tangent_out) = match of_whole {
                Some(sample) => (
                    if is_of_border(before, n) { sample.tangent_in } else { straight.0 },
                    if is_of_border(n, after) { sample.tangent_out } else { straight.1 },
                ),
                None => straight,
            };
            Sample { position: drawn[n], tangent_in, tangent_out }
        };
        range.clone().map(sample).collect()
    });
    Boundary::new(loops.collect()).map_err(|_| DivideFault::TooThin)
}

/// A joint of the whole as far as it lies on the piece.
fn joint_of(joint: &Joint, cutout: &Cutout<'_>) -> Option<Joint> {
    let sides: Vec<[usize; 2]> =
        joint.steps.iter().map(|&[a, b]| [a.min(b).get(), a.max(b).get()]).collect();
    let mut steps: Vec<[VertexIndex; 2]> = Vec::new();
    for range in cutout.loops() {
        for n in range.clone() {
            let ends = [n, if n + 1 == range.end { range.start } else { n + 1 }];
            if cutout.whole_side(ends).is_some_and(|side| sides.contains(&side)) {
                steps.push(ends.map(in_sheet));
            }
        }
    }
    let length = |step: &[VertexIndex; 2]| {
        let [a, b] = step.map(|v| cutout.vertex(v.get()).space);
        a.distance(b)
    };
    let length_mm = steps.iter().map(length).sum();
    (!steps.is_empty()).then(|| Joint { length_mm, steps, ..joint.clone() })
}
