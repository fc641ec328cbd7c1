//! Textures: the coordinates that each pixel shows, against rays in f64, which share no code with the library.

use core::convert::Infallible;
use embedded_graphics::pixelcolor::raw::RawU32;
use embedded_graphics::pixelcolor::{PixelColor, Rgb888};
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::{PointsIter, Rectangle};
use embedded_graphics::Pixel;
use pinhole::space::{Model, World};
use pinhole::{
    Accuracy, Affine, Angle, Camera, Cull, DepthBuffer, Frame, IndexedTexels, Mesh, Picture, Point3,
    Projection, Scalar, ScreenVertex, TexelSlice, Texels, Texture, TextureCoords, TextureError, Vector3,
    ViewTransform, Viewport, Window,
};
use support::oracle::rng::Rng;

pub(crate) const SIDE: u32 = 240;
pub(crate) const FOV: f64 = 60.0;
pub(crate) const NEAR: f64 = 1.0;
pub(crate) const FAR: f64 = 2000.0;

/// The coordinates that a pixel shows, in 2⁻³² of the texture's sides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Shown(pub(crate) [u32; 2]);

impl PixelColor for Shown {
    type Raw = RawU32;
}

/// Texels that show their coordinates.
#[derive(Clone, Copy)]
pub(crate) struct Numbered(pub(crate) [u32; 2]);

impl Texels for Numbered {
    type Color = Shown;

    fn size_bits(&self) -> [u32; 2] {
        self.0
    }

    fn texel(&self, u: u32, v: u32) -> Shown {
        Shown([u, v])
    }
}

/// Texels whose coordinates have 32 bits.
#[derive(Clone, Copy)]
pub(crate) struct Wide<S>(pub(crate) S);

impl<S: Texels> Texels for Wide<S> {
    type Color = S::Color;
    const WIDE: bool = true;

    fn size_bits(&self) -> [u32; 2] {
        self.0.size_bits()
    }

    fn texel(&self, u: u32, v: u32) -> S::Color {
        self.0.texel(u, v)
    }
}

/// The bound that `Texels::WIDE` documents for coordinates that share a word, in sides.
pub(crate) const PACKING: f64 = 37.0 / 65536.0;

/// A square DrawTarget that is not the library's.
pub(crate) struct Screen(pub(crate) Vec<Option<Shown>>);

impl OriginDimensions for Screen {
    fn size(&self) -> Size {
        Size::new_equal(self.0.len().isqrt() as u32)
    }
}

impl DrawTarget for Screen {
    type Color = Shown;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Shown>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        let columns = self.0.len().isqrt();
        for Pixel(Point { x, y }, color) in pixels {
            self.0[y as usize * columns + x as usize] = Some(color);
        }
        Ok(())
    }
}

pub(crate) type V = [f64; 3];

/// Corners in view space, which is the world here, in units of 2^exponent, and texture coordinates in 1/16 texel.
pub(crate) struct Scene {
    pub(crate) vertices: Vec<[i16; 3]>,
    pub(crate) exponent: i8,
    pub(crate) faces: Vec<[u16; 3]>,
    pub(crate) uv: Vec<[i16; 2]>,
}

impl Scene {
    pub(crate) fn camera() -> Camera {
        let viewport = Viewport::new(Point::zero(), Size::new(SIDE, SIDE)).unwrap();
        let number = |v| Scalar::from_f64(v).expect("in range");
        let lens =
            Projection::perspective(Angle::degrees(60), viewport.size(), number(NEAR), number(FAR)).unwrap();
        let [eye, ahead] = [0, -1].map(|z| Point3::from_ints(0, 0, z));
        let view = ViewTransform::look_at(eye, ahead, Vector3::from_ints(0, 1, 0)).unwrap();
        Camera::new(&view, &lens, &viewport)
    }

    fn draw(&self, accuracy: Accuracy, texels: impl Texels<Color = Shown>) -> Vec<Option<Shown>> {
        let mesh = Mesh::new(&self.vertices, self.exponent, &self.faces).unwrap();
        let camera = Self::camera();
        let instance = camera.place(&mesh, &Affine::<Model, World>::identity()).with_cull(Cull::None);
        let texture = Texture::new(texels).with_accuracy(accuracy);
        let mut screen = Screen(vec![None; (SIDE * SIDE) as usize]);
        let Ok(_) = instance.solid(|face| texture.at(mesh.corners_of(face, &self.uv)), &mut [], &mut screen);
        screen.0
    }

