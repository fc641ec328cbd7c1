//! A flight over fields, among trees: a texture in perspective, and sprites.

use embedded_graphics::geometry::AnchorPoint;
use embedded_graphics::pixelcolor::Gray4;
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use pinhole::space::{Model, World};
use pinhole::{Affine, Angle, Mesh, Scalar, Sprite, SpriteSource, Texture, Textured, Vector3};

/// Where something moves: all but the sky.
pub(super) const CHANGES: Rectangle = Rectangle::new(Point::new(0, 4), Size::new(128, 60));
/// Of the ground, in world units.
const HALF_SIDE: i16 = 96;
/// World units by which the view moves on in a step. The picture of the fields repeats after 16 units.
const SPEED: i16 = 3;

pub(super) const GROUND: Mesh<'static> = {
    const S: i16 = HALF_SIDE;
    let Ok(mesh) = Mesh::new(&[[-S, 0, S], [S, 0, S], [S, 0, -S], [-S, 0, -S]], 0, &[[0, 1, 2], [0, 2, 3]])
    else {
        panic!()
    };
    mesh
};
/// A tree at each vertex, far ones first.
pub(super) const TREES: Mesh<'static> = {
    let Ok(mesh) = Mesh::new(&TREE_POINTS, 0, &[]) else { panic!() };
    mesh
};
const TREE_POINTS: [[i16; 3]; 14] = [
    [30, 0, -84],
    [-52, 0, -78],
    [9, 0, -70],
    [-24, 0, -61],
    [42, 0, -55],
    [-9, 0, -49],
    [21, 0, -40],
    [-38, 0, -34],
    [13, 0, -26],
    [-15, 0, -21],
    [31, 0, -15],
    [-27, 0, -8],
    [10, 0, -3],
    [-11, 0, 6],
];

/// Fields with a light edge, one in two of them ploughed.
static FIELDS: [[Gray4; 16]; 16] = {
    let mut texels = [[Gray4::new(2); 16]; 16];
    let mut row = 0;
    while row < 16 {
        let mut column = 0;
        while column < 16 {
            let (ploughed, edge) = ((row < 8) == (column < 8), row % 8 == 0 || column % 8 == 0);
            texels[row][column] = Gray4::new(match (edge, ploughed, column % 2) {
                (true, ..) => 6,
                (_, true, 0) => 1,
                (_, true, _) => 3,
                _ => 2,
            });
            column += 1;
        }
        row += 1;
    }
    texels
};

/// The shader of a face of the ground, by its vertices.
pub(super) fn fields(step: i32) -> impl Fn(usize) -> Textured<&'static [[Gray4; 16]; 16]> + Clone {
    let texture = Texture::new(&FIELDS);
    // A texel is a world unit, and 16 units of its coordinates.
    let (side, on) = (32 * HALF_SIDE, -16 * SPEED * step as i16);
    let coords = [[0, side + on], [side, side + on], [side, on], [0, on]];
    move |face| texture.at(GROUND.corners_of(face, &coords))
}

/// How far the trees have come.
pub(super) fn passed(step: i32) -> Affine<Model, World> {
    Affine::translation(Vector3::from_ints(0, 0, SPEED * step as i16))
}

pub(super) fn tree() -> Sprite<Tree> {
    Sprite::new(Tree).with_height(Scalar::const_from_int(9)).with_anchor(AnchorPoint::BottomCenter)
}

/// The ship, which rolls from side to side above the fields.
pub(super) fn ship(step: i32) -> Affine<Model, World> {
    let sway = Angle::degrees(45 * step).sin();
    let roll = Angle::degrees(24 * ((step + 1) % 4 - 2).abs() - 24);
    Affine::<Model, Model>::scale(Scalar::from_num(0.4))
        .then::<Model>(&Affine::rotation_z(roll))
        .then::<Model>(&Affine::rotation_y(Angle::degrees(180)))
        .then(&Affine::translation(Vector3::new(
            sway.saturating_mul(Scalar::const_from_int(4)),
            Scalar::const_from_int(8),
            Scalar::const_from_int(14),
        )))
}

/// A conifer of 15 × 24 texels, lit from the left.
#[derive(Clone, Copy)]
pub(super) struct Tree;

impl SpriteSource for Tree {
    type Color = Gray4;

    fn picture_size(&self) -> Size {
        Size::new(15, 24)
    }

    fn color_at(&self, column: u32, row: u32) -> Option<Gray4> {
        let away = column.abs_diff(7);
        match row {
            // Two skirts of branches.
            0..=8 if away <= row / 2 + 1 => {}
            9..=19 if away <= (row - 7) / 2 + 1 => {}
            20.. if away <= 1 => return Some(Gray4::new(4)),
            _ => return None,
        }
        Some(Gray4::new(if column < 7 { 13 } else { 9 }))
    }
}
