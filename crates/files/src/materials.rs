//! Materials: the catalogue, `materials.json`, and those that a design brings along.
//!
//! Both are written in one way, an object of materials by their names. A number stands alone or
//! with its source; the catalogue gives the source of every one.

use crate::json::{Called, Named, Object};
use crate::names::{folded, refused_anywhere, shown};
use schemars::JsonSchema;
use serde::de::{self, Deserialize, Deserializer, MapAccess, Visitor};
use serde::{Deserialize as Derived, Serialize};
use sheetwright::material::{
    ASSUMED, DEFAULT_STRETCH_LIMIT, DEFAULT_WARP_LIMIT_DEG, Material, Sourced,
};
use std::collections::BTreeMap;
use std::fmt;
use std::ops::RangeInclusive;
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

/// What a sheet of one material and one thickness takes.
#[derive(Debug, Derived, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct MaterialFile {
    /// How reports call it. Default: its name.
    #[serde(default)]
    pub(crate) title: Option<String>,
    /// Thickness, mm: 0.001 to 1000.
    thickness_mm: NumberFile,
    /// The smallest radius that it is bent to, mm: 0.001 to 1,000,000. A sheet folds along a scored
    /// line if this is at most 10 times the thickness.
    bend_radius_mm: NumberFile,
    /// The largest warp angle along a ruling that it takes, degrees: 0.01 to 90. Default: 6.
    #[serde(default)]
    warp_limit_deg: Option<NumberFile>,
    /// By which share lengths within its plane may change: 0.000001 to 1. Default: 0.001.
    #[serde(default)]
    stretch_limit: Option<NumberFile>,
}

impl Called for MaterialFile {
    const CALLED: &str = "material";
}

/// A number, without a source or with one.
#[derive(Debug, Serialize, JsonSchema)]
#[serde(untagged)]
enum NumberFile {
    /// A number without a source: it is assumed.
    Bare(f64),
    /// A number and where it comes from.
    Sourced(SourcedFile),
}

/// A number and where it comes from.
#[derive(Debug, Derived, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct SourcedFile {
    /// The number.
    value: f64,
    /// A publication, a data sheet or a measurement; begins with `assumed` where there is none.
    #[schemars(length(min = 1))]
    source: String,
}

/// The sheet that a design is made from.
#[derive(Debug, JsonSchema)]
#[schemars(untagged)]
pub(crate) enum MaterialChoice {
    /// The name of one of `materials`, or of one in the catalogue.
    Name(String),
    /// What it takes. Its name is its `title`, or `own`.
    Own(MaterialFile),
}

/// Thicknesses, mm, from a thousandth to a metre: a number beyond was meant in another unit.
const THICKNESSES_MM: RangeInclusive<f64> = 0.001..=1000.0;
/// Bend radii, mm, up to a kilometre: a larger one forbids every bend.
const BEND_RADII_MM: RangeInclusive<f64> = 0.001..=1e6;
/// Warp angles, degrees, up to a right angle: rungs hardly turn by more.
const WARP_LIMITS_DEG: RangeInclusive<f64> = 0.01..=90.0;
/// Shares of a length, up to all of it.
const STRETCH_LIMITS: RangeInclusive<f64> = 1e-6..=1.0;

/// How an error is made of a JSON path, what is wrong, and what to do.
pub(crate) type Refuse<'a, E> = &'a dyn Fn(&str, String, &str) -> E;

/// The materials of an object, in its order.
pub(crate) fn materials_in<E>(
    list: Named<MaterialFile>,
    refuse: Refuse<'_, E>,
) -> Result<Vec<Material>, E> {
    let read = |(name, file): (String, MaterialFile)| {
        if let Some(why) = refused_anywhere(&name) {
            let message = format!("the material's name {} {why}", shown(&name));
            return Err(refuse("materials", message, "Give it a short name in one line."));
        }
        let path = format!("materials.{name}");
        material(name, file, &path, refuse)
    };
    list.0.into_iter().map(read).collect()
}

/// A material of what stands at a path.
pub(crate) fn material<E>(
    name: String,
    file: MaterialFile,
    path: &str,
    refuse: Refuse<'_, E>,
) -> Result<Material, E> {
    if let Some((title, why)) = file.title.as_deref().and_then(|t| Some((t, refused_anywhere(t)?)))
    {
        let message = format!("the title {} {why}", shown(title));
        return Err(refuse(
            &format!("{path}.title"),
            message,
            "Give it a short title in one line.",
        ));
    }
    let number = |field: &str, file: NumberFile, range: RangeInclusive<f64>, unit: &str| {
        number_in(file, &range).map_err(|fault| {
            let (least, most) = (range.start(), range.end());
            let hint = format!("It takes {least} to {most}{unit}.");
            let (below, message, hint) = match fault {
                Fault::Value(value) => {
                    ("", format!("the number {value}{unit} is out of range"), hint)
                }
                Fault::Source => {
                    let hint = "Say where the number comes from, or write the number alone.";
                    (".source", "the source is empty".to_owned(), hint.to_owned())
                }
            };
            refuse(&format!("{path}.{field}{below}"), message, &hint)
        })
    };
    let warp = file.warp_limit_deg.unwrap_or(NumberFile::Bare(DEFAULT_WARP_LIMIT_DEG));
    let stretch = file.stretch_limit.unwrap_or(NumberFile::Bare(DEFAULT_STRETCH_LIMIT));
    Ok(Material {
        thickness_mm: number("thickness_mm", file.thickness_mm, THICKNESSES_MM, " mm")?,
        bend_radius_mm: number("bend_radius_mm", file.bend_radius_mm, BEND_RADII_MM, " mm")?,
        warp_limit_deg: number("warp_limit_deg", warp, WARP_LIMITS_DEG, "°")?,
        stretch_limit: number("stretch_limit", stretch, STRETCH_LIMITS, "")?,
        title: file.title.unwrap_or_else(|| name.clone()),
        name,
    })
}

