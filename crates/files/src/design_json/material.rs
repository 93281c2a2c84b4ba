//! The materials that a design defines, and the material of its sheet.

use super::source::Source;
use crate::json::Named;
use crate::materials::{MaterialChoice, MaterialFile, material, material_named, materials_in};
use crate::meant::material_meant;
use crate::names::shown;
use crate::reading::InputError;
use sheetwright::design::Design;
use sheetwright::material::Material;

/// The name of a material without a title that `material` gives as an object instead of a name.
const OWN: &str = "own";
/// The most materials that a design defines.
const MAX_MATERIALS: usize = 1000;

/// Returns the material of the sheet, and all materials that the design defines. If `material` is
/// an object instead of a name, its material is the last of them.
pub(super) fn read(
    choice: Option<MaterialChoice>,
    list: Named<MaterialFile>,
    source: &Source<'_>,
) -> Result<(Option<Material>, Vec<Material>), InputError> {
    let count = list.0.len() + usize::from(matches!(choice, Some(MaterialChoice::Own(_))));
    if count > MAX_MATERIALS {
        let message = format!("the design has {count} materials");
        return Err(source.error(
            "materials",
            message,
            format!("The limit is {MAX_MATERIALS} materials."),
        ));
    }
    let refuse = |path: &str, message: String, hint: &str| source.error(path, message, hint);
    let mut own = materials_in(list, &refuse)?;
    let chosen = match choice {
        None => None,
        Some(MaterialChoice::Name(wanted)) => {
            let found = material_meant(&wanted, &own);
            Some(found.map_err(|(message, hint)| source.error("material", message, hint))?)
        }
        Some(MaterialChoice::Own(file)) => {
            let name = file.title.clone().unwrap_or_else(|| OWN.to_owned());
            let chosen = material(name, *file, "material", &refuse)?;
            if own.iter().any(|other| other.name == chosen.name) {
                let message =
                    format!("`materials` has one of the name {} too", shown(&chosen.name));
                let hint = "Write its name here, or give this one another `title`.";
                return Err(source.error("material", message, hint));
            }
            own.push(chosen.clone());
            Some(chosen)
        }
    };
    Ok((chosen, own))
}

