//! Reference pictures and coordinates in files: a cube, solid and as a wireframe, by the library and by the oracles (the exact corners
//! snapped, then exact coverage and exact lines), in perspective, in orthographic projection, and by the worked set-ups of docs/spec.md,
//! section 4, viewing by PRP and window. `GOLDEN=1 cargo test --test golden` writes the files anew.

use pinhole::prelude::*;
use pinhole::space::{Model, World};
use std::collections::BTreeSet;
use support::bridge::draw::{self, solid, wireframe, Shader, CUBE_EDGES, CUBE_FACES};
use support::bridge::pair::{window, CameraBits, ModelBits, ProjectionBits, Step, ViewBits, ONE};
use support::bridge::{point, reals, rectangle, scalar};
use support::definition::{Family, Projectors};
use support::oracle::chain::{snap, vertex, Viewport};
use support::oracle::coverage::{covers, edge, Area};
use support::oracle::line;
use support::oracle::target::Recorder;

struct Picture {
    camera: Camera,
    model: Affine<Model, World>,
    vertices: [[i16; 3]; 8],
    /// The vertices on the screen, by the oracle.
    exact: Vec<(f64, f64)>,
    size: (u32, u32),
    /// Of the sides, each of two faces.
    letters: &'static [u8; 6],
}

impl Picture {
    fn letter(&self, face: usize) -> char {
        char::from(self.letters[face / 2 % 6])
    }

    /// Solid and wireframe as the oracles draw them, after the library has drawn the same.
    fn as_the_oracle(&self) -> [String; 2] {
        let exact = self.oracle();
        let mesh = Mesh::new(&self.vertices, 0, &CUBE_FACES)
            .and_then(|m| m.with_edges(&CUBE_EDGES))
            .expect("a mesh");
        let instance = self.camera.place(&mesh, &self.model);
        let (width, height) = self.size;
        let (mut lines, mut faces) = (Recorder::sized(width, height), Recorder::sized(width, height));
        wireframe(&instance, &mut lines).expect("no error");
        solid(&instance, &mut faces).expect("no error");
        let mut painted = Recorder::sized(width, height);
        let mut painter = Painter::<Shader, 8, 12>::new();
        instance.faces(|face| Shader(face as u16)).sorted(&mut painter).expect("room");
        painter.draw(&mut painted).expect("no error");
        let by_letter = |target: &Recorder<Shader>| {
            target.picture(width as i32, height as i32, |Shader(face)| self.letter(usize::from(face)))
        };
        let drawn = lines.picture(width as i32, height as i32, |_| '#');
        for (drawn, exact) in
            [(by_letter(&faces), &exact[0]), (by_letter(&painted), &exact[0]), (drawn, &exact[1])]
        {
            assert!(drawn == *exact, "drawn\n{drawn}\nexpected\n{exact}");
        }
        exact
    }

    fn oracle(&self) -> [String; 2] {
        let at: Vec<(i64, i64)> = self.exact.iter().copied().map(snap).collect();
        let corners = CUBE_FACES.iter().map(|face| face.map(|i| at[usize::from(i)])).enumerate();
        // Counter-clockwise with y up: negative with y down.
        let front: Vec<_> = corners.filter(|(_, t)| edge(t[0], t[1], t[2]) < 0).collect();
        let area = Area::new(0, 0, self.size.0.into(), self.size.1.into());
        let mut lines = BTreeSet::new();
        for ends in CUBE_EDGES {
            let [a, b] = ends.map(|i| at[usize::from(i)]).map(|(x, y)| (x >> 8, y >> 8));
            lines.extend(line::clipped(a, b, area));
        }
        let (mut pictures, mut row) = ([String::new(), String::new()], 0);
        for (x, y) in area.pixels() {
            if y != row {
                pictures.iter_mut().for_each(|picture| picture.push('\n'));
                row = y;
            }
            let mut here = front.iter().filter(|(_, t)| covers(*t, x, y));
            pictures[0].push(here.next().map_or('.', |(i, _)| self.letter(*i)));
            assert!(here.next().is_none());
            pictures[1].push(if lines.contains(&(x, y)) { '#' } else { '.' });
        }
        pictures.map(|picture| picture + "\n")
    }
}

