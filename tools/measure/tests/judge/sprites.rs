//! Sprites in scene files, against pictures that are computed here from the definition: a pixel shows the texel that holds its centre.

use crate::harness::{changed, mix, scene as base_scene, Folder, RENDER};
use pinhole_apps_support::testing::input_is_not_overwritten;
use serde_json::{json, Value};
use std::fs;
use std::path::Path;

const WIDTH: usize = 32;
const HEIGHT: usize = 16;

/// A scene of 32 × 16 pixels, 8 to a unit at distance 4: x from −2 to 2, y from −1 to 1. A triangle at distance 4 covers its lower
/// left half.
fn scene(perspective: bool) -> Value {
    // Near is 1 and far is 9.
    let projection = match perspective {
        true => json!([[2, 0, 0, 0], [0, 4, 0, 0], [0, 0, -1.25, -2.25], [0, 0, -1, 0]]),
        false => json!([[0.5, 0, 0, 0], [0, 1, 0, 0], [0, 0, -0.25, -1.25], [0, 0, 0, 1]]),
    };
    let triangle = json!({"vertices": [[-2, -1, -4], [2, -1, -4], [-2, 1, -4]], "triangles": [[0, 1, 2]],
        "projection": projection, "width": WIDTH, "height": HEIGHT});
    changed(base_scene(), triangle)
}

/// This scene, without perspective, with sprites.
fn with(sprites: Value) -> Value {
    changed(scene(false), json!({"sprites": sprites}))
}

/// Red, green, blue and opacity of a texel of the test's picture, 6 × 4.
fn texel(column: u32, row: u32) -> [u8; 4] {
    let opacity = if (column + 2 * row) % 5 == 3 { 127 } else { 128 };
    [40 * column as u8, 60 * row as u8, 200 - 10 * (column * row) as u8, opacity]
}

const COLUMNS: u32 = 6;
const ROWS: u32 = 4;

/// A picture of 24 bits per pixel as a BMP file: the lower row first, blue first, rows of a multiple of 4 bytes.
fn bmp(file: &Path, pixel: impl Fn(u32, u32) -> [u8; 3]) {
    let mut rows = Vec::new();
    for row in (0..ROWS).rev() {
        (0..COLUMNS).for_each(|column| rows.extend(pixel(column, row).iter().rev()));
        rows.resize(rows.len().next_multiple_of(4), 0);
    }
    let mut bytes = b"BM".to_vec();
    for number in [54 + rows.len() as u32, 0, 54, 40, COLUMNS, ROWS] {
        bytes.extend(number.to_le_bytes());
    }
    bytes.extend([1, 0, 24, 0]);
    for number in [0, rows.len() as u32, 0, 0, 0, 0] {
        bytes.extend(number.to_le_bytes());
    }
    bytes.extend(rows);
    fs::write(file, bytes).unwrap();
}

/// The folder of a test, with its picture.
fn folder(name: &str) -> Folder {
    let to = Folder::new(name);
    to.png("picture.png", [COLUMNS, ROWS], texel);
    to
}

/// The picture of a scene, and what was printed.
fn drawn(to: &Folder, scene: &Value, options: &[&str]) -> (Vec<[u8; 3]>, String) {
    let mode = if options.contains(&"--mode") { &[][..] } else { &["--mode", "flat"] };
    let drawn = to.draw(scene, &[&["--background", "#0000ff"], mode, options].concat());
    (drawn.picture, drawn.said)
}

/// A sprite by the definition: where its rectangle begins and how large it is, in pixels, its distance, and its texels.
struct Sprite<'t> {
    low: [f64; 2],
    size: [f64; 2],
    distance: f64,
    texels: [u32; 2],
    texel: &'t dyn Fn(u32, u32) -> Option<[u8; 3]>,
}

impl Sprite<'_> {
    fn color(&self, x: usize, y: usize) -> Option<[u8; 3]> {
        let offset = [x as f64 + 0.5 - self.low[0], y as f64 + 0.5 - self.low[1]];
        let is_in = (0..2).all(|i| (0.0..self.size[i]).contains(&offset[i]));
        let [column, row] =
            [0, 1].map(|i| (offset[i] * f64::from(self.texels[i]) / self.size[i]).floor() as u32);
        is_in.then(|| (self.texel)(column, row)).flatten()
    }
}

