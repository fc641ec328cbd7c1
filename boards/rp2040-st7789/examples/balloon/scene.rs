//! A balloon drifts over fields in the mist, among trees: textures in perspective, light and fog by rows of palettes, which cost no
//! instruction a pixel, sprites, and a shadow by a screen door. It is drawn in any colour type, into any target, and needs no file but this one.

use embedded_graphics_core::geometry::{AnchorPoint, Point, Size};
use embedded_graphics_core::pixelcolor::Rgb888;
use pinhole::meshes::{CUBE, SPHERE};
use pinhole::space::{Model, World};
use pinhole::{
    fog::{Fog, VertexFog},
    prelude::*,
    sprite::{PlacedSprites, SpriteSource},
    texture::{IndexedTexels, LitPalette, Textured},
    Angle,
};

/// The way after which everything looks as before, in 1/32 world units: trees repeat after 48 units, fields after 16.
pub const WAY: i32 = 48 * 32;

/// What can be drawn in.
pub trait Ink: Color + From<Rgb888> {}
impl<C: Color + From<Rgb888>> Ink for C {}

/// The colours of the scene.
#[derive(Clone, Copy)]
pub struct Colors {
    /// The sky, and what everything fades into.
    pub mist: Rgb888,
    /// Soil, meadow, wheat, paths.
    pub fields: [Rgb888; 4],
    /// Of trees in the light, in the shade, and of trunks.
    pub tree: [Rgb888; 3],
    /// The gores of the balloon by turns, its belt, and the basket, in full light.
    pub balloon: [Rgb888; 4],
    pub shadow: Rgb888,
}

/// The colours of a morning.
pub const MORNING: Colors = Colors {
    mist: Rgb888::new(206, 214, 222),
    fields: [
        Rgb888::new(112, 82, 56),
        Rgb888::new(92, 138, 62),
        Rgb888::new(206, 176, 84),
        Rgb888::new(222, 206, 170),
    ],
    tree: [Rgb888::new(52, 112, 66), Rgb888::new(26, 72, 52), Rgb888::new(84, 58, 40)],
    balloon: [
        Rgb888::new(226, 54, 44),
        Rgb888::new(250, 236, 206),
        Rgb888::new(30, 74, 140),
        Rgb888::new(150, 104, 60),
    ],
    shadow: Rgb888::new(38, 46, 30),
};

const NO_MESH: &str = "a list of the scene does not fit its mesh";

/// Half of the ground's width, in world units.
const HALF_WIDTH: i16 = 128;
/// The ground in strips across the view, each in one level of fog, from behind the eye to where nothing but mist is seen.
const STRIPS: usize = 24;
/// Their depth.
const STRIP: i16 = 6;
const NEAR_EDGE: i16 = 36;

const GROUND: Mesh<'static> = {
    // The left and the right end of each edge between strips, from the nearest on.
    const ENDS: [[i16; 3]; 2 * STRIPS + 2] = {
        let mut ends = [[0; 3]; 2 * STRIPS + 2];
        let mut at = 0;
        while at < ends.len() {
            let side = if at % 2 == 0 { -HALF_WIDTH } else { HALF_WIDTH };
            ends[at] = [side, 0, NEAR_EDGE - STRIP * (at / 2) as i16];
            at += 1;
        }
        ends
    };
    const FACES: [[u16; 3]; 2 * STRIPS] = {
        let mut faces = [[0; 3]; 2 * STRIPS];
        let mut at = 0;
        while at < STRIPS {
            let left = 2 * at as u16;
            faces[2 * at] = [left, left + 1, left + 3];
            faces[2 * at + 1] = [left, left + 3, left + 2];
            at += 1;
        }
        faces
    };
    match Mesh::new(&ENDS, 0, &FACES) {
        Ok(mesh) => mesh,
        Err(_) => panic!("faces"),
    }
};
/// A disc of radius 1.
const SHADOW: Mesh<'static> = {
    const R: i16 = 64;
    const H: i16 = 45; // R/√2
    const RIM: [[i16; 3]; 8] =
        [[R, 0, 0], [H, 0, -H], [0, 0, -R], [-H, 0, -H], [-R, 0, 0], [-H, 0, H], [0, 0, R], [H, 0, H]];
    match Mesh::new(&RIM, -6, &[[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5], [0, 5, 6], [0, 6, 7]]) {
        Ok(mesh) => mesh,
        Err(_) => panic!("faces"),
    }
};
const CANOPY: Mesh<'static> = SPHERE;
const BASKET: Mesh<'static> = CUBE;
/// A tree at each vertex, far ones first.
const TREES: Mesh<'static> = match Mesh::new(&TREE_POINTS, 0, &[]) {
    Ok(mesh) => mesh,
    Err(_) => panic!("vertices"),
};

