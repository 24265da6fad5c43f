//! What is written on a picture: the time, a bar of length, the directions of the axes, and the scale of colours.

use glam::{DVec2, DVec3};
use noto_sans_mono_bitmap::{FontWeight, RasterHeight, get_raster, get_raster_width};

use super::heading;
use super::palette::value_color;
use super::{Color, Image, Picture};

/// The longest bar of length, as a part of the width.
const BAR: f64 = 0.2;
/// The opacity of the outline of letters.
const SHADE: f64 = 0.4;
/// The opacity of the outline of the box.
const OUTLINE: f64 = 0.5;
/// The shorter side of a picture below which nothing is written, in lines of text.
const LEAST: f64 = 12.0;
/// The width of the scale of speeds, and that of a picture below which it is left out, in lines of text.
const SCALE: [f64; 2] = [11.0, 20.0];

impl Image {
    /// Writes on it, in its corners: the time \[time\], or the redshift where space expands, the axes x, y and z as they are seen, a bar with its length at the centre of the
    /// picture \[length\], and the scale of speeds or headings where colours show them; and the outline of a box that is closed along every axis. Nothing is written on pictures of less than 192 pixels, and no scale
    /// on those of less than 320 pixels from left to right.
    pub fn annotate(&mut self, picture: &Picture, time: f64) {
        let (width, height) = (f64::from(self.width), f64::from(self.height));
        let short = width.min(height);
        let size = match short {
            x if x < 500.0 => RasterHeight::Size16,
            x if x < 1000.0 => RasterHeight::Size24,
            _ => RasterHeight::Size32,
        };
        let line = size.val() as f64;
        if short < LEAST * line {
            return;
        }
        let mut pen = Pen { size, line, dark: false, image: self };
        let edges = picture.outline();
        if !edges.is_empty() {
            pen.over(DVec2::ZERO, DVec2::new(width, height));
            let [ink, _] = pen.ink();
            edges.into_iter().for_each(|edge| pen.thin(edge, ink));
        }
        let (low, right) = (height - 0.75 * line, width - 0.75 * line);
        pen.over(DVec2::new(0.0, height - 2.0 * line), DVec2::new(8.0 * line, height));
        pen.text(&picture.moment(time), DVec2::new(0.75 * line, low - line));
        pen.over(DVec2::ZERO, DVec2::splat(6.0 * line));
        pen.axes(picture, DVec2::new(3.0 * line, 3.0 * line));
        pen.over(DVec2::new((1.0 - BAR) * width, height - 2.0 * line), DVec2::new(width, height));
        pen.bar(picture.bar(), DVec2::new(right, low));
        // A style may have no use for colours.
        if width < SCALE[1] * line || picture.style().unused().contains(&"color") {
            return;
        }
        pen.over(DVec2::new(width - SCALE[0] * line, 0.0), DVec2::new(width, 3.0 * line));
        pen.scale(&picture.color, DVec2::new(right, 0.75 * line));
    }
}

impl Picture {
    /// The time in words, or the redshift.
    fn moment(&self, time: f64) -> String {
        match &self.expansion {
            // To the digits that are worth something, and no −0 at the end of a run.
            Some(expansion) => format!("z = {:.2}", (1.0 / expansion.scale_factor(time) - 1.0 + 1e-9).max(-1.0)),
            None => format!("t = {}", number(time)),
        }
    }
    /// The outline of a closed box, as it is seen \[pixels\]; of a fluid it is drawn already.
    pub(crate) fn outline(&self) -> Vec<[DVec2; 2]> {
        let is_drawn = self.frame.water.is_there();
        let edges = if is_drawn { Vec::new() } else { self.facets().tank_edges(&self.frame) };
        edges.iter().map(super::tank::Edge::places).collect()
    }
    /// A bar of a round length at the centre: how long it is \[pixels\], and the length in words.
    pub(crate) fn bar(&self) -> Option<(f64, String)> {
        let scale = self.frame.scale();
        let length = round_length(BAR * f64::from(self.frame.width) / scale)?;
        Some((length * scale, number(length)))
    }
}

/// Draws letters and lines.
struct Pen<'a> {
    image: &'a mut Image,
    size: RasterHeight,
    /// The height of a line of text \[pixels\].
    line: f64,
    /// Whether it draws dark on bright.
    dark: bool,
}

