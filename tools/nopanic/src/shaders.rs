//! A shader of our own that asks for everything that a shader may ask for, drawn by every call, into memory of our own.

use crate::any;
use core::hint::black_box;
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::pixelcolor::{
    Bgr555, Bgr565, Bgr666, Bgr888, BinaryColor, Gray2, Gray4, Gray8, Rgb555, Rgb565, Rgb666, Rgb888,
};
use embedded_graphics_core::primitives::Rectangle;
use pinhole::clip::Barycentric;
use pinhole::raster::{Gradient, Span, Triangle};
use pinhole::{
    Accuracy, Blend, Blended, ColorKeyed, CornerValues, DepthBuffer, DepthTested, Dim, HalfBlended,
    IndexKeyed, IndexedTexels, LitPalette, LitTexels, Memory, MeshInstance, Painter, PainterError,
    PictureError, PixelFormat, Pixels, ScreenDoor, ScreenVertex, Shader, SpanShader, Statistics, StoredPixel,
    TexelSlice, Texels, Texture, TextureError, Translucent, WithPlanes,
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
    type Setup = ([Gradient; 2], Rgb565);
    const BLENDS: bool = true;

    fn set_up(&self, triangle: &Triangle<'_>) -> Self::Setup {
        black_box(self.corners);
        (self.values.map(|values| triangle.gradient(values.map(|value| value as u32))), self.color)
    }

    fn span((gradients, color): &Self::Setup, span: Span) -> impl Iterator<Item = Rgb565> {
        black_box(gradients.map(|gradient| gradient.at(span.x, span.y)));
        core::iter::repeat(*color)
    }

    fn blend((_, color): &Self::Setup) -> impl Fn(Rgb565, Rgb565) -> Rgb565 + Copy {
        let mix = Rgb565::blend(color); // a colour does not look: the default
        move |own, stored| mix(black_box(stored), own)
    }
}

fn shader() -> Everything {
    Everything {
        corners: [[any(); 3]; 3],
        values: [[any(); 3]; 2],
        color: Rgb565::load([any() as u8, any() as u8]),
    }
}

fn area() -> Rectangle {
    Rectangle::new(Point::new(any(), any()), Size::new(any() as u32, any() as u32))
}

#[unsafe(no_mangle)]
fn entry_shader_of_own(
    by_planes: &MeshInstance<'_, i16, WithPlanes>,
    cache: &mut [ScreenVertex],
    cells: &mut [u16],
    depths: &mut [u16],
) -> Result<[Statistics; 4], PictureError> {
    let instance = by_planes.without_planes();
    let mut target = Pixels::<Rgb565, u16>::new(cells, area())?;
    let Ok(solid) = instance.solid(|_| shader(), cache, &mut target);
    let Ok(culled) = by_planes.solid(|_| shader(), cache, &mut target);
    let [mut tested, mut kept] = [Statistics::default(); 2];
    if let Ok(mut depth) = DepthBuffer::new(area(), depths) {
        let Ok(statistics) = instance.depth_tested(|_| shader(), cache, &mut depth, &mut target);
        tested = statistics;
        kept = by_planes.depth_only(cache, &mut depth);
    }
    Ok([solid, culled, tested, kept])
}

#[unsafe(no_mangle)]
fn entry_painter_by_planes(
    painter: &mut Painter<Everything, 20, 20>,
    instance: &MeshInstance<'_, i16, WithPlanes>,
) -> Result<(), PainterError> {
    painter.add(instance, |_| shader())
}

#[unsafe(no_mangle)]
fn entry_painter_depth_tested(
    painter: &mut Painter<DepthTested<HalfBlended<Rgb565>>, 20, 20>,
    instance: &MeshInstance<'_>,
    cells: &mut [u16],
    depths: &mut [u16],
) -> Option<Statistics> {
    let shade = |_| DepthTested::new(HalfBlended::new(Rgb565::load(any() as u16)));
    painter.add(instance, shade).ok()?;
    let mut target = Pixels::<Rgb565, u16>::new(cells, area()).ok()?;
    let mut depth = DepthBuffer::new(area(), depths).ok()?;
    let Ok(()) = painter.order().depth_tested(&mut depth, &mut target);
    let Ok(statistics) = painter.depth_tested(&mut depth, &mut target);
    Some(statistics)
}

/// Draws a texture by the calls that differ in how rows are cut into runs.
fn textured<S: Texels<Color = Rgb565>>(
    texels: S,
    instance: &MeshInstance<'_>,
    cache: &mut [ScreenVertex],
    cells: &mut [u16],
    depths: &mut [u16],
) -> Result<[Statistics; 2], TextureError> {
    let accuracy = [Accuracy::Quarter, Accuracy::Eighth, Accuracy::Sixteenth];
    let accuracy = accuracy.get(any() as usize).copied().unwrap_or_default();
    let texture = Texture::new(texels).with_accuracy(accuracy).with_exponent(any() as i8)?;
    shaded(|_| texture.at([[any() as i16, any() as i16]; 3]), instance, cache, cells, depths)
}

