//! Sprites whose borders are known exactly, into memory, into a DrawTarget and in bands, with depth: each pixel shows the texel
//! that holds its centre, by the definition in i128.
#![no_main]

mod bytes;

use bytes::Bytes;
use embedded_graphics_core::geometry::{AnchorPoint, Point, Size};
use embedded_graphics_core::pixelcolor::Gray8;
use embedded_graphics_core::primitives::Rectangle;
use libfuzzer_sys::fuzz_target;
use pinhole::{
    Camera, DepthBuffer, Picture, Pixels, Point3, Projection, Scalar, Sprite, SpriteSource, Target, Vector3,
    ViewTransform, Viewport, Window,
};

const SIZE: Size = Size::new(64, 48);
const SKY: Gray8 = Gray8::new(7);

#[derive(Clone, Copy)]
struct Picked(Size);

impl SpriteSource for Picked {
    type Color = Gray8;
    type Ink = Option<Gray8>;

    fn picture_size(&self) -> Size {
        self.0
    }

    fn texel_at(&self, column: u32, row: u32) -> Option<Gray8> {
        assert!(column < self.0.width && row < self.0.height);
        let mixed = (column.wrapping_mul(0x9e37_79b1) ^ row.wrapping_mul(0x85eb_ca77)) >> 20;
        (!mixed.is_multiple_of(5)).then(|| Gray8::new(mixed as u8))
    }
}

/// One world unit is a pixel: positions and lengths are exact in 1/256.
fn camera() -> Camera {
    let [zero, width, height] = [0, 64, 48].map(Scalar::from_int);
    let view = ViewTransform::look_along(
        Point3::from_ints(0, 0, 0),
        Vector3::from_ints(0, 0, -1),
        Vector3::from_ints(0, 1, 0),
    );
    let window = Window { left: zero, right: width, bottom: -height, top: zero };
    let lens = Projection::orthographic(window, Scalar::from_int(1), Scalar::from_int(257));
    Camera::new(&view.unwrap(), &lens.unwrap(), &Viewport::new(Point::zero(), SIZE).unwrap())
}

/// Borders in sub-pixels, the numbers of texels, and the depth.
struct Seen {
    low: [i128; 2],
    size: [i128; 2],
    picture: Picked,
    depth: u16,
}

fuzz_target!(|data: &[u8]| {
    let mut bytes = Bytes::new(data);
    let camera = camera();
    let mut all = Vec::new();
    let mut drawn: Vec<(Point3<pinhole::space::World>, Sprite<Picked>)> = Vec::new();
    for _ in 0..1 + bytes.below(4) {
        // Within 8191 pixels, where the guard band has 8192.
        let [x, y] = [0; 2].map(|_| match bytes.below(3) {
            0 => bytes.wild() % (8191 << 8),
            _ => bytes.wild() % (80 << 8),
        });
        let side = |bytes: &mut Bytes<'_>| match bytes.below(3) {
            0 => bytes.wild() as u32,
            _ => u32::from(bytes.byte()),
        };
        let picture = Picked(Size::new(side(&mut bytes), side(&mut bytes)));
        let distance = 2 + bytes.below(250) as i16;
        let sprite = Sprite::new(picture);
        let (sprite, size) = match bytes.below(2) {
            0 => {
                let pixels = bytes.byte();
                let size = [picture.0.width, picture.0.height]
                    .map(|n| ((i128::from(n) * i128::from(pixels)) << 8).min(1 << 30));
                (sprite.magnified(pixels), size)
            }
            _ => {
                // Up to 32767 pixels: in I16F16, multiples of a sub-pixel.
                let [width, height] = [0; 2].map(|_| bytes.wild() % (32_767 << 8));
                let scalar = |sub_pixels: i32| Scalar::from_bits(sub_pixels << 8);
                let size = [width, height].map(|n| i128::from(n.max(0)));
                (sprite.with_size(scalar(width), scalar(height)), size)
            }
        };
        let (sprite, before) = match bytes.below(3) {
            0 => (sprite.with_anchor(AnchorPoint::BottomLeft), [0, size[1]]),
            1 => (sprite, size.map(|n| n / 2)),
            _ => {
                let at = [0; 2].map(|_| u32::from(bytes.byte()));
                let texels = [picture.0.width, picture.0.height];
                let part = |i: usize| match texels[i] {
                    texels if at[i] >= texels => size[i],
                    // Counted in pairs.
                    texels if texels >> 31 > 0 => i128::from(at[i] >> 1) * size[i] / i128::from(texels >> 1),
                    texels => i128::from(at[i]) * size[i] / i128::from(texels),
                };
                (sprite.with_anchor_at(at[0], at[1]), [part(0), part(1)])
            }
        };
        // y is down on the screen.
        let at = Point3::new(
            Scalar::from_bits(x << 8),
            Scalar::from_bits(-y << 8),
            Scalar::from_int(-i32::from(distance)),
        );
        let seen = camera.project(at).expect("inside");
        assert_eq!((seen.point.x(), seen.point.y()), (x, y));
        drawn.push((at, sprite));
        let low = [i128::from(x) - before[0], i128::from(y) - before[1]];
        let empty = picture.0.width == 0 || picture.0.height == 0;
        all.push(Seen { low, size: if empty { [0; 2] } else { size }, picture, depth: seen.depth });
    }

    let (mut expected, mut depths) = (vec![SKY; 64 * 48], vec![u16::MAX; 64 * 48]);
    for seen in &all {
        for (at, (pixel, depth)) in expected.iter_mut().zip(&mut depths).enumerate() {
            let pixel_at = [(at % 64) as i128, (at / 64) as i128];
            let texel = |axis: usize, texels: u32| {
                let offset = 256 * pixel_at[axis] + 128 - seen.low[axis];
                let inside = (0..seen.size[axis]).contains(&offset);
                inside.then(|| (offset * i128::from(texels) / seen.size[axis]) as u32)
            };
            let Size { width, height } = seen.picture.0;
            let (Some(column), Some(row)) = (texel(0, width), texel(1, height)) else { continue };
            if let Some(color) = seen.picture.texel_at(column, row).filter(|_| seen.depth < *depth) {
                (*pixel, *depth) = (color, seen.depth);
            }
        }
    }

    fn draw<T: Target<Color = Gray8>>(
        camera: &Camera,
        drawn: &[(Point3<pinhole::space::World>, Sprite<Picked>)],
        depth: &mut DepthBuffer<'_>,
        target: &mut T,
    ) {
        for (at, sprite) in drawn {
            assert!(camera.place_sprite(*at).depth_tested(|_| *sprite, depth, target).is_ok());
        }
    }
    let area = Rectangle::new(Point::zero(), SIZE);
    let (mut pixels, mut storage) = (vec![SKY; 64 * 48], vec![0; 64 * 48]);
    let mut depth = DepthBuffer::new(area, &mut storage).unwrap();
    draw(&camera, &drawn, &mut depth, &mut Picture::new(&mut pixels, SIZE).unwrap());
    assert!(pixels == expected && depth.values() == depths);
    // In bands of 5 rows, the last one of 3.
    for (band, y) in expected.chunks(64 * 5).zip((0..).step_by(5)) {
        let area = Rectangle::new(Point::new(0, y), Size::new(64, band.len() as u32 / 64));
        let mut cells = vec![SKY; band.len()];
        let mut depth = DepthBuffer::new(area, &mut storage).unwrap();
        draw(&camera, &drawn, &mut depth, &mut Pixels::<Gray8>::new(&mut cells, area).unwrap());
        assert!(cells == band);
    }
});
