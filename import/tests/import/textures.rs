//! Pictures of materials, from PNG and BMP files to texels, to Rust source, and to pixels.

use crate::common::folder;
use embedded_graphics::pixelcolor::{Rgb565, Rgb888, RgbColor};
use pinhole::texture::Texels;
use pinhole_import::{import, ImportedMesh, IndexedPicture, Options, TextureFormat};
use std::path::{Path, PathBuf};

/// A picture: red, green, blue and opacity of each pixel, row by row.
#[derive(Clone)]
struct Image {
    width: u32,
    height: u32,
    pixels: Vec<[u8; 4]>,
}

impl Image {
    fn from_fn(width: u32, height: u32, color: impl Fn(u32, u32) -> [u8; 3]) -> Self {
        let places = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        let opaque = |(x, y)| {
            let [r, g, b] = color(x, y);
            [r, g, b, 255]
        };
        Self { width, height, pixels: places.map(opaque).collect() }
    }

    /// Each pixel's column, row and colour.
    fn colors(&self) -> impl Iterator<Item = (u32, u32, [u8; 3])> + '_ {
        let place = |i: usize| (i as u32 % self.width, i as u32 / self.width);
        self.pixels.iter().enumerate().map(move |(i, &[r, g, b, _])| (place(i).0, place(i).1, [r, g, b]))
    }

    fn png(&self) -> Vec<u8> {
        let kind = (png::ColorType::Rgba, png::BitDepth::Eight);
        png([self.width, self.height], kind, None, self.pixels.as_flattened())
    }

    /// 24 bits a pixel, the lower row first.
    fn bmp(&self) -> Vec<u8> {
        let row = |row: &[[u8; 4]]| {
            let mut bytes: Vec<u8> = row.iter().flat_map(|&[r, g, b, _]| [b, g, r]).collect();
            bytes.resize(bytes.len().div_ceil(4) * 4, 0);
            bytes
        };
        let rows = self.pixels.chunks(self.width as usize).rev().flat_map(row);
        bmp([self.width as i32, self.height as i32], 24, 0, &[], rows)
    }

    /// As PNG or BMP, by the file's name.
    fn save(&self, path: &Path) {
        let bytes = if path.extension().is_some_and(|e| e == "bmp") { self.bmp() } else { self.png() };
        std::fs::write(path, bytes).unwrap();
    }
}

/// A PNG file, whose palette is red, green and blue of each colour.
fn png(
    [width, height]: [u32; 2],
    (color, depth): (png::ColorType, png::BitDepth),
    palette: Option<Vec<u8>>,
    data: &[u8],
) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(color);
    encoder.set_depth(depth);
    if let Some(palette) = palette {
        encoder.set_palette(palette);
    }
    let mut writer = encoder.write_header().unwrap();
    writer.write_image_data(data).unwrap();
    writer.finish().unwrap();
    bytes
}

/// A BMP file with a header of 40 bytes: what follows the header (masks or a palette), and the pixels.
fn bmp(
    [width, height]: [i32; 2],
    depth: u16,
    compression: u32,
    after: &[u8],
    pixels: impl IntoIterator<Item = u8>,
) -> Vec<u8> {
    let mut bytes = b"BM\0\0\0\0\0\0\0\0".to_vec();
    bytes.extend((54 + after.len() as u32).to_le_bytes());
    bytes.extend(40u32.to_le_bytes());
    bytes.extend(width.to_le_bytes());
    bytes.extend(height.to_le_bytes());
    bytes.extend(1u16.to_le_bytes());
    bytes.extend(depth.to_le_bytes());
    bytes.extend(compression.to_le_bytes());
    bytes.extend([0; 20]);
    bytes.extend(after);
    bytes.extend(pixels);
    bytes
}

/// A square in the plane z = 0, with all of a picture on it.
const SQUARE: &str = "mtllib square.mtl\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\n\
    vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl paint\nf 1/1 2/2 3/3 4/4\n";

