//! The command line: parses arguments, runs a command, returns an exit code.

/// Prints a line on standard output. A failure to print is reported at the end of the program.
macro_rules! out {
    ($($text:tt)*) => {{
        use std::io::Write as _;
        crate::cli::stdout::printed(&writeln!(std::io::stdout(), $($text)*));
    }};
}
/// Prints a line on standard error.
macro_rules! note {
    ($($text:tt)*) => {{
        use std::io::Write as _;
        let _ = writeln!(std::io::stderr(), $($text)*);
    }};
}

mod aftermath;
mod args;
mod bench;
mod check;
mod compare;
mod conclude;
mod convert;
mod course;
mod crowds;
mod doctor;
mod engine;
mod explain;
mod failure;
mod far;
mod film;
mod info;
mod load;
mod neighbors;
mod progress;
mod run;
mod scenes;
mod shell;
mod solves;
mod stability;
mod stdout;
mod stop;
mod summary;
mod sweep;
mod validate;
mod view;
mod words;

use std::process::ExitCode;

use clap::Parser;

use args::{Args, Command};
use failure::Failure;
use motes::Error;

/// Parses the arguments, runs the command, and reports failures as a message and an exit code.
pub fn main() -> ExitCode {
    let words = std::env::args_os().skip(1).take_while(|word| word != "--");
    let _ = failure::JSON.set(words.into_iter().any(|word| word == "--json"));
    let args = match Args::try_parse() {
        Ok(args) => args,
        Err(error) => {
            // clap exits with 2 for wrong arguments and with 0 for --help.
            let printed = error.print();
            if error.use_stderr() {
                let code = u8::try_from(error.exit_code()).unwrap_or(2);
                failure::event(code, serde_json::json!({ "text": error.to_string().trim_end() }));
                return ExitCode::from(code);
            }
            stdout::printed(&printed);
            return ended(Ok(()));
        }
    };
    ended(pollster::block_on(dispatch(args.command)))
}

/// The exit code. Lost standard output is a failure, unless there is another one.
fn ended(result: Result<(), Failure>) -> ExitCode {
    match result.and_then(|()| Ok(stdout::flush()?)) {
        Ok(()) => ExitCode::SUCCESS,
        // A driver may still be at work.
        Err(failure @ Failure::Error(Error::Timeout { .. })) => {
            failure.report();
            stop::leave(7)
        }
        Err(failure) => failure.report(),
    }
}

async fn dispatch(command: Command) -> Result<(), Failure> {
    // Writing files and measuring states use threads, too.
    motes::cpu::threads()?;
    match command {
        Command::Run(args) => Box::pin(run::run(&args)).await,
        Command::Resume(args) => Box::pin(run::resume(&args)).await,
        Command::View(args) => Box::pin(view::view(&args)).await,
        Command::Check(args) => check::check(&args).await,
        Command::Explain(args) => explain::explain(&args).await,
        Command::Compare(args) => compare::compare(&args).await,
        Command::Crowds(args) => crowds::crowds(&args).await,
        Command::Scenes(args) => scenes::scenes(&args),
        Command::Convert(args) => convert::convert(&args),
        Command::Info(args) => info::info(&args),
        Command::Stability(args) => stability::stability(&args).await,
        Command::Bench(args) => bench::bench(&args).await,
        Command::Sweep(args) => sweep::sweep(&args).await,
        Command::Validate(args) => validate::validate(&args).await,
        Command::Doctor(args) => doctor::doctor(&args).await,
    }
}
