//! The gallery: the figures of the paper that the project grew from, each from a design of its own.

use sheetwright::design::{Design, DesignPanel, PanelMesh, PanelShape, Triangles};
use sheetwright::flatten::Aim;
use sheetwright::index::VertexIndex;
use sheetwright::make::{Made, Part, make};
use sheetwright::math::to_deg;
use sheetwright::sheet::Sheet;
use sheetwright::watch::Unwatched;
use sheetwright_files::{
    InputFormat, MeshFormat, MeshSettings, PanelQuads, Picture, ReadOptions, design_from_template,
    design_picture, flat_picture, gauss_picture, material_named, quads_picture, read_bytes,
    side_by_side, space_picture, stacked, write_design,
};
use sheetwright_shapes::gallery::{half_sphere, multiply_connected, raised};
use sheetwright_shapes::three_cones;
use std::error::Error;
use std::fmt::Write;

type Result<T> = std::result::Result<T, Box<dyn Error>>;

const TEXT: &str = include_str!("gallery.md");

/// Samples of the designs.
const SAMPLES: usize = 200;
/// Rings of triangles of the half sphere: 2,400 triangles.
const RINGS: usize = 20;
const FOLDER: &str = "examples/gallery";

/// Writes `docs/gallery.md`, its pictures, and the files that it is made from.
pub(crate) fn write() -> Result<()> {
    let shapes = Shapes::made()?;
    let pictures = shapes.pictures()?.into_iter();
    let pictures = pictures.map(|(name, picture)| (picture_path(name), picture.standalone()));
    let files = designs()?.into_iter().map(|(name, bytes)| (format!("{FOLDER}/{name}"), bytes));
    let page = ("docs/gallery.md".to_owned(), shapes.page()?.into_bytes());
    let root = crate::root();
    std::fs::create_dir_all(root.join(FOLDER))?;
    let pictures = pictures.map(|(name, text)| (name, text.into_bytes()));
    for (name, bytes) in files.chain(pictures).chain([page]) {
        let path = root.join(name);
        std::fs::write(&path, bytes)?;
        println!("wrote {}", path.display());
    }
    Ok(())
}

fn picture_path(name: &str) -> String {
    format!("docs/pictures/gallery-{name}.svg")
}

/// The files that the gallery is made from.
fn designs() -> Result<Vec<(&'static str, Vec<u8>)>> {
    let template = |name: &str, setting: &str| -> Result<Vec<u8>> {
        Ok(write_design(&design_from_template(name, &[setting.to_owned()])?))
    };
    Ok(vec![
        ("multiply-connected.sheet.json", write_design(&multiply_connected(SAMPLES))),
        ("raised.sheet.json", write_design(&raised(SAMPLES))),
        ("revolution-4.sheet.json", template("revolution", "pieces=4")?),
        ("revolution-12.sheet.json", template("revolution", "pieces=12")?),
        ("hemisphere-36.sheet.json", template("hemisphere", "diameter=400mm")?),
        ("three-cones.sheet.json", write_design(&three_cones::design(SAMPLES))),
        ("half-sphere.obj", obj("half-sphere", &half_sphere(RINGS))),
    ])
}

/// A mesh as an OBJ file.
fn obj(name: &str, mesh: &Triangles) -> Vec<u8> {
    let mut text = format!("# Units: mm.\no {name}\n");
    for p in &mesh.positions {
        // Writing to a string does not fail. A micrometre is fine enough.
        let _ = writeln!(text, "v {:.3} {:.3} {:.3}", p.x + 0.0, p.y + 0.0, p.z + 0.0);
    }
    for [a, b, c] in mesh.triangles.iter().map(|t| t.map(VertexIndex::get)) {
        let _ = writeln!(text, "f {} {} {}", a + 1, b + 1, c + 1);
    }
    text.into_bytes()
}

/// The shapes, made from the designs as they are written.
struct Shapes {
    multiply_connected: Made,
    /// The multiply connected panel with its windows left closed, laid flat as a mesh.
    closed: Made,
    /// For the least mean length error, and for the least largest.
    half_spheres: [Made; 2],
    three_cones: Made,
    raised: Made,
    revolutions: [Made; 2],
    hemisphere: Made,
}