/// A new folder with the square, its library that names this picture, and the picture.
fn square(test: &str, map: &str, file: &str, picture: Image) -> PathBuf {
    let folder = folder(&format!("textures-{test}"));
    std::fs::write(folder.join("square.mtl"), format!("newmtl paint\nKd 1 1 1\n{map}\n")).unwrap();
    std::fs::write(folder.join("square.obj"), SQUARE).unwrap();
    picture.save(&folder.join(file));
    folder.join("square.obj")
}

fn with(colors: usize) -> Options {
    Options { texture: Some(TextureFormat { colors, ..TextureFormat::default() }), ..Options::default() }
}

/// The warnings about the picture.
fn said(mesh: &ImportedMesh) -> Vec<String> {
    let all = mesh.warnings.iter().map(ToString::to_string);
    all.filter(|text| !text.starts_with("open edges")).collect()
}

/// 16 × 8 pixels, each of its own colour, which 16-bit colour tells apart, too.
fn numbered() -> Image {
    Image::from_fn(16, 8, |x, y| [x as u8 * 16, y as u8 * 32, 255])
}

#[test]
fn texels_are_the_pictures_pixels() {
    for file in ["numbered.png", "numbered.bmp"] {
        let path = square(&format!("exact-{file}"), &format!("map_Kd {file}"), file, numbered());
        let mesh = import(&path, &with(256)).unwrap();
        assert_eq!(said(&mesh), Vec::<String>::new());
        let picture = mesh.picture.as_ref().unwrap();
        assert_eq!((picture.width, picture.height, picture.bits(), picture.error), (16, 8, 8, 0));
        assert_eq!(picture.flash_bytes(), 16 * 8 + 256 * 2);
        for (row, column) in (0..8).flat_map(|row| (0..16).map(move |column| (row, column))) {
            assert_eq!(picture.color(column, row), [column as u8 * 16, row as u8 * 32, 255]);
        }
        assert_eq!(picture.color(16, 0), [0; 3]);
        assert_eq!(mesh.files, [path.with_file_name("square.mtl"), path.with_file_name(file)]);
    }
    // The picture is only read if it is asked for.
    let path = square("unasked", "map_Kd nowhere.png", "other.png", numbered());
    let mesh = import(&path, &Options::default()).unwrap();
    let unwanted = "pictures of materials: 1, the first nowhere.png; left out: use --texture 16";
    assert_eq!((mesh.picture.as_ref(), &said(&mesh)[..]), (None, &[unwanted.to_string()][..]));
}

#[test]
fn texels_of_few_bits_fill_bytes_from_the_left() {
    for (colors, bits) in [(2, 1), (4, 2), (16, 4)] {
        let of = |x: u32, y: u32| ((x * 7 + y * 3) % colors) as u8;
        let picture = Image::from_fn(32, 16, |x, y| [of(x, y) * 17, 255 - of(x, y), 9]);
        let path = square(&format!("bits-{bits}"), "map_Kd few.png", "few.png", picture.clone());
        let mesh = import(&path, &with(colors as usize)).unwrap();
        let read = mesh.picture.unwrap();
        assert_eq!((read.bits(), read.texels.len()), (bits, 32 * 16 * bits as usize / 8));
        let palette: Vec<Rgb888> = read.palette.iter().map(|&[r, g, b]| Rgb888::new(r, g, b)).collect();
        // As the library reads them.
        let shown = |u: u32, v: u32| -> Rgb888 {
            match bits {
                1 => pinhole::texture::IndexedTexels::<_, 1>::new(&read.texels, 32, 16, &palette)
                    .unwrap()
                    .texel(u, v),
                2 => pinhole::texture::IndexedTexels::<_, 2>::new(&read.texels, 32, 16, &palette)
                    .unwrap()
                    .texel(u, v),
                _ => pinhole::texture::IndexedTexels::<_, 4>::new(&read.texels, 32, 16, &palette)
                    .unwrap()
                    .texel(u, v),
            }
        };
        for (x, y, [r, g, b]) in picture.colors() {
            assert_eq!(read.color(x as usize, y as usize), [r, g, b]);
            assert_eq!(shown(x << 27, y << 28), Rgb888::new(r, g, b));
        }
    }
}

