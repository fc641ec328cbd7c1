//! docs/spec.md, section 4, viewing by PRP and window: the normalising transforms onto the canonical volumes, from
//! there to clip space, and the worked set-ups against the projector that cuts the view plane.

use pinhole::space::{Model, View, World};
use pinhole::{Affine, Camera, Mesh, Painter, Projection, ProjectionError, ReferenceVolume, ScreenVertex};
use support::bridge;
use support::bridge::draw::{Shader, CUBE_EDGES};
use support::bridge::pair::{window, ViewBits, ONE};
use support::bridge::{point, reals, rectangle, scalar};
use support::definition::{Family, Projectors};
use support::oracle;
use support::oracle::chain::{self, fx, snap, Viewport, V3};
use support::oracle::coverage::{covers, edge, Area};
use support::oracle::rng::Rng;
use support::oracle::target::Recorder;

const HALF: f64 = 0.5 / 65536.0;

struct Random {
    prp: [i32; 3],
    window: [i32; 4],
    front: i32,
    back: i32,
}

/// A volume of moderate size, its front before the PRP.
fn random(rng: &mut Rng) -> Random {
    let mut place = |reach: i64| rng.int(-reach * i64::from(ONE), reach * i64::from(ONE)) as i32;
    let (x, y, l, b) = (place(50), place(50), place(50), place(50));
    let n = rng.int(i64::from(ONE / 4), i64::from(100 * ONE)) as i32;
    let mut size = || rng.int(i64::from(ONE / 2), i64::from(60 * ONE)) as i32;
    let window = [l, l + size(), b, b + size()];
    let front = n - size();
    Random { prp: [x, y, n], window, front, back: front - 4 * size() }
}

fn parallel(r: &Random) -> ReferenceVolume {
    ReferenceVolume::parallel(point(r.prp), window(r.window), scalar(r.front), scalar(r.back))
        .expect("a volume")
}

fn perspective(r: &Random) -> ReferenceVolume {
    ReferenceVolume::perspective(point(r.prp), window(r.window), scalar(r.front), scalar(r.back))
        .expect("a volume")
}

/// The eight corners of the view volume, with their signs in x and y and whether at the back.
fn corners(family: &Family) -> Vec<(V3, [f64; 2], bool)> {
    let picture = family.picture();
    let mut all = Vec::new();
    for x in [-1.0, 1.0] {
        for y in [-1.0, 1.0] {
            for back in [false, true] {
                let n = if back { picture.back } else { picture.front };
                all.push((picture.back_to([x, y], n), [x, y], back));
            }
        }
    }
    all
}

#[test]
fn s4_the_view_volumes_corners_go_to_the_canonical_volumes() {
    let mut rng = Rng::new(0x41);
    let mut compared = 0;
    for _ in 0..5000 {
        let r = random(&mut rng);
        for (at, [sx, sy], back) in corners(&Family::ReferenceParallel(r.prp, r.window, r.front, r.back)) {
            let Some(bits) = bridge::pair::bits(at) else { continue };
            compared += 1;
            let got = reals(parallel(&r).normalise(point::<View>(bits)));
            // The corner was rounded to 2⁻¹⁶, which moves x by 2/width of that, and z by 1/depth.
            let w = fx(r.window[1]) - fx(r.window[0]);
            let h = fx(r.window[3]) - fx(r.window[2]);
            let slope = 400.0 / fx(r.prp[2]).max(0.25);
            let want = [sx, sy, if back { -1.0 } else { 0.0 }];
            let room = [w, h, fx(r.front) - fx(r.back)].map(|d| HALF * (1.01 + 2.0 * (1.0 + slope) / d));
            for i in 0..3 {
                assert!((got[i] - want[i]).abs() <= room[i], "{got:?} for {want:?}");
            }
        }
        let volume = perspective(&r);
        let (to_front, to_back) = (fx(r.prp[2]) - fx(r.front), fx(r.prp[2]) - fx(r.back));
        let z_min = to_front / to_back;
        assert!((fx(volume.z_min().to_bits()) - z_min).abs() <= HALF * 1.01);
        for (at, [sx, sy], back) in corners(&Family::Reference(r.prp, r.window, r.front, r.back)) {
            let Some(bits) = bridge::pair::bits(at) else { continue };
            compared += 1;
            let got = reals(volume.normalise(point::<View>(bits)));
            let z = if back { 1.0 } else { z_min };
            let want = [sx * z, sy * z, -z];
            // x = (shear and scale: 2·pn/width)/to_back of a move of 2⁻¹⁷.
            let slope = 2.0 + 200.0 / fx(r.prp[2]).max(0.25);
            let size = (fx(r.window[1]) - fx(r.window[0])).min(fx(r.window[3]) - fx(r.window[2]));
            let room = HALF * (1.01 + slope * (2.0 * fx(r.prp[2]) / size + 1.0) / to_back);
            for i in 0..3 {
                assert!((got[i] - want[i]).abs() <= room, "{got:?} for {want:?}, {room}");
            }
        }
    }
    assert!(compared > 60_000, "{compared}");
}

