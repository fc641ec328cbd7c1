//! The text of docs/accuracy.md.

use super::figures::{binary, decimal};
use super::functions::{self, Measured};
use super::population::{DESIGNS, POPULATIONS, RANGES};
use super::sweep::{sweep, Pair, Sweep, COUNT};
use super::textures;
use pinhole_apps_support::grouped::grouped;
use std::fmt::Write as _;

/// The bounds that [`pinhole::MeshInstance::project`] and [`pinhole::Camera::project`] document, in px and in depth steps.
const PLACE: f64 = 1.0 / 256.0;
const DEPTH: f64 = 1.0;
/// The least ratio of far to near.
const DEEP: f64 = 2.0;

const HEAD: &str = "\
# Accuracy

How far the integers are from exact results, measured. This page is written by

```sh
cargo run --release -p pinhole-measure -- accuracy
```

and CI checks that it is current (`-- --check`). The reference is f64 from the same quantised inputs: the bits of
angles, eyes, vertices and matrices, never the library's own intermediate results (`tests/support/src/oracle`). All inputs come from
a seeded generator. The documentation of each function states its bound, and the test named beside it asserts it.
`tests/bounds.rs` also asserts that a bound is at most twice the largest error found; the margins of `Camera::visibility` and
of culling by planes are derived instead, and err on the safe side. A Cortex-M0, whose multiplier
keeps 32 bits, computes the same bits as all other cores (`both_forms_give_the_same_bits`, `tests/device`), so this page
holds for it too.
";

const CHAIN: &str = "\
## Vertices on the screen

Each line stands for COUNT visible vertices before random cameras. An error is the larger of the errors in x and in y, in
pixels, *before* the snap to 1/256 px (`MeshInstance::project_unsnapped`) and *after* it (`MeshInstance::project`, for points
`Camera::project`). The snap alone costs up to 1/512 = 1.95·10⁻³ px.

| population | world | least distance z | viewport | cameras |
|---|---|---|---|---|
";

const DRAWN: &str = "
The eye is uniform in the world's cube, gaze and up are uniform on the sphere (1/50 rad and more apart), the field of
view is uniform from 26° to 120° (focal lengths up to 693 px), the near plane lies at the least distance and far is
1.01, 1.1, 2, 16 or 32 000 times as far. Places are uniform in the picture and logarithmic in distance, inside the world
and the volume. A mesh is turned about three axes, in units of a power of two (`i16`) or of 2⁻¹⁶ (`I16F16`); r is
the half extent of the mesh about its own origin, z the vertex's distance along the view axis. r/z is logarithmic from
1/64 to 16, and from 16 to 300. Single points are points of the world in 2⁻¹⁶.

| | | before: max | 99.9 % | RMS | after: max | 99.9 % | RMS |
|---|---|---|---|---|---|---|---|
";

const DEPTHS: &str = "\
## Depth

In steps of 65536, against 65535·(z/w + 1)/2, *before* and *after* rounding to a whole step; the three populations
together. The error from the rounding of coefficients grows with far/(far − near) and with r/z.

| far ÷ near | | before: max | 99.9 % | RMS | after: max | 99.9 % | RMS | bound |
|---|---|---|---|---|---|---|---|---|
";

const FUNCTIONS: &str = "\
## Functions

The largest error met, powers of two rounded up to a tenth. The tests are those of `tests/bounds.rs`, which repeats
these measurements.

| function | error in units of | largest | bound | test |
|---|---|---|---|---|
";

const ELSEWHERE: &str = "
Bounds that other tests hold, with their own measurements:

