//! The size of a design: another one where the call says so, and the unit of a mesh whose file
//! names none.

use crate::args::SourceArgs;
use crate::failure::Failure;
use crate::voice::Voice;
use sheetwright::design::Design;
use sheetwright_files::{InputFormat, MeshFormat, Units};

/// The design in the size that the call gives. A mesh in a file that names no unit (`said`) is in
/// the one that it is meant in, and a note says so; where the call gives a size, none is needed.
pub(crate) fn sized(
    design: Design,
    format: InputFormat,
    said: Option<Units>,
    args: &SourceArgs,
    voice: Voice,
) -> Result<Design, Failure> {
    let is_unsure = matches!(format, InputFormat::Mesh(_)) && args.units.is_none();
    if let Some(size) = args.size {
        let extent = design.extent_mm();
        if extent == 0.0 {
            let hint = "Leave --size out, or give a design with points in different places.";
            return Err(Failure::new("the design has no size that --size could change", hint));
        }
        let factor = size / extent;
        voice.note(&format!("note: all lengths are {} times those of the file", short(factor)));
        return Ok(design.scaled(factor));
    }
    let design = match said {
        Some(units) if is_unsure => {
            let unit = match units {
                Units::Millimetres => return Ok(rescaled(design, args)),
                Units::Centimetres => "centimetres",
                Units::Metres => "metres",
                Units::Inches => "inches",
                Units::Feet => "feet",
            };
            voice.note(&format!("note: this file is read in {unit}, as a comment in it says"));
            design
        }
        None if is_unsure => meant(design, format, voice),
        _ => design,
    };
    Ok(rescaled(design, args))
}

fn rescaled(design: Design, args: &SourceArgs) -> Design {
    match args.scale {
        Some(factor) => design.scaled(factor),
        None => design,
    }
}

/// A mesh that was read in millimetres, in the unit that it is meant in.
fn meant(design: Design, format: InputFormat, voice: Voice) -> Design {
    let extent = design.extent_mm();
    let is_glb = format == InputFormat::Mesh(MeshFormat::Glb);
    match (Units::meant(extent), is_glb) {
        (Units::Metres, true) => voice.note(
            "note: this file is read in metres, as the standard of glTF says; --units mm reads it \
             in millimetres",
        ),
        (Units::Metres, false) => voice.note(&format!(
            "note: the file names no unit, and {} mm would be small for a sheet: it is read in \
             metres; --units mm reads it in millimetres, --size 300mm makes it as large",
            short(extent)
        )),
        (_, true) => voice.note(
            "note: the standard of glTF says metres, and this file is read in millimetres; \
             --units m reads it in metres",
        ),
        _ => {}
    }
    match Units::meant(extent) {
        Units::Millimetres => design,
        units => design.scaled(units.in_mm()),
    }
}

/// A number with four significant digits, without zeros behind them.
fn short(number: f64) -> String {
    let decimals = [1000.0, 100.0, 10.0, 1.0, 0.1, 0.01, 0.001].iter().position(|&n| number >= n);
    let text = format!("{number:.*}", decimals.unwrap_or(9));
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

#[cfg(test)]
mod tests {
    use super::short;

    #[test]
    fn numbers_show_four_digits() {
        let shown = [12345.6, 300.0, 12.5, 1.23456, 0.5, 0.00123456].map(short);
        assert_eq!(shown, ["12346", "300", "12.5", "1.235", "0.5", "0.001235"]);
    }
}
