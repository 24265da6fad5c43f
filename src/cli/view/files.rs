//! The files of a scene that is edited while it runs.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant, SystemTime};

/// The interval at which they are looked at.
pub const LOOK: Duration = Duration::from_millis(250);

/// The files of a scene, and when they were written last.
pub struct Files {
    written: Vec<(PathBuf, Option<SystemTime>)>,
    looked: Instant,
}

impl Files {
    /// The files of a scene that was read from a time on. What was written since then may not have been read.
    pub fn of(files: &[PathBuf], begun: SystemTime) -> Self {
        let written = files.iter().map(|file| (file.clone(), modified(file).filter(|time| *time < begun))).collect();
        Self { written, looked: Instant::now() }
    }
    /// Their paths.
    pub fn paths(&self) -> impl Iterator<Item = &PathBuf> {
        self.written.iter().map(|(file, _)| file)
    }
    /// Whether one of them was written since it was read, and is at rest.
    pub fn changed(&mut self) -> bool {
        if self.looked.elapsed() < LOOK {
            return false;
        }
        self.looked = Instant::now();
        let resting = |time: SystemTime| time.elapsed().is_ok_and(|since| since > LOOK / 2);
        self.written.iter().any(|(file, time)| {
            let now = modified(file);
            now != *time && now.is_some_and(resting)
        })
    }
}

fn modified(file: &Path) -> Option<SystemTime> {
    std::fs::metadata(file).and_then(|data| data.modified()).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Longer than a look, and than a file takes to come to rest.
    fn wait() {
        std::thread::sleep(LOOK + Duration::from_millis(50));
    }

    #[test]
    fn what_is_saved_is_seen_once() {
        let folder = tempfile::tempdir().expect("a folder");
        let [scene, law] = ["scene.toml", "law.wgsl"].map(|name| folder.path().join(name));
        for file in [&scene, &law] {
            std::fs::write(file, "one").expect("a file");
        }
        wait();
        let mut files = Files::of(&[scene.clone(), law.clone()], SystemTime::now());
        wait();
        assert!(!files.changed(), "nothing was saved");
        std::fs::write(&law, "two").expect("a file");
        assert!(!files.changed(), "too soon after the last look");
        wait();
        assert!(files.changed(), "the law was saved");
        let mut files = Files::of(&[scene, law.clone()], SystemTime::now());
        wait();
        assert!(!files.changed(), "it was seen");
        // Some editors take the old file away before they write the new one.
        std::fs::remove_file(&law).expect("no file");
        wait();
        assert!(!files.changed(), "there is nothing to be read");
        std::fs::write(&law, "three").expect("a file");
        wait();
        assert!(files.changed(), "the law is there again");
    }
    #[test]
    fn what_is_saved_while_it_is_read_is_read_again() {
        let folder = tempfile::tempdir().expect("a folder");
        let scene = folder.path().join("scene.toml");
        let begun = SystemTime::now() - Duration::from_millis(20);
        std::fs::write(&scene, "one").expect("a file");
        let mut files = Files::of(&[scene], begun);
        wait();
        assert!(files.changed());
    }
}