const TERMINAL: (u32, u32) = (44, 22);

/// The camera looks down at the cube, which has been turned about y and x. Sides: +x, −x, +y, −y, +z, −z.
fn cube(projection: ProjectionBits) -> Picture {
    let camera = CameraBits {
        view: ViewBits::LookAt([ONE, 2 * ONE, 4 * ONE], [0; 3], [0, ONE, 0]),
        projection,
        viewport: (0, 0, TERMINAL.0, TERMINAL.1),
    };
    let model = ModelBits(vec![Step::Y(350_000_000), Step::X(80_000_000)]);
    let (exact, turned) = (camera.exact(), model.exact());
    let exact: Vec<_> = draw::CUBE.iter().map(|&v| exact.screen(exact.clip(&turned, vertex(v, 0)))).collect();
    for c in exact.iter().flat_map(|&(x, y)| [x, y]) {
        assert!(((c * 256.0).fract().abs() - 0.5).abs() > 1e-2, "a tie of the snap decides the picture");
    }
    let (camera, model) = (camera.library(), model.library());
    Picture { camera, model, vertices: draw::CUBE, exact, size: TERMINAL, letters: b"aAbBcC" }
}

#[test]
fn a_cube_matches_its_golden_pictures() {
    // Pixels are twice as high as wide in a terminal: the aspect says so.
    let lens = ProjectionBits::Perspective((1 << 31) / 4, (TERMINAL.0, 2 * TERMINAL.1), ONE, 20 * ONE);
    let flat = ProjectionBits::Orthographic([-2 * ONE, 2 * ONE, -2 * ONE, 2 * ONE], ONE, 20 * ONE);
    let drawn = [lens, flat].map(|projection| cube(projection).as_the_oracle().join("\n")).join("\n");
    assert!(drawn == include_str!("golden/cube.golden"), "{drawn}");
}

/// Viewing by PRP and window.
struct SetUp {
    name: &'static str,
    vrp: [i32; 3],
    vpn: [i32; 3],
    prp: [i32; 3],
    window: [i32; 4],
    parallel: bool,
}

const H: i32 = ONE / 2;

/// The worked set-ups of docs/spec.md, section 4: name, VRP, VPN, PRP, the ends of both sides of the window.
const SET_UPS: [SetUp; 4] = [
    set_up("one-point", [0, 0, 0], [0, 0, ONE], [H, H, ONE], [-1, 3], false),
    set_up("two-point", [2 * ONE, H, 0], [ONE, 0, ONE], [0, 0, 10 * ONE], [-10, 20], false),
    set_up("two-point, closer", [2 * ONE, H, 0], [ONE, 0, ONE], [0, 0, 10 * ONE], [-1, 2], false),
    set_up("parallel", [ONE, H, 0], [0, 0, ONE], [0, 0, 10 * ONE], [-2, 2], true),
];

const fn set_up(
    name: &'static str,
    vrp: [i32; 3],
    vpn: [i32; 3],
    prp: [i32; 3],
    [low, high]: [i32; 2],
    parallel: bool,
) -> SetUp {
    let window = [low * ONE, high * ONE, low * ONE, high * ONE];
    SetUp { name, vrp, vpn, prp, window, parallel }
}

impl SetUp {
    fn family(&self) -> Family {
        if self.parallel {
            Family::ReferenceParallel(self.prp, self.window, H, -4 * ONE)
        } else {
            Family::Reference(self.prp, self.window, H, -4 * ONE)
        }
    }

    fn view(&self) -> ViewBits {
        ViewBits::Reference(self.vrp, self.vpn, [0, ONE, 0])
    }

