//! From the polygons of a file to the triangles of its groups.

use super::doubled::Polygons;
use super::polygon::{MOST_CORNERS, split};
use super::{NO_SURFACE, too_many};
use crate::names::made_for_files;
use crate::reading::InputError;
use sheetwright::math::Point3;
use sheetwright::mesh::{MAX_MESH_COORDINATE_MM, MAX_TRIANGLES};
use std::collections::{BTreeMap, BTreeSet};

/// The name of a group whose own name can't be the name of a file.
const UNNAMED: &str = "mesh";
/// The most groups of a file; each becomes a panel.
const MAX_GROUPS: usize = 1000;
/// The most bytes of a group's name: the number of a part must fit behind it.
const MAX_GROUP_NAME: usize = 80;

/// A finished group.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Built {
    pub(crate) name: String,
    pub(crate) positions: Vec<Point3>,
    /// Each by the indices of its corners in `positions`.
    pub(crate) triangles: Vec<[usize; 3]>,
    /// Lines of the file along sides of its triangles, each by indices in `positions`.
    pub(crate) seams: Vec<Vec<usize>>,
    /// The number of its triangles that are left out because two corners coincide.
    pub(crate) left_out: usize,
}

/// A group with triangles by the indices of the file's points.
#[derive(Clone, Debug, Default)]
struct Group {
    name: String,
    triangles: Vec<[usize; 3]>,
    polygons: Polygons,
    left_out: usize,
}

impl Group {
    /// Leaves out the triangles with two corners in one place.
    fn leave_out(&mut self) {
        let before = self.triangles.len();
        self.triangles.retain(|[a, b, c]| a != b && b != c && c != a);
        self.left_out += before - self.triangles.len();
    }
}

/// The finished groups of a file.
pub(crate) struct AllBuilt {
    pub(crate) groups: Vec<Built>,
    /// How many lines of the file run along sides of triangles all the way.
    pub(crate) seam_lines: usize,
}

/// Gathers points and polygons, in the order of the file.
pub(crate) struct Builder {
    place: String,
    stem: String,
    unit_mm: f64,
    points: Vec<Point3>,
    groups: Vec<Group>,
    /// Lines by the indices of their points.
    lines: Vec<Vec<usize>>,
    /// The number of points of all lines.
    line_points: usize,
    /// The indices of the groups, by their names in the file.
    known: BTreeMap<String, usize>,
    triangles: usize,
    /// The index of the group that the next polygon belongs to.
    at: usize,
    welded: bool,
}

impl Builder {
    pub(crate) fn new(place: &str, stem: &str, unit_mm: f64) -> Self {
        Self {
            place: place.to_owned(),
            stem: stem.to_owned(),
            unit_mm,
            points: Vec::new(),
            groups: vec![Group::default()],
            lines: Vec::new(),
            line_points: 0,
            known: BTreeMap::new(),
            triangles: 0,
            at: 0,
            welded: false,
        }
    }

    /// Makes corners with equal coordinates, to the last bit, one. For formats that give every
    /// triangle corners of its own, or a corner several points where normals differ.
    pub(crate) fn weld(&mut self) {
        self.welded = true;
    }

    /// The number of points so far.
    pub(crate) fn points(&self) -> usize {
        self.points.len()
    }

    /// Adds a point, in the unit of the file; `where_from` gives its place for errors.
    pub(crate) fn point(
        &mut self,
        [x, y, z]: [f64; 3],
        where_from: impl Fn() -> String,
    ) -> Result<(), InputError> {
        let point = Point3::new(x * self.unit_mm, y * self.unit_mm, z * self.unit_mm);
        let fits = [point.x, point.y, point.z].iter().all(|c| c.abs() <= MAX_MESH_COORDINATE_MM);
        if !fits {
            return Err(InputError::at(
                where_from(),
                "a coordinate is not a finite number within ±1e11 mm",
                "Check the units and the numbers.",
            ));
        }
        // Before welding, every triangle may have three points of its own.
        if self.points.len() == 3 * MAX_TRIANGLES {
            return Err(too_many(where_from()));
        }
        // Adding 0 turns −0 into 0, so that equal points have equal bits.
        self.points.push(Point3::new(point.x + 0.0, point.y + 0.0, point.z + 0.0));
        Ok(())
    }

