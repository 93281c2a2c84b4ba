//! How meshes are flattened.

use clap::{Args, ValueEnum};
use sheetwright::flatten::Aim;
use sheetwright::math::from_deg;
use sheetwright::mesh::Skin;
use sheetwright_files::MeshSettings;

/// How meshes are flattened.
#[derive(Debug, Args)]
#[command(next_help_heading = "Meshes")]
pub(crate) struct MeshArgs {
    /// What flattening minimises where a mesh can't be laid flat exactly [default: mean]
    #[arg(long, value_enum, ignore_case = true, value_name = "AIM")]
    pub(crate) aim: Option<AimArg>,
    /// Divide a mesh into panels along the creases above this angle, in degrees
    #[arg(long, value_name = "DEG", value_parser = crease_deg)]
    pub(crate) split_creases: Option<f64>,
    /// Cut a mesh that would stretch too much, from its border to the points that stretch most
    #[arg(long)]
    pub(crate) darts: bool,
    /// Lay one skin flat alone of a plate that comes as a closed mesh with two
    #[arg(long, value_enum, ignore_case = true, value_name = "SKIN")]
    pub(crate) skin: Option<SkinArg>,
    /// Fold a mesh between its facets and stretch nothing, as a paper model is made; --facets=off
    /// never does. It suits flat facets: where the mesh samples a curved part, its triangles fold
    /// to slivers in many pieces, which may overlap, as the report says [default: where a coarse
    /// mesh would not bend as one surface]
    #[arg(long, value_enum, ignore_case = true, value_name = "HOW", num_args = 0..=1,
        require_equals = true, default_missing_value = "on")]
    pub(crate) facets: Option<FacetsArg>,
    /// No piece of a mesh that is folded is larger than this: the name of a paper, on one sheet of
    /// which it is printed, or a width and a height in mm, such as 280x200
    #[arg(long, value_name = "SIZE", value_parser = piece_size)]
    pub(crate) pieces_within: Option<PieceSize>,
}

/// Whether facets are folded.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum FacetsArg {
    /// They are
    On,
    /// They are not
    Off,
}

/// The largest size of a piece, mm.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PieceSize([f64; 2]);

fn piece_size(given: &str) -> Result<PieceSize, String> {
    sheetwright_files::piece_size(given).map(PieceSize)
}

impl MeshArgs {
    pub(crate) fn settings(&self) -> MeshSettings {
        MeshSettings {
            aim: self.aim.map(|aim| match aim {
                AimArg::Mean => Aim::Mean,
                AimArg::Max => Aim::Max,
                AimArg::Seams => Aim::Seams,
            }),
            split_creases: self.split_creases.map(from_deg),
            darts: self.darts,
            skin: self.skin.map(|skin| match skin {
                SkinArg::Outer => Skin::Outer,
                SkinArg::Inner => Skin::Inner,
            }),
            facets: self.facets.map(|facets| matches!(facets, FacetsArg::On)),
            pieces_within_mm: self.pieces_within.map(|PieceSize(size)| size),
        }
    }

    /// The first option for meshes that is given, as it is written.
    pub(crate) fn given(&self) -> Option<String> {
        let aim = self.aim.map(|aim| format!("--aim {}", aim.name()));
        let others = [
            ("--split-creases", self.split_creases.is_some()),
            ("--darts", self.darts),
            ("--skin", self.skin.is_some()),
            ("--facets", self.facets.is_some()),
            ("--pieces-within", self.pieces_within.is_some()),
        ];
        let other = others.iter().find(|(_, is_given)| *is_given);
        aim.or_else(|| other.map(|(name, _)| (*name).to_owned()))
    }
}

fn crease_deg(given: &str) -> Result<f64, String> {
    let deg = given.parse().ok().filter(|deg| (1.0..180.0).contains(deg));
    deg.ok_or_else(|| "give an angle from 1 to below 180 degrees".to_owned())
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum SkinArg {
    /// The larger skin, which lies outside where the plate bends one way
    Outer,
    /// The smaller skin
    Inner,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum AimArg {
    /// The mean length error
    Mean,
    /// The largest length error
    Max,
    /// The length error of the seams and the border, which stay exact
    Seams,
}

impl AimArg {
    fn name(self) -> &'static str {
        match self {
            Self::Mean => "mean",
            Self::Max => "max",
            Self::Seams => "seams",
        }
    }
}
