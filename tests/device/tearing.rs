//! The book's chapter on tearing: a panel that reads its memory while it is written, and how many of its refreshes show two frames.

const ROWS: u32 = 240;
/// Rows of a band.
const BAND: u32 = 8;

/// When a frame begins.
#[derive(Clone, Copy)]
enum Start {
    /// When the one before has ended.
    WhenReady,
    /// When TE rises after that: the last row has been read.
    TeRises,
    /// When TE falls: the first row is read next.
    TeFalls,
}

/// In which order bands are written.
#[derive(Clone, Copy)]
enum Order {
    Down,
    Up,
}

/// Of 600 refreshes of `period` microseconds, how many show rows of more than one frame. A frame takes `writing` microseconds, band after band.
fn torn(period: u64, writing: u64, start: Start, order: Order) -> usize {
    // Nothing is read in 24 of 344 lines, as an ST7789 is set at first.
    let porch = period * 24 / 344;
    // When each row got the frame of a number: (time, row, frame), in the order of time.
    let (mut writes, mut now, mut frame) = (Vec::new(), 0, 1);
    let bands = u64::from(ROWS / BAND);
    while now < 600 * period {
        let begin = match start {
            Start::WhenReady => now,
            Start::TeRises => now.div_ceil(period) * period,
            Start::TeFalls => now.saturating_sub(porch).div_ceil(period) * period + porch,
        };
        for band in 0..ROWS / BAND {
            let first = BAND
                * match order {
                    Order::Down => band,
                    Order::Up => ROWS / BAND - 1 - band,
                };
            // A row is as it will be when its own part of the band's time is over.
            let time = |row: u32| {
                begin + (u64::from(band) * writing + u64::from(row + 1) * writing / u64::from(BAND)) / bands
            };
            writes.extend((0..BAND).map(|row| (time(row), first + row, frame)));
        }
        now = begin + writing;
        frame += 1;
    }
    let (mut memory, mut writes, mut count) = (vec![0; ROWS as usize], writes.into_iter().peekable(), 0);
    for refresh in 0..600 {
        let mut shown = Vec::new();
        for row in 0..ROWS {
            let time = refresh * period + porch + u64::from(row) * (period - porch) / u64::from(ROWS);
            while let Some((_, row, frame)) = writes.next_if(|write| write.0 <= time) {
                memory[row as usize] = frame;
            }
            shown.push(memory[row as usize]);
        }
        count += usize::from(shown.iter().any(|frame| *frame != shown[0]));
    }
    count
}

/// The time of a frame of 16 bits a pixel on a bus, in microseconds.
fn on_bus(width: u64, megahertz: f64) -> u64 {
    ((width * u64::from(ROWS) * 16) as f64 / megahertz) as u64
}

#[test]
fn a_frame_that_begins_with_te_is_never_torn() {
    let period = 16_667;
    let down = |writing, start| torn(period, writing, start, Order::Down);
    for writing in [5_000, 14_746, 16_000] {
        assert_eq!(down(writing, Start::TeRises), 0, "{writing} µs");
        // The writer overtakes the reader.
        assert!(writing > 15_500 || down(writing, Start::TeFalls) > 100, "{writing} µs");
    }
    for writing in [period, 25_000, 32_100] {
        assert_eq!(down(writing, Start::TeFalls), 0, "{writing} µs");
        // The reader overtakes the writer.
        assert!(writing < 20_000 || down(writing, Start::TeRises) > 100, "{writing} µs");
    }
    // Too long, and in the other order, and without TE.
    assert!(down(36_000, Start::TeFalls) > 100);
    assert!(torn(period, 14_746, Start::TeRises, Order::Up) > 100);
    let free = [10_000, 30_000].map(|writing| down(writing, Start::WhenReady));
    println!("{free:?} of 600 refreshes without TE");
    assert!(free.iter().all(|count| *count > 200));
}

/// The table of the chapter.
#[test]
fn these_buses_are_fast_enough() {
    for (hertz, width, enough) in [(60, 240, 29.0), (60, 320, 39.0), (40, 240, 19.5), (40, 320, 26.0)] {
        let is_torn =
            |megahertz| torn(1_000_000 / hertz, on_bus(width, megahertz), Start::TeFalls, Order::Down) > 0;
        assert!(!is_torn(enough), "{hertz} Hz, {width} columns");
        assert!(is_torn(0.95 * enough), "{hertz} Hz, {width} columns");
    }
}
