//! Shaders of the library and one of our own that asks for everything that a shader may ask for, into memory of our own: faces, fog
//! and sprites.

use crate::any;
use crate::inputs::{area, color, corners, levels, point, report, rotation, scalar, size, wide_color};
use core::hint::black_box;
use embedded_graphics_core::geometry::{AnchorPoint, OriginDimensions, Point, Size};
use embedded_graphics_core::image::GetPixel;
use embedded_graphics_core::pixelcolor::{
    Bgr555, Bgr565, Bgr666, Bgr888, BinaryColor, Gray2, Gray4, Gray8, Rgb555, Rgb565, Rgb666, Rgb888,
};
use pinhole::raster::{Gradient, Span, Triangle};
use pinhole::shading::{Barycentric, Translucent};
use pinhole::space::{Model, World};
use pinhole::{
    color::{Alpha, BlendMode, Half, Mixed},
    draw::SpriteFor,
    fog::{Fog, FogTable, VertexFog},
    light::LightError,
    mesh::Coordinate,
    prelude::*,
    shading::{CornerValues, DepthTested, Dithered, Shader, SpanShader},
    sprite::{PlacedSprites, SolidTexel, SpriteImage, SpriteSource},
    target::{BufferError, Pixels},
    texture::{
        Accuracy, BilinearTexels, ColorKeyed, IndexedTexels, MipPicture, MipTexels, TexelSlice, Texels,
        TextureError,
    },
};

/// Depths, 1/w and the weights of each corner, and the pixels that are there.
#[derive(Clone, Copy)]
struct Everything {
    corners: [[i32; 3]; 3],
    values: [[i32; 3]; 2],
    color: Rgb565,
}

impl Shader for Everything {
    type Varying = Barycentric;
    const NEEDS_DEPTH: bool = true;
    const NEEDS_W: bool = true;

    fn sub_face(&self, corners: [Barycentric; 3]) -> Self {
        Self { corners: corners.map(Barycentric::weights), ..*self }
    }

    fn with_corners(&self, corners: &CornerValues) -> Self {
        let color = self.color.with_corners(corners); // a colour asks for nothing: the default
        Self { values: [corners.depths(), corners.inverse_w()], color, ..*self }
    }
}

impl SpanShader<Rgb565> for Everything {
    type Ink = Mixed<Rgb565, Looked>;
    type Setup = ([Gradient; 2], Rgb565);
    type FastPath = ();

    fn set_up(&self, triangle: &Triangle<'_>) -> Self::Setup {
        black_box(self.corners);
        (self.values.map(|values| triangle.gradient(values.map(|value| value as u32))), self.color)
    }

    fn span((gradients, color): &Self::Setup, span: Span) -> impl Iterator<Item = Self::Ink> {
        black_box(gradients.map(|gradient| gradient.at(span.x, span.y)));
        core::iter::repeat(Mixed::new(*color, Looked))
    }
}

/// A blend mode of a program's own.
#[derive(Clone, Copy)]
struct Looked;

impl BlendMode<Rgb565> for Looked {
    fn blend(self, own: Rgb565, stored: Rgb565) -> Rgb565 {
        black_box(stored);
        own
    }
}

fn shader() -> Everything {
    Everything { corners: [[any(); 3]; 3], values: [[any(); 3]; 2], color: color() }
}

/// Faces, and the memory that they are drawn with.
struct Faces<'a> {
    instance: MeshInstance<'a>,
    cache: &'a mut [ScreenVertex],
    cells: &'a mut [u16],
    depths: &'a mut [u16],
}

impl Faces<'_> {
    /// Into memory, without depth and with it.
    fn draw<S: SpanShader<Rgb565>>(&mut self, shade: impl Fn(usize) -> S) {
        let Self { instance, cache, cells, depths } = self;
        let Ok(mut target) = Pixels::<Rgb565, u16>::new(cells, area()) else { return };
        report(instance.faces(&shade).cached(cache).draw(&mut target));
        let Ok(mut depth) = DepthBuffer::new(area(), depths) else { return };
        report(instance.faces(&shade).cached(cache).draw(&mut target.depth_tested(&mut depth)));
    }

    /// A texture that repeats.
    fn textured<S: Texels<Color = Rgb565>>(&mut self, texels: S) -> Result<(), TextureError> {
        let accuracy = [Accuracy::Quarter, Accuracy::Eighth, Accuracy::Sixteenth];
        let accuracy = accuracy.get(any() as usize).copied().unwrap_or_default();
        let texture = Texture::new(texels).with_accuracy(accuracy).with_exponent(any() as i8)?;
        self.draw(|_| texture.at(corners()));
        Ok(())
    }

    /// A picture that does not repeat, without light and with light at each corner.
    fn clamped_and_lit<S: Texels<Color = Rgb565>>(&mut self, texels: S) -> Result<(), TextureError> {
        let texture = Texture::new(texels).with_exponent(any() as i8)?;
        self.draw(|_| texture.clamped_at(corners()));
        self.draw(|_| texture.clamped_at(corners()).lit(levels()));
        Ok(())
    }
}