/// Returns the name of the material of the sheet, and the materials that the file defines. If
/// neither the design nor the catalogue defines the material of the sheet, it is the last of them,
/// under an unused name.
pub(super) fn written(design: &Design) -> (Option<String>, Vec<Material>) {
    let mut own = design.materials.clone();
    let Some(chosen) = &design.material else { return (None, own) };
    if material_named(&chosen.name, &own).as_ref() == Some(chosen) {
        return (Some(chosen.name.clone()), own);
    }
    let is_free = |name: &String| !own.iter().any(|other| other.name == *name);
    let numbered = (2..).map(|n| format!("{}-{n}", chosen.name));
    let mut names = std::iter::once(chosen.name.clone()).chain(numbered);
    let name = names.find(is_free).unwrap_or_default();
    own.push(Material { name: name.clone(), ..chosen.clone() });
    (Some(name), own)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::{InputFormat, read_bytes};
    use crate::materials::known_materials;
    use crate::reading::ReadOptions;
    use crate::write_design;
    use sheetwright::material::Sourced;

    const PLY: &str =
        r#"{"thickness_mm": {"value": 3.8, "source": "calliper"}, "bend_radius_mm": 350}"#;

    fn read(fields: &str) -> Result<Design, InputError> {
        read_with(fields, None)
    }

    fn read_with(fields: &str, material: Option<&str>) -> Result<Design, InputError> {
        let text = format!(r#"{{"sheetwright":1,{fields},"curves":{{}},"panels":[]}}"#);
        let material = material.map(str::to_owned);
        let options = ReadOptions { material, ..ReadOptions::default() };
        read_bytes(InputFormat::Design, text.as_bytes(), "d.sheet.json", None, &options)
    }

    fn again(design: &Design) -> Design {
        let options = ReadOptions::default();
        read_bytes(InputFormat::Design, &write_design(design), "d.sheet.json", None, &options)
            .unwrap()
    }

    #[test]
    fn a_design_keeps_its_own_materials() {
        let own = format!(r#""materials": {{"b-ply": {PLY}, "a-ply": {PLY}, "paper": {PLY}}}"#);
        for (chosen, found) in [
            ("\"a-ply\"", Some("a-ply")),
            ("\"steel-1mm\"", Some("steel-1mm")),
            ("\"paper\"", Some("paper")),
            ("null", None),
            (PLY, Some("own")),
        ] {
            let design = read(&format!(r#""material": {chosen}, {own}"#)).unwrap();
            let material = design.material.as_ref();
            assert_eq!(material.map(|m| &m.name[..]), found);
            let names: Vec<&str> = design.materials.iter().map(|m| &m.name[..]).collect();
            assert_eq!(names[..3], ["b-ply", "a-ply", "paper"]);
            assert_eq!(names.get(3), found.filter(|name| *name == "own").as_ref());
            if found.is_some_and(|name| name != "steel-1mm") {
                let calliper = Sourced { value: 3.8, source: "calliper".to_owned() };
                let found = material.unwrap();
                assert_eq!((&found.thickness_mm, &found.title), (&calliper, &found.name));
                assert_eq!(found.warp_limit_deg, Sourced::assumed(6.0));
            }
            assert_eq!(again(&design), design);
        }
        // The caller may set one of them, or one of the catalogue.
        for (asked, found) in [("B-PLY", "b-ply"), ("steel-1MM", "steel-1mm")] {
            let design = read_with(&format!(r#""material": "paper", {own}"#), Some(asked)).unwrap();
            assert_eq!(design.material.as_ref().unwrap().name, found);
            assert_eq!(again(&design), design);
        }
        let error = read_with(&own, Some("c-play")).unwrap_err();
        assert_eq!(error.to_string(), "the material 'c-play' is not known");
        assert!(
            error.hint.contains("Known here: 'b-ply'; 'a-ply'; 'paper'; alu"),
            "{}",
            error.hint
        );
    }

    const FULL: &str = r#"{"thickness_mm": 4, "bend_radius_mm": 385, "modulus_n_per_mm2": 6400,
        "poisson": {"value": 0.1, "source": "tested"}, "yield_strain": 0.002,
        "density_kg_per_m3": 660, "k_factors": {"table": [[1, 0.38], [3, 0.43]], "source": "bent"},
        "deductions": {"table": [[2, 45, 1.2], [2, 90, 3.5]], "source": "brake"},
        "grain": {"along": {"modulus_n_per_mm2": 11800, "bend_radius_mm": 960},
                  "across": {"modulus_n_per_mm2": {"value": 1040, "source": "sag"},
                             "bend_radius_mm": 385}}}"#;

    #[test]
    fn every_field_is_read_and_written_back() {
        let design = read(&format!(r#""material": {FULL}"#)).unwrap();
        let sourced = |value, source: &str| Some(Sourced { value, source: source.to_owned() });
        let found = design.material.as_ref().unwrap();
        assert_eq!(found.modulus_n_per_mm2, sourced(6400.0, "assumed"));
        assert_eq!(found.poisson, sourced(0.1, "tested"));
        assert_eq!(found.yield_strain, sourced(0.002, "assumed"));
        assert_eq!(found.density_kg_per_m3, sourced(660.0, "assumed"));
        let k = found.k_factors.as_ref().unwrap();
        let rows: Vec<[f64; 2]> = k.rows.iter().map(|k| [k.radius_per_thickness, k.k]).collect();
        assert_eq!((&rows[..], &k.source[..]), (&[[1.0, 0.38], [3.0, 0.43]][..], "bent"));
        let grain = found.grain.as_ref().unwrap();
        assert_eq!(Some(grain.across.modulus_n_per_mm2.clone()), sourced(1040.0, "sag"));
        assert_eq!(grain.along.bend_radius_mm, Sourced::assumed(960.0));
        assert_eq!(again(&design), design);
        // K-factors without a source, and a material without any of these.
        for own in [&FULL.replace(r#", "source": "bent""#, ""), PLY] {
            let design = read(&format!(r#""material": {own}"#)).unwrap();
            assert_eq!(again(&design), design);
            let text = String::from_utf8(write_design(&design)).unwrap();
            assert!(!text.contains("null") && text.contains("poisson") == (own != PLY), "{text}");
        }
        // All of the catalogue, written as the design's own.
        for material in known_materials(&[]) {
            let mine = Material { name: "mine".to_owned(), ..material.clone() };
            let design = Design { material: Some(mine), ..design.clone() };
            assert_eq!(again(&design).material, design.material, "{}", material.name);
        }
    }

    #[test]
    fn errors_of_optional_fields_know_their_path() {
        for (from, to, path, message) in [
            ("6400", "3e6", "modulus_n_per_mm2", "the number 3000000 N/mm² is out"),
            ("0.1,", "0.5,", "poisson", "the number 0.5 is out"),
            (r#""tested""#, r#""""#, "poisson.source", "the source is empty"),
            ("0.002", "0", "yield_strain", "the number 0 is out"),
            ("660", "0.66", "density_kg_per_m3", "the number 0.66 kg/m³ is out"),
            ("[[1, 0.38], [3, 0.43]]", "[]", "k_factors.table", "the table of K-factors has 0"),
            ("0.43", "0.7", "k_factors.table[1]", "the K-factor 0.7 is out"),
            ("[1, 0.38]", "[-1, 0.38]", "k_factors.table[0]", "the radius over thickness -1 is"),
            ("[3, 0.43]", "[1, 0.43]", "k_factors.table[1]", "the radius 1 follows"),
            (r#""bent""#, r#"" ""#, "k_factors.source", "the source is empty"),
            ("[[2, 45, 1.2], [2, 90, 3.5]]", "[]", "deductions.table", "the table of deductions"),
            ("2, 90, 3.5", "-2, 90, 3.5", "deductions.table[1]", "the radius -2 mm is out"),
            ("2, 90, 3.5", "2, 180, 3.5", "deductions.table[1]", "the angle 180 is out"),
            ("2, 90, 3.5", "2, 90, 12", "deductions.table[1]", "the deduction 12 mm is out"),
            ("2, 90, 3.5", "2, 45, 3.5", "deductions.table[1]", "the row follows one of as"),
            (r#""brake""#, r#"" ""#, "deductions.source", "the source is empty"),
            ("960", "0", "grain.along.bend_radius_mm", "the number 0 mm is out"),
            ("1040", "-1", "grain.across.modulus_n_per_mm2", "the number -1 N/mm² is"),
        ] {
            assert_eq!(FULL.matches(from).count(), 1, "{from}");
            let error = read(&format!(r#""material": {}"#, FULL.replace(from, to))).unwrap_err();
            assert_eq!(error.place, Some(format!("d.sheet.json: material.{path}")), "{to}");
            assert!(error.message.starts_with(message), "{to}: {}", error.message);
            assert!(!error.hint.is_empty(), "{to}");
        }
        for (from, to, said) in [
            ("\"along\"", "\"with\"", "the field 'with' is not known"),
            ("\"table\"", "\"tabel\"", "the field 'tabel' is not known"),
            ("[3, 0.43]", "[3]", "material.k_factors.table"),
            (
                r#"{"table": [[1, 0.38], [3, 0.43]], "source": "bent"}"#,
                "[[[1, 0.38]]]",
                "an object",
            ),
        ] {
            let error = read(&format!(r#""material": {}"#, FULL.replace(from, to))).unwrap_err();
            assert!(error.to_string().contains(said), "{to}: {error}");
        }
    }

    #[test]
    fn a_material_from_elsewhere_is_written_under_a_name_that_is_free() {
        let design = read(&format!(r#""materials": {{"paper": {PLY}}}"#)).unwrap();
        let material = material_named("paper", &[]);
        let back = again(&Design { material: material.clone(), ..design.clone() });
        assert_eq!(back.materials.len(), 2);
        let renamed = Material { name: "paper-2".to_owned(), ..material.unwrap() };
        assert_eq!(back.material, Some(renamed));
        assert_eq!(again(&back), back);
    }

    #[test]
    fn what_is_read_is_written_so_that_it_reads() {
        let list = |count: usize| {
            let own: Vec<String> = (0..count).map(|n| format!(r#""m{n}": {PLY}"#)).collect();
            format!(r#""material": {PLY}, "materials": {{{}}}"#, own.join(","))
        };
        let design = read(&list(MAX_MATERIALS - 1)).unwrap();
        assert_eq!(again(&design), design);
        let error = read(&list(MAX_MATERIALS)).unwrap_err();
        assert_eq!(error.message, "the design has 1001 materials");
    }

    #[test]
    fn errors_know_their_path() {
        let of = |field: &str| format!(r#""materials": {{"a": {{{field}}}}}"#);
        for (fields, path, message) in [
            (
                of(r#""thickness_mm": 0, "bend_radius_mm": 3"#),
                "materials.a.thickness_mm",
                "the number 0 mm is out",
            ),
            (
                of(r#""thickness_mm": 1, "bend_radius_mm": 1e9"#),
                "materials.a.bend_radius_mm",
                "the number 10000",
            ),
            (
                of(r#""thickness_mm": 1, "bend_radius_mm": 3, "warp_limit_deg": 91"#),
                "materials.a.warp_limit_deg",
                "the number 91° is",
            ),
            (
                of(r#""thickness_mm": 1, "bend_radius_mm": 3, "stretch_limit": 2"#),
                "materials.a.stretch_limit",
                "the number 2 is out",
            ),
            (
                of(r#""thickness_mm": {"value": 1, "source": " "}, "bend_radius_mm": 3"#),
                "materials.a.thickness_mm.source",
                "the source is empty",
            ),
            (
                of(r#""thickness_mm": 1, "bend_radius_mm": 3, "title": "a\nb""#),
                "materials.a.title",
                "the title 'a",
            ),
            (
                format!(r#""materials": {{"": {PLY}}}"#),
                "materials",
                "the material's name '' is empty",
            ),
            (
                r#""material": {"thickness_mm": 1, "bend_radius_mm": -3}"#.to_owned(),
                "material.bend_radius_mm",
                "the number -3 mm",
            ),
            (r#""material": "steel""#.to_owned(), "material", "the material 'steel' is not known"),
            (
                format!(r#""material": {PLY}, "materials": {{"own": {PLY}}}"#),
                "material",
                "`materials` has one",
            ),
        ] {
            let error = read(&fields).unwrap_err();
            assert_eq!(error.place, Some(format!("d.sheet.json: {path}")), "{fields}");
            assert!(error.message.starts_with(message), "{fields}: {}", error.message);
        }
        let error = read(&of(r#""thickness": 1"#)).unwrap_err();
        assert!(error.to_string().contains("materials.a.thickness: the field 'thickness' is not"));
        assert!(error.hint.starts_with("Did you mean `thickness_mm`? "), "{}", error.hint);
    }
}
