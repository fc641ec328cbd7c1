//! The page has one copy of the drawing code for all formats. Its pixels equal those of firmware, which is compiled for its
//! format: drawn here by the library's own shaders, colours and texels, in one piece.

use embedded_graphics::geometry::{Dimensions, Point, Size};
use embedded_graphics::pixelcolor::{BinaryColor, Gray2, Gray4, Rgb565, Rgb888, RgbColor};
use embedded_graphics::primitives::Rectangle;
use pinhole::{bands::SmoothFrame, prelude::*, shading::SpanShader, texture::TexelSlice, Angle};
use pinhole_apps_support::canvas::Canvas;
use pinhole_import::{import_bytes, Edges, ImportedMesh, Options};
use pinhole_planner::{Choice, Planner, Tricolor};

const SIZE: Size = Size::new(101, 83); // rows of some formats do not end with a byte
const PIXELS: usize = (SIZE.width * SIZE.height) as usize;
const COLOR: Rgb888 = Rgb888::new(0xf8, 0xfc, 0x58);

/// A box, each side with a part of the texture; one side shows two parts.
const BOX: &str = "v -2 -1 -1\nv 2 -1 -1\nv 2 1 -1\nv -2 1 -1\nv -2 -1 1\nv 2 -1 1\nv 2 1 1\nv -2 1 1\n\
    vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt 2 0\nvt 2 2\nvt 0 2\n\
    f 5/1 6/2 7/3 8/4\nf 2/1 1/2 4/3 3/4\nf 6/1 2/5 3/6 7/7\nf 1/1 5/2 8/3 4/4\nf 8/1 7/2 3/3 4/4\nf 1/1 2/2 6/3 5/4\n";

fn model(vertex_normals: bool, has_edges: bool) -> ImportedMesh {
    let edges = if has_edges { Edges::CreasesFirst { degrees: 0.0 } } else { Edges::None };
    let options =
        Options { fit: Some(2.0), edges, edge_faces: has_edges, vertex_normals, ..Options::default() };
    import_bytes(BOX.into(), "box.obj".as_ref(), &[], &options).expect("a box")
}

/// The pixels of the box, as red, green, blue and opacity, filled by what `shader` gives for a face and its light.
fn drawn<C, S>(model: &ImportedMesh, shader: impl Fn(usize, &Lambert) -> S) -> Vec<u8>
where
    C: Color + From<Rgb888> + Into<Rgb888>,
    S: SpanShader<C, Ink = C>,
{
    let mesh = model.mesh().expect("a mesh");
    placed(&mesh, |instance, light| {
        let mut canvas = Canvas::new(SIZE, C::from(Rgb888::BLACK));
        let mut depths = vec![0; PIXELS];
        let mut depth = DepthBuffer::new(canvas.bounding_box(), &mut depths).expect("depths");
        let mut cache = vec![ScreenVertex::EMPTY; mesh.vertices().len()];
        let Ok(_) = instance
            .faces(|face| shader(face, light))
            .cached(&mut cache)
            .draw(&mut canvas.depth_tested(&mut depth));
        shown(canvas.pixels())
    })
}

/// The box before the page's camera, and its light.
fn placed<R>(mesh: &Mesh<'_>, draw: impl FnOnce(&MeshInstance<'_>, &Lambert) -> R) -> R {
    let viewport = Viewport::new(Point::zero(), SIZE).expect("a viewport");
    let [field_of_view, yaw, pitch] = [40, 30, 20].map(Angle::degrees);
    let camera =
        Camera::framing(&mesh.bounding_sphere(), &viewport, field_of_view, yaw, pitch).expect("a camera");
    let turned = Affine::rotation_y(Angle::turns(7, 120));
    let light = Lambert::new(&turned, Vector3::from_ints(2, 3, 4), 48).expect("a light");
    draw(&camera.place(mesh, &turned), &light)
}

