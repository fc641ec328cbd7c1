//! Every named projection, with the house in a position that suits it.

use embedded_graphics::geometry::Size;
use pinhole::space::{View as ViewSpace, World};
use pinhole::{
    Angle, NumberError, PlanarProjection, Point3, Projection, ReferenceVolume, Scalar, Side, Vector3,
    ViewTransform, Window,
};
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

/// The centre of the house, which is the reference point of the parallel views.
fn middle() -> Result<Point3<World>, NumberError> {
    Point3::from_f32(0.5, 0.75, -0.5)
}

/// Half the window of the parallel views. All have one scale, 64 px per unit.
const HALF: f32 = 1.25;

type Views = Result<Vec<View>, Box<dyn Error>>;

/// All views, in the order of the sheet.
pub(crate) fn all(picture: Size) -> Views {
    let mut views = multiview()?;
    views.extend(axonometric()?);
    views.extend(oblique()?);
    views.extend(points(picture)?);
    views.extend(shifted()?);
    views.extend(planar()?);
    views.extend(reference()?);
    views.push(matrix()?);
    Ok(views)
}

fn multiview() -> Views {
    let projection = Projection::orthographic(square(HALF), number(-2.0), number(2.0))?;
    let sides = [
        ("front", Side::Front, "VPN (0,0,1)"),
        ("back", Side::Back, "VPN (0,0,-1)"),
        ("top", Side::Top, "VPN (0,1,0)"),
        ("bottom", Side::Bottom, "VPN (0,-1,0)"),
        ("left", Side::Left, "VPN (-1,0,0)"),
        ("right", Side::Right, "VPN (1,0,0)"),
    ];
    let mut views = Vec::new();
    for (name, side, vpn) in sides {
        let viewing = ViewTransform::multiview(middle()?, side);
        views.push(View { name, details: ["multiview, orthographic", vpn], viewing, projection });
    }
    Ok(views)
}

fn axonometric() -> Views {
    let projection = Projection::orthographic(square(HALF), number(-2.0), number(2.0))?;
    Ok(vec![
        View {
            name: "isometric",
            details: ["VPN (1,1,1)", "x, y, z: 0.82"],
            viewing: ViewTransform::isometric(middle()?),
            projection,
        },
        View {
            name: "dimetric",
            details: ["VPN (2,1,2)", "x, z: 0.75; y: 0.94"],
            viewing: ViewTransform::dimetric(middle()?, number(2.0), number(1.0))?,
            projection,
        },
        View {
            name: "trimetric",
            details: ["VPN (1,2,3)", "x: 0.96; y: 0.85; z: 0.60"],
            viewing: ViewTransform::trimetric(middle()?, Vector3::from_ints(1, 2, 3))?,
            projection,
        },
    ])
}

fn oblique() -> Views {
    let viewing = ViewTransform::multiview(middle()?, Side::Front);
    let kinds = [
        ("cavalier", ["oblique, angle 45°, factor 1", "VPN (0,0,1)"], 45, 1.0),
        ("cabinet", ["oblique, angle 45°, factor 0.5", "VPN (0,0,1)"], 45, 0.5),
        ("oblique 60°", ["angle 60°, factor 0.75", "VPN (0,0,1)"], 60, 0.75),
    ];
    let mut views = Vec::new();
    for (name, details, angle, factor) in kinds {
        let angle = Angle::degrees(angle);
        let projection = Projection::oblique(square(HALF), number(-2.0), number(2.0), angle, number(factor))?;
        views.push(View { name, details, viewing, projection });
    }
    Ok(views)
}

/// Perspectives by field of view: as many vanishing points as the VPN has components.
fn points(picture: Size) -> Views {
    let up = Vector3::from_ints(0, 1, 0);
    let lens = |fov: i32| Projection::perspective(Angle::degrees(fov), picture, number(0.25), number(8.0));
    Ok(vec![
        View {
            name: "one-point",
            details: ["VPN (0,0,1), field of view 100°", "eye (1.5, 1, 1.5)"],
            viewing: ViewTransform::from_reference(
                Point3::from_f32(1.5, 1.0, 1.5)?,
                Vector3::from_ints(0, 0, 1),
                up,
            )?,
            projection: lens(100)?,
        },
        View {
            name: "two-point",
            details: ["VPN (4,0,5), field of view 105°", "eye (1.5, 0.65, 0.8)"],
            viewing: ViewTransform::from_reference(
                Point3::from_f32(1.5, 0.65, 0.8)?,
                Vector3::from_ints(4, 0, 5),
                up,
            )?,
            projection: lens(105)?,
        },
        View {
            name: "three-point",
            details: ["VPN (5,5,6), field of view 120°", "eye (1.3, 1.6, 0.5)"],
            viewing: ViewTransform::from_reference(
                Point3::from_f32(1.3, 1.6, 0.5)?,
                Vector3::from_ints(5, 5, 6),
                up,
            )?,
            projection: lens(120)?,
        },
    ])
}

