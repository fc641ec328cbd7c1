//! A sprite: a picture with a size and an anchor.

use super::rotated::RotatedPicture;
use super::source::{SolidTexel, SpriteSource};
use crate::camera::Rotation;
use crate::math::num::divide;
use crate::math::Scalar;
use embedded_graphics_core::geometry::{AnchorPoint, Point, Size};
use embedded_graphics_core::pixelcolor::PixelColor;

/// A picture that faces the viewer, at a point of the world: a tree, a particle, a label, a marker. Also called a billboard or, of
/// many points, a point sprite.
///
/// Its rectangle is upright on the screen, whichever way the camera is turned, and its [anchor](Self::with_anchor) lies at the image of
/// the point. Its size is fixed, in [pixels](Self::magnified), or in [world units](Self::with_size), so that it shrinks with distance.
/// [`Camera::place_sprite`](crate::Camera::place_sprite) and [`Camera::place_sprites`](crate::Camera::place_sprites) draw it.
///
/// **Which pixel shows which texel.** The image of the point is rounded to 1/256 px, like a vertex; so are the borders of the
/// rectangle. A pixel is covered if its centre lies in the rectangle, or on its left or upper border, and shows the texel that
/// holds the centre: column `⌊(pixel + ½ − left) · columns / width⌋`, exactly; the row is computed likewise. At one pixel per
/// texel each texel is shown once, whatever the fraction of the point's position. No pixel takes a division or a 64-bit product.
///
/// **Depth** is that of the point for all pixels of the sprite.
///
/// ```
/// use embedded_graphics::{geometry::AnchorPoint, mock_display::MockDisplay, pixelcolor::BinaryColor, prelude::*};
/// use pinhole::{math::Sphere, prelude::*, sprite::SpriteImage, Angle};
/// use embedded_graphics::image::ImageRaw;
/// // A flag of 5 × 4 texels, whose pole stands on a point of the world.
/// let image = ImageRaw::<BinaryColor>::new(&[0b11111_000, 0b11111_000, 0b10000_000, 0b10000_000], 5);
/// let flag = Sprite::new(SpriteImage::new(&image).with_key(BinaryColor::Off)).with_anchor(AnchorPoint::BottomLeft);
/// let viewport = Viewport::new(Point::zero(), Size::new(12, 8))?;
/// let sphere = Sphere { centre: Point3::from_ints(0, 0, 0), radius: Scalar::from_int(1) };
/// let camera = Camera::framing(&sphere, &viewport, Angle::degrees(40), Angle::ZERO, Angle::ZERO)?;
/// let mut display = MockDisplay::new();
/// camera.place_sprite(Point3::from_ints(0, 0, 0)).draw(|_| flag, &mut display)?;
/// display.assert_pattern(&[
///     "      #####",
///     "      #####",
///     "      #    ",
///     "      #    ", // the point is the middle of 12 × 8 pixels, below the pole and at its left
/// ]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Sprite<S> {
    pub(crate) source: S,
    pub(crate) size: SpriteSize,
    anchor: Anchor,
}

/// The point of the picture that lies at the point of the world.
#[derive(Clone, Copy, Debug)]
enum Anchor {
    /// The parts of width and height to its left and above it, in halves: 0, 1 or 2.
    Halves([u8; 2]),
    /// The columns and rows to its left and above it.
    Texels([u32; 2]),
}

/// The size of a sprite on the screen.
#[derive(Clone, Copy, Debug)]
pub(crate) enum SpriteSize {
    /// Pixels for each texel, along a row and down a column.
    Pixels(u8),
    /// Width and height in world units.
    World([Scalar; 2]),
}

impl<S> Sprite<S> {
    /// A picture at one pixel per texel, with its middle at the point.
    pub const fn new(source: S) -> Self {
        Self { source, size: SpriteSize::Pixels(1), anchor: Anchor::Halves([1, 1]) }
    }

    /// This sprite with squares of `pixels` × `pixels` for its texels, at any distance. 0 draws nothing.
    #[must_use]
    pub const fn magnified(mut self, pixels: u8) -> Self {
        self.size = SpriteSize::Pixels(pixels);
        self
    }

