//! Faces into a picture in memory, a firmware for each shader: of one colour, textured, with a screen door, half mixed, in fog, with
//! keyed texels, and by a table of shades whose light or fog is that of vertices; and sprites at the vertices, keyed and scaled by their
//! distance.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::image::prelude::*;

/// The firmware that is built.
const IMAGE: &str = env!("CARGO_BIN_NAME");
/// The vertices in the cache: sprites have none.
const CACHED: usize = if is_equal(IMAGE, "flash_sprites") { 0 } else { CORNERS };

/// 128 bytes, which count.
static TEXELS: [[Rgb565; 8]; 8] = {
    let mut texels = [[Rgb565::RED; 8]; 8];
    texels[2] = [Rgb565::GREEN; 8];
    texels
};

/// 512 bytes, which count.
static SHADES: ShadeTable<Rgb565> = {
    let mut shades = [Rgb565::BLACK; 256];
    let mut at = 0;
    while at < 256 {
        shades[at] = Rgb565::new(at as u8 / 8, 0, 0);
        at += 1;
    }
    ShadeTable::from_colors(shades)
};

image!(
    cube,
    corners: [ScreenVertex; CACHED] = [ScreenVertex::EMPTY; CACHED],
    memory: [Rgb565; pixels(ROWS)] = [scene::BACKGROUND; pixels(ROWS)],
    {
        let scene = Turntable::turned();
        let mut picture = Picture::new(memory, black_box(Size::new(scene::SIZE, ROWS))).ok()?;
        let frame = Frame { place: || scene.place(cube), corners, picture: &mut picture };
        let color = |face| if face & 1 == 0 { Rgb565::RED } else { scene::BACKGROUND };
        let fog = || {
            let [start, end] = black_box([1 << 16, 4 << 16]).map(Scalar::from_bits);
            Fog::new(start, end).ok()
        };
        match IMAGE {
            "flash_color" => frame.draw(color),
            "flash_textured" => {
                let texture = Texture::new(black_box(&TEXELS));
                frame.draw(|face| texture.at(UV[face & 1]))
            }
            "flash_screen_door" => frame.draw(|face| ScreenDoor::new(color(face), black_box(40))),
            "flash_half" => frame.draw(|face| Translucent::new(color(face), Half)),
            "flash_fogged" => {
                let table = FogTable::new(&fog()?, scene.camera(), scene::BACKGROUND).ok()?;
                frame.draw(|face| Fogged::new(color(face), &table))
            }
            "flash_keyed" => {
                let texture = Texture::new(ColorKeyed::new(black_box(&TEXELS), Rgb565::GREEN));
                frame.draw(|face| texture.at(UV[face & 1]))
            }
            "flash_shades" => {
                let levels = black_box([32, 64, 96, 128, 160, 192, 224, 256]);
                frame.draw(|face| SHADES.lit(cube.mesh.corners_of(face, &levels)))
            }
            "flash_vertex_fog" => {
                let fog = VertexFog::new(&fog()?, scene.camera(), &scene.model, cube.mesh.exponent());
                let mut factors = [0; CORNERS];
                for (factor, &vertex) in factors.iter_mut().zip(cube.mesh.vertices()) {
                    *factor = fog.factor(vertex);
                }
                frame.draw(|face| SHADES.lit(cube.mesh.corners_of(face, &factors)))
            }
            "flash_sprites" => {
                let points = scene.camera().place_sprites(&cube.mesh, &scene.model);
                let side = black_box(Scalar::from_bits(1 << 14));
                let texels = ColorKeyed::new(black_box(&TEXELS), Rgb565::GREEN);
                let sprite = Sprite::new(texels).with_size(side, side);
                let Ok(_) = points.draw(|_| sprite, &mut picture.pixels());
            }
            _ => return None,
        }
        black_box(picture.colors());
        Some(())
    }
);

/// What the faces are drawn with.
struct Frame<'a, 'p, I> {
    place: I,
    corners: &'a mut [ScreenVertex],
    picture: &'a mut Picture<'p, Rgb565>,
}

impl<I: FnOnce() -> MeshInstance<'static>> Frame<'_, '_, I> {
    #[inline(always)]
    fn draw<S: SpanShader<Rgb565>>(self, shade: impl Fn(usize) -> S) {
        let Ok(_) = (self.place)().faces(&shade).cached(self.corners).draw(&mut self.picture.pixels());
    }
}
