//! Files that are cut off or damaged: each is a plan or an error, and none a panic or a long wait.

use motes::formats::floor_plan::{self, Measure, Scale};
use proptest::prelude::*;
use proptest::sample::Index;

use super::rooms;

/// Pieces of files that may stand anywhere.
const PIECES: &[&str] = &[
    "<g>",
    "</g>",
    "<use href=\"#room\"/>",
    "<use href=\"#a\"/>",
    "<g id=\"a\">",
    "transform=\"scale(1e30)\"",
    "transform=\"matrix(0 0 0 0 1 1)\"",
    "stroke-width=\"1e9\"",
    "d=\"M 0 0 L 1e38 1e38 A 1 1 0 0 0 5 5 Z\"",
    "class=\"walls\"",
    "id=\"floor\"",
    "viewBox=\"0 0 1e9 1\"",
    "width=\"1e30mm\"",
    "clip-path=\"url(#c)\"",
    "<clipPath id=\"c\"><path d=\"M 0 0 L 9 9 L 0 9\"/></clipPath>",
    "stroke-dasharray=\"1e-9\"",
    "&ink;",
    "NaN",
    "1e308",
    "-1e308",
    "-",
    "\"coordinates\": ",
    "[[[",
    "]]",
    "null",
    "\"type\": \"Polygon\", ",
    "0\nINSERT\n2\nPOST\n10\n0\n20\n0\n70\n1000\n71\n1000\n",
    "0\nSEQEND\n",
    "0\nEOF\n",
    "42\n1e300\n",
    "41\n1e15\n",
    "0\nARC\n8\nwalls\n10\n0\n20\n0\n40\n1e15\n50\n0\n51\n1\n",
    "67\n1\n",
    "230\n-1\n",
    "\n",
    "\0",
    "é",
];

fn good() -> [String; 6] {
    let strokes = rooms::STROKES.replace("viewBox", "width=\"244mm\" height=\"104mm\" viewBox");
    [&strokes, rooms::PAPER, rooms::NAMED, &rooms::dxf(), rooms::FEATURES, rooms::WALLS].map(str::to_owned)
}

/// Whether bytes are a plan; of a scale, so that drawings come to the grid.
fn survives(bytes: &[u8]) -> bool {
    let scales = [None, Some(Scale::Unit(0.01)), Some(Scale::Paper(100.0))];
    let mut is_plan = false;
    for scale in scales {
        // Features without walls have no pixels.
        let pixel = if bytes.starts_with(b"{") && scale.is_none() { None } else { Some(0.1) };
        match floor_plan::read(bytes, &Measure { scale, pixel }) {
            Ok(_) => is_plan = true,
            Err(why) => assert!(why.len() > 9, "{why}"),
        }
    }
    is_plan
}

/// A file that is cut off is an error, but for what follows its last shape.
#[test]
fn what_is_cut_off_is_refused() {
    for text in good() {
        assert!(survives(text.as_bytes()), "{text}");
        let end = text.trim_end().len();
        for at in (0..end).step_by(7) {
            assert!(!survives(&text.as_bytes()[..at]), "{at}: {}", &text[..at]);
        }
    }
}

fn mutated() -> impl Strategy<Value = Vec<u8>> {
    let change = (any::<Index>(), any::<Index>(), 0..4_u8, any::<Index>(), any::<u8>());
    (any::<Index>(), proptest::collection::vec(change, 1..6)).prop_map(|(file, changes)| {
        let all = good();
        let mut bytes = all[file.index(all.len())].clone().into_bytes();
        for (at, length, kind, piece, byte) in changes {
            if bytes.is_empty() {
                break;
            }
            let start = at.index(bytes.len());
            let end = (start + length.index(30)).min(bytes.len());
            match kind {
                0 => drop(bytes.drain(start..end)),
                1 => drop(bytes.splice(start..end, PIECES[piece.index(PIECES.len())].bytes())),
                2 => bytes[start] = byte,
                _ => {
                    let copy = bytes[start..end].to_vec();
                    let to = piece.index(bytes.len());
                    drop(bytes.splice(to..to, copy));
                }
            }
        }
        bytes
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1500, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_mutation(bytes in mutated()) {
        survives(&bytes);
    }

    #[test]
    fn any_pieces(pieces in proptest::collection::vec(proptest::sample::select(PIECES), 0..20), start in 0..4_usize) {
        let begins = ["<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 9 9\">", "{", "0\n", ""];
        survives(format!("{}{}", begins[start], pieces.concat()).as_bytes());
    }
}

/// Drawings that grow by repetition: each level is drawn ten times by the next one, chains are long, and clip paths are within each other.
#[test]
fn what_grows_without_end_is_refused() {
    let svg = |body: &str| format!("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 9 9\">{body}</svg>");
    let level = |n: usize| format!("<g id=\"g{}\">{}</g>", n + 1, format!("<use href=\"#g{n}\"/>").repeat(10));
    let mut laughs = "<rect id=\"g0\" width=\"9\" height=\"9\"/>".to_owned();
    laughs.extend((0..9).map(level));
    let chain: Vec<String> = (0..3000).map(|n| format!("<g id=\"u{n}\"><use href=\"#u{}\"/></g>", n + 1)).collect();
    let circle = "<g id=\"a\"><use href=\"#b\"/></g><g id=\"b\"><use href=\"#a\"/></g>";
    let clips: Vec<String> = (0..3000)
        .map(|n| {
            format!("<clipPath id=\"c{n}\" clip-path=\"url(#c{})\"><rect width=\"9\" height=\"9\"/></clipPath>", n + 1)
        })
        .collect();
    let clips = format!("{}<rect width=\"9\" height=\"9\" clip-path=\"url(#c0)\"/>", clips.concat());
    let nested = format!("{}{}", "<g>".repeat(100_000), "</g>".repeat(100_000));
    for body in [laughs, chain.concat(), circle.to_owned(), clips, nested] {
        survives(svg(&body).as_bytes());
    }
    let mut blocks = "0\nSECTION\n2\nBLOCKS\n".to_owned();
    for n in 0..12 {
        let insert = format!("0\nINSERT\n2\nB{}\n10\n0\n20\n0\n", n + 1);
        blocks += &format!("0\nBLOCK\n2\nB{n}\n{}0\nENDBLK\n", insert.repeat(10));
    }
    blocks += "0\nBLOCK\n2\nB12\n0\nLINE\n10\n0\n20\n0\n11\n1\n21\n1\n0\nENDBLK\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n0\nINSERT\n2\nB0\n10\n0\n20\n0\n0\nENDSEC\n0\nEOF\n";
    let said = floor_plan::read(blocks.as_bytes(), &Measure::default()).expect_err("too much");
    assert!(said.contains("more than 2000000 points and entities"), "{said}");
}
