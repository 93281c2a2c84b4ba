//! Curve tables (`*.csv`).
