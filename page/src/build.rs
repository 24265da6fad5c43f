//! The steps of the build.

use std::ffi::OsStr;
use std::fs;
use std::io::BufWriter;
use std::path::{Path, PathBuf};
use std::process::Command;

use wasm_bindgen_cli_support::Bindgen;

const TARGET: &str = "wasm32-unknown-unknown";
/// The widest picture of a scene in the gallery \[pixels\].
const WIDEST: u32 = 400;

/// What went wrong, in words.
type Fault = Box<dyn std::error::Error>;

/// Builds the page, in the folder of the argument.
pub fn page() -> Result<PathBuf, Fault> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().ok_or("the project has no folder")?;
    let build = std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), PathBuf::from);
    let folder = std::env::args_os().nth(1).map_or_else(|| build.join("site"), PathBuf::from);
    let mut compile = compiler()?;
    println!("compiling for browsers, which takes some minutes the first time");
    run(compile.current_dir(root).args([
        "build",
        "--profile",
        "page",
        "--lib",
        "--package",
        "page",
        "--target",
        TARGET,
    ]))?;
    let wasm = build.join(TARGET).join("page").join("page.wasm");
    fs::create_dir_all(&folder)?;
    Bindgen::new()
        .input_path(&wasm)
        .web(true)?
        .typescript(false)
        .remove_name_section(true)
        .remove_producers_section(true)
        .out_name("motes")
        .generate(&folder)?;
    optimize(&folder.join("motes_bg.wasm"))?;
    for file in fs::read_dir(root.join("page/static"))? {
        let file = file?;
        fs::copy(file.path(), folder.join(file.file_name()))?;
    }
    let pictures = folder.join("pictures");
    fs::create_dir_all(&pictures)?;
    for file in fs::read_dir(root.join("scenes/pictures"))? {
        let path = file?.path();
        if let (Some("png"), Some(name)) = (path.extension().and_then(OsStr::to_str), path.file_name()) {
            shrink(&path, &pictures.join(name)).map_err(|why| format!("{}: {why}", path.display()))?;
        }
    }
    Ok(folder)
}

/// The compiler with the standard library for browsers: that of rustup, or Debian's, which compiles that library, too.
fn compiler() -> Result<Command, Fault> {
    let cargo = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    let known = Command::new("rustc").args(["--print", "target-libdir", "--target", TARGET]).output()?;
    if Path::new(String::from_utf8(known.stdout)?.trim()).exists() {
        return Ok(cargo);
    }
    println!("adding {TARGET} to Rust");
    let Err(refused) = run(Command::new("rustup").args(["target", "add", TARGET])) else { return Ok(cargo) };
    let source = Path::new("/usr/lib/rustlib/src/rust/library/std");
    let debian = ["/usr/bin/cargo", "/usr/bin/rustc", "/usr/bin/wasm-ld"].map(Path::new);
    if !source.exists() || !debian.iter().all(|program| program.exists()) {
        return Err(format!("{refused}; on Debian the packages rustc-web cargo-web rust-web-src lld do as well").into());
    }
    let [cargo, rustc, linker] = debian;
    let mut cargo = Command::new(cargo);
    cargo.arg("-Zbuild-std=std,panic_abort").env("RUSTC_BOOTSTRAP", "1").env("RUSTC", rustc);
    cargo.env("CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER", linker).env_remove("RUSTUP_TOOLCHAIN");
    Ok(cargo)
}

fn run(command: &mut Command) -> Result<(), Fault> {
    let name = command.get_program().to_string_lossy().into_owned();
    let ended = command.status().map_err(|why| format!("`{name}` cannot be started: {why}"))?;
    if ended.success() { Ok(()) } else { Err(format!("`{name}` failed: what it says stands above").into()) }
}

/// Makes the program smaller by `wasm-opt` of binaryen, where it is installed.
fn optimize(wasm: &Path) -> Result<(), Fault> {
    let found = Command::new("wasm-opt").arg("--version").output().is_ok_and(|ended| ended.status.success());
    if found {
        run(Command::new("wasm-opt").arg("-Os").arg("--all-features").arg("-o").arg(wasm).arg(wasm))
    } else {
        Ok(())
    }
}

/// A smaller copy of a picture: each pixel is the mean of a square.
fn shrink(from: &Path, to: &Path) -> Result<(), Fault> {
    let mut decoder = png::Decoder::new(std::io::BufReader::new(fs::File::open(from)?));
    decoder.set_transformations(png::Transformations::normalize_to_color8());
    let mut reader = decoder.read_info()?;
    let mut pixels = vec![0; reader.output_buffer_size().ok_or("it is too large")?];
    let info = reader.next_frame(&mut pixels)?;
    let each = info.color_type.samples();
    let part = info.width.div_ceil(WIDEST).max(1);
    let (width, height) = (info.width / part, info.height / part);
    let mean = |x: u32, y: u32, channel: usize| {
        let channel = if each < 3 { 0 } else { channel };
        let at = |x: u32, y: u32| u32::from(pixels[(y as usize * info.width as usize + x as usize) * each + channel]);
        let sum: u32 = (0..part * part).map(|i| at(x * part + i % part, y * part + i / part)).sum();
        u8::try_from(sum / (part * part)).unwrap_or(u8::MAX)
    };
    let small: Vec<u8> = (0..height)
        .flat_map(|y| (0..width).flat_map(move |x| (0..3).map(move |channel| (x, y, channel))))
        .map(|(x, y, channel)| mean(x, y, channel))
        .collect();
    let mut encoder = png::Encoder::new(BufWriter::new(fs::File::create(to)?), width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::High);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&small)?;
    Ok(writer.finish()?)
}
