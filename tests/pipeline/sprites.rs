//! Sprites: which pixels they cover, which texel each shows and which depth it stores, by the definition in i128 around points,
//! sizes and depths in f64, which share no code with the library; on every target, in one piece and in bands.

use embedded_graphics::geometry::{AnchorPoint, AnchorX, AnchorY};
use embedded_graphics::image::{GetPixel, Image, ImageDrawable, ImageRaw};
use embedded_graphics::mock_display::MockDisplay;
use embedded_graphics::pixelcolor::raw::{BigEndian, LittleEndian};
use embedded_graphics::pixelcolor::{Bgr888, BinaryColor, Gray2, Gray4, Gray8, Rgb565, Rgb888};
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use pinhole::{
    color::{Alpha, Half},
    prelude::*,
    shading::Translucent,
    sprite::{PlacedSprites, SolidTexel, SpriteImage, SpriteSource},
    target::Pixels,
    texture::ColorKeyed,
};
use support::bridge::pair::{CameraBits, ModelBits, ProjectionBits, Step, ViewBits, ONE};
use support::bridge::rectangle;
use support::bridge::ways::{bands, memory, memory_with, screen};
use support::oracle::chain;
use support::oracle::rng::Rng;
use support::oracle::shade::{self, halved};
use support::oracle::target::Screen;

const SIZE: Size = Size::new(140, 100);
const AREA: Rectangle = Rectangle::new(Point::zero(), SIZE);
/// The viewport leaves a border of the target free.
const VIEWPORT: (i32, i32, u32, u32) = (7, 3, 120, 90);
const EXPONENT: i8 = -8;
const SKY: Rgb888 = Rgb888::new(1, 2, 3);
static NOTHING: [u16; 140 * 100] = [u16::MAX; 140 * 100];

/// A picture by a formula; a third of its texels is transparent.
#[derive(Clone, Copy, Debug)]
struct Noise {
    size: Size,
    seed: u32,
}

impl SpriteSource for Noise {
    type Color = Rgb888;
    type Ink = Option<Rgb888>;

    fn picture_size(&self) -> Size {
        self.size
    }

    fn texel_at(&self, column: u32, row: u32) -> Option<Rgb888> {
        assert!(column < self.size.width && row < self.size.height, "({column}, {row}) of {self:?}");
        let mixed = (column.wrapping_mul(0x9e37_79b1) ^ row.wrapping_mul(0x85eb_ca77) ^ self.seed)
            .wrapping_mul(0xc2b2_ae3d);
        let [a, b, c, d] = (mixed ^ mixed >> 15).to_le_bytes();
        (d % 3 > 0).then(|| Rgb888::new(a, b, c))
    }
}

/// The size of a sprite, and which point of it is the anchor.
#[derive(Clone, Copy, Debug)]
struct Shape {
    picture: Noise,
    size: Extent,
    anchor: Anchor,
}

#[derive(Clone, Copy, Debug)]
enum Anchor {
    /// In halves of the width and of the height.
    Halves([i128; 2]),
    Texels([u32; 2]),
}

#[derive(Clone, Copy, Debug)]
enum Extent {
    Pixels(u8),
    /// Width and height in world units, in I16F16.
    World([i32; 2]),
}

impl Shape {
    fn sprite<S>(&self, source: S) -> Sprite<S> {
        let sprite = match self.anchor {
            Anchor::Halves(halves) => {
                let [x, y] = halves.map(|half| half as usize);
                let across = [AnchorX::Left, AnchorX::Center, AnchorX::Right];
                let down = [AnchorY::Top, AnchorY::Center, AnchorY::Bottom];
                Sprite::new(source).with_anchor(AnchorPoint::from_xy(across[x], down[y]))
            }
            Anchor::Texels([column, row]) => Sprite::new(source).with_anchor_at(column, row),
        };
        match self.size {
            Extent::Pixels(pixels) => sprite.magnified(pixels),
            Extent::World([width, height]) => {
                sprite.with_size(Scalar::from_bits(width), Scalar::from_bits(height))
            }
        }
    }
}

