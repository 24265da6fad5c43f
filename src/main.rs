//! The command `motes`. All waiting is done here and in `cli/`; the library never blocks.

mod cli;

use std::process::ExitCode;

fn main() -> ExitCode {
    hush();
    cli::main()
}

/// Mesa's layer that chooses devices looks for a Wayland display, and complains on standard error where there is no desktop.
#[expect(unsafe_code, reason = "no other thread runs yet that could read the environment")]
fn hush() {
    if cfg!(target_os = "linux") && std::env::var_os("XDG_RUNTIME_DIR").is_none() {
        // SAFETY: this is the first thing that the program does.
        unsafe { std::env::set_var("NODEVICE_SELECT", "1") };
    }
}
