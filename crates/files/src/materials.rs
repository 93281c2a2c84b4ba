//! Materials: the catalogue, `materials.json`, and those that a design brings along.
//!
//! Both are written in one way, an object of materials by their names. A number stands alone or
//! with its source; the catalogue gives the source of every one.

mod convert;
mod file;

use crate::json::{Named, Object};
use crate::names::folded;
pub(crate) use convert::{file_of, material, materials_in};
pub(crate) use file::{MaterialChoice, MaterialFile};
use schemars::JsonSchema;
use serde::Deserialize as Derived;
use sheetwright::material::Material;
use std::collections::BTreeMap;
use std::sync::OnceLock;

/// The materials that a design with these of its own can name: its own in their order, then those
/// of the catalogue but for names that an own one has.
///
/// # Panics
/// Where the catalogue of the program itself can't be read, which its tests show.
pub fn known_materials(own: &[Material]) -> Vec<&Material> {
    static CATALOGUE: OnceLock<Vec<Material>> = OnceLock::new();
    let catalogue = CATALOGUE.get_or_init(|| match catalogue_in(include_str!("materials.json")) {
        Ok(materials) => materials,
        Err(error) => panic!("materials.json: {error}"),
    });
    let is_hidden = |name: &str| own.iter().any(|material| material.name == name);
    own.iter().chain(catalogue.iter().filter(|material| !is_hidden(&material.name))).collect()
}

/// The material that a design with these of its own means by a name; one that differs in upper and
/// lower case alone where no other is.
pub fn material_named(name: &str, own: &[Material]) -> Option<Material> {
    let known = known_materials(own);
    let exact = known.iter().find(|material| material.name == name);
    let alike = || known.iter().find(|material| folded(&material.name) == folded(name));
    exact.or_else(alike).map(|&material| material.clone())
}

/// The first word of a material's name, by which lists group neighbours: `steel` of `steel-1mm`.
pub fn material_group(name: &str) -> &str {
    name.split('-').next().unwrap_or_default()
}

/// The names of the catalogue, by group: `steel-1mm, -2mm; veneer-0.6mm`.
pub fn catalogue_names() -> String {
    let mut names = String::new();
    let mut group = "";
    for material in known_materials(&[]) {
        let of = material_group(&material.name);
        let between = match names.is_empty() {
            true => "",
            false if of == group => ", ",
            false => "; ",
        };
        let said = if of == group { &material.name[of.len()..] } else { &material.name[..] };
        names.push_str(between);
        names.push_str(said);
        group = of;
    }
    names
}

/// The catalogue of materials of Sheetwright.
#[derive(Debug, Derived, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "Sheetwright materials")]
struct CatalogueFile {
    /// Where this schema lies, for editors; not used otherwise.
    #[serde(rename = "$schema", default)]
    #[allow(dead_code, reason = "editors read it, this program does not")]
    schema: Option<String>,
    /// The materials, by name, as in a design.
    #[schemars(with = "BTreeMap<String, MaterialFile>")]
    materials: Named<MaterialFile>,
}

/// The materials of a catalogue, or what is wrong with it.
fn catalogue_in(text: &str) -> Result<Vec<Material>, String> {
    let Object(file): Object<CatalogueFile> =
        serde_json::from_str(text).map_err(|error| error.to_string())?;
    let refuse = |path: &str, message: String, _: &str| format!("{path}: {message}");
    materials_in(file.materials, &refuse)
}

#[cfg(test)]
mod tests {
    use super::*;
    use sheetwright::material::{ASSUMED, Sourced};

    /// The numbers of a material, by their fields; of K-factors the source alone.
    fn numbers(m: &Material) -> Vec<(&str, &Sourced)> {
        let known = [
            ("modulus_n_per_mm2", &m.modulus_n_per_mm2),
            ("poisson", &m.poisson),
            ("yield_strain", &m.yield_strain),
            ("density_kg_per_m3", &m.density_kg_per_m3),
        ];
        let mut all = vec![
            ("thickness_mm", &m.thickness_mm),
            ("bend_radius_mm", &m.bend_radius_mm),
            ("warp_limit_deg", &m.warp_limit_deg),
            ("stretch_limit", &m.stretch_limit),
        ];
        all.extend(known.iter().filter_map(|(field, number)| Some((*field, number.as_ref()?))));
        for way in m.grain.iter().flat_map(|grain| [&grain.along, &grain.across]) {
            all.push(("grain", &way.modulus_n_per_mm2));
            all.push(("grain", &way.bend_radius_mm));
        }
        all
    }

