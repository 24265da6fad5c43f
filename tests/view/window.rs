//! The window itself, with the events of a screen: `tests/run` gives it one, and runs this.

use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use egui::{Pos2, Vec2};

use super::BIN;
use super::hand::Hand;

/// What a machine under load may need.
const LIMIT: Duration = Duration::from_mins(2);

/// A window, closed at the end.
struct Window(Child);

impl Drop for Window {
    fn drop(&mut self) {
        // It may have ended by itself.
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// Asks again until there is an answer.
fn until<T>(what: &str, mut ask: impl FnMut() -> Option<T>) -> T {
    let begun = Instant::now();
    loop {
        if let Some(answer) = ask() {
            return answer;
        }
        assert!(begun.elapsed() < LIMIT, "after {} s: {what}", LIMIT.as_secs());
        std::thread::sleep(Duration::from_millis(250));
    }
}

/// What the program that moves the pointer says.
fn xdotool(args: &[&str]) -> Option<String> {
    let run = Command::new("xdotool").args(args).output().expect("xdotool");
    run.status.success().then(|| String::from_utf8_lossy(&run.stdout).trim().to_owned())
}

fn act(args: &[&str]) {
    assert!(xdotool(args).is_some(), "xdotool {args:?}");
    // Frames of a software adapter take as long.
    std::thread::sleep(Duration::from_millis(150));
}

fn drag(from: Pos2, by: Vec2) {
    let place = |at: Pos2| [at.x, at.y].map(|x| format!("{x:.0}"));
    let to = |at: Pos2| {
        let [x, y] = place(at);
        act(&["mousemove", &x, &y]);
    };
    to(from);
    act(&["mousedown", "1"]);
    to(from + 0.5 * by);
    to(from + by);
    act(&["mouseup", "1"]);
}

/// The pictures in a folder, by their names.
fn pictures(folder: &Path) -> Vec<String> {
    let files = std::fs::read_dir(folder).expect("a folder");
    let mut names: Vec<String> = files.filter_map(|file| file.ok()?.file_name().into_string().ok()).collect();
    names.retain(|name| Path::new(name).extension().is_some_and(|ending| ending == "png"));
    names.sort();
    names
}

/// Saves a picture by its key; its name and pixels.
fn taken(folder: &Path) -> (String, Vec<u8>) {
    let before = pictures(folder);
    act(&["key", "p"]);
    let name = until("no picture is saved", || pictures(folder).into_iter().find(|name| !before.contains(name)));
    let read = || {
        let file = std::fs::File::open(folder.join(&name)).ok()?;
        let mut reader = png::Decoder::new(std::io::BufReader::new(file)).read_info().ok()?;
        let mut pixels = vec![0; reader.output_buffer_size()?];
        reader.next_frame(&mut pixels).ok()?;
        Some(pixels)
    };
    let pixels = until("the picture cannot be read", read);
    (name, pixels)
}

fn differ(one: &[u8], two: &[u8]) -> f64 {
    assert_eq!(one.len(), two.len(), "pictures of other sizes");
    let others = one.iter().zip(two).filter(|(a, b)| a.abs_diff(**b) > 20).count();
    others as f64 / one.len() as f64
}

/// The time that its process has worked, in hundredths of a second.
fn ticks(window: &Window) -> u64 {
    let stat = std::fs::read_to_string(format!("/proc/{}/stat", window.0.id())).expect("a process");
    // The second field is a name in parentheses, which may have spaces.
    let (_, fields) = stat.rsplit_once(')').expect("a name");
    let number = |place: usize| fields.split_whitespace().nth(place).and_then(|field| field.parse::<u64>().ok());
    number(11).zip(number(12)).map(|(user, system)| user + system).expect("times")
}

/// The step in the name of a picture.
fn step(name: &str) -> u64 {
    name.split('_').nth(1).and_then(|part| part.trim_end_matches(".png").parse().ok()).expect("a step")
}

#[test]
#[ignore = "needs a screen, xdotool and xclip, which tests/run brings"]
fn a_window_is_dragged_changed_and_edited() {
    let folder = tempfile::tempdir().expect("a folder");
    let scene = folder.path().join("scene.toml");
    let text = "[simulation]\ndt = 0.01\nsteps = 100000\n[[particles]]\nshape = \"plummer\"\ncount = 300\n[[force]]\nkind = \"gravity\"\nsoftening = 0.05\n";
    std::fs::write(&scene, text).expect("a scene");
    let slider = Hand::on(&scene.to_string_lossy(), &[]).place_beside("size");
    let child = Command::new(BIN)
        .args(["view", "scene.toml", "--size", "820x1200"])
        .current_dir(folder.path())
        .stdout(Stdio::null())
        .spawn()
        .expect("the program");
    let mut window = Window(child);
    let id = until("no window is open", || {
        let ended = window.0.try_wait().expect("a process");
        assert!(ended.is_none(), "the program has ended before its window was open: {ended:?}");
        xdotool(&["search", "--name", "motes: scene"]).filter(|id| !id.is_empty())
    });
    act(&["windowmove", &id, "0", "0"]);
    act(&["windowfocus", &id]);
    // Without a window manager the focus stays where it is put.
    std::thread::sleep(Duration::from_secs(2));
    act(&["key", "space"]);
    let (name, before) = taken(folder.path());
    assert!(step(&name) > 0, "it runs: {name}");
    let (again, same) = taken(folder.path());
    assert!(step(&again) == step(&name) && differ(&before, &same) == 0.0, "it stands still: {name}, {again}");
    // When the exposure has settled, which takes a software adapter a while, nothing is drawn any more: it was a whole processor
    // where each frame asked for the next, and a good part of one where each look at the files did.
    until("it works on at rest", || {
        let begun = ticks(&window);
        std::thread::sleep(Duration::from_secs(3));
        (ticks(&window) - begun < 30).then_some(())
    });
    act(&["key", "c"]);
    let command = until("no command is on the clipboard", || {
        let run = Command::new("xclip").args(["-o", "-selection", "clipboard"]).output().expect("xclip");
        Some(String::from_utf8_lossy(&run.stdout).into_owned()).filter(|text| !text.is_empty())
    });
    assert_eq!(command.trim(), "motes view scene.toml");
    // Balls that overlap look the same from many sides: some of the pixels change.
    drag(Pos2::new(250.0, 600.0), Vec2::new(80.0, 10.0));
    let (_, turned) = taken(folder.path());
    assert!(differ(&before, &turned) > 0.005, "a drag turns the camera: {}", differ(&before, &turned));
    drag(slider, Vec2::new(30.0, 0.0));
    let (_, larger) = taken(folder.path());
    let light = |rgb: &[u8]| rgb.iter().map(|byte| f64::from(*byte)).sum::<f64>() / rgb.len() as f64;
    assert!(
        light(&larger) > 1.1 * light(&turned),
        "larger balls are brighter: {} after {}",
        light(&larger),
        light(&turned)
    );
    // A fault is no end, and is tried again when the file comes that was missing.
    let law = "\n[[force]]\nwgsl = \"law.wgsl\"\nover = \"each\"\n";
    std::fs::write(&scene, format!("{text}{law}")).expect("a scene");
    std::thread::sleep(Duration::from_secs(2));
    let (still, _) = taken(folder.path());
    assert_eq!(step(&still), step(&name), "what ran before is there");
    std::fs::write(
        folder.path().join("law.wgsl"),
        "fn force(me: Particle) -> vec4f { return vec4f(-me.position, 0.0); }\n",
    )
    .expect("a law");
    until("the law does not begin the scene again", || (step(&taken(folder.path()).0) == 0).then_some(()));
    assert!(window.0.try_wait().expect("a process").is_none(), "the window has closed");
}
