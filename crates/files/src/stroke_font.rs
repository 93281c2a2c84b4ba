//! A single-stroke alphabet for engraved labels.
