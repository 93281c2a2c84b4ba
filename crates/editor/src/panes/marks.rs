//! Where what is marked of a panel lies: in space, and on the pattern.

use crate::engine::shown::Shown;
use crate::panes::measured::sides;
use sheetwright::check::Place;
use sheetwright::index::SampleIndex;
use sheetwright::math::{Point2, Point3, Vec3};

/// How large a spot is, points.
pub(super) const SPOT: f32 = 4.5;

/// The lines and spots of a place.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Marks {
    /// Lines in space, mm.
    pub(super) lines: Vec<[Point3; 2]>,
    /// Spots in space, mm.
    pub(super) spots: Vec<Point3>,
    /// Lines on the pattern, mm.
    pub(super) flat_lines: Vec<[Point2; 2]>,
    /// Spots on the pattern, mm.
    pub(super) flat_spots: Vec<Point2>,
    /// The way that the sheet faces there, of any length; zero where that is not known.
    pub(super) facing: Vec3,
}

impl Marks {
    /// Those of a place on a panel. The whole panel has none, nor have points of a curve, which
    /// stands beside it, and seams of a mesh, which its pattern marks.
    pub(super) fn of(place: &Place, shown: &Shown) -> Self {
        let mut marks = Self::default();
        match place {
            Place::Whole | Place::CurvePoints { .. } => {}
            Place::Points { at } => marks.spots.clone_from(at),
            Place::Lines { lines } => {
                for pair in lines.iter().flat_map(|line| line.on_part.windows(2)) {
                    marks.lines.push([pair[0].0, pair[1].0]);
                    marks.flat_lines.push([pair[0].1, pair[1].1]);
                }
            }
            Place::Rungs { numbers } => {
                for rung in numbers.iter().filter_map(|&n| shown.rungs.get(n)) {
                    marks.line(shown, rung.ends);
                    marks.flat_line(shown, rung.flat_ends);
                    marks.facing += rung.normals[0] + rung.normals[1];
                }
            }
            Place::Samples { numbers } => {
                for sample in numbers.iter().map(|&sample| number(sample)) {
                    marks.spots.extend(shown.positions.get(sample as usize));
                    let mut corners = corners_at(shown, sample);
                    corners.sort_unstable();
                    corners.dedup();
                    let flat = corners.iter().filter_map(|&c| shown.flat.get(c as usize));
                    marks.flat_spots.extend(flat);
                }
            }
            Place::Triangles { corners } => {
                for corners in corners.iter().map(|corners| corners.map(number)) {
                    let found = shown.triangles.iter().position(|t| *t == corners);
                    let flat = found.and_then(|n| shown.flat_triangles.get(n));
                    sides(corners).into_iter().for_each(|side| marks.line(shown, side));
                    let flat = flat.into_iter().flat_map(|&corners| sides(corners));
                    flat.for_each(|side| marks.flat_line(shown, side));
                }
            }
            Place::Sides { sides } => {
                for side in sides {
                    marks.line(shown, side.samples.map(number));
                    marks.flat_line(shown, side.corners.map(|corner| corner as u32));
                }
            }
            Place::Seams { seams } => {
                for ends in seams.iter().filter_map(|seam| Some(seam.ends?.map(number))) {
                    marks.line(shown, ends);
                    let flat = flat_sides(shown, ends);
                    flat.into_iter().for_each(|side| marks.flat_line(shown, side));
                }
            }
        }
        marks
    }

    /// All points in space that are to be seen.
    pub(super) fn points(&self) -> Vec<Point3> {
        self.lines.iter().flatten().chain(&self.spots).copied().collect()
    }

    /// All points on the pattern that are to be seen.
    pub(super) fn flat_points(&self) -> Vec<Point2> {
        self.flat_lines.iter().flatten().chain(&self.flat_spots).copied().collect()
    }

    fn line(&mut self, shown: &Shown, ends: [u32; 2]) {
        let ends = ends.map(|end| shown.positions.get(end as usize).copied());
        if let [Some(a), Some(b)] = ends {
            self.lines.push([a, b]);
        }
    }

    fn flat_line(&mut self, shown: &Shown, ends: [u32; 2]) {
        let ends = ends.map(|end| shown.flat.get(end as usize).copied());
        if let [Some(a), Some(b)] = ends {
            self.flat_lines.push([a, b]);
        }
    }
}

fn number(sample: SampleIndex) -> u32 {
    sample.get() as u32
}

/// The corners of the sheet that are a sample, more than one where it is cut open.
fn corners_at(shown: &Shown, sample: u32) -> Vec<u32> {
    let pairs = shown.triangles.iter().flatten().zip(shown.flat_triangles.iter().flatten());
    pairs.filter(|(of, _)| **of == sample).map(|(_, corner)| *corner).collect()
}