    fn camera(&self, size: u32) -> Camera {
        let area = rectangle(0, 0, size, size);
        let viewport = pinhole::Viewport::new(area.top_left, area.size).expect("a viewport");
        Camera::new(
            &self.view().library().expect("a view"),
            &self.family().library().expect("a projection"),
            &viewport,
        )
    }

    /// The cube's corners on the screen, by the definition.
    fn exact(&self, size: u32) -> Vec<(f64, f64)> {
        let (view, picture) = (self.view().exact(), self.family().picture());
        let viewport = Viewport::new(0, 0, size, size);
        CUBE.iter().map(|v| picture.screen(&viewport, view.apply(v.map(f64::from)))).collect()
    }
}

/// The cube [0, 1]² × [−1, 0]: vertex k has x, y, z + 1 by bits 0, 1, 2.
const CUBE: [[i16; 3]; 8] =
    [[0, 0, -1], [1, 0, -1], [0, 1, -1], [1, 1, -1], [0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]];

#[test]
fn s4_worked_set_ups_by_hand() {
    // By hand. One-point: the face z = 0 lies in the view plane, so 1 unit is 60 px and (0, 0) is at
    // 60 px from the left; the far face z = −1 is twice as far from the PRP, hence half as large about (½, ½).
    let one = SET_UPS[0].exact(240);
    assert!((one[4].0 - 60.0).abs() < 1e-9 && (one[4].1 - 180.0).abs() < 1e-9, "{:?}", one[4]);
    assert!((one[0].0 - 75.0).abs() < 1e-9 && (one[0].1 - 165.0).abs() < 1e-9, "{:?}", one[0]);
    // Parallel: DOP (0, 0, −10) is along n, so both faces coincide: 60 px a unit about (1, ½).
    let flat = SET_UPS[3].exact(240);
    assert!((flat[0].0 - 60.0).abs() < 1e-9 && (flat[0].1 - 150.0).abs() < 1e-9, "{:?}", flat[0]);
    assert_eq!(flat[0], flat[4]);
}

/// The cube, with the nearer face, z = 0, marked.
fn picture(s: &SetUp, size: u32) -> Picture {
    Picture {
        camera: s.camera(size),
        model: Affine::identity(),
        vertices: CUBE,
        exact: s.exact(size),
        size: (size, size),
        letters: b"aAbB#C",
    }
}

#[test]
fn s4_worked_set_ups_draw_their_golden_pictures() {
    let mut all = String::new();
    for s in &SET_UPS {
        // Larger than the golden picture, too.
        picture(s, 240).as_the_oracle();
        let picture = picture(s, 40);
        let [solid, lines] = picture.as_the_oracle();
        all += &format!("{}\n", s.name);
        for (a, b) in solid.lines().zip(lines.lines()) {
            all += &format!("{a}  {}\n", b.replace('#', "+"));
        }
        all.push('\n');
    }
    if std::env::var_os("GOLDEN").is_some() {
        std::fs::write(concat!(env!("CARGO_MANIFEST_DIR"), "/golden/reference.golden"), &all)
            .expect("written");
    }
    assert!(all == include_str!("golden/reference.golden"), "{all}");
}

#[test]
fn s4_the_direction_of_a_parallel_projection_is_window_center_minus_prp() {
    let Projectors::Along(d) = SET_UPS[3].family().picture().projectors else { panic!("parallel") };
    assert_eq!(d, [0.0, 0.0, -10.0]);
    // Off the centre it is oblique: a unit of depth moves by (2, −1)/4 of a unit.
    let (prp, area) = (point([-2 * ONE, ONE, 4 * ONE]), window([-ONE, ONE, -ONE, ONE]));
    let lens = Projection::parallel_from_reference(prp, area, scalar(0), scalar(-4 * ONE)).expect("a volume");
    let got = lens.apply(point([0, 0, -4 * ONE])).expect("a point before the eye");
    // DOP = (0, 0, 0) − (−2, 1, 4) = (2, −1, −4): from (0, 0, −4) back along it to (−2, 1, 0).
    assert_eq!(reals(got), [-2.0, 1.0, 1.0]);
}
