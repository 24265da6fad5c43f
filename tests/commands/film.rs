//! `motes run --frames`: how many pictures, of which steps, joined to what.

use std::fs::File;
use std::io::BufReader;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

/// One body that rests between two that fly apart: for a camera that looks at all each time, it would be seen to move.
const SCENE: &str = "\
# Two bodies leave a third.
[simulation]
dt = 0.1
steps = 10
[[particles]]
bodies = [{ position = [0, 0, 0], mass = 1 }, { position = [1, 0, 0], velocity = [3, 0, 1], mass = 1 },
          { position = [-1, 0, 0.5], velocity = [0, 0, -0.2], mass = 1 }]
[output]
every = 10
formats = []
frames = 4
[picture]
width = 97
height = 65
";

struct Place {
    folder: tempfile::TempDir,
}

impl Place {
    fn new(scene: &str) -> Self {
        let place = Self { folder: tempfile::tempdir().expect("a folder") };
        std::fs::write(place.at("birds.toml"), scene).expect("written");
        place
    }
    fn at(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }
    /// `motes run` of the scene into a folder, where nothing is on the PATH but what is in `path`.
    fn motes(&self, out: &str, path: &str, more: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_motes"));
        command.arg("run").arg(self.at("birds.toml")).arg("-o").arg(self.at(out)).args(more);
        command.env_remove("WGPU_ADAPTER_NAME").env("PATH", self.at(path)).stdin(Stdio::null());
        command
    }
    fn run(&self, out: &str, path: &str, more: &[&str]) -> (i32, String, String) {
        let Output { status, stdout, stderr } = self.motes(out, path, more).output().expect("the program starts");
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("output is UTF-8");
        (status.code().unwrap_or(-1), text(stdout), text(stderr))
    }
    fn frames(&self, out: &str) -> Vec<PathBuf> {
        let Ok(entries) = std::fs::read_dir(self.at(out).join("frames")) else { return Vec::new() };
        let mut files: Vec<_> = entries.map(|e| e.expect("an entry").path()).collect();
        files.retain(|file| file.extension().is_some_and(|e| e == "png"));
        files.sort();
        files
    }
}

fn decoder(file: &Path) -> png::Reader<BufReader<File>> {
    png::Decoder::new(BufReader::new(File::open(file).expect("a file"))).read_info().expect("a PNG")
}

fn rgb(file: &Path) -> Vec<u8> {
    let mut reader = decoder(file);
    let mut bytes = vec![0; reader.output_buffer_size().expect("small")];
    let info = reader.next_frame(&mut bytes).expect("a picture");
    assert_eq!(info.color_type, png::ColorType::Rgb);
    bytes
}

/// The pictures of an animated PNG as a viewer shows them, and their delays in seconds.
fn film(file: &Path) -> (Vec<Vec<u8>>, Vec<f64>) {
    let mut reader = decoder(file);
    let control = *reader.info().animation_control().expect("an animation");
    assert_eq!(control.num_plays, 0, "it repeats for ever");
    let mut shown = Vec::new();
    let (mut pictures, mut delays) = (Vec::new(), Vec::new());
    for _ in 0..control.num_frames {
        let mut bytes = vec![0; reader.output_buffer_size().expect("small")];
        reader.next_frame(&mut bytes).expect("a frame");
        let frame = *reader.info().frame_control().expect("a frame's control");
        assert_eq!((frame.x_offset, frame.y_offset), (0, 0));
        delays.push(f64::from(frame.delay_num) / f64::from(frame.delay_den));
        shown.resize(bytes.len() / 4 * 3, 0);
        for (old, new) in shown.chunks_exact_mut(3).zip(bytes.chunks_exact(4)) {
            assert!(new[3] == 255 || frame.blend_op == png::BlendOp::Over && new == [0; 4]);
            if new[3] == 255 {
                old.copy_from_slice(&new[..3]);
            }
        }
        pictures.push(shown.clone());
    }
    let mut bytes = vec![0; reader.output_buffer_size().expect("small")];
    assert!(reader.next_frame(&mut bytes).is_err(), "no more frames than it says");
    (pictures, delays)
}

