//! `sheetwright completions` and `sheetwright man`: what shells and manuals know of the command.

use crate::args::Cli;
use crate::failure::Failure;
use crate::voice::print_as_it_is;
use clap::CommandFactory;
use clap_complete::Shell;

pub(crate) fn completions(shell: Shell) -> Result<(), Failure> {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut Cli::command(), "sheetwright", &mut script);
    print_as_it_is(&script)
}

pub(crate) fn man(name: Option<&str>) -> Result<(), Failure> {
    let mut all = Cli::command();
    all.build();
    let command = match name {
        None => &all,
        Some(name) => all.find_subcommand(name).ok_or_else(|| {
            let names: Vec<&str> = all.get_subcommands().map(clap::Command::get_name).collect();
            let hint = format!("The commands are {}.", names.join(", "));
            Failure::new(format!("there is no command '{name}'"), hint)
        })?,
    };
    let mut page = Vec::new();
    clap_mangen::Man::new(command.clone())
        .render(&mut page)
        .map_err(|error| Failure::new(error.to_string(), "This is a fault of the program."))?;
    print_as_it_is(&page)
}
