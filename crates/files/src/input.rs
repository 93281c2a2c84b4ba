//! Inputs of every format, from a file or from bytes: designs, curve tables, drawings and meshes.

use crate::hull_table::is_hull_table;
use crate::linework::{self, DrawingFormat};
use crate::meant::material_meant;
use crate::mesh::MeshFormat;
use crate::names::shown;
use crate::reading::{
    EFFORTS, InputError, ReadOptions, TAKEN, TOLERANCES, VarySettings, display_name, is_tolerance,
    read_whole, refuse_folder, refuse_large, text_of, without_utf16,
};
use crate::units::Units;
use crate::{design_json, hull_table, mesh, table, table_design};
use sheetwright::boundary::MAX_SAMPLES;
use sheetwright::cost::MAX_FOLD;
use sheetwright::design::{Design, Dimensions, LEAST_EFFORT, MOST_EFFORT};
use sheetwright::material::Material;
use std::path::Path;

/// The format of an input.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InputFormat {
    /// A design, `*.sheet.json` or `*.json`.
    Design,
    /// A curve table or a table of offsets, `*.csv`, `*.tsv` or `*.txt`; its words tell which.
    Table,
    /// A table of offsets in a workbook, `*.xlsx` or `*.ods`.
    Workbook,
    /// A mesh, `*.obj`, `*.stl`, `*.ply` or `*.glb`.
    Mesh(MeshFormat),
    /// A drawing, `*.svg` or `*.dxf`, or an OBJ file with lines in place of faces.
    Drawing(DrawingFormat),
}

impl InputFormat {
    /// The format of a file, by the ending of its name.
    ///
    /// # Errors
    /// An ending of no known format.
    pub fn of(path: &Path) -> Result<Self, InputError> {
        let name = path.display().to_string();
        let ending = path.extension().and_then(|e| e.to_str()).unwrap_or("").to_lowercase();
        match ending.as_str() {
            "csv" | "tsv" | "txt" => Ok(Self::Table),
            "xlsx" | "ods" => Ok(Self::Workbook),
            "json" => Ok(Self::Design),
            "svg" => Ok(Self::Drawing(DrawingFormat::Svg)),
            "dxf" => Ok(Self::Drawing(DrawingFormat::Dxf)),
            "" => Err(InputError::at(name, "the name has no ending that tells the format", TAKEN)),
            other if let Some(format) = MeshFormat::of_ending(other) => Ok(Self::Mesh(format)),
            other if let Some((message, hint)) = linework::way_round(other) => {
                Err(InputError::at(name, message, hint))
            }
            _ => {
                let message = format!("the ending {} is not known", shown(&format!(".{ending}")));
                Err(InputError::at(name, message, TAKEN))
            }
        }
    }
}

impl InputFormat {
    /// The format of an input, detected from its first bytes; `None` if they match no format.
    pub fn of_bytes(bytes: &[u8]) -> Option<Self> {
        if bytes.starts_with(b"glTF") {
            return Some(Self::Mesh(MeshFormat::Glb));
        }
        if bytes.starts_with(b"ply\n") || bytes.starts_with(b"ply\r") {
            return Some(Self::Mesh(MeshFormat::Ply));
        }
        if is_binary_stl(bytes) {
            return Some(Self::Mesh(MeshFormat::Stl));
        }
        if bytes.starts_with(b"PK\x03\x04") {
            return Some(Self::Workbook);
        }
        let bytes = without_utf16(&bytes[..bytes.len().min(SHOWS)]);
        let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(&bytes);
        let text = String::from_utf8_lossy(bytes).to_lowercase();
        let mut lines = text.lines().map(str::trim).filter(|line| !line.is_empty());
        let first = lines.clone().next()?;
        if first.starts_with('{') {
            return Some(Self::Design);
        }
        if first == "ply" {
            return Some(Self::Mesh(MeshFormat::Ply));
        }
        if first == "solid" || first.starts_with("solid ") {
            return Some(Self::Mesh(MeshFormat::Stl));
        }
        if let Some(drawing) = linework::format_of(&text) {
            return Some(Self::Drawing(drawing));
        }
        let columns: Vec<&str> =
            first.split([',', ';', '\t']).map(|c| c.trim_matches([' ', '"'])).collect();
        if ["x", "y", "z"].iter().all(|column| columns.contains(column)) {
            return Some(Self::Table);
        }
        // Groups of a mesh may have the names of lines, such as `o keel`.
        let is_point = |line: &str| line.starts_with("v ") || line.starts_with("v\t");
        if lines.any(is_point) {
            return Some(Self::Mesh(MeshFormat::Obj));
        }
        is_hull_table(&text).then_some(Self::Table)
    }