#[test]
fn frames_are_evenly_spaced_joined_and_the_same_on_every_run() {
    let place = Place::new(SCENE);
    let (code, stdout, stderr) = place.run("a", "nothing", &["--json", "--fps", "12"]);
    assert_eq!((code, stderr.as_str()), (0, ""));
    let events: Vec<serde_json::Value> = stdout.lines().map(|l| serde_json::from_str(l).expect("JSON")).collect();
    let of = |kind: &str| events.iter().filter(|e| e["event"] == kind).cloned().collect::<Vec<_>>();
    let steps: Vec<_> = of("frame").iter().map(|e| (e["frame"].as_u64(), e["step"].as_u64())).collect();
    // Thirds of ten steps.
    let wanted = [(0, 0), (1, 3), (2, 7), (3, 10)].map(|(k, step)| (Some(k), Some(step)));
    assert_eq!(steps, wanted);
    assert!(of("film")[0]["frames"] == 4 && of("film")[0]["fps"] == 12);
    assert!(
        of("video")[0]["file"].is_null() && of("video")[0]["reason"].as_str() == Some("there is no ffmpeg on the PATH")
    );
    assert_eq!(events.last().expect("events")["event"], "finish");

    let frames = place.frames("a");
    let names: Vec<_> = frames.iter().map(|f| f.file_name().expect("a name").to_string_lossy().into_owned()).collect();
    assert_eq!(names, ["frame_0000.png", "frame_0001.png", "frame_0002.png", "frame_0003.png"]);
    let pictures: Vec<_> = frames.iter().map(|f| rgb(f)).collect();
    assert!(pictures.windows(2).all(|p| p[0] != p[1]), "something moves");
    let (shown, delays) = film(&place.at("a").join("birds_film.png"));
    assert!(shown == pictures, "the film shows its frames");
    assert!(delays.iter().all(|d| (d - 1.0 / 12.0).abs() < 1e-12), "{delays:?}");

    // The body at rest is the brightest of its place from first to last: the camera stays.
    let resting = |picture: &[u8]| {
        let amber = |p: &[u8]| f64::from(p[0]) - f64::from(p[2]);
        let places = picture.chunks_exact(3).zip(0_u32..).filter(|(p, _)| amber(p) > 90.0).map(|(_, i)| i);
        places.map(|i| (i % 97, i / 97)).collect::<Vec<_>>()
    };
    let first = resting(&pictures[0]);
    assert!(!first.is_empty() && pictures.iter().all(|p| resting(p).contains(&first[first.len() / 2])), "{first:?}");

    // All of them are in every picture, the last one too.
    let colors = |picture: &[u8]| picture.chunks_exact(3).filter(|p| p.iter().any(|c| *c > 150)).count();
    assert!(
        colors(&pictures[3]) * 10 > colors(&pictures[0]) * 9,
        "{:?}",
        pictures.iter().map(|p| colors(p)).collect::<Vec<_>>()
    );

    let (code, ..) = place.run("b", "nothing", &["--quiet"]);
    assert_eq!(code, 0);
    assert!(place.frames("b").iter().map(|f| rgb(f)).eq(pictures), "the same pictures");
    let bytes = |file: &str| std::fs::read(place.at(file)).expect("a file");
    assert_eq!(bytes("a/frames/frame_0002.png"), bytes("b/frames/frame_0002.png"));
}

#[test]
fn more_frames_than_states_are_refused_and_one_is_the_last() {
    let place = Place::new(SCENE);
    let (code, _, stderr) = place.run("many", "nothing", &["--frames", "12"]);
    assert_eq!(code, 3, "{stderr}");
    for words in ["12 `frames`", "of 10 steps", "at most 11", "output.frames=12"] {
        assert!(stderr.contains(words), "no {words} in\n{stderr}");
    }
    assert!(!place.at("many").exists(), "refused before the run starts");
    let (code, stdout, stderr) = place.run("each", "nothing", &["--frames", "11"]);
    assert_eq!((code, place.frames("each").len()), (0, 11), "{stderr}");
    assert!(stdout.contains("film: birds_film.png, the 11 pictures"), "{stdout}");
    assert!(stdout.contains("no video: there is no ffmpeg") && stdout.contains("ffmpeg -framerate 30"), "{stdout}");
    // The bodies that fly apart are not in a picture of the first.
    let (code, stdout, _) = place.run("one", "nothing", &["--frames", "1", "--json"]);
    let step = stdout.lines().find(|l| l.contains("\"frame\":0")).expect("a frame");
    assert!(code == 0 && step.contains("\"step\":10"), "{step}");
    let (pictures, _) = film(&place.at("one").join("birds_film.png"));
    assert_eq!(pictures.len(), 1);
    let (code, stdout, _) = place.run("none", "nothing", &["--frames", "0"]);
    assert!(code == 0 && !stdout.contains("film") && place.frames("none").is_empty(), "{stdout}");
}

#[cfg(unix)]
fn program(place: &Place, folder: &str, text: &str) {
    use std::os::unix::fs::PermissionsExt;
    std::fs::create_dir_all(place.at(folder)).expect("a folder");
    let file = place.at(folder).join("ffmpeg");
    std::fs::write(&file, text).expect("written");
    std::fs::set_permissions(&file, std::fs::Permissions::from_mode(0o755)).expect("a program");
}