fn own(faces: &mut Faces<'_>) -> Result<(), BufferError> {
    faces.draw(|_| shader());
    let Faces { instance, cache, cells, depths } = faces;
    report(
        instance
            .faces(|_| shader())
            .culled_by_planes()
            .cached(cache)
            .draw(&mut Pixels::<Rgb565, u16>::with_stride(cells, area(), any() as usize)?),
    );
    if let Ok(mut depth) = DepthBuffer::new(area(), depths) {
        report(instance.depth_only(cache, &mut depth));
    }
    Ok(())
}

fn painter_depth_tested(
    painter: &mut Painter<DepthTested<Translucent<Rgb565, Half>>, 20, 20>,
    faces: &mut Faces<'_>,
) -> Option<()> {
    let shade = |_| DepthTested::new(Translucent::new(color(), Half));
    faces.instance.faces(shade).sorted(painter).ok()?;
    let mut target = Pixels::<Rgb565, u16>::new(faces.cells, area()).ok()?;
    let mut depth = DepthBuffer::new(area(), faces.depths).ok()?;
    report(painter.order().draw(&mut target.depth_tested(&mut depth)));
    report(painter.draw(&mut target.depth_tested(&mut depth)));
    Some(())
}

/// Textures need the corners' 1/w, and wrappers of shaders pass it on; also without the picture's copies.
fn keyed(faces: &mut Faces<'_>, texels: IndexedTexels<'_, Rgb565, 4>) -> Result<(), TextureError> {
    faces.textured(ColorKeyed::new(texels, color()))?;
    let texture = Texture::new(ColorKeyed::new(texels, color()));
    faces.draw(|_| texture.clamped_at(corners()));
    let face = |_| texture.at(corners());
    faces.draw(|f| ScreenDoor::new(face(f), any() as u8));
    faces.draw(|f| Translucent::new(face(f), Half));
    faces.draw(|f| Translucent::new(face(f), Alpha::new(any() as u8)));
    Ok(())
}

/// Faces that leave out pixels, or mix with what is behind them.
fn translucent(faces: &mut Faces<'_>) {
    faces.draw(|_| ScreenDoor::new(color(), any() as u8));
    faces.draw(|_| ScreenDoor::new(Translucent::new(color(), Half), any() as u8));
    faces.draw(|_| Translucent::new(color(), Half));
    faces.draw(|_| Translucent::new(color(), Alpha::new(any() as u8)));
    faces.draw(|_| Translucent::new(color(), |own: Rgb565, stored: Rgb565| stored.emitting(own)));
}

/// Mixes two colours of a format.
fn blend<C: Color>() {
    let [own, stored] = [(); 2].map(|()| C::from_bits(any() as u32));
    report((Half.blend(own, stored).to_bits(), own.mix(stored, any() as u8).to_bits()));
    report(own.over(stored, any() as u16).to_bits());
}

fn fog(camera: &Camera) -> Result<FogTable<Rgb565>, LightError> {
    let fog = Fog::new(scalar(), scalar())?;
    let table = match any() {
        0 => FogTable::new(&fog, camera, color())?,
        1 => FogTable::exponential(&fog, camera, color())?,
        _ => FogTable::squared(&fog, camera, color())?,
    };
    report(table.factor(any() as u16));
    Ok(table)
}

fn vertex_fog(
    fog: &Fog,
    camera: &Camera,
    model: &Affine<Model, World>,
    vertices: &[[i16; 3]],
    factors: &mut [u16],
) {
    let fog = VertexFog::new(fog, camera, model, any() as i8);
    for (factor, &vertex) in factors.iter_mut().zip(vertices) {
        *factor = fog.factor(vertex);
    }
    report(fog.factor([any() as i16; 3]));
}

