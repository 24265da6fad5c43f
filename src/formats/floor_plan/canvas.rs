//! A grid of pixels that the shapes of a drawing are drawn on, each with what it is. A pixel belongs to a shape if its middle does.

use glam::{BVec2, DVec2};

use super::Plan;
use super::measure::{Measure, PIXEL, rounded};
use super::picture::{self, EXIT, Mark, OPEN, Picture, WALL};

/// Pixels, unless their side is given.
const USUAL: f64 = (16_u32 << 20) as f64;
/// Pixels, at most.
const MOST: f64 = (64_u32 << 20) as f64;
/// Pixels that are not given are larger than [`PIXEL`] by these, at most.
const COARSER: [f64; 4] = [1.0, 2.0, 4.0, 8.0];
/// Pixels that all shapes together may cover, at most: more than a hundred of the largest grids.
const PAINTED: u64 = 1 << 33;
/// Lines are drawn at least as wide as this, so that no way leads across them, and exits as that \[pixels\].
const LINE: f64 = 1.01;
const EXIT_LINE: f64 = 2.0;

/// What a pixel is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ink {
    Open,
    Wall,
    Exit,
}

impl Ink {
    fn kind(self) -> u8 {
        match self {
            Self::Open => OPEN,
            Self::Wall => WALL,
            Self::Exit => EXIT,
        }
    }
    /// Lines of this are drawn at least as wide as this \[pixels\].
    pub fn narrowest(self) -> f64 {
        if self == Self::Exit { EXIT_LINE } else { LINE }
    }
}

/// Which points are inside of outlines.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rule {
    NonZero,
    EvenOdd,
}

/// A part of a grid that shapes are cut to.
#[derive(Debug, Clone)]
pub struct Clip {
    /// The first column and row, and those after the last ones.
    from: [usize; 2],
    to: [usize; 2],
    /// Which of its pixels belong to it, row by row.
    inside: Vec<bool>,
}

/// A row of pixels: from a column to before another one.
#[derive(Debug, Clone, Copy)]
struct Span {
    row: usize,
    from: usize,
    to: usize,
}

/// The grid. Places are in pixels, to the right and down from its upper left corner.
pub struct Canvas {
    width: usize,
    height: usize,
    kinds: Vec<u8>,
    /// What is around it.
    around: u8,
    /// The place of the lower left corner \[m\].
    low: DVec2,
    /// The side of a pixel \[m\].
    pub side: f64,
    /// What one should know of it.
    remark: Option<String>,
    painted: u64,
    marks: Vec<Mark>,
}