/// [`textured`] for a picture that does not repeat, with light at each corner.
fn clamped_and_lit<S: LitTexels<Color = Rgb565>>(
    texels: S,
    instance: &MeshInstance<'_>,
    cache: &mut [ScreenVertex],
    cells: &mut [u16],
    depths: &mut [u16],
) -> Result<[Statistics; 2], TextureError> {
    let texture = Texture::new(texels).with_exponent(any() as i8)?;
    let levels = [any() as u16, any() as u16, any() as u16];
    let shade = |_| texture.clamped_at([[any() as i16, any() as i16]; 3]);
    shaded(shade, instance, cache, cells, depths)?;
    shaded(|face| shade(face).lit(levels), instance, cache, cells, depths)
}

/// Draws faces into memory, without depth and with it.
fn shaded<S: SpanShader<Rgb565>>(
    shade: impl Fn(usize) -> S,
    instance: &MeshInstance<'_>,
    cache: &mut [ScreenVertex],
    cells: &mut [u16],
    depths: &mut [u16],
) -> Result<[Statistics; 2], TextureError> {
    let [mut solid, mut tested] = [Statistics::default(); 2];
    if let Ok(mut target) = Pixels::<Rgb565, u16>::new(cells, area()) {
        let Ok(statistics) = instance.solid(&shade, cache, &mut target);
        solid = statistics;
        if let Ok(mut depth) = DepthBuffer::new(area(), depths) {
            let Ok(statistics) = instance.depth_tested(&shade, cache, &mut depth, &mut target);
            tested = statistics;
        }
    }
    Ok([solid, tested])
}

#[unsafe(no_mangle)]
fn entry_texture_of_known_size(
    texels: &[[Rgb565; 64]; 32],
    instance: &MeshInstance<'_>,
    cache: &mut [ScreenVertex],
    cells: &mut [u16],
    depths: &mut [u16],
) -> Result<[Statistics; 2], TextureError> {
    textured(texels, instance, cache, cells, depths)
}

#[unsafe(no_mangle)]
fn entry_texture_of_any_size(
    texels: &[Rgb565],
    instance: &MeshInstance<'_>,
    cache: &mut [ScreenVertex],
    cells: &mut [u16],
    depths: &mut [u16],
) -> Result<[Statistics; 2], TextureError> {
    let texels = TexelSlice::new(texels, any() as usize, any() as usize)?;
    textured(texels, instance, cache, cells, depths)
}

#[unsafe(no_mangle)]
fn entry_texture_with_palette(
    texels: &[u8],
    palettes: [&[Rgb565]; 2],
    instance: &MeshInstance<'_>,
    cache: &mut [ScreenVertex],
    cells: &mut [u16],
    depths: &mut [u16],
) -> Result<[Statistics; 2], TextureError> {
    let [palette, other] = palettes;
    let texels = IndexedTexels::<_, 4>::new(texels, any() as usize, any() as usize, palette)?;
    textured(texels.with_palette(other)?, instance, cache, cells, depths)
}

#[unsafe(no_mangle)]
fn entry_texture_with_key(
    texels: &[u8],
    palette: &[Rgb565],
    instance: &MeshInstance<'_>,
    cache: &mut [ScreenVertex],
    cells: &mut [u16],
    depths: &mut [u16],
) -> Result<[Statistics; 4], TextureError> {
    let texels = IndexedTexels::<_, 4>::new(texels, any() as usize, any() as usize, palette)?;
    let [solid, tested] = textured(IndexKeyed::new(texels, any() as u8), instance, cache, cells, depths)?;
    let key = Rgb565::load(any() as u16);
    let [other_solid, other_tested] = textured(ColorKeyed::new(texels, key), instance, cache, cells, depths)?;
    // Textures need the corners' 1/w, and wrappers of shaders pass it on; also without the picture's copies.
    let texture = Texture::new(ColorKeyed::new(texels, key));
    shaded(|_| texture.clamped_at([[any() as i16, any() as i16]; 3]), instance, cache, cells, depths)?;
    let face = |_| texture.at([[any() as i16, any() as i16]; 3]);
    shaded(|f| ScreenDoor::new(face(f), any() as u8), instance, cache, cells, depths)?;
    shaded(|f| HalfBlended::new(face(f)), instance, cache, cells, depths)?;
    shaded(|f| Blended::new(face(f), any() as u8), instance, cache, cells, depths)?;
    Ok([solid, tested, other_solid, other_tested])
}

#[unsafe(no_mangle)]
fn entry_screen_door(
    instance: &MeshInstance<'_>,
    cache: &mut [ScreenVertex],
    cells: &mut [u16],
    depths: &mut [u16],
) -> Result<[Statistics; 2], PictureError> {
    let mut target = Pixels::<Rgb565, u16>::new(cells, area())?;
    let shade = |_| ScreenDoor::new(Rgb565::load(any() as u16), any() as u8);
    let Ok(solid) = instance.solid(shade, cache, &mut target);
    let mut tested = Statistics::default();
    if let Ok(mut depth) = DepthBuffer::new(area(), depths) {
        let Ok(statistics) = instance.depth_tested(shade, cache, &mut depth, &mut target);
        tested = statistics;
    }
    Ok([solid, tested])
}

