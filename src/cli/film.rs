//! Encoding of the pictures of a film as a video.

use std::io;
use std::path::Path;
use std::process::{Command, Stdio};

use motes::run::Film;
use serde_json::json;

use super::progress::Progress;
use super::shell::quoted;

/// The report on the film of a run in this folder.
pub fn lines(film: &Film, name: &str, folder: &Path, progress: &Progress) -> Vec<String> {
    let frames = film.done().len();
    if frames == 0 {
        return vec!["no film: the run was stopped before its first frame".to_owned()];
    }
    if let Some((outside, count)) =
        film.outside().filter(|(outside, count)| u64::from(*outside) * 10 > u64::from(*count))
    {
        progress.say(&format!(
            "note: {outside} of {count} particles have left the picture, whose camera is set by the first frame: set \
             picture.auto_frame = false with picture.center and picture.extent"
        ));
    }
    let (file, rate) = (film.file(), film.rate());
    progress.event("film", json!({ "file": folder.join(&file), "frames": frames, "fps": rate }));
    let line = format!("film: {file}, the {frames} pictures in frames/ at {rate} a second");
    vec![line, video(film, name, folder, progress)]
}

/// Encodes a video by ffmpeg. Returns a line about it, or about the reason why there is none.
fn video(film: &Film, name: &str, folder: &Path, progress: &Progress) -> String {
    let (name, part) = (format!("{name}_film.mp4"), format!("{name}_film.part.mp4"));
    let to_part = arguments(film, &format!("../{part}"));
    let mut command = Command::new("ffmpeg");
    command.current_dir(folder.join("frames")).args(["-loglevel", "error", "-nostdin", "-y"]);
    let made = command.args(&to_part).stdin(Stdio::null()).stdout(Stdio::null()).output();
    let reason = match made {
        Ok(done) if done.status.success() => {
            std::fs::rename(folder.join(&part), folder.join(&name)).err().map(|e| e.to_string())
        }
        Ok(done) => {
            let said = String::from_utf8_lossy(&done.stderr);
            let line = said.lines().rfind(|l| !l.trim().is_empty()).unwrap_or("it does not say why");
            Some(format!("ffmpeg failed ({}): {}", done.status, line.trim()))
        }
        Err(error) if error.kind() == io::ErrorKind::NotFound => Some("there is no ffmpeg on the PATH".to_owned()),
        Err(error) => Some(format!("ffmpeg does not start: {error}")),
    };
    let Some(reason) = reason else {
        let file = folder.join(&name);
        progress.event("video", json!({ "file": file, "frames": film.done().len(), "fps": film.rate() }));
        return format!("video: {name}, made by ffmpeg");
    };
    // An incomplete file must not look like a video.
    let _ = std::fs::remove_file(folder.join(&part));
    let words = arguments(film, &format!("../{name}"));
    let by_hand = words.iter().fold("ffmpeg".to_owned(), |line, word| line + " " + &quoted(word));
    progress.event("video", json!({ "file": null, "reason": reason, "command": by_hand }));
    let place = folder.join("frames");
    format!("no video: {reason}; to make one, in {}: {by_hand}", place.display())
}

/// H.264 as all players support it, which requires even sides. Earlier runs may have left more frames.
fn arguments(film: &Film, to: &str) -> Vec<String> {
    let (rate, frames) = (film.rate().to_string(), film.done().len().to_string());
    let files = format!("frame_%0{}d.png", film.digits());
    let even = "crop=trunc(iw/2)*2:trunc(ih/2)*2";
    let words = ["-framerate", &rate, "-i", &files, "-frames:v", &frames, "-vf", even, "-c:v", "libx264"];
    let more = ["-crf", "18", "-pix_fmt", "yuv420p", "-movflags", "+faststart", to];
    words.into_iter().chain(more).map(str::to_owned).collect()
}