impl Shapes {
    fn made() -> Result<Self> {
        let designs = designs()?;
        let made = |name: &str, aim: Option<Aim>| -> Result<Made> {
            let found = designs.iter().find(|(other, _)| *other == name);
            let bytes = &found.ok_or("no such design")?.1;
            let is_mesh = name.ends_with("obj");
            let format =
                if is_mesh { InputFormat::Mesh(MeshFormat::Obj) } else { InputFormat::Design };
            let mesh = MeshSettings { aim, ..MeshSettings::default() };
            let options = ReadOptions { mesh, ..ReadOptions::default() };
            let design = read_bytes(format, bytes, name, None, &options)?;
            Ok(make(&design, &mut Unwatched)?)
        };
        let design = |name: &str| made(name, None);
        let mesh = |name: &str, aim: Aim| made(name, Some(aim));
        let multiply_connected = design("multiply-connected.sheet.json")?;
        Ok(Self {
            closed: left_closed(&surface_of(&multiply_connected.parts[0])?)?,
            multiply_connected,
            half_spheres: [mesh("half-sphere.obj", Aim::Mean)?, mesh("half-sphere.obj", Aim::Max)?],
            three_cones: design("three-cones.sheet.json")?,
            raised: design("raised.sheet.json")?,
            revolutions: [design("revolution-4.sheet.json")?, design("revolution-12.sheet.json")?],
            hemisphere: design("hemisphere-36.sheet.json")?,
        })
    }

    fn pictures(&self) -> Result<Vec<(&'static str, Picture)>> {
        let [four, twelve] = &self.revolutions;
        let [mean, largest] = &self.half_spheres;
        let laid_flat = |title: &str, made: &Made| stacked(title, &[space(made), flat(made)]);
        let gauss = gauss_picture(&mean.parts[0], None).ok_or("no Gauss image")?;
        let quads_of = |made: &Made| -> Result<Picture> {
            let part = &made.parts[0];
            let found = part.found().ok_or("a mesh has no rulings")?;
            Ok(quads_picture(part, &PanelQuads::new(found).planar.mesh))
        };
        Ok(vec![
            (
                "multiply-connected",
                side_by_side(
                    "A hood with two windows",
                    &[
                        stacked(
                            "Cut open, exact",
                            &[space(&self.multiply_connected), flat(&self.multiply_connected)],
                        ),
                        laid_flat("Left closed", &self.closed),
                    ],
                ),
            ),
            (
                "half-sphere",
                side_by_side(
                    "Half a sphere",
                    &[
                        stacked("Least mean", &[laid_flat("Laid flat", mean), gauss]),
                        laid_flat("Least largest", largest),
                    ],
                ),
            ),
            ("three-cones", three("Three cones", &self.three_cones)?),
            ("raised", {
                let pictures = [three("A raised surface", &self.raised)?, quads_of(&self.raised)?];
                stacked("A raised surface, and its planar quads", &pictures)
            }),
            (
                "revolution",
                side_by_side(
                    "A vase in 4 pieces and in 12",
                    &[
                        stacked("4 pieces", &[design_picture(four), flat(four)]),
                        stacked("12 pieces", &[design_picture(twelve), flat(twelve)]),
                    ],
                ),
            ),
            ("hemisphere", {
                let pieces = &self.hemisphere.parts;
                let bands = [0, pieces.len() / 2, pieces.len() - 1];
                let flat: Vec<Picture> =
                    bands.iter().map(|&n| flat_picture(&pieces[n], None)).collect();
                let title = "A hemisphere in 36 pieces";
                side_by_side(title, &[design_picture(&self.hemisphere), stacked("Flat", &flat)])
            }),
            ("quads", {
                let cones = &self.three_cones;
                side_by_side("Triangles to quads", &[space(cones), quads_of(cones)?])
            }),
        ])
    }

