//! Whole set-ups: a vertex through view, projection and viewport within the documented budget, whatever
//! the four are (ARCHITECTURE.md, "Numbers"); nodes' visibility; and single points both ways.

use super::projections;
use super::views::{self, triple};
use crate::fuzzed::Bytes;
use pinhole::{
    camera::{CameraError, Projected, Visibility},
    Camera, Mesh,
};
use support::bridge::pair::{bits, CameraBits, ModelBits, ProjectionBits, Step, ONE};
use support::bridge::{point, screen_point};
use support::oracle::chain::{self, fx, fx3, length, mul4, V3, V4};

fn viewport(b: &mut Bytes<'_>) -> (i32, i32, u32, u32) {
    match b.byte() {
        0..=127 => (0, 0, 480, 320),
        128..=159 => (-8192, -8192, 16_384, 16_384),
        160..=191 => (b.i8() as i32 * 64, b.i8() as i32 * 64, 1, 1),
        _ => {
            let (x, y) = (i32::from(b.i16() >> 2), i32::from(b.i16() >> 2));
            let extent = |low: i32, k: u16| 1 + u32::from(k) % (8192 - low).unsigned_abs();
            (x, y, extent(x, b.u16()), extent(y, b.u16()))
        }
    }
}

struct SetUp {
    bits: CameraBits,
    exact: chain::Camera,
}

/// And whether the budget holds: VUP 1/50 rad off VPN, and no number of the projection's own out of range.
fn set_up(b: &mut Bytes<'_>) -> Option<(SetUp, bool)> {
    let bits = CameraBits { view: views::any(b), projection: projections::any(b), viewport: viewport(b) };
    let CameraBits { view, projection, .. } = bits;
    pinhole::Viewport::new(bits.area().top_left, bits.area().size).ok()?;
    view.library().ok()?;
    projection.library().ok()?;
    let set_up = SetUp { bits, exact: bits.exact() };
    Some((set_up, views::sine(view) > 0.02 && !projections::saturates(&projection)))
}

/// A box of twice that has a sphere whose radius is still a number.
const SMALL: f64 = 18_000.0;

/// Three roundings to 2⁻³², as a translation or a constant takes them, in what 12·2⁻³⁰ is a part of.
const STEPS: f64 = 1.0 / 16.0;

impl SetUp {
    /// |a| + |b| + |c| of each row times `reach`, and its constant, which is rounded to 2⁻³² like the
    /// translation that `reach` allows for: that shows where w is small by the projection itself. And what
    /// cancels in a row.
    fn rho(&self, reach: f64) -> V4 {
        let mut rho =
            self.exact.projection.map(|[a, b, c, d]| (a.abs() + b.abs() + c.abs()) * reach + d.abs() + STEPS);
        for (rho, [linear, constant]) in rho.iter_mut().zip(projections::parts(&self.bits.projection)) {
            *rho += linear * reach + constant;
        }
        rho
    }