/// A sprite on the screen, from the exact chain: in sub-pixels.
#[derive(Clone, Copy, Debug)]
struct Seen {
    number: usize,
    shape: Shape,
    low: [i128; 2],
    size: [i128; 2],
    depth: u16,
}

impl Seen {
    /// The texel of a pixel.
    fn texel(&self, pixel: [i32; 2]) -> Option<[u32; 2]> {
        let Size { width, height } = self.shape.picture.size;
        let along = |axis: usize, texels: u32| {
            let offset = 256 * i128::from(pixel[axis]) + 128 - self.low[axis];
            (0..self.size[axis])
                .contains(&offset)
                .then(|| (offset * i128::from(texels) / self.size[axis]) as u32)
        };
        Some([along(0, width)?, along(1, height)?])
    }

    fn color(&self, pixel: [i32; 2]) -> Option<Rgb888> {
        let [column, row] = self.texel(pixel)?;
        self.shape.picture.texel_at(column, row)
    }
}

/// The nearest integer, or `None` if rounding hangs on the last bits of the exact value.
fn sure(value: f64) -> Option<i128> {
    ((value.fract().abs() - 0.5).abs() > 0.02).then(|| value.round() as i128)
}

/// Why a point leads to no sprite.
enum Unseen {
    Unsure,
    Outside,
    /// Its sprite has no size.
    Degenerate,
}

/// The sprite of a vertex, which is the `number`th of its mesh.
fn seen(
    camera: &chain::Camera,
    model: &chain::Affine,
    (number, vertex): (usize, [i16; 3]),
    shape: Shape,
) -> Result<Seen, Unseen> {
    let at = chain::vertex(vertex, EXPONENT);
    let clip = camera.clip(model, at);
    let [_, _, z, w] = clip;
    let margin = 1e-4 * w.abs().max(0.01);
    if (z + w).abs() < margin || (z - w).abs() < margin {
        return Err(Unseen::Unsure);
    }
    if z < -w || z > w || w <= 0.0 {
        return Err(Unseen::Outside);
    }
    let (x, y) = camera.screen(clip);
    let reach = x.abs().max(y.abs());
    if (reach - 8192.0).abs() < 1.0 {
        return Err(Unseen::Unsure);
    }
    if reach > 8192.0 {
        return Err(Unseen::Outside);
    }
    let Size { width: columns, height: rows } = shape.picture.size;
    let size = match shape.size {
        Extent::Pixels(pixels) => {
            [columns, rows].map(|texels| Some((256 * i128::from(texels) * i128::from(pixels)).min(1 << 30)))
        }
        Extent::World(size) => {
            // From the point to the points beside and above it, parallel to the view plane.
            let [a, b, c] = camera.view.apply_placed(model, at);
            let [width, height] = size.map(|bits| f64::from(bits.max(0)) / 65536.0);
            let screen = |x: f64, y: f64| camera.screen(chain::mul4(&camera.projection, [x, y, c, 1.0]));
            let (from, to) = (screen(a, b), screen(a + width, b + height));
            [(to.0 - from.0) * 256.0, (from.1 - to.1) * 256.0]
                .map(|length| sure(length).map(|n| n.min(1 << 30)))
        }
    };
    let ([Some(width), Some(height)], Some(x), Some(y)) = (size, sure(x * 256.0), sure(y * 256.0)) else {
        return Err(Unseen::Unsure);
    };
    let Some(depth) = sure(chain::depth(clip)) else { return Err(Unseen::Unsure) };
    if [width, height].contains(&0) || [columns, rows].contains(&0) {
        return Err(Unseen::Degenerate);
    }
    let before = |axis: usize, length: i128| match shape.anchor {
        Anchor::Halves(halves) => halves[axis] * length / 2,
        Anchor::Texels(count) => {
            let texels = [columns, rows][axis];
            // Of 2³¹ and more, pairs are counted.
            let unit = texels >> 31;
            i128::from(count[axis].min(texels) >> unit) * length / i128::from(texels >> unit)
        }
    };
    Ok(Seen {
        number,
        shape,
        low: [x - before(0, width), y - before(1, height)],
        size: [width, height],
        depth: depth as u16,
    })
}