/// Red, green, blue and opacity of pixels.
fn shown<C: Copy + Into<Rgb888>>(pixels: &[C]) -> Vec<u8> {
    let colors = pixels.iter().map(|&color| color.into());
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
    let (flat, smooth, texels) = (model(false, false), model(true, false), checker::<C>());
    let mesh = smooth.mesh().expect("a mesh");
    let level = |face: usize, light: &Lambert| light.level(mesh.normals()[face]);
    let lit = |face: usize, light: &Lambert| {
        let normals = mesh.corners_of(face, mesh.vertex_normals());
        Gouraud::lit(of_16_bits(), normals.map(|normal| light.level(normal)))
    };
    let dithered = |face, light: &Lambert| Dithered(Flat::lit(of_16_bits(), level(face, light)));
    let coords = flat.texture().expect("coordinates").expect("coordinates");
    let texture = Texture::new(TexelSlice::new(&texels, 32, 32).expect("texels"));
    let texture = texture.with_exponent(coords.exponent()).expect("an exponent");
    let textured = |face: usize| texture.at(coords.corners(face));
    let check = |style: &str, expected: Vec<u8>| {
        assert!(page(&format!("format={format}&style={style}")) == expected, "{format}, {style}");
    };
    check("flat&dither=1", drawn::<C, _>(&flat, dithered));
    check("gouraud&dither=1", drawn::<C, _>(&smooth, |face, light| Dithered(lit(face, light))));
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

/// The box with smooth edges, as firmware draws it in bands of at most `rows` rows.
fn smooth_bands<S: SpanShader<Rgb565, Ink = Rgb565>>(
    model: &ImportedMesh,
    creases: usize,
    rows: u32,
    shader: impl Fn(usize, &Lambert) -> S,
) -> Vec<u8> {
    let mesh = model.mesh().expect("a mesh");
    let strip_bytes = |rows| Frame::<Rgb565>::strip_bytes(SIZE.width, rows);
    let (mut strip, mut kept) = (vec![0; strip_bytes(rows)], vec![0; strip_bytes(2)]);
    let mut depths = vec![0; (SIZE.width * rows) as usize];
    let mut cache = vec![ScreenVertex::EMPTY; mesh.vertices().len()];
    let (mut bins, mut edge_bins) = (vec![0; mesh.face_bins_len()], vec![0; mesh.smooth_bins_len()]);
    placed(&mesh, |instance, light| {
        let transformed = instance.transform_depth(&mut cache);
        let mut faces = transformed.bin_faces(&mut bins).expect("bins");
        let edges = transformed.bin_smooth_edges(|edge| edge < creases, &mut edge_bins);
        let (mut edges, mut canvas) = (edges.expect("bins"), Canvas::new(SIZE, Rgb565::BLACK));
        let area = Rectangle::new(Point::zero(), SIZE);
        let mut frame = SmoothFrame::new(area, Rgb565::BLACK, &mut kept, &mut depths).expect("rows");
        while let Some(mut band) = frame.next_band(&mut strip).expect("a strip") {
            let (mut pixels, mut depth) = band.new_rows();
            let Ok(()) = faces.draw(|face| shader(face, light), &mut pixels.depth_tested(&mut depth));
            let Ok(()) = band.smooth(|pass| edges.draw(pass)).send(&mut canvas);
        }
        shown(canvas.pixels())
    })
}

/// The box with smooth edges in a picture of few bits a pixel.
fn smooth_picture<C: Color + From<Rgb888> + Into<Rgb888>>(model: &ImportedMesh) -> Vec<u8> {
    let (mesh, mut pixels, mut depths) =
        (model.mesh().expect("a mesh"), vec![C::from(Rgb888::BLACK); PIXELS], vec![0; PIXELS]);
    let mut cache = vec![ScreenVertex::EMPTY; mesh.vertices().len()];
    let mut edge_bins = vec![0; mesh.smooth_bins_len()];
    let mut picture = Picture::new(&mut pixels, SIZE).expect("a picture");
    let mut depth = DepthBuffer::new(picture.bounding_box(), &mut depths).expect("depths");
    placed(&mesh, |instance, light| {
        let color = |face: usize| C::from(COLOR).dim(light.level(mesh.normals()[face]));
        let Ok(_) = instance.faces(color).draw(&mut picture.pixels().depth_tested(&mut depth));
        let is_crease = |edge| Some(edge) < model.creases;
        let transformed = instance.transform_depth(&mut cache);
        let mut edges = transformed.bin_smooth_edges(is_crease, &mut edge_bins).expect("bins");
        picture.pixels().depth_tested(&mut depth).smooth(|pass| edges.draw(pass));
    });
    shown(&pixels)
}

#[test]
fn smooth_edges_are_those_of_firmware_in_bands() {
    let (flat, smooth) = (model(false, true), model(true, true));
    let creases = flat.creases.expect("creases");
    assert_eq!(creases, 12, "the edges of the box, without the diagonals of its sides");
    let mesh = smooth.mesh().expect("a mesh");
    let level = |face: usize, light: &Lambert| light.level(mesh.normals()[face]);
    let lit = |face: usize, light: &Lambert| {
        let normals = mesh.corners_of(face, mesh.vertex_normals());
        Gouraud::lit(of_16_bits(), normals.map(|normal| light.level(normal)))
    };
    for rows in [6, 9, 33] {
        let bands =
            smooth_bands(&flat, creases, rows, |face, light| Rgb565::from(COLOR).dim(level(face, light)));
        assert!(page("style=flat&smooth-edges=1") == bands, "flat, {rows} rows");
        let dithered = |face: usize, light: &Lambert| Dithered(Flat::lit(of_16_bits(), level(face, light)));
        let bands = smooth_bands(&flat, creases, rows, dithered);
        assert!(page("style=flat&dither=1&smooth-edges=1") == bands, "dithered, {rows} rows");
        let bands = smooth_bands(&smooth, 0, rows, lit);
        assert!(page("style=gouraud&smooth-edges=1") == bands, "Gouraud, {rows} rows");
    }
    assert!(page("format=gray2&smooth-edges=1") == smooth_picture::<Gray2>(&flat), "Gray2");
    assert!(page("format=gray4&smooth-edges=1") == smooth_picture::<Gray4>(&flat), "Gray4");
    for sharp in ["format=mono", "format=tricolor", "style=wireframe"] {
        assert!(page(&format!("{sharp}&smooth-edges=1")) == page(sharp), "{sharp}");
    }
    for style in ["flat", "gouraud", "textured"] {
        let [sharp, smooth] = [0, 1].map(|is| page(&format!("style={style}&smooth-edges={is}")));
        assert!(sharp != smooth, "{style}");
    }
}
