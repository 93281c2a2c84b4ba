//! The edges of the panels of meshes: where they meet one another, the sides of their cuts, and
//! their border.

use super::border::{Step, edges};
use super::of_sheet::cut_name;
use super::{Edge, EdgeSource};
use crate::mesh::CutMesh;
use crate::sample::StepPlace;
use sheetwright_geometry::index::VertexIndex;
use sheetwright_geometry::math::Point2;
use std::collections::BTreeMap;

/// What a panel is joined to, by the number of the panel, and the sides of triangles along which it
/// is, by vertices of its sheet, which lies to their left.
pub type MeshJoint = (usize, Vec<[VertexIndex; 2]>);

/// A panel of a mesh whose edges are looked for.
#[derive(Clone, Copy, Debug)]
pub struct MeshBorder<'a> {
    /// Its name.
    pub name: &'a str,
    /// Its sheet.
    pub sheet: &'a CutMesh,
    /// Where the vertices of its sheet lie on the pattern, mm.
    pub flat: &'a [Point2],
    /// Where it is joined to panels that it was divided from, itself among them.
    pub joints: &'a [MeshJoint],
}

/// The edges of all panels of a design. They have no mates yet.
pub fn edges_of_meshes(panels: &[MeshBorder<'_>]) -> Vec<Vec<Edge>> {
    // Panels that were not divided from one another meet where their sides lie on one another.
    let mut at_side: BTreeMap<StepPlace, Vec<usize>> = BTreeMap::new();
    for (number, panel) in panels.iter().enumerate() {
        for side in panel.sides() {
            at_side.entry(panel.place(side)).or_default().push(number);
        }
    }
    let of_panel = |(number, panel): (usize, &MeshBorder<'_>)| {
        let known = panel.known();
        let source = |side: [VertexIndex; 2]| {
            let meets = || {
                let all = at_side.get(&panel.place(side)).into_iter().flatten();
                let other = all.copied().find(|&other| other != number);
                other.map(|with| EdgeSource::Panel { with })
            };
            known.get(&side).copied().or_else(meets).unwrap_or(EdgeSource::Border)
        };
        let step = |side: [VertexIndex; 2]| -> Step { (side[0].get(), source(side)) };
        let loops: Vec<Vec<Step>> = panel
            .sheet
            .mesh
            .loops()
            .iter()
            .map(|line| sides_of(line).map(step).collect())
            .collect();
        let name = |source: EdgeSource| match source {
            EdgeSource::Cut { number, second } => cut_name(number, second),
            EdgeSource::Panel { with } => panels[with].name.to_owned(),
            _ => "border".to_owned(),
        };
        edges(&loops, name, panel.sheet.mesh.positions(), panel.flat)
    };
    panels.iter().enumerate().map(of_panel).collect()
}

/// The sides along a loop of vertices.
fn sides_of(line: &[VertexIndex]) -> impl Iterator<Item = [VertexIndex; 2]> + '_ {
    let next = line.iter().cycle().skip(1);
    line.iter().zip(next).map(|(&a, &b)| [a, b])
}

impl MeshBorder<'_> {
    fn sides(&self) -> impl Iterator<Item = [VertexIndex; 2]> + '_ {
        self.sheet.mesh.loops().iter().flat_map(|line| sides_of(line))
    }

    fn place(&self, side: [VertexIndex; 2]) -> StepPlace {
        StepPlace::between(side.map(|v| self.sheet.mesh.position(v)))
    }

    /// The sides of cuts and joints, in the direction of the loops.
    fn known(&self) -> BTreeMap<[VertexIndex; 2], EdgeSource> {
        let mut known = BTreeMap::new();
        for (number, seam) in self.sheet.seams.iter().enumerate() {
            for (side, second) in seam.sides.iter().zip([false, true]) {
                for pair in side.windows(2) {
                    // The sheet lies to the right of the second side.
                    let ends = if second { [pair[1], pair[0]] } else { [pair[0], pair[1]] };
                    known.insert(ends, EdgeSource::Cut { number, second });
                }
            }
        }
        for (with, steps) in self.joints {
            known.extend(steps.iter().map(|&step| (step, EdgeSource::Panel { with: *with })));
        }
        known
    }
}
