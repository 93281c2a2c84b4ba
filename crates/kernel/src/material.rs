//! What sheets can do: the limits that a verdict is given against.
//!
//! The numbers are working rules to begin with, and only one of them has a source that was read:
//! metal shipbuilding accepts a warp angle of 6° \[ZB18\]. A warp angle along a ruling means that a
//! sheet must stretch there, so this list takes 6° for every sheet that hardly stretches, and
//! assumes twice as much for those that do. The radii are rules of thumb that were not looked up:
//! for plywood of 6 and 9 mm, bent dry across the face grain, as commonly quoted from \[APA-E30\],
//! thinner plywood by the same ratio to its thickness; for metal a multiple of the thickness. Check
//! them against the sheet that is to be cut.

/// A sheet material of a thickness.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// How designs name it.
    pub name: &'static str,
    /// How people call it.
    pub title: &'static str,
    /// Thickness, mm.
    pub thickness_mm: f64,
    /// The smallest radius that it is bent to, mm.
    pub bend_radius_mm: f64,
    /// The largest warp angle that it takes, degrees.
    pub warp_limit_deg: f64,
    /// By which share it is stretched or squeezed within its plane at most, without unit.
    pub stretch_limit: f64,
}

/// The largest warp angle of a sheet that nothing is known of, degrees: metal shipbuilding
/// \[ZB18\].
pub const DEFAULT_WARP_LIMIT_DEG: f64 = 6.0;

/// By which share a sheet that nothing is known of is stretched within its plane at most: a
/// millimetre in a metre, about where metal stops springing back. Assumed, not looked up; the same
/// as [`sheetwright_geometry::tolerance::Tolerance::MOST_STRETCH`].
pub const DEFAULT_STRETCH_LIMIT: f64 = 1e-3;

/// By which share leather, cloth and soft plastic are stretched within their plane at most, a few
/// per cent. Assumed.
const SOFT_STRETCH_LIMIT: f64 = 0.02;

/// A sheet that is bent to no less than this many thicknesses is taken to break when it is folded:
/// between solid board (10) and plywood (96), nearer to the board.
const MOST_THICKNESSES: f64 = 10.0;

const fn material(
    name: &'static str,
    title: &'static str,
    thickness_mm: f64,
    bend_radius_mm: f64,
    warp_limit_deg: f64,
) -> Material {
    let stretches = warp_limit_deg > DEFAULT_WARP_LIMIT_DEG;
    let stretch_limit = if stretches { SOFT_STRETCH_LIMIT } else { DEFAULT_STRETCH_LIMIT };
    Material { name, title, thickness_mm, bend_radius_mm, warp_limit_deg, stretch_limit }
}

/// Every material, by name.
pub const MATERIALS: [Material; 15] = [
    material("aluminium-1mm", "aluminium 5754, 1 mm", 1.0, 1.0, 6.0),
    material("aluminium-2mm", "aluminium 5754, 2 mm", 2.0, 2.0, 6.0),
    material("aluminium-4mm", "aluminium 5083, 4 mm", 4.0, 6.0, 6.0),
    material("card-0.3mm", "card, 0.3 mm", 0.3, 1.0, 6.0),
    material("cardboard-1.5mm", "solid board, 1.5 mm", 1.5, 15.0, 6.0),
    // Leather, cloth and soft plastic stretch a few per cent: assumed to forgive twice the warp.
    material("canvas", "canvas or sailcloth", 0.5, 0.5, 12.0),
    material("leather-2mm", "leather, 2 mm", 2.0, 2.0, 12.0),
    material("paper", "paper, 80 to 160 g/m²", 0.15, 0.5, 6.0),
    material("plywood-3mm", "plywood, 3 mm", 3.0, 290.0, 6.0),
    material("plywood-4mm", "plywood, 4 mm", 4.0, 385.0, 6.0),
    material("plywood-6mm", "plywood, 6 mm", 6.35, 610.0, 6.0),
    material("plywood-9mm", "plywood, 9 mm", 9.5, 914.0, 6.0),
    material("polypropylene-0.8mm", "polypropylene sheet, 0.8 mm", 0.8, 2.0, 12.0),
    material("steel-1mm", "mild steel, 1 mm", 1.0, 1.0, 6.0),
    material("steel-5mm", "mild steel plate, 5 mm", 5.0, 7.5, 6.0),
];

impl Material {
    /// Whether it takes a sharp fold along a scored line: not plywood, whose bend radius is a
    /// hundred times its thickness.
    pub fn folds(&self) -> bool {
        self.bend_radius_mm <= MOST_THICKNESSES * self.thickness_mm
    }

    /// The material of a name.
    pub fn named(name: &str) -> Option<&'static Self> {
        MATERIALS.iter().find(|m| m.name == name)
    }
}

/// The largest warp angle that is accepted, degrees: the material's, or the default without one.
pub fn warp_limit_deg(material: Option<&Material>) -> f64 {
    material.map_or(DEFAULT_WARP_LIMIT_DEG, |m| m.warp_limit_deg)
}

/// By which share a sheet is stretched within its plane at most: the material's, or the default
/// without one.
pub fn stretch_limit(material: Option<&Material>) -> f64 {
    material.map_or(DEFAULT_STRETCH_LIMIT, |m| m.stretch_limit)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn materials_stand_by_name_once() {
        for pair in MATERIALS.windows(2) {
            let (a, b) = (pair[0].name, pair[1].name);
            assert_ne!(a, b);
        }
        assert_eq!(Material::named("paper").map(|m| m.bend_radius_mm), Some(0.5));
        assert!(Material::named("cheese").is_none());
        assert_eq!(stretch_limit(Material::named("canvas")), 0.02);
        assert_eq!(stretch_limit(None), stretch_limit(Material::named("steel-1mm")));
    }
}