    /// u and v in texels at a point of the screen, in pixels, of a face.
    pub(crate) fn exact(&self, face: usize, [x, y]: [f64; 2]) -> [f64; 2] {
        let scale = (FOV.to_radians() / 2.0).tan();
        let half = f64::from(SIDE) / 2.0;
        let ray = [(x - half) / half * scale, (half - y) / half * scale, -1.0];
        let [a, b, c] = self.faces[face]
            .map(|i| self.vertices[usize::from(i)].map(|c| f64::from(c) * 2f64.powi(self.exponent.into())));
        let weights = [volume(ray, b, c), volume(a, ray, c), volume(a, b, ray)];
        let sum: f64 = weights.iter().sum();
        let uv = self.faces[face].map(|i| self.uv[usize::from(i)].map(|c| f64::from(c) / 16.0));
        [0, 1].map(|axis| (0..3).map(|i| weights[i] * uv[i][axis]).sum::<f64>() / sum)
    }

    /// The largest error in texels of the pixels that show one face, beyond a shift of 1/64 pixel; and how many pixels show it.
    fn worst(&self, accuracy: Accuracy, texels: impl Texels<Color = Shown>) -> (f64, usize) {
        assert_eq!(texels.size_bits(), [6, 6]);
        let (mut worst, mut count) = (0.0f64, 0);
        for face in 0..self.faces.len() {
            let alone = Scene {
                faces: vec![self.faces[face]],
                vertices: self.vertices.clone(),
                uv: self.uv.clone(),
                exponent: self.exponent,
            };
            for (i, shown) in alone.draw(accuracy, texels).into_iter().enumerate() {
                let Some(Shown(shown)) = shown else { continue };
                let (x, y) = ((i as u32 % SIDE) as f64 + 0.5, (i as u32 / SIDE) as f64 + 0.5);
                let near = [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)]
                    .map(|(dx, dy)| alone.exact(0, [x + dx / 64.0, y + dy / 64.0]));
                for axis in 0..2 {
                    let values = near.map(|uv| uv[axis]);
                    let low = values.iter().copied().fold(f64::MAX, f64::min);
                    let high = values.iter().copied().fold(f64::MIN, f64::max);
                    let shown = f64::from(shown[axis]) / 2f64.powi(32) * 64.0;
                    // Modulo the texture's side.
                    let middle = (low + high) / 2.0;
                    let off = (shown - middle + 32.0).rem_euclid(64.0) - 32.0;
                    worst = worst.max(off.abs() - (high - low) / 2.0);
                }
                count += 1;
            }
        }
        (worst, count)
    }
}

pub(crate) fn volume(a: V, b: V, c: V) -> f64 {
    a[0] * (b[1] * c[2] - b[2] * c[1])
        + a[1] * (b[2] * c[0] - b[0] * c[2])
        + a[2] * (b[0] * c[1] - b[1] * c[0])
}

/// A quad in front of the camera, turned about the line of sight by `roll` degrees, with 4·`tiles` repetitions.
pub(crate) fn quad(corners: [[f64; 3]; 4], roll: f64, texels: i16, exponent: i8) -> Scene {
    let (s, c) = roll.to_radians().sin_cos();
    let turned = corners.map(|[x, y, z]| [c * x - s * y, s * x + c * y, z]);
    let scale = 2f64.powi(-i32::from(exponent));
    let t = texels * 16;
    Scene {
        vertices: turned.map(|v| v.map(|c| (c * scale).round() as i16)).to_vec(),
        exponent,
        faces: vec![[0, 1, 2], [0, 2, 3]],
        uv: vec![[0, t], [t, t], [t, 0], [0, 0]],
    }
}

/// A floor from `near` to `far` ahead, one unit below the eye, `half` units to each side.
pub(crate) fn floor(near: f64, far: f64, half: f64) -> [[f64; 3]; 4] {
    [[-half, -1.0, -near], [half, -1.0, -near], [half, -1.0, -far], [-half, -1.0, -far]]
}