/// Draws faces in fog, and edges that have colours of their own.
fn fogged(faces: &mut Faces<'_>, table: &FogTable<Rgb565>, shades: &ShadeTable<Rgb565>) {
    faces.draw(|_| Fogged::new(color(), table));
    faces.draw(|_| Fogged::new(Gouraud::lit(wide_color(), levels()), table));
    faces.draw(|_| Fogged::new(shades.lit(levels()), table));
    faces.draw(|_| Fogged::new(ScreenDoor::new(color(), any() as u8), table));
    faces.draw(|_| Fogged::new(Translucent::new(color(), Alpha::new(any() as u8)), table));
    if let Ok(mut target) = Pixels::<Rgb565, u16>::new(faces.cells, area()) {
        report(faces.instance.edges(|_| color()).cached(faces.cache).draw(&mut target));
    }
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
        1 => sprite.with_size(scalar(), scalar()),
        _ => sprite.with_height(scalar()),
    };
    match any() {
        0 => sprite.with_anchor(AnchorPoint::TopLeft),
        1 => sprite.with_anchor(AnchorPoint::BottomCenter),
        _ => sprite.with_anchor_at(any() as u32, any() as u32),
    }
}

/// Sprites, and the depths that they are drawn with.
struct Sprites<'a, V: Coordinate>(&'a PlacedSprites<'a, V>, &'a mut [u16]);

impl<V: Coordinate<Stored = V>> Sprites<'_, V> {
    /// Without depth and with it.
    fn draw<T: Surface<Color = Rgb565>, S: SpriteFor<T>>(&mut self, picture: impl Fn() -> S, target: &mut T) {
        let Self(placed, depths) = self;
        report(placed.draw(|_| sprite(picture()), target).ok());
        let Ok(mut depth) = DepthBuffer::new(area(), depths) else { return };
        report(placed.draw(|_| sprite(picture()), &mut target.depth_tested(&mut depth)).ok());
    }
}

type Texels64 = [[Rgb565; 64]; 32];

fn sprites_in_memory(
    mut sprites: Sprites<'_, i16>,
    texels: &Texels64,
    fog: &FogTable<Rgb565>,
    to: &mut Pixels<'_, Rgb565, u16>,
) {
    let image = Image(size());
    let picture = SpriteImage::new(&image);
    match any() {
        0 => sprites.draw(|| texels, to),
        1 => sprites.draw(|| ColorKeyed::new(texels, color()), to),
        2 => sprites.draw(|| Clone::clone(&picture), to),
        3 => sprites.draw(|| Translucent::new(SpriteImage::new(&image).with_key(color()), Half), to),
        4 => sprites.draw(|| Translucent::new(texels, Alpha::new(any() as u8)), to),
        5 => sprites.draw(|| Translucent::new(Fogged::new(texels, fog), Alpha::new(any() as u8)), to),
        6 => sprites.draw(|| Fogged::new(Translucent::new(texels, Half), fog), to),
        7 => sprites.draw(|| Fogged::new(SolidTexel::new(color()), fog), to),
        _ => sprites.draw(|| SolidTexel::new(color()), to),
    }
}

fn sprites_in_picture<T: Surface<Color = Rgb565>>(
    mut sprites: Sprites<'_, Scalar>,
    texels: &Texels64,
    to: &mut T,
) {
    let image = Image(size());
    match any() {
        0 => sprites.draw(|| texels, to),
        1 => sprites.draw(|| SpriteImage::new(&image).with_key(color()), to),
        _ => sprites.draw(|| SolidTexel::new(color()), to),
    }
}

fn one_sprite<T: Surface<Color = Rgb565>>(camera: &Camera, to: &mut T) {
    let (placed, square) = (camera.place_sprite(point()), |_| Sprite::square(color(), any() as u8));
    report(placed.draw(square, to).ok());
    report(placed.bounds(square));
    let image = Image(size());
    report(placed.draw(|_| sprite(SpriteImage::new(&image)).rotated(rotation()), to).ok());
}

