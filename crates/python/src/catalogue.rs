//! What there is to choose from: materials, templates, trades, formats, presets.

use crate::failure::Failure;
use pyo3::prelude::*;
use sheetwright::material::Sourced;
use sheetwright_files::{
    Format, Preset, catalogue_json, design_from_template, known_materials, new_design, trade_names,
    trade_title, trims_for, write_design,
};

/// A material of the catalogue.
#[pyclass(frozen, get_all, module = "pysheetwright")]
pub(crate) struct Material {
    /// How designs and calls name it.
    name: String,
    /// The name for people.
    title: String,
    /// How thick it is, mm.
    thickness_mm: f64,
    /// The smallest bend radius, mm.
    bend_radius_mm: f64,
    /// The largest warp angle that it takes, degrees.
    warp_limit_deg: f64,
    /// The largest strain within its plane, as a share.
    stretch_limit: f64,
    /// Young's modulus, N/mm²; None where it is unknown.
    modulus_n_per_mm2: Option<f64>,
    /// Mass per volume, kg/m³; None where it is unknown.
    density_kg_per_m3: Option<f64>,
}

#[pymethods]
impl Material {
    fn __repr__(&self) -> String {
        format!("<Material {}: {}>", self.name, self.title)
    }
}

/// The materials of the catalogue.
#[pyfunction]
pub(crate) fn materials() -> Vec<Material> {
    let value = |number: &Option<Sourced>| number.as_ref().map(|number| number.value);
    let materials = known_materials(&[]).into_iter().map(|material| Material {
        name: material.name.clone(),
        title: material.title.clone(),
        thickness_mm: material.thickness_mm.value,
        bend_radius_mm: material.bend_radius_mm.value,
        warp_limit_deg: material.warp_limit_deg.value,
        stretch_limit: material.stretch_limit.value,
        modulus_n_per_mm2: value(&material.modulus_n_per_mm2),
        density_kg_per_m3: value(&material.density_kg_per_m3),
    });
    materials.collect()
}

/// The catalogue of templates, as JSON text.
#[pyfunction]
pub(crate) fn templates() -> String {
    catalogue_json(None)
}

/// The design of a template as JSON text; settings are texts `NAME=VALUE`. A trade adds what it
/// does along edges.
#[pyfunction]
pub(crate) fn template(
    name: &str,
    settings: Vec<String>,
    trade: Option<&str>,
    folder: Option<std::path::PathBuf>,
) -> PyResult<String> {
    if let Some(trade) = trade
        && !trade_names().contains(&trade)
    {
        Err(Failure::of_choice("trade", trade, &trade_names()))?;
    }
    let bytes = match folder {
        Some(folder) => {
            let mut new = new_design(name, &settings, &folder).map_err(Failure::from)?;
            if let Some(trade) = trade {
                new.make_for(trade);
            }
            new.bytes()
        }
        None => {
            let mut design = design_from_template(name, &settings).map_err(Failure::from)?;
            let thickness_mm = design.sheet_thickness_mm();
            if let Some(trims) =
                trade.and_then(|trade| trims_for(&design, Some(trade), [thickness_mm; 2]))
            {
                (design.trims, design.trade) = (trims, trade.map(str::to_owned));
            }
            write_design(&design)
        }
    };
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

/// The trades, each with what it is for.
#[pyfunction]
pub(crate) fn trades() -> Vec<(&'static str, &'static str)> {
    trade_names().into_iter().map(|name| (name, trade_title(name).unwrap_or_default())).collect()
}

/// The formats of files, each with what it is for.
#[pyfunction]
pub(crate) fn formats() -> Vec<(&'static str, &'static str)> {
    Format::ALL.into_iter().map(|format| (format.name(), format.about().1)).collect()
}

/// The presets of machines, each with what it is for.
#[pyfunction]
pub(crate) fn presets() -> Vec<(&'static str, &'static str)> {
    Preset::all().iter().map(|preset| (preset.name, preset.about)).collect()
}