| function | bound | test |
|---|---|---|
| `MeshInstance::project`, any projection, viewport and focal length | the budget in ARCHITECTURE.md, \"Numbers\" | `tests/camera/vertex_chain.rs`, `tests/camera/random_projections.rs` |
| `MeshInstance::project`, r/z > 300, 480 × 320 px, focal lengths to 700 px | 1/512 + 6.5·10⁻⁶·r/z px | `vertices_of_objects_beyond_300_times_their_distance` |
| `Camera::unproject` | half a sub-pixel and half a step, and `project`'s own error, carried back | `unproject_gives_the_projected_point_back` |
| `Camera::ray` | 2⁻¹⁵ and 2⁻²⁷ of the distance, and `project`'s own error, carried back | `unproject_gives_the_projected_point_back` |
| `Camera::visibility` | 2⁻²⁰ of size and distance, on the safe side | `s5_bounding_spheres_are_classified_as_their_vertices` |
| `Mesh::with_planes`: the eye behind a plane | known beyond 1/290 of the eye's distance or the mesh's largest coordinate, on the safe side | `faces_are_left_out_only_where_the_eye_is_behind_their_plane` |
| `MeshInstance::depth_tested`, between the corners | 0.54 step; beyond 512 px ½ + 2⁻¹³ + 2⁻¹⁷ a column and a row; 1.1 on the far plane | `d2_…` in `raster/depth.rs` |
| `MeshInstance::wireframe_depth_tested`, `hidden_line`: the depth of a line | ½ + n·2⁻¹⁷ + 2⁻¹³ step, n pixels from an end, at least 1; a line whose two ends lie in one pixel is tested by its nearer end | `depth_along_a_line_is_that_of_the_point_on_it` |
| `MeshInstance::hidden_line` | all of an edge in sight is drawn if the object is convex; otherwise 99.95 % of it, as the mean over edges, and one edge in 1000 lacks more than a tenth; 0.05 % of the drawn pixels have no edge in sight within a pixel | `tests/pipeline/hidden_lines.rs` |
| `Gouraud`, `Flat` | ½ + 2⁻⁹ level of the target's channel | `tests/shading/` |
| `Dithered`, mean of 8 × 8 pixels of one colour | 1/128 + 2⁻¹⁶ level | `tests/shading/dithered.rs` |
| `Mesh::bounding_sphere`, radius | √3 times the least, 9·2⁻¹⁶ and 2⁻²⁸ of itself | `s5_bounding_spheres` |
| `ViewTransform::from_matrix` | rows ½·2⁻³⁰, eye ½·2⁻³² and what f64 loses | `s3_a_view_from_its_matrix` |
| `Affine::to_matrix`, `Projection::to_matrix` and back | exact | `s2_a_matrix_read_back_is_the_same_transform`, `s4_a_projection_from_its_matrix` |
| `ViewTransform::isometric`, rows | 2⁻³² | `s4_isometric_rows` |
| `Quaternion` from micromath's, through `Affine::from_quaternion` | 2⁻²⁷ | `s2_quaternions_match_f64_and_micromath` |
| `Lambert::level` | 1 of 256 | `tests/shading/light.rs` |
| `Dim::dim` | ½ step of a channel | `levels_of_every_color_type_are_the_nearest` |
| `clip::line`, `clip::triangle` | 2⁻²⁷ of the largest coordinate | `tests/pipeline/view_volume.rs` |
| `raster` | none: exact | `tests/raster/fill_rule.rs`, `tests/raster/lines.rs`, `tests/raster/random_shapes.rs`, `tests/hard_cases/` |
";

/// The page and the plot of textures, or the bound that does not hold.
pub(crate) fn page() -> Result<(String, String), String> {
    // Each population has its own random numbers, so the order of threads changes nothing.
    let (sweeps, functions, textures) = std::thread::scope(|scope| {
        let sweeps = POPULATIONS.each_ref().map(|population| scope.spawn(|| sweep(population)));
        let (functions, textures) = (functions::all(), textures::measure());
        (sweeps.map(|thread| thread.join()), functions, textures)
    });
    let mut textures = textures?;
    let mut all = Vec::new();
    for result in sweeps {
        all.push(result.map_err(|_| "a sweep ended early".to_string())??);
    }
    let mut page = HEAD.to_string();
    let written = write_tables(&mut page, &mut all, &mut textures, &functions);
    written.map_err(|error| error.to_string())?;
    let broken = broken(&all, &functions).or_else(|| textures::broken(&textures));
    broken.map_or_else(|| Ok((page, textures::svg(&textures))), Err)
}