/// Red, green and blue are 1/3, 2/3 and all of few levels, so that one palette holds picture and means.
#[test]
fn mip_levels_are_those_of_the_library() {
    let few = Image::from_fn(16, 8, |x, y| [0, 1, 2].map(|i| (x * y + x) as u8 % 2 * 3 * (i + 1)));
    let path = square("mips", "map_Kd few.png", "few.png", few.clone());
    let mips = |mip_levels| {
        let format = TextureFormat { mip_levels, ..TextureFormat::default() };
        import(&path, &Options { texture: Some(format), ..Options::default() }).unwrap()
    };
    let (mesh, without) = (mips(true), mips(false).picture.unwrap());
    let read = mesh.picture.as_ref().unwrap();
    assert_eq!((said(&mesh).len(), read.error, read.rows(), read.texels.len()), (0, 0, 16, 2 * 16 * 8));
    assert_eq!(read.flash_bytes(), without.flash_bytes() + 16 * 8);
    let palette: Vec<Rgb888> = read.palette.iter().map(|&[r, g, b]| Rgb888::new(r, g, b)).collect();
    let texels = pinhole::texture::IndexedTexels::<_, 8>::new(&read.texels, 16, 16, &palette).unwrap();
    let mut picture = [[Rgb888::BLACK; 16]; 8];
    for (x, y, color @ [r, g, b]) in few.colors() {
        assert_eq!(read.color(x as usize, y as usize), color);
        picture[y as usize][x as usize] = Rgb888::new(r, g, b);
    }
    let built = pinhole::texture::MipPicture::build(picture);
    let mixed = built.copies().as_flattened().iter().filter(|texel| texel.r() % 3 != 0).count();
    assert!(mixed > 20, "{mixed}");
    for (level, row, column) in (0..4).flat_map(|l| (0..8).flat_map(move |v| (0..16).map(move |u| (l, v, u))))
    {
        let (u, v) = (column << 28, row << 29);
        let own = pinhole::texture::MipTexels::new(texels).covered_by(level << 16).texel(u, v);
        assert_eq!(
            own,
            pinhole::texture::MipTexels::new(&built).covered_by(level << 16).texel(u, v),
            "{level}: {column}, {row}"
        );
    }
}

#[test]
fn more_colours_than_a_palette_holds_become_fewer() {
    let smooth = Image::from_fn(64, 64, |x, y| [x as u8 * 4, y as u8 * 4, 128]);
    // How far a channel is off on average, against a palette of so many colours on a square grid of red and green: a quarter of
    // a cell of 256/√n. NeuQuant weighs colours by how often they occur, and comes near that grid.
    for (colors, bits) in [(256, 8), (16, 4), (4, 2), (2, 1)] {
        let path = square(&format!("smooth-{bits}"), "map_Kd smooth.png", "smooth.png", smooth.clone());
        let mesh = import(&path, &with(colors)).unwrap();
        let read = mesh.picture.as_ref().unwrap();
        assert_eq!(read.palette.len(), colors);
        let (mut sum, mut worst) = (0, 0);
        for (x, y, pixel) in smooth.colors() {
            let color = read.color(x as usize, y as usize);
            let off = [0, 1, 2].map(|i| pixel[i].abs_diff(color[i]));
            sum += u32::from(off[0]) + u32::from(off[1]);
            worst = worst.max(*off.iter().max().unwrap());
        }
        assert_eq!(worst, read.error);
        let message = format!(
            "picture smooth.png: 4096 colours become {colors}, a channel off by up to {worst} of 255"
        );
        assert_eq!(said(&mesh), [message]);
        let (mean, grid) = (f64::from(sum) / 8192.0, 64.0 / (colors as f64).sqrt());
        println!("{colors}: {mean:.1} off on average, {worst} at most; a grid {grid:.1}");
        assert!(mean < 1.6 * grid, "{colors}: {mean} {grid}");
    }
}

