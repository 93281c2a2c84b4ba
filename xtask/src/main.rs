//! Chores of the project: `cargo xtask` lists them.
#![allow(clippy::print_stdout, clippy::print_stderr)] // a program for the terminal

mod bending;
mod compare;
mod composites;
mod figures;
mod fold_price;
mod gallery;
mod measured;
mod outputs;
mod panels;
mod peers;
mod quads;
mod release;
mod templates;
mod tools;
mod trades;
mod vary;
mod web;

use std::process::ExitCode;

const HELP: &str = "Chores of the project:
  cargo xtask bend-peers   what bench/peers/bend calls: DIR for panels that CalculiX computes
  cargo xtask bending      writes docs/bending-measured.md: verdicts beside finer nets and more samples
  cargo xtask compare      compares two folders that outputs wrote: BEFORE AFTER
  cargo xtask composites   writes docs/composites.md and examples/three-cones.sheet.json
  cargo xtask figures      writes docs/pictures/: the hull, the three cones, moved curves, meshes, nets;
                           with a word, those with it in their names
  cargo xtask fold-price   writes docs/fold-price.md: what the fold price costs and what it buys
  cargo xtask gallery      writes docs/gallery.md, its pictures and examples/gallery/
  cargo xtask measured     writes docs/measured.md: gores against the sphere, a duct against tradition
  cargo xtask outputs      makes all there is with a command: --with COMMAND --out DIR
  cargo xtask panels       writes a curve table of random panels for measuring batches: COUNT SAMPLES FILE
  cargo xtask peers        what bench/peers/run calls; writes bench/peers/README.md: our speed beside CGAL's
  cargo xtask quads        writes docs/quads.md: planar quads and smooth strips, measured
  cargo xtask release      makes what people install without Rust: --out DIR [--tested-editor]
  cargo xtask templates    writes docs/templates.md and its pictures, from the catalogue
  cargo xtask trades       writes the pictures of docs/trades/
  cargo xtask vary         writes docs/vary-compared.md: what moved curves gain, against the paper
  cargo xtask web          builds the editor for the browser into target/web, or --out DIR
";

fn main() -> ExitCode {
    let chore = std::env::args().nth(1).unwrap_or_default();
    let done = match chore.as_str() {
        "bend-peers" => bending::write_held(),
        "bending" => bending::write(),
        "compare" => compare::run().map_err(Into::into),
        "composites" => composites::write(),
        "figures" => figures::write(),
        "fold-price" => fold_price::write(),
        "gallery" => gallery::write(),
        "measured" => measured::write(),
        "outputs" => outputs::write().map_err(Into::into),
        "panels" => panels::write(),
        "peers" => peers::run(),
        "quads" => quads::write(),
        "release" => release::build().map_err(Into::into),
        "templates" => templates::write(),
        "trades" => trades::write(),
        "vary" => vary::write(),
        "web" => web::build().map_err(Into::into),
        _ => {
            print!("{HELP}");
            return if chore.is_empty() { ExitCode::SUCCESS } else { ExitCode::from(2) };
        }
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

/// The root of the checkout.
fn root() -> std::path::PathBuf {
    let here = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    here.parent().unwrap_or(here).to_owned()
}
