//! The table of the catalogue in `docs/materials.md`, made from the catalogue.
#![allow(clippy::unwrap_used)] // Whatever fails here is a failed test.

use sheetwright::material::{ASSUMED, KFactors, Material, Sourced};
use sheetwright_files::known_materials;
use std::collections::BTreeSet;

/// Begins and ends the part of the page that is made.
const BEGIN: &str = "<!-- made from materials.json -->\n";
const END: &str = "<!-- end -->\n";

/// Of a number without a source.
const ASSUMED_MARK: &str = "~";

fn cell(number: &Sourced, scale: f64) -> String {
    let mark = if number.source.starts_with(ASSUMED) { ASSUMED_MARK } else { "" };
    // Ten decimals hide the rounding of the scale.
    let value = format!("{:.10}", scale * number.value);
    format!("{mark}{}", value.trim_end_matches('0').trim_end_matches('.'))
}

fn known(number: Option<&Sourced>, scale: f64) -> String {
    number.map_or_else(|| "–".to_owned(), |number| cell(number, scale))
}

fn row(m: &Material) -> String {
    let k = |k: &KFactors| {
        let cells: Vec<String> = k
            .rows
            .iter()
            .map(|row| format!("{} at {} t", row.k, row.radius_per_thickness))
            .collect();
        cells.join(", ")
    };
    let cells = [
        format!("`{}`", m.name),
        m.title.clone(),
        cell(&m.thickness_mm, 1.0),
        cell(&m.bend_radius_mm, 1.0),
        cell(&m.warp_limit_deg, 1.0),
        cell(&m.stretch_limit, 100.0),
        known(m.yield_strain.as_ref(), 100.0),
        known(m.modulus_n_per_mm2.as_ref(), 1.0),
        known(m.poisson.as_ref(), 1.0),
        known(m.density_kg_per_m3.as_ref(), 1.0),
        m.k_factors.as_ref().map_or_else(|| "–".to_owned(), k),
    ];
    format!("| {} |\n", cells.join(" | "))
}

fn grain_row(m: &Material) -> Option<String> {
    let grain = m.grain.as_ref()?;
    let cells: Vec<String> = [&grain.along, &grain.across]
        .iter()
        .flat_map(|way| [cell(&way.modulus_n_per_mm2, 1.0), cell(&way.bend_radius_mm, 1.0)])
        .collect();
    Some(format!("| `{}` | {} |\n", m.name, cells.join(" | ")))
}

/// Every source of the catalogue once, sorted, but for assumptions.
fn sources() -> BTreeSet<String> {
    let file: serde_json::Value =
        serde_json::from_str(include_str!("../src/materials.json")).unwrap();
    fn collect(value: &serde_json::Value, found: &mut BTreeSet<String>) {
        for (field, value) in value.as_object().into_iter().flatten() {
            match value.as_str() {
                Some(source) if field == "source" && !source.starts_with(ASSUMED) => {
                    found.insert(source.to_owned());
                }
                _ => collect(value, found),
            }
        }
    }
    let mut found = BTreeSet::new();
    collect(&file["materials"], &mut found);
    found
}

fn made() -> String {
    let mut text = String::from(
        "| `material` | sheet | thickness, mm | smallest bend radius, mm | warp, degrees | stretch, % | yield, % | modulus, N/mm² | Poisson | density, kg/m³ | K |\n\
         |---|---|---|---|---|---|---|---|---|---|---|\n",
    );
    text.extend(known_materials(&[]).into_iter().map(row));
    text.push_str(
        "\n| grain | along: modulus, N/mm² | radius, mm | across: modulus, N/mm² | radius, mm |\n\
         |---|---|---|---|---|\n",
    );
    text.extend(known_materials(&[]).into_iter().filter_map(grain_row));
    text.push_str("\nSources, but for assumptions:\n\n");
    text.extend(sources().iter().map(|source| format!("- {source}\n")));
    text
}

/// `SHEETWRIGHT_REWRITE=1 cargo test -p sheetwright-files --test materials_page` writes it anew.
#[test]
fn the_table_in_the_docs_is_that_of_the_catalogue() {
    let path = format!("{}/../../docs/materials.md", env!("CARGO_MANIFEST_DIR"));
    let kept = std::fs::read_to_string(&path).unwrap().replace('\r', "");
    let (before, rest) = kept.split_once(BEGIN).unwrap();
    let (_, after) = rest.split_once(END).unwrap();
    let page = format!("{before}{BEGIN}\n{}\n{END}{after}", made());
    if std::env::var_os("SHEETWRIGHT_REWRITE").is_some() {
        std::fs::write(&path, &page).unwrap();
        return;
    }
    assert!(
        kept == page,
        "docs/materials.md differs from the catalogue; write it anew with SHEETWRIGHT_REWRITE=1 \
         cargo test -p sheetwright-files --test materials_page"
    );
}