#[test]
fn other_sizes_are_resampled() {
    // Left half red, right half blue: the same after any resampling, but near the middle.
    for (from, to, mip_levels) in [
        ((8, 256), (8, 256), false),
        ((100, 40), (128, 32), false),
        ((3, 1000), (8, 256), false),
        ((90, 91), (64, 128), false),
        ((8, 256), (8, 128), true),
    ] {
        let halves =
            Image::from_fn(from.0, from.1, |x, _| if 2 * x < from.0 { [255, 0, 0] } else { [0, 0, 255] });
        let path =
            square(&format!("size-{}-{mip_levels}", from.0), "map_Kd halves.png", "halves.png", halves);
        let texture = Some(TextureFormat { mip_levels, ..TextureFormat::default() });
        let mesh = import(&path, &Options { texture, ..Options::default() }).unwrap();
        let read = mesh.picture.as_ref().unwrap();
        assert_eq!((read.width, read.height), to);
        let is_whole = (from.0 as usize, from.1 as usize) == to;
        assert_eq!(said(&mesh).len(), usize::from(!is_whole), "{:?}", said(&mesh));
        if let [text] = &said(&mesh)[..] {
            let wanted =
                format!("picture halves.png: {} x {} pixels become {} x {}, ", from.0, from.1, to.0, to.1);
            assert!(text.starts_with(&wanted), "{text}");
        }
        assert_eq!(read.color(0, to.1 / 2), [255, 0, 0]);
        assert_eq!(read.color(to.0 - 1, to.1 / 2), [0, 0, 255]);
    }
}

#[test]
fn doubtful_pictures_are_written_and_formats_that_there_are_not_refused() {
    let mut glass = Image::from_fn(8, 8, |_, _| [9; 3]);
    glass.pixels.iter_mut().step_by(4).for_each(|pixel| pixel[3] = 0);
    let see_through = "picture it.png: transparent pixels: 16, written as if they were not";
    let size = "texture of 256 x 128 texels: 33280 bytes of flash; if that is too much, reduce the picture, or use --texture 16";
    for (picture, doubt) in [(glass, see_through), (Image::from_fn(256, 128, |_, _| [1, 2, 3]), size)] {
        let mesh = import(&square("doubtful", "map_Kd it.png", "it.png", picture), &with(256)).unwrap();
        assert_eq!((mesh.picture.is_some(), said(&mesh)), (true, vec![doubt.to_string()]));
    }
    let path = square("format", "map_Kd numbered.png", "numbered.png", numbered());
    let error = import(&path, &with(3)).unwrap_err().to_string();
    assert!(error.ends_with(": a texture has 2, 4, 16 or 256 colours"), "{error}");
}

/// The picture in a file, and the warnings about it.
fn read_picture(test: &str, file: &str, bytes: &[u8]) -> (Option<IndexedPicture>, String) {
    let path = square(test, &format!("map_Kd {file}"), file, numbered());
    std::fs::write(path.with_file_name(file), bytes).unwrap();
    let mesh = import(&path, &with(256)).unwrap();
    let said = said(&mesh).join("|");
    (mesh.picture, said)
}

