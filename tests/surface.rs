//! The example of a surface that changes in every frame: its film has its frames, and they differ.

mod programs;

use std::collections::BTreeSet;
use std::fs::File;
use std::io::BufReader;

#[test]
fn a_film_has_its_frames_and_its_sheet() {
    let out = programs::folder("surface", "film");
    let done =
        programs::example("surface", &["--size", "48", "--frames", "5", "--out", out.to_str().unwrap()]);
    assert!(done.status.success() && done.stderr.is_empty(), "{done:?}");
    let said = String::from_utf8(done.stdout).unwrap();
    assert!(said.contains("5 frames in bands of 16 rows"), "{said}");

    let file = File::open(out.join("surface.gif")).unwrap();
    let mut gif = gif::DecodeOptions::new().read_info(file).unwrap();
    assert_eq!((gif.width(), gif.height()), (48, 48));
    let mut frames = BTreeSet::new();
    while let Some(frame) = gif.read_next_frame().unwrap() {
        let shades: BTreeSet<u8> = frame.buffer.iter().copied().collect();
        assert!(shades.len() > 30, "{} colours", shades.len());
        frames.insert(frame.buffer.to_vec());
    }
    assert_eq!(frames.len(), 5, "each frame shows another surface");
    let sheet = BufReader::new(File::open(out.join("contact-sheet.png")).unwrap());
    let sheet = png::Decoder::new(sheet).read_info().unwrap();
    assert_eq!((sheet.info().width, sheet.info().height), (4 * 48, 48));
}

#[test]
fn bad_input_is_one_line_and_exit_code_2() {
    for arguments in [&["--size", "9"][..], &["--frames", "1"], &["--colour", "red"]] {
        programs::refusal(&programs::example("surface", arguments));
    }
}