/// From a view point to clip space by N and the two maps of docs/spec.md, section 4, in f64, and by the library.
#[test]
fn s4_the_canonical_volumes_go_to_the_clip_volume() {
    let mut rng = Rng::new(0x42);
    for _ in 0..20_000 {
        let r = random(&mut rng);
        let p = [0; 3].map(|_| rng.int(-100 * i64::from(ONE), 100 * i64::from(ONE)) as i32);
        let at = chain::fx3(p);
        let [l, rt, b, t] = r.window.map(fx);
        let prp = chain::fx3(r.prp);
        let (front, back) = (fx(r.front), fx(r.back));
        // Sh takes (cx − px, cy − py, −pn) to (0, 0, −pn), with the window's centre c.
        let (cx, cy) = ((l + rt) / 2.0, (b + t) / 2.0);
        let (shx, shy) = ((cx - prp[0]) / prp[2], (cy - prp[1]) / prp[2]);
        // Parallel: S·T·Sh.
        let n = [
            (at[0] + shx * at[2] - cx) * 2.0 / (rt - l),
            (at[1] + shy * at[2] - cy) * 2.0 / (t - b),
            (at[2] - front) / (front - back),
        ];
        let clip = Projection::from_reference(&parallel(&r)).apply(point(p));
        let unit = f64::from(clip.exponent()).exp2();
        let got = clip.xyzw().map(|c| f64::from(c) * unit);
        let want = [n[0], n[1], -2.0 * n[2] - 1.0, 1.0];
        let largest = want.iter().fold(1.0f64, |a, c| a.max(c.abs()));
        for i in 0..4 {
            // Cancellation costs what the terms are larger than their sum.
            let room = 2f64.powi(-25) * (largest + (at[2] * shx).abs().max((at[2] * shy).abs()) + 200.0);
            assert!((got[i] - want[i]).abs() <= room, "{got:?} for {want:?}");
        }
        // Perspective: S·Sh·T(−PRP), then z and w, up to a factor.
        let q = [at[0] - prp[0], at[1] - prp[1], at[2] - prp[2]];
        let (to_front, to_back) = (prp[2] - front, prp[2] - back);
        let z_min = to_front / to_back;
        let n = [
            (q[0] + shx * q[2]) * 2.0 * prp[2] / (rt - l) / to_back,
            (q[1] + shy * q[2]) * 2.0 * prp[2] / (t - b) / to_back,
            q[2] / to_back,
        ];
        let want = [n[0], n[1], (-(1.0 + z_min) * n[2] - 2.0 * z_min) / (1.0 - z_min), -n[2]];
        let clip = Projection::from_reference(&perspective(&r)).apply(point(p));
        let got = clip.xyzw().map(f64::from);
        if want[3].abs() < 1e-3 {
            continue;
        }
        // Homogeneous: compared after bringing w together; the factor is positive.
        let factor = want[3] / got[3];
        assert!(factor > 0.0);
        let largest = want.iter().fold(1.0f64, |a, c| a.max(c.abs()));
        let terms = 100.0 * (1.0 + shx.abs().max(shy.abs())) * (2.0 * prp[2] / (rt - l).min(t - b)) / to_back;
        let room = 2f64.powi(-25) * (largest + terms + 1.0 / (1.0 - z_min)) / want[3].abs().min(1.0)
            * (1.0 + largest);
        for i in 0..4 {
            assert!(
                (got[i] * factor - want[i]).abs() <= room,
                "{i}: {:?} for {want:?}, {room}",
                got.map(|c| c * factor)
            );
        }
    }
}

