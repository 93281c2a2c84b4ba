//! Jobs and answers as bytes, for the way between a page and its workers.
//!
//! Numbers are little-endian, lists and texts begin with their length, one of several kinds begins
//! with its number; a check sum stands before everything. Bytes that are broken give `None`,
//! whatever they are: nothing here panics, and nothing is allocated that the bytes could not fill.

mod design;
mod findings;
mod made;

use super::{Answer, Detail, Job, Refusal, Varied};
use crate::envelope::{opened, sealed};
use sheetwright::math::{Point2, Point3, Vec2, Vec3};
use sheetwright::watch::Stage;
use sheetwright_files::{Format, OutputFile};
use std::sync::Arc;

/// A job as bytes.
pub fn job_bytes(job: &Job) -> Vec<u8> {
    bytes_of(job)
}

/// The job in some bytes; `None` if they are broken.
pub fn job_of(bytes: &[u8]) -> Option<Job> {
    of_bytes(bytes)
}

/// An answer as bytes.
pub fn answer_bytes(answer: &Answer) -> Vec<u8> {
    bytes_of(answer)
}

/// The answer in some bytes; `None` if they are broken.
pub fn answer_of(bytes: &[u8]) -> Option<Answer> {
    of_bytes(bytes)
}

fn bytes_of<T: Wire>(value: &T) -> Vec<u8> {
    let mut out = Vec::new();
    value.put(&mut out);
    sealed(&out)
}

fn of_bytes<T: Wire>(bytes: &[u8]) -> Option<T> {
    let mut rest = opened(bytes)?;
    let value = T::take(&mut rest)?;
    rest.is_empty().then_some(value)
}

/// What has bytes.
trait Wire: Sized {
    /// Adds its bytes.
    fn put(&self, out: &mut Vec<u8>);
    /// Takes its bytes from the front.
    fn take(from: &mut &[u8]) -> Option<Self>;
}

/// A struct: its fields, one after the other.
macro_rules! fields {
    ($name:ty { $($field:ident),* }) => {
        impl Wire for $name {
            fn put(&self, out: &mut Vec<u8>) {
                let Self { $($field),* } = self;
                $($field.put(out);)*
            }

            fn take(from: &mut &[u8]) -> Option<Self> {
                Some(Self { $($field: Wire::take(from)?),* })
            }
        }
    };
}

/// An enum of kinds without fields: their numbers, in this order.
macro_rules! kinds {
    ($name:ty { $($kind:ident),* }) => {
        impl Wire for $name {
            fn put(&self, out: &mut Vec<u8>) {
                // The compiler sees here that none is forgotten.
                match self {
                    $(Self::$kind => {})*
                }
                let number = [$(Self::$kind),*].iter().position(|kind| kind == self);
                out.push(number.unwrap_or_default() as u8);
            }

            fn take(from: &mut &[u8]) -> Option<Self> {
                [$(Self::$kind),*].get(usize::from(u8::take(from)?)).copied()
            }
        }
    };
}

/// An enum of kinds with fields: the number of the kind, in this order, then its fields.
macro_rules! variants {
    ($name:ty { $($kind:ident { $($field:ident),* }),* }) => {
        const _: () = {
            #[derive(Clone, Copy)]
            enum Number { $($kind),* }

            impl Wire for $name {
                fn put(&self, out: &mut Vec<u8>) {
                    // The compiler sees here that none is forgotten.
                    match self {
                        $(Self::$kind { $($field),* } => {
                            out.push(Number::$kind as u8);
                            $($field.put(out);)*
                        })*
                    }
                }

                fn take(from: &mut &[u8]) -> Option<Self> {
                    let number = u8::take(from)?;
                    $(
                        if number == Number::$kind as u8 {
                            return Some(Self::$kind { $($field: Wire::take(from)?),* });
                        }
                    )*
                    None
                }
            }
        };
    };
}
use {fields, kinds, variants};

macro_rules! numbers {
    ($($name:ty),*) => {$(
        impl Wire for $name {
            fn put(&self, out: &mut Vec<u8>) {
                out.extend(self.to_le_bytes());
            }

            fn take(from: &mut &[u8]) -> Option<Self> {
                let (first, rest) = from.split_first_chunk()?;
                *from = rest;
                Some(Self::from_le_bytes(*first))
            }
        }
    )*};
}
numbers!(u8, u32, u64, f64);

impl Wire for usize {
    fn put(&self, out: &mut Vec<u8>) {
        (*self as u64).put(out);
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        u64::take(from)?.try_into().ok()
    }
}

impl Wire for bool {
    fn put(&self, out: &mut Vec<u8>) {
        out.push(u8::from(*self));
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        match u8::take(from)? {
            0 => Some(false),
            1 => Some(true),
            _ => None,
        }
    }
}

impl<T: Wire> Wire for Vec<T> {
    fn put(&self, out: &mut Vec<u8>) {
        self.len().put(out);
        self.iter().for_each(|item| item.put(out));
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        let length = usize::take(from)?;
        // Every item has a byte at least; memory is taken for as much as is there.
        let sure = from.len() / size_of::<T>().max(1);
        let mut list = (length <= from.len()).then(|| Self::with_capacity(length.min(sure)))?;
        for _ in 0..length {
            list.push(T::take(from)?);
        }
        Some(list)
    }
}

