//! Fog by vertex, by face, by edge and by pixel.

use crate::any;
use embedded_graphics_core::geometry::{Point, Size};
use embedded_graphics_core::pixelcolor::{Gray4, Rgb565, Rgb888};
use embedded_graphics_core::primitives::Rectangle;
use pinhole::space::{Model, World};
use pinhole::{
    Affine, Blended, Camera, DepthBuffer, Flat, Fog, FogError, FogTable, Fogged, Gouraud, LitPalette,
    MeshInstance, Pixels, Scalar, ScreenDoor, ScreenVertex, ShadeTable, SpanShader, StoredPixel, VertexFog,
};

fn color() -> Rgb565 {
    Rgb565::load(any() as u16)
}

fn wide_color() -> Rgb888 {
    Rgb888::new(any() as u8, any() as u8, any() as u8)
}

#[unsafe(no_mangle)]
fn entry_fog(camera: &Camera) -> Result<(FogTable<Rgb565>, [i32; 4]), FogError> {
    let [start, end] = [(); 2].map(|()| Scalar::from_bits(any()));
    let fog = Fog::linear(start, end)?;
    let table = FogTable::new(&fog, camera, color())?;
    let table = match any() {
        0 => table,
        1 => FogTable::new(&Fog::exponential(start, end)?, camera, color())?,
        _ => FogTable::new(&Fog::squared(start, end)?, camera, color())?,
    };
    let seen: u16 = table.color_at(color(), any() as u16).stored();
    let numbers =
        [fog.start().to_bits(), fog.end().to_bits(), table.factor(any() as u16).into(), seen.into()];
    Ok((table, numbers))
}

#[unsafe(no_mangle)]
fn entry_vertex_fog(
    fog: &Fog,
    camera: &Camera,
    model: &Affine<Model, World>,
    vertices: &[[i16; 3]],
    factors: &mut [u16],
) -> [u16; 2] {
    let fog = VertexFog::new(fog, camera, model, any() as i8);
    fog.factors(vertices, factors);
    [fog.factor([any() as i16; 3]), fog.face_factor([[any() as i16; 3]; 3])]
}

#[unsafe(no_mangle)]
fn entry_colors_in_fog() -> (Flat, ShadeTable<Rgb565>, ShadeTable<Gray4>, LitPalette<Rgb565, 2, 32>) {
    let flat = Flat::from(wide_color()).in_fog(wide_color(), any() as u16);
    let palette = LitPalette::in_fog(&[wide_color(), wide_color()], wide_color());
    let table = ShadeTable::in_fog(wide_color(), wide_color());
    (flat, table, ShadeTable::in_fog(wide_color(), wide_color()), palette)
}

/// Draws faces in fog, with depth and without.
fn shaded<S: SpanShader<Rgb565>>(
    shade: impl Fn(usize) -> S,
    instance: &MeshInstance<'_>,
    cache: &mut [ScreenVertex],
    cells: &mut [u16],
    depths: &mut [u16],
) {
    let area = Rectangle::new(Point::new(any(), any()), Size::new(any() as u32, any() as u32));
    let Ok(mut target) = Pixels::<Rgb565, u16>::new(cells, area) else { return };
    let Ok(_) = instance.solid(&shade, cache, &mut target);
    if let Ok(mut depth) = DepthBuffer::new(area, depths) {
        let Ok(_) = instance.depth_tested(&shade, cache, &mut depth, &mut target);
    }
    let Ok(_) = instance.wireframe_by_edge(|_| color(), cache, &mut target);
}

#[unsafe(no_mangle)]
fn entry_fogged(
    table: &FogTable<Rgb565>,
    shades: &ShadeTable<Rgb565>,
    instance: &MeshInstance<'_>,
    cache: &mut [ScreenVertex],
    cells: &mut [u16],
    depths: &mut [u16],
) {
    let levels = [(); 3].map(|()| any() as u16);
    shaded(|_| Fogged::new(color(), table), instance, cache, cells, depths);
    shaded(|_| Fogged::new(Gouraud::lit(wide_color(), levels), table), instance, cache, cells, depths);
    shaded(|_| Fogged::new(shades.lit(levels), table), instance, cache, cells, depths);
    let door = |_| Fogged::new(ScreenDoor::new(color(), any() as u8), table);
    shaded(door, instance, cache, cells, depths);
    let glass = |_| Fogged::new(Blended::new(color(), any() as u8), table);
    shaded(glass, instance, cache, cells, depths);
}
