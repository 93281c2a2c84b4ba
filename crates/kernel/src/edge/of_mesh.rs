//! The edges of the parts of meshes: where they meet one another, the sides of their cuts, and
//! their border.

use super::border::edges_of;
use super::{Edge, EdgeSource};
use crate::sample::StepPlace;
use crate::sheet::Sheet;
use sheetwright_geometry::index::VertexIndex;
use sheetwright_geometry::math::Point2;
use std::collections::BTreeMap;

/// A part of a mesh whose edges are looked for.
#[derive(Clone, Debug)]
pub(crate) struct MeshBorder<'a> {
    /// Its number among the parts of the design.
    pub(crate) part: usize,
    /// Its name.
    pub(crate) name: &'a str,
    /// Its sheet.
    pub(crate) sheet: &'a Sheet,
    /// Where the vertices of its sheet lie on the pattern, mm.
    pub(crate) flat: &'a [Point2],
    /// Where it is joined to parts that it was divided from: the number of each, and the steps of
    /// its border, the sheet to the left.
    pub(crate) joints: Vec<(usize, &'a [[VertexIndex; 2]])>,
}

/// The edges of all parts of meshes of a design. They have no mates yet.
pub(crate) fn edges_of_meshes(parts: &[MeshBorder<'_>]) -> Vec<Vec<Edge>> {
    // Parts that were not divided from one another meet where their steps lie on one another.
    let mut at_step: BTreeMap<StepPlace, Vec<usize>> = BTreeMap::new();
    for part in parts {
        for step in part.sheet.border_steps() {
            at_step.entry(part.place(step)).or_default().push(part.part);
        }
    }
    let name_of = |with: usize| {
        let found = parts.iter().find(|part| part.part == with);
        found.map_or_else(String::new, |part| part.name.to_owned())
    };
    let of_part = |part: &MeshBorder<'_>| {
        let joints = part.joints.iter();
        let of_joints: BTreeMap<[VertexIndex; 2], usize> =
            joints.flat_map(|&(with, steps)| steps.iter().map(move |&step| (step, with))).collect();
        let source = |step: [VertexIndex; 2]| {
            let meets = || {
                let all = at_step.get(&part.place(step)).into_iter().flatten();
                all.copied().find(|&other| other != part.part)
            };
            let with = of_joints.get(&step).copied().or_else(meets);
            with.map_or(EdgeSource::Border, |with| EdgeSource::Part { with })
        };
        let name = |source: EdgeSource| match source {
            EdgeSource::Part { with } => name_of(with),
            _ => "border".to_owned(),
        };
        edges_of(part.sheet, part.flat, source, name)
    };
    parts.iter().map(of_part).collect()
}

impl MeshBorder<'_> {
    fn place(&self, step: [VertexIndex; 2]) -> StepPlace {
        StepPlace::between(step.map(|v| self.sheet.mesh().position(v)))
    }
}
