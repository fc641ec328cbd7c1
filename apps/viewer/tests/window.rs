//! The window under a virtual display: the pixels that X shows equal those that the host renders of the same state. Without Xvfb
//! the test says so and tests nothing (with CI set it fails).

use embedded_graphics::pixelcolor::RgbColor;
use embedded_graphics::prelude::*;
use pinhole_apps_support::testing;
use pinhole_viewer::{Source, State, Viewer};
use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

const SIZE: Size = Size::new(320, 240);
const SCREEN: Size = Size::new(400, 300);
const VIEWER: &str = env!("CARGO_BIN_EXE_pinhole-viewer");

/// The picture that a window should show after these keys.
fn expected(keys: &str) -> Vec<[u8; 3]> {
    let source = Source::built_in();
    let mut state = source.state();
    let mut viewer = Viewer::new(source, SIZE);
    viewer.draw(&state).unwrap();
    for name in keys.split(' ') {
        state.apply(State::key(name).unwrap());
        viewer.draw(&state).unwrap();
    }
    viewer.picture(&state, None).iter().map(|c| [c.r(), c.g(), c.b()]).collect()
}

/// Ends what it started, whatever becomes of the test.
struct Running(Child);

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

fn wait_for<T>(what: &str, look: impl Fn() -> Option<T>) -> T {
    for _ in 0..600 {
        if let Some(found) = look() {
            return found;
        }
        sleep(Duration::from_millis(50));
    }
    panic!("no {what} in half a minute")
}

/// An X server on a display that no other has; its screen is a file.
fn server(folder: &Path) -> Option<(Running, String)> {
    let size = format!("{}x{}x24", SCREEN.width, SCREEN.height);
    let number = folder.join("number");
    let to = fs::File::create(&number).unwrap();
    let started = Command::new("Xvfb")
        .args(["-displayfd", "1", "-screen", "0", &size, "-nolisten", "tcp", "-fbdir"])
        .arg(folder)
        .stdout(Stdio::from(to))
        .stderr(Stdio::null())
        .spawn();
    let Ok(child) = started else {
        assert!(std::env::var_os("CI").is_none(), "Xvfb is missing: apt-get install xvfb");
        // Not by eprintln, which the test harness shows only when a test fails.
        write!(std::io::stderr(), "\nSKIPPED, NOT TESTED: no window was opened: apt-get install xvfb\n")
            .expect("stderr");
        return None;
    };
    let running = Running(child);
    let name = wait_for("display", || {
        let text = fs::read_to_string(&number).ok()?;
        text.ends_with('\n').then(|| format!(":{}", text.trim()))
    });
    Some((running, name))
}

/// The rows of the screen, as the X Window Dump format has them: a header of big-endian numbers, colours, pixels.
fn screen(folder: &Path) -> Vec<Vec<[u8; 3]>> {
    let bytes = fs::read(folder.join("Xvfb_screen0")).unwrap();
    let header = |place: usize| {
        let bytes = bytes[4 * place..][..4].try_into().unwrap();
        u32::from_be_bytes(bytes) as usize
    };
    let (size, width, height, stride, colours) = (header(0), header(4), header(5), header(12), header(19));
    assert_eq!((width, height, header(11)), (SCREEN.width as usize, SCREEN.height as usize, 32));
    let pixels = &bytes[size + 12 * colours..];
    let row = |y: usize| pixels[y * stride..][..4 * width].chunks(4).map(|p| [p[2], p[1], p[0]]).collect();
    (0..height).map(row).collect()
}

/// Whether the picture stands in the screen, at the corner.
fn stands_at(screen: &[Vec<[u8; 3]>], picture: &[[u8; 3]], left: usize, top: usize) -> bool {
    let width = SIZE.width as usize;
    picture.chunks(width).zip(&screen[top..]).all(|(row, of)| row == &of[left..left + width])
}

/// A program that cannot open a window refused: exit code 2, and one line, which is given.
fn refusal(mut viewer: Command) -> String {
    let done = viewer.env("DISPLAY", ":none-such").env_remove("WAYLAND_DISPLAY").output().unwrap();
    let said = String::from_utf8(done.stderr).unwrap();
    assert_eq!((done.status.code(), said.lines().count()), (Some(2), 1), "{said}");
    said
}

#[test]
fn a_scene_too_small_for_a_display_says_so_itself() {
    let scene = Path::new(env!("CARGO_TARGET_TMPDIR")).join("small.json");
    let text = r#"{"vertices": [[-1, -1, 0], [1, -1, 0], [-1, 1, 0]], "triangles": [[0, 1, 2]],
        "model": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]], "view": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]],
        "projection": [[1,0,0,0],[0,1,0,0],[0,0,-0.4,0],[0,0,0,1]], "width": 8, "height": 64}"#;
    fs::write(&scene, text).unwrap();
    let viewer = |size: &[&str]| {
        let mut viewer = Command::new(VIEWER);
        viewer.arg(&scene).args(size);
        refusal(viewer)
    };
    let expected = "is of 8 x 64 pixels, but a display has 16 to 1024 on a side: state its size by --size\n";
    assert_eq!(viewer(&[]), format!("{}: {expected}", scene.display()));
    let said = viewer(&["--size", "8x64"]);
    assert!(said.starts_with("--size: 8x64 is not WxH, each from 16 to 1024"), "{said}");
}

#[test]
fn a_window_that_cannot_be_opened_is_one_line() {
    let said = refusal(Command::new(VIEWER));
    assert!(said.starts_with("no window can be opened: "), "{said}");
}

/// A screenshot needs no window.
#[test]
fn a_screenshot_is_what_a_window_would_show() {
    let png = Path::new(env!("CARGO_TARGET_TMPDIR")).join("unseen.png");
    let _ = fs::remove_file(&png); // from an earlier run
    let done =
        Command::new(VIEWER).args(["--keys", "w h", "--screenshot"]).arg(&png).env_remove("DISPLAY").output();
    assert!(done.unwrap().status.success());
    assert!(testing::picture(&png) == ([SIZE.width as usize, SIZE.height as usize], expected("w h")));
}

#[test]
fn the_window_shows_what_the_host_renders() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("window");
    let _ = fs::remove_dir_all(&folder); // from an earlier run
    fs::create_dir_all(&folder).unwrap();
    let Some((_server, display)) = server(&folder) else { return };
    for (number, keys) in ["s - - - - r left", "l p p c h", "c c c c d up b", "b b"].into_iter().enumerate() {
        let png = folder.join(format!("{number}.png"));
        let viewer = Command::new(VIEWER)
            .args(["--scale", "1", "--stay", "60000", "--keys", keys, "--screenshot"])
            .arg(&png)
            .env("DISPLAY", &display)
            .stdout(Stdio::null())
            .spawn()
            .unwrap();
        let _viewer = Running(viewer);
        let expected = expected(keys);
        // X draws with a delay; without a window manager the window stands in the corner.
        wait_for(&format!("picture of {keys}"), || {
            stands_at(&screen(&folder), &expected, 0, 0).then_some(())
        });
    }
}