/// What is wrong with a number.
enum Fault {
    Value(f64),
    Source,
}

fn number_in(file: NumberFile, range: &RangeInclusive<f64>) -> Result<Sourced, Fault> {
    let number = match file {
        NumberFile::Bare(value) => Sourced::assumed(value),
        NumberFile::Sourced(SourcedFile { value, source }) => Sourced { value, source },
    };
    if !range.contains(&number.value) {
        Err(Fault::Value(number.value))
    } else if number.source.trim().is_empty() {
        Err(Fault::Source)
    } else {
        Ok(number)
    }
}

/// A material as it stands in a file, with every default written out.
pub(crate) fn file_of(material: &Material) -> MaterialFile {
    let number = |Sourced { value, source }: &Sourced| match source.as_str() {
        ASSUMED => NumberFile::Bare(*value),
        _ => NumberFile::Sourced(SourcedFile { value: *value, source: source.clone() }),
    };
    MaterialFile {
        title: Some(material.title.clone()),
        thickness_mm: number(&material.thickness_mm),
        bend_radius_mm: number(&material.bend_radius_mm),
        warp_limit_deg: Some(number(&material.warp_limit_deg)),
        stretch_limit: Some(number(&material.stretch_limit)),
    }
}

impl<'de> Deserialize<'de> for NumberFile {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Number;
        impl<'de> Visitor<'de> for Number {
            type Value = NumberFile;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, "a number or an object with `value` and `source`")
            }
            fn visit_f64<E: de::Error>(self, value: f64) -> Result<NumberFile, E> {
                Ok(NumberFile::Bare(value))
            }
            fn visit_u64<E: de::Error>(self, value: u64) -> Result<NumberFile, E> {
                Ok(NumberFile::Bare(value as f64))
            }
            fn visit_i64<E: de::Error>(self, value: i64) -> Result<NumberFile, E> {
                Ok(NumberFile::Bare(value as f64))
            }
            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<NumberFile, A::Error> {
                SourcedFile::deserialize(de::value::MapAccessDeserializer::new(map))
                    .map(NumberFile::Sourced)
            }
        }
        deserializer.deserialize_any(Number)
    }
}

impl<'de> Deserialize<'de> for MaterialChoice {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Choice;
        impl<'de> Visitor<'de> for Choice {
            type Value = MaterialChoice;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, "the name of a material or an object")
            }
            fn visit_str<E: de::Error>(self, name: &str) -> Result<MaterialChoice, E> {
                Ok(MaterialChoice::Name(name.to_owned()))
            }
            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<MaterialChoice, A::Error> {
                MaterialFile::deserialize(de::value::MapAccessDeserializer::new(map))
                    .map(MaterialChoice::Own)
            }
        }
        deserializer.deserialize_any(Choice)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_number_of_the_catalogue_has_a_source() {
        let file: serde_json::Value = serde_json::from_str(include_str!("materials.json")).unwrap();
        let materials = file["materials"].as_object().unwrap();
        assert_eq!(materials.len(), known_materials(&[]).len());
        for (name, material) in materials {
            let fields = material.as_object().unwrap();
            let numbers = fields.iter().filter(|(field, _)| *field != "title");
            let sources = numbers.map(|(_, number)| number["source"].as_str().unwrap());
            assert_eq!((fields.len(), sources.count()), (5, 4), "{name}");
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
        assert_eq!((known[0], known[1], known.len()), ("paper", "STEEL-1MM", 16));
        assert_eq!(material_named("paper", &own).unwrap().title, "mine");
        assert_eq!(material_named("steel-1mm", &own).unwrap().title, "mild steel, 1 mm");
        assert_eq!(material_named("Steel-1mm", &own).unwrap().title, "mine");
    }

    #[test]
    fn every_material_stands_in_the_docs_with_its_limits() {
        let docs = include_str!("../../../docs/files.md");
        for m in known_materials(&[]) {
            let row = format!(
                "| `{}` | {} | {} | {} | {} | {} |",
                m.name,
                m.title,
                m.thickness_mm.value,
                m.bend_radius_mm.value,
                m.warp_limit_deg.value,
                100.0 * m.stretch_limit.value
            );
            assert!(docs.contains(&row), "{row}");
        }
    }

    #[test]
    fn the_schema_is_that_of_the_code() {
        let schema = schemars::schema_for!(CatalogueFile);
        let text = serde_json::to_string_pretty(&schema).unwrap() + "\n";
        crate::json::assert_schema_in_docs("materials.schema.json", &text);
    }
}
