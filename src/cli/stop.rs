//! Ctrl-C, SIGTERM and SIGHUP: the first one lets the batch end and the results be written, the second ends at once.

use std::time::Duration;

use motes::run::Stop;

use super::args::StopArgs;

/// A stop by signals from now on, and by the time limit, if there is one. Where signals cannot be handled, they end the
/// program as usual.
pub fn listen(args: &StopArgs) -> Stop {
    let longest = args.max_hours.and_then(|hours| Duration::try_from_secs_f64(3600.0 * hours).ok());
    let stop = longest.map_or_else(Stop::default, Stop::after);
    let asked = stop.clone();
    let ignored = signals::hangup_is_ignored();
    let _ = ctrlc::set_handler(move || {
        if asked.is_asked() {
            std::process::exit(130);
        }
        asked.ask();
    });
    if ignored {
        signals::ignore(signals::HANGUP);
    }
    // With the signal ignored, a file at its size limit is an error of the write call.
    signals::ignore(signals::TOO_LARGE);
    stop
}

/// Ends the program at once, with what is printed. While a driver compiles, its own handlers of an exit crash (NVIDIA 580), so that they are left
/// out where the system can do so.
pub fn leave(code: u8) -> ! {
    let _ = super::stdout::flush();
    signals::leave(code.into())
}

/// The signals of the system.
#[cfg(unix)]
mod signals {
    use nix::sys::signal::{SigHandler, Signal, signal};

    pub const HANGUP: Signal = Signal::SIGHUP;
    pub const TOO_LARGE: Signal = Signal::SIGXFSZ;

    /// Whether the program was started with SIGHUP ignored: `nohup` starts a program that a closed terminal shall not end.
    #[expect(unsafe_code, reason = "the only way to ask; no handler of ours is installed by it")]
    pub fn hangup_is_ignored() -> bool {
        // SAFETY: the default action and ignoring are no functions of this program.
        let before = unsafe { signal(HANGUP, SigHandler::SigIgn) };
        // SAFETY: as above.
        let restored = |handler| unsafe { signal(HANGUP, handler) };
        match before {
            Ok(SigHandler::SigIgn) => true,
            Ok(_) => restored(SigHandler::SigDfl).is_err(),
            Err(_) => false,
        }
    }
    /// Ends the process without handlers.
    #[expect(unsafe_code, reason = "the only way to leave them out")]
    pub fn leave(code: i32) -> ! {
        // SAFETY: it does not return, and has no conditions.
        unsafe { nix::libc::_exit(code) }
    }
    /// Ignores a signal.
    #[expect(unsafe_code, reason = "no function of this program is called by it")]
    pub fn ignore(what: Signal) {
        // SAFETY: ignoring is no function of this program.
        let _ = unsafe { signal(what, SigHandler::SigIgn) };
    }
}

/// Other systems have no such signals.
#[cfg(not(unix))]
mod signals {
    pub const HANGUP: () = ();
    pub const TOO_LARGE: () = ();

    pub fn leave(code: i32) -> ! {
        std::process::exit(code)
    }
    pub fn hangup_is_ignored() -> bool {
        false
    }
    pub fn ignore(_: ()) {}
}