/// Seven trees, four times, one behind the other.
static TREE_POINTS: [[i16; 3]; 28] = {
    const GROUP: [[i16; 3]; 7] =
        [[30, 0, -46], [-19, 0, -39], [12, 0, -32], [-44, 0, -26], [-10, 0, -18], [21, 0, -11], [-25, 0, -4]];
    let mut points = [[0; 3]; 28];
    let mut at = 0;
    while at < 28 {
        let [x, y, z] = GROUP[at % 7];
        points[at] = [x, y, z - 48 * (2 - (at / 7) as i16)];
        at += 1;
    }
    points
};

/// Packs a picture of `W` columns, two bits a texel.
macro_rules! picture {
    ($width:literal, $height:literal, |$column:ident, $row:ident| $texel:expr) => {{
        let mut bytes = [0u8; $width * $height / 4];
        let mut at = 0;
        while at < $width * $height {
            let ($column, $row) = (at % $width, at / $width);
            let texel: u8 = $texel;
            bytes[at / 4] |= texel << (6 - 2 * (at % 4));
            at += 1;
        }
        bytes
    }};
}

/// Four fields between paths: ploughed along the way, wheat, a meadow, ploughed across. A texel is half a world unit.
static FIELDS: [u8; 256] = picture!(32, 32, |column, row| match (row / 16, column / 16) {
    _ if row % 16 == 0 || column % 16 == 0 => 3,
    (0, 0) => (column / 2 % 2) as u8,
    (0, _) => 2 + ((7 * row + 3 * column) % 11 == 0) as u8,
    (_, 0) => (row / 2 % 2) as u8 + 1,
    _ => ((5 * row + 11 * column) % 13 != 0) as u8,
});

/// Two gores of the balloon, with a belt of zigzags.
static CLOTH: [u8; 64] = picture!(8, 32, |column, row| {
    let from_middle = if column < 4 { 3 - column } else { column - 4 };
    let low = 11 + 2 * from_middle;
    match row {
        _ if row >= low && row < low + 4 => 2,
        _ => (column / 4) as u8,
    }
});
/// The basket's, of one colour.
static WICKER: [u8; 16] = [0xff; 16];

/// What stays from frame to frame.
pub struct Scene<C> {
    camera: Camera,
    fog: Fog,
    mist: C,
    /// From nothing but mist to none.
    fields: LitPalette<C, 4, 32>,
    balloon: LitPalette<C, 4, 16>,
    tree: [C; 3],
    shadow: C,
}

/// The memory of a frame: zeros at first, so that a static takes no flash.
pub struct Buffers {
    placed: [Slot<MeshInstance<'static>>; 4],
    trees: Slot<PlacedSprites<'static>>,
    ground: MeshBuffers!(GROUND),
    shadow: MeshBuffers!(SHADOW),
    canopy: MeshBuffers!(CANOPY),
    basket: MeshBuffers!(BASKET),
}

/// An `Option` that is zeros when it is empty.
#[repr(u8)]
enum Slot<T> {
    Empty,
    Full(T),
}

impl<T> Slot<T> {
    fn put(&mut self, value: T) -> Result<&T, &'static str> {
        *self = Self::Full(value);
        match self {
            Self::Full(value) => Ok(value),
            Self::Empty => Err("an empty slot"),
        }
    }
}