    fn page(&self) -> Result<String> {
        let mut table = String::new();
        for (name, made) in [
            ("multiply connected", &self.multiply_connected),
            ("three cones", &self.three_cones),
            ("raised", &self.raised),
            ("revolution in 4", &self.revolutions[0]),
            ("revolution in 12", &self.revolutions[1]),
            ("hemisphere in 36", &self.hemisphere),
        ] {
            let panels = &made.parts;
            let triangles: usize = panels.iter().map(|p| p.sheet.mesh().triangles().len()).sum();
            let most = |of: fn(&Part) -> f64| panels.iter().map(of).fold(0.0, f64::max);
            writeln!(
                table,
                "| {name} | {} | {} | {:.1}° | {} | {} | {} |",
                panels.len(),
                thousands(triangles),
                most(|p| to_deg(p.measures.warp_max)),
                small(most(|p| p.measures.gauss_area_sr)),
                small(most(|p| p.measures.length_error_mean)),
                small(most(|p| p.measures.length_error_max)),
            )?;
        }
        for (name, made) in [
            ("multiply connected, left closed", &self.closed),
            ("half sphere, least mean error", &self.half_spheres[0]),
            ("half sphere, least largest error", &self.half_spheres[1]),
        ] {
            let panel = &made.parts[0];
            writeln!(
                table,
                "| {name} | 1 | {} | | {} | {} | {} |",
                thousands(panel.sheet.mesh().triangles().len()),
                small(panel.measures.gauss_area_sr),
                small(panel.measures.length_error_mean),
                small(panel.measures.length_error_max),
            )?;
        }
        Ok(TEXT.replace("{TABLE}", table.trim_end()))
    }
}

/// A surface with windows, of cloth, which gives way so far that nothing need be cut open.
fn left_closed(surface: &Sheet) -> Result<Made> {
    let mut design = as_mesh_design("windows left closed", surface, Aim::Max);
    design.material = material_named("canvas", &[]);
    let made = make(&design, &mut Unwatched)?;
    if made.parts.iter().any(|part| !part.sheet.seams().is_empty()) {
        return Err("the windows were to stay closed".into());
    }
    Ok(made)
}

/// The surface of a part, not cut open.
fn surface_of(part: &Part) -> Result<Sheet> {
    Ok(Sheet::whole(&part.found().ok_or("a mesh is given")?.surface))
}

/// A surface as a mesh from elsewhere would come.
fn as_mesh_design(name: &str, surface: &Sheet, aim: Aim) -> Design {
    let triangles = Triangles {
        positions: surface.mesh().positions().to_vec(),
        triangles: surface.mesh().triangles().to_vec(),
        left_out: 0,
    };
    let mesh = PanelMesh { aim, ..PanelMesh::new(triangles) };
    let panel = DesignPanel::new(name, PanelShape::Mesh(mesh), 0);
    Design { name: name.to_owned(), panels: vec![panel], ..Design::default() }
}

fn space(made: &Made) -> Picture {
    space_picture(&made.parts[0], made.material.as_ref())
}

fn flat(made: &Made) -> Picture {
    flat_picture(&made.parts[0], made.material.as_ref())
}

/// The three views of a shape in the paper: in space, flat, and its length errors.
fn three(title: &str, made: &Made) -> Result<Picture> {
    let errors = as_mesh_design(title, &made.parts[0].sheet, Aim::Mean);
    let errors = make(&errors, &mut Unwatched)?;
    let errors = flat_picture(&errors.parts[0], made.material.as_ref());
    let mut in_space = vec![space(made)];
    in_space.extend(gauss_picture(&made.parts[0], made.material.as_ref()));
    Ok(side_by_side(title, &[stacked("In space", &in_space), flat(made), errors]))
}

/// A number with two digits, and its power of ten where it is small; rounding is 0.
fn small(x: f64) -> String {
    match x {
        _ if x < 1e-9 => "0".to_owned(),
        _ if x < 1e-2 => format!("{x:.1e}"),
        _ => format!("{x:.3}"),
    }
}

fn thousands(count: usize) -> String {
    if count < 1000 { count.to_string() } else { format!("{},{:03}", count / 1000, count % 1000) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_page_and_the_designs_are_those_of_the_code() {
        let root = crate::root();
        for (name, bytes) in designs().unwrap() {
            let kept = std::fs::read(root.join(FOLDER).join(name)).unwrap_or_default();
            assert!(kept == bytes, "{name} differs from the code: run cargo xtask gallery");
        }
        let shapes = Shapes::made().unwrap();
        let kept = std::fs::read(root.join("docs/gallery.md")).unwrap_or_default();
        let page = shapes.page().unwrap();
        assert!(kept == page.as_bytes(), "docs/gallery.md differs: run cargo xtask gallery");
        for (name, _) in shapes.pictures().unwrap() {
            let path = root.join(picture_path(name));
            assert!(path.exists(), "{}: run cargo xtask gallery", path.display());
        }
    }
}