/// A shift lens: seen from above, but with an upright view plane, so that verticals stay vertical.
fn shifted() -> Views {
    Ok(vec![View {
        name: "off-axis frustum",
        details: ["near 0.8: -0.9..0.9 x -1.4..0.4", "VPN (1,0,2), eye (1.6, 2, 1.5)"],
        viewing: ViewTransform::from_reference(
            Point3::from_f32(1.6, 2.0, 1.5)?,
            Vector3::from_ints(1, 0, 2),
            Vector3::from_ints(0, 1, 0),
        )?,
        projection: Projection::frustum(window(-0.9, 0.9, -1.4, 0.4), number(0.8), number(8.0))?,
    }])
}

fn planar() -> Views {
    // The view plane is z = 0 of view space, through the middle of the house.
    let near_eye = PlanarProjection::general(
        Scalar::ZERO,
        Some(number(3.0)),
        Vector3::<ViewSpace>::from_f32(1.0, 1.0, 2.0)?,
    )?;
    // From above at 45°: the plan keeps its shape, and verticals their length.
    let far_eye = PlanarProjection::general(Scalar::ZERO, None, Vector3::<ViewSpace>::from_ints(0, -1, 1))?;
    let seen = |planar: &PlanarProjection, half: f32| {
        Projection::from_planar(planar, square(half), number(-1.0), number(2.0))
    };
    Ok(vec![
        View {
            name: "general planar",
            details: ["z_p 0, Q 3, direction (1,1,2)", "VPN (0,0,1)"],
            viewing: ViewTransform::multiview(middle()?, Side::Front),
            projection: seen(&near_eye, 1.5)?,
        },
        View {
            name: "general planar, parallel",
            details: ["z_p 0, Q infinite, dir (0,-1,1)", "VPN (0,1,0): the plan is true"],
            viewing: ViewTransform::from_reference(
                middle()?,
                Vector3::from_ints(0, 1, 0),
                Vector3::from_ints(-1, 0, -2),
            )?,
            projection: seen(&far_eye, 1.5)?,
        },
    ])
}

/// By reference point and window. Front and back at n = 0.5 and −4.
fn reference() -> Views {
    let up = Vector3::from_ints(0, 1, 0);
    let (front, back) = (number(0.5), number(-4.0));
    let ten = Point3::from_ints(0, 0, 10);
    let perspective = |prp, window| {
        Ok::<_, Box<dyn Error>>(Projection::from_reference(&ReferenceVolume::perspective(
            prp, window, front, back,
        )?))
    };
    let corner =
        ViewTransform::from_reference(Point3::from_f32(2.0, 0.5, 0.0)?, Vector3::from_ints(1, 0, 1), up)?;
    Ok(vec![
        View {
            name: "PRP, window: one-point",
            details: ["VRP 0, VPN (0,0,1)", "PRP (.5,.5,1), window -1..3"],
            viewing: ViewTransform::from_reference(
                Point3::from_ints(0, 0, 0),
                Vector3::from_ints(0, 0, 1),
                up,
            )?,
            projection: perspective(Point3::from_f32(0.5, 0.5, 1.0)?, window(-1.0, 3.0, -1.0, 3.0))?,
        },
        View {
            name: "PRP, window: two-point",
            details: ["VRP (2,.5,0), VPN (1,0,1)", "PRP (0,0,10), window -10..20"],
            viewing: corner,
            projection: perspective(ten, window(-10.0, 20.0, -10.0, 20.0))?,
        },
        View {
            name: "PRP, window: closer",
            details: ["VRP (2,.5,0), VPN (1,0,1)", "PRP (0,0,10), window -1..2"],
            viewing: corner,
            projection: perspective(ten, window(-1.0, 2.0, -1.0, 2.0))?,
        },
        View {
            name: "PRP, window: parallel",
            details: ["VRP (1,.5,0), VPN (0,0,1)", "PRP (0,0,10), window -2..2"],
            viewing: ViewTransform::from_reference(
                Point3::from_f32(1.0, 0.5, 0.0)?,
                Vector3::from_ints(0, 0, 1),
                up,
            )?,
            projection: Projection::from_reference(&ReferenceVolume::parallel(
                ten,
                square(2.0),
                front,
                back,
            )?),
        },
    ])
}

/// A projection from a matrix: the projectors meet behind the house, so that distant parts are larger and opposite walls are
/// visible at once.
fn matrix() -> Result<View, Box<dyn Error>> {
    // w = 1 + z/2 over view z: 3/2 one unit before the middle of the house and 1/2 one unit behind it, where z/w
    // is −1 and +1.
    let scale = 0.75;
    Ok(View {
        name: "from_matrix: reverse",
        details: ["w = 1 + z/2: far is large", "VPN (0,1,6)"],
        viewing: ViewTransform::from_reference(
            middle()?,
            Vector3::from_ints(0, 1, 6),
            Vector3::from_ints(0, 1, 0),
        )?,
        projection: Projection::from_matrix(&[
            [scale, 0.0, 0.0, 0.0],
            [0.0, scale, 0.0, 0.0],
            [0.0, 0.0, -1.0, -0.5],
            [0.0, 0.0, 0.5, 1.0],
        ])?,
    })
}