    /// Begins a new group of this name; the next polygons belong to it.
    pub(crate) fn begin(
        &mut self,
        name: &str,
        where_from: impl Fn() -> String,
    ) -> Result<(), InputError> {
        let last = &self.groups[self.groups.len() - 1];
        if last.triangles.is_empty() && last.left_out == 0 {
            self.groups.pop();
        }
        if self.groups.len() == MAX_GROUPS {
            let message = format!("the mesh has more than {MAX_GROUPS} groups");
            let hint = "Every group becomes a panel: merge groups that are one piece of sheet.";
            return Err(InputError::at(where_from(), message, hint));
        }
        self.groups.push(Group { name: name.to_owned(), ..Group::default() });
        self.at = self.groups.len() - 1;
        Ok(())
    }

    /// Continues the group of this name, or begins it; the next polygons belong to it.
    pub(crate) fn go_on(
        &mut self,
        name: &str,
        where_from: impl Fn() -> String,
    ) -> Result<(), InputError> {
        let known = self.known.get(name).copied();
        match known.filter(|&at| self.groups.get(at).is_some_and(|group| group.name == name)) {
            Some(at) => self.at = at,
            None => {
                self.begin(name, where_from)?;
                self.known.insert(name.to_owned(), self.at);
            }
        }
        Ok(())
    }

    /// Adds a polygon by the indices of its points, all of which must exist.
    pub(crate) fn polygon(
        &mut self,
        corners: &[usize],
        where_from: impl Fn() -> String,
    ) -> Result<(), InputError> {
        let group = &mut self.groups[self.at];
        let mut ring: Vec<usize> = corners.to_vec();
        ring.dedup_by_key(|corner| self.points[*corner].to_vec().to_array().map(f64::to_bits));
        while ring.len() > 1 && self.points[ring[0]] == self.points[ring[ring.len() - 1]] {
            ring.pop();
        }
        if ring.len() < 3 {
            group.left_out += 1;
            return Ok(());
        }
        let Some(triangles) = split(&self.points, &ring) else {
            let count = ring.len();
            let message = format!(
                "the face has {count} corners and is not convex; the limit is {MOST_CORNERS}"
            );
            let hint = "Divide it, or export it as triangles.";
            return Err(InputError::at(where_from(), message, hint));
        };
        self.triangles += triangles.len();
        if self.triangles > MAX_TRIANGLES {
            return Err(too_many(where_from()));
        }
        let first = group.triangles.len();
        group.triangles.extend(triangles);
        group.polygons.add(&self.points, &ring, first..group.triangles.len());
        Ok(())
    }

    /// Adds a line by the indices of its points, which must exist once all points are added.
    pub(crate) fn line(
        &mut self,
        points: Vec<usize>,
        where_from: impl Fn() -> String,
    ) -> Result<(), InputError> {
        self.line_points += points.len();
        // As many points as all triangles have corners.
        if self.line_points > 3 * MAX_TRIANGLES {
            return Err(too_many(where_from()));
        }
        self.lines.push(points);
        Ok(())
    }

    /// The groups that have triangles, each with the points that its triangles use. The first group
    /// also counts the triangles left out of groups that end up empty.
    pub(crate) fn built(mut self) -> Result<AllBuilt, InputError> {
        for group in &mut self.groups {
            let polygons = std::mem::take(&mut group.polygons);
            polygons.divide_alike(&self.points, &mut group.triangles);
        }
        // In a file whose triangles share no point, equal coordinates must mean one point.
        let mut used = vec![false; self.points.len()];
        let corners = self.groups.iter().flat_map(|group| group.triangles.iter().flatten());
        let shared = corners.into_iter().any(|&corner| std::mem::replace(&mut used[corner], true));
        if self.welded || !shared {
            weld(&self.points, &mut self.groups, &mut self.lines);
        }
        // Only after welding is it known which triangles have coinciding corners.
        let Self { place, points, mut groups, lines, stem, .. } = self;
        groups.iter_mut().for_each(Group::leave_out);
        let (mut kept, lost): (Vec<Group>, Vec<Group>) =
            groups.into_iter().partition(|group| !group.triangles.is_empty());
        let Some(first) = kept.first_mut() else {
            return Err(InputError::at(place, "the mesh has no triangle", NO_SURFACE));
        };
        first.left_out += lost.iter().map(|group| group.left_out).sum::<usize>();
        let several = kept.len() > 1;
        let lines = Lines::of(&lines);
        let mut on_sides = BTreeSet::new();
        let built = |group: Group| {
            let seams = lines.along(&group.triangles, &mut on_sides);
            built(&points, group, &seams, &stem, several)
        };
        let groups = kept.into_iter().map(built).collect();
        let seam_lines = lines.all_on(&on_sides);
        Ok(AllBuilt { groups, seam_lines })
    }
}