    /// The format that the content shows where the name leaves it open: OBJ files may have lines in
    /// place of faces.
    fn by_content(self, bytes: &[u8]) -> Self {
        match self {
            Self::Mesh(MeshFormat::Obj) if linework::is_lines(bytes) => {
                Self::Drawing(DrawingFormat::Obj)
            }
            other => other,
        }
    }
}

/// The bytes at the beginning of an input that format detection reads; some programs begin files
/// with long comments.
const SHOWS: usize = 1 << 16;

/// Whether the length of the input is the one that the header of a binary STL states.
fn is_binary_stl(bytes: &[u8]) -> bool {
    const HEADER: usize = 80;
    const TRIANGLE: usize = 50;
    let count = bytes.get(HEADER..HEADER + 4).and_then(|count| count.try_into().ok());
    count.map(u32::from_le_bytes).is_some_and(|count| {
        let rest = bytes.len() - HEADER - 4;
        count > 0 && rest as u64 == u64::from(count) * TRIANGLE as u64
    })
}

/// The design in a file: curves, or a mesh with one panel per group.
///
/// # Errors
/// A file that can't be read, or that is no design, curve table, drawing or mesh that this version
/// reads.
pub fn read_input(path: &Path, options: &ReadOptions) -> Result<Design, InputError> {
    // Checked before the ending, since a folder may have any ending.
    refuse_folder(path)?;
    let format = InputFormat::of(path)?;
    let bytes = read_whole(path)?;
    // A bare file name lies in the folder that the program runs in.
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    read_bytes(format, &bytes, &path.display().to_string(), Some(folder), options)
}

/// The design in some bytes. `name` is the name of their file, or `-` for standard input: messages
/// show it, and its stem is the default name. Tables and meshes that a design refers to lie in
/// `folder`; without a folder, a design can't refer to any.
///
/// # Errors
/// Bytes that are no design, curve table, drawing or mesh that this version reads, or options out
/// of range.
pub fn read_bytes(
    format: InputFormat,
    bytes: &[u8],
    name: &str,
    folder: Option<&Path>,
    options: &ReadOptions,
) -> Result<Design, InputError> {
    refuse_large(bytes, display_name(name))?;
    let format = format.by_content(bytes);
    check_options(format, options)?;
    let mut design = match format {
        InputFormat::Mesh(format) => {
            let (design, seams) = mesh::read(format, bytes, name, options)?;
            Design { notes: linework::lines_beside(format, bytes, seams), ..design }
        }
        InputFormat::Drawing(format) => linework::read(format, bytes, name, options)?,
        InputFormat::Design => design_json::read(text_of(bytes, name)?, name, folder, options)?,
        InputFormat::Workbook => hull_table::read_as_design(bytes, name, true, options)?,
        InputFormat::Table if is_offsets(bytes, name)? => {
            hull_table::read_as_design(bytes, name, false, options)?
        }
        InputFormat::Table if options.second_table.is_some() => {
            return Err(InputError::at(display_name(name), NO_SECOND, NO_SECOND_HINT));
        }
        InputFormat::Table => table_design::read_as_design(text_of(bytes, name)?, name, options)?,
    };
    settle(&mut design, format, options)?;
    Ok(design)
}

/// Sets what the caller asks for in place of what the design says, or a format can't say.
///
/// # Errors
/// An unknown material or trade, or a setting that does not go with the design.
pub(crate) fn settle(
    design: &mut Design,
    format: InputFormat,
    options: &ReadOptions,
) -> Result<(), InputError> {
    if let Some(material) = material_asked_for(options, &design.materials)? {
        design.material = Some(material);
    }
    options.bends.set(design);
    options.sheets.set(design)?;
    design.dimensions = options.dimensions.or(design.dimensions);
    design.thickness_mm = options.thickness_mm.or(design.thickness_mm);
    design.bend_radius_mm = options.bend_radius_mm.or(design.bend_radius_mm);
    if format != InputFormat::Design {
        let (trade, thickness_mm) = (options.trade.as_deref(), design.sheet_thickness_mm());
        let read = design_json::trims_of(trade, Vec::new(), Units::Millimetres, thickness_mm);
        let refused = |(_, message, hint)| InputError { message, place: None, hint };
        design.trims = read.map_err(refused)?;
        design.trims.extend(options.allowance());
        design.trade.clone_from(&options.trade);
    }
    if let (Some(dimensions), None) = (design.dimensions, design.sheet_thickness_mm()) {
        return Err(InputError {
            message: format!(
                "the dimensions are those of the {} of a sheet of which no thickness is known",
                match dimensions {
                    Dimensions::Inside => "inside",
                    Dimensions::Mean => "middle",
                    Dimensions::Outside => "outside",
                }
            ),
            place: None,
            hint: "Name a material, or give a thickness.".to_owned(),
        });
    }
    Ok(())
}

