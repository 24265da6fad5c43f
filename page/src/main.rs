//! Builds the page: `cargo run -p page [FOLDER]`. What it writes is served by any static server; it asks for nothing else.

#[cfg(not(target_arch = "wasm32"))]
mod build;

#[cfg(not(target_arch = "wasm32"))]
fn main() -> std::process::ExitCode {
    match build::page() {
        Ok(folder) => {
            println!("the page is in {0}; serve it, as by `python3 -m http.server -d {0}`", folder.display());
            std::process::ExitCode::SUCCESS
        }
        Err(why) => {
            eprintln!("error: {why}");
            std::process::ExitCode::FAILURE
        }
    }
}

#[cfg(target_arch = "wasm32")]
fn main() {}