    /// This sprite with a width and a height in world units, parallel to the view plane: it shrinks with distance in perspective.
    /// A size that is not positive draws nothing.
    ///
    /// **Error.** For points in the picture that are 1/64 world units or more ahead of the eye, and a picture of up to 90°, width
    /// and height are off by at most 1/512 px plus 1.2·10⁻⁸ of themselves. At the vertices of a mesh that reaches r world units
    /// from its origin, add 2⁻²⁸·r/w, where w is the distance ahead. Sprites larger than 2²² px are drawn at that size.
    ///
    /// ```
    /// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::Gray8, prelude::*};
    /// use pinhole::{prelude::*, sprite::SolidTexel, Angle};
    /// let viewport = Viewport::new(Point::zero(), Size::new(64, 64))?;
    /// let (eye, up) = (Point3::from_ints(0, 0, 8), Vector3::from_ints(0, 1, 0));
    /// let view = ViewTransform::look_at(eye, Point3::from_ints(0, 0, 0), up)?;
    /// let [near, far] = [1, 100].map(Scalar::from_int);
    /// let camera = Camera::new(&view, &Projection::perspective(Angle::degrees(90), viewport.size(), near, far)?, &viewport);
    /// let unit = Scalar::from_int(1);
    /// let square = |color| Sprite::new(SolidTexel::new(color)).with_size(unit, unit);
    /// let mut display = MockDisplay::new();
    /// // Within 90°, 16 world units are 64 pixels at a distance of 8, and 32 at 16.
    /// camera.place_sprite(Point3::from_ints(0, 0, 0)).draw(|_| square(Gray8::WHITE), &mut display)?;
    /// assert_eq!(display.affected_area().size, Size::new(4, 4));
    /// camera.place_sprite(Point3::from_ints(8, 0, -8)).draw(|_| square(Gray8::WHITE), &mut display)?;
    /// assert_eq!(display.get_pixel(Point::new(49, 32)), None); // 2 pixels from 47 on
    /// assert_eq!(display.get_pixel(Point::new(48, 32)), Some(Gray8::WHITE));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub const fn with_size(mut self, width: Scalar, height: Scalar) -> Self {
        self.size = SpriteSize::World([width, height]);
        self
    }

    /// This sprite with another point of its picture at the point of the world. The default is the middle, `AnchorPoint::Center`;
    /// for an object that stands on a floor, take `AnchorPoint::BottomCenter`.
    #[must_use]
    pub const fn with_anchor(mut self, anchor: AnchorPoint) -> Self {
        use AnchorPoint as A;
        self.anchor = Anchor::Halves(match anchor {
            A::TopLeft => [0, 0],
            A::TopCenter => [1, 0],
            A::TopRight => [2, 0],
            A::CenterLeft => [0, 1],
            A::Center => [1, 1],
            A::CenterRight => [2, 1],
            A::BottomLeft => [0, 2],
            A::BottomCenter => [1, 2],
            A::BottomRight => [2, 2],
        });
        self
    }

    /// This sprite with the upper left corner of a texel at the point of the world, like the hot spot of a cursor. A column or
    /// row beyond the picture counts as its right or lower border.
    ///
    /// ```
    /// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::Gray8, prelude::*};
    /// use pinhole::{meshes::CUBE, prelude::*, Angle};
    /// let viewport = Viewport::new(Point::zero(), Size::new(64, 64))?;
    /// let camera = Camera::framing(&CUBE.bounding_sphere(), &viewport, Angle::degrees(40), Angle::ZERO, Angle::ZERO)?;
    /// let picture = [[Gray8::WHITE; 8]; 8];
    /// let mut display = MockDisplay::new();
    /// let arrow = Sprite::new(&picture).with_anchor_at(2, 0);
    /// camera.place_sprite(Point3::from_ints(0, 0, 0)).draw(|_| arrow, &mut display)?;
    /// assert_eq!(display.affected_area().top_left, Point::new(32 - 2, 32));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub const fn with_anchor_at(mut self, column: u32, row: u32) -> Self {
        self.anchor = Anchor::Texels([column, row]);
        self
    }
}

