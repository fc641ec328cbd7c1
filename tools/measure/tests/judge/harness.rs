//! Runs `pinhole-measure render` and reads what it writes.

use pinhole_apps_support::testing::{self, refusal, Program};
use serde_json::Value;
use std::fs;
use std::path::PathBuf;
use support::oracle::picture::Scene;

pub(crate) const RENDER: Program =
    Program::new(env!("CARGO_BIN_EXE_pinhole-measure"), env!("CARGO_TARGET_TMPDIR")).subcommand("render");

/// The folder of a test.
pub(crate) struct Folder(pub(crate) PathBuf);

/// Every output of a scene.
#[derive(Debug)]
pub(crate) struct Drawn {
    pub(crate) ids: Vec<i32>,
    pub(crate) depth: Vec<u16>,
    pub(crate) texels: Vec<u16>,
    pub(crate) used: Value,
    pub(crate) width: usize,
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

    /// The outputs of a scene.
    pub(crate) fn draw(&self, scene: &Value, options: &str) -> Drawn {
        self.write("scene.json", scene.to_string());
        self.draw_file("scene.json", options, !scene["texture"].is_null())
    }

    /// The outputs of a file; those of a scene are equal to the bit when it is drawn again as it was used.
    pub(crate) fn draw_file(&self, file: &str, options: &str, is_textured: bool) -> Drawn {
        let is_scene = file.ends_with(".json");
        let of_lines = ["wireframe", "hidden-line"].iter().any(|mode| options.contains(mode));
        let mut outputs = vec!["used", "png"];
        outputs.extend(["ids", "depth"].iter().filter(|_| !of_lines));
        outputs.extend(is_textured.then_some("texels"));
        let named: String = outputs.iter().map(|name| format!(" --{name} out.{name}")).collect();
        let run = |file: &str| -> String {
            let words = format!("{options}{named} --stats");
            let words: Vec<&str> = std::iter::once(file).chain(words.split_whitespace()).collect();
            let done = RENDER.run_in(&self.0, &words);
            // Of a mesh there may be warnings.
            let is_well = done.status.success() && (done.stderr.is_empty() || !is_scene);
            assert!(is_well, "{words:?}: {done:?}");
            String::from_utf8(done.stdout).unwrap()
        };
        let files = || -> Vec<_> { outputs.iter().map(|name| self.read(&format!("out.{name}"))).collect() };
        let said = run(file);
        let first = files();
        if is_scene {
            self.write("again.json", &first[0]);
            run("again.json");
            assert!(files() == first, "{file}, as it is used, draws something else: {options}");
        }
        let of =
            |name: &str| outputs.iter().position(|output| *output == name).map_or(&[][..], |at| &first[at]);
        let words = |name| of(name).as_chunks().0.iter().map(|b| u16::from_le_bytes(*b)).collect();
        let ([width, _], picture) = testing::picture(&self.0.join("out.png"));
        Drawn {
            ids: of("ids").as_chunks().0.iter().map(|bytes| i32::from_le_bytes(*bytes)).collect(),
            depth: words("depth"),
            texels: words("texels"),
            used: serde_json::from_slice(&first[0]).unwrap(),
            width,
            picture,
            said,
        }
    }

    /// The line that refuses a scene, which changes no file.
    pub(crate) fn refused(&self, scene: &str, options: &[&str]) -> String {
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

/// A scene with these fields instead of others; a field that is null goes.
pub(crate) fn changed(mut scene: Value, changes: &Value) -> Value {
    for (field, value) in changes.as_object().into_iter().flatten() {
        scene[field] = value.clone();
    }
    scene.as_object_mut().unwrap().retain(|_, value| !value.is_null());
    scene
}

/// A vector, or any other list of numbers.
pub(crate) fn numbers<const N: usize>(value: &Value) -> [f64; N] {
    core::array::from_fn(|i| value[i].as_f64().unwrap_or_else(|| panic!("{value}: no number {i}")))
}

/// The scene as it was used, for the oracle.
pub(crate) fn used(value: &Value) -> Scene {
    let matrix = |name: &str| core::array::from_fn(|i| numbers(&value[name][i]));
    let corner = |index: f64| index as usize;
    Scene {
        vertices: value["vertices"].as_array().unwrap().iter().map(numbers).collect(),
        triangles: value["triangles"].as_array().unwrap().iter().map(|t| numbers(t).map(corner)).collect(),
        model: matrix("model"),
        view: matrix("view"),
        projection: matrix("projection"),
        width: value["width"].as_u64().unwrap() as usize,
        height: value["height"].as_u64().unwrap() as usize,
        viewport: numbers(&value["viewport"]),
        cull: value["cull"] == "back",
    }
}
