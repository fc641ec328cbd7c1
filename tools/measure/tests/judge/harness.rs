//! Runs `pinhole-measure render` and reads what it writes.

use pinhole_apps_support::testing::{self, refusal, Program};
use serde_json::{json, Value};
use std::fs;
use std::path::PathBuf;

pub(crate) const RENDER: Program =
    Program::new(env!("CARGO_BIN_EXE_pinhole-measure"), env!("CARGO_TARGET_TMPDIR")).subcommand("render");

/// The folder of a test.
pub(crate) struct Folder(pub(crate) PathBuf);

/// Every output of a scene.
pub(crate) struct Drawn {
    pub(crate) ids: Vec<i32>,
    pub(crate) depth: Vec<u16>,
    pub(crate) texels: Vec<u16>,
    pub(crate) used: Value,
    pub(crate) picture: Vec<[u8; 3]>,
    pub(crate) said: String,
}

impl Folder {
    pub(crate) fn new(test: &str) -> Self {
        Self(RENDER.folder("judge", test))
    }

    pub(crate) fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        fs::write(self.0.join(name), content).unwrap();
    }

    pub(crate) fn read(&self, name: &str) -> Vec<u8> {
        fs::read(self.0.join(name)).unwrap()
    }

    /// Writes a picture with red, green, blue and opacity of each pixel.
    pub(crate) fn png(&self, name: &str, [width, height]: [u32; 2], pixel: impl Fn(u32, u32) -> [u8; 4]) {
        let mut encoder = png::Encoder::new(fs::File::create(self.0.join(name)).unwrap(), width, height);
        encoder.set_color(png::ColorType::Rgba);
        let bytes: Vec<u8> = (0..width * height).flat_map(|i| pixel(i % width, i / width)).collect();
        encoder.write_header().unwrap().write_image_data(&bytes).unwrap();
    }

    /// The outputs of a scene, and of its used form, which are equal to the bit.
    pub(crate) fn draw(&self, scene: &Value, options: &[&str]) -> Drawn {
        self.write("scene.json", scene.to_string());
        self.draw_file("scene.json", options)
    }

    pub(crate) fn draw_file(&self, file: &str, options: &[&str]) -> Drawn {
        let text = self.read(file);
        let text = text.strip_prefix("\u{feff}".as_bytes()).unwrap_or(&text);
        let scene: Value = serde_json::from_slice(text).unwrap();
        let of_lines = options.iter().any(|option| ["wireframe", "hidden-line"].contains(option));
        let mut outputs = vec!["used", "png"];
        if !of_lines {
            outputs.extend(["ids", "depth"]);
        }
        if !scene["texture"].is_null() {
            outputs.push("texels");
        }
        let run = |file: &str| -> String {
            let named = outputs.iter().flat_map(|&name| [format!("--{name}"), format!("out.{name}")]);
            let words: Vec<String> = std::iter::once(file.into()).chain(named).collect();
            let words: Vec<&str> = words.iter().map(String::as_str).chain(options.iter().copied()).collect();
            let done = RENDER.run_in(&self.0, &[&words[..], &["--stats"]].concat());
            assert!(done.status.success() && done.stderr.is_empty(), "{done:?}");
            String::from_utf8(done.stdout).unwrap()
        };
        let files = || -> Vec<_> { outputs.iter().map(|name| self.read(&format!("out.{name}"))).collect() };
        let said = run(file);
        let first = files();
        self.write("again.json", &first[0]);
        run("again.json");
        assert!(files() == first, "the scene as it is used draws something else: {scene}");
        let of = |name: &str| outputs.iter().position(|output| *output == name).map(|at| &first[at][..]);
        let words = |name| {
            of(name).unwrap_or_default().as_chunks().0.iter().map(|b| u16::from_le_bytes(*b)).collect()
        };
        let ids = of("ids").unwrap_or_default().as_chunks().0;
        Drawn {
            ids: ids.iter().map(|bytes| i32::from_le_bytes(*bytes)).collect(),
            depth: words("depth"),
            texels: words("texels"),
            used: serde_json::from_slice(&first[0]).unwrap(),
            picture: testing::picture(&self.0.join("out.png")).1,
            said,
        }
    }

    /// The line that refuses a scene, which changes no file.
    pub(crate) fn refused(&self, scene: &Value, options: &[&str]) -> String {
        self.refused_text(&scene.to_string(), options)
    }

    pub(crate) fn refused_text(&self, scene: &str, options: &[&str]) -> String {
        self.write("refused.json", scene);
        self.write("kept", "as it was");
        let before = fs::read_dir(&self.0).unwrap().count();
        let words = [&["refused.json", "--used", "kept", "--png", "none"][..], options].concat();
        let said = refusal(&RENDER.run_in(&self.0, &words));
        assert!(
            self.read("kept") == b"as it was" && fs::read_dir(&self.0).unwrap().count() == before,
            "{said}"
        );
        said
    }
}

/// A triangle in front of a triangle, in a picture of 8 × 6.
pub(crate) fn scene() -> Value {
    let identity = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]];
    json!({
        "vertices": [[-1, -1, 0], [1, -1, 0], [-1, 1, 0], [-1, -1, 0.5], [0, -1, 0.5], [-1, 0, 0.5]],
        "triangles": [[0, 1, 2], [3, 4, 5]],
        "view": identity,
        // z = −1 is near −1: depth grows with −z.
        "projection": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, -1, 0], [0, 0, 0, 1]],
        "width": 8, "height": 6
    })
}

/// This scene with these fields instead of others; a field that is null goes.
pub(crate) fn with(changes: Value) -> Value {
    changed(scene(), changes)
}

pub(crate) fn changed(mut scene: Value, changes: Value) -> Value {
    for (field, value) in changes.as_object().unwrap() {
        scene[field] = value.clone();
    }
    scene.as_object_mut().unwrap().retain(|_, value| !value.is_null());
    scene
}

/// A colour over another, `alpha` of 32 parts.
pub(crate) fn mix(own: [u8; 3], below: [u8; 3], alpha: u32) -> [u8; 3] {
    [0, 1, 2].map(|i| ((u32::from(own[i]) * alpha + u32::from(below[i]) * (32 - alpha) + 16) / 32) as u8)
}
