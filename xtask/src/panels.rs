//! A curve table with many panels, for measuring batches: random smooth closed curves, each from
//! the number of its panel.

use sheetwright_shapes::family::Family;
use std::error::Error;
use std::fs::File;
use std::io::{BufWriter, Write as _};

const CALL: &str = "call it as: cargo xtask panels COUNT SAMPLES FILE.csv";

/// Writes the table that the call asks for.
pub(crate) fn write() -> Result<(), Box<dyn Error>> {
    let args: Vec<String> = std::env::args().skip(2).collect();
    let [count, samples, path] = &args[..] else { return Err(CALL.into()) };
    let (count, samples): (u64, usize) = (count.parse()?, samples.parse()?);
    let mut table = BufWriter::new(File::create(path)?);
    writeln!(table, "curve,x,y,z")?;
    for panel in 1..=count {
        for at in Family::Fourier(panel).boundary(samples).positions() {
            writeln!(table, "p{panel},{},{},{}", at.x, at.y, at.z)?;
        }
    }
    table.flush()?;
    Ok(())
}