    #[test]
    fn every_number_of_the_catalogue_has_a_source() {
        let text = include_str!("materials.json");
        let file: serde_json::Value = serde_json::from_str(text).unwrap();
        let materials = file["materials"].as_object().unwrap();
        assert_eq!(materials.len(), known_materials(&[]).len());
        fn sources(value: &serde_json::Value) -> usize {
            let fields = value.as_object().unwrap();
            match fields.get("source") {
                Some(source) => usize::from(!source.as_str().unwrap().is_empty()),
                None => fields.values().map(sources).sum(),
            }
        }
        for m in known_materials(&[]) {
            let mut file = materials[&m.name].clone();
            let title = file.as_object_mut().unwrap().remove("title");
            assert_eq!(title.unwrap().as_str(), Some(&m.title[..]));
            let count = numbers(m).len() + usize::from(m.k_factors.is_some());
            assert_eq!(sources(&file), count, "{}", m.name);
            assert!(m.modulus_n_per_mm2.is_some() && m.poisson.is_some(), "{}", m.name);
            assert!(m.density_kg_per_m3.is_some(), "{}", m.name);
        }
    }

    #[test]
    fn numbers_of_the_catalogue_agree_with_each_other() {
        const METALS: [&str; 6] =
            ["aluminium", "brass", "copper", "galvanised", "stainless", "steel"];
        for m in known_materials(&[]) {
            let is_metal = METALS.contains(&material_group(&m.name));
            let keeps_its_bend =
                is_metal || ["pet", "polypropylene"].contains(&material_group(&m.name));
            assert_eq!(m.yield_strain.is_some(), keeps_its_bend, "{}", m.name);
            if let Some(strain) = &m.yield_strain {
                assert_eq!(strain.value, m.stretch_limit.value, "{}", m.name);
            }
            assert_eq!(m.k_factors.is_some(), is_metal, "{}", m.name);
            for row in m.k_factors.iter().flat_map(|k| &k.rows) {
                assert!((0.3..=0.5).contains(&row.k), "{}", m.name);
            }
            if let Some(grain) = &m.grain {
                let (along, across) = (&grain.along, &grain.across);
                let mean = 0.5 * (along.modulus_n_per_mm2.value + across.modulus_n_per_mm2.value);
                let modulus = m.modulus_n_per_mm2.as_ref().unwrap().value;
                assert!((modulus / mean - 1.0).abs() < 1e-3, "{}: {mean}", m.name);
                assert!(across.bend_radius_mm.value < along.bend_radius_mm.value, "{}", m.name);
                let ways = [along, across].map(|way| way.bend_radius_mm.value);
                assert!(ways.contains(&m.bend_radius_mm.value), "{}", m.name);
            }
        }
    }

    /// A publication stands by its name, not by an address that moves.
    #[test]
    fn sources_name_a_publication_or_the_reason_of_an_assumption() {
        for m in known_materials(&[]) {
            for (field, Sourced { source, .. }) in numbers(m) {
                let is_short = source.len() < "nominal".len() || source == ASSUMED;
                assert!(!is_short && !source.contains("://"), "{} {field}: {source}", m.name);
            }
        }
    }

    #[test]
    fn a_name_is_found_among_its_own_first_and_in_any_case() {
        let paper = material_named("paper", &[]).unwrap();
        assert_eq!((&paper.title[..], paper.bend_radius_mm.value), ("paper, 80 to 160 g/m²", 0.5));
        assert_eq!(material_named("Paper", &[]), Some(paper.clone()));
        assert_eq!(material_named("cheese", &[]), None);
        let of =
            |name: &str| Material { name: name.to_owned(), title: "mine".into(), ..paper.clone() };
        let own = [of("paper"), of("STEEL-1MM")];
        let known: Vec<&str> = known_materials(&own).iter().map(|m| &m.name[..]).collect();
        assert_eq!((known[0], known[1], known.len()), ("paper", "STEEL-1MM", 59));
        assert_eq!(material_named("paper", &own).unwrap().title, "mine");
        assert_eq!(material_named("steel-1mm", &own).unwrap().title, "mild steel, 1 mm");
        assert_eq!(material_named("Steel-1mm", &own).unwrap().title, "mine");
    }

    /// Scripts name them.
    #[test]
    fn the_first_names_of_the_catalogue_stay() {
        for name in [
            "aluminium-1mm",
            "aluminium-2mm",
            "aluminium-4mm",
            "card-0.3mm",
            "cardboard-1.5mm",
            "canvas",
            "leather-2mm",
            "paper",
            "plywood-3mm",
            "plywood-4mm",
            "plywood-6mm",
            "plywood-9mm",
            "polypropylene-0.8mm",
            "steel-1mm",
            "steel-5mm",
        ] {
            assert!(material_named(name, &[]).is_some(), "{name}");
        }
    }

    #[test]
    fn names_are_listed_by_group() {
        let names = catalogue_names();
        assert!(names.starts_with("aluminium-1mm, -1.5mm, -2mm, -3mm, -4mm, -1050-1mm, "));
        assert!(names.contains("; paper, -80g, -160g; "), "{names}");
        let groups: Vec<&str> =
            names.split("; ").map(|names| names.split('-').next().unwrap()).collect();
        assert!(groups.is_sorted_by(|a, b| a < b), "{groups:?}");
    }

    #[test]
    fn the_schema_is_that_of_the_code() {
        let schema = schemars::schema_for!(CatalogueFile);
        let text = serde_json::to_string_pretty(&schema).unwrap() + "\n";
        crate::json::assert_schema_in_docs("materials.schema.json", &text);
    }
}