/// A wall along the line of sight, a thousand times as far at its end.
pub(crate) const WALL: [[f64; 3]; 4] =
    [[-1.0, -30.0, -1.2], [-1.0, 30.0, -1.2], [-1.0, 30.0, -1200.0], [-1.0, -30.0, -1200.0]];

/// Random triangles before the near plane and across it, most of them slender or far to the side.
pub(crate) fn soup(seed: u64, reach: i64, texels: i64) -> Scene {
    let mut rng = Rng::new(seed);
    let mut scene = Scene { vertices: vec![], exponent: -6, faces: vec![], uv: vec![] };
    for i in 0..120u16 {
        let centre = [rng.int(-(reach), reach), rng.int(-(reach), reach), -rng.int(-(3000), 3000).abs() - 70];
        for _ in 0..3 {
            let size = [1000, 200, 40][usize::from(i) % 3];
            scene.vertices.push([0, 1, 2].map(|k| (centre[k] + rng.int(-(size), size)) as i16));
            scene.uv.push([0, 1].map(|_| rng.int(-(16 * texels), 16 * texels) as i16));
        }
        scene.faces.push([3 * i, 3 * i + 1, 3 * i + 2]);
    }
    scene
}

/// The promise of `Texture`: a pixel shows the coordinates of a point within 1/64 pixel, off by at most the chosen error, the
/// error of the planes, `planes` texels, and that of packing.
#[test]
fn texels_are_those_of_rays_within_the_chosen_error() {
    let cases = [
        ("floor", quad(floor(1.7, 9.5, 6.0), 0.0, 64, -10), 0.01),
        ("rolled floor", quad(floor(0.5, 9.5, 6.0), 25.0, 64, -10), 0.01),
        ("rolled horizon", quad(floor(0.9, 1000.0, 900.0), 20.0, 1600, -5), 0.02),
        ("horizon", quad(floor(0.9, 1000.0, 900.0), 0.0, 1600, -5), 0.02),
        ("wall", quad(WALL, 0.0, 400, -4), 0.02),
        ("small triangles", soup(1, 300, 30), 0.01),
        ("large triangles", soup(2, 2000, 1000), 0.02),
    ];
    for (accuracy, chosen) in
        [(Accuracy::Quarter, 0.25), (Accuracy::Eighth, 0.125), (Accuracy::Sixteenth, 0.0625)]
    {
        let (mut largest, texels) = (0.0f64, Numbered([6, 6]));
        for (name, scene, planes) in &cases {
            let (worst, pixels) = scene.worst(accuracy, Wide(texels));
            assert!(worst <= chosen + planes, "{name}, {accuracy:?}: {worst}");
            assert!(pixels > 10_000, "{name}: {pixels} pixels");
            largest = largest.max(worst);
            let (worst, _) = scene.worst(accuracy, texels);
            assert!(worst <= chosen + planes + 64.0 * PACKING, "{name}, {accuracy:?}, packed: {worst}");
        }
        assert!(largest > chosen / 2.0, "{accuracy:?}: {largest}");
    }
}

/// A colour of its own for nearly all coordinates, in a format that every kind of target has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Colored;

impl Texels for Colored {
    type Color = Rgb888;

    fn size_bits(&self) -> [u32; 2] {
        [6, 6]
    }

    fn texel(&self, u: u32, v: u32) -> Rgb888 {
        Rgb888::new((u >> 24) as u8, (v >> 24) as u8, (u >> 16 ^ v >> 12) as u8)
    }
}

/// A DrawTarget that is not the library's.
pub(crate) struct Display(pub(crate) Vec<Rgb888>);

impl OriginDimensions for Display {
    fn size(&self) -> Size {
        Size::new(SIDE, SIDE)
    }
}

impl DrawTarget for Display {
    type Color = Rgb888;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Rgb888>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        for Pixel(Point { x, y }, color) in pixels {
            self.0[y as usize * SIDE as usize + x as usize] = color;
        }
        Ok(())
    }
}

