//! Ctrl-C, SIGTERM and SIGHUP: the first one lets the batch end and the results be written, the second ends at once.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Whether a signal asked the run to end.
#[derive(Clone, Default)]
pub struct Stop(Arc<AtomicBool>);

impl Stop {
    /// Listens from now on. Where that cannot be had, signals end the program as usual.
    pub fn listen() -> Self {
        let stop = Self::default();
        let flag = stop.clone();
        let ignored = hangup::is_ignored();
        let _ = ctrlc::set_handler(move || {
            if flag.0.swap(true, Ordering::Relaxed) {
                std::process::exit(130);
            }
        });
        if ignored {
            hangup::ignore();
        }
        stop
    }
    /// Whether to stop.
    pub fn asked(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// `nohup` starts a program that a closed terminal shall not end.
#[cfg(unix)]
mod hangup {
    use nix::sys::signal::{SigHandler, Signal, signal};

    /// Whether the program was started with SIGHUP ignored.
    #[expect(unsafe_code, reason = "the only way to ask; no handler of ours is installed by it")]
    pub fn is_ignored() -> bool {
        // SAFETY: the default action and ignoring are no functions of this program.
        let before = unsafe { signal(Signal::SIGHUP, SigHandler::SigIgn) };
        // SAFETY: as above.
        let restored = |handler| unsafe { signal(Signal::SIGHUP, handler) };
        match before {
            Ok(SigHandler::SigIgn) => true,
            Ok(_) => restored(SigHandler::SigDfl).is_err(),
            Err(_) => false,
        }
    }
    /// Ignores it again.
    #[expect(unsafe_code, reason = "it puts back what was there when the program started")]
    pub fn ignore() {
        // SAFETY: ignoring is no function of this program.
        let _ = unsafe { signal(Signal::SIGHUP, SigHandler::SigIgn) };
    }
}

/// Elsewhere there is no such signal.
#[cfg(not(unix))]
mod hangup {
    pub fn is_ignored() -> bool {
        false
    }
    pub fn ignore() {}
}
