//! The page has one copy of the drawing code for all formats. Its pixels equal those of firmware, which is compiled for its
//! format: drawn here by the library's own shaders, colours and texels, in one piece.

use embedded_graphics::geometry::{Dimensions, Point, Size};
use embedded_graphics::pixelcolor::{BinaryColor, Gray2, Gray4, Rgb565, Rgb888, RgbColor};
use pinhole::{prelude::*, shading::SpanShader, texture::TexelSlice, Angle};
use pinhole_apps_support::canvas::Canvas;
use pinhole_import::{import_bytes, Edges, ImportedMesh, Options};
use pinhole_planner::{Choice, Planner, Tricolor};

const SIZE: Size = Size::new(101, 83); // rows of some formats do not end with a byte
const COLOR: Rgb888 = Rgb888::new(0xf8, 0xfc, 0x58);

/// A box, each side with a part of the texture; one side shows two parts.
const BOX: &str = "v -2 -1 -1\nv 2 -1 -1\nv 2 1 -1\nv -2 1 -1\nv -2 -1 1\nv 2 -1 1\nv 2 1 1\nv -2 1 1\n\
    vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt 2 0\nvt 2 2\nvt 0 2\n\
    f 5/1 6/2 7/3 8/4\nf 2/1 1/2 4/3 3/4\nf 6/1 2/5 3/6 7/7\nf 1/1 5/2 8/3 4/4\nf 8/1 7/2 3/3 4/4\nf 1/1 2/2 6/3 5/4\n";

fn model(vertex_normals: bool) -> ImportedMesh {
    let options = Options { fit: Some(2.0), edges: Edges::None, vertex_normals, ..Options::default() };
    import_bytes(BOX.into(), "box.obj".as_ref(), &[], &options).expect("a box")
}

/// The pixels of the box, as red, green, blue and opacity, filled by what `shader` gives for a face and its light.
fn drawn<C, S>(model: &ImportedMesh, shader: impl Fn(usize, &Lambert) -> S) -> Vec<u8>
where
    C: Color + From<Rgb888> + Into<Rgb888>,
    S: SpanShader<C, Ink = C>,
{
    let mesh = model.mesh().expect("a mesh");
    let mut canvas = Canvas::new(SIZE, C::from(Rgb888::BLACK));
    let viewport = Viewport::new(Point::zero(), SIZE).expect("a viewport");
    let [field_of_view, yaw, pitch] = [40, 30, 20].map(Angle::degrees);
    let camera =
        Camera::framing(&mesh.bounding_sphere(), &viewport, field_of_view, yaw, pitch).expect("a camera");
    let turned = Affine::rotation_y(Angle::turns(7, 120));
    let light = Lambert::new(&turned, Vector3::from_ints(2, 3, 4), 48).expect("a light");
    let mut depths = vec![0; (SIZE.width * SIZE.height) as usize];
    let mut depth = DepthBuffer::new(canvas.bounding_box(), &mut depths).expect("depths");
    let mut cache = vec![ScreenVertex::EMPTY; mesh.cache_len()];
    let instance = camera.place(&mesh, &turned);
    let Ok(_) = instance
        .faces(|face| shader(face, &light))
        .cached(&mut cache)
        .draw(&mut canvas.depth_tested(&mut depth));
    let colors = canvas.pixels().iter().map(|&color| color.into());
    colors.flat_map(|color: Rgb888| [color.r(), color.g(), color.b(), 255]).collect()
}

fn page(rest: &str) -> Vec<u8> {
    let mut planner = Planner::default();
    planner.load("box.obj", BOX.into());
    let text = format!("mesh=file&width=101&height=83&turn=7&color=f8fc58&{rest}");
    planner.draw(&Choice::parse(&text).expect(&text)).expect(&text).0
}

/// The colour as the page passes it to shaders: converted from 16 bits.
fn of_16_bits() -> Rgb888 {
    Rgb565::from(COLOR).into()
}

/// All styles that the format has. A format without shades is always dithered, and shows texels as they are.
fn are_equal<C: Color + From<Rgb888> + Into<Rgb888>>(format: &str, has_shades: bool) {
    let (flat, smooth, texels) = (model(false), model(true), checker::<C>());
    let mesh = smooth.mesh().expect("a mesh");
    let level = |face: usize, light: &Lambert| light.level(mesh.normals()[face]);
    let lit = |face: usize, light: &Lambert| {
        let normals = mesh.corners_of(face, mesh.vertex_normals());
        Gouraud::lit(of_16_bits(), normals.map(|normal| light.level(normal)))
    };
    let dithered = |face, light: &Lambert| Flat::lit(of_16_bits(), level(face, light)).dithered();
    let coords = flat.texture().expect("coordinates").expect("coordinates");
    let texture = Texture::new(TexelSlice::new(&texels, 32, 32).expect("texels"));
    let texture = texture.with_exponent(coords.exponent()).expect("an exponent");
    let textured = |face: usize| texture.at(coords.corners(face));
    let check = |style: &str, expected: Vec<u8>| {
        assert!(page(&format!("format={format}&style={style}")) == expected, "{format}, {style}");
    };
    check("flat&dither=1", drawn::<C, _>(&flat, dithered));
    check("gouraud&dither=1", drawn::<C, _>(&smooth, |face, light| lit(face, light).dithered()));
    if !has_shades {
        return check("textured", drawn::<C, _>(&flat, |face, _| textured(face)));
    }
    check("flat", drawn::<C, _>(&flat, |face, light| C::from(COLOR).dim(level(face, light))));
    check("gouraud", drawn::<C, _>(&smooth, lit));
    check("textured", drawn::<C, _>(&flat, |face, light| textured(face).lit([level(face, light); 3])));
}

/// Squares of 8 texels, the upper left one in the colour, the others in a quarter of it.
fn checker<C: From<Rgb888>>() -> Vec<C> {
    let dark = Rgb888::new(COLOR.r() / 4, COLOR.g() / 4, COLOR.b() / 4);
    let is_light = |x: usize, y: usize| (x / 8) % 2 == (y / 8) % 2;
    (0..32 * 32).map(|i| C::from(if is_light(i % 32, i / 32) { COLOR } else { dark })).collect()
}

#[test]
fn every_format_has_the_pixels_of_its_own_type() {
    are_equal::<Rgb565>("rgb565", true);
    are_equal::<Gray2>("gray2", true);
    are_equal::<Gray4>("gray4", true);
    are_equal::<BinaryColor>("mono", false);
    are_equal::<Tricolor>("tricolor", false);
}
