//! The cycles that a core waits for flash: a line of it takes some cycles more than one, the next line may be fetched while
//! the core runs, and a cache keeps some lines.

use serde::Deserialize;

/// The timing of a chip's flash.
#[derive(Clone, Copy, Deserialize)]
pub(crate) struct FlashRules {
    /// Additional cycles of a line, beyond one.
    pub(crate) wait: u64,
    /// The bytes of a line.
    pub(crate) line: u32,
    /// Whether the next line is fetched while the current one is executed.
    pub(crate) prefetch: bool,
    /// The lines that the instruction cache keeps, and its ways; 0 lines without a cache.
    pub(crate) lines: usize,
    pub(crate) ways: usize,
    pub(crate) data: DataCache,
}

/// The cache of lines that loads read.
#[derive(Clone, Copy, Deserialize)]
pub(crate) enum DataCache {
    None,
    /// The cache for instructions.
    Shared,
    /// A cache of its own, of this many lines, fully associative.
    Own(usize),
}

/// The state of the flash and its caches.
#[derive(Clone)]
pub(crate) struct Flash {
    rules: FlashRules,
    instructions: Cache,
    data: Cache,
    /// The line that the core takes instructions from, and that of its last load.
    line: Option<u32>,
    loaded: Option<u32>,
    /// The time at which the line after `line` is there.
    ready: u64,
}

impl Flash {
    pub(crate) fn new(rules: FlashRules) -> Self {
        let own = match rules.data {
            DataCache::Own(lines) => lines,
            DataCache::None | DataCache::Shared => 0,
        };
        Self {
            rules,
            instructions: Cache::new(rules.lines, rules.ways),
            data: Cache::new(own, own),
            line: None,
            loaded: None,
            ready: 0,
        }
    }

    /// Cycles that the core waits for an instruction of `bytes` bytes at `address`, from cycle `now` on.
    pub(crate) fn fetch(&mut self, address: u32, bytes: u32, now: u64) -> u64 {
        let mut waited = 0;
        for line in address / self.rules.line..=(address + bytes - 1) / self.rules.line {
            let before = self.line.replace(line);
            if before == Some(line) {
                continue;
            }
            let now = now + waited;
            if self.instructions.has(line) {
                self.ready = now + self.rules.wait;
                continue;
            }
            let follows = before.is_some_and(|before| before + 1 == line);
            let wait = match follows && self.rules.prefetch {
                true => self.ready.saturating_sub(now).min(self.rules.wait),
                false => self.rules.wait,
            };
            waited += wait;
            self.ready = now + wait + self.rules.wait + 1;
        }
        waited
    }

    /// Cycles that a load from `address` in flash waits.
    pub(crate) fn read(&mut self, address: u32) -> u64 {
        let line = address / self.rules.line;
        let cached = match self.rules.data {
            DataCache::None => false,
            DataCache::Shared => self.instructions.has(line),
            DataCache::Own(_) => self.data.has(line),
        };
        if cached || self.loaded == Some(line) {
            return 0;
        }
        self.loaded = Some(line);
        self.rules.wait
    }
}

/// Sets of lines, each of which drops the line that was used longest ago.
#[derive(Clone)]
struct Cache {
    /// The lines of each set, the last used one first.
    sets: Vec<Vec<u32>>,
    ways: usize,
}

impl Cache {
    fn new(lines: usize, ways: usize) -> Self {
        let sets = lines.checked_div(ways).unwrap_or(0);
        Self { sets: vec![Vec::new(); sets], ways }
    }

    /// Whether the cache has the line; it has it from now on.
    fn has(&mut self, line: u32) -> bool {
        let count = self.sets.len();
        if count == 0 {
            return false;
        }
        let set = &mut self.sets[line as usize % count];
        let at = set.iter().position(|kept| *kept == line);
        match at {
            Some(at) => set[..=at].rotate_right(1),
            None => {
                set.truncate(self.ways - 1);
                set.insert(0, line);
            }
        }
        at.is_some()
    }
}
