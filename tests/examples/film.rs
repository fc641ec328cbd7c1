//! The example of a surface that changes in every frame: its film has its frames, and they differ.

use crate::programs;
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

#[test]
fn the_bands_example_draws_one_picture_in_three_ways() {
    let to = programs::folder("bands", "example");
    let done = programs::example("bands", &["--out".as_ref(), to.as_os_str()]);
    let said = String::from_utf8_lossy(&done.stdout).into_owned();
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    let others = said.split_whitespace().find_map(|word| word.parse::<u32>().ok());
    assert!(others.is_some_and(|n| n >= 30) && said.contains("the same picture three times"), "{said}");
    let file = std::fs::File::open(to.join("bands.png")).expect("a picture");
    let mut reader = png::Decoder::new(std::io::BufReader::new(file)).read_info().expect("PNG");
    let mut pixels = vec![0; reader.output_buffer_size().expect("it fits memory")];
    reader.next_frame(&mut pixels).expect("PNG");
    // A palette: the pot's shades, the caption, the background, which is not even half of it; no magenta.
    let palette = reader.info().palette.clone().expect("few colours");
    assert!(
        palette.chunks(3).any(|c| c == [255, 255, 255]) && !palette.chunks(3).any(|c| c == [255, 0, 255])
    );
    let background = pixels.iter().filter(|&&p| p == pixels[0]).count();
    assert!(palette.len() > 60 && background * 3 < pixels.len() * 2, "{background}");
}
