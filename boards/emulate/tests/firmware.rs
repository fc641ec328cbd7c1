//! Firmware with a fault fails on the emulated board for the right reason, where an emulator could hide it, and a bus that fails does no
//! lasting harm. What a display refuses is tested without emulators (`src/watch.rs`).
//! Each firmware is a copy of the template in which a few words are replaced, built and linked as the template is.

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::sync::atomic::{AtomicU32, Ordering};
use support::firmware::{edit, has_tools, image, Folder};
use support::ROOT;

/// Enough for a fault that only the second frame shows.
const FRAMES: &str = "2";

struct Template {
    board: &'static str,
    target: &'static str,
}

/// A text of a file, and what replaces it.
type Edit = (&'static str, &'static str, &'static str);

const RP2040: Template = Template { board: "rp2040-st7789", target: "thumbv6m-none-eabi" };
const EMBASSY: Template = Template { board: "rp2040-embassy", target: "thumbv6m-none-eabi" };
const STM32: Template = Template { board: "stm32f4-ili9341", target: "thumbv7em-none-eabihf" };

/// Tests by their names: a template, options of its run, what is edited, and the problem with which the run must end.
macro_rules! faults {
    ($($(#[$about:meta])* $name:ident: $template:ident $([$($option:literal),*])?, [$($edit:expr),*], $problem:literal;)*) => {$(
        $(#[$about])*
        #[test]
        fn $name() {
            $template.ends(&[$($edit),*], &[$($($option),*)?], $problem);
        }
    )*};
}

faults! {
    /// The last bytes are still in the bus's queue when CS rises.
    without_flush_the_rp2040_deselects_the_display_too_early: RP2040,
        [("src/bus.rs", "spi.flush().is_ok();", "true;\n        let _ = &mut spi;")],
        "while CS is high";
    without_waiting_the_reset_is_too_short: RP2040,
        [("src/panel.rs", "delay.delay_us(20);", "")],
        "a reset pulse of";
    a_bus_that_is_too_fast_is_noticed_on_the_stm32: STM32,
        [("src/main.rs", "const HERTZ: u32 = 25_000_000", "const HERTZ: u32 = 50_000_000")],
        "a byte in 160 ns";
    a_bus_mode_that_the_display_does_not_have_is_noticed_on_the_stm32: STM32,
        [("src/main.rs", "MODE: Mode = MODE_0", "MODE: Mode = embedded_hal::spi::MODE_1")],
        "neither in mode 0 nor in mode 3";
    without_waiting_the_reset_is_too_short_on_the_stm32: STM32,
        [("src/bus.rs", "time.div_ceil(1000) * MEGAHERTZ", "0 * time")],
        "a reset pulse of";
    /// The last bytes are still in the bus's registers when CS rises.
    without_waiting_for_the_bus_the_stm32_deselects_the_display_too_early: STM32,
        [("src/bus.rs", "done.and_then(|()| within_time(|| !self.spi.is_busy()))", "done")],
        "while CS is high";
    dma_that_repeats_one_byte_is_noticed: STM32,
        [("src/bus.rs", "memory_increment(true)", "memory_increment(false)")],
        "is not modelled";
    commands_among_the_bytes_of_dma_are_noticed: STM32,
        [("src/panel.rs", "self.finish()?;\n        let (Ok", "let (Ok")],
        "unknown command";
    an_error_of_dma_that_nobody_reads_is_noticed: RP2040 ["--break-bus", "160000"],
        [("src/bus.rs", "control.read().ahb_error().bit_is_set()", "false")],
        "DMA is started with an error";
    without_refresh_a_panel_stays_lost_on_the_rp2040: RP2040 ["--break-bus", "160000", "--by", "reset"],
        [("src/main.rs", "shown = panel.refresh()", "shown = Ok(())")],
        "no whole frame for 1 s after the bus has broken";
    without_refresh_a_panel_stays_lost_under_embassy: EMBASSY ["--break-bus", "160000", "--by", "reset"],
        [("src/tasks.rs", "panel.refresh()", "Ok(())")],
        "no whole frame for 1 s after the bus has broken";
    /// The registers come back, and pixels that do not change do not.
    without_a_whole_frame_a_panel_stays_lost_under_embassy: EMBASSY ["--break-bus", "160000", "--by", "reset"],
        [("src/tasks.rs", "WHOLE.store(true, Relaxed)", "WHOLE.store(shown.is_err(), Relaxed)")],
        "no whole frame for 1 s after the bus has broken";
    bands_that_overtake_the_panel_are_torn: EMBASSY ["--frames", "40"],
        [("src/tasks.rs", "Duration::from_micros(ROW * rows)", "Duration::from_micros(0 * rows)")],
        "refreshes are torn";
    a_watchdog_resets_an_rp2040_that_hangs_under_embassy: EMBASSY ["--frames", "120"],
        [("src/tasks.rs", "feed_watchdog();", "if number == 0 {\n            feed_watchdog();\n        }")],
        "the chip is reset by its watchdog";
    a_watchdog_resets_an_rp2040_that_hangs: RP2040 ["--frames", "40"],
        [("src/main.rs", "watchdog.feed();", "if frame == 0 {\n                watchdog.feed();\n            }")],
        "the chip is reset by its watchdog";
    without_refresh_a_panel_stays_lost_on_the_stm32: STM32 ["--break-bus", "160000", "--by", "reset"],
        [("src/main.rs", "shown = panel.refresh()", "shown = Ok(())")],
        "no whole frame for 1 s after the bus has broken";
    without_a_whole_frame_a_panel_stays_lost_on_the_stm32: STM32 ["--break-bus", "160000", "--by", "reset"],
        [("src/main.rs", "picture.shown = None;\n                delay", "delay")],
        "no whole frame for 1 s after the bus has broken";
    without_whole_bands_a_panel_stays_lost_on_the_stm32: STM32 ["--break-bus", "160000", "--by", "reset"],
        [("src/main.rs", "changed(band, is_whole)", "changed(band, is_whole && bytes == 0)")],
        "no whole frame for 1 s after the bus has broken";
    without_a_whole_frame_a_panel_stays_lost_on_the_rp2040: RP2040 ["--break-bus", "160000", "--by", "reset"],
        [("src/main.rs", "picture.shown = None;\n                delay", "delay")],
        "no whole frame for 1 s after the bus has broken";
    without_a_time_limit_and_a_watchdog_a_stall_lasts: STM32 ["--break-bus", "160000", "--by", "stall"],
        [("src/bus.rs", "> PATIENCE", "> u32::MAX"), ("src/main.rs", "WATCHDOG: u32 = 1000", "WATCHDOG: u32 = 0")],
        "no whole frame for 1 s after the bus has broken";
    a_watchdog_resets_an_stm32_that_hangs: STM32 ["--frames", "80"],
        [("src/main.rs", "watchdog.feed();", "")],
        "the chip is reset by its watchdog";
}

/// The template itself passes, so the mutants fail because of their own faults.
#[test]
fn the_template_for_the_rp2040_passes() {
    RP2040.passes(&[]);
}

/// While the model turns by itself, a press of the button stops it. Then the encoder turns it by 2 clicks back, 3 forward and 4 back,
/// and the next press lets it go on. A click is a step of the turn.
#[test]
fn the_encoder_and_the_button_turn_the_model() {
    let Some(turned) = EMBASSY.steps(&[]) else { return };
    assert_eq!(turned, [-2, 3, -4]);
}

#[test]
fn an_encoder_whose_contacts_are_swapped_turns_the_other_way() {
    let swapped = "[Input::new(p.PIN_11, Pull::Up), Input::new(p.PIN_10, Pull::Up)]";
    let contacts = "[Input::new(p.PIN_10, Pull::Up), Input::new(p.PIN_11, Pull::Up)]";
    // The 2 clicks forward belong to the turn before, and the 4 to that after.
    let Some(turned) = EMBASSY.steps(&[("src/chip.rs", contacts, swapped)]) else { return };
    assert_eq!(turned, [-3]);
}

#[test]
fn without_waiting_for_te_many_refreshes_are_torn() {
    let edits = [("src/tasks.rs", "strip.is_first && has_te != Some(false)", "false")];
    let Some(output) = EMBASSY.run(&edits, &["--frames", "40"]) else { return };
    let (torn, refreshes) = tears(&output);
    assert!(!output.status.success() && 3 * torn >= refreshes && refreshes > 20, "{torn} of {refreshes}");
}

/// A frame takes 20 ms, the first one and the one after each refresh of the registers 50. While a frame is written, a panel of 40 Hz reads its memory once.
#[test]
fn a_lower_refresh_rate_makes_tears_rarer_on_the_stm32() {
    let usual = [("src/registers.rs", "(0xb1, &[0x01, 0x18])", "(0xb1, &[0x00, 0x1b])")];
    let outputs = [&[][..], &usual].map(|edits| STM32.run(edits, &["--frames", "40"]));
    let [Some(set), Some(usual)] = &outputs else { return };
    let [(few, of_set), (many, of_usual)] = [set, usual].map(tears);
    assert!(set.status.success() && usual.status.success());
    assert!(3 * few < of_set && 3 * many > of_usual, "{few} of {of_set}, {many} of {of_usual}");
    assert!(10 * of_usual > 17 * of_set, "{of_usual} refreshes, and {of_set}");
}

/// The torn refreshes of a run, and all.
fn tears(output: &Output) -> (u32, u32) {
    let said =
        [&output.stdout, &output.stderr].map(|said| String::from_utf8_lossy(said).into_owned()).concat();
    let (before, _) = said.split_once(" refreshes are torn").unwrap_or_else(|| panic!("{output:?}"));
    let mut words = before.rsplit(' ');
    let refreshes = words.next().and_then(|word| word.parse().ok());
    let torn = words.nth(3).and_then(|word| word.parse().ok());
    (torn.expect("a number"), refreshes.expect("a number"))
}

/// A byte in the middle of the second frame.
const MIDDLE: &str = "160000";

/// The frame is lost and logged, the panel reset, and the frames after it are compared, pixel by pixel; all within a second.
#[test]
fn after_a_fault_of_the_bus_the_panel_is_reset_and_drawn_whole() {
    let stalls = "the bus does not go on";
    for (template, fault, problem) in [
        (&STM32, "error", "frame 1: DMA has an error"),
        (&STM32, "stall", &format!("frame 1: {stalls}")[..]),
        (&RP2040, "error", "frame 1: DMA has an error"),
        (&RP2040, "stall", &format!("frame 1: {stalls}")),
        (&EMBASSY, "stall", stalls),
    ] {
        let said = template.passes(&["--break-bus", MIDDLE, "--by", fault]);
        let wanted = format!("logs: {problem}");
        assert!(said.is_none_or(|said| said.contains(&wanted) && !said.contains("frame 2")), "{fault}");
    }
}

/// The panel forgets its registers in the middle of a frame, which the firmware cannot see.
#[test]
fn a_panel_that_lost_its_state_comes_back_within_a_second() {
    for template in [STM32, RP2040, EMBASSY] {
        template.passes(&["--break-bus", MIDDLE, "--by", "reset"]);
    }
}

/// As above, at some 8 frames a second: a count of frames in place of the time would take longer.
#[test]
fn a_panel_of_slow_frames_comes_back_within_a_second() {
    let edits = [("src/main.rs", "watchdog.feed();", "watchdog.feed();\n            delay.delay_ms(80);")];
    for template in [STM32, RP2040] {
        let Some(output) = template.run(&edits, &["--break-bus", MIDDLE, "--by", "reset"]) else { return };
        assert!(output.status.success(), "{output:?}");
    }
}

/// The firmware says why, and resets the chip, whose next start succeeds.
#[test]
fn a_bus_error_during_the_start_resets_the_chip() {
    let said = STM32.passes(&["--break-bus", "3"]);
    assert!(said.is_none_or(|said| said.contains("logs: the bus has an error")));
}

/// As above, where all of the chip is reset: the firmware gives up after a stall.
#[test]
fn an_rp2040_that_gives_up_starts_anew() {
    let log = "defmt::error!(\"frame {=u32}: {=str}\", frame, problem)";
    let edits = [("src/main.rs", log, "stop(problem)")];
    let Some(output) = RP2040.run(&edits, &["--break-bus", MIDDLE, "--by", "stall"]) else { return };
    assert!(output.status.success(), "{output:?}");
}

impl Template {
    /// Builds the firmware with the edits and runs it: the run must end with this problem.
    #[track_caller]
    fn ends(&self, edits: &[Edit], options: &[&str], problem: &str) {
        let Some(output) = self.run(edits, options) else { return };
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(!output.status.success() && said.contains(problem), "not {problem:?} but {output:?}");
    }

    /// The run must succeed. Returns its output; `None` if the tools are missing.
    #[track_caller]
    fn passes(&self, options: &[&str]) -> Option<String> {
        let output = self.run(&[], options)?;
        let said = String::from_utf8_lossy(&output.stdout).into_owned();
        assert!(
            output.status.success() && said.contains(&format!(": {FRAMES} frames equal, ")),
            "{output:?}"
        );
        Some(said)
    }

    /// Uses the button and the encoder. Returns the runs of steps in one direction, without the first and the last run; all frames
    /// must equal the host's. `None` if the tools are missing.
    #[track_caller]
    fn steps(&self, edits: &[Edit]) -> Option<Vec<i32>> {
        const BUTTON: u8 = 12;
        let mut inputs = vec![(400, BUTTON, 0), (420, BUTTON, 1)];
        let mut time = 500;
        for (clicks, [leads, follows]) in [(2, [11, 10]), (3, [10, 11]), (4, [11, 10])] {
            for _ in 0..clicks {
                inputs.extend([(time, leads, 0), (time + 3, follows, 0)]);
                inputs.extend([(time + 6, leads, 1), (time + 9, follows, 1)]);
                time += 40; // a frame takes 15 ms
            }
        }
        inputs.extend([(time, BUTTON, 0), (time + 20, BUTTON, 1)]);
        let inputs: Vec<_> =
            inputs.iter().map(|(time, pin, level)| format!("{time}:{pin}={level}")).collect();
        let output = self.run(edits, &["--frames", "40", "--inputs", &inputs.join(",")])?;
        let said = String::from_utf8_lossy(&output.stdout).into_owned();
        let steps = said.lines().find_map(|line| line.strip_prefix(&format!("{}: steps: ", self.board)));
        let steps = steps.unwrap_or_else(|| panic!("{output:?}")).split(' ');
        let steps: Vec<i32> = steps.map(|step| step.parse().expect("a number")).collect();
        assert_eq!((steps.len(), steps.first()), (40, Some(&0)));
        let differences = steps.windows(2).map(|pair| (pair[1] - pair[0] + 180) % 120 - 60);
        let mut runs: Vec<i32> = Vec::new();
        for difference in differences {
            assert_eq!(difference.abs(), 1, "{steps:?}");
            match runs.last_mut() {
                Some(run) if run.signum() == difference => *run += difference,
                _ => runs.push(difference),
            }
        }
        assert!(runs.len() >= 2 && runs.first() > Some(&0) && runs.last() > Some(&0), "{steps:?}");
        Some(runs[1..runs.len() - 1].to_vec())
    }

    /// Runs the firmware with the edits; `None` if the tools are missing.
    fn run(&self, edits: &[Edit], options: &[&str]) -> Option<Output> {
        static NUMBER: AtomicU32 = AtomicU32::new(0);
        let checks: [&[&str]; 2] =
            [&["tools/cross", "--check", self.target], &["boards/emulate/run", "--check"]];
        if !has_tools(&format!("faulty firmware for {}", self.board), &checks) {
            return None;
        }
        let folder = Folder::new(&format!("emulate-{}", NUMBER.fetch_add(1, Ordering::Relaxed)));
        let target_dir = std::env::var_os("CARGO_TARGET_DIR").map(PathBuf::from);
        let target_dir = target_dir.unwrap_or_else(|| Path::new(ROOT).join("target/cross"));
        let image = image(self.board, self.target, &target_dir, &folder.0, |copy| {
            for (file, from, to) in edits {
                edit(&copy.join(file), from, to);
            }
        });
        let output = Command::new(env!("CARGO_BIN_EXE_emulate"))
            .arg(self.board)
            .arg(image)
            .args(if options.contains(&"--frames") { &[][..] } else { &["--frames", FRAMES] })
            .args(options)
            .stdin(Stdio::null())
            .output();
        Some(output.expect("the program was built"))
    }
}