/// Replaces each corner by the first point with equal coordinates.
fn weld(points: &[Point3], groups: &mut [Group], lines: &mut [Vec<usize>]) {
    let mut first: BTreeMap<[u64; 3], usize> = BTreeMap::new();
    let of: Vec<usize> = points
        .iter()
        .enumerate()
        .map(|(n, p)| *first.entry([p.x, p.y, p.z].map(f64::to_bits)).or_insert(n))
        .collect();
    let corners = groups.iter_mut().flat_map(|group| group.triangles.iter_mut().flatten());
    for corner in corners.chain(lines.iter_mut().flatten()) {
        *corner = of[*corner];
    }
}

fn built(points: &[Point3], group: Group, seams: &[&[usize]], stem: &str, several: bool) -> Built {
    let mut used: Vec<usize> = group.triangles.iter().flatten().copied().collect();
    used.sort_unstable();
    used.dedup();
    let number = |corner: usize| used.partition_point(|&other| other < corner);
    let triangles = group.triangles.iter().map(|t| t.map(number)).collect();
    let seams = seams.iter().map(|run| run.iter().copied().map(number).collect()).collect();
    let named = [group.name.as_str(), if several { "" } else { stem }, stem, UNNAMED];
    let name = named
        .into_iter()
        .map(|name| made_for_files(name, MAX_GROUP_NAME))
        .find(|name| !name.is_empty())
        .unwrap_or_else(|| UNNAMED.to_owned());
    let positions = used.iter().map(|&n| points[n]).collect();
    Built { name, positions, triangles, seams, left_out: group.left_out }
}

/// The lines of a file, and the first step of them between every two points: its line, and its
/// number in that.
struct Lines<'a> {
    lines: &'a [Vec<usize>],
    first: BTreeMap<[usize; 2], (usize, usize)>,
}

impl<'a> Lines<'a> {
    fn of(lines: &'a [Vec<usize>]) -> Self {
        let mut first = BTreeMap::new();
        for (n, line) in lines.iter().enumerate() {
            for (step, ends) in line.windows(2).enumerate() {
                first.entry(side(ends[0], ends[1])).or_insert((n, step));
            }
        }
        Self { lines, first }
    }

    /// The runs of lines along sides of triangles, whose steps are noted. Other steps, as between
    /// loose points, are no seams.
    fn along(
        &self,
        triangles: &[[usize; 3]],
        noted: &mut BTreeSet<(usize, usize)>,
    ) -> Vec<&'a [usize]> {
        if self.first.is_empty() {
            return Vec::new();
        }
        let sides = triangles.iter().flat_map(|&[a, b, c]| [side(a, b), side(b, c), side(c, a)]);
        let mut steps: Vec<(usize, usize)> =
            sides.filter_map(|side| self.first.get(&side).copied()).collect();
        steps.sort_unstable();
        steps.dedup();
        noted.extend(&steps);
        let runs = steps.chunk_by(|a, b| a.0 == b.0 && a.1 + 1 == b.1);
        runs.map(|run| &self.lines[run[0].0][run[0].1..run[0].1 + run.len() + 1]).collect()
    }

    /// How many lines run along sides all the way, of which `noted` has the first steps.
    fn all_on(&self, noted: &BTreeSet<(usize, usize)>) -> usize {
        let is_on = |ends: &[usize]| {
            let first = self.first.get(&side(ends[0], ends[1]));
            first.is_some_and(|step| noted.contains(step))
        };
        let all_on = |line: &&Vec<usize>| line.len() > 1 && line.windows(2).all(is_on);
        self.lines.iter().filter(all_on).count()
    }
}

fn side(a: usize, b: usize) -> [usize; 2] {
    [a.min(b), a.max(b)]
}
