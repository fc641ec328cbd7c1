//! Triangle coverage by the rules R1–R9, one pixel at a time, in exact integers.
//!
//! Vertices are 24.8 sub-pixels up to ±2²¹; pixel centres in here stay below ±2²⁴ sub-pixels: the
//! products stay below 2⁵⁰, so i64 is exact.

/// A vertex in 1/256 px, y down.
pub type P = (i64, i64);

/// R1: the centre of pixel (i, j), in sub-pixels.
pub fn centre(i: i64, j: i64) -> P {
    (256 * i + 128, 256 * j + 128)
}

/// Twice the signed area of a, b, p: the edge function of the edge a → b at p.
pub fn edge(a: P, b: P, p: P) -> i64 {
    (b.0 - a.0) * (p.1 - a.1) - (b.1 - a.1) * (p.0 - a.0)
}

/// R1–R7: is the centre of pixel (i, j) covered?
pub fn covers(t: [P; 3], i: i64, j: i64) -> bool {
    if edge(t[0], t[1], t[2]) == 0 {
        return false; // R6
    }
    let p = centre(i, j);
    (0..3).all(|k| {
        let (a, b, c) = (t[k], t[(k + 1) % 3], t[(k + 2) % 3]);
        // Each edge's function is positive on the third vertex's side (R7: whatever the winding).
        let side = edge(a, b, c).signum();
        let e = side * edge(a, b, p);
        // How it grows to the right and downwards.
        let (right, down) = (-side * (b.1 - a.1), side * (b.0 - a.0));
        let left_edge = right > 0; // R3: not horizontal, interior to its right
        let top_edge = right == 0 && down > 0; // R4: horizontal, interior below
        e > 0 || (e == 0 && (left_edge || top_edge)) // R2, R5
    })
}

/// The covered pixels of an area at most 64 wide, a word a row, bit k for column left + k: the edge functions again,
/// stepped from pixel to pixel instead of evaluated for each. For edges whose ties do not count, 1 is subtracted.
pub fn rows(t: [P; 3], area: Area) -> Vec<u64> {
    assert!(area.width() <= 64);
    let full = edge(t[0], t[1], t[2]);
    let mut lines: [(i64, i64, i64); 3] = core::array::from_fn(|k| {
        let (a, b) = (t[k], t[(k + 1) % 3]);
        let side = full.signum();
        let (right, down) = (-side * (b.1 - a.1), side * (b.0 - a.0));
        let tie_counts = right > 0 || (right == 0 && down > 0);
        let first = side * edge(a, b, centre(area.left, area.top)) - i64::from(!tie_counts);
        (first, 256 * right, 256 * down)
    });
    (area.top..area.bottom)
        .map(|_| {
            let (mut row, mut at) = (0, lines.map(|(value, ..)| value));
            for bit in 0..area.width() {
                if full != 0 && at[0] >= 0 && at[1] >= 0 && at[2] >= 0 {
                    row |= 1 << bit;
                }
                for (value, (_, right, _)) in at.iter_mut().zip(lines) {
                    *value += right;
                }
            }
            for (value, _, down) in &mut lines {
                *value += *down;
            }
            row
        })
        .collect()
}

/// A half-open rectangle of pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Area {
    pub left: i64,
    pub top: i64,
    pub right: i64,
    pub bottom: i64,
}

impl Area {
    pub fn new(left: i64, top: i64, right: i64, bottom: i64) -> Self {
        Area { left, top, right, bottom }
    }

    pub fn width(&self) -> usize {
        (self.right - self.left).max(0) as usize
    }

    pub fn height(&self) -> usize {
        (self.bottom - self.top).max(0) as usize
    }

    pub fn contains(&self, x: i64, y: i64) -> bool {
        x >= self.left && x < self.right && y >= self.top && y < self.bottom
    }

    pub fn pixels(self) -> impl Iterator<Item = (i64, i64)> {
        (self.top..self.bottom).flat_map(move |y| (self.left..self.right).map(move |x| (x, y)))
    }

    pub fn intersect(self, other: Area) -> Area {
        Area::new(
            self.left.max(other.left),
            self.top.max(other.top),
            self.right.min(other.right),
            self.bottom.min(other.bottom),
        )
    }
}

/// How often each pixel of an area was drawn; a pixel outside the area is an error of the caller.
#[derive(Clone, PartialEq, Eq)]
pub struct Counts {
    pub area: Area,
    pub hits: Vec<u32>,
}

impl Counts {
    pub fn new(area: Area) -> Self {
        Counts { area, hits: vec![0; area.width() * area.height()] }
    }

    pub fn hit(&mut self, x: i64, y: i64) {
        assert!(self.area.contains(x, y), "({x}, {y}) is outside {:?}", self.area);
        let at = (y - self.area.top) as usize * self.area.width() + (x - self.area.left) as usize;
        self.hits[at] += 1;
    }

    pub fn at(&self, x: i64, y: i64) -> u32 {
        if !self.area.contains(x, y) {
            return 0;
        }
        self.hits[(y - self.area.top) as usize * self.area.width() + (x - self.area.left) as usize]
    }

    pub fn total(&self) -> u64 {
        self.hits.iter().map(|&h| u64::from(h)).sum()
    }

    /// One line per row: `.` nothing, `1`–`9`, `+` more.
    pub fn picture(&self) -> String {
        let mut text = String::new();
        for row in self.hits.chunks(self.area.width().max(1)) {
            for &h in row {
                text.push(match h {
                    0 => '.',
                    1..=9 => char::from(b'0' + h as u8),
                    _ => '+',
                });
            }
            text.push('\n');
        }
        text
    }
}

impl core::fmt::Debug for Counts {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "{:?}\n{}", self.area, self.picture())
    }
}

/// The coverage of a triangle in an area.
pub fn triangle(t: [P; 3], area: Area) -> Counts {
    let mut counts = Counts::new(area);
    for (x, y) in area.pixels() {
        if covers(t, x, y) {
            counts.hit(x, y);
        }
    }
    counts
}
