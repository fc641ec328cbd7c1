//! The cycles that a core waits for flash: a line of it takes some cycles more than one, the next line may be fetched while
//! the core runs, and a cache keeps some lines.

/// The timing of a chip's flash.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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

#[cfg(test)]
mod tests {
    use super::{Cache, DataCache, Flash, FlashRules};

    const SLOW: FlashRules =
        FlashRules { wait: 2, line: 8, prefetch: false, lines: 0, ways: 0, data: DataCache::None };

    #[test]
    fn a_line_waits_once() {
        let mut flash = Flash::new(SLOW);
        // Four instructions of two bytes lie in the first line, the fifth in the second.
        let waited: Vec<u64> = (0..5).map(|at| flash.fetch(2 * at, 2, u64::from(10 * at))).collect();
        assert_eq!(waited, [2, 0, 0, 0, 2]);
    }

    #[test]
    fn an_instruction_across_two_lines_waits_for_both() {
        assert_eq!(Flash::new(SLOW).fetch(6, 4, 0), 4);
    }

    #[test]
    fn straight_code_runs_from_the_prefetched_line() {
        let mut flash = Flash::new(FlashRules { prefetch: true, ..SLOW });
        // The first line is there at cycle 2, the second 3 cycles later: what comes at cycle 4 waits one of them, and what comes at
        // cycle 20, long after the third is there, waits for none.
        assert_eq!(flash.fetch(0, 2, 0), 2);
        assert_eq!(flash.fetch(8, 2, 4), 1);
        assert_eq!(flash.fetch(16, 2, 20), 0);
        // A jump waits for the whole line.
        assert_eq!(flash.fetch(64, 2, 30), 2);
    }

    #[test]
    fn a_cache_keeps_the_lines_that_were_used_last() {
        // Lines 0, 2 and 4 share one of two sets.
        let mut cache = Cache::new(4, 2);
        let kept: Vec<bool> = [0, 2, 0, 4, 0, 2, 1].map(|line| cache.has(line)).to_vec();
        assert_eq!(kept, [false, false, true, false, true, false, false]);
    }

    #[test]
    fn loads_wait_by_line_and_may_share_the_cache() {
        let mut none = Flash::new(SLOW);
        assert_eq!([0, 4, 8, 0].map(|address| none.read(address)), [2, 0, 2, 2]);
        let mut own = Flash::new(FlashRules { data: DataCache::Own(2), ..SLOW });
        assert_eq!([0, 4, 8, 0].map(|address| own.read(address)), [2, 0, 2, 0]);
        let mut shared = Flash::new(FlashRules { lines: 4, ways: 2, data: DataCache::Shared, ..SLOW });
        assert_eq!(shared.fetch(8, 2, 0), 2);
        assert_eq!([8, 0].map(|address| shared.read(address)), [0, 2]);
    }
}