impl Buffers {
    #[allow(clippy::new_without_default)]
    pub const fn new() -> Self {
        Self {
            placed: [Slot::Empty, Slot::Empty, Slot::Empty, Slot::Empty],
            trees: Slot::Empty,
            ground: mesh_buffers!(GROUND),
            shadow: mesh_buffers!(SHADOW),
            canopy: mesh_buffers!(CANOPY),
            basket: mesh_buffers!(BASKET),
        }
    }
}

/// Where everything is: the balloon sways and turns.
struct Poses {
    shadow: Affine<Model, World>,
    canopy: Affine<Model, World>,
    basket: Affine<Model, World>,
    trees: Affine<Model, World>,
}

/// Of the light and the fog on things.
struct Levels {
    light: Lambert,
    ground: VertexFog,
    trees: VertexFog,
}

/// A frame, which draws itself band by band.
pub struct Frame<'a, C> {
    scene: &'a Scene<C>,
    levels: Levels,
    /// Of each [`Body`].
    textures: [Texture<IndexedTexels<'a, C, 2>>; 3],
    /// How far the fields have come, in units of their texture.
    passed: i16,
    bodies: [BinnedFaces<'a, i16, true>; 3],
    shadow: BinnedFaces<'a, i16, true>,
    trees: &'a PlacedSprites<'static>,
}

impl<C: Ink> Scene<C> {
    /// The scene on a screen of this size.
    #[inline(never)] // set-up: its variables leave the stack
    pub fn new(size: Size, colors: &Colors) -> Result<Self, &'static str> {
        let eye = Point3::from_ints(0, 7, 34);
        let view = ViewTransform::look_at(eye, Point3::from_ints(0, 0, 0), Vector3::from_ints(0, 1, 0));
        let [near, far] = [2, 200].map(Scalar::from_int);
        let lens = Projection::perspective(Angle::degrees(50), size, near, far);
        let viewport = Viewport::new(Point::zero(), size).map_err(|_| "the screen has no pixels")?;
        let (Ok(view), Ok(lens)) = (view, lens) else { return Err("no camera") };
        let camera = Camera::new(&view, &lens, &viewport);
        let fog = Fog::new(Scalar::from_int(20), Scalar::from_int(112)).map_err(|_| "no fog")?;
        Ok(Self {
            camera,
            fog,
            mist: colors.mist.into(),
            fields: LitPalette::in_fog(&colors.fields, colors.mist),
            balloon: LitPalette::new(&colors.balloon),
            tree: colors.tree.map(C::from),
            shadow: colors.shadow.into(),
        })
    }

    /// The frame at a part of the [`WAY`].
    #[inline(never)] // its variables leave the stack
    pub fn frame<'a>(&'a self, way: i32, buffers: &'a mut Buffers) -> Result<Frame<'a, C>, &'static str> {
        let Buffers { placed: [a, b, c, d], trees, ground, shadow, canopy, basket } = buffers;
        let poses = Poses::at(way % WAY);
        let texture = |bytes, width, height, palette| match IndexedTexels::new(bytes, width, height, palette)
        {
            Ok(texels) => Ok(Texture::new(texels)),
            Err(_) => Err("a picture of the scene is too short"),
        };
        let dark = self.balloon.row(0);
        let camera = &self.camera;
        Ok(Frame {
            scene: self,
            levels: self.levels(&poses)?,
            textures: [
                texture(FIELDS.as_slice(), 32, 32, self.fields.row(0))?,
                texture(&CLOTH, 8, 32, dark)?,
                texture(&WICKER, 8, 8, dark)?,
            ],
            passed: (way % WAY) as i16,
            bodies: [
                bin(place(a, camera, &GROUND, &Affine::identity())?, &mut ground.cache, &mut ground.bins)?,
                bin(place(b, camera, &CANOPY, &poses.canopy)?, &mut canopy.cache, &mut canopy.bins)?,
                bin(place(c, camera, &BASKET, &poses.basket)?, &mut basket.cache, &mut basket.bins)?,
            ],
            shadow: bin(place(d, camera, &SHADOW, &poses.shadow)?, &mut shadow.cache, &mut shadow.bins)?,
            trees: trees.put(camera.place_sprites(&TREES, &poses.trees))?,
        })
    }

    #[inline(never)] // its variables leave the stack
    fn levels(&self, poses: &Poses) -> Result<Levels, &'static str> {
        let fog = |model: &Affine<Model, World>| VertexFog::new(&self.fog, &self.camera, model, 0);
        Ok(Levels {
            light: Lambert::new(&poses.canopy, Vector3::from_ints(-3, 3, 2), 96).map_err(|_| "no light")?,
            ground: fog(&Affine::identity()),
            trees: fog(&poses.trees),
        })
    }
}

