//! Reads written patterns back and folds them up again.
