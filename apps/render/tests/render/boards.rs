//! The templates for boards and the preview: frames of a turn, and whose code draws a model.

use pinhole_render::firmware;
use std::path::Path;

const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");

/// The preview counts frames as these templates do; the STM32F411's, whose bus is slow, turns in fewer.
#[test]
fn the_templates_turn_in_as_many_frames_as_the_preview() {
    let wanted = format!("\nconst FRAMES: u32 = {};\n", firmware::FRAMES);
    for board in ["any-cortex-m", "rp2040-st7789"] {
        let main =
            std::fs::read_to_string(Path::new(ROOT).join("boards").join(board).join("src/main.rs")).unwrap();
        assert!(main.contains(&wanted), "{board}");
    }
}

/// Which code draws a model with `--firmware`: that of the project it lies in, unless it is the template that is compiled in.
#[test]
fn a_model_is_drawn_by_the_project_that_it_lies_in() {
    let of = |file: &str| firmware::project(&Path::new(ROOT).join(file));
    assert_eq!(of("boards/common/all/model.stl"), None);
    assert_eq!(of("assets/teapot.obj"), None);
    // A copy, and then one with another colour.
    let copy = Path::new(env!("CARGO_TARGET_TMPDIR")).join("boards-copy");
    std::fs::create_dir_all(copy.join("src")).unwrap();
    std::fs::create_dir_all(copy.join("parts")).unwrap();
    for (group, file) in [("all", "build.rs"), ("all", "model.stl"), ("one-strip", "src/picture.rs")] {
        let shared = Path::new(ROOT).join("boards/common").join(group).join(file);
        std::fs::copy(shared, copy.join(file)).unwrap();
    }
    std::fs::copy(copy.join("model.stl"), copy.join("parts/gear.stl")).unwrap();
    for file in ["model.stl", "parts/gear.stl"] {
        assert_eq!(firmware::project(&copy.join(file)), None);
    }
    let picture = std::fs::read_to_string(copy.join("src/picture.rs")).unwrap();
    std::fs::write(copy.join("src/picture.rs"), picture.replace("CSS_GOLD", "CSS_TEAL")).unwrap();
    for file in ["model.stl", "parts/gear.stl"] {
        assert_eq!(firmware::project(&copy.join(file)), Some(copy.canonicalize().unwrap()));
    }
}