/// 8 × 8 pixels by all kinds of BMP files: what each writer means by its bits is written here from the format's definition.
#[test]
fn bmp_files_of_all_kinds_are_read() {
    // Each pixel has one of four colours, whose channels are full or empty, so that all kinds hold them.
    let palette: [[u8; 3]; 4] = [[0, 0, 0], [255, 0, 0], [0, 255, 255], [255, 255, 255]];
    let of = |x: u32, y: u32| ((3 * x + y * y) % 4) as usize;
    let entries: Vec<u8> = palette.iter().flat_map(|&[r, g, b]| [b, g, r, 0]).collect();
    // Rows from the bottom of pixels of so many bits, the left one in the highest bits, or the lowest byte first.
    let upwards = |row: &dyn Fn(u32) -> Vec<u8>| (0..8).rev().flat_map(row).collect::<Vec<u8>>();
    let packed = |bits: u32| {
        upwards(&|y| {
            let bits_of = |x| (0..bits).rev().map(move |bit| of(x, y) as u8 >> bit & 1);
            let all: Vec<u8> = (0..8).flat_map(bits_of).collect();
            let byte = |bits: &[u8]| bits.iter().fold(0, |byte, bit| byte << 1 | bit);
            let mut bytes: Vec<u8> = all.chunks(8).map(byte).collect();
            bytes.resize(bytes.len().div_ceil(4) * 4, 0);
            bytes
        })
    };
    let words = |bits: u16, masks: [u32; 3]| {
        let word = |x, y| {
            let color = palette[of(x, y)];
            let word = (0..3).map(|i| if color[i] == 255 { masks[i] } else { 0 }).sum::<u32>();
            word.to_le_bytes().into_iter().take(usize::from(bits / 8))
        };
        upwards(&|y| (0..8).flat_map(|x| word(x, y)).collect())
    };
    let plain = |bits, masks| bmp([8; 2], bits, 0, &[], words(bits, masks));
    let masks = |masks: [u32; 3]| masks.iter().flat_map(|mask| mask.to_le_bytes()).collect::<Vec<u8>>();
    let masked = |bits, of: [u32; 3]| bmp([8; 2], bits, 3, &masks(of), words(bits, of));
    // A run for each pixel; then given pixels, at least 3 of them; then jumps over the black ones.
    let run = |x, y, both: u8| vec![1, of(x, y) as u8 * both];
    let line = |pixels: &dyn Fn(u32) -> Vec<u8>| (0..8).flat_map(pixels).chain([0; 2]).collect::<Vec<u8>>();
    let runs = |both| [upwards(&|y| line(&|x| run(x, y, both))), vec![0, 1]].concat();
    let given = upwards(&|y| [vec![0, 8], line(&|x| vec![of(x, y) as u8])].concat());
    let pair = |x, y| (of(x, y) << 4 | of(x + 1, y)) as u8;
    let pairs = upwards(&|y| vec![0, 8, pair(0, y), pair(2, y), pair(4, y), pair(6, y), 0, 0]);
    let jumps = upwards(&|y| line(&|x| if of(x, y) == 0 { vec![0, 2, 1, 0] } else { run(x, y, 1) }));
    let four = |bits, compression, pixels: Vec<u8>| {
        let mut bytes = bmp([8; 2], bits, compression, &entries, pixels);
        bytes[46] = 4;
        bytes
    };
    const RGB: [u32; 3] = [0xff_0000, 0xff00, 0xff];
    let downwards = words(24, RGB).chunks(24).rev().flatten().copied().collect::<Vec<u8>>();
    // The header of OS/2: sides of 16 bits, and no fourth byte in the palette.
    let mut old = b"BM\0\0\0\0\0\0\0\0".to_vec();
    old.extend([26 + 12, 0, 0, 0, 12, 0, 0, 0, 8, 0, 8, 0, 1, 0, 8, 0]);
    old.extend(palette.iter().flat_map(|&[r, g, b]| [b, g, r]));
    old.extend(packed(8));
    // A header of 108 bytes with masks of its own, also for opacity.
    let mut new = bmp([8, 8], 32, 3, &[], []);
    (new[10], new[14]) = (14 + 108, 108);
    new.extend(masks([0xff00_0000, 0xff_0000, 0xff00]));
    new.extend([0xff, 0, 0, 0]);
    new.resize(14 + 108, 0);
    new.extend(
        words(32, [0xff00_0000, 0xff_0000, 0xff00])
            .chunks(4)
            .flat_map(|word| [255, word[1], word[2], word[3]]),
    );
    for (kind, bytes) in [
        ("24 bits", plain(24, RGB)),
        ("the upper row first", bmp([8, -8], 24, 0, &[], downwards)),
        ("32 bits", plain(32, RGB)),
        ("15 bits", plain(16, [0x7c00, 0x3e0, 0x1f])),
        ("16 bits by masks", masked(16, [0xf800, 0x7e0, 0x1f])),
        ("30 bits by masks", masked(32, [0x3ff, 0xf_fc00, 0x3ff0_0000])),
        ("8 bits", four(8, 0, packed(8))),
        ("4 bits", four(4, 0, packed(4))),
        ("2 bits", bmp([8, 8], 2, 0, &entries, packed(2))),
        ("runs", four(8, 1, runs(1))),
        ("runs of 4 bits", four(4, 2, runs(17))),
        ("given pixels", four(8, 1, given)),
        ("given pixels of 4 bits", four(4, 2, pairs)),
        ("jumps", four(8, 1, jumps)),
        ("an old header", old),
        ("a new header", new),
    ] {
        let (picture, said) = read_picture("bmp-kinds", "it.bmp", &bytes);
        let picture = picture.unwrap_or_else(|| panic!("{kind}: {said}"));
        assert_eq!(said, "", "{kind}");
        for (x, y) in (0..8).flat_map(|y| (0..8).map(move |x| (x, y))) {
            assert_eq!(picture.color(x as usize, y as usize), palette[of(x, y)], "{kind}: {x}, {y}");
        }
        // Cut anywhere, it is refused or read, and never ends the import.
        for length in (0..bytes.len()).step_by(7) {
            read_picture("bmp-cut", "it.bmp", &bytes[..length]);
        }
    }
    for (kind, bytes, problem) in [
        ("JPEG", bmp([8, 8], 24, 4, &[], [0; 192]), "is a BMP of a kind that is not read"),
        ("wide", bmp([8193, 8], 24, 0, &[], [0; 192]), "has a side of no pixel, or of more than 8192"),
        ("flat", bmp([8, 0], 24, 0, &[], [0; 192]), "has a side of no pixel, or of more than 8192"),
        ("short", bmp([8, 8], 24, 0, &[], [0; 191]), "ends too soon"),
    ] {
        let (picture, said) = read_picture("bmp-problems", "it.bmp", &bytes);
        let start = format!("no texture: picture it.bmp: cannot be read: {problem}");
        assert!(picture.is_none() && said.starts_with(&start), "{kind}: {said}");
    }
}

