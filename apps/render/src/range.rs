//! Refuses scenes of which the crate's number formats lose what is seen.
//!
//! A coordinate keeps 30 bits of the largest number, so one number that is far larger than the others takes their bits.

use crate::scene::Scene;
use crate::sprites::SceneSprites;

/// Pixels by which rounding may move all corners of what is seen of a triangle, or a sprite.
const FARTHEST: f64 = 8.0;

/// A clip point of the scene, and of the scene in the crate's formats.
type Pair = [[f64; 4]; 2];

/// Checks that rounding has moved nothing that is seen by more than [`FARTHEST`] pixels. The error names the largest number.
pub(crate) fn check(scene: &Scene, used: &Scene) -> Result<(), String> {
    let pairs: Vec<Pair> =
        scene.vertices.iter().zip(&used.vertices).map(|(&a, &b)| [scene.clip(a), used.clip(b)]).collect();
    let moved = |&[a, b]: &Pair| {
        if b[3] <= 0.0 {
            return f64::INFINITY;
        }
        let ([x, y], [rounded_x, rounded_y]) = (scene.screen(a), used.screen(b));
        (x - rounded_x).hypot(y - rounded_y)
    };
    let is_kept = |pair: &Pair| sides(pair).iter().all(|&side| side >= 0.0) && moved(pair) <= FARTHEST;
    let kept: Vec<bool> = pairs.iter().map(is_kept).collect();
    let is_lost = |triangle: &[usize; 3]| {
        if triangle.iter().any(|&corner| kept[corner]) {
            return false;
        }
        let seen = in_view(triangle.map(|corner| pairs[corner]));
        !seen.is_empty() && seen.iter().all(|corner| moved(corner) > FARTHEST)
    };
    let lost = scene.triangles.iter().position(is_lost).map(|number| format!("triangle {number}"));
    let points = |scene: &Scene| -> Vec<[f64; 4]> {
        scene
            .sprites
            .iter()
            .flat_map(|entry| &entry.points)
            .map(|&point| scene.clip_of_world(point))
            .collect()
    };
    let sprites = || {
        let pairs = points(scene).into_iter().zip(points(used)).map(|(a, b)| [a, b]);
        let mut seen = pairs.filter(|pair| sides(pair).iter().all(|&side| side > 0.0));
        seen.any(|pair| moved(&pair) > FARTHEST).then(|| "a sprite".into())
    };
    match lost.or_else(sprites) {
        None => Ok(()),
        Some(what) => Err(format!(
            "{} leaves the range: coordinates keep 30 bits of the largest one, so rounding moves {what} by more than {FARTHEST} \
             pixels",
            largest(scene)
        )),
    }
}

/// The signed distances of a clip point from the sides of the view volume: none is negative inside.
fn sides(&[[x, y, z, w], _]: &Pair) -> [f64; 6] {
    [w + x, w - x, w + y, w - y, w + z, w - z]
}

/// The corners of the part of a triangle in the view volume (Sutherland and Hodgman, *Reentrant polygon clipping*, 1974).
fn in_view(triangle: [Pair; 3]) -> Vec<Pair> {
    let mut polygon = triangle.to_vec();
    for side in 0..6 {
        let mut cut = Vec::new();
        for (place, to) in polygon.iter().enumerate() {
            let from = &polygon[(place + polygon.len() - 1) % polygon.len()];
            let (a, b) = (sides(from)[side], sides(to)[side]);
            if (a < 0.0) != (b < 0.0) {
                let between = |k: usize, i: usize| from[k][i] + (to[k][i] - from[k][i]) * (a / (a - b));
                cut.push([0, 1].map(|k| [0, 1, 2, 3].map(|i| between(k, i))));
            }
            if b >= 0.0 {
                cut.push(*to);
            }
        }
        polygon = cut;
    }
    polygon
}

/// The number of a scene that is largest in the world, and its place in the file.
fn largest(scene: &Scene) -> String {
    let number = |name: String, number: f64, in_the_world: f64| (in_the_world.abs(), name, number);
    let vertices = scene.vertices.iter().enumerate().flat_map(|(index, vertex)| {
        (0..3).map(move |axis| {
            let factor = (0..3).map(|row| scene.model[row][axis].abs()).fold(0.0, f64::max);
            number(format!("vertices[{index}][{axis}]"), vertex[axis], vertex[axis] * factor)
        })
    });
    let place = |name: &'static str, matrix: &[[f64; 4]; 4]| {
        [0, 1, 2].map(|row| number(format!("{name}[{row}][3]"), matrix[row][3], matrix[row][3]))
    };
    let sprites = scene.sprites.iter().flat_map(SceneSprites::world_numbers);
    let sprites = sprites.map(|c| number("sprites".into(), c, c));
    let fog = scene.fog.and_then(|fog| fog.range).into_iter().flatten().map(|c| number("fog".into(), c, c));
    let places = place("model", &scene.model).into_iter().chain(place("view", &scene.view));
    let largest = vertices.chain(places).chain(sprites).chain(fog).max_by(|a, b| a.0.total_cmp(&b.0));
    largest.map_or_else(String::new, |(_, name, number)| format!("{name}: {number:e}"))
}