entries! {
    entry_shader_of_own(faces: &mut Faces<'_>) -> Result<(), BufferError> { own(faces) }
    entry_painter_by_planes(painter: &mut Painter<Everything, 20, 20>, faces: &Faces<'_>) { report(faces.instance.faces(|_| shader()).culled_by_planes().sorted(painter)) }
    entry_painter_depth_tested(painter: &mut Painter<DepthTested<Translucent<Rgb565, Half>>, 20, 20>, faces: &mut Faces<'_>) -> Option<()> { painter_depth_tested(painter, faces) }
    entry_translucent(faces: &mut Faces<'_>) { translucent(faces) }

    entry_texture_of_known_size(faces: &mut Faces<'_>, texels: &Texels64) -> Result<(), TextureError> { faces.textured(texels) }
    entry_texture_with_mips(faces: &mut Faces<'_>, texels: &Texels64) -> Result<(), TextureError> {
        let built = MipPicture::build(*texels);
        faces.textured(MipTexels::new(&MipPicture::new(*built.copies(), *texels)))?;
        faces.clamped_and_lit(MipTexels::new(&built))?;
        faces.textured(BilinearTexels::new(MipTexels::new(&built)))?;
        faces.clamped_and_lit(BilinearTexels::new(texels))
    }
    entry_texture_of_any_size(faces: &mut Faces<'_>, texels: &[Rgb565]) -> Result<(), TextureError> { faces.textured(TexelSlice::new(texels, any() as usize, any() as usize)?) }
    entry_texture_with_palette(faces: &mut Faces<'_>, texels: &[u8], palette: &[Rgb565]) -> Result<(), TextureError> {
        faces.textured(IndexedTexels::<_, 4>::new(texels, any() as usize, any() as usize, palette)?)?;
        faces.clamped_and_lit(IndexedTexels::<_, 4>::new(texels, any() as usize, any() as usize, palette)?)?;
        faces.textured(MipTexels::new(IndexedTexels::<_, 4>::new(texels, any() as usize, any() as usize, palette)?))
    }
    entry_texture_with_key(faces: &mut Faces<'_>, texels: &[u8], palette: &[Rgb565]) -> Result<(), TextureError> {
        keyed(faces, IndexedTexels::<_, 4>::new(texels, any() as usize, any() as usize, palette)?)
    }
    entry_lit_texture_of_known_size(faces: &mut Faces<'_>, texels: &Texels64) -> Result<(), TextureError> { faces.clamped_and_lit(texels) }
    entry_lit_texture_of_any_size(faces: &mut Faces<'_>, texels: &[Rgb565]) -> Result<(), TextureError> { faces.clamped_and_lit(TexelSlice::new(texels, any() as usize, any() as usize)?) }

    entry_blend_binary() { blend::<BinaryColor>() }
    entry_blend_gray2() { blend::<Gray2>() }
    entry_blend_gray4() { blend::<Gray4>() }
    entry_blend_gray8() { blend::<Gray8>() }
    entry_blend_rgb555() { blend::<Rgb555>() }
    entry_blend_rgb565() { blend::<Rgb565>() }
    entry_blend_rgb666() { blend::<Rgb666>() }
    entry_blend_rgb888() { blend::<Rgb888>() }
    entry_blend_bgr555() { blend::<Bgr555>() }
    entry_blend_bgr565() { blend::<Bgr565>() }
    entry_blend_bgr666() { blend::<Bgr666>() }
    entry_blend_bgr888() { blend::<Bgr888>() }

    entry_gouraud_in_perspective(faces: &mut Faces<'_>) {
        let shader = || Gouraud::new([wide_color(), wide_color(), wide_color()]).in_perspective();
        faces.draw(|_| shader());
        faces.draw(|_| Dithered(shader()));
    }

    entry_fog(camera: &Camera) -> Result<FogTable<Rgb565>, LightError> { fog(camera) }
    entry_vertex_fog(fog: &Fog, camera: &Camera, model: &Affine<Model, World>, vertices: &[[i16; 3]], factors: &mut [u16]) { vertex_fog(fog, camera, model, vertices, factors) }
    entry_fogged(faces: &mut Faces<'_>, table: &FogTable<Rgb565>, shades: &ShadeTable<Rgb565>) { fogged(faces, table, shades) }
    entry_color_in_fog() -> Flat { Flat::from(wide_color()).in_fog(wide_color(), any() as u16) }
    entry_tables_in_fog() -> (ShadeTable<Rgb565>, ShadeTable<Gray4>) { (ShadeTable::in_fog(wide_color(), wide_color()), ShadeTable::in_fog(wide_color(), wide_color())) }

    entry_sprites_in_memory(camera: &Camera, mesh: &Mesh<'_>, model: &Affine<Model, World>, texels: &Texels64, fog: &FogTable<Rgb565>, cells: &mut [u16], depths: &mut [u16]) -> Result<(), BufferError> {
        sprites_in_memory(Sprites(&camera.place_sprites(mesh, model), depths), texels, fog, &mut Pixels::<Rgb565, u16>::new(cells, area())?);
        Ok(())
    }
    entry_sprites_in_a_picture(camera: &Camera, mesh: &Mesh<'_, Scalar>, model: &Affine<Model, World>, texels: &Texels64, pixels: &mut [Rgb565], depths: &mut [u16]) -> Result<(), BufferError> {
        sprites_in_picture(Sprites(&camera.place_sprites(mesh, model), depths), texels, &mut Picture::new(pixels, size())?);
        Ok(())
    }
    entry_sprite(camera: &Camera, pixels: &mut [Rgb565]) -> Result<(), BufferError> { one_sprite(camera, &mut Picture::new(pixels, size())?); Ok(()) }
}
