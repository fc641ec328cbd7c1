//! Sprites with every kind of picture, into memory and into a display, without depth and with it.

use crate::any;
use embedded_graphics_core::geometry::{AnchorPoint, OriginDimensions, Point, Size};
use embedded_graphics_core::image::GetPixel;
use embedded_graphics_core::pixelcolor::Rgb565;
use embedded_graphics_core::primitives::Rectangle;
use pinhole::space::{Model, World};
use pinhole::{
    Affine, Blended, Camera, ColorKeyed, Coordinate, DepthBuffer, FogTable, Fogged, HalfBlended, Mesh,
    Picture, PictureError, Pixels, PlacedSprites, Point3, Scalar, SolidTexel, Sprite, SpriteImage,
    SpriteSource, Statistics, StoredPixel, Target,
};

fn color() -> Rgb565 {
    Rgb565::load(any() as u16)
}

/// An image that is not the library's.
struct Image(Size);

impl OriginDimensions for Image {
    fn size(&self) -> Size {
        self.0
    }
}

impl GetPixel for Image {
    type Color = Rgb565;

    fn pixel(&self, p: Point) -> Option<Rgb565> {
        (any() != p.x + p.y).then(color)
    }
}

fn sprite<S: SpriteSource>(source: S) -> Sprite<S> {
    let sprite = Sprite::new(source);
    let sprite = match any() {
        0 => sprite.magnified(any() as u8),
        1 => sprite.with_size(Scalar::from_bits(any()), Scalar::from_bits(any())),
        _ => sprite.with_height(Scalar::from_bits(any())),
    };
    match any() {
        0 => sprite.with_anchor(AnchorPoint::TopLeft),
        1 => sprite.with_anchor(AnchorPoint::BottomCenter),
        _ => sprite.with_anchor_at(any() as u32, any() as u32),
    }
}

fn draw<T: Target<Color = Rgb565>, V: Coordinate<Stored = V>, S: SpriteSource<Color = Rgb565>>(
    placed: &PlacedSprites<'_, V>,
    picture: impl Fn(usize) -> S,
    depths: &mut [u16],
    target: &mut T,
) -> [Option<Statistics>; 2] {
    let area = Rectangle::new(Point::new(any(), any()), Size::new(any() as u32, any() as u32));
    let flat = placed.draw(|index| sprite(picture(index)), target).ok();
    let Ok(mut depth) = DepthBuffer::new(area, depths) else { return [flat, None] };
    [flat, placed.depth_tested(|index| sprite(picture(index)), &mut depth, target).ok()]
}

#[unsafe(no_mangle)]
fn entry_sprites_in_memory(
    camera: &Camera,
    mesh: &Mesh<'_>,
    model: &Affine<Model, World>,
    texels: &[[Rgb565; 64]; 32],
    fog: &FogTable<Rgb565>,
    cells: &mut [u16],
    depths: &mut [u16],
) -> Result<[Option<Statistics>; 2], PictureError> {
    let area = Rectangle::new(Point::new(any(), any()), Size::new(any() as u32, any() as u32));
    let mut target = Pixels::<Rgb565, u16>::new(cells, area)?;
    let placed = camera.place_sprites(mesh, model);
    let image = Image(Size::new(any() as u32, any() as u32));
    Ok(match any() {
        0 => draw(&placed, |_| texels, depths, &mut target),
        1 => draw(&placed, |_| ColorKeyed::new(texels, color()), depths, &mut target),
        2 => {
            let picture = SpriteImage::new(&image);
            draw(&placed, |_| Clone::clone(&picture), depths, &mut target)
        }
        3 => draw(
            &placed,
            |_| HalfBlended::new(SpriteImage::new(&image).with_key(color())),
            depths,
            &mut target,
        ),
        4 => draw(&placed, |_| Blended::new(texels, any() as u8), depths, &mut target),
        5 => draw(&placed, |_| Blended::new(Fogged::new(texels, fog), any() as u8), depths, &mut target),
        6 => draw(&placed, |_| Fogged::new(HalfBlended::new(texels), fog), depths, &mut target),
        7 => draw(&placed, |_| Fogged::new(SolidTexel::new(color()), fog), depths, &mut target),
        _ => draw(&placed, |_| SolidTexel::new(color()), depths, &mut target),
    })
}

#[unsafe(no_mangle)]
fn entry_sprites_in_a_picture(
    camera: &Camera,
    mesh: &Mesh<'_, Scalar>,
    model: &Affine<Model, World>,
    texels: &[[Rgb565; 64]; 32],
    pixels: &mut [Rgb565],
    depths: &mut [u16],
) -> Result<[Option<Statistics>; 2], PictureError> {
    let mut target = Picture::new(pixels, Size::new(any() as u32, any() as u32))?;
    let placed = camera.place_sprites(mesh, model);
    let image = Image(Size::new(any() as u32, any() as u32));
    Ok(match any() {
        0 => draw(&placed, |_| texels, depths, &mut target),
        1 => draw(&placed, |_| SpriteImage::new(&image).with_key(color()), depths, &mut target),
        _ => draw(&placed, |_| SolidTexel::new(color()), depths, &mut target),
    })
}

#[unsafe(no_mangle)]
fn entry_sprite(
    camera: &Camera,
    at: Point3<World>,
    pixels: &mut [Rgb565],
) -> Result<(Statistics, Rectangle), PictureError> {
    let mut target = Picture::new(pixels, Size::new(any() as u32, any() as u32))?;
    let (placed, square) = (camera.place_sprite(at), |_| Sprite::square(color(), any() as u8));
    let Ok(statistics) = placed.draw(square, &mut target);
    Ok((statistics, placed.bounds(square)))
}
