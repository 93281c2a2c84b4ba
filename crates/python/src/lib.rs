//! The Rust half of the Python package `pysheetwright`: NumPy arrays to kernel values and back.
//!
//! Nothing is computed here that the command would not compute: whatever a caller hands over
//! becomes the bytes of a design, of a curve table or of a mesh (`source`), which
//! `sheetwright_files` reads as it reads files. So a panel from Python is, to the last bit, the
//! panel that the command makes of such a file. `settings` has the options, `ranges` what their
//! numbers may be, `made` and `part` the results, `many` the panels by the thousand, `failure` the
//! errors.
//!
//! The half that is Python, `python/pysheetwright`, has the functions with their keywords and
//! documentation, plots, and Ray. `_native.pyi` beside it has the types of what stands here.

mod arrays;
mod catalogue;
mod failure;
mod flat_mesh;
mod made;
mod many;
mod nested;
mod part;
mod ranges;
mod remedies;
mod settings;
mod signals;
mod source;

/// The Rust half of `pysheetwright`.
#[pyo3::pymodule]
mod _native {
    #[pymodule_export]
    use crate::catalogue::{Material, formats, materials, presets, template, templates, trades};
    #[pymodule_export]
    use crate::flat_mesh::{FlatMesh, flatten};
    #[pymodule_export]
    use crate::made::{Made, make_bytes, make_file, make_mesh, make_points};
    #[pymodule_export]
    use crate::many::solve_many;
    #[pymodule_export]
    use crate::nested::{Layout, nest};
    #[pymodule_export]
    use crate::part::{Edge, Finding, Part};

    #[pymodule_export]
    #[allow(non_upper_case_globals, reason = "Python's name for it")]
    const __version__: &str = env!("CARGO_PKG_VERSION");
}
