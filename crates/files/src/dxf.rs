//! Patterns as DXF R12, and back.
