//! What is kept of a document that its file does not have: all of it, and the name of the file, so
//! that *Save* still goes there after it has come back.
//!
//! `SWD1`, the length of the name, the name, and then the bytes of a design. What begins otherwise
//! is a design that was kept without a name, as earlier versions did.

use super::Document;

const MARK: [u8; 4] = *b"SWD1";
/// What messages call it.
const NAME: &str = "recovered.sheet.json";

/// A document that its file does not have.
#[derive(Clone, Debug, PartialEq)]
pub struct Draft {
    /// The document.
    pub document: Document,
    /// The name of its file, if it has one.
    pub file: Option<String>,
}

impl Draft {
    /// Its bytes, to be kept.
    pub fn bytes(&self) -> Vec<u8> {
        let file = self.file.as_deref().unwrap_or("");
        let mut all = MARK.to_vec();
        all.extend((file.len() as u64).to_le_bytes());
        all.extend(file.as_bytes());
        all.extend(self.document.bytes());
        all
    }

    /// What was kept.
    ///
    /// # Errors
    /// What is wrong with it, in words.
    pub fn read(bytes: &[u8]) -> Result<Self, String> {
        let (file, design) = match bytes.strip_prefix(&MARK) {
            Some(rest) => named(rest).ok_or("What was kept is not whole.")?,
            None => ("", bytes),
        };
        let file = (!file.is_empty()).then(|| file.to_owned());
        Ok(Self { document: Document::read(NAME, design)?, file })
    }
}

/// The name, and the bytes after it.
fn named(rest: &[u8]) -> Option<(&str, &[u8])> {
    let (length, rest) = rest.split_first_chunk::<8>()?;
    let length = usize::try_from(u64::from_le_bytes(*length)).ok()?;
    let (name, design) = rest.split_at_checked(length)?;
    Some((std::str::from_utf8(name).ok()?, design))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_draft_comes_back_with_the_name_of_its_file() {
        let mut document = Document::default();
        document.design.name = "hood".to_owned();
        for file in [None, Some("/home/me/häuser/a\nb.sheet.json".to_owned())] {
            let draft = Draft { document: document.clone(), file };
            let bytes = draft.bytes();
            assert_eq!(Draft::read(&bytes), Ok(draft));
            // The last byte ends a line.
            for n in 0..bytes.len() - 1 {
                assert!(Draft::read(&bytes[..n]).is_err(), "cut off after {n}");
            }
        }
        // As earlier versions kept it.
        assert_eq!(Draft::read(&document.bytes()), Ok(Draft { document, file: None }));
    }
}
