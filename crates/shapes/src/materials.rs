//! Sheets for tests, with limits that stay whatever the catalogue says.

use sheetwright::material::{Material, Sourced};

/// Mild steel of a thickness, mm: it yields at 0.12 %.
pub fn steel(thickness_mm: f64) -> Material {
    Material {
        modulus_n_per_mm2: Some(Sourced::assumed(210_000.0)),
        poisson: Some(Sourced::assumed(0.3)),
        yield_strain: Some(Sourced::assumed(1.2e-3)),
        ..sheet(&format!("steel, {thickness_mm} mm"), thickness_mm, thickness_mm, 1.2e-3)
    }
}

/// Plywood of 3 mm, which takes a bend radius of 290 mm and a strain of 0.3 %.
pub fn plywood() -> Material {
    sheet("plywood, 3 mm", 3.0, 290.0, 3e-3)
}

/// A sheet of which no more than its thickness, its bend radius, both mm, and the strain that it
/// takes are known.
fn sheet(title: &str, thickness_mm: f64, bend_radius_mm: f64, strain: f64) -> Material {
    Material {
        name: title.to_owned(),
        title: title.to_owned(),
        thickness_mm: Sourced::assumed(thickness_mm),
        bend_radius_mm: Sourced::assumed(bend_radius_mm),
        warp_limit_deg: Sourced::assumed(6.0),
        stretch_limit: Sourced::assumed(strain),
        modulus_n_per_mm2: None,
        poisson: None,
        yield_strain: None,
        density_kg_per_m3: None,
        k_factors: None,
        deductions: None,
        grain: None,
    }
}
