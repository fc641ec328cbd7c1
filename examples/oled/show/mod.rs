//! The show: nine scenes of eight frames, each with another way to draw. Firmware and host share this code, so that tests can
//! compare every pixel.
#![allow(dead_code)] // firmware, host and test each take what they need

#[path = "../../../boards/rp2040-st7789/examples/balloon/scene.rs"]
#[allow(unreachable_pub)] // as a file of its own it is right
mod balloon;
mod dithered;
mod meshes;
mod screen;

pub(crate) use screen::{Display, Screen, SIZE};

use balloon::{Ink, MORNING, WAY};
use embedded_graphics::mono_font::{ascii::FONT_5X8, MonoTextStyle};
use embedded_graphics::pixelcolor::{Gray4, Gray8, Rgb888};
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use embedded_graphics::text::Text;
use heapless::Vec;
use meshes::{
    BALL, BALL_CORNERS, BALL_COUNT, LEFT_TIP, NOSE, RIGHT_TIP, RING, RING_CORNERS, SHIP, TEAPOT,
    TEAPOT_FACES, TEAPOT_VERTICES,
};
use pinhole::space::{Model, World};
use pinhole::{
    draw::{BinnedEdges, TransformedMesh},
    mesh::{Hierarchy, Node},
    prelude::*,
    Angle,
};

/// Frames of a scene.
pub(crate) const STEPS: u32 = 8;
pub(crate) const SCENES: [&str; 9] =
    ["wireframe", "hidden line", "flat", "Gouraud", "hierarchy", "dirty", "labels", "balloon", "one bit"];
pub(crate) const FRAMES: u32 = STEPS * SCENES.len() as u32;

/// The scene of a frame.
pub(crate) fn caption(frame: u32) -> &'static str {
    SCENES.get((frame / STEPS) as usize).copied().unwrap_or_default()
}

/// The memory of a frame, except for that of bands: the objects before the camera, and buffers that the library uses for
/// transformed vertices, bins and light levels. Every object has its own. It is zero at first, so it takes no flash.
pub(crate) struct Scratch {
    stage: Stage,
    teapot: ([ScreenVertex; TEAPOT_VERTICES], [u16; bin_storage_len(TEAPOT_FACES)], [u16; TEAPOT_VERTICES]),
    balls: [([ScreenVertex; BALL_CORNERS], [u16; bin_storage_len(BALL_COUNT)], [u16; BALL_CORNERS]); 3],
    rings: [([ScreenVertex; RING_CORNERS], [u16; bin_storage_len(RING_CORNERS)]); 2],
    ship: ([ScreenVertex; 8], [u16; bin_storage_len(12)], [u16; bin_storage_len(17)]),
    balloon: balloon::Buffers,
    greys: Vec<balloon::Scene<Gray4>, 1>,
    dithered: Vec<balloon::Scene<Gray8>, 1>,
}

/// The largest number of objects in a scene. Each takes 176 bytes, which are not on the stack.
type Stage = Vec<MeshInstance<'static>, 5>;

/// The nodes of the solar system: joints, which turn about the sun and the planet, then three balls and two orbits.
pub(crate) type SolarSystem = [Node; 7];

/// The nodes before they turn.
pub(crate) const SOLAR_SYSTEM: SolarSystem = [
    Node::root(Affine::identity()),
    Node::child(0, Affine::identity()),
    Node::root(Affine::identity()),
    Node::child(0, Affine::identity()),
    Node::child(1, Affine::identity()),
    Node::root(Affine::identity()),
    Node::child(0, Affine::identity()),
];

/// Length of the bin storage: an entry per face or edge, one for every 16 of them, and one for each bin.
const fn bin_storage_len(count: usize) -> usize {
    count + count.div_ceil(16) + 32
}

impl Scratch {
    pub(crate) const fn new() -> Self {
        Self {
            stage: Vec::new(),
            teapot: (
                [ScreenVertex::EMPTY; TEAPOT_VERTICES],
                [0; bin_storage_len(TEAPOT_FACES)],
                [0; TEAPOT_VERTICES],
            ),
            balls: [(
                [ScreenVertex::EMPTY; BALL_CORNERS],
                [0; bin_storage_len(BALL_COUNT)],
                [0; BALL_CORNERS],
            ); 3],
            rings: [([ScreenVertex::EMPTY; RING_CORNERS], [0; bin_storage_len(RING_CORNERS)]); 2],
            ship: ([ScreenVertex::EMPTY; 8], [0; bin_storage_len(12)], [0; bin_storage_len(17)]),
            balloon: balloon::Buffers::new(),
            greys: Vec::new(),
            dithered: Vec::new(),
        }
    }

