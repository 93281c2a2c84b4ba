//! Patterns as SVG, and back.