/// Sprites whose pixels are certain, and their images.
struct Scene {
    camera: CameraBits,
    model: ModelBits,
    vertices: Vec<[i16; 3]>,
    shapes: Vec<Shape>,
    seen: Vec<Seen>,
    /// How many have no image, and how many have no size.
    outside: u32,
    degenerate: u32,
}

impl Scene {
    fn new(camera: CameraBits, model: ModelBits, candidates: &[([i16; 3], Shape)]) -> Self {
        let (exact, exact_model) = (camera.exact(), model.exact());
        let mut scene = Self {
            camera,
            model,
            vertices: Vec::new(),
            shapes: Vec::new(),
            seen: Vec::new(),
            outside: 0,
            degenerate: 0,
        };
        for &(vertex, shape) in candidates {
            match seen(&exact, &exact_model, (scene.vertices.len(), vertex), shape) {
                Err(Unseen::Unsure) => continue,
                Err(Unseen::Outside) => scene.outside += 1,
                Err(Unseen::Degenerate) => scene.degenerate += 1,
                Ok(seen) => scene.seen.push(seen),
            }
            scene.vertices.push(vertex);
            scene.shapes.push(shape);
        }
        scene
    }

    fn place<R>(&self, draw: impl FnOnce(&PlacedSprites<'_>) -> R) -> R {
        let mesh = Mesh::new(&self.vertices, EXPONENT, &[]).expect("a mesh");
        draw(&self.camera.library().with_far_clip(true).place_sprites(&mesh, &self.model.library()))
    }

    /// The picture and the depths by the definition. `merge` makes a pixel of a sprite's number, its colour and the stored
    /// pixel; `stored` has depths that are there before, and whether sprites store theirs.
    fn exact(
        &self,
        stored: Option<(&[u16], bool)>,
        merge: impl Fn(usize, Rgb888, Rgb888) -> Rgb888,
    ) -> (Vec<Rgb888>, Vec<u16>) {
        let (mut pixels, mut depths) = (vec![SKY; 140 * 100], vec![u16::MAX; 140 * 100]);
        let (depths_before, writes) = stored.unwrap_or((&[], true));
        depths.iter_mut().zip(depths_before).for_each(|(depth, before)| *depth = *before);
        let (left, top, width, height) = VIEWPORT;
        for seen in &self.seen {
            for y in top..(top + height as i32) {
                for x in left..(left + width as i32) {
                    let at = (y * 140 + x) as usize;
                    if let Some(color) = seen.color([x, y]).filter(|_| seen.depth < depths[at]) {
                        pixels[at] = merge(seen.number, color, pixels[at]);
                        if writes {
                            depths[at] = seen.depth;
                        }
                    }
                }
            }
        }
        (pixels, depths)
    }

    fn check_statistics(&self, statistics: Statistics) {
        let Statistics { drawn, outside, degenerate, culled, clipped } = statistics;
        assert_eq!((drawn, outside, degenerate), (self.seen.len() as u32, self.outside, self.degenerate));
        assert_eq!((culled, clipped), (0, 0));
    }

    fn draw<T: Surface<Color = Rgb888, Error = E>, E: core::fmt::Debug>(&self, target: &mut T) {
        let statistics =
            self.place(|points| points.draw(|i| self.shapes[i].sprite(self.shapes[i].picture), target));
        self.check_statistics(statistics.expect("no error"));
    }

    fn draw_deep<T: Surface<Color = Rgb888, Error = E>, E: core::fmt::Debug>(
        &self,
        depth: &mut DepthBuffer<'_>,
        target: &mut T,
    ) {
        let sprite = |i: usize| self.shapes[i].sprite(self.shapes[i].picture);
        self.check_statistics(
            self.place(|points| points.draw(sprite, &mut target.depth_tested(depth))).expect("no error"),
        );
    }

    /// The smallest rectangle that holds the pixels of the viewport that sprites cover.
    fn bounds(&self) -> Rectangle {
        let (left, top, width, height) = VIEWPORT;
        let viewport = Rectangle::new(Point::new(left, top), Size::new(width, height));
        let is_covered = |at: &Point| self.seen.iter().any(|seen| seen.texel([at.x, at.y]).is_some());
        let corners = viewport.points().filter(is_covered).fold(None, |corners, at| {
            let (low, high) = corners.unwrap_or((at, at));
            Some((low.component_min(at), high.component_max(at)))
        });
        corners.map_or(Rectangle::zero(), |(low, high)| Rectangle::with_corners(low, high))
    }

    /// The fast path, spans into a DrawTarget, and both in bands: all show the oracle's pixels.
    fn check(&self) {
        let bounds = self.place(|points| points.bounds(|i| self.shapes[i].sprite(self.shapes[i].picture)));
        assert_eq!(bounds, self.bounds());

        let keep = |_: usize, own: Rgb888, _: Rgb888| own;
        let (flat, _) = self.exact(Some((&NOTHING, false)), keep);
        let (deep, depths) = self.exact(None, keep);
        let other = Rectangle::new(Point::new(-3, -2), SIZE + Size::new(9, 4));

        assert!(memory(AREA, SKY, &mut |target, _| self.draw(target)) == flat);
        for depth_area in [AREA, other] {
            let found =
                memory_with(AREA, depth_area, SKY, &mut |target, depth| self.draw_deep(depth, target));
            assert!((&found.0, &found.1) == (&deep, &depths));
        }
        let (found, _) = screen(AREA, &mut |target, _| self.draw(target));
        assert!(found.over(SKY) == flat);
        let (found, stored) = screen(AREA, &mut |target, depth| self.draw_deep(depth, target));
        assert!(found.over(SKY) == deep && stored == depths);

        assert!(bands(AREA, SKY, 9, &mut |band, _| self.draw(&mut band.pixels())) == flat);
        assert!(bands(AREA, SKY, 9, &mut |band, _| self.draw(band)) == flat);
        for direct in [false, true] {
            let mut stored = Vec::new();
            let found = bands(AREA, SKY, 9, &mut |band, depth| {
                match direct {
                    true => self.draw_deep(depth, &mut band.pixels()),
                    false => self.draw_deep(depth, band),
                }
                stored.extend_from_slice(depth.values());
            });
            assert!(found == deep && stored == depths);
        }
    }
}

fn camera(rng: &mut Rng, kind: usize) -> CameraBits {
    let eye = [rng.int(-3, 3) as i32 * ONE, ONE, 5 * ONE];
    CameraBits {
        view: ViewBits::LookAt(eye, [0; 3], [ONE / 5, ONE, 0]),
        projection: match kind {
            0 => ProjectionBits::Perspective(1 << 29, (120, 90), ONE, 40 * ONE),
            1 => ProjectionBits::Frustum([-ONE / 3, ONE / 2, -ONE / 2, ONE / 4], ONE / 2, 30 * ONE),
            2 => ProjectionBits::Orthographic([-3 * ONE, 5 * ONE, -2 * ONE, 4 * ONE], ONE, 20 * ONE),
            // A unit is a pixel.
            3 => ProjectionBits::Orthographic([-60, 60, -45, 45].map(|c| c * ONE), -100 * ONE, 100 * ONE),
            _ => ProjectionBits::Perspective(1 << 26, (120, 90), 3 * ONE, 900 * ONE),
        },
        viewport: VIEWPORT,
    }
}

/// Of up to `largest` world units.
fn shape(rng: &mut Rng, largest: i32) -> Shape {
    let side = |rng: &mut Rng| {
        let reach = [2, 8, 40, 300, 1 << 32][rng.below(5)];
        // A picture may be empty.
        if rng.one_in(30) {
            0
        } else {
            rng.int(1, reach).min(u32::MAX.into()) as u32
        }
    };
    let picture = Noise { size: Size::new(side(rng), side(rng)), seed: rng.next() as u32 };
    // From a pixel for 64 texels to 64 pixels for one.
    let size = match rng.below(3) {
        0 => Extent::Pixels(1),
        1 => Extent::Pixels([0, 2, 3, 5, 64, 255][rng.below(6)]),
        _ => {
            let reach = [ONE / 16, ONE / 2, 4 * ONE, largest][rng.below(4)];
            Extent::World([0; 2].map(|_| rng.int(i64::from(-reach / 8), reach.into()) as i32))
        }
    };
    let anchor = match rng.one_in(3) {
        true => Anchor::Texels([0; 2].map(|_| rng.below(60) as u32)),
        false => Anchor::Halves([0; 2].map(|_| rng.below(3) as i128)),
    };
    Shape { picture, size, anchor }
}

#[test]
fn every_target_shows_the_oracles_pixels() {
    let mut rng = Rng::new(0x59);
    let (mut seen, mut outside, mut degenerate) = (0, 0, 0);
    for case in 0..240 {
        let reach = [400, 900, 3000, 32_767][rng.below(4)];
        let largest = if case % 5 == 3 { i32::MAX } else { 60 * ONE };
        let model = ModelBits(vec![
            Step::Y(rng.next() as u32),
            Step::Scale([ONE * 3 / 4; 3]),
            Step::Move([0, ONE / 7, 0]),
        ]);
        let candidates: Vec<_> = (0..20)
            .map(|_| ([0; 3].map(|_| rng.int(-reach, reach) as i16), shape(&mut rng, largest)))
            .collect();
        // Few sprites too, so that their bounds are not those of the viewport.
        let count = [20, 20, 2, 1][rng.below(4)];
        let scene = Scene::new(camera(&mut rng, case % 5), model, &candidates[..count]);
        seen += scene.seen.len();
        outside += scene.outside;
        degenerate += scene.degenerate;
        scene.check();
    }
    println!("{seen} sprites, {outside} outside, {degenerate} without size");
    assert!(seen > 1200 && outside > 150 && degenerate > 40);
}

/// Half of two channels, by the documentation of `Half`, and 1/32 parts to nearest.
fn mixed(own: Rgb888, below: Rgb888, alpha: Option<u8>) -> Rgb888 {
    let channel =
        |own, below| alpha.map_or_else(|| halved(own, below), |alpha| shade::mixed(own, below, alpha));
    Rgb888::new(channel(own.r(), below.r()), channel(own.g(), below.g()), channel(own.b(), below.b()))
}

/// Translucent sprites are mixed with what is there, once for each pixel, and hide nothing.
#[test]
fn translucent_sprites_are_mixed_with_the_stored_pixels() {
    let mut rng = Rng::new(0x5a);
    let mut changed = 0;
    for case in 0..40 {
        let camera = camera(&mut rng, case % 5);
        let mut scene = |count: usize| {
            let mut candidate = |_| ([0; 3].map(|_| rng.int(-500, 500) as i16), shape(&mut rng, 60 * ONE));
            let candidates: Vec<_> = (0..count).map(&mut candidate).collect();
            Scene::new(camera, ModelBits::default(), &candidates)
        };
        let (walls, scene) = (scene(4), scene(20));
        let alphas: Vec<u8> = scene.shapes.iter().map(|_| rng.below(33) as u8).collect();
        let (_, behind) = walls.exact(None, |_, own, _| own);
        for (deep, half) in [(false, false), (false, true), (true, false), (true, true)] {
            let pixels = memory(AREA, SKY, &mut |target, depth| {
                walls.draw_deep(depth, &mut Screen::new(AREA));
                let statistics = scene.place(|points| {
                    let shape = |i: usize| scene.shapes[i];
                    let halves = |i: usize| shape(i).sprite(Translucent::new(shape(i).picture, Half));
                    let parts =
                        |i: usize| shape(i).sprite(Translucent::new(shape(i).picture, Alpha::new(alphas[i])));
                    match (deep, half) {
                        (false, true) => points.draw(halves, target),
                        (false, false) => points.draw(parts, target),
                        (true, true) => points.draw(halves, &mut target.depth_tested(depth)),
                        (true, false) => points.draw(parts, &mut target.depth_tested(depth)),
                    }
                });
                scene.check_statistics(statistics.expect("no error"));
                assert!(depth.values() == behind);
            });
            let alpha = |i: usize| (!half).then(|| alphas[i]);
            let (expected, _) = scene
                .exact(Some((if deep { &behind } else { &NOTHING[..] }, false)), |i, own, below| {
                    mixed(own, below, alpha(i))
                });
            assert!(pixels == expected, "case {case}, deep {deep}, half {half}");
            changed += pixels.iter().filter(|&&pixel| pixel != SKY).count();
        }
    }
    println!("{changed} mixed pixels");
    assert!(changed > 100_000, "{changed}");
}

/// Of a height that gives a width half-way between two steps of a `Scalar`, the width is the larger one.
#[test]
fn a_tie_of_a_height_rounds_up() {
    let raw = [255; 2 * 4 * 3];
    let image = ImageRaw::<Rgb888>::new(&raw, 2);
    // A step is 4 pixels.
    let camera = CameraBits::ahead(ProjectionBits::Orthographic([-8, 8, -8, 8], ONE, 100 * ONE), (64, 64));
    let placed = camera.library().place_sprite(Point3::from_ints(0, 0, -10));
    for (height, width) in [(2, 1), (3, 2), (4, 2), (5, 3)] {
        let sprite = |_| Sprite::new(SpriteImage::new(&image)).with_height(Scalar::from_bits(height));
        let (picture, _) = screen(rectangle(0, 0, 64, 64), &mut |target, _| {
            placed.draw(sprite, target).expect("no error");
        });
        let drawn = picture.drawn().count();
        assert_eq!(drawn, 4 * width * 4 * height as usize, "{height}");
    }
}

/// A sprite at one pixel per texel shows what embedded-graphics' `Image` draws at its upper left corner, but for texels of a key.
fn shows_the_image<I>(image: &I)
where
    I: GetPixel<Color: Default + core::fmt::Debug> + ImageDrawable<Color = <I as GetPixel>::Color>,
{
    let camera = CameraBits::pixels((64, 64)).library();
    for at in [Point::new(9, 11), Point::new(-3, 60), Point::new(61, -2)] {
        let sky = <I as GetPixel>::Color::default();
        let (mut drawn, mut expected) = (vec![sky; 64 * 64], vec![sky; 64 * 64]);
        let Ok(()) =
            Image::new(image, at).draw(&mut Picture::new(&mut expected, Size::new(64, 64)).expect("room"));
        let placed = camera.place_sprite(Point3::from_ints(at.x as i16, -at.y as i16, -10));
        let mut show = |picture: SpriteImage<'_, I>| {
            drawn.fill(sky);
            let sprite = |_| Sprite::new(picture).with_anchor(AnchorPoint::TopLeft);
            let mut target = Picture::new(&mut drawn, Size::new(64, 64)).expect("room");
            let Ok(_) = placed.draw(sprite, &mut target.pixels());
            drawn.clone()
        };
        assert!(show(SpriteImage::new(image)) == expected, "at {at}");
        assert!(expected.iter().any(|&pixel| pixel != sky));
        // Without the colour of a pixel that all three places show, and that the sky has not.
        let colors = (2..7).map(|row| image.pixel(Point::new(5, row)).expect("a pixel"));
        let key = colors.into_iter().find(|&color| color != sky).expect("another color");
        let keyed = expected.iter().map(|&pixel| if pixel == key { sky } else { pixel });
        assert!(show(SpriteImage::new(image).with_key(key)).iter().copied().eq(keyed), "with a key, at {at}");
    }
}