impl Pen<'_> {
    /// Chooses light or dark letters for a part of the picture.
    fn over(&mut self, low: DVec2, high: DVec2) {
        let size = DVec2::new(f64::from(self.image.width), f64::from(self.image.height));
        let [from, to] = [low, high].map(|corner| corner.clamp(DVec2::ZERO, size).to_array().map(super::frame::whole));
        let (mut light, mut count) = (0_u64, 0_u64);
        for row in
            self.image.rgba.chunks_exact(4 * self.image.width as usize).take(to[1] as usize).skip(from[1] as usize)
        {
            for pixel in row.chunks_exact(4).take(to[0] as usize).skip(from[0] as usize) {
                light += pixel[..3].iter().map(|byte| u64::from(*byte)).sum::<u64>();
                count += 3;
            }
        }
        self.dark = light > 150 * count;
    }
    /// The width of a text \[pixels\].
    fn width(&self, text: &str) -> f64 {
        (text.chars().count() * get_raster_width(FontWeight::Regular, self.size)) as f64
    }
    /// Covers a part of a pixel with a colour; pixels beyond the edges are left out.
    fn cover(&mut self, x: f64, y: f64, color: DVec3, part: f64) {
        let inside =
            (0.0..f64::from(self.image.width)).contains(&x) && (0.0..f64::from(self.image.height)).contains(&y);
        if !inside || part <= 0.0 {
            return;
        }
        let at = 4 * (super::frame::whole(y) as usize * self.image.width as usize + super::frame::whole(x) as usize);
        for (byte, to) in self.image.rgba[at..at + 3].iter_mut().zip(color.to_array()) {
            let mixed = f64::from(*byte) * (1.0 - part) + 255.0 * to * part;
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between two bytes")]
            let rounded = mixed.clamp(0.0, 255.0).round() as u8;
            *byte = rounded;
        }
    }
    fn ink(&self) -> [DVec3; 2] {
        let (light, dark) = (DVec3::splat(0.95), DVec3::splat(0.05));
        if self.dark { [dark, light] } else { [light, dark] }
    }
    /// A text with its upper left corner at a place, in an outline of one pixel.
    fn text(&mut self, text: &str, at: DVec2) {
        let [ink, shade] = self.ink();
        let step = get_raster_width(FontWeight::Regular, self.size) as f64;
        let round = [DVec2::X, DVec2::Y, -DVec2::X, -DVec2::Y, DVec2::ONE, DVec2::NEG_ONE];
        let layers = round.map(|shift| (shade, SHADE, shift)).into_iter().chain([(ink, 1.0, DVec2::ZERO)]);
        for (color, part, shift) in layers {
            for (n, letter) in text.chars().enumerate() {
                // A unit of a user's column may have letters that the font lacks.
                let of = |letter| get_raster(letter, FontWeight::Regular, self.size);
                let Some(raster) = of(letter).or_else(|| of('?')) else { continue };
                let from = at.round() + DVec2::new(n as f64 * step, 0.0) + shift;
                for (y, row) in raster.rows().enumerate() {
                    for (x, value) in row.iter().enumerate() {
                        let here = from + DVec2::new(x as f64, y as f64);
                        self.cover(here.x, here.y, color, part * f64::from(*value) / 255.0);
                    }
                }
            }
        }
    }
    /// A line of a tenth of the height of the text.
    fn stroke(&mut self, from: DVec2, to: DVec2, color: DVec3) {
        let half = 0.05 * self.line;
        let (low, high) = ((from.min(to) - half - 1.0).floor(), (from.max(to) + half + 1.0).ceil());
        let along = to - from;
        let mut y = low.y;
        while y <= high.y {
            let mut x = low.x;
            while x <= high.x {
                let r = DVec2::new(x, y) + 0.5 - from;
                let part = (r.dot(along) / along.length_squared().max(1e-9)).clamp(0.0, 1.0);
                self.cover(x, y, color, (half + 0.5 - r.distance(part * along)).clamp(0.0, 1.0));
                x += 1.0;
            }
            y += 1.0;
        }
    }
    /// A line of one pixel, as far as it is in the picture, through which one can see.
    fn thin(&mut self, [from, to]: [DVec2; 2], color: DVec3) {
        let size = DVec2::new(f64::from(self.image.width), f64::from(self.image.height));
        let steps = (to - from).abs().max_element();
        // Of lines from far away the part within the picture is found first.
        let (mut first, mut last) = (0.0_f64, 1.0_f64);
        for k in 0..2 {
            let way = to[k] - from[k];
            let at = [-1.0, size[k]].map(|end| (end - from[k]) / way);
            if way.abs() > 1e-9 {
                (first, last) = (first.max(at[0].min(at[1])), last.min(at[0].max(at[1])));
            }
        }
        let across = if (to.x - from.x).abs() > (to.y - from.y).abs() { DVec2::Y } else { DVec2::X };
        let mut step = (first * steps).floor();
        while steps > 0.0 && step <= last * steps {
            let at = from + (to - from) * (step / steps).min(1.0);
            let low = (at - 0.5).dot(across).floor();
            for near in [low, low + 1.0] {
                let part = 1.0 - (at.dot(across) - 0.5 - near).abs();
                let place = at * (DVec2::ONE - across) + across * near;
                self.cover(place.x, place.y, color, OUTLINE * part);
            }
            step += 1.0;
        }
    }
    /// The axes from a place, those towards the eye last; an axis along the line of sight is a point.
    fn axes(&mut self, picture: &Picture, at: DVec2) {
        let camera = &picture.frame.camera;
        let mut axes = [(DVec3::X, "x"), (DVec3::Y, "y"), (DVec3::Z, "z")];
        axes.sort_by(|a, b| a.0.dot(camera.back).total_cmp(&b.0.dot(camera.back)));
        let [ink, _] = self.ink();
        for (axis, name) in axes {
            let seen = DVec2::new(axis.dot(camera.right), -axis.dot(camera.up));
            self.stroke(at, at + 1.5 * self.line * seen, ink);
            if seen.length() > 0.3 {
                let middle = at + (1.5 * seen + 0.5 * seen.normalize_or_zero()) * self.line;
                self.text(name, middle - 0.5 * DVec2::new(self.width(name), self.line));
            }
        }
    }
    /// A bar of a round length, with its right end at a place, and the length above it.
    fn bar(&mut self, bar: Option<(f64, String)>, at: DVec2) {
        let Some((pixels, text)) = bar else { return };
        let [ink, _] = self.ink();
        let (from, tick) = (at - DVec2::new(pixels, 0.0), DVec2::new(0.0, 0.25 * self.line));
        self.stroke(from, at, ink);
        [from, at].into_iter().for_each(|end| self.stroke(end - tick, end, ink));
        self.text(&text, 0.5 * (from + at) - DVec2::new(0.5 * self.width(&text), 1.4 * self.line));
    }
    /// The scale of values with its title and the numbers at its ends, with its right upper corner at a place. A title that has no room between them stands below.
    fn ramp(&mut self, [title, low, high]: [&str; 3], at: DVec2) {
        let (wide, thick) = (SCALE[0] * self.line, 0.6 * self.line);
        let from = at - DVec2::new(wide, 0.0);
        let mut x = 0.0;
        while x < wide {
            let color = value_color(x / wide);
            let mut y = 0.0;
            while y < thick {
                self.cover(from.x + x, from.y + y, color, 1.0);
                y += 1.0;
            }
            x += 1.0;
        }
        let below = from + DVec2::new(0.0, thick + 0.1 * self.line);
        self.text(low, below);
        self.text(high, below + DVec2::new(wide - self.width(high), 0.0));
        let room = wide - 2.0 * self.width(low).max(self.width(high)) - self.line;
        let lower = if self.width(title) > room { self.line } else { 0.0 };
        self.text(title, below + DVec2::new((0.5 * (wide - self.width(title))).min(wide - self.width(title)), lower));
    }
    /// The scale of colours, with its right upper corner at a place.
    fn scale(&mut self, color: &Color, at: DVec2) {
        match color {
            Color::Given(_) | Color::Column(_) => {}
            // The scale of particles of one speed is widened by as much as a number is rounded.
            Color::Speed { slow, fast } => {
                self.ramp(["speed", &number(slow.max(0.0)), &number(if *fast < 1e-30 { 0.0 } else { *fast })], at);
            }
            Color::Value(scaled) => {
                self.ramp([&scaled.title(), &number(scaled.low), &number(scaled.high)], at);
            }
            Color::Heading => {
                let radius = 1.2 * self.line;
                let middle = at + DVec2::new(-2.0 * radius, radius);
                let mut y = -radius;
                while y <= radius {
                    let mut x = -radius;
                    while x <= radius {
                        let r = DVec2::new(x, y);
                        let edge = (radius - r.length()).min(r.length() - 0.5 * radius).clamp(0.0, 1.0);
                        let color = heading::tint(DVec3::new(x, -y, 0.0).extend(0.0));
                        self.cover(middle.x + x, middle.y + y, color, edge);
                        x += 1.0;
                    }
                    y += 1.0;
                }
                let text = "heading in xy";
                let place = DVec2::new(at.x - self.width(text), at.y + 2.1 * radius);
                self.text(text, place);
            }
        }
    }
}

