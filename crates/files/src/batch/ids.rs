//! Names for the rows of a table and their folders: no two have one, on no system.

use crate::names::{OwnNames, is_invisible};

/// Names that are taken.
#[derive(Debug, Default)]
pub struct Ids(OwnNames);

impl Ids {
    /// The name, with a number behind it if it is taken; where it is empty, that of the row.
    pub fn take(&mut self, name: &str, row: u64) -> String {
        let name: String = name.chars().filter(|c| !is_invisible(*c)).collect();
        match name.trim() {
            "" => self.0.take(&row.to_string(), '-'),
            name => self.0.take(name, '-'),
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
