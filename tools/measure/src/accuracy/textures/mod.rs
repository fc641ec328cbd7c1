//! The error of textures: the coordinates that pixels show, against rays in f64, beside methods of other libraries.

mod costs;
mod methods;
mod plot;
mod scenes;
#[path = "../../../../bench/src/cells/stepped.rs"]
mod stepped;

use crate::accuracy::figures::{decimal, Errors};
use crate::oracle::chain;
use crate::oracle::texture::{off_repeated, Ray};
use methods::{Method, Shown, METHODS, TEXELS};
use pinhole::space::{Model, World};
use pinhole::{Accuracy, Affine, Mesh};
use scenes::{Scene, CAMERA};
use std::fmt::Write as _;

/// The file of the plot, beside the page.
pub(crate) const PLOT: &str = "texture-error.svg";

/// The errors of a scene by each method.
pub(crate) struct Measured {
    scene: Scene,
    /// In texels, beyond a shift of 1/64 pixel.
    errors: [Errors; METHODS.len()],
    /// Percent of the pixels that show another texel than the ray's.
    others: [f64; METHODS.len()],
    /// Instructions of a frame, if the benchmark has the scene.
    costs: Option<[f64; METHODS.len()]>,
}

impl Measured {
    /// Instructions for each of the pixels that a method, by its place in [`METHODS`], draws.
    fn per_pixel(&self, method: usize) -> Option<f64> {
        Some(self.costs?.get(method)? / self.errors.get(method)?.count() as f64)
    }
}

/// The error bound that [`pinhole::Texture`] documents in addition to the accuracy, for faces without a corner close to the eye.
const PLANES: f64 = 0.02;

pub(crate) fn measure() -> Result<Vec<Measured>, String> {
    let one = |scene: Scene| {
        let costs = scene.cell.map(costs::of_scene).transpose()?;
        of_scene(scene, costs).map_err(|error| error.to_string())
    };
    scenes::all().into_iter().map(one).collect()
}

fn of_scene(scene: Scene, costs: Option<[f64; METHODS.len()]>) -> Result<Measured, pinhole::MeshError> {
    let (camera, exact) = (CAMERA.library(), CAMERA.exact());
    let mut measured = Measured { scene, errors: Default::default(), others: [0.0; METHODS.len()], costs };
    for (corners, uv) in &measured.scene.faces {
        let mesh = Mesh::new(corners, measured.scene.exponent, &[[0, 1, 2]])?;
        let instance =
            camera.place(&mesh, &Affine::<Model, World>::identity()).with_cull(measured.scene.cull);
        let at = corners.map(|corner| chain::vertex(corner, measured.scene.exponent));
        let texels = uv.map(|uv| uv.map(|c| f64::from(c) / 16.0));
        let ray = Ray::new(&exact, &chain::IDENTITY, at, texels);
        for (i, (method, _)) in METHODS.into_iter().enumerate() {
            for (point, Shown(shown)) in method.draw(&instance, *uv) {
                let (x, y) = (i64::from(point.x), i64::from(point.y));
                let near = ray.around(x, y).zip(ray.at(x as f64 + 0.5, y as f64 + 0.5));
                let Some((near, centre)) = near else { continue };
                let shown = shown.map(|c| f64::from(c) / 2f64.powi(32) * TEXELS);
                let off = [0, 1].map(|axis| off_repeated(shown[axis], near[axis], TEXELS));
                measured.errors[i].add(off[0].max(off[1]).max(0.0));
                let is_other =
                    (0..2).any(|axis| shown[axis].floor() != centre[axis].rem_euclid(TEXELS).floor());
                measured.others[i] += f64::from(u8::from(is_other));
            }
        }
    }
    for (others, errors) in measured.others.iter_mut().zip(&measured.errors) {
        *others *= 100.0 / errors.count().max(1) as f64;
    }
    Ok(measured)
}

const HEAD: &str = "\
## Textures

The texel coordinates that a pixel shows, against a ray in f64 through its centre: the larger error of u and of v in texels, beyond the
coordinates of all points within 1/64 pixel of the centre, because corners are snapped to 1/256 pixel. *Another* is the share of pixels that show another texel
than the ray's. Each face is drawn alone into 240 × 240 pixels, with a texture of 64 × 64 texels, so an error of 32 is the largest that can
be seen. The last two methods are the common ones of other libraries, on the same triangles (`tools/bench/src/cells/stepped.rs`):
u/w, v/w and 1/w are linear on the screen and divided, by a reciprocal of 16 bits, at each pixel, or at every sixteenth pixel of a span and
at its end, with coordinates linear in between. *Instructions* are those of a frame on an M3, vertices, faces and rows included, for each
pixel that is drawn: `tools/bench/run cells X1 X2 X3 X4 M3`.

| scene | | largest | 99.9 % | RMS | another, % | instructions |
|---|---|---|---|---|---|---|
";

/// The section of the page.
pub(crate) fn text(measured: &mut [Measured]) -> String {
    let mut text = String::from(HEAD);
    for one in &mut *measured {
        for (i, (_, name)) in METHODS.into_iter().enumerate() {
            let cost = one.per_pixel(i).map_or("–".into(), |cost| format!("{cost:.1}"));
            let Measured { scene, errors, others, .. } = &mut *one;
            let first = if i == 0 { format!("{}: {}", scene.name, scene.about) } else { String::new() };
            let _ = writeln!(
                text,
                "| {first} | {name} | {} | {} | {cost} |",
                errors[i].cells(),
                decimal(others[i])
            );
        }
    }
    text += &format!(
        "
![Instructions for each pixel, and the largest error, of each method on four scenes](texture-error.svg)

The library's error is at most its accuracy and that of the planes: {PLANES} texel here, asserted by `tests/shading/textures.rs`; the general
bound stands at `Texture`. A fixed step has no bound: on the rolled floor, and wherever w changes much within sixteen pixels, it shows
texels from elsewhere in the texture. On the floor that is not rolled it is right, because w is constant along each row.

"
    );
    text
}

/// The plot, and what is written into it.
pub(crate) fn svg(measured: &[Measured]) -> String {
    plot::svg(measured)
}

/// A bound that does not hold.
pub(crate) fn broken(measured: &[Measured]) -> Option<String> {
    measured.iter().find_map(|Measured { scene, errors, .. }| {
        METHODS.iter().zip(errors).find_map(|((method, name), errors)| {
            let chosen = match method {
                Method::Ours(Accuracy::Quarter) => 0.25,
                Method::Ours(Accuracy::Eighth) => 0.125,
                Method::Ours(Accuracy::Sixteenth) => 0.0625,
                _ => return None,
            };
            let largest = errors.largest();
            (largest > chosen + PLANES).then(|| {
                format!("{}, {name}: {largest} texels off, the bound is {}", scene.name, chosen + PLANES)
            })
        })
    })
}