impl Poses {
    #[inline(never)] // its variables leave the stack
    fn at(way: i32) -> Self {
        let turn = Angle::turns(way, WAY as u32);
        let [x, y] = [turn, turn + turn].map(Angle::sin);
        let tenths = |tenths: i32| Scalar::from_bits((tenths << 16) / 10);
        let balloon = |height: Scalar, width: i32, tall: i32| {
            let [width, tall] = [width, tall].map(tenths);
            let at = Vector3::new(x * Scalar::from_int(5), height, Scalar::from_int(13));
            Affine::scale_axes(width, tall, width).rotate_y(turn).translate(at)
        };
        let height = tenths(70) + y;
        Self {
            shadow: balloon(tenths(1), 31, 10),
            canopy: balloon(height, 31, 35),
            basket: balloon(height - tenths(46), 6, 6),
            trees: Affine::translation(Vector3::new(
                Scalar::ZERO,
                Scalar::ZERO,
                Scalar::from_bits(way << 11),
            )),
        }
    }
}

/// Not inlined: an instance leaves the stack.
#[inline(never)]
fn place<'p>(
    slot: &'p mut Slot<MeshInstance<'static>>,
    camera: &Camera,
    mesh: &'static Mesh<'static>,
    model: &Affine<Model, World>,
) -> Result<&'p MeshInstance<'static>, &'static str> {
    slot.put(camera.place(mesh, model))
}

/// Not inlined: its variables leave the stack.
#[inline(never)]
fn bin<'a>(
    instance: &'a MeshInstance<'static>,
    cache: &'a mut [ScreenVertex],
    bins: &'a mut [u16],
) -> Result<BinnedFaces<'a, i16, true>, &'static str> {
    instance.transform_depth(cache).bin_faces(bins).map_err(|_| NO_MESH)
}

/// The parts of the scene that have a texture.
#[derive(Clone, Copy)]
enum Body {
    Ground,
    Canopy,
    Basket,
}

impl<'a, C: Ink> Frame<'a, C> {
    /// Draws what lies in a target, whose background is the mist.
    pub fn draw<T: Surface<Color = C>>(
        &mut self,
        depth: &mut DepthBuffer<'_>,
        target: &mut T,
    ) -> Result<(), T::Error> {
        let Self { scene, levels, textures, passed, bodies, shadow, trees } = self;
        // One loop and one type of closure, so that the code that draws textured faces is linked once.
        let names = [Body::Ground, Body::Canopy, Body::Basket];
        for ((faces, texture), body) in bodies.iter_mut().zip(*textures).zip(names) {
            faces.draw(shader(scene, levels, texture, body, *passed), &mut target.depth_tested(depth))?;
        }
        shadow.draw(|_| ScreenDoor::new(scene.shadow, 40), &mut target.depth_tested(depth))?;
        let tree = |vertex: usize| {
            let factor = TREE_POINTS.get(vertex).map_or(0, |&point| levels.trees.factor(point));
            let tree = Sprite::new(Tree(scene.tree.map(|color| color.over(scene.mist, factor))));
            tree.with_height(Scalar::from_int(9)).with_anchor(AnchorPoint::BottomCenter)
        };
        trees.draw(tree, &mut target.depth_tested(depth))?;
        Ok(())
    }
}