/// However a row is cut into spans, by another target, by bands, by regions or by what the depth buffer hides, a pixel shows the
/// same texel.
#[test]
fn textures_are_equal_on_every_target_and_in_bands() {
    let sky = Rgb888::new(1, 2, 3);
    let area = Rectangle::new(Point::zero(), Size::new(SIDE, SIDE));
    let scenes = [
        quad(floor(0.5, 9.5, 6.0), 25.0, 200, -10),
        quad(floor(0.9, 1000.0, 900.0), 20.0, 1600, -5),
        quad(WALL, 70.0, 400, -4),
        soup(3, 300, 30),
        soup(4, 1500, 2000),
    ];
    for scene in &scenes {
        let mesh = Mesh::new(&scene.vertices, scene.exponent, &scene.faces).unwrap();
        let camera = Scene::camera();
        let instance = camera.place(&mesh, &Affine::<Model, World>::identity()).with_cull(Cull::None);
        let texture = Texture::new(Colored);
        let shade = |face| texture.at(mesh.corners_of(face, &scene.uv));
        let count = mesh.vertices().len();
        let mut cache = vec![ScreenVertex::EMPTY; count];
        let mut numbers = vec![0; (SIDE * SIDE) as usize];

        // Without depth.
        let mut display = Display(vec![sky; (SIDE * SIDE) as usize]);
        let Ok(_) = instance.solid(shade, &mut cache, &mut display);
        let mut pixels = vec![sky; (SIDE * SIDE) as usize];
        let mut picture = Picture::new(&mut pixels, area.size).unwrap();
        let Ok(_) = instance.solid(shade, &mut cache, &mut picture.pixels());
        assert!(pixels == display.0);
        let drawn = pixels.iter().filter(|&&pixel| pixel != sky).count();
        assert!(drawn > 10_000, "{drawn}");

        // With depth: what is nearer cuts rows into runs.
        let mut deep = Display(vec![sky; (SIDE * SIDE) as usize]);
        let mut depth = DepthBuffer::new(area, &mut numbers).unwrap();
        let Ok(_) = instance.depth_tested(shade, &mut cache, &mut depth, &mut deep);
        let mut pixels = vec![sky; (SIDE * SIDE) as usize];
        let mut picture = Picture::new(&mut pixels, area.size).unwrap();
        let mut depth = DepthBuffer::new(area, &mut numbers).unwrap();
        let Ok(_) = instance.depth_tested(shade, &mut cache, &mut depth, &mut picture.pixels());
        assert!(pixels == deep.0);

        // In bands of 7 rows of a region of odd width, into the band's memory and through its DrawTarget.
        let region = Rectangle::new(Point::new(37, 11), Size::new(119, 205));
        for by_memory in [true, false] {
            let mut banded = Display(vec![sky; (SIDE * SIDE) as usize]);
            let (mut strip, mut bin_storage) = (vec![0u8; 119 * 7 * 3], vec![0u16; 4096]);
            let mut faces = instance.transform(&mut cache).bin_faces(&mut bin_storage).unwrap();
            let mut frame = Frame::new(region, sky);
            while let Some(mut band) = frame.next_band(&mut strip).unwrap() {
                let Ok(()) = match by_memory {
                    true => faces.solid(shade, &mut band.pixels()),
                    false => faces.solid(shade, &mut band),
                };
                let Ok(()) = band.send(&mut banded);
            }
            for Point { x, y } in region.points() {
                let at = (y as u32 * SIDE + x as u32) as usize;
                assert_eq!(banded.0[at], display.0[at], "({x}, {y}), by memory: {by_memory}");
            }
        }
    }
}

/// Coordinates of a parallel projection are linear on the screen: no pixel is off by more than 1/100 texel and the error of packing.
#[test]
fn parallel_projections_are_exact() {
    let texels = Numbered([8, 3]);
    assert!(parallel_projection_is_off_by(Wide(texels), 0.0) <= 0.01);
    let packed = parallel_projection_is_off_by(texels, PACKING);
    assert!(packed <= 0.01, "{packed}");
}