/// Levels of grey in 16 bits, in 2 bits, and colours of a palette.
#[test]
fn png_files_of_all_kinds_are_read() {
    let level = |x: usize, y: usize| (x + 8 * y) as u16;
    let places = || (0..8).flat_map(|y| (0..8).map(move |x| (x, y)));
    // 1023 of 65535 a step: 1023 / 257 = 3.98 of 255.
    let deep: Vec<u8> = places().flat_map(|(x, y)| (level(x, y) * 1023).to_be_bytes()).collect();
    let deep = png([8; 2], (png::ColorType::Grayscale, png::BitDepth::Sixteen), None, &deep);
    let picture = read_picture("png-16", "it.png", &deep).0.unwrap();
    for (x, y) in places() {
        let expected = (f64::from(level(x, y) * 1023) / 257.0).round() as u8;
        assert_eq!(picture.color(x, y), [expected; 3]);
    }
    let palette = vec![9, 8, 7, 255, 0, 0, 0, 255, 0, 0, 0, 255];
    for (color, palette, expected) in [
        (png::ColorType::Grayscale, None, [[0; 3], [85; 3], [170; 3], [255; 3]]),
        (png::ColorType::Indexed, Some(palette), [[9, 8, 7], [255, 0, 0], [0, 255, 0], [0, 0, 255]]),
    ] {
        let shallow = png([8; 2], (color, png::BitDepth::Two), palette, &[0b00_01_10_11; 16]);
        let (picture, said) = read_picture("png-2", "it.png", &shallow);
        let picture = picture.unwrap_or_else(|| panic!("{said}"));
        for (x, y) in places() {
            assert_eq!(picture.color(x, y), expected[x % 4]);
        }
    }
    let (_, said) = read_picture("png-short", "it.png", &numbered().png()[..60]);
    assert!(said.starts_with("no texture: picture it.png: cannot be read: "), "{said}");
    let wide = Image::from_fn(8193, 1, |_, _| [0; 3]).png();
    let (_, said) = read_picture("png-wide", "it.png", &wide);
    assert_eq!(said, "no texture: picture it.png: cannot be read: has a side of more than 8192 pixels");
}

