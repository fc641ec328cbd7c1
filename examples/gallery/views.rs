//! Every named projection, with the house in a position that suits it.

use embedded_graphics::geometry::Size;
use pinhole::space::World;
use pinhole::{camera::Window, math::MathError, prelude::*, Angle};
use std::error::Error;

/// A cell of the sheet.
pub(crate) struct View {
    pub(crate) name: &'static str,
    /// Two lines of parameters.
    pub(crate) details: [&'static str; 2],
    pub(crate) viewing: ViewTransform,
    pub(crate) projection: Projection,
}

fn number(v: f32) -> Scalar {
    Scalar::from_f32(v).expect("in range")
}

/// A square window centred on the axis.
fn square(half: f32) -> Window {
    window(-half, half, -half, half)
}

fn window(left: f32, right: f32, bottom: f32, top: f32) -> Window {
    Window { left: number(left), right: number(right), bottom: number(bottom), top: number(top) }
}

fn point<S>([x, y, z]: [f32; 3]) -> Result<Point3<S>, MathError> {
    Point3::from_f32(x, y, z)
}

/// The view from a reference point along a normal, upright.
fn from(at: [f32; 3], [x, y, z]: [i16; 3]) -> Result<ViewTransform, Box<dyn Error>> {
    let up = Vector3::from_ints(0, 1, 0);
    Ok(ViewTransform::from_reference(point(at)?, Vector3::from_ints(x, y, z), up)?)
}

/// The centre of the house, which is the reference point of the parallel views.
const MIDDLE: [f32; 3] = [0.5, 0.75, -0.5];
/// Half the window of the parallel views. All have one scale, 64 px per unit.
const HALF: f32 = 1.25;

/// All views, in the order of the sheet.
pub(crate) fn all(picture: Size) -> Result<Vec<View>, Box<dyn Error>> {
    let middle: Point3<World> = point(MIDDLE)?;
    let (near, far) = (number(-2.0), number(2.0));
    let parallel = Projection::orthographic(square(HALF), near, far)?;
    let slanted = |degrees, factor| {
        Projection::oblique(square(HALF), near, far, Angle::degrees(degrees), number(factor))
    };
    // As many vanishing points as the VPN has components.
    let lens = |fov| Projection::perspective(Angle::degrees(fov), picture, number(0.25), number(8.0));
    // A shift lens: seen from above, but with an upright view plane, so that verticals stay vertical.
    let shifted = Projection::frustum(window(-0.9, 0.9, -1.4, 0.4), number(0.8), number(8.0))?;
    // The view plane is z = 0 of view space, through the middle of the house.
    let planar = |distance, x, y, z| {
        let direction = Vector3::from_ints(x, y, z);
        Projection::planar(Scalar::ZERO, distance, direction, square(1.5), number(-1.0), number(2.0))
    };
    let near_eye = planar(Some(number(3.0)), 1, 1, 2)?;
    // From above at 45°: the plan keeps its shape, and verticals their length.
    let far_eye = planar(None, 0, -1, 1)?;
    let plan =
        ViewTransform::from_reference(middle, Vector3::from_ints(0, 1, 0), Vector3::from_ints(-1, 0, -2))?;
    // By reference point and window. Front and back at n = 0.5 and −4.
    let (front, back, ten) = (number(0.5), number(-4.0), Point3::from_ints(0, 0, 10));
    let volume = |prp, window| Projection::perspective_from_reference(prp, window, front, back);
    let near_prp = volume(point([0.5, 0.5, 1.0])?, window(-1.0, 3.0, -1.0, 3.0))?;
    let wide = volume(ten, window(-10.0, 20.0, -10.0, 20.0))?;
    let closer = volume(ten, window(-1.0, 2.0, -1.0, 2.0))?;
    let in_parallel = Projection::parallel_from_reference(ten, square(2.0), front, back)?;
    let corner = from([2.0, 0.5, 0.0], [1, 0, 1])?;
    // The projectors meet behind the house, so that distant parts are larger and opposite walls are visible at once:
    // w = 1 + z/2 over view z, 3/2 one unit before the middle of the house and 1/2 one unit behind it, where z/w is −1 and +1.
    let reverse = Projection::from_matrix(&[
        [0.75, 0.0, 0.0, 0.0],
        [0.0, 0.75, 0.0, 0.0],
        [0.0, 0.0, -1.0, -0.5],
        [0.0, 0.0, 0.5, 1.0],
    ])?;
    let side = |vpn| from(MIDDLE, vpn);
    // Seen from above, up is away from the viewer; from below, towards the viewer.
    let level =
        |y| ViewTransform::from_reference(middle, Vector3::from_ints(0, y, 0), Vector3::from_ints(0, 0, -y));
    let front = side([0, 0, 1])?;
    let isometric = ViewTransform::isometric(middle);
    let (dimetric, trimetric) = (side([2, 1, 2])?, side([1, 2, 3])?);

    let multiview = "multiview, orthographic";
    let views = [
        ("front", [multiview, "VPN (0,0,1)"], front, parallel),
        ("back", [multiview, "VPN (0,0,-1)"], side([0, 0, -1])?, parallel),
        ("top", [multiview, "VPN (0,1,0)"], level(1)?, parallel),
        ("bottom", [multiview, "VPN (0,-1,0)"], level(-1)?, parallel),
        ("left", [multiview, "VPN (-1,0,0)"], side([-1, 0, 0])?, parallel),
        ("right", [multiview, "VPN (1,0,0)"], side([1, 0, 0])?, parallel),
        ("isometric", ["VPN (1,1,1)", "x, y, z: 0.82"], isometric, parallel),
        ("dimetric", ["VPN (2,1,2)", "x, z: 0.75; y: 0.94"], dimetric, parallel),
        ("trimetric", ["VPN (1,2,3)", "x: 0.96; y: 0.85; z: 0.60"], trimetric, parallel),
        ("cavalier", ["oblique, angle 45°, factor 1", "VPN (0,0,1)"], front, slanted(45, 1.0)?),
        ("cabinet", ["oblique, angle 45°, factor 0.5", "VPN (0,0,1)"], front, slanted(45, 0.5)?),
        ("oblique 60°", ["angle 60°, factor 0.75", "VPN (0,0,1)"], front, slanted(60, 0.75)?),
        (
            "one-point",
            ["VPN (0,0,1), field of view 100°", "eye (1.5, 1, 1.5)"],
            from([1.5, 1.0, 1.5], [0, 0, 1])?,
            lens(100)?,
        ),
        (
            "two-point",
            ["VPN (4,0,5), field of view 105°", "eye (1.5, 0.65, 0.8)"],
            from([1.5, 0.65, 0.8], [4, 0, 5])?,
            lens(105)?,
        ),
        (
            "three-point",
            ["VPN (5,5,6), field of view 120°", "eye (1.3, 1.6, 0.5)"],
            from([1.3, 1.6, 0.5], [5, 5, 6])?,
            lens(120)?,
        ),
        (
            "off-axis frustum",
            ["near 0.8: -0.9..0.9 x -1.4..0.4", "VPN (1,0,2), eye (1.6, 2, 1.5)"],
            from([1.6, 2.0, 1.5], [1, 0, 2])?,
            shifted,
        ),
        ("general planar", ["z_p 0, Q 3, direction (1,1,2)", "VPN (0,0,1)"], front, near_eye),
        (
            "general planar, parallel",
            ["z_p 0, Q infinite, dir (0,-1,1)", "VPN (0,1,0): the plan is true"],
            plan,
            far_eye,
        ),
        (
            "PRP, window: one-point",
            ["VRP 0, VPN (0,0,1)", "PRP (.5,.5,1), window -1..3"],
            from([0.0; 3], [0, 0, 1])?,
            near_prp,
        ),
        (
            "PRP, window: two-point",
            ["VRP (2,.5,0), VPN (1,0,1)", "PRP (0,0,10), window -10..20"],
            corner,
            wide,
        ),
        ("PRP, window: closer", ["VRP (2,.5,0), VPN (1,0,1)", "PRP (0,0,10), window -1..2"], corner, closer),
        (
            "PRP, window: parallel",
            ["VRP (1,.5,0), VPN (0,0,1)", "PRP (0,0,10), window -2..2"],
            from([1.0, 0.5, 0.0], [0, 0, 1])?,
            in_parallel,
        ),
        (
            "from_matrix: reverse",
            ["w = 1 + z/2: far is large", "VPN (0,1,6)"],
            from(MIDDLE, [0, 1, 6])?,
            reverse,
        ),
    ];
    let view = |(name, details, viewing, projection)| View { name, details, viewing, projection };
    Ok(views.into_iter().map(view).collect())
}
