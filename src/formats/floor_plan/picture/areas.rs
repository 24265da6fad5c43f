//! Connected areas of a plan in pixels: its exits, and the floor beside them.

use std::collections::VecDeque;

use glam::DVec2;

use super::colors::Picture;

pub const OPEN: u8 = 0;
pub const WALL: u8 = 1;
pub const EXIT: u8 = 2;
/// What pedestrians can be on: exits, and the closed rooms beside them.
pub const FLOOR: u8 = 3;

const NONE: u32 = u32::MAX;

/// Areas of open pixels that hang together by their sides.
#[derive(Debug, Clone, Copy)]
pub struct Room {
    /// One of its pixels.
    pub first: (u32, u32),
    pixels: usize,
    /// Sides of its pixels to others.
    edges: usize,
    /// Whether it reaches the edge of the picture.
    is_outside: bool,
    has_exit: bool,
}

impl Room {
    /// Its area \[pixels\].
    pub fn area(&self) -> f64 {
        self.pixels as f64
    }
    /// Twice its area over the length of its outline: half of the side of a square, the width of what is long and narrow \[pixels\].
    pub fn thickness(&self) -> f64 {
        2.0 * self.pixels as f64 / self.edges as f64
    }
}

/// The areas of a plan.
pub struct Areas {
    pub width: usize,
    pub height: usize,
    /// Floor, or not, for each pixel.
    pub mask: Vec<u8>,
    /// The pixels of each exit, from the top; they hang together by sides or corners.
    pub exits: Vec<Vec<(u32, u32)>>,
    label: Vec<u32>,
    rooms: Vec<Room>,
}

impl Areas {
    pub fn of(picture: &Picture) -> Self {
        let (width, height) = (picture.width as usize, picture.height as usize);
        let kinds = &picture.kinds;
        let mut label = vec![NONE; kinds.len()];
        let (mut rooms, mut exits) = (Vec::new(), Vec::new());
        for start in 0..kinds.len() {
            if label[start] != NONE || kinds[start] == WALL {
                continue;
            }
            if kinds[start] == EXIT {
                let pixels = filled(kinds, &mut label, (width, height), start, NONE - 1);
                exits.push(pixels.iter().map(|at| place(*at, width)).collect());
            } else {
                let number = u32::try_from(rooms.len()).unwrap_or(NONE);
                let pixels = filled(kinds, &mut label, (width, height), start, number);
                let edge = |at: &usize| {
                    at.is_multiple_of(width) || at % width == width - 1 || *at < width || at + width >= kinds.len()
                };
                let is_outside = pixels.iter().any(edge);
                let around = |at: &usize| {
                    let within = sides(width, height, at % width, at / width);
                    4 - within.filter(|next| label[*next] == number).count()
                };
                let edges = pixels.iter().map(around).sum();
                let first = place(start, width);
                rooms.push(Room { first, pixels: pixels.len(), edges, is_outside, has_exit: false });
            }
        }
        let mut areas = Self { width, height, mask: Vec::new(), exits, label, rooms };
        for number in 0..areas.exits.len() {
            for room in areas.beside(&areas.exits[number]) {
                areas.rooms[room].has_exit = true;
            }
        }
        let is_floor = |label: &u32| {
            let room = areas.rooms.get(*label as usize);
            *label == NONE - 1 || room.is_some_and(|room| room.has_exit && !room.is_outside)
        };
        areas.mask = areas.label.iter().map(|label| if is_floor(label) { FLOOR } else { WALL }).collect();
        areas
    }
    /// The rooms beside an exit, some of them more than once.
    fn beside(&self, exit: &[(u32, u32)]) -> Vec<usize> {
        let labels = exit.iter().flat_map(|(x, y)| sides(self.width, self.height, *x as usize, *y as usize));
        labels.map(|at| self.label[at] as usize).filter(|room| *room < self.rooms.len()).collect()
    }
    /// Whether a closed room is beside an exit.
    pub fn is_inside(&self, exit: &[(u32, u32)]) -> bool {
        self.beside(exit).into_iter().any(|room| !self.rooms[room].is_outside)
    }
    /// The closed rooms without an exit.
    pub fn rooms_without_exit(&self) -> impl Iterator<Item = &Room> {
        self.rooms.iter().filter(|room| !room.is_outside && !room.has_exit)
    }
    /// Adds to the floor what lies outside of exits up to a distance \[pixels\]: no wall stands right behind an exit, which would push pedestrians back.
    pub fn land(&mut self, distance: f64) {
        let mut left: VecDeque<(usize, usize)> = VecDeque::new();
        for (x, y) in self.exits.iter().flatten() {
            let at = *y as usize * self.width + *x as usize;
            left.push_back((at, at));
        }
        let width = self.width;
        let apart = |a: usize, b: usize| {
            let [dx, dy] = [(a % width).abs_diff(b % width), (a / width).abs_diff(b / width)];
            (dx as f64).hypot(dy as f64)
        };
        while let Some((at, origin)) = left.pop_front() {
            for next in sides(width, self.height, at % width, at / width) {
                let room = self.rooms.get(self.label[next] as usize);
                if self.mask[next] != FLOOR
                    && room.is_some_and(|room| room.is_outside)
                    && apart(next, origin) <= distance
                {
                    self.mask[next] = FLOOR;
                    left.push_back((next, origin));
                }
            }
        }
    }
    /// The middle of what is beside an exit and outside, if anything is.
    pub fn outside_of(&self, exit: &[(u32, u32)]) -> Option<DVec2> {
        let beside = exit.iter().flat_map(|(x, y)| sides(self.width, self.height, *x as usize, *y as usize));
        let is_outside = |at: &usize| self.rooms.get(self.label[*at] as usize).is_some_and(|room| room.is_outside);
        let places: Vec<usize> = beside.filter(is_outside).collect();
        let middle = |at: &usize| DVec2::new((at % self.width) as f64 + 0.5, (at / self.width) as f64 + 0.5);
        (!places.is_empty()).then(|| places.iter().map(middle).sum::<DVec2>() / places.len() as f64)
    }
    /// Where floor touches floor by a corner alone, one pixel of it is taken away: outlines do not touch.
    pub fn part_corners(&mut self) {
        loop {
            let mut changed = false;
            for at in 0..self.mask.len().saturating_sub(self.width) {
                if at % self.width + 1 == self.width {
                    continue;
                }
                let [a, b, c, d] = [at, at + 1, at + self.width, at + self.width + 1].map(|at| self.mask[at] == FLOOR);
                if a == d && b == c && a != b {
                    self.mask[if a { at } else { at + 1 }] = WALL;
                    changed = true;
                }
            }
            if !changed {
                return;
            }
        }
    }
}

