//! Numbers at the ends of their ranges, as fuzzing found them: right, or refused, never wrong in silence.

mod bridge;
mod definition;
mod oracle;

use bridge::pair::{CameraBits, ModelBits, ProjectionBits, Step, ViewBits, ONE};
use bridge::{point, reals, rectangle, scalar, vector};
use definition::Family;
use pinhole::space::{Model, World};
use pinhole::{
    Affine, Camera, InverseError, Mesh, PlanarProjection, Projection, ProjectionError, Viewing, Viewport,
    Visibility,
};

/// far/(far − near) is 8·10⁵, and times the object's 2000 units from the eye that passes 2³⁰, where a row's
/// constant would saturate.
#[test]
fn a_vertex_beyond_near_is_there_however_thin_the_volume() {
    let camera = CameraBits {
        view: ViewBits::LookAlong([0; 3], [0, 0, -ONE], [0, ONE, 0]),
        projection: ProjectionBits::Perspective(1 << 30, (4, 3), 100 * ONE, 100 * ONE + 8),
        viewport: (0, 0, 40, 30),
    };
    let mesh = Mesh::new(&[[0, 0, 1850]], 0, &[]).expect("a mesh");
    let model = ModelBits(vec![Step::Move([0, 0, -2000 * ONE])]).library();
    assert!(camera.library().place(&mesh, &model).project(0).is_some());
}

/// The z row's constant, z_p·(1 + z_p/(Q·dz)), passes 2³⁰ for the one plane and not for the other.
#[test]
fn a_planar_image_lies_in_its_plane_or_there_is_none() {
    let general = |z_p: i32| {
        PlanarProjection::general(scalar(z_p * ONE), Some(scalar(-ONE / 2)), vector([-ONE, -ONE, -ONE]))
    };
    assert_eq!(general(20_304), Err(ProjectionError::OutOfRange));
    let image = general(17_000).expect("a plane").apply(point([-ONE / 2; 3])).expect("an image");
    assert!((reals(image)[2] - 17_000.0).abs() < 0.01, "{image:?}");
}

/// w(far) = far/d passes 2³⁰ for the one far plane and not for the other: all depths are scaled by it.
#[test]
fn depth_of_a_picture_on_a_plane_close_to_the_eye() {
    let far = Family::EyeAtOrigin(-1, [-2, 2, -2, 2], ONE, 32_767 * ONE);
    assert_eq!(far.library().err(), Some(ProjectionError::OutOfRange));
    let family = Family::EyeAtOrigin(-1, [-2, 2, -2, 2], ONE, 16_000 * ONE);
    let area = rectangle(0, 0, 40, 40);
    let view = Viewing::look_along(point([0; 3]), vector([0, 0, -ONE]), vector([0, ONE, 0]));
    let viewport = Viewport::new(area.top_left, area.size).expect("a viewport");
    let camera = Camera::new(&view.expect("a view"), &family.library().expect("a projection"), &viewport);
    let (_, depth) = camera.project(point([0, 0, -2 * ONE])).expect("seen");
    let wanted = family.picture().depth([0.0, 0.0, -2.0]);
    assert!((f64::from(depth) - wanted).abs() <= 1.0, "{depth} instead of {wanted}");
}

/// A mesh wider than ±32768 of its units has a sphere whose radius saturates, which stands for any.
#[test]
fn a_sphere_holds_all_vertices_of_the_widest_meshes() {
    let mesh = Mesh::new(&[[-32_767, 0, 0], [32_767, 0, 0]], 4, &[]).expect("a mesh");
    let model = Affine::<Model, World>::scale(scalar(ONE / 64));
    let camera = CameraBits {
        view: ViewBits::LookAlong([8191 * ONE, 0, 10 * ONE], [0, 0, -ONE], [0, ONE, 0]),
        projection: ProjectionBits::Perspective(1 << 30, (4, 3), ONE, 100 * ONE),
        viewport: (0, 0, 40, 30),
    }
    .library();
    let (p, _) = camera.place(&mesh, &model).project(1).expect("a place");
    assert!((0..40 * 256).contains(&p.x()) && (0..30 * 256).contains(&p.y()), "seen");
    assert_ne!(camera.visibility(&mesh.bounding_sphere(), &model), Visibility::Outside);
}

/// Two equal axes lie in a plane with any third. The rows' lengths differ by 2²⁶ here, so that a determinant of
/// rounded cofactors would pass for a volume.
#[test]
fn two_equal_axes_have_no_inverse() {
    let (a, b) = ([-1_073_741_823, -16, -8], [-33_554_432, 1, -14]);
    let frame = Affine::<Model, World>::from_frame(vector(a), vector(b), vector(a), point([0; 3]));
    assert_eq!(frame.inverse().map(|_| ()), Err(InverseError::Singular));
}

/// A mesh far from its own origin, brought back by a translation of 2.4 million units, under a matrix that
/// from_matrix scales up: a row's constant passes 2³⁰ and comes back.
#[test]
fn a_mesh_brought_back_from_afar_is_in_its_place() {
    let (turned, straight) = ([0.0, 0.0, -1.0, 0.0], [0.0, 1.0, 0.0, 0.0]);
    let last = [0.0, 0.0, 0.0, 1.0];
    let viewing = Viewing::from_matrix(&[[1.0, 0.0, 0.0, 0.0], turned, straight, last]).expect("a view");
    for factor in [1.0, 8.0, 10.0, 0.1, 1.01, 500.0] {
        let row = |axis: usize, c: f64| core::array::from_fn(|i| if i == axis { c } else { 0.0 });
        let scale = 8.0 * factor;
        let mut model = [row(0, scale), row(1, scale), row(2, scale), last];
        model[2][3] = 240.0 * 1024.0 * factor;
        let narrow = 1.0 / (1024.0 * factor);
        let matrix = [row(0, narrow), row(1, narrow), row(2, -0.5 * narrow), last];
        let projection = Projection::from_matrix(&matrix).expect("a projection");
        let area = rectangle(0, 0, 16, 16);
        let viewport = Viewport::new(area.top_left, area.size).expect("a viewport");
        let camera = Camera::new(&viewing, &projection, &viewport);
        // (±1, ±1, −240 ± 1) · 128
        let vertices = [[-1, -1, -241], [1, 1, -239], [0, 0, -240]];
        let vertices = vertices.map(|v: [i32; 3]| v.map(|c| scalar(c * 128 * ONE)));
        let mesh = Mesh::from_fixed(&vertices, &[]).expect("a mesh");
        let placed = camera.place(&mesh, &Affine::from_matrix(&model).expect("a model"));
        let found = [0, 1, 2].map(|i| placed.project(i).map(|(p, _)| (p.x(), p.y())));
        assert_eq!(found, [Some((0, 0)), Some((4096, 4096)), Some((2048, 2048))], "{factor}");
    }
}