impl Canvas {
    /// A grid over a rectangle \[m\]; its pixels are 0.02 m wide, or larger where these would be too many, or as given.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most 64 million")]
    pub fn over(low: DVec2, high: DVec2, measure: &Measure, background: Ink) -> Result<Self, String> {
        let size = high - low;
        let is_fine = size.is_finite() && size.cmpgt(DVec2::ZERO) == BVec2::TRUE && low.abs().max_element() < 1e12;
        if !is_fine {
            return Err(format!(
                "the drawing reaches from {low} to {high} m, and has no area: nothing of it is a plan"
            ));
        }
        let count = |side: f64| (size.x / side + 2.0) * (size.y / side + 2.0);
        let side = match measure.pixel {
            Some(side) => side,
            None => COARSER.map(|times| times * PIXEL).into_iter().find(|side| count(*side) <= USUAL).unwrap_or(PIXEL),
        };
        if count(side) > MOST {
            return Err(format!(
                "the drawing is {} by {} m, and with pixels of {side} m these are more than the {MOST} that a plan may have: check its scale, or \
                 choose larger ones with --pixel, or pixel in [plan]",
                rounded(size.x),
                rounded(size.y)
            ));
        }
        // Corners at multiples of pixels are on the grid.
        let low = (low / side + 1e-6).floor() * side;
        let [width, height] = ((high - low) / side - 1e-6).ceil().max(DVec2::ONE).to_array().map(|n| n as usize);
        let kinds = vec![background.kind(); width * height];
        let remark = (measure.pixel.is_none() && side > PIXEL).then(|| {
            format!(
                "the drawing is {} by {} m, and drawn on pixels of {side} m, as smaller ones would be more than {USUAL}: check its scale, or give --pixel, or \
                 pixel in [plan]",
                rounded(size.x),
                rounded(size.y)
            )
        });
        Ok(Self { width, height, kinds, around: background.kind(), low, side, remark, painted: 0, marks: Vec::new() })
    }
    /// A place on it \[pixels\], from one in metres.
    pub fn place(&self, x: DVec2) -> DVec2 {
        let r = (x - self.low) / self.side;
        DVec2::new(r.x, self.height as f64 - r.y)
    }
    /// Draws what is inside of outlines. Whether it has a pixel.
    pub fn fill(&mut self, rings: &[Vec<DVec2>], rule: Rule, ink: Ink, clip: Option<&Clip>) -> Result<bool, String> {
        let spans = self.spans(rings, rule)?;
        let mut first = None;
        for span in spans {
            for x in span.from..span.to {
                if clip.is_none_or(|clip| clip.holds(x, span.row)) {
                    let at = span.row * self.width + x;
                    self.kinds[at] = ink.kind();
                    first.get_or_insert(at);
                }
            }
        }
        if let (Some(at), Ink::Exit) = (first, ink) {
            self.marks.push(Mark { x: at % self.width, y: at / self.width, name: None });
        }
        Ok(first.is_some())
    }
    /// Draws a line of a width \[pixels\], with ends that stick out by half of it.
    pub fn line(&mut self, points: &[DVec2], width: f64, ink: Ink) -> Result<bool, String> {
        let half = 0.5 * width.max(ink.narrowest());
        let pieces = points.windows(2).map(|pair| {
            let along = half * (pair[1] - pair[0]).normalize_or(DVec2::X);
            let across = along.perp();
            let [a, b] = [pair[0] - along, pair[1] + along];
            vec![a - across, b - across, b + across, a + across]
        });
        self.fill(&pieces.collect::<Vec<_>>(), Rule::NonZero, ink, None)
    }
    /// Names the exit that was drawn last.
    pub fn name_exit(&mut self, name: Option<String>) {
        if let Some(mark) = self.marks.last_mut() {
            mark.name = name;
        }
    }
    /// The part of the grid that is inside of outlines, and within another part.
    pub fn clip(&mut self, shapes: &[(Vec<Vec<DVec2>>, Rule)], within: Option<&Clip>) -> Result<Clip, String> {
        let mut spans = Vec::new();
        for (rings, rule) in shapes {
            spans.extend(self.spans(rings, *rule)?);
        }
        let from = spans.iter().fold([usize::MAX; 2], |low, span| [low[0].min(span.from), low[1].min(span.row)]);
        let to = spans.iter().fold([0; 2], |high, span| [high[0].max(span.to), high[1].max(span.row + 1)]);
        let mut clip = Clip { from, to, inside: Vec::new() };
        let [width, height] = [0, 1].map(|k| to[k].saturating_sub(from[k]));
        self.pay((width * height) as u64)?;
        clip.inside = vec![false; width * height];
        for span in spans {
            for x in span.from..span.to {
                clip.inside[(span.row - from[1]) * width + x - from[0]] =
                    within.is_none_or(|within| within.holds(x, span.row));
            }
        }
        Ok(clip)
    }
    /// The plan that has been drawn.
    pub fn plan(self) -> Result<Plan, String> {
        let [width, height] = [self.width, self.height].map(|n| u32::try_from(n).unwrap_or(u32::MAX));
        let picture = Picture { width, height, kinds: self.kinds, around: self.around };
        let mut plan = picture::plan(picture, self.side, self.low, &self.marks)?;
        plan.remarks.extend(self.remark);
        Ok(plan)
    }
    fn pay(&mut self, pixels: u64) -> Result<(), String> {
        self.painted += pixels;
        if self.painted <= PAINTED {
            return Ok(());
        }
        Err(format!(
            "its shapes cover more than {PAINTED} pixels together: leave out what lies on top of each other, or choose larger pixels with --pixel, or \
             pixel in [plan]"
        ))
    }
    /// The rows of pixels whose middles are inside of outlines, which are closed.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to the grid")]
    fn spans(&mut self, rings: &[Vec<DVec2>], rule: Rule) -> Result<Vec<Span>, String> {
        let (rows, columns) = (self.height as f64, self.width as f64);
        // The first row or column whose middle is not before a place.
        let first = |x: f64, most: f64| (x - 0.5).ceil().clamp(0.0, most) as usize;
        let mut sides: Vec<Side> = Vec::new();
        for ring in rings.iter().filter(|ring| ring.iter().all(|x| x.is_finite())) {
            for (a, b) in ring.iter().zip(ring.iter().cycle().skip(1)) {
                let (top, bottom, turn) = if a.y < b.y { (*a, *b, 1) } else { (*b, *a, -1) };
                let [from, to] = [top.y, bottom.y].map(|y| first(y, rows));
                if from < to {
                    sides.push(Side { top, bottom, turn, from, to });
                }
            }
        }
        let work: usize = sides.iter().map(|side| side.to - side.from).sum();
        self.pay(work as u64)?;
        sides.sort_by_key(|side| side.from);
        let (mut spans, mut next, mut active): (Vec<Span>, _, Vec<usize>) = (Vec::new(), 0, Vec::new());
        let mut row = sides.first().map_or(0, |side| side.from);
        let mut crossings: Vec<(f64, i32)> = Vec::new();
        let mut covered = 0;
        while next < sides.len() || !active.is_empty() {
            while next < sides.len() && sides[next].from <= row {
                active.push(next);
                next += 1;
            }
            active.retain(|side| sides[*side].to > row);
            let y = row as f64 + 0.5;
            crossings.clear();
            crossings.extend(active.iter().map(|side| (sides[*side].at(y), sides[*side].turn)));
            crossings.sort_by(|a, b| a.0.total_cmp(&b.0));
            let mut turns = 0;
            for pair in crossings.windows(2) {
                turns += pair[0].1;
                let is_inside = match rule {
                    Rule::NonZero => turns != 0,
                    Rule::EvenOdd => turns % 2 != 0,
                };
                let [from, to] = [pair[0].0, pair[1].0].map(|x| first(x, columns));
                if is_inside && from < to {
                    covered += (to - from) as u64;
                    spans.push(Span { row, from, to });
                }
            }
            row += 1;
        }
        self.pay(covered)?;
        Ok(spans)
    }
}