/// The largest error in texels of a floor in a parallel projection, beyond `packing` in sides.
fn parallel_projection_is_off_by(texels: impl Texels<Color = Shown>, packing: f64) -> f64 {
    let scene = quad(floor(1.0, 9.0, 3.0), 33.0, 500, -10);
    let size = Size::new(SIDE, SIDE);
    let one = Scalar::from_int(4);
    let window = Window { left: -one, right: one, bottom: -one, top: one };
    let lens = Projection::orthographic(window, Scalar::from_int(-20), Scalar::from_int(20)).unwrap();
    let [eye, ahead] = [[0, 3, 0], [0, 0, -3]].map(|[x, y, z]| Point3::from_ints(x, y, z));
    let view = ViewTransform::look_at(eye, ahead, Vector3::from_ints(0, 1, 0)).unwrap();
    let camera = Camera::new(&view, &lens, &Viewport::new(Point::zero(), size).unwrap());
    let mesh = Mesh::new(&scene.vertices, scene.exponent, &scene.faces).unwrap();
    let instance = camera.place(&mesh, &Affine::<Model, World>::identity()).with_cull(Cull::None);
    let texture = Texture::new(texels);
    let mut screen = Screen(vec![None; (SIDE * SIDE) as usize]);
    let Ok(_) = instance.solid(|face| texture.at(mesh.corners_of(face, &scene.uv)), &mut [], &mut screen);
    // u and v are affine in x and y: three pixels give the map, with the vertices' error of 1/256 pixel.
    let (turn, half) = (0.5f64.sqrt(), f64::from(SIDE) / 2.0);
    let mut worst = 0.0f64;
    let mut count = 0;
    for (i, shown) in screen.0.iter().enumerate() {
        let Some(Shown(shown)) = *shown else { continue };
        let (x, y) = ((i as u32 % SIDE) as f64 + 0.5, (i as u32 / SIDE) as f64 + 0.5);
        // View space: the eye looks down by 45 degrees.
        let (right, up) = ((x - half) / half * 4.0, (half - y) / half * 4.0);
        // The rolled floor's plane through its corners.
        let [a, b, _, d] = [0, 1, 2, 3].map(|i| scene.vertices[i].map(|c| f64::from(c) / 1024.0));
        let screen_of = |p: V| [p[0], (p[1] - 3.0) * turn - p[2] * turn];
        let ([ax, ay], [bx, by], [dx, dy]) = (screen_of(a), screen_of(b), screen_of(d));
        let (e, f, g) = ([bx - ax, by - ay], [dx - ax, dy - ay], [right - ax, up - ay]);
        let area = e[0] * f[1] - e[1] * f[0];
        let (along, across) = ((g[0] * f[1] - g[1] * f[0]) / area, (e[0] * g[1] - e[1] * g[0]) / area);
        // a has coordinates (0, t), b (t, t), d (0, 0); vertices are off by up to 1/256 pixel.
        let exact = [500.0 * along, 500.0 * (1.0 - across)];
        let slope = [
            500.0 * (f[0].abs() + f[1].abs()) / area.abs() * 4.0 / half,
            500.0 * (e[0].abs() + e[1].abs()) / area.abs() * 4.0 / half,
        ];
        for (axis, side) in [256.0, 8.0].into_iter().enumerate() {
            let shown = f64::from(shown[axis]) / 2f64.powi(32) * side;
            let off = (shown - exact[axis] + side / 2.0).rem_euclid(side) - side / 2.0;
            worst = worst.max(off.abs() - slope[axis] / 64.0 - packing * side);
        }
        count += 1;
    }
    assert!(count > 10_000, "{count}");
    worst
}

