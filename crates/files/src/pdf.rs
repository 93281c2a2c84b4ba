//! Patterns as PDF, true to scale, tiled to sheets of paper.