#[test]
fn images_of_embedded_graphics_are_shown_as_they_draw_themselves() {
    let bytes: Vec<u8> = (0..13 * 7 * 4).map(|i: u32| (i.wrapping_mul(0x9e37_79b1) >> 24) as u8).collect();
    macro_rules! raw {
        ($($color:ty, $order:ty, $row:expr;)*) => {$(
            shows_the_image(&ImageRaw::<$color, $order>::new(&bytes[..7 * $row], 13));
        )*};
    }
    raw! {
        BinaryColor, BigEndian, 2;
        Gray2, BigEndian, 4;
        Gray4, BigEndian, 7;
        Gray8, BigEndian, 13;
        Rgb565, BigEndian, 13 * 2;
        Rgb565, LittleEndian, 13 * 2;
        Bgr888, BigEndian, 13 * 3;
        Rgb888, LittleEndian, 13 * 3;
    }
}

/// Texels of a texture, keyed or not, are shown in their order; squares have the size that they are given.
#[test]
fn texels_of_textures_are_shown_in_their_order() {
    let texels: [[Gray8; 16]; 8] =
        core::array::from_fn(|row| core::array::from_fn(|column| Gray8::new((16 * row + column) as u8)));
    let draw = |target: &mut MockDisplay<Gray8>, keyed: bool| {
        let placed = CameraBits::pixels((64, 64)).library().place_sprite(Point3::from_ints(4, -5, -10));
        let key = Gray8::new(35);
        let drawn = match keyed {
            true => placed.draw(
                |_| Sprite::new(ColorKeyed::new(&texels, key)).with_anchor(AnchorPoint::TopLeft),
                target,
            ),
            false => placed.draw(|_| Sprite::new(&texels).with_anchor(AnchorPoint::TopLeft), target),
        };
        drawn.expect("no error");
    };
    for keyed in [false, true] {
        let mut display = MockDisplay::new();
        draw(&mut display, keyed);
        for (row, column) in (0..8).flat_map(|row| (0..16).map(move |column| (row, column))) {
            let expected = Some(Gray8::new(16 * row + column)).filter(|_| !keyed || (row, column) != (2, 3));
            let at = Point::new(4 + i32::from(column), 5 + i32::from(row));
            assert_eq!(display.get_pixel(at), expected);
        }
    }
    for side in [0, 1, 2, 5, 63] {
        let mut display = MockDisplay::new();
        let placed = CameraBits::pixels((64, 64)).library().place_sprite(Point3::from_ints(32, -32, -10));
        let statistics = placed.draw(|_| Sprite::square(Gray8::WHITE, side), &mut display).expect("no error");
        assert_eq!(display.affected_area().size, Size::new_equal(side.into()));
        assert_eq!((statistics.drawn, statistics.degenerate), (u32::from(side > 0), u32::from(side == 0)));
    }
}

