//! Sprites: pictures that face the viewer, at points of the world.

use super::draw_region::{pixels, DrawRegion};
use super::drawable::SpriteFor;
use super::instance::MeshInstance;
use super::sprite_fill::{fill, ScreenSprite};
use super::statistics::{Outcome, Statistics};
use super::vertex_cache::TransformedMesh;
use crate::camera::{Camera, SizeOnScreen, UnpackedVertex};
use crate::fast::sprite_fill::Strip;
use crate::math::{Affine, Coordinate, Point3, Scalar, Vector3};
use crate::raster::{Scissor, SpriteAxis};
use crate::scene::Mesh;
use crate::shading::{Sprite, SpriteSize, SpriteSource};
use crate::space::{Model, World};
use crate::surface::{rectangle, Surface, Target};
use core::convert::Infallible;
use embedded_graphics_core::geometry::Size;
use embedded_graphics_core::primitives::Rectangle;

/// Points before a camera, each of which shows a [`Sprite`]. [`Camera::place_sprite`] and [`Camera::place_sprites`] make it, once per
/// frame.
#[must_use = "`.draw(sprite, &mut target)` draws the sprites"]
#[derive(Clone, Copy, Debug)]
pub struct PlacedSprites<'m, V: Coordinate = i16> {
    points: MeshInstance<'m, V>,
    world_size: SizeOnScreen,
}

/// The point of [`Camera::place_sprite`], in model space.
static ORIGIN: Mesh<'static> = match Mesh::new(&[[0; 3]], 0, &[]) {
    Ok(mesh) => mesh,
    Err(_) => panic!("a mesh of one vertex"),
};

impl Camera {
    /// Places one sprite at a point of the world. [`Sprite`] has an example.
    ///
    /// ```
    /// use embedded_graphics::{pixelcolor::Rgb565, prelude::*};
    /// use pinhole::{math::Sphere, meshes::SPHERE, prelude::*, Angle};
    /// // A marker of 3 × 3 pixels on a solid ball: drawn before the ball, not drawn behind it.
    /// let mut pixels = [Rgb565::BLACK; 64 * 64];
    /// let mut picture = Picture::new(&mut pixels, Size::new(64, 64))?;
    /// let viewport = Viewport::new(Point::zero(), Size::new(64, 64))?;
    /// let all = Sphere { centre: Point3::from_ints(0, 0, 0), radius: Scalar::from_int(3) };
    /// let camera = Camera::framing(&all, &viewport, Angle::degrees(40), Angle::ZERO, Angle::ZERO)?;
    /// let mut depths = [0; 64 * 64];
    /// let mut depth = DepthBuffer::new(picture.bounding_box(), &mut depths)?;
    /// let ball = camera.place(&SPHERE, &Affine::identity());
    /// ball.faces(|_| Rgb565::BLUE).draw(&mut picture.pixels().depth_tested(&mut depth))?;
    /// for z in [-2, 2] {
    ///     let marker = camera.place_sprite(Point3::from_ints(0, 0, z));
    ///     marker.draw(|_| Sprite::square(Rgb565::RED, 3), &mut picture.pixels().depth_tested(&mut depth))?;
    ///     let shown = if z < 0 { Rgb565::BLUE } else { Rgb565::RED };
    ///     assert_eq!(picture.colors()[32 * 64 + 32], shown);
    /// }
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[inline(never)] // set-up: code size counts
    pub fn place_sprite(&self, at: Point3<World>) -> PlacedSprites<'static> {
        // A model transform of scale 0 maps the vertex to this point, bit for bit where `Camera::project` projects it.
        let to = Affine::<Model, World>::translation(Vector3::new(at.x(), at.y(), at.z()));
        self.place_sprites(&ORIGIN, &Affine::<Model, Model>::scale(Scalar::ZERO).then(&to))
    }

    /// Places a sprite at each vertex of a mesh, which needs no faces, whose vertices `model` takes to the world. Sizes in world units
    /// are not scaled by `model`.
    ///
    /// ```
    /// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::Rgb888, prelude::*};
    /// use pinhole::{prelude::*, Angle};
    /// // Sparks that fade: larger and brighter first.
    /// const SPARKS: [[i16; 3]; 4] = [[-60, 0, 0], [-20, 30, 0], [20, 30, 0], [60, 0, 0]];
    /// let mesh = Mesh::new(&SPARKS, -6, &[])?;
    /// let viewport = Viewport::new(Point::zero(), Size::new(64, 64))?;
    /// let camera = Camera::framing(&mesh.bounding_sphere(), &viewport, Angle::degrees(40), Angle::ZERO, Angle::ZERO)?;
    /// let mut display = MockDisplay::new();
    /// let spark = |index| Sprite::square(Rgb888::new(255, 220 - 50 * index as u8, 0), 4 - index as u8);
    /// let statistics = camera.place_sprites(&mesh, &Affine::identity()).draw(spark, &mut display)?;
    /// assert_eq!(statistics.drawn, 4);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[inline(never)] // the result is large and is written directly to the caller's variable
    pub fn place_sprites<'m, V: Coordinate<Stored = V>>(
        &self,
        mesh: &'m Mesh<'m, V>,
        model: &Affine<Model, World>,
    ) -> PlacedSprites<'m, V> {
        let points = self.place(mesh, model);
        PlacedSprites { world_size: SizeOnScreen::new(self, model, mesh.exponent().into()), points }
    }
}

