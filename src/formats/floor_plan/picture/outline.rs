//! Outlines of areas of pixels. Places are in pixels, to the right and down from the upper left corner.

use std::collections::VecDeque;

use glam::{DMat2, DVec2};

const NONE: u8 = u8::MAX;
const UNSEEN: u32 = u32::MAX;

/// A closed outline.
pub struct Ring {
    /// The middles of the sides of pixels along it.
    pub points: Vec<DVec2>,
    pub is_hole: bool,
    /// The number of the area around or within it.
    pub area: u32,
}

/// All outlines of the areas of a kind, which touch each other nowhere.
pub fn rings(mask: &[u8], width: usize, height: usize, is_in: impl Fn(u8) -> bool) -> Vec<Ring> {
    let inside = |x: usize, y: usize| x < width && y < height && is_in(mask[y * width + x]);
    let area = numbered(width, height, &inside);
    // From each corner of pixels the direction of the side that begins there: right, down, left or up, with the area at its right hand.
    let across = width + 1;
    let mut out = vec![NONE; across * (height + 1)];
    for y in 0..height {
        for x in (0..width).filter(|x| inside(*x, y)) {
            let beside = |dx: usize, dy: usize| inside((x + dx).wrapping_sub(1), (y + dy).wrapping_sub(1));
            let corner = |dx: usize, dy: usize| (y + dy) * across + x + dx;
            let sides = [
                (beside(1, 0), corner(0, 0)),
                (beside(2, 1), corner(1, 0)),
                (beside(1, 2), corner(1, 1)),
                (beside(0, 1), corner(0, 1)),
            ];
            for ((shut, corner), direction) in sides.into_iter().zip(0..) {
                if !shut {
                    out[corner] = direction;
                }
            }
        }
    }
    let mut all = Vec::new();
    for start in 0..out.len() {
        if out[start] == NONE {
            continue;
        }
        let (x, y) = (start % across, start / across);
        // The pixel at the right hand of the first side.
        let pixel = match out[start] {
            0 => y * width + x,
            1 => y * width + x - 1,
            2 => (y - 1) * width + x - 1,
            _ => (y - 1) * width + x,
        };
        let (mut at, mut points, mut twice) = (start, Vec::new(), 0.0);
        while out[at] != NONE {
            let direction = std::mem::replace(&mut out[at], NONE);
            let next = match direction {
                0 => at + 1,
                1 => at + across,
                2 => at - 1,
                _ => at - across,
            };
            let [a, b] = [at, next].map(|k| DVec2::new((k % across) as f64, (k / across) as f64));
            twice += a.perp_dot(b);
            points.push(0.5 * (a + b));
            at = next;
        }
        all.push(Ring { points, is_hole: twice < 0.0, area: area[pixel] });
    }
    all
}

/// The number of the area of each pixel, by sides.
fn numbered(width: usize, height: usize, inside: &impl Fn(usize, usize) -> bool) -> Vec<u32> {
    let mut numbers = vec![UNSEEN; width * height];
    let (mut count, mut left) = (0, VecDeque::new());
    for start in 0..numbers.len() {
        if numbers[start] != UNSEEN || !inside(start % width, start / width) {
            continue;
        }
        numbers[start] = count;
        left.push_back(start);
        while let Some(at) = left.pop_front() {
            let (x, y) = (at % width, at / width);
            for (x, y) in [(x.wrapping_sub(1), y), (x + 1, y), (x, y.wrapping_sub(1)), (x, y + 1)] {
                if inside(x, y) && numbers[y * width + x] == UNSEEN {
                    numbers[y * width + x] = count;
                    left.push_back(y * width + x);
                }
            }
        }
        count += 1;
    }
    numbers
}

/// A ring with fewer points, none of which was farther from it than this (Douglas & Peucker 1973).
pub fn straightened(points: &[DVec2], within: f64) -> Vec<DVec2> {
    let count = points.len();
    if count <= 4 {
        return points.to_vec();
    }
    // Both ends are kept: the first point that lies farthest from the middle, and the one farthest from that.
    let middle = points.iter().copied().sum::<DVec2>() / count as f64;
    let farthest = |from: DVec2| {
        let far = |k: &usize| points[*k].distance_squared(from);
        (0..count).max_by(|a, b| far(a).total_cmp(&far(b)).then(b.cmp(a))).unwrap_or(0)
    };
    let first = farthest(middle);
    let second = (farthest(points[first]) + count - first) % count;
    let at = |k: usize| points[(first + k) % count];
    let mut kept = vec![false; count + 1];
    [0, second, count].into_iter().for_each(|k| kept[k] = true);
    let mut spans = vec![(0, second), (second, count)];
    while let Some((from, to)) = spans.pop() {
        let (a, b) = (at(from), at(to));
        let off = |k: &usize| (at(*k) - a).perp_dot(b - a).abs() / a.distance(b).max(f64::MIN_POSITIVE);
        let Some(worst) = (from + 1..to).max_by(|j, k| off(j).total_cmp(&off(k))) else { continue };
        if off(&worst) > within {
            kept[worst] = true;
            spans.extend([(from, worst), (worst, to)]);
        }
    }
    (0..count).filter(|k| kept[*k]).map(at).collect()
}

/// The line along pixels, from end to end but for half a pixel: through their middle, in the direction of their largest spread.
pub fn axis(pixels: &[(u32, u32)]) -> [DVec2; 2] {
    let middles = || pixels.iter().map(|(x, y)| DVec2::new(f64::from(*x) + 0.5, f64::from(*y) + 0.5));
    let centre = middles().sum::<DVec2>() / pixels.len().max(1) as f64;
    let spread = middles().fold(DMat2::ZERO, |sum, x| {
        let r = x - centre;
        sum + DMat2::from_cols(r * r.x, r * r.y)
    });
    let angle = 0.5 * (2.0 * spread.y_axis.x).atan2(spread.x_axis.x - spread.y_axis.y);
    let direction = DVec2::from_angle(angle);
    let along = || middles().map(|x| (x - centre).dot(direction));
    let (low, high) = along().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
    let ends = if high - low > 1.0 { [low + 0.5, high - 0.5] } else { [low, high] };
    ends.map(|t| centre + t * direction)
}