    /// A vertex with an image: within the budget for an object of this half extent.
    fn check(&self, at: V3, extent: f64, got: Option<Projected>, what: &dyn core::fmt::Debug) {
        let what = (&self.bits, what);
        let clip = mul4(&self.exact.projection, [at[0], at[1], at[2], 1.0]);
        let (w, rho) = (clip[3], self.rho(extent + length(at) + STEPS));
        let v = &self.exact.viewport;
        let [x, y, z] = [0, 1, 2].map(|i| clip[i] / w);
        let share =
            |i: usize, size: f64, quotient: f64| size / 2.0 * (rho[i] + quotient.abs() * rho[3]) / w.abs();
        let share = share(0, v.width, x).max(share(1, v.height, y));
        // w and d are no finer than x and y over what is free between the viewport's centre and the guard
        // band: inside the viewport that is part of the budget, elsewhere it comes on top.
        let (cx, cy) = (v.x + v.width / 2.0, v.y + v.height / 2.0);
        let free = (8192.0 - cx.abs().max(cy.abs())).max(0.5);
        // Rows' constants saturate at 2³⁰, x's and y's over what is free: such objects lie that many volumes
        // away.
        let stretch = (v.width.max(v.height) / free).max(1.0);
        if rho.iter().any(|reach| reach * stretch > 2f64.powi(29)) {
            return;
        }
        let (ex, ey) = v.apply([x, y, z]);
        let beside = (ex - cx).abs().max((ey - cy).abs()) / free;
        let budget = share * beside.max(1.0) + 8192.0 * rho[3] / w.abs();
        let coarse = (share + rho[3] / w.abs()) / free;
        // In front of the near plane or not: the sum of two rows, each within a few 2⁻³⁰ of its own range, or of the range
        // of x and y, if that is coarser, because the rows share one exponent.
        let (near, unsure) = (clip[2] + w, (rho[2] + rho[3] + 2.0 * w.abs() * coarse) * 2f64.powi(-26));
        if near < -unsure {
            assert!(got.is_none(), "{:?} before near: {clip:?} {at:?} {what:?}", got);
            return;
        }
        if near < unsure || w < rho[3] * 2f64.powi(-26) {
            return;
        }
        // Sine and cosine are within 2⁻²⁹·⁵, and one of them is small for narrow angles and for wide ones:
        // within the viewport that too is part of the budget.
        let lens = match self.bits.projection {
            ProjectionBits::Perspective(..) => {
                let cotangent = self.exact.projection[1][1];
                cotangent.max(1.0 / cotangent) * 2f64.powi(-29) * beside * free
            }
            _ => 0.0,
        };
        // The budget's 12 is for VUP well off VPN: the roll's error grows as 1/sine.
        let factor = 12.0 + (1.0 / views::sine(self.bits.view) - 4.0).max(0.0);
        let bound = 1.0 / 512.0 + 2.5e-6 + factor * 2f64.powi(-30) * budget + lens;
        let far = ex.abs().max(ey.abs());
        let Some(Projected { point: p, depth }) = got else {
            assert!(far > 8192.0 - bound, "dropped at ({ex}, {ey}): {clip:?} {at:?} {what:?}");
            return;
        };
        assert!(far < 8192.0 + bound, "{p:?} for ({ex}, {ey}): {clip:?} {at:?} {what:?}");
        let error = (f64::from(p.x()) / 256.0 - ex).abs().max((f64::from(p.y()) / 256.0 - ey).abs());
        assert!(
            error <= bound,
            "{error} px off at ({ex}, {ey}), {:.2}·2⁻³⁰ of the budget {budget}: {clip:?} {at:?} {what:?}",
            (error - 1.0 / 512.0) / budget * 2f64.powi(30)
        );
        let wanted = chain::depth(clip).clamp(0.0, 65_534.0);
        let deep = 65_535.0 * ((rho[2] + z.abs() * rho[3]) / 2.0 / w + coarse);
        // Half a step, and half of the 1/256 to which a corner is rounded first.
        let steps = (f64::from(depth) - wanted).abs();
        assert!(
            steps <= 0.503 + 20.0 * 2f64.powi(-30) * deep,
            "depth {depth} for {wanted}, budget {deep}: {clip:?} {at:?} {what:?}"
        );
    }
}

pub(crate) fn angle(b: &mut Bytes<'_>) -> u32 {
    match b.byte() {
        k @ 0..=127 => u32::from(k) << 27,
        k @ 128..=191 => (u32::from(k) << 29).wrapping_add(b.i8() as u32),
        _ => b.u32(),
    }
}

fn turn(b: &mut Bytes<'_>) -> Step {
    match b.byte() % 3 {
        0 => Step::X(angle(b)),
        1 => Step::Y(angle(b)),
        _ => Step::Z(angle(b)),
    }
}