/// Why a second file is refused.
const NO_SECOND: &str = "a second table goes with a table of offsets only";
const NO_SECOND_HINT: &str = "Leave the second table out.";

/// Whether a table is one of offsets: by its words, and where those tell nothing, by its ending.
fn is_offsets(bytes: &[u8], name: &str) -> Result<bool, InputError> {
    let text = text_of(bytes, name)?;
    let lower = name.to_lowercase();
    let is_csv = !(lower.ends_with(".tsv") || lower.ends_with(".txt"));
    Ok(is_hull_table(text) || !is_csv && !table::is_curve_table(text))
}

/// The material that the caller sets, from the design's `own` materials or the catalogue.
fn material_asked_for(
    options: &ReadOptions,
    own: &[Material],
) -> Result<Option<Material>, InputError> {
    let wanted = options.material.as_deref();
    let found = wanted.map(|wanted| material_meant(wanted, own)).transpose();
    found.map_err(|(message, hint)| InputError { message, place: None, hint })
}

/// Refuses settings out of range, and those that do not go with a format.
pub(crate) fn check_options(format: InputFormat, options: &ReadOptions) -> Result<(), InputError> {
    let refused = |message: String, hint: &str| {
        Err(InputError { message, place: None, hint: hint.to_owned() })
    };
    if let Some(samples) = options.samples
        && samples > MAX_SAMPLES
    {
        return refused(
            format!("the number of samples is {samples}; the limit is {MAX_SAMPLES}"),
            "Use fewer samples; a few hundred are enough for most panels.",
        );
    }
    if let Some(mm) = options.tolerance_mm
        && !is_tolerance(mm)
    {
        return refused(format!("the tolerance of the samples is {mm} mm"), TOLERANCES);
    }
    if let Some(fold) = options.fold
        && !(0.0..=MAX_FOLD).contains(&fold)
    {
        return refused(
            format!("the fold price is {fold}"),
            "Set a fold price from 0 (twist alone) to 10.",
        );
    }
    if let Some(effort) = options.effort
        && !(LEAST_EFFORT..=MOST_EFFORT).contains(&effort)
    {
        return refused(format!("the effort is {effort}"), EFFORTS);
    }
    if !options.rails.is_empty() && !matches!(format, InputFormat::Drawing(_)) {
        return refused(
            "rails can't be chosen by name but in a drawing".to_owned(),
            "A design names the rails of its panels itself.",
        );
    }
    let may_be_offsets = matches!(format, InputFormat::Table | InputFormat::Workbook);
    if options.second_table.is_some() && !may_be_offsets {
        return refused(NO_SECOND.to_owned(), NO_SECOND_HINT);
    }
    if let InputFormat::Mesh(_) = format {
        let ReadOptions {
            samples,
            tolerance_mm,
            fold,
            effort,
            method,
            plane,
            slides,
            vary,
            sheets,
            ..
        } = options;
        let given = [
            ("samples", samples.is_some()),
            ("a tolerance of samples", tolerance_mm.is_some()),
            ("a fold price", fold.is_some()),
            ("an effort", effort.is_some() && sheets.sheets.is_empty()),
            ("a method", method.is_some()),
            ("a plane", plane.is_some()),
            ("a slide of edges", slides.is_some()),
            ("moving", *vary != VarySettings::default()),
        ];
        if let Some((what, _)) = given.into_iter().find(|(_, given)| *given) {
            return refused(
                format!("{what} can't be set for a mesh, which is flattened as it is"),
                "Leave the setting out, or give boundary curves instead.",
            );
        }
    }
    if format == InputFormat::Design && options.units.is_some() {
        return refused(
            "units can't be set for a design, which states its own".to_owned(),
            "Change the design's field `units` instead.",
        );
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use sheetwright::curve::Curve;

    #[test]
    fn the_ending_tells_the_format() {
        assert_eq!(InputFormat::of(Path::new("a/b.sheet.json")), Ok(InputFormat::Design));
        assert_eq!(InputFormat::of(Path::new("B.CSV")), Ok(InputFormat::Table));
        let svg = InputFormat::of(Path::new("lid.SVG"));
        assert_eq!(svg, Ok(InputFormat::Drawing(DrawingFormat::Svg)));
        assert!(InputFormat::of(Path::new("a.step")).unwrap_err().hint.contains("DXF"));
        let mesh = InputFormat::of(Path::new("hull.STL"));
        assert_eq!(mesh, Ok(InputFormat::Mesh(MeshFormat::Stl)));
        assert!(InputFormat::of(Path::new("a.doc")).unwrap_err().hint.contains(".csv"));
    }

    #[test]
    fn the_content_tells_the_format() {
        let mesh = |format| Some(InputFormat::Mesh(format));
        let mut stl = vec![b's'; 80];
        stl.extend(1u32.to_le_bytes());
        stl.extend([0; 50]);
        for (bytes, format) in [
            (&b" \n{ \"sheetwright\": 1 }"[..], Some(InputFormat::Design)),
            (b"\xef\xbb\xbf{}", Some(InputFormat::Design)),
            (b"\nCurve; X; Y; Z\n", Some(InputFormat::Table)),
            (b"x\ty\tz", Some(InputFormat::Table)),
            (b"solid part\n facet", mesh(MeshFormat::Stl)),
            (&stl, mesh(MeshFormat::Stl)),
            (b"ply\nformat ascii 1.0", mesh(MeshFormat::Ply)),
            (b"\xff\xfep\0l\0y\0\n\0", mesh(MeshFormat::Ply)),
            (b"\xfe\xff\0v\0 \x001\0 \x002\0 \x003", mesh(MeshFormat::Obj)),
            (b"glTF\x02\0\0\0", mesh(MeshFormat::Glb)),
            (b"# made by\nmtllib a.mtl\no box\nv 0 0 0\n", mesh(MeshFormat::Obj)),
            (b"o keel\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", mesh(MeshFormat::Obj)),
            (b"Station,0,1\nKeel,0,0\n", Some(InputFormat::Table)),
            (
                b"<?xml version=\"1.0\"?>\n<!-- by hand -->\n<svg>",
                Some(InputFormat::Drawing(DrawingFormat::Svg)),
            ),
            (b"  0\r\nSECTION\r\n", Some(InputFormat::Drawing(DrawingFormat::Dxf))),
            (b"999\nby hand\n0\nSECTION\n", Some(InputFormat::Drawing(DrawingFormat::Dxf))),
            (b"1,2,3\n4,5,6\n", None),
            (b"", None),
            (b"\0\x01\x02", None),
        ] {
            assert_eq!(
                InputFormat::of_bytes(bytes),
                format,
                "{:?}",
                String::from_utf8_lossy(bytes)
            );
        }
    }

    fn example(name: &str) -> Design {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples").join(name);
        read_input(&path, &ReadOptions::default()).unwrap()
    }

    #[test]
    fn the_examples_read() {
        let hull = example("ubc-fishing-vessel.sheet.json");
        let names: Vec<&str> = hull.panels.iter().map(|p| p.name.as_str()).collect();
        assert_eq!(names, ["topside", "chine-strake", "bottom"]);
        assert_eq!(hull.material.map(|m| m.name).as_deref(), Some("steel-5mm"));
        assert!(hull.curves.iter().all(|c| c.points.len() == 13 && !c.closed));
        assert_eq!(hull.curves[0].points[0].at.x, 70.0 * 304.8);
        let leaf = example("leaf.csv");
        assert_eq!((leaf.panels.len(), leaf.curves[0].points.len()), (1, 64));
    }

    #[test]
    fn the_circle_of_the_duct_is_round() {
        let duct = example("square-to-round.sheet.json");
        let circle = duct.curves.iter().find(|c| c.name == "circle").unwrap();
        let curve = Curve::new(circle.kind.unwrap(), &circle.points, circle.closed).unwrap();
        let spans = curve.spans().len();
        for step in 0..=spans * 20 {
            let p = curve.position(step as f64 / 20.0);
            let off = (p.x * p.x + p.y * p.y).sqrt() - 150.0;
            assert!(off.abs() < 0.01 && p.z == 350.0, "{step}: {off}");
        }
    }
}