impl Wire for String {
    fn put(&self, out: &mut Vec<u8>) {
        self.len().put(out);
        out.extend(self.as_bytes());
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        Self::from_utf8(Vec::take(from)?).ok()
    }
}

impl<T: Wire> Wire for Option<T> {
    fn put(&self, out: &mut Vec<u8>) {
        self.is_some().put(out);
        self.iter().for_each(|value| value.put(out));
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        Some(if bool::take(from)? { Some(T::take(from)?) } else { None })
    }
}

impl<T: Wire, E: Wire> Wire for Result<T, E> {
    fn put(&self, out: &mut Vec<u8>) {
        self.is_ok().put(out);
        match self {
            Ok(value) => value.put(out),
            Err(error) => error.put(out),
        }
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        Some(if bool::take(from)? { Ok(T::take(from)?) } else { Err(E::take(from)?) })
    }
}

impl<T: Wire, const N: usize> Wire for [T; N] {
    fn put(&self, out: &mut Vec<u8>) {
        self.iter().for_each(|item| item.put(out));
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        let mut list = Vec::with_capacity(N);
        for _ in 0..N {
            list.push(T::take(from)?);
        }
        list.try_into().ok()
    }
}

impl<A: Wire, B: Wire> Wire for (A, B) {
    fn put(&self, out: &mut Vec<u8>) {
        self.0.put(out);
        self.1.put(out);
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        Some((A::take(from)?, B::take(from)?))
    }
}

impl<T: Wire> Wire for Box<T> {
    fn put(&self, out: &mut Vec<u8>) {
        (**self).put(out);
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        T::take(from).map(Self::new)
    }
}

impl<T: Wire> Wire for Arc<T> {
    fn put(&self, out: &mut Vec<u8>) {
        (**self).put(out);
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        T::take(from).map(Self::new)
    }
}

fields!(Point2 { x, y });
fields!(Point3 { x, y, z });
fields!(Refusal { message, hint });
fields!(OutputFile { name, bytes });
fields!(Varied { moved, moved_max_mm, before, after });
kinds!(Detail { Coarse, Full });
kinds!(Stage { Sample, Solve, Vary, Flatten, Check, Nest });
kinds!(Format {
    Obj,
    Svg,
    Dxf,
    Pdf,
    Quads,
    Step,
    Fold,
    Astm,
    Offsets,
    Brake,
    Parts,
    Sheets,
    Assembly,
    Report
});

impl Wire for Vec2 {
    fn put(&self, out: &mut Vec<u8>) {
        self.to_array().put(out);
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        <[f64; 2]>::take(from).map(Self::from_array)
    }
}

impl Wire for Vec3 {
    fn put(&self, out: &mut Vec<u8>) {
        self.to_array().put(out);
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        <[f64; 3]>::take(from).map(Self::from_array)
    }
}

impl Wire for Job {
    fn put(&self, out: &mut Vec<u8>) {
        match self {
            Self::Show { number, design, detail } => {
                out.push(0);
                number.put(out);
                design.put(out);
                detail.put(out);
            }
            Self::Vary { number, design } => {
                out.push(1);
                number.put(out);
                design.put(out);
            }
            Self::Export { number, design, formats } => {
                out.push(2);
                number.put(out);
                design.put(out);
                formats.put(out);
            }
            Self::Advise { number, design } => {
                out.push(3);
                number.put(out);
                design.put(out);
            }
        }
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        let kind = u8::take(from)?;
        let (number, design) = (u64::take(from)?, Arc::take(from)?);
        Some(match kind {
            0 => Self::Show { number, design, detail: Detail::take(from)? },
            1 => Self::Vary { number, design },
            2 => Self::Export { number, design, formats: Vec::take(from)? },
            3 => Self::Advise { number, design },
            _ => return None,
        })
    }
}

impl Wire for Answer {
    fn put(&self, out: &mut Vec<u8>) {
        match self {
            Self::Shown { number, detail, panels } => {
                out.push(0);
                number.put(out);
                detail.put(out);
                panels.put(out);
            }
            Self::Varied { number, outcome } => {
                out.push(1);
                number.put(out);
                outcome.put(out);
            }
            Self::Files { number, outcome } => {
                out.push(2);
                number.put(out);
                outcome.put(out);
            }
            Self::Progress { number, stage, text, done } => {
                out.push(3);
                number.put(out);
                stage.put(out);
                text.put(out);
                done.put(out);
            }
            Self::Advised { number, advice, is_over } => {
                out.push(4);
                number.put(out);
                advice.put(out);
                is_over.put(out);
            }
        }
    }

    fn take(from: &mut &[u8]) -> Option<Self> {
        let kind = u8::take(from)?;
        let number = u64::take(from)?;
        Some(match kind {
            0 => Self::Shown { number, detail: Detail::take(from)?, panels: Vec::take(from)? },
            1 => Self::Varied { number, outcome: Wire::take(from)? },
            2 => Self::Files { number, outcome: Wire::take(from)? },
            3 => Self::Progress {
                number,
                stage: Stage::take(from)?,
                text: String::take(from)?,
                done: f64::take(from)?,
            },
            4 => Self::Advised { number, advice: Vec::take(from)?, is_over: bool::take(from)? },
            _ => return None,
        })
    }
}

#[cfg(test)]
mod tests;
