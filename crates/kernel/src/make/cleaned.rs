//! The meshes of a design healed, and without the parts that are too small to be sheet. The design
//! keeps them as they came.

use crate::design::{Design, PanelShape, Triangles};
use crate::mesh::{Healed, Healing, Specks, WithoutSpecks, healed, without_specks};
use sheetwright_geometry::boundary::size_of;
use std::sync::Arc;

/// The triangles of a panel that are used, the parts of its mesh that were left out, and what was
/// healed.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Cleaned {
    pub(super) triangles: Arc<Triangles>,
    pub(super) specks: Option<Specks>,
    pub(super) healings: Vec<Healing>,
}

/// The meshes of a design as they were cleaned last. While a handle is dragged, no mesh changes,
/// and a large one takes longer to heal than a frame.
#[derive(Clone, Debug, Default)]
pub(super) struct LastCleaned {
    from: Vec<Option<Arc<Triangles>>>,
    cleaned: Vec<Option<Cleaned>>,
}

impl LastCleaned {
    /// [`cleaned`] of a design, at once where no mesh is another one than last time.
    pub(super) fn of(&mut self, design: &Design) -> Vec<Option<Cleaned>> {
        let from: Vec<Option<Arc<Triangles>>> = meshes(design).map(|mesh| mesh.cloned()).collect();
        let is_one = |(a, b): (&Option<Arc<Triangles>>, &Option<Arc<Triangles>>)| match (a, b) {
            // What came from elsewhere as bytes has its mesh anew.
            (Some(a), Some(b)) => Arc::ptr_eq(a, b) || a == b,
            (None, None) => true,
            _ => false,
        };
        if from.len() != self.from.len() || !from.iter().zip(&self.from).all(is_one) {
            *self = Self { from, cleaned: cleaned(design) };
        }
        self.cleaned.clone()
    }
}

/// The triangles of each panel that is to be made, healed and without parts that are too small;
/// `None` for a panel that is no mesh, or of which no triangle is left. Parts left out of such a
/// panel are counted with the first panel that is kept. If no mesh has a triangle left, all stay as
/// they are and fail in `make` with their own errors.
pub(super) fn cleaned(design: &Design) -> Vec<Option<Cleaned>> {
    cleaned_of(&meshes(design).collect::<Vec<_>>())
}

/// The mesh of each panel that is to be made, if it is one.
fn meshes(design: &Design) -> impl Iterator<Item = Option<&Arc<Triangles>>> {
    design.panels_to_make().into_iter().map(|panel| match &panel.shape {
        PanelShape::Mesh(mesh) => Some(&mesh.triangles),
        _ => None,
    })
}

fn cleaned_of(meshes: &[Option<&Arc<Triangles>>]) -> Vec<Option<Cleaned>> {
    let all = || meshes.iter().copied().flatten();
    let size = size_of(all().flat_map(|mesh| mesh.positions.iter().copied()));
    let whole = |mesh: &Arc<Triangles>| Cleaned {
        triangles: mesh.clone(),
        specks: None,
        healings: Vec::new(),
    };
    let one = |mesh: &Arc<Triangles>| match without_specks(&mesh.positions, &mesh.triangles, size) {
        None => whole(mesh),
        Some(WithoutSpecks { positions, triangles, specks }) => {
            let left = Triangles { positions, triangles, left_out: mesh.left_out };
            let (triangles, specks) = (Arc::new(left), Some(specks));
            Cleaned { triangles, specks, healings: Vec::new() }
        }
    };
    let mut kept: Vec<Option<Cleaned>> = Vec::with_capacity(meshes.len());
    let (mut lost, mut lost_triangles) = (None::<Specks>, 0);
    for mesh in meshes {
        let left = mesh.map(one).map(with_healing);
        let is_lost = |left: &Cleaned| left.triangles.triangles.is_empty() && left.specks.is_some();
        if let Some(gone) = left.as_ref().filter(|left| is_lost(left)) {
            lost_triangles += gone.triangles.left_out;
            lost = both(lost, gone.specks);
        }
        kept.push(left.filter(|left| !is_lost(left)));
    }
    let Some(first) = kept.iter_mut().flatten().next() else {
        return meshes.iter().map(|mesh| mesh.map(whole)).collect();
    };
    if lost.is_some() {
        Arc::make_mut(&mut first.triangles).left_out += lost_triangles;
        first.specks = both(first.specks, lost);
    }
    kept
}

/// The triangles healed, if they need it.
fn with_healing(mut cleaned: Cleaned) -> Cleaned {
    let Triangles { positions, triangles, left_out } = &*cleaned.triangles;
    if let Some(Healed { positions, triangles, healings }) = healed(positions, triangles) {
        let left_out = *left_out;
        cleaned.triangles = Arc::new(Triangles { positions, triangles, left_out });
        cleaned.healings = healings;
    }
    cleaned
}

/// The parts left out of two meshes, in total.
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
    fn mesh(sizes: &[f64], left_out: usize) -> Arc<Triangles> {
        let corners = |(n, size): (usize, &f64)| {
            let at = |x: f64, y: f64| Point3::new(x, y, 10.0 * n as f64);
            [at(0.0, 0.0), at(*size, 0.0), at(0.0, *size)]
        };
        let numbers = (0..sizes.len()).map(|n| [3 * n, 3 * n + 1, 3 * n + 2]);
        Arc::new(Triangles {
            positions: sizes.iter().enumerate().flat_map(corners).collect(),
            triangles: numbers.map(|t| t.map(VertexIndex::new)).collect(),
            left_out,
        })
    }

    #[test]
    fn a_mesh_of_nothing_but_specks_is_no_panel_and_is_counted() {
        let (dust, hood, lid) = (mesh(&[1e-9, 1e-14], 2), mesh(&[80.0, 1e-9], 1), mesh(&[9.0], 0));
        // The second panel is bounded by curves.
        let kept = cleaned_of(&[Some(&dust), None, Some(&hood), Some(&lid)]);
        let [None, None, Some(of_hood), Some(of_lid)] = &kept[..] else { panic!("{kept:?}") };
        assert_eq!((of_hood.triangles.triangles.len(), of_hood.triangles.left_out), (1, 3));
        assert_eq!(of_hood.specks.map(|specks| specks.parts), Some(3));
        assert!(of_lid.specks.is_none() && Arc::ptr_eq(&of_lid.triangles, &lid));
        // Where there is nothing else, what is wrong with it is for the door to say.
        let kept = cleaned_of(&[Some(&dust)]);
        assert!(kept[0].as_ref().is_some_and(|kept| Arc::ptr_eq(&kept.triangles, &dust)));
    }
}
