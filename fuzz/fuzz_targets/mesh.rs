//! Any bytes as a mesh of every format: an error with a hint, or groups that fit their own points.
//! Small ones are made as well: the door of the kernel keeps what it promises.
#![no_main]

use libfuzzer_sys::fuzz_target;
use sheetwright::design::MeshDesign;
use sheetwright::make::{MeshOptions, make_meshes};
use sheetwright::math::from_deg;
use sheetwright::watch::Unwatched;
use sheetwright_files::{
    Format, Input, InputFormat, MeshFormat, PdfOptions, ReadOptions, mesh_hint_for,
    mesh_output_files, read_any_bytes,
};

/// Triangles up to which making takes no time worth speaking of.
const SMALL: usize = 60;

fuzz_target!(|bytes: &[u8]| {
    for format in MeshFormat::ALL {
        let name = format!("fuzz.{}", format.ending());
        let format = InputFormat::Mesh(format);
        match read_any_bytes(format, bytes, &name, None, &ReadOptions::default()) {
            Err(error) => assert!(!error.message.is_empty() && !error.hint.is_empty()),
            Ok(Input::Design(_)) => unreachable!("a mesh is no design"),
            Ok(Input::Mesh(design)) => {
                assert!(!design.groups.is_empty());
                for group in &design.groups {
                    let corners = group.triangles.iter().flatten();
                    assert!(corners.clone().count() > 0);
                    assert!(corners.into_iter().all(|v| v.get() < group.positions.len()));
                    assert!(group.positions.iter().all(|p| p.is_finite()));
                }
                try_to_make(&design);
            }
        }
    }
});

fn try_to_make(design: &MeshDesign) {
    if design.groups.iter().map(|group| group.triangles.len()).sum::<usize>() > SMALL {
        return;
    }
    let split = MeshOptions { split_creases: Some(from_deg(30.0)), ..MeshOptions::default() };
    for options in [MeshOptions::default(), split] {
        match make_meshes(design, &options, &mut Unwatched) {
            Err(error) => assert!(!mesh_hint_for(&error).is_empty()),
            Ok(made) => {
                let files = mesh_output_files(&made, &[Format::Report], &PdfOptions::default());
                assert!(files.is_ok_and(|outputs| outputs.files.len() == 2));
            }
        }
    }
}
