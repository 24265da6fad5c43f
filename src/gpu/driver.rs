//! Known drivers, and the reasons why the expected one is not used.

use std::ffi::OsString;
use std::path::Path;

use wgpu::{AdapterInfo, Backend};

/// Variables that give the files of Vulkan drivers, in the order in which the loader reads them.
const FILES: [&str; 2] = ["VK_DRIVER_FILES", "VK_ICD_FILENAMES"];
/// The variable that selects a backend.
const CHOICE: &str = "WGPU_BACKEND";

/// A known defect of a driver that costs time and memory.
pub fn warning(info: &AdapterInfo) -> Option<String> {
    let (major, minor) = mesa(&info.driver_info)?;
    let recompiles = info.backend == Backend::Vulkan && info.name.contains("llvmpipe");
    (recompiles && ((22, 2)..=(23, 0)).contains(&(major, minor))).then(|| {
        format!(
            "llvmpipe of Mesa {major}.{minor} recompiles a kernel at every dispatch where a branch depends on the first word of a \
             uniform block, and keeps all of them in memory (22.2 to 23.0 do); motes leaves that word unused, other programs may \
             not. A newer Mesa is free of it and does not cut loops: mesa-vulkan-drivers 25 or later (on Debian 12 from \
             bookworm-backports)"
        )
    })
}

/// The version of Mesa in the description of a driver, `Mesa 22.3.6 (LLVM 15.0.6)`.
fn mesa(driver: &str) -> Option<(u32, u32)> {
    let version = driver.split("Mesa ").nth(1)?;
    let mut numbers = version.split(|c: char| !c.is_ascii_digit()).map(|n| n.parse().ok());
    Some((numbers.next()??, numbers.next()??))
}

/// The reason why OpenGL runs the kernels, if it was not chosen.
pub fn substitute(info: &AdapterInfo) -> Option<String> {
    substitute_in(info.backend, |name| std::env::var_os(name))
}

fn substitute_in(backend: Backend, variable: impl Fn(&str) -> Option<OsString>) -> Option<String> {
    if backend != Backend::Gl || variable(CHOICE).is_some() {
        return None;
    }
    let expected = match std::env::consts::OS {
        "macos" | "ios" => "Metal",
        "windows" => "Vulkan or DirectX 12",
        _ => "Vulkan",
    };
    let named = FILES.into_iter().find_map(|name| Some((name, variable(name)?)));
    let cause = named.map_or(String::new(), |(name, files)| {
        let absent = std::env::split_paths(&files).find(|file| !Path::new(file).is_file());
        match absent {
            Some(file) => format!(": {name} names {}, which is not there", file.display()),
            None => format!(": {name} is {}", files.display()),
        }
    });
    Some(format!(
        "there is no adapter of {expected}{cause}; OpenGL runs the kernels, which is slower and without subgroups ({CHOICE}=gl asks for \
         it without this note)"
    ))
}

#[cfg(test)]
mod tests {
    use super::{Backend, mesa, substitute_in};

    #[test]
    fn versions_of_mesa_are_read() {
        assert_eq!(mesa("Mesa 22.3.6 (LLVM 15.0.6)"), Some((22, 3)));
        assert_eq!(mesa("4.5 (Core Profile) Mesa 23.0.0-devel"), Some((23, 0)));
        assert_eq!((mesa("535.183.01"), mesa("Mesa from git"), mesa("")), (None, None, None));
    }

    #[test]
    fn opengl_is_explained_unless_it_is_asked_for() {
        let set = |wanted: &'static str, to: &'static str| move |name: &str| (name == wanted).then(|| to.into());
        assert_eq!(substitute_in(Backend::Vulkan, |_| None), None);
        assert_eq!(substitute_in(Backend::Gl, set("WGPU_BACKEND", "gl")), None);
        let plain = substitute_in(Backend::Gl, |_| None).expect("a note");
        assert!(plain.contains("OpenGL runs the kernels") && !plain.contains("VK_"), "{plain}");
        for name in super::FILES {
            let absent = substitute_in(Backend::Gl, set(name, "/no/such/driver.json")).expect("a note");
            assert!(absent.contains(&format!("{name} names /no/such/driver.json, which is not there")), "{absent}");
        }
        let there = substitute_in(Backend::Gl, set("VK_DRIVER_FILES", "Cargo.toml")).expect("a note");
        assert!(there.contains("VK_DRIVER_FILES is Cargo.toml"), "{there}");
    }
}
