//! The pictures of the README and the docs, made from the examples.

use sheetwright::design::{Design, DesignPanel, PanelMesh, PanelShape, Triangles};
use sheetwright::make::{Made, make};
use sheetwright::watch::Unwatched;
use sheetwright_files::{
    InputFormat, Picture, ReadOptions, VarySettings, design_picture, flat_picture, gauss_picture,
    moved_picture, read_bytes, read_input, side_by_side, space_picture, stacked, warp_chart,
};
use sheetwright_shapes::low_poly;
use std::error::Error;

/// Samples of each rail: enough for a smooth picture, few enough for a small file.
const SAMPLES: usize = 120;
/// Samples of each rail where it is moved: as many as the docs speak of.
const SAMPLES_MOVED: usize = 200;

/// Makes a picture.
type Draw = fn() -> Result<Picture, Box<dyn Error>>;

/// Writes every picture, or those with a word in their names that is given.
pub(crate) fn write() -> Result<(), Box<dyn Error>> {
    let word = std::env::args().nth(2).unwrap_or_default();
    let pictures: [(&str, Draw); 7] = [
        ("hull.svg", hull),
        ("hull-moved.svg", hull_moved),
        ("three-cones.svg", three_cones),
        ("vary.svg", vary),
        ("meshes.svg", meshes),
        ("nets.svg", nets),
        ("slots.svg", slots),
    ];
    for (name, draw) in pictures.into_iter().filter(|(name, _)| name.contains(&word)) {
        let path = crate::root().join("docs/pictures").join(name);
        std::fs::write(&path, draw()?.standalone())?;
        println!("wrote {}", path.display());
    }
    Ok(())
}

fn hull_with(samples: usize, vary: VarySettings) -> Result<Made, Box<dyn Error>> {
    let example = crate::root().join("examples/ubc-fishing-vessel.sheet.json");
    let options = ReadOptions { samples: Some(samples), vary, ..ReadOptions::default() };
    Ok(make(&read_input(&example, &options)?, &mut Unwatched)?)
}

/// The last plank of the hull moved until it bends: both boundaries, and its warp before and after.
fn hull_moved() -> Result<Picture, Box<dyn Error>> {
    let asked =
        VarySettings { warp_deg: Some(5.6), limit_mm: Some(15.0), ..VarySettings::default() };
    let made = hull_with(SAMPLES_MOVED, asked)?;
    let bottom = made.parts.last().ok_or("the hull has no planks")?;
    let before = bottom.change().map(|change| &change.before);
    let charts = before.map(|b| &**b).into_iter().chain([bottom]);
    let charts: Vec<Picture> =
        charts.filter_map(|p| warp_chart(p, made.material.as_ref())).collect();
    let mut pictures: Vec<Picture> = moved_picture(bottom).into_iter().collect();
    pictures.push(side_by_side("Warp before, and after", &charts));
    Ok(stacked("The boundary of a plank, moved until it bends", &pictures))
}

fn hull() -> Result<Picture, Box<dyn Error>> {
    let made = hull_with(SAMPLES, VarySettings::default())?;
    let flat: Vec<Picture> =
        made.parts.iter().map(|panel| flat_picture(panel, made.material.as_ref())).collect();
    let title = "The planks of a hull in space, and laid flat";
    Ok(side_by_side(title, &[design_picture(&made), stacked("The flat planks", &flat)]))
}

/// The best triangulation and the best bridge of the three cones, with their Gauss images.
fn three_cones() -> Result<Picture, Box<dyn Error>> {
    let [best, bridge] = crate::composites::drawn()?;
    let column = |made: &Made, title: &str| {
        let panel = &made.parts[0];
        let mut pictures = vec![space_picture(panel, made.material.as_ref())];
        pictures.extend(gauss_picture(panel, made.material.as_ref()));
        stacked(title, &pictures)
    };
    let columns = [
        column(&best, "The best of all triangulations, with its Gauss image"),
        column(&bridge, "The best bridge triangulation, with its Gauss image"),
    ];
    Ok(side_by_side("Three cones joined to one sheet", &columns))
}

