//! Designs (`*.sheet.json`): JSON to a kernel design and back.