#[expect(clippy::cast_possible_truncation, reason = "a picture has so many columns and rows")]
fn place(at: usize, width: usize) -> (u32, u32) {
    ((at % width) as u32, (at / width) as u32)
}

/// The pixels beside one, by their sides.
fn sides(width: usize, height: usize, x: usize, y: usize) -> impl Iterator<Item = usize> {
    let at = y * width + x;
    let all = [
        (x > 0).then(|| at - 1),
        (x + 1 < width).then_some(at + 1),
        (y > 0).then(|| at - width),
        (y + 1 < height).then_some(at + width),
    ];
    all.into_iter().flatten()
}

/// Labels the area of a pixel; its pixels. Exits hang together by corners, too.
fn filled(kinds: &[u8], label: &mut [u32], (width, height): (usize, usize), start: usize, number: u32) -> Vec<usize> {
    let kind = kinds[start];
    label[start] = number;
    let (mut pixels, mut next) = (vec![start], 0);
    while let Some(at) = pixels.get(next).copied() {
        next += 1;
        let (x, y) = (at % width, at / width);
        let mut take = |other: usize| {
            if kinds[other] == kind && label[other] == NONE {
                label[other] = number;
                pixels.push(other);
            }
        };
        sides(width, height, x, y).for_each(&mut take);
        if kind == EXIT {
            for (dx, dy) in [(0, 0), (2, 0), (0, 2), (2, 2)] {
                let (x, y) = ((x + dx).wrapping_sub(1), (y + dy).wrapping_sub(1));
                if x < width && y < height {
                    take(y * width + x);
                }
            }
        }
    }
    pixels
}
