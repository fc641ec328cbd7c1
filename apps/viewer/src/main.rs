//! The simulator: a window that shows a model on a small display, drawn as firmware draws it.
//!
//! ```text
//! cargo run --release -p pinhole-viewer --features viewer -- MODEL.stl     # needs SDL2: libsdl2-dev
//! ```

use clap::{value_parser, Arg, ArgMatches, Command};
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::prelude::*;
use embedded_graphics_simulator::sdl2::{Keycode, Mod, MouseButton};
use embedded_graphics_simulator::{OutputSettingsBuilder, SimulatorDisplay, SimulatorEvent, Window};
use pinhole_apps_support::command;
use pinhole_render::import;
use pinhole_viewer::{write_png, Action, Source, State, Viewer};
use std::ops::RangeInclusive;
use std::panic;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::{Duration, Instant};

fn main() -> ExitCode {
    command::run(|| -> Result<ExitCode, String> {
        let mut given = command::matches(arguments())?;
        let source = match given.remove_one::<PathBuf>("FILE") {
            Some(file) => {
                if let Some(name) = import::typed(&given).filter(|_| !import::is_model(&file)) {
                    return Err(format!(
                        "--{name}: a scene is drawn as it stands; use this option with .obj and .stl"
                    ));
                }
                if !import::is_model(&file) {
                    import::refuse_texture(&given)?;
                }
                Source::read(&file, &import::options(&given))?
            }
            None if import::typed(&given).is_some() || given.contains_id("texture") => {
                return Err(
                    "--up, --flip, --fix-winding, --two-sided, --root, --texture: are for a FILE".into()
                )
            }
            None => Source::built_in(),
        };
        let screenshot: Option<PathBuf> = given.remove_one("screenshot");
        screenshot.as_deref().map_or(Ok(()), |file| source.apart_from(file))?;
        let size = size(&mut given, &source)?;
        let mut state = source.state();
        let (warnings, in_firmware) = (source.warnings().collect::<Vec<_>>(), source.size_in_firmware());
        let file = source.file().map(Path::to_path_buf).unwrap_or_default();
        let mut viewer = Viewer::new(source, size);
        viewer.draw(&state)?;
        if let Some(size) = in_firmware {
            command::say(format_args!("{}: {size}", file.display()))?;
        }
        command::warn(&file, &warnings);
        for action in actions(&mut given)? {
            state.apply(action);
            viewer.draw(&state)?; // so that what changes is what the last key changed
        }
        let stay = Duration::from_millis(given.remove_one("stay").unwrap_or_default());
        let script = Script { screenshot, stay };
        let scale = given.remove_one::<u32>("scale").unwrap_or(2);
        run(viewer, state, size, scale, &script)?;
        Ok(ExitCode::SUCCESS)
    })
}

fn arguments() -> Command {
    let text = |name: &'static str, value, help| Arg::new(name).long(name).value_name(value).help(help);
    Command::new("viewer")
        .about("Shows a model in a window, as on the display of a microcontroller; press h for the keys")
        .arg(
            Arg::new("FILE")
                .help("A mesh (.obj, .stl) or a scene (.json) [default: a teapot]")
                .value_parser(value_parser!(PathBuf)),
        )
        .args(import::arguments())
        .arg(import::texture_argument())
        .arg(text(
            "size",
            "WxH",
            "Size of the display in pixels, 16 to 1024 each [default: the scene's, or 320x240]",
        ))
        .arg(
            text("scale", "N", "Magnification of the display in the window, 1 to 8 [default: 2]")
                .value_parser(value_parser!(u32).range(1..=8)),
        )
        .arg(
            text("keys", "KEYS", "Pressed at the beginning, such as \"w b p left\"")
                .allow_hyphen_values(true),
        )
        .arg(
            text("screenshot", "FILE", "Writes what the window shows, as a PNG file, and ends")
                .value_parser(value_parser!(PathBuf)),
        )
        .arg(
            text("stay", "MS", "Milliseconds from the screenshot to the end of the program")
                .value_parser(value_parser!(u64).range(..=600_000)),
        )
}

/// Width and height of a display.
const SIDES: RangeInclusive<u32> = 16..=1024;

fn size(given: &mut ArgMatches, source: &Source) -> Result<Size, String> {
    if let Some(text) = given.remove_one::<String>("size") {
        return command::size(&text, SIDES);
    }
    let size = source.size().unwrap_or(Size::new(320, 240));
    if SIDES.contains(&size.width) && SIDES.contains(&size.height) {
        return Ok(size);
    }
    let Size { width, height } = size;
    let (low, high) = (SIDES.start(), SIDES.end());
    Err(source
        .named(&format!("is of {width} x {height} pixels, but a display has {low} to {high} on a side: state its size by --size")))
}

/// A script, which replaces a user's input.
struct Script {
    screenshot: Option<PathBuf>,
    stay: Duration,
}

fn actions(given: &mut ArgMatches) -> Result<Vec<Action>, String> {
    let keys: String = given.remove_one("keys").unwrap_or_default();
    let action =
        |name| State::key(name).ok_or_else(|| format!("--keys: {name} is not a key; h shows the keys"));
    keys.split_whitespace().map(action).collect()
}