impl<S: SpriteSource> Sprite<S> {
    /// This sprite with its picture, size and anchor turned to match a [turned viewport](crate::Viewport::rotated), so that its viewer sees it
    /// upright. Call it last: sizes and anchors that are set later count along the panel's rows and columns.
    ///
    /// ```
    /// use embedded_graphics::{geometry::AnchorPoint, image::ImageRaw, mock_display::MockDisplay, pixelcolor::BinaryColor, prelude::*};
    /// use pinhole::{camera::Rotation, meshes::CUBE, prelude::*, sprite::SpriteImage, Angle};
    /// // A flag of 5 × 4 texels, with its pole below it.
    /// let image = ImageRaw::<BinaryColor>::new(&[0b11111_000, 0b11111_000, 0b10000_000, 0b10000_000], 5);
    /// let flag = Sprite::new(SpriteImage::new(&image).with_key(BinaryColor::Off)).with_anchor(AnchorPoint::BottomLeft);
    /// let viewport = Viewport::new(Point::zero(), Size::new(12, 8))?.rotated(Rotation::Deg90);
    /// let camera = Camera::framing(&CUBE.bounding_sphere(), &viewport, Angle::degrees(40), Angle::ZERO, Angle::ZERO)?;
    /// let mut panel = MockDisplay::new();
    /// camera.place_sprite(Point3::from_ints(0, 0, 0)).draw(|_| flag.rotated(viewport.rotation()), &mut panel)?;
    /// panel.assert_pattern(&[
    ///     "            ",
    ///     "            ",
    ///     "            ",
    ///     "            ",
    ///     "      ####  ", // the viewer's upper border is at the right
    ///     "        ##  ",
    ///     "        ##  ",
    ///     "        ##  ",
    /// ]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn rotated(self, rotation: Rotation) -> Sprite<RotatedPicture<S>> {
        let is_quarter = rotation.of_size(Size::new(1, 2)).width == 2;
        let size = match self.size {
            SpriteSize::World([width, height]) if is_quarter => SpriteSize::World([height, width]),
            size => size,
        };
        // Borders are turned like the texels of a picture with one texel more each way.
        let turn = |[x, y]: [u32; 2], last: Size| {
            let all =
                rotation.of_size(Size::new(last.width.saturating_add(1), last.height.saturating_add(1)));
            let Point { x, y } = rotation.turn(Point::new(x as i32, y as i32), all);
            [x as u32, y as u32]
        };
        let anchor = match self.anchor {
            Anchor::Halves(at) => {
                Anchor::Halves(turn(at.map(u32::from), Size::new(2, 2)).map(|halves| halves as u8))
            }
            Anchor::Texels([x, y]) => {
                let last = self.source.picture_size();
                Anchor::Texels(turn([x.min(last.width), y.min(last.height)], last))
            }
        };
        Sprite { source: RotatedPicture::new(self.source, rotation), size, anchor }
    }

    /// The parts of width and height, 0 … 2³⁰, that lie before the anchor, rounded down.
    #[inline(always)]
    pub(crate) fn before_anchor(&self, size: [i32; 2], texels: [u32; 2]) -> [i32; 2] {
        let ([width, height], [columns, rows]) = (size, texels);
        match self.anchor {
            Anchor::Halves([x, y]) => [halves(width, x), halves(height, y)],
            Anchor::Texels([x, y]) => [part(width, x, columns), part(height, y, rows)],
        }
    }

    /// This sprite with a height in world units, and the width at which its texels are square, rounded to the nearest 2⁻¹⁶ and
    /// saturated. [`with_size`](Self::with_size) has the error.
    ///
    /// ```
    /// use embedded_graphics::{image::ImageRaw, pixelcolor::Gray8};
    /// use pinhole::{sprite::{Sprite, SpriteImage}, Scalar};
    /// let image = ImageRaw::<Gray8>::new(&[0; 15], 3); // 3 × 5 texels
    /// let tree = Sprite::new(SpriteImage::new(&image)).with_height(Scalar::from_int(10)); // 6 wide
    /// ```
    #[must_use]
    pub fn with_height(self, height: Scalar) -> Self {
        let Size { width: columns, height: rows } = self.source.picture_size();
        // Pictures have less than 2³¹ rows; without rows, nothing is drawn at any size.
        let rows = rows.clamp(1, i32::MAX as u32);
        let bits = u64::from(height.to_bits().max(0).unsigned_abs()) * u64::from(columns & (i32::MAX as u32)); // below 2⁶²
        let (width, rest) = divide(bits, rows);
        let width = width + u64::from(rest >= rows - rest); // to nearest, ties up
        self.with_size(Scalar::from_bits(width.min(i32::MAX as u64) as i32), height)
    }
}

/// 0, 1 or 2 halves of a length.
#[inline(always)]
const fn halves(length: i32, count: u8) -> i32 {
    match count {
        0 => 0,
        1 => length >> 1,
        _ => length,
    }
}

/// The part of `length`, 0 … 2³⁰, that `count` of its `texels` take: all of it if `count` is not less than `texels`.
fn part(length: i32, count: u32, texels: u32) -> i32 {
    if count >= texels {
        return length;
    }
    // `divide` takes a divisor of 31 bits: 2³¹ texels and more are counted in pairs. The product is below 2⁶², the quotient below the
    // length.
    let down = texels >> 31;
    let product = u64::from(length.unsigned_abs()) * u64::from(count >> down);
    divide(product, texels >> down).0 as i32
}

impl<C: PixelColor> Sprite<SolidTexel<C>> {
    /// A square of one colour, `side` pixels wide and high, with its middle at the point: for particles. 0 draws nothing.
    ///
    /// Particles that shrink with distance are `Sprite::new(SolidTexel::new(color))` [with a size](Self::with_size).
    pub const fn square(color: C, side: u8) -> Self {
        Self::new(SolidTexel::new(color)).magnified(side)
    }
}

// The picture is not printed: it need not implement `Format`.
#[cfg(feature = "defmt")]
impl<S> defmt::Format for Sprite<S> {
    fn format(&self, f: defmt::Formatter<'_>) {
        match self.size {
            SpriteSize::Pixels(pixels) => defmt::write!(f, "sprite, {=u8} px per texel", pixels),
            SpriteSize::World([width, height]) => {
                defmt::write!(f, "sprite of {=i32} x {=i32} / 65536", width.to_bits(), height.to_bits());
            }
        }
    }
}