impl<V: Coordinate<Stored = V>> PlacedSprites<'_, V> {
    /// Draws the sprites in the order of the vertices: `sprite` gets a vertex's index. Translucent sprites have to come from far to
    /// near.
    ///
    /// Into a target [with a depth buffer](crate::target::Surface::depth_tested) it draws the pixels that are nearer than the buffer, and stores
    /// their depth, except of sprites that are mixed with the stored pixels. Points beyond the far plane are outside then, as with
    /// faces.
    ///
    /// [`Statistics`] counts each sprite: as `outside` if its point lies before the near plane, beyond a far plane that clips or more
    /// than 8192 pixels from the target's origin, as `degenerate` if it has no size or no texel, otherwise as `drawn`.
    ///
    /// A [`Translucent`](crate::shading::Translucent) picture reads the stored pixels, so it does not compile for a
    /// target whose pixels do not lie in memory:
    ///
    /// ```compile_fail,E0277
    /// # use embedded_graphics::{mock_display::MockDisplay, pixelcolor::Rgb565, prelude::*};
    /// # use pinhole::{color::Half, math::Sphere, prelude::*, shading::Translucent, sprite::SolidTexel, Angle};
    /// # let viewport = Viewport::new(Point::zero(), Size::new(64, 64))?;
    /// # let sphere = Sphere { centre: Point3::from_ints(0, 0, 0), radius: Scalar::from_int(2) };
    /// # let camera = Camera::framing(&sphere, &viewport, Angle::degrees(40), Angle::ZERO, Angle::ZERO)?;
    /// let smoke = Sprite::new(Translucent::new(SolidTexel::new(Rgb565::RED), Half));
    /// let placed = camera.place_sprite(Point3::from_ints(0, 0, 0));
    /// placed.draw(|_| smoke, &mut MockDisplay::new())?; // into a `Picture`, by `picture.pixels()`, it compiles
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// The target's error, at the first span that it refuses.
    #[inline(always)]
    pub fn draw<T: Target, S: SpriteFor<T::Surface>>(
        &self,
        sprite: impl Fn(usize) -> Sprite<S>,
        target: &mut T,
    ) -> Result<Statistics, T::Error> {
        target.dispatch(
            sprite,
            |sprite, surface| {
                let region = DrawRegion::shared(&surface.area(), self.points.area(), None);
                let mut strip = Strip::default();
                self.each(false, sprite, |image, source| {
                    fill::<T::Surface, S, false>(image, source, &region.scissor, &mut strip, None, surface)
                })
            },
            |sprite, surface, depth| {
                let region = DrawRegion::shared(&surface.area(), self.points.area(), Some(depth));
                let mut strip = Strip::default();
                self.each(true, sprite, |image, source| {
                    let depth = Some(&mut *depth);
                    fill::<T::Surface, S, true>(image, source, &region.scissor, &mut strip, depth, surface)
                })
            },
        )
    }

    /// A rectangle inside the viewport around all pixels of the sprites, hidden and transparent ones too, for
    /// [`DirtyRegions`](crate::bands::DirtyRegions): no pixel outside it is drawn. It is empty if there are none. `sprite` is the closure of
    /// [`draw`](Self::draw).
    ///
    /// ```
    /// use embedded_graphics::{pixelcolor::Gray8, prelude::*, primitives::Rectangle};
    /// use pinhole::{meshes::CUBE, prelude::*, Angle};
    /// let viewport = Viewport::new(Point::zero(), Size::new(64, 64))?;
    /// let camera = Camera::framing(&CUBE.bounding_sphere(), &viewport, Angle::degrees(40), Angle::ZERO, Angle::ZERO)?;
    /// let marker = camera.place_sprite(Point3::from_ints(0, 0, 0)); // in the middle of 64 × 64 pixels
    /// let bounds = marker.bounds(|_| Sprite::square(Gray8::WHITE, 4));
    /// assert_eq!(bounds, Rectangle::new(Point::new(30, 30), Size::new(4, 4)));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn bounds<S: SpriteSource>(&self, sprite: impl Fn(usize) -> Sprite<S>) -> Rectangle {
        let (viewport, mut bounds) = (pixels(self.points.area()), Scissor::UNION_IDENTITY);
        let Ok(_) = self.each(false, sprite, |image, _| {
            let covered = image.covered(&viewport);
            if !covered.is_empty() {
                bounds = bounds.union(&covered);
            }
            Ok::<(), Infallible>(())
        });
        rectangle(&bounds.clipped_to(&viewport))
    }

    /// Calls `draw` with each sprite that has pixels, and its picture. `far`: whether the far plane clips.
    #[inline(always)]
    fn each<S: SpriteSource, E>(
        &self,
        far: bool,
        sprite: impl Fn(usize) -> Sprite<S>,
        mut draw: impl FnMut(&ScreenSprite, &S) -> Result<(), E>,
    ) -> Result<Statistics, E> {
        let mut statistics = Statistics::default();
        for index in 0..self.points.mesh().vertices.len() {
            let mut sprite = sprite(index);
            // `index as u16` is exact: a mesh has at most 65536 vertices.
            let outcome = match self.image(index as u16, far, &sprite) {
                None => Outcome::Outside,
                Some(image) if image.is_empty() => Outcome::Degenerate,
                Some(image) => {
                    sprite.source.set_depth(image.depth);
                    draw(&image, &sprite.source)?;
                    Outcome::Unclipped
                }
            };
            statistics.count(outcome);
        }
        Ok(statistics)
    }

    /// Where a sprite lies on the screen; `None` if its point does not.
    #[inline(always)]
    fn image<S: SpriteSource>(&self, index: u16, far: bool, sprite: &Sprite<S>) -> Option<ScreenSprite> {
        let UnpackedVertex { point, depth } = self.point(index, far)?;
        let Size { width: columns, height: rows } = sprite.source.picture_size();
        let size = match sprite.size {
            _ if columns == 0 || rows == 0 => [0; 2],
            SpriteSize::Pixels(pixels) => [columns, rows].map(|texels| fixed_size(texels, pixels)),
            SpriteSize::World(size) => self.size_in_world(index, size)?,
        };
        let ([width, height], [left, above]) = (size, sprite.before_anchor(size, [columns, rows]));
        Some(ScreenSprite {
            columns: SpriteAxis::new(point.x(), left, width, columns),
            rows: SpriteAxis::new(point.y(), above, height, rows),
            depth: UnpackedVertex { point, depth }.step(),
        })
    }

    #[inline(never)] // one copy for all kinds of sprites
    fn point(&self, index: u16, far: bool) -> Option<UnpackedVertex> {
        TransformedMesh::<V, true>::with_cache(&self.points, far, &[]).vertex(index)
    }

    #[inline(never)] // one copy for all kinds of sprites
    fn size_in_world(&self, index: u16, size: [Scalar; 2]) -> Option<[i32; 2]> {
        let vertex = *self.points.mesh().vertices.get(usize::from(index))?;
        self.world_size.at(vertex, size)
    }
}

/// The length of `texels` texels of `pixels` pixels each, in sub-pixels.
fn fixed_size(texels: u32, pixels: u8) -> i32 {
    let sub_pixels = u64::from(texels) * (u64::from(pixels) << 8); // below 2⁴⁸
    sub_pixels.min(SpriteAxis::LARGEST as u64) as i32
}

defmt_format!([V: Coordinate] PlacedSprites<'_, V>, self, "sprites at the vertices of {}", self.points);