/// Sprites thousands of pixels outside of the picture, before the near plane and of every extreme size draw nothing outside.
#[test]
fn sprites_far_outside_draw_what_reaches_in() {
    let huge = Scalar::MAX;
    let mut drawn = 0;
    for [x, y] in [[-8000, 0], [8100, 0], [0, 8100], [0, -8000], [32_000, 0], [5000, 5000]] {
        for (width, height) in [
            (huge, huge),
            (huge, Scalar::from_bits(1)),
            (Scalar::from_bits(1), huge),
            (Scalar::ONE, Scalar::ONE),
        ] {
            let mut display = MockDisplay::new();
            let placed = CameraBits::pixels((64, 64)).library().place_sprite(Point3::from_ints(x, -y, -10));
            let sprite = Sprite::new(SolidTexel::new(BinaryColor::On)).with_size(width, height);
            let statistics = placed.draw(|_| sprite, &mut display).expect("no error");
            // The guard band: 8192 pixels; a size of less than a sub-pixel is none.
            let is_outside = x.abs() > 8192;
            let is_thin = !is_outside && (width == Scalar::from_bits(1) || height == Scalar::from_bits(1));
            let counts = [statistics.drawn, statistics.outside, statistics.degenerate];
            assert_eq!(counts.map(|n| n == 1), [!is_outside && !is_thin, is_outside, is_thin]);
            let reaches = |at: i16, size: Scalar| size == huge || (0..64).contains(&at);
            let is_shown = counts[0] == 1 && reaches(x, width) && reaches(y, height);
            assert_eq!(
                display.affected_area().size,
                Size::new_equal(if is_shown { 64 } else { 0 }),
                "{x} {y}"
            );
            drawn += u32::from(is_shown);
        }
    }
    assert_eq!(drawn, 5);
}

