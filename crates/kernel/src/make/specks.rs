//! The groups of a design without the parts that are too small to be sheet.

use crate::design::MeshGroup;
use crate::mesh::{Specks, WithoutSpecks, without_specks};
use sheetwright_geometry::boundary::size_of;
use std::borrow::Cow;

/// A group as it is made, and what was left out of it.
pub(super) type Cleaned<'a> = (Cow<'a, MeshGroup>, Option<Specks>);

/// The groups without parts that are too small, and those parts; of groups of which nothing is
/// left, what was left out counts with the first that is kept. If nothing is left of any, all stay
/// as they are, to be refused for what is wrong with them.
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

#[cfg(test)]
mod tests {
    use super::*;
    use sheetwright_geometry::index::VertexIndex;
    use sheetwright_geometry::math::Point3;

    /// Right triangles of these sizes, mm, 10 mm apart along z.
    fn group(name: &str, sizes: &[f64], left_out: usize) -> MeshGroup {
        let corners = |(n, size): (usize, &f64)| {
            let at = |x: f64, y: f64| Point3::new(x, y, 10.0 * n as f64);
            [at(0.0, 0.0), at(*size, 0.0), at(0.0, *size)]
        };
        let numbers = (0..sizes.len()).map(|n| [3 * n, 3 * n + 1, 3 * n + 2]);
        MeshGroup {
            name: name.to_owned(),
            positions: sizes.iter().enumerate().flat_map(corners).collect(),
            triangles: numbers.map(|t| t.map(VertexIndex::new)).collect(),
            left_out,
        }
    }

    #[test]
    fn a_group_of_nothing_but_specks_is_no_panel_and_is_counted() {
        let groups = [
            group("dust", &[1e-9, 1e-14], 2),
            group("hood", &[80.0, 1e-9], 1),
            group("lid", &[9.0], 0),
        ];
        let kept = cleaned(&groups);
        let names: Vec<&str> = kept.iter().map(|(group, _)| &group.name[..]).collect();
        assert_eq!(names, ["hood", "lid"]);
        assert_eq!((kept[0].0.triangles.len(), kept[0].0.left_out), (1, 3));
        assert_eq!(kept[0].1.map(|specks| specks.parts), Some(3));
        assert!(matches!(kept[1], (Cow::Borrowed(_), None)));
        // Where there is nothing else, what is wrong with it is for the door to say.
        let kept = cleaned(&groups[..1]);
        assert!(matches!(kept[..], [(Cow::Borrowed(_), None)]) && kept[0].0.triangles.len() == 2);
    }
}
