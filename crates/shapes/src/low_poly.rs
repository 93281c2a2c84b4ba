//! Models as makers of paper models have them: an animal and a helmet of some hundred facets.

use crate::solids::{self, Solid};
use sheetwright::math::{Point3, Vec3, cos, sin};
use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::{PI, TAU};

/// A body of quadrilaterals that is modelled by pulling faces out.
struct Cage {
    points: Vec<Point3>,
    faces: Vec<[usize; 4]>,
}

impl Cage {
    /// The surface of a block of cells: corners at these coordinates along each axis.
    fn block(x: &[f64], y: &[f64], z: &[f64]) -> Self {
        let mut cage = Self { points: Vec::new(), faces: Vec::new() };
        let mut numbers: BTreeMap<[usize; 3], usize> = BTreeMap::new();
        let last = [x.len() - 1, y.len() - 1, z.len() - 1];
        for axis in 0..3 {
            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
            for (end, i, j) in [0, last[axis]].into_iter().flat_map(|end| {
                (0..last[u]).flat_map(move |i| (0..last[v]).map(move |j| (end, i, j)))
            }) {
                let mut ring = [[0, 0], [1, 0], [1, 1], [0, 1]].map(|[du, dv]| {
                    let mut cell = [0; 3];
                    (cell[axis], cell[u], cell[v]) = (end, i + du, j + dv);
                    *numbers.entry(cell).or_insert_with(|| {
                        cage.points.push(Point3::new(x[cell[0]], y[cell[1]], z[cell[2]]));
                        cage.points.len() - 1
                    })
                });
                if end == 0 {
                    ring.reverse();
                }
                cage.faces.push(ring);
            }
        }
        cage
    }

    /// Pulls the faces of a region out: their corners move by `way` and draw nearer to their middle
    /// by `shrink`; walls follow round the region.
    fn pull(&mut self, region: &[usize], way: Vec3, shrink: f64) {
        let sides = |face: [usize; 4]| [0, 1, 2, 3].map(|k| [face[k], face[(k + 1) % 4]]);
        let all: BTreeSet<[usize; 2]> = region.iter().flat_map(|&f| sides(self.faces[f])).collect();
        let corners: BTreeSet<usize> = all.iter().map(|side| side[0]).collect();
        let sum: Vec3 = corners.iter().map(|&n| self.points[n].to_vec()).sum();
        let middle = sum / corners.len() as f64;
        let mut moved = BTreeMap::new();
        for &n in &corners {
            let from = self.points[n].to_vec();
            self.points.push(Point3::from_vec(middle + (from - middle) * shrink + way));
            moved.insert(n, self.points.len() - 1);
        }
        for &f in region {
            self.faces[f] = self.faces[f].map(|n| moved[&n]);
        }
        let rim = all.iter().filter(|[a, b]| !all.contains(&[*b, *a]));
        let walls: Vec<[usize; 4]> = rim.map(|&[a, b]| [a, b, moved[&b], moved[&a]]).collect();
        self.faces.extend(walls);
    }

    /// The face whose middle lies nearest to a place.
    fn at(&self, x: f64, y: f64, z: f64) -> usize {
        let away = |f: &usize| {
            let sum: Vec3 = self.faces[*f].iter().map(|&n| self.points[n].to_vec()).sum();
            Point3::from_vec(sum / 4.0).distance(Point3::new(x, y, z))
        };
        let all = 0..self.faces.len();
        all.min_by(|a, b| away(a).total_cmp(&away(b))).expect("a cage has faces")
    }

