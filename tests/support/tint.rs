//! Shaders as files, for another compiler than naga: `tests/tint/run` gives them to Tint.

use std::collections::HashSet;
use std::path::Path;

use motes::kernel::Kernel;
use serde_json::{Map, Value, json};

/// The folder that they are written to, if any.
const FOLDER: &str = "MOTES_SHADERS";

/// Every way in which kernels make shaders pipelines, once. `lanes` is the size of their machine's
/// subgroups, or 0.
pub fn shaders<'a>(kernels: impl Iterator<Item = (String, &'a Kernel, u32)>) -> Vec<Value> {
    let mut seen = HashSet::new();
    let mut shaders = Vec::new();
    for (of, kernel, lanes) in kernels {
        for pass in &kernel.passes {
            let constants: Map<_, _> =
                pass.constants.iter().map(|(name, value)| ((*name).to_owned(), json!(value))).collect();
            let files: Vec<_> = pass.shader.sources().iter().map(|source| source.file.as_ref()).collect();
            if seen.insert((pass.shader.text().to_owned(), format!("{constants:?}"), lanes)) {
                shaders
                    .push(json!({ "of": format!("{of}: {}", kernel.name), "files": files, "code": pass.shader.text(),
                    "constants": constants, "entry": pass.shader.reflection().entry, "lanes": lanes }));
            }
        }
    }
    shaders
}

/// Writes them where they are wanted.
pub fn write(name: &str, shaders: &[Value]) {
    if let Some(folder) = std::env::var_os(FOLDER) {
        let path = Path::new(&folder).join(format!("{name}.json"));
        std::fs::write(&path, json!(shaders).to_string()).expect("the file can be written");
    }
}
