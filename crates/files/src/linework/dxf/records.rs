//! A DXF file as records: a name and the pairs of a group code and a value that follow it.

use crate::reading::InputError;
use sheetwright::math::{Point3, Vec3};

/// A record of a file, such as an entity.
#[derive(Clone, Debug)]
pub(super) struct Record<'a> {
    pub(super) kind: &'a str,
    /// The number of the line of its name, from 1.
    pub(super) line: usize,
    pairs: Vec<(i32, &'a str)>,
}

impl<'a> Record<'a> {
    pub(super) fn pairs(&self) -> impl Iterator<Item = (i32, &'a str)> {
        self.pairs.iter().copied()
    }

    pub(super) fn text(&self, code: i32) -> Option<&'a str> {
        self.pairs().find(|(found, _)| *found == code).map(|(_, value)| value)
    }

    /// The first number with a code.
    pub(super) fn number(&self, code: i32) -> Option<f64> {
        self.text(code)?.parse().ok()
    }

    pub(super) fn or(&self, code: i32, usual: f64) -> f64 {
        self.number(code).unwrap_or(usual)
    }

    pub(super) fn flags(&self, code: i32) -> i64 {
        self.text(code).and_then(|value| value.parse().ok()).unwrap_or(0)
    }

    /// The point whose x has a code; y and z have codes 10 and 20 higher.
    pub(super) fn point(&self, code: i32) -> Point3 {
        Point3::new(self.or(code, 0.0), self.or(code + 10, 0.0), self.or(code + 20, 0.0))
    }

    /// All points whose x has a code, in order.
    pub(super) fn points(&self, code: i32) -> Vec<Point3> {
        let mut points: Vec<Point3> = Vec::new();
        for (found, value) in self.pairs() {
            let value = value.parse().unwrap_or(f64::NAN);
            match (found.wrapping_sub(code), points.last_mut()) {
                (0, _) => points.push(Point3::new(value, 0.0, 0.0)),
                (10, Some(point)) => point.y = value,
                (20, Some(point)) => point.z = value,
                _ => {}
            }
        }
        points
    }

    /// All numbers with a code, in order.
    pub(super) fn numbers(&self, code: i32) -> Vec<f64> {
        let of_code = self.pairs().filter(|(found, _)| *found == code);
        of_code.map(|(_, value)| value.parse().unwrap_or(f64::NAN)).collect()
    }

    /// The direction of extrusion, which plane entities stand on.
    pub(super) fn normal(&self) -> Vec3 {
        if self.number(210).is_none() && self.number(230).is_none() {
            return Vec3::Z;
        }
        Vec3::new(self.or(210, 0.0), self.or(220, 0.0), self.or(230, 0.0))
    }

    pub(super) fn layer(&self) -> &'a str {
        self.text(8).unwrap_or("0")
    }
}

/// The records of a file, in order.
///
/// # Errors
/// A line where a group code should stand.
pub(super) fn records<'a>(text: &'a str, place: &str) -> Result<Vec<Record<'a>>, InputError> {
    let mut records: Vec<Record<'a>> = Vec::new();
    let mut lines = text.lines().enumerate();
    while let Some((n, code)) = lines.next() {
        let at = || format!("{place}:{}", n + 1);
        if code.trim().is_empty() && text.lines().skip(n).all(|line| line.trim().is_empty()) {
            break;
        }
        let Ok(code) = code.trim().parse::<i32>() else {
            let shown = crate::names::shown(code.trim());
            let message = format!("{shown} stands where the number of a group should");
            return Err(InputError::at(at(), message, super::EXPORT));
        };
        let Some((_, value)) = lines.next() else {
            let hint = "The file is incomplete: copy or export it again.";
            return Err(InputError::at(at(), "the file ends within a group", hint));
        };
        match (code, records.last_mut()) {
            (0, _) => records.push(Record { kind: value.trim(), line: n + 1, pairs: Vec::new() }),
            // A comment, or data of other programs.
            (999.., _) | (_, None) => {}
            (_, Some(record)) => record.pairs.push((code, value.trim())),
        }
    }
    Ok(records)
}
