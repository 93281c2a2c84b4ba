//! Names for the rows of a table and their folders: no two have one, on no system.

use crate::names::{folded, is_invisible};
use std::collections::BTreeMap;

/// Names that are taken.
#[derive(Debug, Default)]
pub struct Ids {
    /// The number that is tried next, by the name without one.
    next: BTreeMap<String, u64>,
}

impl Ids {
    /// The name, with a number behind it if it is taken; where it is empty, that of the row.
    pub fn take(&mut self, name: &str, row: u64) -> String {
        let name: String = name.chars().filter(|c| !is_invisible(*c)).collect();
        let name = match name.trim() {
            "" => row.to_string(),
            name => name.to_owned(),
        };
        let first = folded(&name);
        let Some(&known) = self.next.get(&first) else {
            self.next.insert(first, 2);
            return name;
        };
        let mut next = known;
        loop {
            let numbered = format!("{name}-{next}");
            next += 1;
            let key = folded(&numbered);
            if !self.next.contains_key(&key) {
                self.next.insert(key, 2);
                self.next.insert(first, next);
                return numbered;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_two_rows_have_one_name() {
        let mut ids = Ids::default();
        let taken = ["a", "A", "a-2", "a", "", " \n", "b"].map(|name| ids.take(name, 9));
        assert_eq!(taken, ["a", "A-2", "a-2-2", "a-3", "9", "9-2", "b"]);
    }
}