/// Where coordinates are linear, no pixel shows what lies beyond the corners' coordinates: a picture that a face shows once does not
/// begin again at the face's border. Beyond a shift of 1/64 pixel, no pixel is off by more than the bound of packing, and some are by
/// more than half of it.
#[test]
fn linear_coordinates_stay_between_those_of_the_corners() {
    let size = Size::new(SIDE, SIDE);
    let number = Scalar::from_int;
    let window = Window { left: number(-4), right: number(4), bottom: number(-4), top: number(4) };
    let lens = Projection::orthographic(window, number(-20), number(20)).unwrap();
    let [eye, ahead] = [0, -1].map(|z| Point3::from_ints(0, 0, z));
    let view = ViewTransform::look_at(eye, ahead, Vector3::from_ints(0, 1, 0)).unwrap();
    let camera = Camera::new(&view, &lens, &Viewport::new(Point::zero(), size).unwrap());
    let mut rng = Rng::new(61);
    let (mut pixels, mut closest, mut largest) = (0, f64::MAX, [f64::MIN; 2]);
    for case in 0..3000 {
        // Up to 6, 30 and 150 pixels.
        let reach = [102, 512, 2560][case % 3];
        let centre = [(); 2].map(|()| rng.int(-3000, 3000));
        let vertices =
            [(); 3].map(|()| [centre[0] + rng.int(-reach, reach), centre[1] + rng.int(-reach, reach), 0]);
        let vertices = vertices.map(|vertex| vertex.map(|c| c as i16));
        let bits = [3 + rng.below(6) as u32, 3 + rng.below(6) as u32];
        // From one border of the picture to the other, and parts of it.
        let uv = [(); 3].map(|()| {
            [0, 1].map(|axis| [0, 16 << bits[axis], rng.int(0, 16 << bits[axis])][rng.below(3)] as i16)
        });
        // 30 pixels are 1 unit of the world.
        let on_screen = vertices.map(|[x, y, _]| {
            [x, -y].map(|c| f64::from(SIDE) / 2.0 + f64::from(c) * f64::from(SIDE) / 8.0 / 1024.0)
        });
        let mesh = Mesh::new(&vertices, -10, &[[0, 1, 2]]).unwrap();
        let instance = camera.place(&mesh, &Affine::<Model, World>::identity()).with_cull(Cull::None);
        for is_wide in [false, true] {
            let mut screen = Screen(vec![None; (SIDE * SIDE) as usize]);
            let Ok(_) = match is_wide {
                false => instance.solid(|_| Texture::new(Numbered(bits)).at(uv), &mut [], &mut screen),
                true => instance.solid(|_| Texture::new(Wide(Numbered(bits))).at(uv), &mut [], &mut screen),
            };
            for (i, pixel) in screen.0.iter().enumerate() {
                let Some(Shown(shown)) = pixel else { continue };
                let at = [i as u32 % SIDE, i as u32 / SIDE].map(|c| f64::from(c) + 0.5);
                for axis in 0..2 {
                    let texels = uv.map(|uv| f64::from(uv[axis]) / 16.0);
                    let least = texels.into_iter().fold(f64::MAX, f64::min);
                    let most = texels.into_iter().fold(f64::MIN, f64::max);
                    // A texel beyond either border would show the other one.
                    let side = f64::from(1u32 << bits[axis]);
                    let shown = f64::from(shown[axis]) / 2f64.powi(32) * side;
                    let room = (shown - least).min(most - shown);
                    assert!(room >= 0.0 || least == most, "{vertices:?} {uv:?} {bits:?}: {shown}");
                    if most - least > 1.0 {
                        closest = closest.min(room / side);
                    }
                    let (exact, slope) = linear(on_screen, uv.map(|uv| f64::from(uv[axis]) / 16.0), at);
                    let off = (shown - exact + side / 2.0).rem_euclid(side) - side / 2.0;
                    let off = (off.abs() - slope / 64.0) / side;
                    largest[usize::from(is_wide)] = largest[usize::from(is_wide)].max(off);
                }
                pixels += 1;
            }
        }
    }
    assert!(pixels > 100_000 && closest < PACKING / 32.0, "{pixels} pixels, {closest}");
    let [packed, wide] = largest;
    assert!((PACKING / 2.0..PACKING).contains(&packed) && wide < 2f64.powi(-13), "{packed}, {wide}");
}

/// A function that is linear over a triangle and has these values at its corners: its value at a point, and the sum of its changes
/// per pixel.
fn linear([a, b, c]: [[f64; 2]; 3], [u, v, w]: [f64; 3], at: [f64; 2]) -> (f64, f64) {
    let [[bx, by], [cx, cy], [x, y]] = [b, c, at].map(|p| [p[0] - a[0], p[1] - a[1]]);
    let area = bx * cy - by * cx;
    let (right, down) = (((v - u) * cy - (w - u) * by) / area, ((w - u) * bx - (v - u) * cx) / area);
    (u + right * x + down * y, right.abs() + down.abs())
}

