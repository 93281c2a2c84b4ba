//! What depends on all parts of a design: where the parts of meshes meet, how that is marked, and
//! which edges are joined.

use super::part::{Joint, Origin, Part};
use crate::edge::{MeshBorder, PartEdges, edges_of_meshes, join_mates};
use crate::pattern::{EdgeMark, PatternOptions, joint_mark, piece, seam_marks};
use sheetwright_geometry::math::Point3;

/// Numbers the joints of meshes through the design, names the edges of their parts, and draws their
/// patterns with both. Parts of one panel stand side by side.
pub(super) fn join_meshes(parts: &mut [&mut Part]) {
    if parts.iter().all(|part| part.given().is_none()) {
        return;
    }
    number_joints(parts);
    let borders = parts.iter().enumerate().filter_map(|(number, part)| {
        let joints = &part.given()?.joints;
        Some(MeshBorder {
            part: number,
            name: &part.name,
            sheet: &part.sheet,
            flat: &part.flat.points,
            joints: joints.iter().map(|joint| (joint.with, &joint.steps[..])).collect(),
        })
    });
    let borders: Vec<MeshBorder<'_>> = borders.collect();
    let numbers: Vec<usize> = borders.iter().map(|border| border.part).collect();
    let edges = edges_of_meshes(&borders);
    for (number, edges) in numbers.into_iter().zip(edges) {
        let part = &mut *parts[number];
        part.edges = edges;
        let joints = part.given().map_or(&[][..], |given| &given.joints);
        let is_net = part.given().is_some_and(|given| given.is_net);
        let mark = |joint: &Joint| EdgeMark {
            mark: joint.mark.clone(),
            steps: joint.steps.clone(),
            first: true,
        };
        let mut marks = seam_marks(&part.sheet);
        marks.extend(joints.iter().map(mark));
        // A net has a mark at every side, and no room for lengths.
        marks.iter_mut().for_each(|mark| mark.first &= !is_net);
        let options = PatternOptions { bends: part.bends, is_net, is_bare: false };
        part.piece = piece(
            &part.name,
            &part.sheet,
            &part.flat,
            &part.edges,
            &part.measures,
            &marks,
            &options,
        );
    }
}

/// Counts joints and parts through the design, where they were counted through each panel.
fn number_joints(parts: &mut [&mut Part]) {
    let (mut panel_begins, mut joints_before, mut joints_so_far) = (0, 0, 0);
    for number in 0..parts.len() {
        let begins_panel = number == 0 || parts[number].panel != parts[number - 1].panel;
        if begins_panel {
            (panel_begins, joints_before) = (number, joints_so_far);
        }
        let Origin::Given(given) = &mut parts[number].origin else { continue };
        for joint in &mut given.joints {
            let (of_panel, with) = joint.in_panel;
            joint.mark = joint_mark(joints_before + of_panel);
            joint.with = panel_begins + with;
            joints_so_far = joints_so_far.max(joints_before + of_panel + 1);
        }
    }
}

/// Looks for the mates of the edges of all parts of a design: those that were drawn to meet.
pub(super) fn find_mates(parts: &mut [Part]) {
    let drawn: Vec<Vec<Point3>> = parts.iter().map(Part::drawn).collect();
    let parts = parts.iter_mut().zip(&drawn).map(|(part, space)| PartEdges {
        edges: &mut part.edges,
        space,
        flat: &part.flat.points,
    });
    join_mates(&mut parts.collect::<Vec<_>>());
}
