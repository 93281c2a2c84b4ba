//! Quads of panels: made, counted, and written as OBJ.

use crate::obj::one_word;
use crate::shapes::digits;
use sheetwright::check::{Finding, FindingKind};
use sheetwright::make::Found;
use sheetwright::quads::{Planar, PlanarEnd, PlanarOptions, SmoothSurface, planar, quads, smooth};
use sheetwright::tolerance::Tolerance;
use sheetwright::watch::Unwatched;
use std::collections::BTreeSet;
use std::fmt::Write as _;

/// The tolerance of planar quads, as a share of the size.
const EVEN: Tolerance = Tolerance::ROUNDING;
/// The largest distance that vertices may leave the boundary so that quads are planar, as a share
/// of the size: a millimetre in a metre, by which a panel gives way when it is bent cold.
const LEAVE: f64 = 1e-3;

/// A panel in planar quads, and the smooth surface over them.
#[derive(Clone, Debug, PartialEq)]
pub struct PanelQuads {
    /// The quads, and how far their vertices moved to make them planar.
    pub planar: Planar,
    /// The smooth surface.
    pub smooth: SmoothSurface,
}

impl PanelQuads {
    /// The quads of a found surface; vertices may leave its boundary by up to a thousandth of its
    /// size.
    pub fn new(found: &Found) -> Self {
        let mesh = quads(&found.surface, &found.boundary, &found.outline);
        let options = PlanarOptions { even: EVEN, leave_mm: LEAVE * found.boundary.size() };
        let planar = planar(&mesh, &found.outline, &options, &mut Unwatched);
        let smooth = smooth(&planar.mesh, &found.outline);
        Self { planar, smooth }
    }

    /// The finding on the quads; `None` where they are planar on the outline.
    pub(crate) fn finding(&self) -> Option<Finding> {
        let Planar { end, off_max_mm, uneven_after_mm, .. } = self.planar;
        let (uneven_mm, off_mm) = (uneven_after_mm, off_max_mm);
        Some(Finding::of_whole(match end {
            PlanarEnd::OnOutline => return None,
            PlanarEnd::OffOutline => FindingKind::QuadsOffBoundary { off_mm },
            PlanarEnd::TooFarOff => FindingKind::QuadsNotPlanar { uneven_mm, off_mm: Some(off_mm) },
            PlanarEnd::NotFound | PlanarEnd::Stopped => {
                FindingKind::QuadsNotPlanar { uneven_mm, off_mm: None }
            }
        }))
    }
}

/// The OBJ file of the quads of all panels, under their names, with one object and one group per
/// panel.
pub fn write_quads(panels: &[(&str, &PanelQuads)]) -> Vec<u8> {
    let mut obj = String::from("# Planar quads by Sheetwright. Units: mm. One group per panel.\n");
    let mut before = 1;
    let mut taken = BTreeSet::new();
    for (name, made) in panels {
        let name = one_word(name, &mut taken);
        // Writing to a string does not fail.
        let _ = writeln!(obj, "o {name}\ng {name}");
        let mesh = &made.planar.mesh;
        for p in mesh.positions() {
            let _ = writeln!(obj, "v {} {} {}", digits(p.x), digits(p.y), digits(p.z));
        }
        for face in mesh.faces() {
            let corners: Vec<String> = face.iter().map(|i| (before + i).to_string()).collect();
            let _ = writeln!(obj, "f {}", corners.join(" "));
        }
        before += mesh.vertices.len();
    }
    obj.into_bytes()
}
