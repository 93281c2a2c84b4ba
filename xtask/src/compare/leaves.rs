//! The values of a JSON text, each with the way to it: `panels[0].warp_max_deg`.
//!
//! Numbers stay as they are written: rounding on the way in must not hide a last digit. So this is
//! a reader of our own, of texts that our own writers made.

/// A value that contains no other values.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Leaf {
    /// A number, `true`, `false`, `null`, or an empty list or object, as it is written.
    Token(String),
    /// A text, as it is written between its quotes.
    Text(String),
}

/// All leaves in the order of the text.
///
/// # Errors
/// Where it is no JSON, by the byte.
pub(super) fn leaves(text: &str) -> Result<Vec<(String, Leaf)>, String> {
    let mut reader = Reader { text: text.as_bytes(), at: 0, found: Vec::new() };
    reader.value("")?;
    reader.space();
    if reader.at == text.len() { Ok(reader.found) } else { Err(reader.wrong()) }
}

struct Reader<'a> {
    text: &'a [u8],
    at: usize,
    found: Vec<(String, Leaf)>,
}

impl Reader<'_> {
    fn wrong(&self) -> String {
        format!("byte {} is no JSON", self.at)
    }

    fn space(&mut self) {
        while self.text.get(self.at).is_some_and(u8::is_ascii_whitespace) {
            self.at += 1;
        }
    }

    /// Whether this byte comes next; if so, it is skipped.
    fn takes(&mut self, byte: u8) -> bool {
        self.space();
        let is_next = self.text.get(self.at) == Some(&byte);
        self.at += usize::from(is_next);
        is_next
    }

    fn value(&mut self, path: &str) -> Result<(), String> {
        if self.takes(b'{') {
            return self.list(path, b'}', true);
        }
        if self.takes(b'[') {
            return self.list(path, b']', false);
        }
        let leaf = if self.text.get(self.at) == Some(&b'"') {
            Leaf::Text(self.quoted()?)
        } else {
            Leaf::Token(self.token()?)
        };
        self.found.push((path.to_owned(), leaf));
        Ok(())
    }

    /// Reads the values up to the closing bracket.
    fn list(&mut self, path: &str, end: u8, is_object: bool) -> Result<(), String> {
        if self.takes(end) {
            let empty = if is_object { "{}" } else { "[]" };
            self.found.push((path.to_owned(), Leaf::Token(empty.to_owned())));
            return Ok(());
        }
        for n in 0.. {
            let inner = if is_object {
                self.space();
                let key = self.quoted()?;
                if !self.takes(b':') {
                    return Err(self.wrong());
                }
                if path.is_empty() { key } else { format!("{path}.{key}") }
            } else {
                format!("{path}[{n}]")
            };
            self.value(&inner)?;
            if !self.takes(b',') {
                break;
            }
        }
        if self.takes(end) { Ok(()) } else { Err(self.wrong()) }
    }

    fn quoted(&mut self) -> Result<String, String> {
        if !self.takes(b'"') {
            return Err(self.wrong());
        }
        let start = self.at;
        loop {
            match self.text.get(self.at) {
                Some(b'"') => break,
                Some(b'\\') => self.at += 2,
                Some(_) => self.at += 1,
                None => return Err(self.wrong()),
            }
        }
        self.at += 1;
        Ok(String::from_utf8_lossy(&self.text[start..self.at - 1]).into_owned())
    }

    fn token(&mut self) -> Result<String, String> {
        let start = self.at;
        let is_part = |byte: &u8| byte.is_ascii_alphanumeric() || b"+-.".contains(byte);
        while self.text.get(self.at).is_some_and(is_part) {
            self.at += 1;
        }
        let token = String::from_utf8_lossy(&self.text[start..self.at]).into_owned();
        let is_known = ["true", "false", "null"].contains(&&token[..]);
        if is_known || token.parse::<f64>().is_ok() { Ok(token) } else { Err(self.wrong()) }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)] // tests panic

    use super::*;

    #[test]
    fn every_value_has_its_way() {
        let text = r#" {"a": [1.50, {"b": "x \" y"}], "c": null, "d": [], "e": {}, "f": -1e-9} "#;
        let token = |path: &str, token: &str| (path.to_owned(), Leaf::Token(token.to_owned()));
        let expected = [
            token("a[0]", "1.50"),
            ("a[1].b".to_owned(), Leaf::Text(r#"x \" y"#.to_owned())),
            token("c", "null"),
            token("d", "[]"),
            token("e", "{}"),
            token("f", "-1e-9"),
        ];
        assert_eq!(leaves(text).unwrap(), expected);
        for broken in ["", "{", "[1", "[1 2]", "{\"a\" 1}", "{\"a\":}", "nothing", "1 1", "\"x"] {
            assert!(leaves(broken).is_err(), "{broken}");
        }
    }
}
