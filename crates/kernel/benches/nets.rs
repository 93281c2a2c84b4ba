//! How many pieces the nets of known models have, and how long they take: `cargo bench -p
//! sheetwright --bench nets`; `-- --write DIR` writes the models as OBJ files instead, for
//! `bench/peers/nets`, which puts Blender's Export Paper Model beside it.
//!
//! A line for each model, and for one that is larger: its facets, pieces, seconds (one thread), and
//! its name.
#![allow(clippy::print_stdout, clippy::unwrap_used)] // it prints; what fails should stop it

use sheetwright::mesh::Cut;
use sheetwright::nets::{NetOptions, net};
use sheetwright::watch::Unwatched;
use sheetwright_shapes::low_poly::{fine_animal, models};
use std::path::Path;
use std::time::Instant;

fn main() {
    let large = ("animal, fine".to_owned(), fine_animal());
    let all = models().into_iter().chain([large]);
    let arguments: Vec<String> = std::env::args().skip(1).filter(|a| a != "--bench").collect();
    if let [write, folder] = &arguments[..] {
        assert_eq!(write, "--write");
        std::fs::create_dir_all(folder).unwrap();
        for (name, model) in all {
            let file = Path::new(folder).join(format!("{name}.obj"));
            std::fs::write(file, model.obj()).unwrap();
        }
        return;
    }
    for (name, model) in all {
        let mesh = model.mesh();
        let start = Instant::now();
        let net = net(&mesh, &Cut::new(), &NetOptions::default(), &mut Unwatched).unwrap();
        let seconds = start.elapsed().as_secs_f64();
        println!("{}\t{}\t{seconds:.3}\t{name}", net.facets, net.pieces);
    }
}