#[test]
fn s4_reference_volumes_report_their_own_errors() {
    let make = |prp: [i32; 3], w: [i32; 4], front: i32, back: i32| {
        (
            ReferenceVolume::perspective(point(prp), window(w), scalar(front), scalar(back)).map(|_| ()),
            ReferenceVolume::parallel(point(prp), window(w), scalar(front), scalar(back)).map(|_| ()),
        )
    };
    let w = [-ONE, ONE, -ONE, ONE];
    assert_eq!(make([0, 0, ONE], w, ONE - 1, 0), (Ok(()), Ok(())));
    let behind = Err(ProjectionError::ReferenceBehindPlane);
    assert_eq!(make([0, 0, 0], w, -ONE, -2 * ONE), (behind, behind));
    assert_eq!(make([0, 0, -ONE], w, -2 * ONE, -3 * ONE), (behind, behind));
    assert_eq!(make([0, 0, 1], w, 0, -ONE), (Ok(()), Ok(())));
    assert_eq!(make([0, 0, ONE], w, ONE, 0), (Err(ProjectionError::NearNotPositive), Ok(())));
    let order = Err(ProjectionError::NearNotBeforeFar);
    assert_eq!(make([0, 0, ONE], w, 0, 0), (order, order));
    assert_eq!(make([0, 0, ONE], w, -1, 0), (order, order));
    let empty = Err(ProjectionError::EmptyWindow);
    assert_eq!(make([0, 0, ONE], [ONE, ONE, -ONE, ONE], 0, -ONE), (empty, empty));
    assert_eq!(make([0, 0, ONE], [-ONE, ONE, ONE, -ONE], 0, -ONE), (empty, empty));
    // A window of 2⁻¹⁶ at 30000 units cannot be told apart from its centre.
    let far = [30_000 * ONE, 30_000 * ONE + 1, -ONE, ONE];
    let small = Err(ProjectionError::WindowTooSmall);
    assert_eq!(make([0, 0, ONE], far, 0, -ONE), (small, small));
}

/// The worked set-ups of docs/spec.md, section 4: name, VRP, VPN, VUP, PRP, window.
struct SetUp {
    name: &'static str,
    vrp: [i32; 3],
    vpn: [i32; 3],
    prp: [i32; 3],
    window: [i32; 4],
    parallel: bool,
}

const H: i32 = ONE / 2;

