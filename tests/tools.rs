//! What all host examples do alike with standard output and with files.

mod programs;

use programs::{command, example_in, folder, refusal};
use std::fs;
use std::path::Path;
use std::process::Stdio;

/// A triangle for `render`, and one for `coverage`.
const MODEL: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
const COUNTED: &str = r#"{"width": 2, "height": 1, "triangles": [[0, 0, 257, 0, 0, 257]]}"#;

/// Command lines that write files into the folder where they run, and say so.
const SAYING: [(&str, &str); 9] = [
    ("render", "m.obj --png p.png --size 16x16"),
    ("render", "m.obj --ascii --stats"),
    ("coverage", "in.json out"),
    ("spin", "--size 16 --frames 2 --out spin"),
    ("arm", "--size 16 --frames 2 --out arm"),
    ("surface", "--size 16 --frames 2 --out surface"),
    ("bands", "--out bands"),
    ("gallery", "--out gallery.png"),
    ("first", ""),
];

fn fill(folder: &Path) {
    fs::write(folder.join("m.obj"), MODEL).unwrap();
    fs::write(folder.join("in.json"), COUNTED).unwrap();
}

#[test]
fn who_stops_reading_ends_nothing() {
    for (name, line) in SAYING {
        let to = folder("tools", "closed");
        fill(&to);
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let words: Vec<_> = line.split_whitespace().collect();
        let done = command(&to, name, &words).stdout(writer).stderr(Stdio::piped()).output().unwrap();
        let said = String::from_utf8(done.stderr).unwrap();
        assert!(done.status.success() && said.is_empty(), "{name} {line}: {:?} {said}", done.status);
    }
}

#[cfg(target_os = "linux")]
#[test]
fn what_cannot_be_said_is_an_error() {
    for (name, line) in SAYING {
        let to = folder("tools", "full");
        fill(&to);
        let full = fs::File::options().write(true).open("/dev/full").unwrap();
        let words: Vec<_> = line.split_whitespace().collect();
        let done = command(&to, name, &words).stdout(full).stderr(Stdio::piped()).output().unwrap();
        let said = String::from_utf8(done.stderr).unwrap();
        assert_eq!(done.status.code(), Some(2), "{name} {line}: {said}");
        assert!(
            said.starts_with("standard output: cannot be written: ") && said.lines().count() == 1,
            "{said}"
        );
    }
}

/// A scene whose mesh is that of a file.
const SCENE: &str = r#"{"mesh": "m.obj", "width": 8, "height": 8,
    "model": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]], "view": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]],
    "projection": [[1,0,0,0],[0,1,0,0],[0,0,-1,0],[0,0,0,1]]}"#;

#[test]
fn what_is_read_is_not_overwritten_by_any_name() {
    for (input, name, line) in [
        ("m.obj", "render", "m.obj --png"),
        ("m.obj", "render", "m.obj --ids new --gif"),
        ("s.json", "render", "s.json --used"),
        ("m.obj", "render", "s.json --depth"),
        ("in.json", "coverage", "in.json"),
    ] {
        let to = folder("tools", "itself");
        fill(&to);
        fs::write(to.join("s.json"), SCENE).unwrap();
        #[cfg_attr(not(unix), allow(unused_mut))]
        let mut names = vec![input];
        #[cfg(unix)]
        {
            fs::hard_link(to.join(input), to.join("hard")).unwrap();
            std::os::unix::fs::symlink(input, to.join("soft")).unwrap();
            names.extend(["hard", "soft"]);
        }
        let before = (fs::read(to.join(input)).unwrap(), fs::read_dir(&to).unwrap().count());
        for output in names {
            let words: Vec<_> = line.split(' ').chain([output]).collect();
            let said = refusal(&example_in(&to, name, &words));
            assert!(said.starts_with(&format!("{output}: is the input itself")), "{words:?}: {said}");
            let after = (fs::read(to.join(input)).unwrap(), fs::read_dir(&to).unwrap().count());
            assert!(after == before, "{words:?}");
        }
    }
}

/// As where a disk is full: no file takes a byte, and the signal that says so is ignored.
#[cfg(target_os = "linux")]
fn without_room(folder: &Path, name: &str, words: &[&str]) -> std::process::Output {
    let tool = command(folder, name, words);
    let mut shell = std::process::Command::new("sh");
    shell.args(["-c", "trap '' 25; ulimit -f 0; exec \"$@\"", "sh"]).current_dir(folder);
    shell.arg(tool.get_program()).args(tool.get_args()).output().unwrap()
}

#[cfg(target_os = "linux")]
#[test]
fn a_write_that_fails_leaves_what_was_there() {
    for (name, line, output) in [
        ("render", "m.obj --size 16x16 --png", "p.png"),
        ("coverage", "in.json", "out"),
        ("gallery", "--out", "gallery.png"),
        ("bands", "--out .", "bands.png"),
        ("spin", "--size 16 --frames 2 --out .", "spin.gif"),
        ("surface", "--size 16 --frames 2 --out .", "surface.gif"),
    ] {
        for before in [None, Some("before")] {
            let to = folder("tools", "no_room");
            fill(&to);
            if let Some(before) = before {
                fs::write(to.join(output), before).unwrap();
            }
            let count = fs::read_dir(&to).unwrap().count();
            let last = Some(output).filter(|_| !line.ends_with('.'));
            let words: Vec<_> = line.split(' ').chain(last).collect();
            let done = without_room(&to, name, &words);
            let said = String::from_utf8(done.stderr).unwrap();
            assert_eq!((done.status.code(), said.lines().count()), (Some(2), 1), "{name}: {said}");
            assert!(said.contains(output) && said.contains("cannot be written"), "{said}");
            assert_eq!(fs::read_to_string(to.join(output)).ok().as_deref(), before, "{name}");
            assert_eq!(fs::read_dir(&to).unwrap().count(), count, "{name}");
        }
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_device_that_takes_nothing_leaves_the_files_as_they_were() {
    let to = folder("tools", "device");
    fill(&to);
    fs::write(to.join("ids"), "before").unwrap();
    // The picture is what is drawn last.
    let words = ["m.obj", "--size", "16x16", "--ids", "ids", "--depth", "new", "--png", "/dev/full"];
    let said = refusal(&example_in(&to, "render", &words));
    assert!(said.starts_with("/dev/full: cannot be written: "), "{said}");
    assert_eq!(fs::read(to.join("ids")).unwrap(), b"before");
    assert!(!to.join("new").exists());
    // One that takes it does so as before, and stays what it is.
    let words = ["m.obj", "--size", "1x1", "--depth", "new", "--ids", "/dev/stdout"];
    let done = example_in(&to, "render", &words);
    assert!(done.status.success() && done.stdout.len() > 4 && to.join("new").exists(), "{done:?}");
}

#[cfg(unix)]
#[test]
fn a_file_that_is_replaced_keeps_its_permissions() {
    use std::os::unix::fs::PermissionsExt;
    let to = folder("tools", "permissions");
    fill(&to);
    fs::write(to.join("out"), "before").unwrap();
    fs::set_permissions(to.join("out"), fs::Permissions::from_mode(0o640)).unwrap();
    let done = example_in(&to, "coverage", &["in.json", "out"]);
    assert!(done.status.success(), "{done:?}");
    assert_eq!(fs::metadata(to.join("out")).unwrap().permissions().mode() & 0o777, 0o640);
}