/// The sides of triangles on the sheet that join two samples: both sides of a cut.
fn flat_sides(shown: &Shown, ends: [u32; 2]) -> Vec<[u32; 2]> {
    let space = shown.triangles.iter().flat_map(|&t| sides(t));
    let flat = shown.flat_triangles.iter().flat_map(|&t| sides(t));
    let joins = |[a, b]: [u32; 2]| [a, b] == ends || [b, a] == ends;
    space.zip(flat).filter(|(side, _)| joins(*side)).map(|(_, flat)| flat).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use sheetwright::check::{BorderSide, LinePlace, SeamPlace};
    use sheetwright::design::Design;
    use sheetwright::make::make;
    use sheetwright::template::{catalogue, template};
    use sheetwright::watch::Unwatched;

    fn shown(design: &Design) -> Vec<Shown> {
        let made = make(design, &mut Unwatched).unwrap();
        made.parts.iter().map(|panel| Shown::new(panel, design.material.as_ref())).collect()
    }

    fn length<P: Copy>(ends: &[P; 2], distance: impl Fn(P, P) -> f64) -> f64 {
        distance(ends[0], ends[1])
    }

    /// What is marked on the pattern is what is marked in space: so long, and as much of it.
    #[test]
    fn what_is_found_is_marked_in_space_and_on_the_pattern() {
        let (mut rungs, mut samples) = (0, 0);
        for template in catalogue() {
            let Ok(mut design) = template.defaults().design() else { continue };
            // So few samples that some panels are bent in coarse steps.
            design.panels.iter_mut().for_each(|panel| panel.samples = 24);
            for shown in shown(&design) {
                for finding in &shown.findings {
                    let marks = Marks::of(&finding.place, &shown);
                    assert!(shown.has(&finding.place));
                    // With other samples, numbers mean others.
                    assert!(!shown.has(&Place::Rungs { numbers: vec![0, shown.rungs.len()] }));
                    let lengths = marks.lines.iter().map(|ends| length(ends, Point3::distance));
                    let flat = marks.flat_lines.iter().map(|ends| length(ends, Point2::distance));
                    match &finding.place {
                        Place::Whole => assert_eq!(marks, Marks::default()),
                        Place::Rungs { numbers } => {
                            assert_eq!(marks.lines.len(), numbers.len());
                            for (space, flat) in lengths.zip(flat) {
                                assert!((space - flat).abs() < 1e-6 * space, "{}", template.name);
                            }
                            rungs += 1;
                        }
                        Place::Samples { numbers } => {
                            assert_eq!(marks.spots.len(), numbers.len());
                            assert!(marks.flat_spots.len() >= numbers.len());
                            samples += 1;
                        }
                        Place::Points { at } => assert_eq!(marks.spots.len(), at.len()),
                        place => panic!("{}: {place:?}", template.name),
                    }
                }
            }
        }
        assert!(rungs > 0 && samples > 0, "{rungs} and {samples}");
    }

    #[test]
    fn triangles_sides_seams_and_lines_have_marks() {
        let shown = &shown(&template("cone").unwrap().defaults().design().unwrap())[0];
        let sample = |n: u32| SampleIndex::new(n as usize);
        let (corners, flat) = (shown.triangles[3], shown.flat_triangles[3]);
        let side = [corners[0], corners[1]].map(sample);
        let on_part =
            [0, 1].map(|n| (shown.positions[corners[n] as usize], shown.flat[flat[n] as usize]));
        let line = LinePlace { at: Vec::new(), on_part: on_part.to_vec() };
        let places = [
            (Place::Triangles { corners: vec![corners.map(sample)] }, 3),
            (
                Place::Sides {
                    sides: vec![BorderSide {
                        corners: [flat[0], flat[1]].map(|n| n as usize),
                        samples: side,
                    }],
                },
                1,
            ),
            (Place::Seams { seams: vec![SeamPlace { number: 0, ends: Some(side) }] }, 1),
            (Place::Lines { lines: vec![line] }, 1),
        ];
        for (place, count) in places {
            let marks = Marks::of(&place, shown);
            assert_eq!(marks.lines.len(), count, "{place:?}");
            let of_first = length(&marks.lines[0], Point3::distance);
            // A side within the sheet belongs to two triangles, as a seam has two sides.
            for ends in marks.flat_lines.iter().take(if count == 1 { 2 } else { 1 }) {
                assert!((length(ends, Point2::distance) - of_first).abs() < 1e-6 * of_first);
            }
            assert!(marks.flat_lines.len() >= count && marks.points().len() == 2 * count);
            assert!(marks.flat_points().len() >= 2 * count);
        }
    }
}
