//! Palettes of at most 256 colours.

/// A palette, and the entry of each colour.
pub struct Palette {
    /// The entries.
    pub colours: Vec<[u8; 3]>,
    /// The entry of each colour that occurs, by colours.
    index: Vec<([u8; 3], u8)>,
}

/// The colours that one palette entry replaces, and how often each occurs.
type Group = Vec<([u8; 3], usize)>;

/// How often each colour occurs in pictures, by colours.
#[derive(Default)]
pub struct Counts(Group);

impl Counts {
    /// Counts the colours of more pixels.
    pub fn add(&mut self, pixels: impl Iterator<Item = [u8; 3]>) {
        self.0.extend(pixels.map(|colour| (colour, 1)));
        self.0.sort_unstable();
        self.0.dedup_by(|(colour, count), (before, sum)| {
            *sum += if colour == before { *count } else { 0 };
            colour == before
        });
    }
}

impl Palette {
    /// A palette for the colours that occur. The most frequent one is exact, and so are the others if there are at
    /// most 255; otherwise median cut chooses them (Heckbert, *Color image quantization for frame buffer display*, 1982).
    pub fn of(Counts(mut met): Counts) -> Self {
        met.sort_unstable_by_key(|&(colour, count)| (std::cmp::Reverse(count), colour));
        let others = met.split_off(met.len().min(1));
        let mut groups = vec![met];
        if !others.is_empty() {
            groups.extend(cut(others, 255));
        }
        // At most 256 entries.
        let of_group =
            |(i, group): (usize, &Group)| group.iter().map(|&(c, _)| (c, i as u8)).collect::<Vec<_>>();
        let mut index: Vec<_> = groups.iter().enumerate().flat_map(of_group).collect();
        index.sort_unstable();
        Self { index, colours: groups.iter().map(mean).collect() }
    }

    /// Index of the entry for a colour that occurs.
    pub fn index(&self, colour: [u8; 3]) -> u8 {
        let place = self.index.partition_point(|(other, _)| *other < colour);
        self.index.get(place).map_or(0, |(_, entry)| *entry)
    }
}

/// Median cut: splits the group with the longest side into halves of equal pixel counts, until there are enough.
fn cut(all: Group, most: usize) -> Vec<Group> {
    let mut groups = vec![all];
    while groups.len() < most {
        let widest = groups.iter().enumerate().max_by_key(|(i, group)| (longest(group).1, usize::MAX - i));
        let Some((place, _)) = widest.filter(|(_, group)| group.len() > 1) else { break };
        let mut group = groups.swap_remove(place);
        let (channel, _) = longest(&group);
        group.sort_unstable_by_key(|(colour, _)| (colour[channel], *colour));
        let half = group.iter().map(|(_, count)| count).sum::<usize>() / 2;
        let mut before = 0;
        let at = group.iter().position(|(_, count)| {
            before += count;
            before > half
        });
        let upper = group.split_off(at.unwrap_or_default().clamp(1, group.len() - 1));
        groups.extend([group, upper]);
    }
    groups
}

/// The channel with the largest range in a group, and that range.
fn longest(group: &Group) -> (usize, u8) {
    let reach = |channel: usize| {
        let values = || group.iter().map(|(colour, _)| colour[channel]);
        values().max().unwrap_or_default() - values().min().unwrap_or_default()
    };
    (0..3).map(|channel| (channel, reach(channel))).max_by_key(|&(_, reach)| reach).unwrap_or_default()
}

fn mean(group: &Group) -> [u8; 3] {
    let pixels: usize = group.iter().map(|(_, count)| count).sum();
    [0, 1, 2].map(|channel| {
        let sum: usize = group.iter().map(|(colour, count)| usize::from(colour[channel]) * count).sum();
        ((sum + pixels / 2) / pixels.max(1)) as u8 // a mean of u8
    })
}