/// Of sprites at one depth the first one stays, as with faces. In front of the near plane nothing is drawn. Beyond the far plane,
/// sprites are drawn without a depth buffer unless the camera clips there, and never with one.
#[test]
fn equal_depths_and_both_planes() {
    let colors = [Rgb888::RED, Rgb888::BLUE];
    let mesh = Mesh::new(&[[32, -32, -10], [32, -32, -10]], 0, &[]).expect("a mesh");
    let camera = CameraBits::pixels((64, 64)).library();
    let placed = camera.place_sprites(&mesh, &ModelBits::default().library());
    let square = |i: usize| Sprite::square(colors[i], 4);
    let count =
        |pixels: &[Rgb888]| colors.map(|color| pixels.iter().filter(|&&pixel| pixel == color).count());
    let draw_deep = |target: &mut Pixels<'_, Rgb888>, depth: &mut DepthBuffer<'_>| {
        assert_eq!(placed.draw(square, &mut target.depth_tested(depth)).expect("no error").drawn, 2);
    };
    assert_eq!(count(&memory(AREA, SKY, &mut |target, depth| draw_deep(target, depth))), [16, 0]);
    let (found, _) = screen(AREA, &mut |target, depth| {
        assert_eq!(placed.draw(square, &mut target.depth_tested(depth)).expect("no error").drawn, 2);
    });
    assert_eq!(count(&found.over(SKY)), [16, 0]);
    // Without depth, the last one.
    let last = memory(AREA, SKY, &mut |target, _| {
        placed.draw(square, target).expect("no error");
    });
    assert_eq!(count(&last), [0, 16]);

    // Near and far lie at 1 and 100.
    for (z, with_clip, is_drawn, is_drawn_deep) in [
        (0, false, false, false),
        (5, true, false, false),
        (-50, true, true, true),
        (-200, false, true, false),
        (-200, true, false, false),
    ] {
        let placed = camera.with_far_clip(with_clip).place_sprite(Point3::from_ints(32, -32, z));
        let square = |_| Sprite::square(Rgb888::RED, 4);
        for (deep, is_drawn) in [(false, is_drawn), (true, is_drawn_deep)] {
            let (display, _) = screen(AREA, &mut |target, depth| {
                let statistics = match deep {
                    false => placed.draw(square, target),
                    true => placed.draw(square, &mut target.depth_tested(depth)),
                }
                .expect("no error");
                assert_eq!(
                    (statistics.drawn, statistics.outside),
                    (is_drawn.into(), (!is_drawn).into()),
                    "{z}"
                );
            });
            assert_eq!(display.drawn().count() > 0, is_drawn, "{z}");
        }
    }
}