/// Coordinates below 0 are rounded down, not towards 0; the picture repeats on both sides.
#[test]
fn the_picture_repeats_in_both_directions() {
    let corners = [[-6.0, -6.0, -6.0], [6.0, -6.0, -6.0], [6.0, 6.0, -6.0], [-6.0, 6.0, -6.0]];
    let draw = |from: i16| {
        let mut scene = quad(corners, 0.0, 0, -8);
        let (low, high) = (from * 16, (from + 64) * 16);
        scene.uv = vec![[low, high], [high, high], [high, low], [low, low]];
        scene.draw(Accuracy::Quarter, Numbered([4, 5]))
    };
    let first = draw(0);
    assert!(first.iter().flatten().count() > 50_000);
    for from in [-32, -64, 32, 1024, -2048] {
        for (a, b) in first.iter().zip(draw(from)) {
            let ([u, v], [p, q]) = (a.unwrap().0, b.unwrap().0);
            let apart = |a: u32, b: u32| (a.wrapping_sub(b) as i32).unsigned_abs();
            assert!(apart(u, p).max(apart(v, q)) < 1 << 16, "{from}: {a:?} {b:?}");
        }
    }
}

/// Formats: what is stored in a texel is what a pixel shows, at every size.
#[test]
fn texels_of_every_format_and_size_are_where_the_picture_has_them() {
    let mut rng = Rng::new(9);
    for (width, height) in [(8, 8), (16, 8), (8, 256), (256, 256), (32, 128)] {
        let stored: Vec<u8> = (0..width * height).map(|_| rng.bits() as u8).collect();
        let palette: Vec<Rgb888> = (0..256u32).map(|i| Rgb888::new(i as u8, (i * 7) as u8, 3)).collect();
        let colors: Vec<Rgb888> = stored.iter().map(|&i| palette[usize::from(i)]).collect();
        let slice = TexelSlice::new(&colors, width, height).unwrap();
        let indexed = IndexedTexels::<_, 8>::new(&stored, width, height, &palette).unwrap();
        // These bytes as texels of 4, 2 and 1 bits, which begin in the high bits.
        let four = IndexedTexels::<_, 4>::new(&stored, width, height, &palette).unwrap();
        let two = IndexedTexels::<_, 2>::new(&stored, width, height, &palette).unwrap();
        let one = IndexedTexels::<_, 1>::new(&stored, width, height, &palette[..2]).unwrap();
        for y in 0..height {
            for x in 0..width {
                let place = |i: usize, side: usize| {
                    let texel = (1u64 << 32) / side as u64;
                    (i as u64 * texel + rng_offset(i, texel)) as u32
                };
                let (u, v, at) = (place(x, width), place(y, height), y * width + x);
                assert_eq!(slice.texel(u, v), colors[at]);
                assert_eq!(indexed.texel(u, v), colors[at]);
                let low = |bits: usize| {
                    let bit = at * bits;
                    usize::from(stored[bit / 8]) >> (8 - bits - bit % 8) & ((1 << bits) - 1)
                };
                assert_eq!(
                    [four.texel(u, v), two.texel(u, v), one.texel(u, v)],
                    [4, 2, 1].map(|b| palette[low(b)])
                );
            }
        }
    }
    let picture: [[Rgb888; 16]; 8] =
        core::array::from_fn(|y| core::array::from_fn(|x| Rgb888::new(x as u8, y as u8, 0)));
    assert_eq!((&picture).texel(u32::MAX, 0), Rgb888::new(15, 0, 0));
    assert_eq!((&picture).texel(0, u32::MAX), Rgb888::new(0, 7, 0));
    assert_eq!((&picture).size_bits(), [4, 3]);
}

/// A place within a texel: its begin, its end, or between.
fn rng_offset(i: usize, texel: u64) -> u64 {
    [0, texel - 1, texel / 3][i % 3]
}