const SET_UPS: [SetUp; 4] = [
    SetUp {
        name: "one-point",
        vrp: [0, 0, 0],
        vpn: [0, 0, ONE],
        prp: [H, H, ONE],
        window: [-ONE, 3 * ONE, -ONE, 3 * ONE],
        parallel: false,
    },
    SetUp {
        name: "two-point",
        vrp: [2 * ONE, H, 0],
        vpn: [ONE, 0, ONE],
        prp: [0, 0, 10 * ONE],
        window: [-10 * ONE, 20 * ONE, -10 * ONE, 20 * ONE],
        parallel: false,
    },
    SetUp {
        name: "two-point, closer",
        vrp: [2 * ONE, H, 0],
        vpn: [ONE, 0, ONE],
        prp: [0, 0, 10 * ONE],
        window: [-ONE, 2 * ONE, -ONE, 2 * ONE],
        parallel: false,
    },
    SetUp {
        name: "parallel",
        vrp: [ONE, H, 0],
        vpn: [0, 0, ONE],
        prp: [0, 0, 10 * ONE],
        window: [-2 * ONE, 2 * ONE, -2 * ONE, 2 * ONE],
        parallel: true,
    },
];

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
fn s4_worked_set_ups_agree_with_the_definition_at_240() {
    let mesh = Mesh::new(&CUBE, 0, &[]).expect("a mesh");
    for s in &SET_UPS {
        let camera = s.camera(240);
        let instance = camera.place(&mesh, &Affine::identity());
        for (k, want) in s.exact(240).into_iter().enumerate() {
            let got = instance.project(k).expect("in the picture").point;
            let (x, y) = (f64::from(got.x()) / 256.0, f64::from(got.y()) / 256.0);
            assert!(
                (x - want.0).abs().max((y - want.1).abs()) <= 1.0 / 256.0,
                "{} {k}: {got:?} {want:?}",
                s.name
            );
            let world = point::<World>(CUBE[k].map(|c| i32::from(c) * ONE));
            assert_eq!(camera.project(world).map(|seen| seen.point), Ok(got));
        }
    }
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

const FACES: [[u16; 3]; 12] = bridge::draw::CUBE_FACES;

fn letter(face: usize) -> char {
    // The nearer face, z = 0, is marked.
    char::from(b"aAbB#C"[face / 2 % 6])
}

fn solid(s: &SetUp, size: u32) -> String {
    let mesh = Mesh::new(&CUBE, 0, &FACES).expect("a mesh");
    let camera = s.camera(size);
    let mut target = Recorder::sized(size, size);
    let mut painter = Painter::<Shader, 8, 12>::new();
    let model = Affine::<Model, World>::identity();
    painter.add(&camera.place(&mesh, &model), |face| Shader(face as u16)).expect("room");
    painter.draw(&mut target).expect("no error");
    target.picture(size as i32, size as i32, |Shader(face)| letter(usize::from(face)))
}

fn wireframe(s: &SetUp, size: u32) -> String {
    let mesh = Mesh::new(&CUBE, 0, &FACES).and_then(|m| m.with_edges(&CUBE_EDGES)).expect("a mesh");
    let camera = s.camera(size);
    let mut target = Recorder::sized(size, size);
    let mut cache = [ScreenVertex::default(); 8];
    let model = Affine::<Model, World>::identity();
    camera.place(&mesh, &model).wireframe(Shader(0), &mut cache, &mut target).expect("no error");
    target.picture(size as i32, size as i32, |_| '+')
}

/// The picture by the definition: snapped corners, and the exact coverage of the faces that face the viewer.
fn oracle_solid(s: &SetUp, size: u32) -> String {
    let at: Vec<_> = s.exact(size).into_iter().map(snap).collect();
    let front: Vec<_> = FACES
        .iter()
        .map(|f| f.map(|i| at[usize::from(i)]))
        .enumerate()
        .filter(|(_, t)| edge(t[0], t[1], t[2]) < 0)
        .collect();
    let mut text = String::new();
    for y in 0..i64::from(size) {
        for x in 0..i64::from(size) {
            let mut here = front.iter().filter(|(_, t)| covers(*t, x, y));
            text.push(here.next().map_or('.', |(i, _)| letter(*i)));
            assert!(here.next().is_none());
        }
        text.push('\n');
    }
    text
}

fn oracle_wireframe(s: &SetUp, size: u32) -> String {
    let at: Vec<_> = s.exact(size).into_iter().map(snap).map(|(x, y)| (x >> 8, y >> 8)).collect();
    let area = Area::new(0, 0, size.into(), size.into());
    let mut pixels = std::collections::BTreeSet::new();
    for [a, b] in CUBE_EDGES {
        pixels.extend(oracle::line::clipped(at[usize::from(a)], at[usize::from(b)], area));
    }
    let mut text = String::new();
    for y in 0..i64::from(size) {
        for x in 0..i64::from(size) {
            text.push(if pixels.contains(&(x, y)) { '+' } else { '.' });
        }
        text.push('\n');
    }
    text
}

#[test]
fn s4_worked_set_ups_draw_their_golden_pictures() {
    let mut all = String::new();
    for s in &SET_UPS {
        let (drawn, wanted) = (solid(s, 40), oracle_solid(s, 40));
        assert!(drawn == wanted, "{}: drawn\n{drawn}\nexpected\n{wanted}", s.name);
        let (lines, wanted) = (wireframe(s, 40), oracle_wireframe(s, 40));
        assert!(lines == wanted, "{}: drawn\n{lines}\nexpected\n{wanted}", s.name);
        all += &format!("{}\n", s.name);
        for (a, b) in drawn.lines().zip(lines.lines()) {
            all += &format!("{a}  {b}\n");
        }
        all.push('\n');
    }
    if std::env::var_os("GOLDEN").is_some() {
        std::fs::write(concat!(env!("CARGO_MANIFEST_DIR"), "/golden/reference.golden"), &all)
            .expect("written");
    }
    assert!(all == include_str!("reference.golden"), "{all}");
}

/// The shade of a letter in the golden pictures.
fn shade(c: char) -> u8 {
    match c {
        '#' => 255, // the marked face
        '+' => 255,
        '.' => 0,
        'a' => 60,
        'A' => 100,
        'b' => 140,
        'B' => 170,
        _ => 200,
    }
}

/// Solid above, wireframe below. `GOLDEN=1` writes the file anew: look at it then.
fn s4_golden_at_240(s: &SetUp, name: &str) {
    let (drawn, wanted) = (solid(s, 240), oracle_solid(s, 240));
    assert!(drawn == wanted, "{}: solid differs from its definition", s.name);
    let (lines, wanted) = (wireframe(s, 240), oracle_wireframe(s, 240));
    assert!(lines == wanted, "{}: wireframe differs from its definition", s.name);
    let pixels: Vec<u8> = (drawn + &lines).chars().filter(|c| *c != '\n').map(shade).collect();
    let path = format!("{}/golden/{name}.png", env!("CARGO_MANIFEST_DIR"));
    if std::env::var_os("GOLDEN").is_some() {
        let mut encoder = png::Encoder::new(std::fs::File::create(&path).expect("created"), 240, 480);
        encoder.set_color(png::ColorType::Grayscale);
        encoder.write_header().and_then(|mut w| w.write_image_data(&pixels)).expect("written");
    }
    let file = std::io::BufReader::new(std::fs::File::open(&path).expect("a golden picture"));
    let mut reader = png::Decoder::new(file).read_info().expect("a PNG file");
    let mut kept = vec![0; 240 * 480];
    reader.next_frame(&mut kept).expect("its pixels");
    assert!(pixels == kept, "{}: not its golden picture", s.name);
}

#[test]
fn s4_one_point_perspective_matches_its_golden_picture_at_240() {
    s4_golden_at_240(&SET_UPS[0], "one_point");
}

#[test]
fn s4_two_point_perspective_matches_its_golden_picture_at_240() {
    s4_golden_at_240(&SET_UPS[1], "two_point");
}

#[test]
fn s4_closer_two_point_perspective_matches_its_golden_picture_at_240() {
    s4_golden_at_240(&SET_UPS[2], "two_point_closer");
}

#[test]
fn s4_parallel_projection_matches_its_golden_picture_at_240() {
    s4_golden_at_240(&SET_UPS[3], "parallel");
}

#[test]
fn s4_the_direction_of_a_parallel_projection_is_window_center_minus_prp() {
    let Projectors::Along(d) = SET_UPS[3].family().picture().projectors else { panic!("parallel") };
    assert_eq!(d, [0.0, 0.0, -10.0]);
    // Off the centre it is oblique: a unit of depth moves by (2, −1)/4 of a unit.
    let r =
        Random { prp: [-2 * ONE, ONE, 4 * ONE], window: [-ONE, ONE, -ONE, ONE], front: 0, back: -4 * ONE };
    let volume = parallel(&r);
    let got = volume.normalise(point([0, 0, -4 * ONE]));
    // DOP = (0, 0, 0) − (−2, 1, 4) = (2, −1, −4): from (0, 0, −4) back along it to (−2, 1, 0).
    assert_eq!(reals(got), [-2.0, 1.0, -1.0]);
}
