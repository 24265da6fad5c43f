//! The contact sheet of the scenes: a smaller copy of the picture of each, in their order. `UPDATE=1` writes it.

use std::fs::File;
use std::io::{BufReader, BufWriter};
use std::path::Path;

use egui::{Key, Modifiers};
use motes::scene::SCENES;
use motes::view::gallery::{CELL, COLUMNS};

use super::hand::Hand;

/// Red, green and blue of a picture, and its size.
struct Rgb {
    bytes: Vec<u8>,
    size: [usize; 2],
}

fn read(path: &Path) -> Rgb {
    let file = File::open(path).unwrap_or_else(|why| panic!("{}: {why}", path.display()));
    let mut decoder = png::Decoder::new(BufReader::new(file));
    decoder.set_transformations(png::Transformations::normalize_to_color8());
    let mut reader = decoder.read_info().expect("a PNG");
    let mut bytes = vec![0; reader.output_buffer_size().expect("a size")];
    let info = reader.next_frame(&mut bytes).expect("pixels");
    let each = info.color_type.samples();
    assert!(each >= 3, "{}: it has no colours", path.display());
    let bytes = bytes.chunks_exact(each).flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect();
    Rgb { bytes, size: [info.width as usize, info.height as usize] }
}

/// A smaller copy of the middle of a picture, cut to the shape of a cell: means of rectangles.
fn smaller(picture: &Rgb) -> Vec<u8> {
    let [width, height] = picture.size;
    let wide = width.min(height * CELL[0] / CELL[1]);
    let high = height.min(width * CELL[1] / CELL[0]);
    let from = [(width - wide) / 2, (height - high) / 2];
    let end = |k: usize, all: usize, side: usize| k * all / side;
    let mut cell = Vec::new();
    for y in 0..CELL[1] {
        for x in 0..CELL[0] {
            let columns = from[0] + end(x, wide, CELL[0])..from[0] + end(x + 1, wide, CELL[0]);
            let rows = from[1] + end(y, high, CELL[1])..from[1] + end(y + 1, high, CELL[1]);
            let count = columns.len() * rows.len();
            cell.extend((0..3).map(|channel| {
                let at = |x: usize, y: usize| usize::from(picture.bytes[3 * (y * width + x) + channel]);
                let sum: usize = rows.clone().flat_map(|y| columns.clone().map(move |x| at(x, y))).sum();
                u8::try_from((sum + count / 2) / count).expect("a byte")
            }));
        }
    }
    cell
}

#[test]
fn the_contact_sheet_shows_the_picture_of_every_scene() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let sheet = root.join("contact.png");
    let (wide, high) = (COLUMNS * CELL[0], SCENES.len().div_ceil(COLUMNS) * CELL[1]);
    let mut wanted = vec![0; 3 * wide * high];
    for (place, scene) in SCENES.iter().enumerate() {
        let cell = smaller(&read(&root.join("pictures").join(format!("{}.png", scene.name))));
        let corner = [place % COLUMNS * CELL[0], place / COLUMNS * CELL[1]];
        for (y, row) in cell.chunks_exact(3 * CELL[0]).enumerate() {
            let at = 3 * ((corner[1] + y) * wide + corner[0]);
            wanted[at..at + row.len()].copy_from_slice(row);
        }
    }
    if std::env::var_os("UPDATE").is_some() {
        let (columns, rows) = (u32::try_from(wide).expect("a width"), u32::try_from(high).expect("a height"));
        let mut encoder = png::Encoder::new(BufWriter::new(File::create(&sheet).expect("a file")), columns, rows);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_compression(png::Compression::High);
        encoder.write_header().and_then(|mut writer| writer.write_image_data(&wanted)).expect("a PNG");
    }
    let found = read(&sheet);
    assert_eq!(found.size, [wide, high], "UPDATE=1 writes it");
    let differ = found.bytes.iter().zip(&wanted).position(|(a, b)| a != b);
    let scene = differ.map(|byte| {
        let (x, y) = (byte / 3 % wide, byte / 3 / wide);
        SCENES[y / CELL[1] * COLUMNS + x / CELL[0]].name
    });
    assert_eq!(scene, None, "it is not the picture of this scene: UPDATE=1 writes it");
}

#[test]
fn a_click_on_a_picture_opens_its_scene() {
    let mut hand = Hand::on("plummer", &["particles.0.count=10"]);
    hand.key(Key::L, Modifiers::NONE);
    hand.frames(2);
    assert!(!hand.shows("merger"), "without a contact sheet there are none");
    hand.key(Key::L, Modifiers::NONE);
    hand.contact();
    hand.key(Key::L, Modifiers::NONE);
    hand.frames(20);
    let place = hand.place_beside("galaxy");
    hand.click(place);
    hand.frames(1);
    assert_eq!(hand.wanted().as_deref(), Some("galaxy"));
}