#[test]
fn errors_say_the_numbers() {
    let (texels, palette) = ([0u8; 63], [Rgb888::new(0, 0, 0); 15]);
    let message = |error: TextureError| error.to_string();
    let side = IndexedTexels::<Rgb888, 8>::new(&texels, 8, 12, &palette).unwrap_err();
    assert_eq!(side, TextureError::Side { side: 12 });
    assert_eq!(message(side), "a side of 12 texels: resize the picture to 8, 16, 32, 64, 128 or 256 a side");
    let short = IndexedTexels::<Rgb888, 8>::new(&texels, 8, 8, &palette).unwrap_err();
    assert_eq!(short, TextureError::Texels { needed: 64, given: 63 });
    assert_eq!(message(short), "the slice has 63 elements, but a texture of this size needs 64");
    let few = IndexedTexels::<Rgb888, 4>::new(&texels, 8, 8, &palette).unwrap_err();
    assert_eq!(few, TextureError::Palette { needed: 16, given: 15 });
    assert_eq!(message(few), "the palette has 15 colours, but the texels can name 16: append some");
    assert_eq!(
        TexelSlice::<Rgb888>::new(&palette, 8, 8).unwrap_err(),
        TextureError::Texels { needed: 64, given: 15 }
    );
    for side in [0, 4, 512, usize::MAX] {
        assert_eq!(TexelSlice::<Rgb888>::new(&palette, side, 8).unwrap_err(), TextureError::Side { side });
    }
    let texture = Texture::new(Colored);
    assert_eq!(texture.with_exponent(1), Err(TextureError::Exponent { exponent: 1 }));
    assert_eq!(texture.with_exponent(-16), Err(TextureError::Exponent { exponent: -16 }));
    assert_eq!(
        message(TextureError::Exponent { exponent: 1 }),
        "texture coordinates in 2^1 of a side: the exponent must be -15 to 0"
    );
}

/// `TextureCoords` of any exponent give the texels that their documentation names.
#[test]
fn the_unit_of_coordinates_is_a_power_of_two_of_the_side() {
    let corners = [[-6.0, -6.0, -6.0], [6.0, -6.0, -6.0], [6.0, 6.0, -6.0], [-6.0, 6.0, -6.0]];
    let scene = quad(corners, 0.0, 0, -8);
    let mesh = Mesh::new(&scene.vertices, scene.exponent, &scene.faces).unwrap();
    let camera = Scene::camera();
    let instance = camera.place(&mesh, &Affine::<Model, World>::identity());
    for exponent in -15..=0 {
        let full = 1i32 << -exponent; // one side
        let full = i16::try_from(full.min(1 << 14)).unwrap();
        let list = [[0, full], [full, full], [full, 0], [0, 0]];
        let coords = TextureCoords::new(&list, &scene.faces, exponent).unwrap();
        let (texels, exponent) = (Numbered([6, 3]), coords.exponent());
        let (wide, texture) = (Texture::new(Wide(texels)), Texture::new(texels));
        let blank = || Screen(vec![None; (SIDE * SIDE) as usize]);
        let [mut screen, mut packed] = [blank(), blank()];
        let wide = wide.with_exponent(exponent).unwrap();
        let Ok(_) = instance.solid(|face| wide.at(coords.corners(face)), &mut [], &mut screen);
        let texture = texture.with_exponent(exponent).unwrap();
        let Ok(_) = instance.solid(|face| texture.at(coords.corners(face)), &mut [], &mut packed);
        // The quad is 12 wide at a distance of 6, where the picture is 12·tan(30°) wide.
        let share = 12.0 * (FOV.to_radians() / 2.0).tan() / 12.0;
        let at = |x: u32| {
            (0.5 + ((f64::from(x) + 0.5) / f64::from(SIDE) - 0.5) * share) * f64::from(full)
                / 2f64.powi(-i32::from(exponent))
        };
        for x in 0..SIDE {
            for (screen, bound) in [(&screen, 1e-4), (&packed, 1e-4 + 2.0 * PACKING)] {
                let Some(Shown([u, v])) = screen.0[(x * SIDE + x) as usize] else { panic!("{x}") };
                for shown in [u, v] {
                    let off = f64::from(shown) / 2f64.powi(32) - at(x);
                    assert!(((off + 0.5).rem_euclid(1.0) - 0.5).abs() < bound, "{exponent}, {x}: {off}");
                }
            }
        }
    }
}