    /// Draws any frame. The scenes are not inlined, because the stack would then hold the variables of all nine at once.
    pub(crate) fn draw<D: Display>(
        &mut self,
        frame: u32,
        nodes: &mut SolarSystem,
        screen: &mut Screen<'_, D>,
    ) -> Result<(), D::Error> {
        let step = (frame % STEPS) as i32;
        if step == 0 {
            screen.clear();
        }
        match frame / STEPS {
            0 => self.wireframe(step, screen),
            1 => self.hidden_line(step, screen),
            2 => self.flat(step, screen),
            3 => self.gouraud(step, screen),
            4 => self.hierarchy(step, nodes, screen),
            5 => self.dirty(step, screen),
            6 => self.labels(step, screen),
            7 => self.balloon(step, screen),
            _ => self.one_bit(step, screen),
        }
    }

    #[inline(never)]
    fn wireframe<D: Display>(&mut self, step: i32, screen: &mut Screen<'_, D>) -> Result<(), D::Error> {
        let (corners, _, bin_storage) = &mut self.ship;
        let instance = place_ship(&mut self.stage, &turning(step));
        let mut edges = edges(&instance.transform(corners), bin_storage);
        screen.mark(edges.bounds());
        screen.show(SCENES[0], |band, _| {
            let Ok(()) = edges.draw(Gray4::WHITE, band);
        })
    }

    #[inline(never)]
    fn hidden_line<D: Display>(&mut self, step: i32, screen: &mut Screen<'_, D>) -> Result<(), D::Error> {
        let (corners, face_bin_storage, edge_bin_storage) = &mut self.ship;
        let transformed = place_ship(&mut self.stage, &turning(step)).transform_depth(corners);
        let mut faces = faces(&transformed, face_bin_storage);
        let mut edges = edges(&transformed, edge_bin_storage);
        screen.mark(edges.bounds());
        screen.show(SCENES[1], |band, depth| {
            faces.depth_only(depth);
            let Ok(()) = edges.hidden_line(Gray4::WHITE, &mut band.depth_tested(depth));
        })
    }

    #[inline(never)]
    fn flat<D: Display>(&mut self, step: i32, screen: &mut Screen<'_, D>) -> Result<(), D::Error> {
        let (corners, bin_storage, _) = &mut self.ship;
        let model = turning(step);
        let light = light(&model, FROM_ABOVE);
        let instance = place_ship(&mut self.stage, &model);
        let mut faces = faces(&instance.transform_depth(corners), bin_storage);
        screen.mark(faces.bounds());
        screen.show(SCENES[2], |band, depth| {
            let Ok(()) = faces.draw(|face| ship_colour(&light, face), &mut band.depth_tested(depth));
        })
    }

    #[inline(never)]
    fn gouraud<D: Display>(&mut self, step: i32, screen: &mut Screen<'_, D>) -> Result<(), D::Error> {
        let (corners, bin_storage, levels) = &mut self.teapot;
        let turn = Affine::<Model, Model>::rotation_y(Angle::degrees(22 * step - 30));
        let model = turn.then(&Affine::translation(Vector3::from_ints(1, 0, 0)));
        light(&model, FROM_ABOVE).levels(TEAPOT.vertex_normals(), levels);
        let instance = place_one(&mut self.stage, &TEAPOT, &model, [0, 14, 38], 27);
        let mut faces = faces(&instance.transform_depth(corners), bin_storage);
        screen.mark(faces.bounds());
        screen.show(SCENES[3], |band, depth| {
            let shader = |face| Gouraud::lit(Rgb888::WHITE, TEAPOT.corners_of(face, levels)).dithered();
            let Ok(()) = faces.draw(shader, &mut band.depth_tested(depth));
        })
    }

