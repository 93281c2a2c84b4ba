//! JSON types of designs and of the catalogue of materials: values that must be objects, and
//! objects whose keys are names.

use serde::de::{self, Deserialize, Deserializer, MapAccess, Visitor};
use serde::{Serialize, Serializer};
use std::collections::BTreeSet;
use std::fmt;
use std::marker::PhantomData;

/// The end of the message about a name that an object has twice.
pub(crate) const TWICE: &str = "is written twice";

/// A value that must be a JSON object. The reader that serde derives also accepts a list of the
/// fields.
#[derive(Debug)]
pub(crate) struct Object<T>(pub(crate) T);

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Object<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Map<T>(PhantomData<T>);
        impl<'de, T: Deserialize<'de>> Visitor<'de> for Map<T> {
            type Value = T;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, "an object")
            }
            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<T, A::Error> {
                T::deserialize(de::value::MapAccessDeserializer::new(map))
            }
        }
        deserializer.deserialize_map(Map(PhantomData)).map(Self)
    }
}

impl<T: Serialize> Serialize for Object<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.0.serialize(serializer)
    }
}

/// The word for the values of an object of names.
pub(crate) trait Called {
    /// One word, such as `curve`.
    const CALLED: &str;
}

/// The values of an object whose keys are names, in the order of the file. Reading refuses a name
/// that appears twice.
#[derive(Debug)]
pub(crate) struct Named<T>(pub(crate) Vec<(String, T)>);

impl<T> Default for Named<T> {
    fn default() -> Self {
        Self(Vec::new())
    }
}

impl<'de, T: Deserialize<'de> + Called> Deserialize<'de> for Named<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Things<T>(PhantomData<T>);
        impl<'de, T: Deserialize<'de> + Called> Visitor<'de> for Things<T> {
            type Value = Named<T>;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, "an object with a {} a name", T::CALLED)
            }
            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Named<T>, A::Error> {
                let mut things = Vec::new();
                let mut names = BTreeSet::new();
                while let Some(name) = map.next_key::<String>()? {
                    if !names.insert(name.clone()) {
                        let shown = crate::names::shown(&name);
                        let text = format!("the {} {shown} {TWICE}", T::CALLED);
                        return Err(de::Error::custom(text));
                    }
                    let Object(thing) = map.next_value()?;
                    things.push((name, thing));
                }
                Ok(Named(things))
            }
        }
        deserializer.deserialize_map(Things(PhantomData))
    }
}

/// A value as JSON in one line. Numbers, texts and lists of them always serialise.
pub(crate) fn json(value: &impl Serialize) -> String {
    serde_json::to_string(value).unwrap_or_default()
}

/// Compares a schema with the one in `docs/schema`, which is written anew with
/// `SHEETWRIGHT_REWRITE=1 cargo test -p sheetwright-files schema`.
#[cfg(test)]
pub(crate) fn assert_schema_in_docs(name: &str, schema: &str) {
    let path = format!("{}/../../docs/schema/{name}", env!("CARGO_MANIFEST_DIR"));
    if std::env::var_os("SHEETWRIGHT_REWRITE").is_some() {
        std::fs::write(&path, schema).unwrap();
    }
    let kept = std::fs::read_to_string(&path).unwrap_or_default().replace('\r', "");
    assert!(
        kept == schema,
        "docs/schema/{name} differs from the code; write it anew with SHEETWRIGHT_REWRITE=1 cargo \
         test -p sheetwright-files schema"
    );
}