pub(crate) fn check(b: &mut Bytes<'_>) {
    let kind = b.byte();
    let Some((set_up, apart)) = set_up(b) else { return };
    // The first vertex lies in the picture, or anywhere.
    let at = if kind & 3 == 0 {
        fx3(triple(b, [ONE; 3]))
    } else {
        let m = &set_up.exact.projection;
        let depth = match b.byte() {
            0..=127 => (f64::from(b.i8() as i8) / 8.0).exp2(),
            _ => fx(b.wild()).abs(),
        };
        let w = -m[3][2] * depth + m[3][3];
        let place = [b.i8(), b.i8()].map(|c| c as f64 / if kind & 4 == 0 { 127.0 } else { 4.0 });
        let solve = |i: usize| (place[i] * w + m[i][2] * depth - m[i][3]) / m[i][i];
        [solve(0), solve(1), -depth]
    };
    let (view, camera) = (&set_up.exact.view, set_up.bits.library());
    let Some(world) = bits(view.back(at)) else { return };
    points(b, &set_up, &camera, world, apart);

    let exponent = (b.i8() >> 2).clamp(-32, 15) as i8;
    let vertices = [(); 2].map(|()| [b.i16(), b.i16(), b.i16()]);
    let mut model = ModelBits((0..b.below(3)).map(|_| turn(b)).collect());
    if b.byte() & 3 == 0 {
        model.0.insert(0, Step::Scale(triple(b, [ONE; 3])));
    }
    let first = model.exact().apply(chain::vertex(vertices[0], exponent));
    let Some(shift) = bits(core::array::from_fn(|i| fx(world[i]) - first[i])) else { return };
    model.0.push(Step::Move(shift));
    let exact = model.exact();
    // A mesh of zeros alone counts as one of its units wide.
    let largest = vertices.iter().flatten().fold(1.0f64, |m, &c| m.max(f64::from(c).abs()));
    let stretch = (0..3).map(|j| length(core::array::from_fn(|i| exact.m[i][j]))).fold(0.0, f64::max);
    let extent = largest * f64::from(exponent).exp2() * stretch;
    let mesh = Mesh::new(&vertices, exponent, &[]).expect("a mesh");
    let model_ours = model.library();
    let instance = camera.place(&mesh, &model_ours);
    let found = camera.frustum().visibility(&mesh.bounding_sphere(), &model_ours);
    for (i, &v) in vertices.iter().enumerate() {
        let got = instance.project(i).ok();
        // The documented world.
        if extent > 32_767.0
            || !apart
            || exact.apply(chain::vertex(v, exponent)).iter().any(|c| c.abs() > 32_767.0)
        {
            continue;
        }
        let at = view.apply_placed(&exact, chain::vertex(v, exponent));
        set_up.check(at, extent, got, &(&model, v, exponent));
        // A node is surely outside or inside: to the rounding of the planes' coefficients.
        let [x, y, z, w] = mul4(&set_up.exact.projection, [at[0], at[1], at[2], 1.0]);
        let rho = set_up.rho(extent + length(at) + STEPS);
        let room = rho.iter().sum::<f64>() * 2f64.powi(-26);
        let least = [w + x, w - x, w + y, w - y, w + z, w - z].into_iter().fold(f64::INFINITY, f64::min);
        // Rows saturate at 2³⁰, and a mesh's sphere at the ends of its numbers.
        let whole = largest * f64::from(exponent).exp2() < SMALL && rho.iter().all(|r| *r < 2f64.powi(29));
        let text = format_args!("{:?} {model:?} {v:?}·2^{exponent}", set_up.bits);
        match found {
            _ if !whole => {}
            Visibility::Outside => assert!(least <= room, "not outside by {least} ({room}): {at:?} {text}"),
            Visibility::Inside => assert!(least >= -room, "not inside by {least} ({room}): {at:?} {text}"),
            Visibility::Partly => {}
        }
    }
}

/// A point of the world by itself, and back.
fn points(b: &mut Bytes<'_>, set_up: &SetUp, camera: &Camera, world: [i32; 3], apart: bool) {
    let got = camera.project(point(world));
    if apart {
        let image = match got {
            // Beyond the guard band is named as such; far does not clip here.
            Err(CameraError::BeyondFar) => panic!("beyond far: {world:?}"),
            other => other.ok(),
        };
        set_up.check(set_up.exact.view.apply(fx3(world)), 0.0, image, &world);
    }
    let limit = 8192 * 256;
    let any = |b: &mut Bytes<'_>| i64::from(b.wild()).clamp(-limit, limit);
    let (at, depth) = match got {
        Ok(Projected { point: p, depth }) if b.byte() & 1 == 0 => (p, depth),
        _ => (screen_point((any(b), any(b))), b.u16()),
    };
    let _ = camera.unproject(at, depth);
    let _ = camera.vanishing_points();
}