fn write_tables(
    page: &mut String,
    sweeps: &mut [Sweep],
    textures: &mut [textures::Measured],
    functions: &[Measured],
) -> Result<(), std::fmt::Error> {
    write!(page, "\n{}", CHAIN.replace("COUNT", &grouped(COUNT as u64)))?;
    for (population, sweep) in POPULATIONS.iter().zip(&*sweeps) {
        let (width, height) = population.size;
        let z = if population.nearest == 1 { "1".to_string() } else { format!("1/{}", population.nearest) };
        let (name, world, cameras) = (population.name, population.world, grouped(sweep.cameras as u64));
        writeln!(page, "| {name} | ±{world} | {z} | {width} × {height} | {cameras} |")?;
    }
    page.push_str(DRAWN);
    for (population, sweep) in POPULATIONS.iter().zip(&mut *sweeps) {
        for ((_, design, _), pair) in DESIGNS.into_iter().zip(&mut sweep.places) {
            writeln!(
                page,
                "| {} | {design} | {} | {} |",
                population.name,
                pair.before.cells(),
                pair.after.cells()
            )?;
        }
    }
    let steepest = sweeps.iter().fold(0f64, |a, s| a.max(s.per_ratio));
    writeln!(
        page,
        "\nBound, for all of them: 1/256 = 3.91·10⁻³ px after the snap (`tests/camera/vertex_chain.rs`). From r/z = 16 on a unit of r/z \
         costs at most {} px before the snap.\n",
        decimal(steepest)
    )?;
    page.push_str(DEPTHS);
    for (range, far) in RANGES.into_iter().enumerate() {
        for (size, objects) in ["points and r/z ≤ 16", "r/z ≤ 300"].into_iter().enumerate() {
            let mut both = Pair::default();
            for sweep in &mut *sweeps {
                both.append(std::mem::take(&mut sweep.depths[range][size]));
            }
            let bound = if far >= DEEP { "1" } else { "–" };
            writeln!(
                page,
                "| {far} | {objects} | {} | {} | {bound} |",
                both.before.cells(),
                both.after.cells()
            )?;
            for sweep in &mut *sweeps {
                sweep.deepest = sweep.deepest.max(if far >= DEEP { both.after.largest() } else { 0.0 });
            }
        }
    }
    page.push_str(
        "\nThe bound is asserted in `tests/camera/vertex_chain.rs`, for perspectives and boxes alike.\n\n",
    );
    page.push_str(&textures::text(textures));
    page.push_str(FUNCTIONS);
    for Measured { what, unit, error, bound, test } in functions {
        // Depth steps in decimal, other errors as powers of two.
        let number = |v: f64| if *bound >= 0.25 { format!("{v:.5}") } else { binary(v) };
        let bound = if *bound == 0.0 { "exact".to_string() } else { number(*bound) };
        writeln!(page, "| {what} | {unit} | {} | {bound} | `{test}` |", number(*error))?;
    }
    page.push_str(ELSEWHERE);
    Ok(())
}

/// A bound that does not hold.
fn broken(sweeps: &[Sweep], functions: &[Measured]) -> Option<String> {
    let places = sweeps.iter().flat_map(|s| &s.places).map(|pair| pair.after.largest());
    let place = places.fold(0.0, f64::max);
    let depth = sweeps.iter().map(|s| s.deepest).fold(0.0, f64::max);
    if place > PLACE {
        return Some(format!("a vertex is {place} px off, the bound is {PLACE}"));
    }
    if depth > DEPTH {
        return Some(format!("a depth is {depth} steps off, the bound is {DEPTH}"));
    }
    let wrong = functions.iter().find(|m| m.error > m.bound)?;
    Some(format!("{}: {} off, the bound is {}", wrong.what, binary(wrong.error), binary(wrong.bound)))
}
