//! Small typed indices that print themselves: a sample can't be mistaken for a triangle.

use std::fmt;

macro_rules! index {
    ($(#[$doc:meta])* $name:ident, $letter:literal) => {
        $(#[$doc])*
        #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub struct $name(u32);

        impl $name {
            /// The index that counts `position` from 0.
            ///
            /// # Panics
            /// Above u32::MAX, which no validated input reaches (see `boundary::MAX_SAMPLES`).
            pub fn new(position: usize) -> Self {
                assert!(position <= u32::MAX as usize, "index {position} does not fit 32 bits");
                Self(position as u32)
            }

            /// The position that this index counts, from 0.
            pub fn get(self) -> usize {
                self.0 as usize
            }
        }

        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, "{}{}", $letter, self.0)
            }
        }

        impl fmt::Debug for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                fmt::Display::fmt(self, f)
            }
        }
    };
}

index!(
    /// A sample of a boundary, counted through all its loops from 0; prints as `s7`.
    SampleIndex,
    's'
);
index!(
    /// A triangle of a surface, from 0; prints as `t7`.
    TriangleIndex,
    't'
);
index!(
    /// A vertex of a mesh, from 0; prints as `v7`.
    VertexIndex,
    'v'
);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn indices_print_what_they_count() {
        assert_eq!(SampleIndex::new(7).to_string(), "s7");
        assert_eq!(format!("{:?}", TriangleIndex::new(0)), "t0");
        assert_eq!(VertexIndex::new(3).to_string(), "v3");
    }
}
