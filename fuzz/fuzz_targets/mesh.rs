//! Any bytes as a mesh of every format: an error with a hint, or groups that fit their own points.
//! Small ones are made as well: the door of the kernel keeps what it promises.
#![no_main]

use libfuzzer_sys::fuzz_target;
use sheetwright::design::{Design, PanelMesh, PanelShape};
use sheetwright::make::{Judging, make_judged};
use sheetwright::math::from_deg;
use sheetwright::watch::Unwatched;
use sheetwright_files::{
    Format, InputFormat, MeshFormat, MeshSettings, PdfOptions, ReadOptions, hint_for, output_files,
    read_bytes,
};

/// Triangles up to which making takes no time worth speaking of.
const SMALL: usize = 60;

fuzz_target!(|bytes: &[u8]| {
    let split = MeshSettings { split_creases: Some(from_deg(30.0)), ..MeshSettings::default() };
    for format in MeshFormat::ALL {
        let name = format!("fuzz.{}", format.ending());
        for mesh in [MeshSettings::default(), split] {
            let options = ReadOptions { mesh, ..ReadOptions::default() };
            match read_bytes(InputFormat::Mesh(format), bytes, &name, None, &options) {
                Err(error) => assert!(!error.message.is_empty() && !error.hint.is_empty()),
                Ok(design) => {
                    assert!(!design.panels.is_empty());
                    meshes(&design).for_each(fits);
                    try_to_make(&design);
                }
            }
        }
    }
});

fn meshes(design: &Design) -> impl Iterator<Item = &PanelMesh> {
    design.panels.iter().map(|panel| match &panel.shape {
        PanelShape::Mesh(mesh) => mesh,
        _ => unreachable!("a mesh has no curves"),
    })
}

fn fits(mesh: &PanelMesh) {
    let (positions, triangles) = (&mesh.triangles.positions, &mesh.triangles.triangles);
    assert!(!triangles.is_empty());
    assert!(triangles.iter().flatten().all(|v| v.get() < positions.len()));
    assert!(positions.iter().all(|p| p.is_finite()));
}

fn try_to_make(design: &Design) {
    if meshes(design).map(|mesh| mesh.triangles.triangles.len()).sum::<usize>() > SMALL {
        return;
    }
    // An elastic sheet takes seconds where its strain is near the limit.
    match make_judged(design, Judging::Quick, &mut Unwatched) {
        Err(error) => assert!(!hint_for(&error).is_empty()),
        Ok(made) => {
            let files = output_files(&made, &[Format::Report], &PdfOptions::default());
            assert!(files.is_ok_and(|outputs| outputs.files.len() == 2));
        }
    }
}
