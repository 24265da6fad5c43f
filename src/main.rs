//! The command `motes`. All waiting is done here and in `cli/`; the library never blocks.

mod cli;

use std::process::ExitCode;

fn main() -> ExitCode {
    cli::main()
}