/// The examples whose curves move, after they have moved.
fn vary() -> Result<Picture, Box<dyn Error>> {
    let pictures: Vec<Picture> = crate::vary::drawn()?.iter().map(design_picture).collect();
    Ok(side_by_side("A mouse, a hat and a flower, with their curves moved", &pictures))
}

/// A cap of a sphere, which must stretch to lie flat, and a closed cube, which is cut open.
fn meshes() -> Result<Picture, Box<dyn Error>> {
    let mut rows = Vec::new();
    for (file, title) in [("mesh-cap.ply", "A cap of a sphere"), ("mesh-cube.obj", "A closed cube")]
    {
        let path = crate::root().join("corpus/good").join(file);
        let made = make(&read_input(&path, &ReadOptions::default())?, &mut Unwatched)?;
        let (part, material) = (&made.parts[0], made.material.as_ref());
        let pictures = [space_picture(part, material), flat_picture(part, material)];
        rows.push(side_by_side(title, &pictures));
    }
    Ok(stacked("Meshes in space, and laid flat, coloured by how much lengths differ", &rows))
}

/// Two paper models, and their nets.
fn nets() -> Result<Picture, Box<dyn Error>> {
    let models = [
        ("A bear of 588 facets", low_poly::animal(), Some([275.0, 172.0])),
        ("A helmet of 404 facets", low_poly::helmet(), None),
    ];
    let mut rows = Vec::new();
    for (title, model, pieces_within_mm) in models {
        let mesh = model.mesh();
        let (positions, triangles) = (mesh.positions().to_vec(), mesh.triangles().to_vec());
        let given = Triangles { positions, triangles, left_out: 0 };
        let facets = Some(true);
        let shape = PanelMesh { facets, pieces_within_mm, ..PanelMesh::new(given) };
        let panel = DesignPanel::new("net", PanelShape::Mesh(shape), 0);
        let made = make(&Design { panels: vec![panel], ..Design::default() }, &mut Unwatched)?;
        let mut parts: Vec<Picture> =
            made.parts.iter().map(|part| flat_picture(part, made.material.as_ref())).collect();
        parts.truncate(1);
        let mut pictures = vec![design_picture(&made)];
        pictures.append(&mut parts);
        rows.push(side_by_side(title, &pictures));
    }
    Ok(stacked("Models of facets in space, and their nets", &rows))
}

/// A shelf with tabs, and the side that it stands in, with slots for a laser and for a router.
fn slots() -> Result<Picture, Box<dyn Error>> {
    const LASER: &str = r#""kind": "slots""#;
    const ROUTER: &str = r#""kind": "slots", "clearance": 0.4, "dogbone": 3.2"#;
    let made = |slots: &str| -> Result<Made, Box<dyn Error>> {
        let design = format!(
            r#"{{
            "sheetwright": 1, "name": "shelf", "thickness": 6,
            "curves": {{
                "joint": {{ "kind": "polyline", "points": [[0, 0, 0], [160, 0, 0]] }},
                "front": {{ "kind": "polyline", "points": [[160, 0, 0], [160, 60, 0], [0, 60, 0], [0, 0, 0]] }},
                "top": {{ "kind": "polyline", "points": [[160, 0, 0], [160, 0, 60], [0, 0, 60], [0, 0, 0]] }}
            }},
            "panels": [
                {{ "name": "shelf", "boundary": ["joint", "front"], "samples": 40 }},
                {{ "name": "side", "boundary": ["joint", "top"], "samples": 40 }}
            ],
            "trims": [{{ "on": "shelf/joint", {slots} }}]
        }}"#
        );
        let (format, options) = (InputFormat::Design, ReadOptions::default());
        let design = read_bytes(format, design.as_bytes(), "shelf.sheet.json", None, &options)?;
        Ok(make(&design, &mut Unwatched)?)
    };
    let (laser, router) = (made(LASER)?, made(ROUTER)?);
    let parts = [&laser.parts[0], &laser.parts[1], &router.parts[1]];
    let pictures = parts.map(|part| flat_picture(part, None));
    let title =
        "Tabs of a shelf, slots for them, and slots with holes in their corners for a router";
    Ok(side_by_side(title, &pictures))
}