/// The largest of 1, 2 and 5 times a power of ten up to a length; `None` if it has none.
fn round_length(most: f64) -> Option<f64> {
    if !(most.is_finite() && most > 0.0) {
        return None;
    }
    let power = 10_f64.powf(most.log10().floor());
    [5.0, 2.0, 1.0].into_iter().map(|n| n * power).find(|length| *length <= most)
}

/// Four significant digits at most, without zeros at the end.
fn number(x: f64) -> String {
    if x != 0.0 && !(1e-3..1e5).contains(&x.abs()) {
        return format!("{x:.1e}");
    }
    let rounded: f64 = format!("{x:.3e}").parse().unwrap_or(x);
    rounded.to_string()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::{KEYS, Trail};
    use crate::settings::{Settings, Value};
    use crate::state::State;

    /// A picture of 10 by 5 lengths, on which a length is 64 pixels, and a black image of its size.
    fn blank(color: &'static str, eye: DVec3) -> (Picture, Image) {
        let mut particles = State::default();
        for x in [0.0, 1.0] {
            particles.push(DVec3::X * x, DVec3::Y * (1.0 + 3.0 * x), 1.0, 0.0);
        }
        let settings = Settings::defaults(KEYS)
            .with("width", 640.0.into())
            .with("height", 320.0.into())
            .with("auto_frame", false.into())
            .with("extent", 2.5.into())
            .with("eye", Value::Vector(eye))
            .with("color", Value::Text(color.into()));
        let picture = Picture::new(&settings, &particles, &[], Trail::new(0)).expect("a picture");
        let image = Image { width: 640, height: 320, rgba: vec![0; 640 * 320 * 4], outside: 0, broken: 0 };
        (picture, image)
    }
    fn lit(image: &Image, from: [usize; 2], to: [usize; 2]) -> Vec<[usize; 2]> {
        let all = (from[1]..to[1]).flat_map(|y| (from[0]..to[0]).map(move |x| [x, y]));
        all.filter(|[x, y]| image.rgba[4 * (y * 640 + x)] > 128).collect()
    }

    #[test]
    fn lengths_are_round_and_numbers_short() {
        for (most, length) in [(0.99, 0.5), (1.0, 1.0), (19.0, 10.0), (20.5, 20.0), (0.0053, 0.005), (7.3e9, 5e9)] {
            let got = round_length(most).expect("one");
            assert!((got / length - 1.0).abs() < 1e-12, "{most}: {got}");
        }
        assert_eq!([f64::NAN, 0.0, -1.0, f64::INFINITY].map(round_length), [None; 4]);
        let texts = [0.0, 1.5, 12.346, 0.25, 0.0015, 0.002_449, 12_345.6, 0.00012, -3.0, 1e6, 999.96].map(number);
        assert_eq!(
            texts,
            ["0", "1.5", "12.35", "0.25", "0.0015", "0.002449", "12350", "1.2e-4", "-3", "1.0e6", "1000"]
        );
    }

    /// A fifth of 640 pixels is 128, two lengths of 64: the bar has them between its ticks.
    #[test]
    fn units_of_columns_have_all_their_letters() {
        let units = crate::forces::entries().flat_map(|entry| (entry.build)(&Settings::defaults(entry.keys)).columns());
        let lacks: Vec<_> = units
            .filter(|column| {
                column.unit.chars().any(|c| get_raster(c, FontWeight::Regular, RasterHeight::Size16).is_none())
            })
            .map(|column| column.unit.to_string())
            .collect();
        assert_eq!(lacks, [""; 0]);
        let (_, mut image) = blank("group", DVec3::Z);
        let before = image.rgba.clone();
        Pen { size: RasterHeight::Size16, line: 16.0, dark: false, image: &mut image }.text("ξ", DVec2::splat(20.0));
        assert_ne!(image.rgba, before, "a letter that the font lacks leaves no gap");
    }
    #[test]
    fn the_bar_is_as_long_as_it_says() {
        let (picture, mut image) = blank("group", DVec3::Z);
        image.annotate(&picture, 0.0);
        let row: Vec<_> = lit(&image, [320, 308], [640, 309]).into_iter().map(|[x, _]| x).collect();
        let (first, last) = (row[0], row[row.len() - 1]);
        assert!((127..=131).contains(&(last - first)) && row.len() == last - first + 1, "{row:?}");
    }

    /// The pixels of a corner change with what it shows, and with nothing else.
    #[test]
    fn corners_show_the_time_the_axes_and_the_colours() {
        let drawn = |color, eye, time| {
            let (picture, mut image) = blank(color, eye);
            image.annotate(&picture, time);
            let corners =
                [([0, 0], [160, 100]), ([480, 0], [640, 100]), ([0, 220], [320, 320]), ([320, 220], [640, 320])];
            corners.map(|(from, to)| lit(&image, from, to))
        };
        let plain = drawn("group", DVec3::Z, 1.5);
        assert!(!plain[0].is_empty() && plain[1].is_empty() && !plain[2].is_empty() && !plain[3].is_empty());
        let differs = |other: [Vec<[usize; 2]>; 4]| {
            let pairs = plain.iter().zip(&other);
            pairs.map(|(a, b)| a != b).collect::<Vec<_>>()
        };
        assert_eq!(differs(drawn("group", DVec3::Z, 2.5)), [false, false, true, false]);
        assert_eq!(differs(drawn("group", DVec3::X, 1.5)), [true, false, false, false]);
        assert_eq!(differs(drawn("speed", DVec3::Z, 1.5)), [false, true, false, false]);
        assert_eq!(differs(drawn("heading", DVec3::Z, 1.5)), [false, true, false, false]);
        // Surface density has no colours of speeds.
        let (mut picture, mut image) = blank("speed", DVec3::Z);
        picture = picture.styled("density");
        image.annotate(&picture, 1.5);
        assert!(lit(&image, [480, 0], [640, 100]).is_empty());
    }

    /// A closed box of 2 by 1 lengths about the middle has its sides where they are, and no others.
    #[test]
    fn a_closed_box_is_outlined() {
        let (mut picture, mut image) = blank("group", DVec3::Z);
        let (low, high) = (DVec3::new(-1.0, -0.5, 0.0), DVec3::new(1.0, 0.5, 0.0));
        let bounds = crate::kernel::Bounds::new(low, high, crate::kernel::Side::Periodic);
        picture.frame.camera.center = DVec3::ZERO;
        picture.frame.camera.distance = 0.0;
        picture.contain(crate::render::Scenery::default().within(&bounds).tanks);
        image.annotate(&picture, 0.0);
        let bright = |x: usize, y: usize| image.rgba[4 * (y * 640 + x)] > 40;
        // The middle is at 320 and 160, and a length is 64 pixels; the line covers half of both pixels beside it.
        for x in [260, 300, 380] {
            let rows: Vec<usize> = (110..210).filter(|y| bright(x, *y)).collect();
            assert_eq!(rows, [127, 128, 191, 192], "column {x}");
        }
        let columns: Vec<usize> = (240..400).filter(|x| bright(*x, 150)).collect();
        assert_eq!(columns, [255, 256, 383, 384]);
    }

    /// Letters are light on dark and dark on light, and small pictures are left as they are.
    #[test]
    fn letters_stand_out_and_small_pictures_stay() {
        let (picture, mut image) = blank("group", DVec3::Z);
        image.rgba.fill(250);
        image.annotate(&picture, 0.0);
        assert!(image.rgba.iter().any(|byte| *byte < 40));
        let mut small = Image { width: 127, height: 400, rgba: vec![7; 127 * 400 * 4], outside: 0, broken: 0 };
        small.annotate(&picture, 0.0);
        assert!(small.rgba.iter().all(|byte| *byte == 7));
    }
}