    /// Each face divided into four, and all rounded (Catmull and Clark's rule).
    fn rounded(&self) -> Self {
        let point = |n: usize| self.points[n].to_vec();
        let middle = |face: &[usize; 4]| face.iter().map(|&n| point(n)).sum::<Vec3>() / 4.0;
        let count = self.points.len();
        let mut of_sides: BTreeMap<[usize; 2], Vec<usize>> = BTreeMap::new();
        for (f, face) in self.faces.iter().enumerate() {
            for k in 0..4 {
                let (a, b) = (face[k], face[(k + 1) % 4]);
                of_sides.entry([a.min(b), a.max(b)]).or_default().push(f);
            }
        }
        let mut at_corner = vec![(0.0, Vec3::ZERO, Vec3::ZERO); count];
        let middles: Vec<Vec3> = self.faces.iter().map(middle).collect();
        for (face, middle) in self.faces.iter().zip(&middles) {
            face.iter().for_each(|&n| at_corner[n].1 += *middle);
        }
        let mut side_points = BTreeMap::new();
        let mut points: Vec<Vec3> = vec![Vec3::ZERO; count];
        points.extend(&middles);
        for (&[a, b], faces) in &of_sides {
            let half = (point(a) + point(b)) / 2.0;
            for n in [a, b] {
                at_corner[n].0 += 1.0;
                at_corner[n].2 += half;
            }
            side_points.insert([a, b], points.len());
            points.push((half * 2.0 + middles[faces[0]] + middles[faces[1]]) / 4.0);
        }
        for (n, &(valence, faces, sides)) in at_corner.iter().enumerate() {
            let mean = (faces + sides * 2.0) / valence + point(n) * (valence - 3.0);
            points[n] = mean / valence;
        }
        let mut faces = Vec::new();
        for (f, face) in self.faces.iter().enumerate() {
            let side = |k: usize| {
                let (a, b) = (face[k % 4], face[(k + 1) % 4]);
                side_points[&[a.min(b), a.max(b)]]
            };
            faces.extend((0..4).map(|k| [face[k], side(k), count + f, side(k + 3)]));
        }
        Self { points: points.into_iter().map(Point3::from_vec).collect(), faces }
    }

    /// All corners moved a little, alike on the left and on the right, so that no four lie in one
    /// plane.
    fn roughened(mut self, by_mm: f64) -> Self {
        for p in &mut self.points {
            let (x, y, z) = (p.x.abs(), p.y, p.z);
            let way = Vec3::new(0.0, sin(0.31 * x + 0.17 * z), sin(0.23 * y + 0.29 * x + 1.0));
            *p += way * by_mm;
        }
        self
    }

    /// Its faces, each divided along its shorter diagonal.
    fn triangles(&self) -> Solid {
        let halves = |&[a, b, c, d]: &[usize; 4]| {
            let length = |a: usize, b: usize| self.points[a].distance(self.points[b]);
            if length(a, c) <= length(b, d) {
                [vec![a, b, c], vec![a, c, d]]
            } else {
                [vec![a, b, d], vec![b, c, d]]
            }
        };
        let faces = self.faces.iter().flat_map(halves).collect();
        Solid { points: self.points.clone(), faces }
    }
}

/// A bear of 592 triangles that stands on four legs and looks forwards, to −y; 200 mm long.
pub fn animal() -> Solid {
    bear().rounded().roughened(1.5).triangles()
}

/// That bear of 2,368 triangles.
pub fn fine_animal() -> Solid {
    bear().rounded().rounded().roughened(1.5).triangles()
}

fn bear() -> Cage {
    let mut cage = Cage::block(&[-30.0, 0.0, 30.0], &[-60.0, -15.0, 30.0, 75.0], &[50.0, 100.0]);
    for (x, y) in [(-15.0, -37.5), (15.0, -37.5), (-15.0, 52.5), (15.0, 52.5)] {
        let leg = cage.at(x, y, 50.0);
        cage.pull(&[leg], Vec3::new(0.1 * x, 0.0, -25.0), 0.75);
        cage.pull(&[leg], Vec3::new(0.0, -4.0, -25.0), 0.95);
    }
    let neck = [cage.at(-15.0, -60.0, 75.0), cage.at(15.0, -60.0, 75.0)];
    cage.pull(&neck, Vec3::new(0.0, -25.0, 25.0), 0.8);
    cage.pull(&neck, Vec3::new(0.0, -40.0, 4.0), 0.85);
    for x in [-12.0, 12.0] {
        let ear = cage.at(x, -102.0, 130.0);
        cage.pull(&[ear], Vec3::new(0.3 * x, 6.0, 16.0), 0.6);
    }
    cage
}

