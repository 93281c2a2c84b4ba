//! The Gauss image: the directions that the surface faces along its rungs, as points on a sphere.
//!
//! Along a ruling of a developable surface the tangent plane stays the same, so that both ends of a
//! rung have one normal and the image is a curve. Warp spreads it to a ribbon, as wide as the warp
//! angle.

use super::canvas::{Anchor, PathData, Picture, WIDTH, circle, line, round_below, scale_bar, text};
use super::strips::strips;
use crate::space::{RUNG_CLASSES, View, rung_classes};
use crate::wording::decimal;
use sheetwright::disjoint::DisjointSets;
use sheetwright::index::{TriangleIndex, VertexIndex};
use sheetwright::make::{Found, Origin, Part};
use sheetwright::material::Material;
use sheetwright::math::{Point2, Vec3, angle_between, cos, from_deg, sin, to_deg, unit};
use sheetwright::mesh::{Mesh, crease_angles};
use std::collections::BTreeMap;

const HEIGHT: f64 = 236.0;
const RADIUS: f64 = 102.0;
/// The largest spread of an image that is also drawn enlarged, beside the sphere, degrees. The
/// spread is the largest angle of a normal to the middle; within this limit an angle has nearly one
/// size all over the image.
const WIDEST: f64 = 60.0;
/// The least spread of an enlarged image, degrees: below it, all normals face one way.
const NARROWEST: f64 = 0.05;
/// The most rungs drawn.
const RUNGS: usize = 70;
/// The most sides of a mesh drawn.
const MESH_SIDES: usize = 4000;
/// The class of those sides.
const NET: &str = "net";
/// The most distinct sides of a mesh drawn with thick lines and with dots at their directions.
const FEW: usize = 160;
/// Creases that turn by more than this, degrees, separate two directions.
const SHARP_DEG: f64 = 30.0;
/// Lines shorter than this in the picture are not visible.
const SEEN: f64 = 0.05;
/// Points of a curve that lie closer than this in the picture are left out.
const APART: f64 = 0.5;

/// The Gauss image of a part, on the sphere and enlarged. It shows the normals along the rungs of a
/// found surface, and the sides of a mesh as lines between the directions at their ends. `None` if
/// no rung has normals, or no triangles of the mesh meet.
pub fn gauss_picture(part: &Part, material: Option<&Material>) -> Option<Picture> {
    let image = match &part.origin {
        Origin::Found(found) => Image::of(part, found, material),
        Origin::Given(given) => Image::of_mesh(&given.mesh),
    };
    image.map(|image| pictured(&image, &part.name))
}

fn pictured(image: &Image, name: &str) -> Picture {
    let spread = image.spread();
    let enlarged = (NARROWEST..=WIDEST).contains(&to_deg(spread));
    let centre = Point2::new(if enlarged { 116.0 } else { 0.5 * WIDTH }, 0.5 * HEIGHT);
    let (mut body, names) = sphere(&image.view, centre);
    let on_sphere = |n: Vec3| {
        let p = image.view.direction(n);
        Point2::new(centre.x + RADIUS * p.x, centre.y - RADIUS * p.y)
    };
    body += &image.draw(on_sphere, |n| n.dot(image.view.toward) >= 0.0);
    body += &names;
    if enlarged {
        body += &image.enlarged(spread);
    }
    let title = format!("{name}: directions that the surface faces");
    Picture::new(WIDTH, HEIGHT, title, body)
}

/// The directions that a panel faces, and the view of them from their middle.
struct Image {
    view: View,
    /// Runs of rungs, each with the normals on both sides of the strip.
    strips: Vec<Vec<[Vec3; 2]>>,
    /// Rungs that are drawn, with their class.
    rungs: Vec<(&'static str, [Vec3; 2])>,
}

impl Image {
    fn of(part: &Part, found: &Found, material: Option<&Material>) -> Option<Self> {
        let measured = &part.measures.rungs;
        let known = |n: &usize| measured[*n].normals[0] != Vec3::ZERO;
        let mut middle = Vec3::ZERO;
        for n in (0..measured.len()).filter(known) {
            middle += measured[n].normals[0] + measured[n].normals[1];
        }
        if !(0..measured.len()).any(|n| known(&n)) {
            return None;
        }
        let facing = unit(middle).or(unit(found.boundary.area_vector())).unwrap_or(Vec3::Z);
        let mut runs = Vec::new();
        for strip in strips(found.surface.connectivity()) {
            let mut run = Vec::new();
            for (n, sides) in strip {
                if !known(&n) {
                    runs.push(std::mem::take(&mut run));
                    continue;
                }
                let [low, high] = measured[n].normals;
                let as_it_is = sides == measured[n].rung.ends();
                run.push(if as_it_is { [low, high] } else { [high, low] });
            }
            runs.push(run);
        }
        runs.retain(|run| !run.is_empty());
        let classes = rung_classes(part, material, RUNGS);
        let drawn = (0..measured.len()).filter(known);
        let rungs = drawn.filter_map(|n| Some((classes[n]?, measured[n].normals))).collect();
        Some(Self { view: View::from(facing), strips: runs, rungs })
    }

