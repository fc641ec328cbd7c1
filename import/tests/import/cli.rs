//! The command: standard output, files and terminals. What it says of models is in `cases.txt`.
#![cfg(feature = "cli")]

use crate::common::{file, folder};
use pinhole_apps_support::testing::{self, Program};

const IMPORT: Program = Program::new(env!("CARGO_BIN_EXE_pinhole-import"), env!("CARGO_TARGET_TMPDIR"));

/// A tetrahedron: closed, so that nothing is said of it.
const TETRAHEDRON: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

/// Names that a terminal would take for a window's title, a colour, an erased screen or another direction of text.
#[test]
fn control_characters_are_shown_escaped() {
    let names = "mtllib \x1b]0;title\x07\x1b[31mred.mtl\nusemtl \u{9b}2J\u{202e}a\n";
    for (name, text, wanted) in [
        (
            "hostile.obj",
            Some(&*format!("{names}{TETRAHEDRON}")),
            "library \\u{1b}]0;title\\u{7}\\u{1b}[31mred.mtl: ",
        ),
        ("a\x1b[2J.obj", Some(&TETRAHEDRON[..TETRAHEDRON.len() - 8]), "a\\u{1b}[2J.obj: warning: "),
        ("b\x1b[2J.obj", Some("f\n"), "b\\u{1b}[2J.obj:1: "),
        ("c\x1b[2J.obj", None, "c\\u{1b}[2J.obj: cannot be read"),
    ] {
        let model = folder("cli-hostile").join(name);
        if let Some(text) = text {
            std::fs::write(&model, text).unwrap();
        }
        let done = IMPORT.run(&[model.as_os_str(), "-o".as_ref(), model.with_extension("rs").as_os_str()]);
        let said = String::from_utf8([done.stdout, done.stderr].concat()).unwrap();
        let is_harmful = |c: char| c != '\n' && c.is_control() || c == '\u{202e}';
        assert!(!said.contains(is_harmful) && said.contains(wanted), "{said:?}");
    }
}

#[test]
fn the_readme_has_the_options_of_the_help() {
    let help = String::from_utf8(IMPORT.run(&["--help"]).stdout).unwrap();
    let options = |text: &str, start: &str| -> Vec<String> {
        let rows = text.lines().filter_map(|line| line.trim_start().strip_prefix(start));
        let name = |row: &str| row.chars().take_while(|c| c.is_ascii_lowercase() || *c == '-').collect();
        let mut names: Vec<String> = rows.map(name).collect();
        names.sort();
        names
    };
    let mut known = options(&help, "--");
    known.retain(|name| !["help", "version"].contains(&name.as_str()));
    assert_eq!(options(include_str!("../../README.md"), "| `--"), known);
    assert!(known.len() == 23, "{help}");
}

#[test]
fn standard_output_and_files_are_as_of_all_programs() {
    let model = file("cli-files", "m.obj", TETRAHEDRON);
    let folder = model.parent().unwrap();
    testing::input_is_not_overwritten(IMPORT, folder, "m.obj", "m.obj -o");
    for input in ["skin.mtl", "skin.png"] {
        let folder = self::folder(&format!("cli-{input}"));
        testing::textured(&folder);
        testing::input_is_not_overwritten(IMPORT, &folder, input, "skin.obj -o");
    }
    for words in [["-", "-o", "out.rs"], ["m.obj", "-o", "-"]] {
        let said = testing::refusal(&IMPORT.run_in(folder, &words));
        assert!(said.contains(": name a file"), "{said}");
    }
    let command = || IMPORT.command(folder, &["m.obj", "-o", "out.rs"]);
    testing::closed_output_is_no_error(command());
    #[cfg(target_os = "linux")]
    {
        testing::full_output_is_an_error(command());
        testing::failed_write_changes_nothing(&command(), folder, "out.rs");
        std::fs::remove_file(folder.join("out.rs")).unwrap();
        testing::failed_write_changes_nothing(&command(), folder, "out.rs");
    }
    let said = testing::refusal(&IMPORT.run_in(folder, &["none.obj", "-o", "out.rs"]));
    assert!(said.starts_with("none.obj: cannot be read: ") && !folder.join("out.rs").exists(), "{said}");
}

/// The name of a temporary file cannot be foretold, and no link there is followed.
#[cfg(target_os = "linux")]
#[test]
fn a_link_in_the_folder_of_temporary_files_is_not_followed() {
    let model = file("cli-temporary", "m.obj", TETRAHEDRON);
    let (folder, victim) = (model.parent().unwrap(), model.with_file_name("victim"));
    std::fs::write(&victim, "precious").unwrap();
    // Names made of the number of a process, which is one of the next.
    for number in 0..4000 {
        let name = format!("stdout.{}.part", std::process::id() + number);
        std::os::unix::fs::symlink(&victim, folder.join(name)).unwrap();
    }
    let mut command = IMPORT.command(folder, &["m.obj", "-o", "/dev/stdout"]);
    let done = command.env("TMPDIR", folder).output().unwrap();
    assert!(String::from_utf8_lossy(&done.stdout).contains("pub const MESH"), "{done:?}");
    assert_eq!(std::fs::read_to_string(&victim).unwrap(), "precious");
    assert_eq!(std::fs::read_dir(folder).unwrap().count(), 4002, "nothing is left");
}
