//! The robot: six joints, each in its parent, and the shapes that stand on them.
//!
//! ```text
//! turn ─ upper ─ fore ─ hand ─┬─ left finger
//!                             └─ right finger
//! ```

use pinhole::space::{Model, World};
use pinhole::{Affine, Angle, Hierarchy, Node, Point3, Scalar, Vector3};

/// Indices of the joints; parents come first.
const TURN: usize = 0;
const UPPER: usize = 1;
const FORE: usize = 2;
const HAND: usize = 3;
const LEFT: usize = 4;
const RIGHT: usize = 5;
const JOINTS: usize = 6;
/// Joints, then shapes.
const NODES: usize = JOINTS + SHAPES.len();

/// Which of the two meshes a shape shows.
#[derive(Clone, Copy)]
pub(crate) enum Form {
    Drum,
    Beam,
}

/// The colour of a shape.
#[derive(Clone, Copy)]
pub(crate) enum Paint {
    Steel,
    Orange,
    Rubber,
}

/// A mesh on a joint: its position, its half extents and, for a drum, whether its axis is z.
struct Shape {
    joint: usize,
    form: Form,
    paint: Paint,
    place: [f32; 3],
    half: [f32; 3],
    lying: bool,
}

const fn drum(joint: usize, paint: Paint, y: f32, radius: f32, half: f32, lying: bool) -> Shape {
    Shape { joint, form: Form::Drum, paint, place: [0.0, y, 0.0], half: [radius, half, radius], lying }
}

const fn beam(joint: usize, paint: Paint, place: [f32; 3], half: [f32; 3]) -> Shape {
    Shape { joint, form: Form::Beam, paint, place, half, lying: false }
}

/// Heights of the shoulder above the floor and lengths of the two links and the hand.
const SHOULDER: f32 = 1.0;
const UPPER_LENGTH: f32 = 1.7;
const FORE_LENGTH: f32 = 1.4;
const HAND_LENGTH: f32 = 0.45;
/// From the hand's end to the tips of the fingers.
const FINGER: f32 = 0.5;

const SHAPES: [Shape; 10] = [
    drum(TURN, Paint::Steel, 0.12, 0.75, 0.12, false),
    drum(TURN, Paint::Orange, 0.48, 0.42, 0.24, false),
    drum(UPPER, Paint::Steel, 0.0, 0.3, 0.34, true),
    beam(UPPER, Paint::Orange, [0.0, 0.872, 0.0], [0.13, 0.594, 0.15]),
    drum(FORE, Paint::Steel, 0.0, 0.25, 0.28, true),
    beam(FORE, Paint::Orange, [0.0, 0.737, 0.0], [0.1, 0.505, 0.11]),
    drum(HAND, Paint::Steel, 0.0, 0.17, 0.2, true),
    beam(HAND, Paint::Steel, [0.0, 0.31, 0.0], [0.14, 0.145, 0.4]),
    beam(LEFT, Paint::Rubber, [0.0, 0.25, 0.0], [0.1, 0.25, 0.06]),
    beam(RIGHT, Paint::Rubber, [0.0, 0.25, 0.0], [0.1, 0.25, 0.06]),
];

/// A shape in a frame.
pub(crate) struct Part {
    pub(crate) form: Form,
    pub(crate) paint: Paint,
    pub(crate) place: Affine<Model, World>,
    /// Whether the shape is the base: it stands on the floor, and no other shape is behind it.
    pub(crate) carries: bool,
}

fn shift(x: f32, y: f32, z: f32) -> Affine<Model, Model> {
    Affine::translation(Vector3::from_f32(x, y, z).expect("in range"))
}

/// An angle of `amplitude` degrees times the sine of `phase`.
fn swing(amplitude: i64, phase: Angle) -> Angle {
    let (sine, _) = phase.sin_cos(); // in 2⁻³⁰
    Angle::from_bits(((amplitude * i64::from(sine) * 4 / 360) & 0xffff_ffff) as u32)
}

/// Transforms of the joints relative to their parents at a phase of the cycle. They depend on the phase alone, so that no
/// error accumulates.
fn joints(phase: Angle) -> [Affine<Model, Model>; JOINTS] {
    let twice = phase + phase;
    // Down at both ends of the turn, up in between; the hand keeps upright.
    let dip = swing(16, twice - Angle::QUARTER_TURN);
    let upper = Angle::degrees(28) - dip;
    let fore = Angle::degrees(78) - dip;
    let hand = Angle::HALF_TURN - upper - fore;
    // The gripper is closed on the way out and open on the way back.
    let (sine, _) = phase.sin_cos();
    let open = 0.24 - 0.12 * (sine as f32 / (1 << 30) as f32);
    let bend = |angle: Angle| Affine::rotation_z(-angle);
    [
        Affine::rotation_y(swing(100, phase + Angle::QUARTER_TURN)),
        bend(upper).then(&shift(0.0, SHOULDER, 0.0)),
        bend(fore).then(&shift(0.0, UPPER_LENGTH, 0.0)),
        bend(hand).then(&shift(0.0, FORE_LENGTH, 0.0)),
        shift(0.0, HAND_LENGTH, open),
        shift(0.0, HAND_LENGTH, -open),
    ]
}

/// All nodes; a hierarchy needs parents before children.
pub(crate) fn nodes() -> [Node; NODES] {
    let [turn, upper, fore, hand, left, right] = joints(Angle::ZERO);
    let mut nodes = [Node::root(turn); NODES];
    let links = [(TURN, upper), (UPPER, fore), (FORE, hand), (HAND, left), (HAND, right)];
    for (node, (parent, local)) in nodes[1..].iter_mut().zip(links) {
        *node = Node::child(parent as u16, local);
    }
    for (node, shape) in nodes[JOINTS..].iter_mut().zip(&SHAPES) {
        let [across, up, deep] = shape.half.map(|v| Scalar::from_f32(v).expect("in range"));
        let sized = Affine::<Model, Model>::scale_axes(across, up, deep);
        let turned: Affine<Model, Model> =
            if shape.lying { Affine::rotation_x(Angle::QUARTER_TURN) } else { Affine::identity() };
        let [x, y, z] = shape.place;
        *node = Node::child(shape.joint as u16, sized.then(&turned).then(&shift(x, y, z)));
    }
    nodes
}

/// Moves the robot to a phase of its cycle.
pub(crate) fn pose(robot: &mut Hierarchy<'_>, phase: Angle) {
    for (joint, local) in joints(phase).into_iter().enumerate() {
        robot.set_local(joint, local);
    }
    robot.update();
}

/// The shapes of a frame, in drawing order.
pub(crate) fn parts<'r>(robot: &'r Hierarchy<'_>) -> impl Iterator<Item = Part> + 'r {
    let shapes = robot.nodes().iter().skip(JOINTS).zip(&SHAPES);
    shapes.map(|(node, shape)| Part {
        form: shape.form,
        paint: shape.paint,
        place: *node.world(),
        carries: shape.joint == TURN,
    })
}

/// The point between the tips of the fingers.
pub(crate) fn tip(robot: &Hierarchy<'_>) -> Point3<World> {
    let tip = Point3::from_f32(0.0, HAND_LENGTH + FINGER, 0.0).expect("in range");
    robot.world(HAND).map_or(Point3::from_ints(0, 0, 0), |hand| hand.apply(tip))
}