/// The pixel of a point at a distance.
fn at([x, y, z]: [f64; 3], perspective: bool) -> [f64; 2] {
    let scale = if perspective { 8.0 * 4.0 / -z } else { 8.0 };
    [16.0 + scale * x, 8.0 - scale * y]
}

/// Draws sprites over a picture without any, in which the triangle is what is not the background. `test`: with depths.
fn over(base: &[[u8; 3]], sprites: &[Sprite<'_>], test: bool) -> Vec<[u8; 3]> {
    let mut pixels = base.to_vec();
    for (index, pixel) in pixels.iter_mut().enumerate() {
        let mut stored = if *pixel == [0, 0, 255] { f64::INFINITY } else { 4.0 };
        for sprite in sprites {
            if let Some(color) =
                sprite.color(index % WIDTH, index / WIDTH).filter(|_| !test || sprite.distance < stored)
            {
                *pixel = color;
                stored = sprite.distance;
            }
        }
    }
    pixels
}

fn opaque(column: u32, row: u32) -> Option<[u8; 3]> {
    let [r, g, b, opacity] = texel(column, row);
    (opacity >= 128).then_some([r, g, b])
}

#[test]
fn a_pixel_shows_the_texel_that_holds_its_centre() {
    let to = folder("texels");
    // Powers of two, so that points are exact: before, in the plane of and behind the triangle.
    let points = [[-1.5, 0.25, -2.0], [1.0625, -0.28125, -4.0], [-0.625, -0.5, -8.0], [0.25, 0.25, -2.0]];
    let anchors = [
        ("top-left", [0.0, 0.0]),
        ("top-center", [0.5, 0.0]),
        ("top-right", [1.0, 0.0]),
        ("center-left", [0.0, 0.5]),
        ("center", [0.5, 0.5]),
        ("center-right", [1.0, 0.5]),
        ("bottom-left", [0.0, 1.0]),
        ("bottom-center", [0.5, 1.0]),
        ("bottom-right", [1.0, 1.0]),
    ];
    let texel_anchors = [([0, 0], [0.0, 0.0]), ([3, 1], [0.5, 0.25]), ([4096, 2], [1.0, 0.5])];
    let anchors = anchors.map(|(name, part)| (json!(name), part)).into_iter();
    let anchors: Vec<_> = anchors.chain(texel_anchors.map(|(texel, part)| (json!(texel), part))).collect();
    let mut hidden = 0;
    for perspective in [false, true] {
        let (base, _) = drawn(&to, &scene(perspective), &[]);
        assert!((200..300).contains(&base.iter().filter(|&&pixel| pixel != [0, 0, 255]).count()));
        for (index, (anchor, part)) in anchors.iter().enumerate() {
            // The field that has the size, and the size at 8 pixels to a unit.
            let (field, value, size) = [
                ("pixels", json!(1), [6.0, 4.0]),
                ("pixels", json!(2), [12.0, 8.0]),
                ("size", json!([0.5, 1.25]), [4.0, 10.0]),
                ("height", json!(0.75), [9.0, 6.0]),
            ][index % 4]
                .clone();
            for depth in ["test", "none"] {
                let mut entry = json!({"picture": "picture.png", "at": points, "depth": depth});
                (entry[field], entry["anchor"]) = (value.clone(), anchor.clone());
                let with = changed(scene(perspective), json!({"sprites": [entry]}));
                let (pixels, said) = drawn(&to, &with, &[]);
                assert!(said.contains("of 4 sprites 4 drawn, 0 outside, 0 without size"), "{said}");
                let sprites = points.map(|point| {
                    let scale = if perspective && field != "pixels" { 4.0 / -point[2] } else { 1.0 };
                    let (at, size) = (at(point, perspective), size.map(|side| side * scale));
                    let low = [0, 1].map(|i| at[i] - part[i] * size[i]);
                    Sprite { low, size, distance: -point[2], texels: [COLUMNS, ROWS], texel: &opaque }
                });
                let expected = over(&base, &sprites, depth == "test");
                let unequal = (0..pixels.len()).find(|&i| pixels[i] != expected[i]);
                assert!(unequal.is_none(), "{with}: pixel {unequal:?}");
                hidden += usize::from(expected != over(&base, &sprites, false));
            }
        }
    }
    assert!(hidden > 10, "{hidden}");
}

#[test]
fn a_bmp_file_and_a_key_are_a_picture_with_transparent_texels() {
    let to = folder("key");
    let key = [255, 0, 255];
    bmp(&to.0.join("keyed.bmp"), |column, row| opaque(column, row).unwrap_or(key));
    let draw = |entry: Value| drawn(&to, &with(json!([entry])), &[]).0;
    let at = json!([0.3, 0.2, -2]);
    let transparent = draw(json!({"picture": "picture.png", "at": at, "pixels": 2}));
    assert_eq!(draw(json!({"picture": "keyed.bmp", "at": at, "pixels": 2, "key": key})), transparent);
    let plain = draw(json!({"picture": "keyed.bmp", "at": at, "pixels": 2}));
    assert_eq!(plain.iter().filter(|&&pixel| pixel == key).count(), 4 * 4);
    assert!(!transparent.contains(&key));
}

/// Squares and discs of one colour, in a picture of their own for each.
#[test]
fn ready_pictures_are_squares_and_discs() {
    let to = folder("ready");
    // By hand: the discs of embedded-graphics' `Circle`.
    let discs = [
        (1, "#"),
        (2, "## ##"),
        (3, ".#. ### .#."),
        (4, ".##. #### #### .##."),
        (5, ".###. ##### ##### ##### .###."),
        (8, "..####.. .######. ######## ######## ######## ######## .######. ..####.."),
    ];
    let (base, _) = drawn(&to, &scene(false), &[]);
    let color = [250, 200, 10];
    for (side, rows) in discs {
        let rows: Vec<&[u8]> = rows.split(' ').map(str::as_bytes).collect();
        for picture in ["disc", "square"] {
            let (point, anchor) = ([-0.5, 0.25, -2.0], "top-left");
            let entry =
                json!({"picture": picture, "color": color, "pixels": side, "at": point, "anchor": anchor});
            let shape = |column: u32, row: u32| {
                (picture == "square" || rows[row as usize][column as usize] == b'#').then_some(color)
            };
            let size = [f64::from(side); 2];
            let sprite =
                Sprite { low: at(point, false), size, distance: 2.0, texels: [side; 2], texel: &shape };
            assert_eq!(
                drawn(&to, &with(json!([entry])), &[]).0,
                over(&base, &[sprite], true),
                "{picture} {side}"
            );
        }
    }
    // Without a name it is a square of one pixel; in world units a disc covers π/4 of its square.
    let count = |entry: Value| {
        let pixels = drawn(&to, &with(json!([entry])), &[]).0;
        pixels.iter().filter(|&&pixel| pixel == color).count()
    };
    assert_eq!(count(json!({"color": color, "at": [[-0.5, 0.25, -2], [0.5, 0.25, -2]]})), 2);
    let covered = count(json!({"picture": "disc", "color": color, "size": [1.75, 1.75], "at": [0, 0, -2]}));
    assert!((145..=165).contains(&covered), "{covered}"); // 14²·π/4 is 153.9
}

#[test]
fn translucent_sprites_are_mixed_from_far_to_near() {
    let to = folder("alpha");
    let (base, _) = drawn(&to, &scene(false), &[]);
    let [near, middle, far] = [[200, 100, 0], [0, 40, 250], [90, 250, 60]];
    let entry = |color: [u8; 3], distance: i32, alpha: u8| json!({"color": color, "pixels": 6, "alpha": alpha, "at": [0, 0, -distance]});
    // The triangle hides the far one, which comes last in the file, and the near one comes first.
    let three = with(json!([entry(near, 2, 20), entry(middle, 3, 9), entry(far, 6, 16)]));
    let (pixels, _) = drawn(&to, &three, &[]);
    for (index, (&pixel, &below)) in pixels.iter().zip(&base).enumerate() {
        let (x, y) = (index % WIDTH, index / WIDTH);
        let is_in = (13..19).contains(&x) && (5..11).contains(&y);
        let behind = if below == [0, 0, 255] { mix(far, below, 16) } else { below };
        let expected = if is_in { mix(near, mix(middle, behind, 9), 20) } else { below };
        assert_eq!(pixel, expected, "{x}, {y}");
    }
    // They hide nothing, but are hidden by those that are stored, which come first in any order of the file.
    let two = with(json!([entry(near, 5, 20), {"color": middle, "pixels": 2, "at": [0, 0, -3]}]));
    let (pixels, _) = drawn(&to, &two, &[]);
    assert_eq!(pixels.iter().filter(|&&pixel| pixel == middle).count(), 4);
    // In every pixel format, all of a sprite is the sprite.
    for format in ["rgb565", "rgb666", "gray8", "gray4", "gray2", "mono"] {
        let draw = |alpha: Option<u8>| {
            let entry = json!({"picture": "picture.png", "pixels": 2, "at": [0, 0, -2], "alpha": alpha});
            let entry = changed(entry, json!({}));
            drawn(&to, &with(json!([entry])), &["--format", format, "--no-dither"]).0
        };
        assert_eq!(draw(Some(32)), draw(None), "{format}");
        assert_eq!(
            draw(Some(0)),
            drawn(&to, &scene(false), &["--format", format, "--no-dither"]).0,
            "{format}"
        );
    }
}

/// Fog by the distance of the point, as on faces: its share is rounded to 1/32.
#[test]
fn sprites_are_in_the_fog_of_the_scene() {
    let to = folder("fog");
    let color = [200, 100, 40];
    let points = [[-1.0, 0.5, -1.5], [0.5, 0.5, -3.0], [1.0, 0.5, -5.0], [1.5, 0.5, -7.0]];
    let sprites = json!([{"color": color, "pixels": 3, "at": points}]);
    let scene = changed(scene(false), json!({"fog": [2, 6], "sprites": sprites}));
    for (options, factors) in [
        (&[][..], [32, 24, 8, 0]),
        // 64^(−1/4) is 0.354 and 64^(−3/4) is 0.0442; 64^(−1/16) is 0.771 and 64^(−9/16) is 0.0964.
        (&["--fog", "2,6,exponential"], [32, 11, 1, 0]),
        (&["--fog", "2,6,squared"], [32, 25, 3, 0]),
    ] {
        let (pixels, _) = drawn(&to, &scene, options);
        for (x, factor) in [8, 20, 24, 28].into_iter().zip(factors) {
            assert_eq!(pixels[4 * WIDTH + x], mix(color, [0, 0, 255], factor), "{options:?}, {x}");
        }
    }
}

#[test]
fn sprites_are_drawn_over_lines_and_behind_what_hides_lines() {
    let to = folder("lines");
    let color = [1, 220, 30];
    let three =
        with(json!([{"color": color, "pixels": 2, "at": [[-1, -0.5, -8], [1, 0.5, -8], [-1.5, -0.5, -2]]}]));
    let count = |mode: &str| {
        let (pixels, said) = drawn(&to, &three, &["--mode", mode]);
        assert!(said.contains("of 3 sprites 3 drawn"), "{said}");
        pixels.iter().filter(|&&pixel| pixel == color).count()
    };
    assert_eq!((count("wireframe"), count("hidden-line"), count("solid")), (12, 8, 8));
    // One before the near plane, one beyond the far plane, one too small to see.
    let at = json!([[0, 0, -0.5], [0, 0, -9.5], [0, 0, -3]]);
    let (_, said) = drawn(&to, &with(json!([{"color": color, "size": [1e-6, 1e-6], "at": at}])), &[]);
    assert!(said.contains("of 3 sprites 0 drawn, 2 outside, 1 without size"), "{said}");
    let (_, said) = drawn(&to, &with(json!([{"color": color, "depth": "none", "at": at}])), &[]);
    assert!(said.contains("of 3 sprites 2 drawn, 1 outside, 0 without size"), "{said}");
}

#[test]
fn a_picture_of_a_sprite_is_not_overwritten() {
    let to = folder("kept");
    to.write("scene.json", with(json!([{"picture": "picture.png", "at": [0, 0, -2]}])).to_string());
    input_is_not_overwritten(RENDER, &to.0, "picture.png", "scene.json --png");
}