    /// A sun, a planet, a moon, and their orbits.
    #[inline(never)]
    fn hierarchy<D: Display>(
        &mut self,
        step: i32,
        nodes: &mut SolarSystem,
        screen: &mut Screen<'_, D>,
    ) -> Result<(), D::Error> {
        let mut solar = Hierarchy::new(nodes).expect("parents first");
        turn(&mut solar, step);
        let [a, b, c, d, e] = [2, 3, 4, 5, 6].map(|node| solar.world(node).expect("one of seven"));
        let [sun, planet, moon] = &mut self.balls;
        shine([a, b, c], [&mut sun.2, &mut planet.2, &mut moon.2]);
        let objects = [(&BALL, a), (&BALL, b), (&BALL, c), (&RING, d), (&RING, e)];
        place(&mut self.stage, &objects, [0, 20, 46], 36);
        let [a, b, c, d, e] = self.stage.as_slice() else { return Ok(()) };
        let mut of_sun = faces(&a.transform_depth(&mut sun.0), &mut sun.1);
        let mut of_planet = faces(&b.transform_depth(&mut planet.0), &mut planet.1);
        let mut of_moon = faces(&c.transform_depth(&mut moon.0), &mut moon.1);
        let [far, near] = &mut self.rings;
        let mut far = edges(&d.transform_depth(&mut far.0), &mut far.1);
        let mut near = edges(&e.transform_depth(&mut near.0), &mut near.1);
        screen.mark(of_planet.bounds());
        screen.mark(of_moon.bounds());
        screen.mark(near.bounds());
        screen.show(SCENES[4], |band, depth| {
            let balls = [(&mut of_sun, &sun.2), (&mut of_planet, &planet.2), (&mut of_moon, &moon.2)];
            for (faces, levels) in balls {
                let shader = |face| Gouraud::lit(Rgb888::WHITE, BALL.corners_of(face, levels)).dithered();
                let Ok(()) = faces.draw(shader, &mut band.depth_tested(depth));
            }
            for (edges, grey) in [(&mut far, 4), (&mut near, 7)] {
                let Ok(()) = edges.draw(Gray4::new(grey), &mut band.depth_tested(depth));
            }
        })
    }

    /// A small ship in front of a large planet and stars. Only the ship moves, so only the area about it is drawn.
    #[inline(never)]
    fn dirty<D: Display>(&mut self, step: i32, screen: &mut Screen<'_, D>) -> Result<(), D::Error> {
        let (planet, model) = (planet(), flight(step));
        place(&mut self.stage, &[(&BALL, &planet), (&SHIP, &model)], [0, 0, 60], 36);
        let [ball, small] = self.stage.as_slice() else { return Ok(()) };

        let [(corners, bin_storage, levels), ..] = &mut self.balls;
        light(&planet, Vector3::from_ints(-4, 2, -1)).levels(BALL.vertex_normals(), levels);
        let mut ground = faces(&ball.transform_depth(corners), bin_storage);
        let (corners, bin_storage, _) = &mut self.ship;
        let sun = light(&model, Vector3::from_ints(-2, 4, 5));
        let mut ship = faces(&small.transform_depth(corners), bin_storage);
        screen.mark(ship.bounds());
        screen.show(SCENES[5], |band, depth| {
            for (i, &(x, y)) in STARS.iter().enumerate() {
                let grey = Gray4::new(5 + 3 * (i as u8 % 4));
                let Ok(()) = Pixel(Point::new(x, y), grey).draw(band);
            }
            let shader = |face| Gouraud::lit(Rgb888::WHITE, BALL.corners_of(face, levels)).dithered();
            let Ok(()) = ground.draw(shader, &mut band.depth_tested(depth));
            let Ok(()) = ship.draw(|face| ship_colour(&sun, face), &mut band.depth_tested(depth));
        })
    }

    /// Labels at vertices of a solid.
    #[inline(never)]
    fn labels<D: Display>(&mut self, step: i32, screen: &mut Screen<'_, D>) -> Result<(), D::Error> {
        let (corners, face_bin_storage, edge_bin_storage) = &mut self.ship;
        let model = turning(step);
        let light = light(&model, FROM_ABOVE);
        let instance = place_ship(&mut self.stage, &model);
        let transformed = instance.transform_depth(corners);
        let mut faces = faces(&transformed, face_bin_storage);
        let mut edges = edges(&transformed, edge_bin_storage);
        let style = MonoTextStyle::new(&FONT_5X8, Gray4::WHITE);
        let names = [(NOSE, "nose"), (LEFT_TIP, "port"), (RIGHT_TIP, "starboard")];
        let names = names.map(|(vertex, name)| {
            let at = instance.project(vertex).map_or(Point::zero(), Point::from);
            // Next to the point, and inside the picture.
            let width = 5 * name.len() as i32;
            let x = if at.x < SIZE.width as i32 / 2 { at.x - width - 1 } else { at.x + 3 };
            let x = x.clamp(0, SIZE.width as i32 - width);
            Text::new(name, Point::new(x, at.y.clamp(8, 60)), style)
        });
        screen.mark(edges.bounds());
        names.iter().for_each(|name| screen.mark(name.bounding_box()));
        screen.show(SCENES[6], |band, depth| {
            let Ok(()) = faces.draw(|face| ship_colour(&light, face).dim(150), &mut band.depth_tested(depth));
            let Ok(()) = edges.hidden_line(Gray4::new(10), &mut band.depth_tested(depth));
            for name in &names {
                let Ok(_) = name.draw(band);
            }
        })
    }