#[test]
fn colours_are_rounded_as_embedded_graphics_rounds_them() {
    let path = square("types", "map_Kd numbered.png", "numbered.png", numbered());
    for (color, first, bytes) in [
        ("embedded_graphics::pixelcolor::Rgb565", "embedded_graphics::pixelcolor::Rgb565::new(2, 8, 31)", 2),
        (
            "embedded_graphics_core::pixelcolor::Rgb888",
            "embedded_graphics_core::pixelcolor::Rgb888::new(16, 32, 255)",
            4,
        ),
        // (77 · 16 + 150 · 32 + 29 · 255)/256 = 52.4; 52 · 15/255 = 3.06.
        ("Gray4", "Gray4::new(3)", 1),
    ] {
        let format = TextureFormat { color: color.into(), ..TextureFormat::default() };
        let mesh = import(&path, &Options { texture: Some(format), ..Options::default() }).unwrap();
        let picture = mesh.picture.as_ref().unwrap();
        assert_eq!(picture.flash_bytes(), 128 + 256 * bytes);
        let source = mesh.to_rust_mesh("SQUARE", &path, "a test").unwrap();
        // The colour of texel (1, 1), number 17.
        let list = source.split(&format!("PALETTE: [{color}; 256] = [")).nth(1).unwrap();
        let call = list.split("),").nth(17).unwrap().trim();
        assert_eq!(format!("{call})"), first);
        let lists = mesh.to_rust("a test");
        assert!(lists.contains("pub const TEXTURE_SIZE: [usize; 2] = [16, 8];"), "{lists}");
        assert!(lists.contains(&format!("pub const TEXEL_PALETTE: [{color}; 256] = [")), "{lists}");
        assert!(lists.contains("pub const TEXELS: [u8; 128] = ["), "{lists}");
    }
    for value in 0..=255 {
        let color = Rgb565::from(Rgb888::new(value, value, value));
        let nearest = |max: u32| ((u32::from(value) * max + 127) / 255) as u8;
        assert_eq!([color.r(), color.g()], [nearest(31), nearest(63)]);
    }
}

include!("generated/textured.rs");

/// `generated/textured.rs` compiles, and its texels are the pixels of the picture in the colours of a display.
#[test]
fn it_compiles_to_the_picture() {
    let sixteen = Image::from_fn(16, 8, |x, y| [x as u8 % 4 * 64, y as u8 % 4 * 64, 255]);
    let path = square("drawn", "map_Kd sixteen.png\nKe 1.5 .4 0", "sixteen.png", sixteen.clone());
    let mesh = import(&path, &with(16)).unwrap();
    let command = "pinhole-import square.obj -o textured.rs --name TEXTURED --texture 16 --keep-order";
    let text = mesh.to_rust_mesh("TEXTURED", &path, command).unwrap();
    if std::env::var_os("GENERATED").is_some() {
        let here = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/import/generated/textured.rs");
        std::fs::write(here, &text).unwrap();
    }
    assert!(
        text == include_str!("generated/textured.rs"),
        "GENERATED=1 cargo test -p pinhole-import writes it"
    );
    assert_eq!(TEXTURED, mesh.mesh().unwrap());
    assert_eq!((TEXTURED_COLORS, Some(TEXTURED_TEXTURE)), (mesh.colors().unwrap(), mesh.texture().unwrap()));
    // More light than full is full.
    assert_eq!(TEXTURED_COLORS.unwrap().lit::<Rgb888>(1, 0), Rgb888::new(255, 102, 0));
    // A colour and its light, and two indices; four pairs, and six indices. They are not the mesh's, so not in its size.
    for size in [
        "4 vertices, 2 faces, 5 edges; 68 bytes of flash.",
        "1 colours, 1 of them emitting light; 8 bytes of flash.",
        "4 pairs; 28 bytes of flash.",
    ] {
        assert!(text.contains(size), "{text}");
    }
    // The picture's left lower corner lies at that of the square.
    let unit = 2f64.powi(TEXTURED_TEXTURE.exponent().into());
    for (face, corners) in TEXTURED.faces().iter().enumerate() {
        for (corner, at) in corners.map(|vertex| mesh.vertices[usize::from(vertex)]).into_iter().enumerate() {
            let [x, y] = [f64::from(at[0]), f64::from(at[1])].map(|c| c / 32_768.0 + 0.5);
            let uv = TEXTURED_TEXTURE.corners(face)[corner].map(|c| f64::from(c) * unit);
            assert_eq!(uv, [x, 1.0 - y]);
        }
    }
    for (column, row, [r, g, b]) in sixteen.colors() {
        assert_eq!(TEXTURED_TEXELS.texel(column << 28, row << 29), Rgb565::from(Rgb888::new(r, g, b)));
    }
}