#[unsafe(no_mangle)]
fn entry_blended(
    instance: &MeshInstance<'_>,
    cache: &mut [ScreenVertex],
    cells: &mut [u16],
    depths: &mut [u16],
) -> Result<[Statistics; 3], PictureError> {
    let mut target = Pixels::<Rgb565, u16>::new(cells, area())?;
    let color = || Rgb565::load(any() as u16);
    let half = |_| ScreenDoor::new(HalfBlended::new(color()), any() as u8);
    let Ok(solid) = instance.solid(half, cache, &mut target);
    let Ok(_) = instance.solid(|_| HalfBlended::new(color()), cache, &mut target);
    let Ok(_) = instance.solid(|_| Blended::new(color(), any() as u8), cache, &mut target);
    let light = |_| Translucent::by(color(), |own: Rgb565, stored: Rgb565| stored.emitting(own));
    let Ok(_) = instance.solid(light, cache, &mut target);
    let [mut tested, mut mixed] = [Statistics::default(); 2];
    if let Ok(mut depth) = DepthBuffer::new(area(), depths) {
        let Ok(statistics) = instance.depth_tested(half, cache, &mut depth, &mut target);
        tested = statistics;
        let shade = |_| Blended::new(color(), any() as u8);
        let Ok(statistics) = instance.depth_tested(shade, cache, &mut depth, &mut target);
        mixed = statistics;
    }
    Ok([solid, tested, mixed])
}

/// Mixes colours of every format.
#[unsafe(no_mangle)]
fn entry_blend(bits: [u32; 2], alpha: u8) -> [u32; 3] {
    fn both<C: Blend + PixelFormat>([own, stored]: [u32; 2], alpha: u8) -> [u32; 3] {
        let [own, stored] = [own, stored].map(C::decode);
        black_box(own.mixer()(stored, any() as u32).encode());
        black_box(own.fade(stored)(alpha).encode());
        [own.half(stored).encode(), own.mix(stored, alpha).encode(), own.over(stored, any() as u16).encode()]
    }
    match any() {
        0 => both::<BinaryColor>(bits, alpha),
        1 => both::<Gray2>(bits, alpha),
        2 => both::<Gray4>(bits, alpha),
        3 => both::<Gray8>(bits, alpha),
        4 => both::<Rgb555>(bits, alpha),
        5 => both::<Rgb565>(bits, alpha),
        6 => both::<Rgb666>(bits, alpha),
        7 => both::<Rgb888>(bits, alpha),
        8 => both::<Bgr555>(bits, alpha),
        9 => both::<Bgr565>(bits, alpha),
        10 => both::<Bgr666>(bits, alpha),
        _ => both::<Bgr888>(bits, alpha),
    }
}

#[unsafe(no_mangle)]
fn entry_lit_texture_of_known_size(
    texels: &[[Rgb565; 64]; 32],
    instance: &MeshInstance<'_>,
    cache: &mut [ScreenVertex],
    cells: &mut [u16],
    depths: &mut [u16],
) -> Result<[Statistics; 2], TextureError> {
    clamped_and_lit(texels, instance, cache, cells, depths)
}

#[unsafe(no_mangle)]
fn entry_lit_texture_of_any_size(
    texels: &[Rgb565],
    instance: &MeshInstance<'_>,
    cache: &mut [ScreenVertex],
    cells: &mut [u16],
    depths: &mut [u16],
) -> Result<[Statistics; 2], TextureError> {
    let texels = TexelSlice::new(texels, any() as usize, any() as usize)?;
    clamped_and_lit(texels, instance, cache, cells, depths)
}

#[unsafe(no_mangle)]
fn entry_lit_texture_with_palette(
    texels: &[u8],
    colors: &[Rgb888; 17],
    instance: &MeshInstance<'_>,
    cache: &mut [ScreenVertex],
    cells: &mut [u16],
    depths: &mut [u16],
) -> Result<[Statistics; 2], TextureError> {
    let palette = LitPalette::<Rgb565, 17, 32>::new(colors);
    let palette = LitPalette::from_rows(*palette.rows());
    let row = palette.row(any() as u16);
    let texels = IndexedTexels::<_, 4>::new(texels, any() as usize, any() as usize, row)?;
    let texture = Texture::new(texels).with_palette(row);
    shaded(|_| texture.at([[any() as i16, any() as i16]; 3]), instance, cache, cells, depths)?;
    clamped_and_lit(texels, instance, cache, cells, depths)?;
    textured(texels.with_lit_palette(&palette), instance, cache, cells, depths)?;
    clamped_and_lit(texels.with_lit_palette(&palette), instance, cache, cells, depths)
}

#[unsafe(no_mangle)]
fn entry_memory_of_own(cells: &mut [u16]) -> Result<Rectangle, PictureError> {
    let mut memory = Memory::new(cells, area())?;
    let span = Span { x: any(), y: any(), width: any(), height: any() };
    memory.fill(span, any() as u16);
    memory.fill_run(span, core::iter::repeat(any() as u16));
    black_box(memory.row(any(), any(), any()).map(|row| row.len()));
    Ok(memory.area())
}