    /// A balloon over misty fields, in 16 greys.
    #[inline(never)]
    fn balloon<D: Display>(&mut self, step: i32, screen: &mut Screen<'_, D>) -> Result<(), D::Error> {
        let scene = stay(&mut self.greys, &MORNING);
        let mut frame = scene.frame(way(step), &mut self.balloon);
        let frame = frame.as_mut().expect("buffers for all of it");
        screen.mark(CHANGES);
        screen.show_on_bright(MORNING.mist.into(), SCENES[7], |band, depth| {
            let Ok(()) = frame.draw(depth, band);
        })
    }

    /// The balloon in black and white.
    #[inline(never)]
    fn one_bit<D: Display>(&mut self, step: i32, screen: &mut Screen<'_, D>) -> Result<(), D::Error> {
        let scene = stay(&mut self.dithered, &PRINT);
        let mut frame = scene.frame(way(step), &mut self.balloon);
        let frame = frame.as_mut().expect("buffers for all of it");
        screen.mark(CHANGES);
        screen.show_dithered(PRINT.mist.into(), SCENES[8], |greys, depth| {
            let Ok(()) = frame.draw(depth, greys);
        })
    }
}

/// Without firmware there is something to look at, too.
pub(crate) const fn teapot() -> &'static Mesh<'static> {
    const MESH: &Mesh<'static> = &TEAPOT;
    MESH
}

const FROM_ABOVE: Vector3<World> = Vector3::from_ints(-4, 4, 3);

/// The balloon's colours in black and white, which dither well: all fades into white.
const PRINT: balloon::Colors = {
    const fn gray(level: u8) -> Rgb888 {
        Rgb888::new(level, level, level)
    }
    balloon::Colors {
        mist: gray(255),
        fields: [gray(24), gray(150), gray(236), gray(255)],
        tree: [gray(40), gray(0), gray(0)],
        balloon: [gray(0), gray(255), gray(96), gray(0)],
        shadow: gray(0),
    }
};

/// Where something moves in the balloon's scene: in whole rows, all but the sky above it.
const CHANGES: Rectangle = Rectangle::new(Point::new(0, 1), Size::new(SIZE.width, SIZE.height - 1));

/// How far the balloon has come: three world units a step.
fn way(step: i32) -> i32 {
    step * (3 * 32) % WAY
}

/// The balloon's scene, made when it is first needed. Not inlined: what makes it leaves the stack.
#[inline(never)]
fn stay<'s, C: Ink>(
    scene: &'s mut Vec<balloon::Scene<C>, 1>,
    colors: &balloon::Colors,
) -> &'s balloon::Scene<C> {
    if let (true, Ok(made)) = (scene.is_empty(), balloon::Scene::new(SIZE, colors)) {
        let _ = scene.push(made); // there is room for one
    }
    scene.first().expect("a scene")
}

const STARS: [(i32, i32); 12] = [
    (5, 9),
    (14, 41),
    (23, 22),
    (31, 52),
    (38, 5),
    (47, 34),
    (55, 15),
    (66, 46),
    (76, 6),
    (90, 3),
    (112, 5),
    (121, 18),
];

/// Bins the faces and edges. Not inlined, like the functions below: their variables leave the stack.
#[inline(never)]
fn faces<'a, const DEPTH: bool>(
    transformed: &TransformedMesh<'a, i16, DEPTH>,
    bin_storage: &'a mut [u16],
) -> BinnedFaces<'a, i16, DEPTH> {
    transformed.bin_faces(bin_storage).expect("storage for all faces")
}

#[inline(never)]
fn edges<'a, const DEPTH: bool>(
    transformed: &TransformedMesh<'a, i16, DEPTH>,
    bin_storage: &'a mut [u16],
) -> BinnedEdges<'a, i16, DEPTH> {
    transformed.bin_edges(bin_storage).expect("storage for all edges")
}

/// Turns the joints of the solar system; the shapes keep their sizes.
#[inline(never)]
fn turn(solar: &mut Hierarchy<'_>, step: i32) {
    let year = Angle::degrees(60 - 24 * step);
    let month = Angle::degrees(75 * step);
    let out = |distance: i16| Affine::<Model, Model>::translation(Vector3::from_ints(distance, 0, 0));
    solar.set_local(0, out(18).then(&Affine::rotation_y(year)));
    solar.set_local(1, out(7).then(&Affine::rotation_y(month)));
    for (node, radius) in [(2, 8), (3, 4), (4, 2), (5, 18), (6, 7)] {
        solar.set_local(node, Affine::scale(Scalar::from_int(radius)));
    }
    solar.update();
}