impl Clip {
    fn holds(&self, x: usize, y: usize) -> bool {
        let [low, high] = [self.from, self.to];
        x >= low[0]
            && y >= low[1]
            && x < high[0]
            && y < high[1]
            && self.inside[(y - low[1]) * (high[0] - low[0]) + x - low[0]]
    }
}

/// A side of an outline, and the rows whose middles it crosses.
struct Side {
    top: DVec2,
    bottom: DVec2,
    /// 1 where it goes down.
    turn: i32,
    from: usize,
    to: usize,
}

impl Side {
    fn at(&self, y: f64) -> f64 {
        self.top.x + (y - self.top.y) / (self.bottom.y - self.top.y) * (self.bottom.x - self.top.x)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn canvas(width: f64, height: f64) -> Canvas {
        let measure = Measure { pixel: Some(1.0), scale: None };
        Canvas::over(DVec2::ZERO, DVec2::new(width, height), &measure, Ink::Open).expect("a grid")
    }
    fn square(low: f64, high: f64) -> Vec<DVec2> {
        [[low, low], [high, low], [high, high], [low, high]].map(DVec2::from).to_vec()
    }
    fn count(canvas: &Canvas) -> usize {
        canvas.kinds.iter().map(|kind| usize::from(*kind == WALL)).sum()
    }

    #[test]
    fn rules_decide_what_is_inside() {
        for (rule, wanted) in [(Rule::NonZero, 64), (Rule::EvenOdd, 64 - 16)] {
            let mut canvas = canvas(20.0, 10.0);
            let rings = [square(1.0, 9.0), square(3.0, 7.0)];
            assert!(canvas.fill(&rings, rule, Ink::Wall, None).expect("a fill"));
            assert_eq!(count(&canvas), wanted, "{rule:?}");
        }
        // One that goes round the other way is a hole by both rules.
        let mut canvas = canvas(20.0, 10.0);
        let hole = square(3.0, 7.0).into_iter().rev().collect();
        assert!(canvas.fill(&[square(1.0, 9.0), hole], Rule::NonZero, Ink::Wall, None).expect("a fill"));
        assert_eq!(count(&canvas), 48);
    }
    #[test]
    fn shapes_are_cut_to_the_grid_and_to_parts() {
        let mut canvas = canvas(20.0, 10.0);
        let outer = canvas.clip(&[(vec![square(-5.0, 6.0)], Rule::NonZero)], None).expect("a part");
        let inner = canvas.clip(&[(vec![square(2.0, 50.0)], Rule::NonZero)], Some(&outer)).expect("a part");
        assert!(canvas.fill(&[square(-1e9, 1e9)], Rule::NonZero, Ink::Wall, Some(&inner)).expect("a fill"));
        assert_eq!(count(&canvas), 16);
        assert!(!canvas.fill(&[square(30.0, 40.0)], Rule::NonZero, Ink::Wall, None).expect("nothing"));
        assert!(!canvas.fill(&[square(f64::NAN, 4.0)], Rule::NonZero, Ink::Wall, None).expect("nothing"));
        let nothing = canvas.clip(&[], None).expect("a part");
        assert!(!canvas.fill(&[square(0.0, 9.0)], Rule::NonZero, Ink::Wall, Some(&nothing)).expect("nothing"));
    }
    /// However a line runs, its pixels hang together at least by corners: no step to one of four sides leads across it.
    #[test]
    fn no_way_leads_across_thin_lines() {
        for degree in (0..180).step_by(7) {
            let mut canvas = canvas(60.0, 60.0);
            let r = 100.0 * DVec2::from_angle(f64::from(degree).to_radians());
            let middle = DVec2::new(30.3, 29.6);
            assert!(canvas.line(&[middle - r, middle + r], 0.0, Ink::Wall).expect("a line"));
            assert!(count(&canvas) < 130, "{degree}: {}", count(&canvas));
            let side = |at: usize| {
                let x = DVec2::new((at % 60) as f64 + 0.5, (at / 60) as f64 + 0.5);
                r.perp_dot(x - middle) > 0.0
            };
            for at in 0..3600 {
                for next in [(at % 60 < 59).then_some(at + 1), (at < 3540).then_some(at + 60)].into_iter().flatten() {
                    let is_free = [at, next].iter().all(|at| canvas.kinds[*at] == OPEN);
                    assert!(!is_free || side(at) == side(next), "{degree}: {at} {next}");
                }
            }
        }
    }
    #[test]
    fn grids_that_are_too_large_are_refused() {
        let over = |high: f64, pixel| {
            Canvas::over(DVec2::ZERO, DVec2::splat(high), &Measure { pixel, scale: None }, Ink::Open)
        };
        assert!(over(1e3, Some(0.02)).err().is_some_and(|why| why.contains("choose larger ones")));
        assert!(over(1e9, None).err().is_some_and(|why| why.contains("check its scale")));
        assert!(over(f64::NAN, None).err().is_some_and(|why| why.contains("no area")));
        assert_eq!(over(70.0, None).map(|canvas| canvas.side).ok(), Some(0.02));
        assert_eq!(over(100.0, None).map(|canvas| canvas.side).ok(), Some(0.04));
        let Ok(mut canvas) = over(80.0, None) else { panic!("no grid") };
        // As if shapes had been drawn before.
        canvas.painted = PAINTED - 1000;
        let refused = canvas.fill(&[square(0.0, 100.0)], Rule::NonZero, Ink::Wall, None).err();
        assert!(refused.is_some_and(|why| why.contains("on top of each other")));
    }
}