/// The shaders of a body's faces: its texture at their corners, in a palette for their fog or light.
fn shader<'a, 'l, C: Ink>(
    scene: &'a Scene<C>,
    levels: &'l Levels,
    texture: Texture<IndexedTexels<'a, C, 2>>,
    body: Body,
    passed: i16,
) -> impl Fn(usize) -> Textured<IndexedTexels<'a, C, 2>> + use<'a, 'l, C> {
    let lit = move |mesh: &Mesh<'_>, face: usize| {
        let level = mesh.normals().get(face).map_or(256, |&normal| levels.light.level(normal));
        scene.balloon.row(level)
    };
    move |face| {
        let (palette, corners) = match body {
            Body::Ground => {
                // Both faces of a strip have the fog of the strip's far left end.
                let end = GROUND.vertices().get(face / 2 * 2 + 2).copied().unwrap_or_default();
                (scene.fields.row(levels.ground.factor(end)), field_corners(face, passed))
            }
            Body::Canopy => (lit(&CANOPY, face), cloth_corners(face)),
            Body::Basket => (lit(&BASKET, face), [[0; 2]; 3]),
        };
        texture.with_palette(palette).at(corners)
    }
}

/// Texture coordinates of the ground, in 1/16 texel: 32 for a world unit.
fn field_corners(face: usize, passed: i16) -> [[i16; 2]; 3] {
    let corners = GROUND.faces().get(face).copied().unwrap_or_default();
    corners.map(|vertex| {
        let [x, _, z] = GROUND.vertices().get(usize::from(vertex)).copied().unwrap_or_default();
        [32 * x, 32 * z - passed]
    })
}

/// Texture coordinates of the balloon, in 1/16 texel: 4 texels for each of the 16 columns of the sphere and each of the 8 rows from pole to pole.
fn cloth_corners(face: usize) -> [[i16; 2]; 3] {
    // 14 faces to a column; the vertices are 7 rings of 16 from the lowest on, and the poles.
    let column = (face / 14) as i16;
    let corners = CANOPY.faces().get(face).copied().unwrap_or_default();
    corners.map(|vertex| match vertex as i16 {
        112 => [64 * column + 32, 8 * 64],
        113 => [64 * column + 32, 0],
        // A column's right side is the next one's left, and of the last one that of the first.
        vertex => [64 * (column + i16::from(vertex % 16 != column)), 64 * (7 - vertex / 16)],
    })
}

/// A conifer of 15 × 24 texels in the light from the left.
struct Tree<C>([C; 3]);

impl<C: Ink> SpriteSource for Tree<C> {
    type Color = C;
    type Ink = Option<C>;

    fn picture_size(&self) -> Size {
        Size::new(15, 24)
    }

    fn texel_at(&self, column: u32, row: u32) -> Option<C> {
        let Self([light, dark, trunk]) = *self;
        let away = column.abs_diff(7);
        // Three skirts of branches, each wider than the one above.
        let (top, reach) = match row {
            0..7 => (0, 1),
            7..14 => (7, 3),
            14..21 => (14, 4),
            _ => return (away <= 1).then_some(trunk),
        };
        let is_lit = column + (row - top) / 3 < 7;
        (away <= reach + (row - top) / 2).then_some(if is_lit { light } else { dark })
    }
}
