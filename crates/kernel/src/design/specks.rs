//! The groups of a design without the parts that are too small to be sheet.

use super::mesh_design::MeshGroup;
use crate::boundary::size_of;
use crate::mesh::{Specks, WithoutSpecks, without_specks};
use std::borrow::Cow;

/// A group as it is made, and what was left out of it.
pub(super) type Cleaned<'a> = (Cow<'a, MeshGroup>, Option<Specks>);

/// The groups without parts that are too small, and those parts; of groups of which nothing is left,
/// what was left out counts with the first that is kept. If nothing is left of any, all stay as they
/// are, to be refused for what is wrong with them.
pub(super) fn cleaned(groups: &[MeshGroup]) -> Vec<Cleaned<'_>> {
    let size = size_of(groups.iter().flat_map(|group| group.positions.iter().copied()));
    let one = |group: &'_ MeshGroup| -> (Option<MeshGroup>, Option<Specks>) {
        match without_specks(&group.positions, &group.triangles, size) {
            None => (None, None),
            Some(WithoutSpecks { positions, triangles, specks }) => {
                let name = group.name.clone();
                let left = MeshGroup { name, positions, triangles, left_out: group.left_out };
                (Some(left), Some(specks))
            }
        }
    };
    let mut kept: Vec<Cleaned<'_>> = Vec::with_capacity(groups.len());
    let (mut lost, mut lost_triangles) = (None::<Specks>, 0);
    for group in groups {
        let (left, specks) = one(group);
        let left = left.map_or(Cow::Borrowed(group), Cow::Owned);
        if left.triangles.is_empty() && specks.is_some() {
            lost_triangles += left.left_out;
            lost = both(lost, specks);
        } else {
            kept.push((left, specks));
        }
    }
    let Some((first, specks)) = kept.first_mut() else {
        return groups.iter().map(|group| (Cow::Borrowed(group), None)).collect();
    };
    if lost.is_some() {
        first.to_mut().left_out += lost_triangles;
        *specks = both(*specks, lost);
    }
    kept
}

/// What two groups lost, counted together.
fn both(a: Option<Specks>, b: Option<Specks>) -> Option<Specks> {
    match (a, b) {
        (Some(a), Some(b)) => Some(Specks { parts: a.parts + b.parts, ..a }),
        (a, b) => a.or(b),
    }
}
