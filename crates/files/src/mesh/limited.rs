//! Lists in JSON of a limited length: in memory, an empty entry may take a hundred times the bytes
//! that it has in the file.

use serde::de::{Error, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};
use std::fmt;
use std::marker::PhantomData;

/// The most entries of a list: more nodes than any scene of sheets has.
const MOST_ENTRIES: usize = 100_000;

/// A list of at most [`MOST_ENTRIES`].
pub(super) fn limited<'de, D: Deserializer<'de>, T: Deserialize<'de>>(
    from: D,
) -> Result<Vec<T>, D::Error> {
    struct Limited<T>(PhantomData<T>);
    impl<'de, T: Deserialize<'de>> Visitor<'de> for Limited<T> {
        type Value = Vec<T>;

        fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            write!(f, "a list of at most {MOST_ENTRIES} entries")
        }

        fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Vec<T>, A::Error> {
            let mut found = Vec::new();
            while let Some(entry) = list.next_element()? {
                if found.len() == MOST_ENTRIES {
                    return Err(A::Error::custom(format!("more than {MOST_ENTRIES} entries")));
                }
                found.push(entry);
            }
            Ok(found)
        }
    }
    from.deserialize_seq(Limited(PhantomData))
}
