//! Surfaces as OBJ.
