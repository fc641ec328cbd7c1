//! The films to send: the spinning cube S2 of the benchmarks, and a small moving cube before one that stands still.

use embedded_graphics::geometry::{Point, Size};
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::prelude::*;
use pinhole::space::{Model, World};
use pinhole::{
    Affine, Angle, Band, BinnedFaces, Camera, Dim, Lambert, Mesh, MeshInstance, PixelFormat, Point3,
    Projection, Scalar, ScreenVertex, Vector3, ViewTransform, Viewport,
};

/// The cube of ±1.
const VERTICES: [[i16; 3]; 8] =
    [[-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1], [-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1]];
const FACES: [[u16; 3]; 12] = [
    [0, 1, 2],
    [0, 2, 3],
    [5, 4, 7],
    [5, 7, 6],
    [3, 2, 6],
    [3, 6, 7],
    [4, 5, 1],
    [4, 1, 0],
    [1, 5, 6],
    [1, 6, 2],
    [4, 0, 3],
    [4, 3, 7],
];
/// The colour of each pair of faces.
const NORMALS: [[i16; 3]; 6] =
    [[0, 0, 32767], [0, 0, -32767], [0, 32767, 0], [0, -32767, 0], [32767, 0, 0], [-32767, 0, 0]];
/// The orientation of the cube of S2.
const ROTATION: [[f64; 4]; 4] = [
    [0.7986355, 0.0, 0.601815, 0.0],
    [0.282535, 0.8829476, -0.3749367, 0.0],
    [-0.5313711, 0.4694716, 0.7051533, 0.0],
    [0.0, 0.0, 0.0, 1.0],
];
const DISTANCE: f32 = 4.1022;
const LIGHT: (f32, f32, f32) = (0.3999502, 0.5999253, 0.6929137);

pub const BACKGROUND: Rgb888 = Rgb888::new(16, 16, 32);

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Film {
    /// The cube spins about an axis of the world, with this many frames per turn.
    Cube { axis: [i16; 3], turn: u32 },
    /// The cube stands still, and a small cube flies a figure eight before it.
    Small,
}

/// The number of frames of a film.
pub const FRAMES: u32 = 72;

/// An object of a frame.
pub struct Thing {
    instance: MeshInstance<'static>,
    light: Lambert,
    colour: Rgb888,
    pub moves: bool,
}

fn camera(size: Size) -> Camera {
    let number = |v| Scalar::from_f32(v).expect("in range");
    let eye = Point3::from_f32(0.0, 0.0, DISTANCE).expect("in range");
    let along = (Vector3::from_ints(0, 0, -1), Vector3::from_ints(0, 1, 0));
    Camera::new(
        &ViewTransform::look_along(eye, along.0, along.1).expect("a view"),
        &Projection::perspective(Angle::degrees(60), size, number(0.5), number(20.0)).expect("a projection"),
        &Viewport::new(Point::zero(), size).expect("a viewport"),
    )
}

impl Film {
    /// The objects of a frame, the farther ones first.
    pub fn frame(self, size: Size, frame: u32) -> Vec<Thing> {
        let camera = camera(size);
        const MESH: &Mesh<'static> = &match Mesh::new(&VERTICES, 0, &FACES) {
            Ok(mesh) => mesh,
            Err(_) => panic!(),
        };
        let thing = |model: Affine<Model, World>, colour, moves| Thing {
            instance: camera.place(MESH, &model),
            light: {
                let (x, y, z) = LIGHT;
                let towards = Vector3::from_f32(x, y, z).expect("in range");
                Lambert::new(&model, towards, 40).expect("a light")
            },
            colour,
            moves,
        };
        let stands = Affine::from_matrix(&ROTATION).expect("a rotation");
        let (green, red) = (Rgb888::new(90, 220, 140), Rgb888::new(250, 90, 60));
        match self {
            Film::Cube { axis: [x, y, z], turn } => {
                let angle = Angle::turns(frame as i32, turn);
                let spin = Affine::rotation(Point3::from_ints(0, 0, 0), Vector3::from_ints(x, y, z), angle);
                vec![thing(stands.then(&spin.expect("an axis")), green, true)]
            }
            Film::Small => {
                let turn = |number: i32| Angle::turns(number * frame as i32, FRAMES);
                let sine = |angle: Angle| f64::from(angle.sin_cos().0) / f64::from(1 << 30);
                let place = [1.1 * sine(turn(1)), 0.8 * sine(turn(2)), 2.0];
                let mut matrix = [[0.0; 4]; 4];
                for (i, row) in matrix.iter_mut().enumerate().take(3) {
                    row[i] = 0.1;
                    row[3] = place[i];
                }
                matrix[3][3] = 1.0;
                let fly = Affine::<World, World>::from_matrix(&matrix).expect("a place");
                let small = Affine::<Model, World>::rotation_x(turn(3)).then(&fly);
                vec![thing(stands, green, false), thing(small, red, true)]
            }
        }
    }
}

impl Thing {
    fn colour<C: Dim + From<Rgb888>>(&self, face: usize) -> C {
        C::from(self.colour).dim(self.light.level(NORMALS[face / 2]))
    }

    /// Draws the object at once, onto any target.
    pub fn draw<D: DrawTarget<Color: Dim + From<Rgb888>>>(&self, target: &mut D) -> Result<(), D::Error> {
        self.instance.solid(|face| self.colour::<D::Color>(face), &mut [], target).map(|_| ())
    }
}

/// Memory for the vertices and faces of an object: a number for each face, and one for every 16.
type Store = ([ScreenVertex; VERTICES.len()], [u16; FACES.len() + 1]);

/// Memory for the objects of a frame.
#[derive(Default)]
pub struct Memory(Vec<Store>);

/// An object that is binned for bands.
pub struct Recorded<'a> {
    pub thing: &'a Thing,
    pub faces: BinnedFaces<'a>,
}

impl Memory {
    pub fn record<'a>(&'a mut self, things: &'a [Thing]) -> Vec<Recorded<'a>> {
        self.0.resize(things.len(), ([ScreenVertex::EMPTY; VERTICES.len()], [0; FACES.len() + 1]));
        let record = |(thing, (corners, bin_storage)): (&'a Thing, &'a mut Store)| {
            let faces = thing.instance.transform(corners).bin_faces(bin_storage).expect("room for all faces");
            Recorded { thing, faces }
        };
        things.iter().zip(&mut self.0).map(record).collect()
    }
}

impl Recorded<'_> {
    pub fn draw<C: PixelFormat + Dim + From<Rgb888>>(&mut self, band: &mut Band<'_, C>) {
        let Ok(()) = self.faces.solid(|face| self.thing.colour::<C>(face), band);
    }
}