/// Without a display SDL would draw into an invisible window.
fn refuse_without_display() -> Result<(), String> {
    let unset = |name| std::env::var_os(name).is_none_or(|value| value.is_empty());
    if cfg!(target_os = "linux") && ["DISPLAY", "WAYLAND_DISPLAY", "SDL_VIDEODRIVER"].into_iter().all(unset) {
        return Err("there is no display for a window: DISPLAY and WAYLAND_DISPLAY are not set \
                    (`xvfb-run` makes one; with --screenshot none is needed)"
            .into());
    }
    Ok(())
}

fn run(mut viewer: Viewer, mut state: State, size: Size, scale: u32, script: &Script) -> Result<(), String> {
    if script.screenshot.is_none() {
        refuse_without_display()?;
    }
    let mut display = SimulatorDisplay::<Rgb888>::new(size);
    let settings = OutputSettingsBuilder::new().scale(scale).build();
    let mut window = Window::new("pinhole: h for the keys", &settings);
    let (mut shown, mut time, mut held) = (None, Duration::ZERO, None::<Point>);
    loop {
        if shown != Some(state) {
            let start = Instant::now();
            viewer.draw(&state)?;
            // Smoothed over some frames. A script shows no time, so that its pictures can be compared.
            time = if shown.is_none() { start.elapsed() } else { (time * 7 + start.elapsed()) / 8 };
            let time = script.screenshot.is_none().then_some(time);
            let Ok(()) = viewer.show(&state, time, &mut display);
            shown = Some(state);
        }
        update(&mut window, &display);
        if let Some(file) = &script.screenshot {
            write(file, size, &viewer, &state)?;
            std::thread::sleep(script.stay);
            return Ok(());
        }
        for event in window.events() {
            let action = match event {
                SimulatorEvent::Quit => Some(Action::Quit),
                SimulatorEvent::KeyDown { keycode, keymod, .. } => State::key(&name(keycode, keymod)),
                SimulatorEvent::MouseWheel { scroll_delta, .. } => Some(Action::Zoom(scroll_delta.y)),
                SimulatorEvent::MouseButtonDown { mouse_btn: MouseButton::Left, point } => {
                    held = Some(point);
                    None
                }
                SimulatorEvent::MouseButtonUp { .. } => {
                    held = None;
                    None
                }
                SimulatorEvent::MouseMove { point } => {
                    if let Some(from) = held.as_mut() {
                        state.drag(point.x - from.x, point.y - from.y);
                        *from = point;
                    }
                    None
                }
                _ => None,
            };
            match action {
                Some(Action::Quit) => return Ok(()),
                Some(Action::Screenshot) => {
                    let file = free_name();
                    write(&file, size, &viewer, &state)?;
                    command::say(format_args!("{}: what the window shows", file.display()))?;
                }
                Some(action) => state.apply(action),
                None => {}
            }
        }
        state.tick();
        std::thread::sleep(Duration::from_millis(4)); // the window waits for its frame rate, too
    }
}

/// Opens the window. Where SDL refuses (an unknown `SDL_VIDEODRIVER`, no X server), embedded-graphics-simulator panics; the
/// panic hook then prints one line and ends the program, because a release build aborts and cannot catch the panic.
fn update(window: &mut Window, display: &SimulatorDisplay<Rgb888>) {
    let usual = panic::take_hook();
    panic::set_hook(Box::new(|why| {
        let problem = why.payload().downcast_ref::<String>().map_or("SDL refuses", String::as_str);
        let problem = problem.rsplit("value: ").next().unwrap_or(problem); // what `unwrap` writes before it
        command::complain(format_args!("no window can be opened: {problem}"));
        std::process::exit(2)
    }));
    window.update(display);
    panic::set_hook(usual);
}

/// The window's contents without the time.
fn write(file: &Path, size: Size, viewer: &Viewer, state: &State) -> Result<(), String> {
    let mut display = SimulatorDisplay::<Rgb888>::new(size);
    let Ok(()) = viewer.show(state, None, &mut display);
    let points = display.bounding_box().points();
    let pixels: Vec<_> = points.map(|at| display.get_pixel(at)).collect();
    write_png(file, size, &pixels)
}

/// The first file name `viewer-N.png` that does not exist.
fn free_name() -> PathBuf {
    let mut names = (1..).map(|number| PathBuf::from(format!("viewer-{number}.png")));
    names.find(|file| !file.exists()).unwrap_or_default()
}

/// The key's name for [`State::key`].
fn name(key: Keycode, modifiers: Mod) -> String {
    let name = key.name().to_lowercase();
    let shifted = modifiers.intersects(Mod::LSHIFTMOD | Mod::RSHIFTMOD);
    match name.as_str() {
        "keypad +" => "+".into(),
        "keypad -" => "-".into(),
        _ if shifted && name.len() == 1 => name.to_uppercase(),
        _ => name,
    }
}