    fn of_mesh(mesh: &Mesh) -> Option<Self> {
        let areas = (0..mesh.triangles().len()).map(|t| mesh.area_vector(TriangleIndex::new(t)));
        let areas: Vec<Vec3> = areas.collect();
        if !mesh.edges().iter().any(|edge| !edge.is_border()) {
            return None;
        }
        let sides = sides_on_ball(mesh, &areas);
        let first = sides.first()?[0];
        let facing = unit(areas.iter().copied().sum()).unwrap_or(first);
        let every = sides.len().div_ceil(MESH_SIDES);
        let rungs = sides.into_iter().step_by(every).map(|normals| (NET, normals)).collect();
        Some(Self { view: View::from(facing), strips: Vec::new(), rungs })
    }

    /// The largest angle between a normal and the middle, radians.
    fn spread(&self) -> f64 {
        let of_rungs = self.rungs.iter().flat_map(|(_, normals)| normals);
        let normals = self.strips.iter().flatten().flatten().chain(of_rungs);
        normals.map(|&n| angle_between(n, self.view.toward)).fold(0.0, f64::max)
    }

    /// Draws the rungs, then the two sides of every strip. Directions that are not `visible` lie
    /// behind the sphere and are left out.
    fn draw(&self, place: impl Fn(Vec3) -> Point2, visible: impl Fn(Vec3) -> bool) -> String {
        let mut body = String::new();
        // Strips whose rungs all face one way.
        let mut dots = String::new();
        for wanted in RUNG_CLASSES {
            let mut path = PathData::default();
            for ends in self.ends_of(wanted, &place, &visible) {
                if ends[0].distance(ends[1]) > SEEN {
                    path.line(ends);
                }
            }
            body += &path.element(wanted);
        }
        body += &net(self.ends_of(NET, &place, &visible));
        for side in [0, 1] {
            let (mut front, mut behind) = (PathData::default(), PathData::default());
            for strip in &self.strips {
                let mut run: Vec<Point2> = Vec::new();
                let mut in_front = visible(strip[0][side]);
                for pair in strip {
                    let (at, seen) = (place(pair[side]), visible(pair[side]));
                    if seen != in_front {
                        run.push(at);
                        let path = if in_front { &mut front } else { &mut behind };
                        path.line(std::mem::take(&mut run));
                        in_front = seen;
                    }
                    if run.last().is_none_or(|last| last.distance(at) >= APART) {
                        run.push(at);
                    }
                }
                if let [only] = run[..] {
                    dots += &circle("head", only, 4.0);
                    continue;
                }
                let path = if in_front { &mut front } else { &mut behind };
                path.line(run);
            }
            body += &behind.element("curve behind");
            body += &front.element(if side == 0 { "curve" } else { "curve other" });
        }
        body + &dots
    }

    /// The ends of the rungs of a class in the picture, of rungs with both ends visible.
    fn ends_of(
        &self,
        class: &str,
        place: impl Fn(Vec3) -> Point2,
        visible: impl Fn(Vec3) -> bool,
    ) -> Vec<[Point2; 2]> {
        let of_class = self.rungs.iter().filter(|rung| rung.0 == class).map(|rung| rung.1);
        let seen = of_class.filter(|normals| normals.iter().all(|&n| visible(n)));
        seen.map(|normals| normals.map(&place)).collect()
    }