#[cfg(unix)]
#[test]
fn ffmpeg_makes_a_video_of_the_frames_and_its_failure_is_reported() {
    let place = Place::new(SCENE);
    // Writes its arguments and how many frames it sees into the file that it is to make.
    program(&place, "good", "#!/bin/sh\nfor last; do :; done\nset -- \"$@\" frame_*.png\necho \"$@\" > \"$last\"\n");
    let (code, stdout, stderr) = place.run("good out", "good", &[]);
    assert!(code == 0 && stdout.contains("video: birds_film.mp4, made by ffmpeg"), "{stdout}{stderr}");
    let video = std::fs::read_to_string(place.at("good out").join("birds_film.mp4")).expect("a video");
    for words in ["-i frame_%04d.png", "-frames:v 4", "libx264", "yuv420p", "-framerate 30", "frame_0003.png"] {
        assert!(video.contains(words), "no {words} in {video}");
    }
    program(
        &place,
        "bad",
        "#!/bin/sh\nfor last; do :; done\necho half > \"$last\"\necho 'no such codec' >&2\nexit 3\n",
    );
    let (code, stdout, stderr) = place.run("bad out", "bad", &[]);
    assert!(
        code == 0 && stdout.contains("no video: ffmpeg failed") && stdout.contains("no such codec"),
        "{stdout}{stderr}"
    );
    let left = std::fs::read_dir(place.at("bad out")).expect("a folder").map(|e| e.expect("an entry").file_name());
    assert!(left.into_iter().all(|name| !name.to_string_lossy().contains("mp4")), "half a video is none");
    assert_eq!(film(&place.at("bad out").join("birds_film.png")).0.len(), 4);
}

#[cfg(unix)]
#[test]
fn ctrl_c_leaves_a_film_of_what_was_done() {
    let place = Place::new(SCENE);
    // A camera that stays where the scene says: what it sees of a few bodies is drawn at once, too.
    let args = ["--steps", "100000000", "--frames", "1000000", "--set", "picture.auto_frame=false"];
    let child = place.motes("out", "nothing", &args).stdout(Stdio::piped()).stderr(Stdio::null()).spawn();
    let child = child.expect("the program starts");
    let start = Instant::now();
    while place.frames("out").len() < 3 {
        assert!(start.elapsed() < Duration::from_mins(1), "the film does not begin");
        std::thread::sleep(Duration::from_millis(50));
    }
    let killed = Command::new("kill").args(["-INT", &child.id().to_string()]).status().expect("kill");
    assert!(killed.success());
    let Output { status, stdout, .. } = child.wait_with_output().expect("it ends");
    let stdout = String::from_utf8_lossy(&stdout);
    assert_eq!(status.code(), Some(75), "{stdout}");
    let frames = place.frames("out");
    // Six digits for a million.
    assert!(frames[2].ends_with("frame_000002.png"), "{}", frames[2].display());
    let (pictures, _) = film(&place.at("out").join("birds_film.png"));
    assert!(pictures.iter().eq(frames.iter().map(|f| rgb(f)).collect::<Vec<_>>().iter()), "{stdout}");
}

/// The notes are in the corners of frames and of pictures, each with its own time; what is between is as without them.
#[test]
fn notes_are_written_in_the_corners() {
    let place = Place::new(
        &SCENE
            .replace("width = 97\nheight = 65", "width = 320\nheight = 200")
            .replace("formats = []", "formats = [\"png\"]"),
    );
    for (out, notes) in [("plain", "false"), ("noted", "true")] {
        let set = format!("picture.annotate={notes}");
        let (code, _, err) = place.run(out, "nothing", &["-q", "--set", &set]);
        assert_eq!(code, 0, "{err}");
    }
    let pictures = |out: &str| {
        [place.frames(out), vec![place.at(out).join("picture_00.png"), place.at(out).join("picture_10.png")]].concat()
    };
    let mut changed = Vec::new();
    for (plain, noted) in pictures("plain").iter().zip(pictures("noted")) {
        let [plain, noted] = [rgb(plain), rgb(&noted)];
        let differs: Vec<usize> =
            (0..320 * 200).filter(|i| plain[3 * i..3 * i + 3] != noted[3 * i..3 * i + 3]).collect();
        assert!(differs.len() > 100, "{}", differs.len());
        let middle = differs.iter().filter(|i| (80..120).contains(&(**i / 320)));
        assert_eq!(middle.count(), 0, "notes are above and below the middle");
        changed.push(differs);
    }
    assert_eq!(changed.len(), 6, "four frames, two pictures");
    // Of a frame and a picture of the same step the notes are the same, and those of another time are not.
    assert!(changed[0] != changed[1] && changed[4] != changed[5]);
}
