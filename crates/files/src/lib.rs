//! Bytes to kernel values and back: the only crate that knows file formats.
//!
//! In: [`read_input`] makes a kernel [`Design`](sheetwright::design::Design) from a design file, a
//! curve table, a drawing or a mesh, [`design_from_template`] from a template. Out:
//! [`output_files`] makes every file of a made design, in memory; the caller writes them. Each
//! format has its own module.
//!
//! ```
//! use sheetwright::{Unwatched, make};
//! use sheetwright_files::{
//!     Format, InputFormat, OutputOptions, ReadOptions, output_files, read_bytes,
//! };
//!
//! // A curve table as a spreadsheet saves it: a square of 100 mm with one corner lifted by 20 mm.
//! let table = "x,y,z,corner\n0,0,0,1\n100,0,0,1\n100,100,20,1\n0,100,0,1\n";
//! let options = ReadOptions::default();
//! let design = read_bytes(InputFormat::Table, table.as_bytes(), "leaf", None, &options)?;
//! let made = make(&design, &mut Unwatched)?;
//! let outputs = output_files(&made, &[Format::Svg, Format::Dxf], OutputOptions::default())?;
//! let names: Vec<&str> = outputs.files.iter().map(|file| &file.name[..]).collect();
//! assert_eq!(names, ["leaf.svg", "leaf.dxf"]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod archive;
mod arcs;
mod astm;
mod batch;
mod bend_rule;
mod book;
mod brake;
mod catalogue;
mod design_json;
mod drawing;
mod dxf;
mod fold;
mod format;
mod hint;
mod hull_table;
mod input;
mod json;
mod linework;
mod materials;
mod meant;
mod mesh;
mod messages;
mod names;
mod obj;
mod offsets;
mod output;
mod parts;
mod pdf;
mod piece_size;
mod preset;
mod quads;
mod quantity;
mod read_back;
mod reading;
mod refold;
mod report;
mod shapes;
mod sheets;
mod space;
mod step;
mod stock;
mod stroke_font;
mod svg;
mod table;
mod table_design;
mod template_call;
mod trade;
mod units;
mod unzip;
#[cfg(not(all(target_arch = "wasm32", target_os = "unknown")))]
pub mod whole;
mod wording;
mod words;

pub use archive::zipped;
pub use astm::write_astm;
pub use batch::{
    BatchCount, DesignLine, DesignLines, Ids, KeptRow, RowError, RowHead, TableForm, TablePanel,
    TablePanels, TableRows, holds_panels,
};
pub use bend_rule::bend_rule;
pub use brake::BrakeSettings;
pub use catalogue::{catalogue_json, catalogue_text, parameter_table, template_text};
pub use design_json::{read_drawn, trims_for, usual_trim, write_design, write_drawn};
pub use drawing::{Drawing, Mirror, Plan, Reference};
pub use dxf::{read_dxf, write_dxf, write_dxf_for, write_dxf_with};
pub use fold::write_fold;
pub use format::Format;
pub use hint::{FAULT, hint_for, hint_in_design, remedy_for};
pub use hull_table::hull_table_notes;
pub use input::{InputFormat, read_bytes, read_input};
pub use linework::DrawingFormat;
pub use materials::{catalogue_names, known_materials, material_group, material_named};
pub use mesh::{MeshFormat, units_said};
pub use messages::{PanelTimes, error_json, findings_json, timing_json};
pub use names::{refused_for_file, shown, visible};
pub use obj::write_obj;
pub use offsets::{OffsetOptions, write_offsets};
pub use output::{
    OutputError, OutputFile, OutputOptions, Outputs, formats_for, output_files, refuse_unmade,
};
pub use pdf::{MaxSheets, Paper, PdfOptions, Reduced, RollWidth, WrittenPdf, write_pdf};
pub use piece_size::{piece_size, piece_size_text};
pub use preset::{DxfRelease, Preset};
pub use quads::{PanelQuads, write_quads};
pub use quantity::{
    distance_mm, length_in, length_text, read_angle, read_length, read_lengths, read_number,
    size_mm, step_text, strain_share, warp_deg,
};
pub use read_back::{PatternReadError, ReadPattern};
pub use reading::{
    BendSettings, INPUT_ENDINGS, InputError, MAX_INPUT_BYTES, MOST_TOLERANCE_MM, MeshSettings,
    ReadOptions, SecondTable, SheetSettings, VarySettings, io_error, read_limited, stem,
};
pub use refold::{PatternFiles, RefoldFileError, refold_error_mm, refold_files_error_mm};
pub use report::{
    Picture, ReportForm, Written, design_picture, flat_picture, gauss_picture, moved_picture,
    quads_picture, report_html, report_json, report_schema, side_by_side, space_picture, stacked,
    warp_chart,
};
pub use sheets::sheets_sentence;
pub use step::write_step;
pub use stock::{sheet_title, stock_sheet, stock_text};
pub use svg::{read_svg, write_svg, write_svg_for};
pub use table::{MAX_CURVES, MAX_ROWS, TableCurve, read_table, write_table};
pub use template_call::{NewDesign, design_from_template, new_design};
pub use trade::{trade_names, trade_title};
pub use units::Units;
pub use wording::{share_beyond_words, verdict_sentence, verdict_word};
pub use words::{finding_place, finding_text, read_note_text};