    /// The image alone, angles from its middle to scale.
    fn enlarged(&self, spread: f64) -> String {
        const HALF: f64 = 96.0;
        let centre = Point2::new(WIDTH - 124.0, 0.5 * HEIGHT - 10.0);
        let scale = HALF / to_deg(spread);
        let place = |n: Vec3| {
            let flat = self.view.direction(n).to_vec();
            let length = flat.length();
            // At the middle itself the direction is arbitrary.
            let way = if length > 0.0 { flat / length } else { flat };
            let deg = to_deg(angle_between(n, self.view.toward));
            Point2::new(centre.x + scale * deg * way.x, centre.y - scale * deg * way.y)
        };
        let bar = round_below(0.9 * HALF / scale);
        let decimals = if bar >= 1.0 {
            0
        } else if bar >= 0.1 {
            1
        } else {
            2
        };
        let label = format!("{}°", decimal(bar, decimals));
        let corner = Point2::new(WIDTH - 20.0, HEIGHT - 8.0);
        self.draw(place, |_| true)
            + &scale_bar(corner, scale * bar, &label)
            + &text("quiet", Anchor::Start, Point2::new(WIDTH - 228.0, HEIGHT - 8.0), "enlarged")
    }
}

/// The lines between directions of a mesh, each once: the thin lines of a net, or, up to [`FEW`]
/// lines, thick lines with dots, which stand out from the circles of the ball.
fn net(sides: Vec<[Point2; 2]>) -> String {
    let rounded = |p: Point2| [p.x, p.y].map(|x| (x / SEEN).round() as i64);
    let mut places: BTreeMap<[i64; 2], Point2> = BTreeMap::new();
    let mut lines: BTreeMap<[[i64; 2]; 2], [Point2; 2]> = BTreeMap::new();
    for ends in sides {
        let mut key = ends.map(rounded);
        key.iter().zip(ends).for_each(|(key, end)| {
            places.entry(*key).or_insert(end);
        });
        key.sort_unstable();
        if key[0] != key[1] {
            lines.entry(key).or_insert(ends);
        }
    }
    let is_few = lines.len() <= FEW;
    let mut path = PathData::default();
    lines.into_values().for_each(|ends| path.line(ends));
    let mut body = path.element(if is_few { "curve few" } else { NET });
    if is_few {
        places.into_values().for_each(|at| body += &circle("head", at, 2.5));
    }
    body
}

/// The sides of a mesh as they lie on the ball: each joins the directions that the mesh faces at
/// its two ends. The direction at a vertex is the mean of the triangles around it, weighted by
/// their areas. On a sharp crease a vertex has one direction on either side, and a line joins the
/// two. The directions of single triangles would jump from side to side, and their lines would be a
/// tangle.
fn sides_on_ball(mesh: &Mesh, areas: &[Vec3]) -> Vec<[Vec3; 2]> {
    let corner = |t: TriangleIndex, v: VertexIndex| {
        3 * t.get() + mesh.triangles()[t.get()].iter().position(|&c| c == v).unwrap_or(0)
    };
    let inner = || {
        mesh.edges().iter().zip(crease_angles(mesh)).filter_map(|(edge, angle)| {
            let [Some(left), Some(right)] = edge.triangles else { return None };
            Some((edge.ends, [left, right], angle.abs() > from_deg(SHARP_DEG)))
        })
    };
    // Corners that have one direction.
    let mut same = DisjointSets::new(3 * areas.len());
    for (ends, [left, right], is_sharp) in inner() {
        for v in ends {
            if !is_sharp {
                same.join(corner(left, v), corner(right, v));
            }
        }
    }
    let roots = same.all_first();
    let mut sums = vec![Vec3::ZERO; roots.len()];
    for (n, &of) in roots.iter().enumerate() {
        sums[of] += areas[n / 3];
    }
    let facing = |t: TriangleIndex, v: VertexIndex| unit(sums[roots[corner(t, v)]]);
    let mut sides = Vec::new();
    for ([a, b], [left, right], is_sharp) in inner() {
        sides.push([facing(left, a), facing(left, b)]);
        if is_sharp {
            sides.push([facing(right, a), facing(right, b)]);
            sides.push([facing(left, a), facing(right, a)]);
            sides.push([facing(left, b), facing(right, b)]);
        }
    }
    sides.into_iter().filter_map(|[a, b]| Some([a?, b?])).collect()
}

/// A ball with circles of latitude and longitude about z, and the names of its axes, which lie over
/// everything.
fn sphere(view: &View, centre: Point2) -> (String, String) {
    let mut grid = PathData::default();
    let mut arc = |point: &dyn Fn(f64) -> Vec3, from: i32, to: i32| {
        let mut run: Vec<Point2> = Vec::new();
        for n in from..=to {
            let at = point(from_deg(10.0 * f64::from(n)));
            let p = view.direction(at);
            // Points behind the ball are left out.
            if at.dot(view.toward) >= 0.0 {
                run.push(Point2::new(centre.x + RADIUS * p.x, centre.y - RADIUS * p.y));
            } else if run.len() > 1 {
                grid.line(std::mem::take(&mut run));
            } else {
                run.clear();
            }
        }
        if run.len() > 1 {
            grid.line(run);
        }
    };
    for latitude in [-60.0, -30.0, 0.0, 30.0, 60.0] {
        let (level, height) = (cos(from_deg(latitude)), sin(from_deg(latitude)));
        arc(&|a| Vec3::new(level * cos(a), level * sin(a), height), 0, 36);
    }
    for longitude in 0..12 {
        let a = from_deg(30.0 * f64::from(longitude));
        arc(&|l| Vec3::new(cos(l) * cos(a), cos(l) * sin(a), sin(l)), -9, 9);
    }
    let mut names = String::new();
    let mut body = circle("ball", centre, RADIUS) + &grid.element("grid");
    for (axis, name) in [(Vec3::X, "x"), (Vec3::Y, "y"), (Vec3::Z, "z")] {
        for (sign, mark) in [(1.0, "+"), (-1.0, "−")] {
            let p = view.direction(axis * sign).to_vec();
            // Axes that come out near the rim have room for their name.
            if p.length() < 0.7 || axis.dot(view.toward) * sign < -0.05 {
                continue;
            }
            let at = |r: f64| Point2::new(centre.x + r * p.x, centre.y - r * p.y);
            let end = at(RADIUS + 8.0 / p.length());
            body += &line("axis", &[at(RADIUS), end]);
            let word = at(RADIUS * 0.86);
            let word = Point2::new(word.x, word.y + 4.0);
            names += &text("halo quiet", Anchor::Middle, word, &format!("{mark}{name}"));
        }
    }
    (body, names)
}