/// A helmet of 410 triangles with an opening for the face, to −y, a ridge over its top and a brow
/// that stands out; 240 mm high, open below.
pub fn helmet() -> Solid {
    const COLUMNS: usize = 20;
    const ROWS: usize = 11;
    let mut helmet = Solid { points: Vec::new(), faces: Vec::new() };
    for row in 0..ROWS {
        let up = row as f64 / ROWS as f64;
        for column in 0..=COLUMNS - 1 {
            // Column 0 is the middle of the face.
            let turn = TAU * column as f64 / COLUMNS as f64;
            let face = cos(turn).max(0.0);
            let ridge = 14.0 * sin(PI * up) * cos(turn).abs().max(0.8) - 11.2 * sin(PI * up);
            let brow = if row == 7 { 10.0 * face } else { 0.0 };
            let flare = 12.0 * (1.0 - up) * (1.0 - up) * (1.0 - face);
            let round = (1.0 - up * up).sqrt();
            let radius = (95.0 + flare) * round.max(0.2) + 4.0 * ridge.max(0.0) + brow;
            // A little rough, alike on the left and on the right, so that no four lie in one plane.
            let rough = 1.5 * sin(5.0 * up + 3.0 * face + 11.0 * cos(turn));
            let (x, y) = (0.85 * radius * sin(turn), -1.1 * radius * cos(turn));
            helmet.points.push(Point3::new(x, y, 240.0 * sin(0.5 * PI * up) + rough));
        }
    }
    let top = helmet.points.len();
    helmet.points.push(Point3::new(0.0, 0.0, 240.0));
    let at = |row: usize, column: usize| row * COLUMNS + column % COLUMNS;
    for row in 0..ROWS {
        for column in 0..COLUMNS {
            let (a, b) = (at(row, column), at(row, column + 1));
            if row == ROWS - 1 {
                helmet.faces.push(vec![a, b, top]);
                continue;
            }
            // The opening is a cell high and five wide.
            if row == 4 && (column + 3) % COLUMNS < 5 {
                continue;
            }
            let (c, d) = (at(row + 1, column + 1), at(row + 1, column));
            // Diagonals run alike on both sides of the face.
            if 2 * column < COLUMNS {
                helmet.faces.extend([vec![a, b, c], vec![a, c, d]]);
            } else {
                helmet.faces.extend([vec![a, b, d], vec![b, c, d]]);
            }
        }
    }
    helmet
}

/// Every model whose net is looked at, with its name: the solids, prisms and cones, balls, a
/// football, an animal and a helmet.
pub fn models() -> Vec<(String, Solid)> {
    let solids = solids::platonic().into_iter().chain(solids::archimedean());
    let mut models: Vec<(String, Solid)> =
        solids.map(|(name, solid)| (name.to_owned(), solid)).collect();
    for sides in [3, 4, 5, 6, 8, 12, 16, 24, 32, 48, 64] {
        models.push((format!("prism {sides}"), solids::prism(sides, 80.0)));
    }
    for sides in [6, 8, 12, 16, 24, 32, 48, 64] {
        models.push((format!("cone {sides}"), solids::closed_cone(sides, 80.0)));
    }
    for times in [1, 2, 3] {
        let ball = solids::icosphere(times);
        models.push((format!("icosphere {}", ball.faces.len()), ball));
    }
    models.push(("football".to_owned(), solids::football()));
    models.push(("animal".to_owned(), animal()));
    models.push(("helmet".to_owned(), helmet()));
    models
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_models_are_meshes_of_that_many_triangles() {
        let bear = animal().mesh();
        assert_eq!((bear.triangles().len(), bear.euler(), bear.loops().len()), (592, 2, 0));
        let helmet = helmet().mesh();
        assert_eq!((helmet.triangles().len(), helmet.loops().len()), (410, 2));
    }
}