/// Light levels at the vertices of the sun, the planet and the moon.
#[inline(never)]
fn shine([sun, planet, moon]: [&Affine<Model, World>; 3], levels: [&mut [u16; BALL_CORNERS]; 3]) {
    let [of_sun, of_planet, of_moon] = levels;
    for (ball, levels) in [(planet, of_planet), (moon, of_moon)] {
        let here = ball.apply(Point3::from_ints(0, 0, 0));
        let towards_sun = Vector3::new(-here.x(), -here.y(), -here.z());
        light(ball, towards_sun).levels(BALL.vertex_normals(), levels);
    }
    // The sun is bright, and brightest towards the eye.
    let glow = Lambert::new(sun, Vector3::from_ints(0, 20, 46), 150).expect("a direction");
    glow.levels(BALL.vertex_normals(), of_sun);
}

fn light(model: &Affine<Model, World>, towards: Vector3<World>) -> Lambert {
    Lambert::new(model, towards, 24).expect("a direction")
}

/// A camera at a point of the world that looks at its origin, with a vertical field of view in degrees.
#[inline(never)]
fn camera([x, y, z]: [i16; 3], degrees: i32) -> Camera {
    let eye = Point3::from_ints(x, y, z);
    let viewing = ViewTransform::look_at(eye, Point3::from_ints(0, 0, 0), Vector3::from_ints(0, 1, 0))
        .expect("a direction");
    let (near, far) = (Scalar::from_int(2), Scalar::from_int(200));
    let projection =
        Projection::perspective(Angle::degrees(degrees), SIZE, near, far).expect("a field of view");
    let viewport = Viewport::new(Point::zero(), SIZE).expect("a picture");
    Camera::new(&viewing, &projection, &viewport)
}

fn turning(step: i32) -> Affine<Model, World> {
    let roll = Affine::<Model, Model>::rotation_z(Angle::degrees(10 * step - 25));
    roll.then(&Affine::rotation_y(Angle::degrees(18 * step - 75)))
}

/// Position of the large planet.
#[inline(never)]
fn planet() -> Affine<Model, World> {
    Affine::<Model, Model>::scale(Scalar::from_int(16))
        .then(&Affine::translation(Vector3::from_ints(22, -4, 0)))
}

/// Transform of the ship, which flies past the planet.
#[inline(never)]
fn flight(step: i32) -> Affine<Model, World> {
    Affine::<Model, Model>::scale(Scalar::from_ratio(7, 10))
        .then::<Model>(&Affine::rotation_z(Angle::degrees(40 * step)))
        .then::<Model>(&Affine::rotation_y(Angle::degrees(105)))
        .then(&Affine::translation(Vector3::from_ints(-30 + 8 * step as i16, 8 - step as i16, 20)))
}

/// Places objects before a camera. Not inlined: the camera leaves the stack.
#[inline(never)]
fn place(stage: &mut Stage, objects: &[Object<'_>], eye: [i16; 3], degrees: i32) {
    show_to(&camera(eye, degrees), objects, stage);
}

#[inline(never)]
fn show_to(camera: &Camera, objects: &[Object<'_>], stage: &mut Stage) {
    stage.clear();
    for (mesh, model) in objects {
        let _ = stage.push(camera.place(mesh, model)); // no scene has more than there is room for
    }
}

/// A mesh and its transform.
type Object<'a> = (&'static Mesh<'static>, &'a Affine<Model, World>);

fn place_one<'s>(
    stage: &'s mut Stage,
    mesh: &'static Mesh<'static>,
    model: &Affine<Model, World>,
    eye: [i16; 3],
    degrees: i32,
) -> &'s MeshInstance<'static> {
    place(stage, &[(mesh, model)], eye, degrees);
    stage.first().expect("one")
}

fn place_ship<'s>(stage: &'s mut Stage, model: &Affine<Model, World>) -> &'s MeshInstance<'static> {
    place_one(stage, &SHIP, model, [0, 12, 26], 34)
}

fn ship_colour(light: &Lambert, face: usize) -> Gray4 {
    SHIP.normals().get(face).map_or(Gray4::BLACK, |&normal| Gray4::WHITE.dim(light.level(normal)))
}
