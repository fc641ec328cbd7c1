//! Faces in an order in which neighbours follow each other, and vertices in the order of their first use.
//!
//! A renderer that transforms every vertex once, as pinhole does, reads the vertices from one end to the other; what it then
//! gathers for each face are the transformed corners, 8 bytes each. Where the memory has a cache (external RAM, flash behind
//! a prefetcher), a corner used a moment ago costs nothing.

use crate::surface::{Surface, MOST_VERTICES};
use crate::{clusters, Options, Step};

/// Corners that the orders are judged and made for: 128 bytes of them, a few lines of a small cache.
const CACHE: usize = 16;

/// Orders faces and vertices as the options say, by neighbours if that lowers the fetches. Returns those before and after.
pub(crate) fn order(surface: &mut Surface, options: &Options, begins: &mut dyn FnMut(Step)) -> [f64; 2] {
    let fetched = |surface: &Surface| fetches(&surface.faces, surface.vertices.len());
    let before = fetched(surface);
    if surface.vertices.len() > MOST_VERTICES {
        return [before; 2]; // refused later
    }
    if options.reorder {
        begins(Step::Order);
        let places = by_neighbours(&surface.faces, surface.vertices.len());
        let ordered: Vec<[usize; 3]> = places.iter().map(|&place| surface.faces[place]).collect();
        if fetches(&ordered, surface.vertices.len()) < before {
            put(&places, surface);
        }
    }
    if cfg!(feature = "clusters") && options.clusters {
        put(&clusters::order(&surface.faces, &surface.vertices), surface);
    }
    [before, fetched(surface)]
}

/// Puts faces into an order, and vertices into that of their first use.
fn put(places: &[usize], surface: &mut Surface) {
    let Surface { vertices, faces, triangles, coords, .. } = surface;
    let ordered: Vec<[usize; 3]> = places.iter().map(|&place| faces[place]).collect();
    let new = by_first_use(&ordered, vertices.len());
    *faces = ordered.into_iter().map(|face| face.map(|v| new[v])).collect();
    *triangles = places.iter().map(|&place| triangles[place]).collect();
    *coords = places.iter().filter_map(|&place| coords.get(place).copied()).collect();
    let mut moved = vec![[0; 3]; vertices.len()];
    for (vertex, &place) in vertices.iter().zip(&new) {
        moved[place] = *vertex;
    }
    *vertices = moved;
}

/// The places of the faces in their new order: the fan about one vertex after the other, where the next vertex is one
/// of those just used that will still be in a cache of [`CACHE`] corners when all its faces are drawn, the one that has been
/// there longest; else the last used that has faces left; else the first (Sander, Nehab and Barczak 2007, section 3).
fn by_neighbours(faces: &[[usize; 3]], vertices: usize) -> Vec<usize> {
    let around = Around::new(faces, vertices);
    let mut left: Vec<usize> = (0..vertices).map(|v| around.faces(v).len()).collect();
    let mut drawn = vec![false; faces.len()];
    // When each vertex entered the cache; the clock starts where nothing is in it.
    let mut entered = vec![0; vertices];
    let mut clock = CACHE + 1;
    let mut used = Vec::new();
    let mut first_left = 0;
    let mut order = Vec::with_capacity(faces.len());
    let mut next = (vertices > 0).then_some(0);
    while let Some(centre) = next {
        let mut fan = Vec::new();
        for &face in around.faces(centre) {
            if std::mem::replace(&mut drawn[face], true) {
                continue;
            }
            order.push(face);
            for vertex in faces[face] {
                fan.push(vertex);
                left[vertex] -= 1;
                if clock - entered[vertex] > CACHE {
                    entered[vertex] = clock;
                    clock += 1;
                }
            }
        }
        used.extend(&fan);
        // Each face that is left brings in two vertices at most.
        let stays = |v: &usize| clock - entered[*v] + 2 * left[*v] <= CACHE;
        let age = |v: &usize| if stays(v) { clock - entered[*v] } else { 0 };
        let best = fan.into_iter().filter(|&v| left[v] > 0).rev().max_by_key(age);
        next = best.or_else(|| {
            while let Some(vertex) = used.pop() {
                if left[vertex] > 0 {
                    return Some(vertex);
                }
            }
            first_left += left[first_left..].iter().position(|&n| n > 0)?;
            Some(first_left)
        });
    }
    order
}

/// The faces about each vertex.
struct Around {
    starts: Vec<usize>,
    faces: Vec<usize>,
}

impl Around {
    fn new(faces: &[[usize; 3]], vertices: usize) -> Self {
        let mut starts = vec![0; vertices + 1];
        for &vertex in faces.iter().flatten() {
            starts[vertex + 1] += 1;
        }
        for vertex in 0..vertices {
            starts[vertex + 1] += starts[vertex];
        }
        let mut next = starts.clone();
        let mut list = vec![0; faces.len() * 3];
        for (face, corners) in faces.iter().enumerate() {
            for &vertex in corners {
                let next = &mut next[vertex];
                list[*next] = face;
                *next += 1;
            }
        }
        Around { starts, faces: list }
    }

    fn faces(&self, vertex: usize) -> &[usize] {
        &self.faces[self.starts[vertex]..self.starts[vertex + 1]]
    }
}

/// How many vertices a face fetches, on average, with a first-in-first-out cache of [`CACHE`] of them: 3 at worst, about
/// ½ at best in a large closed mesh, which has half as many vertices as faces.
fn fetches(faces: &[[usize; 3]], vertices: usize) -> f64 {
    let mut entered = vec![0; vertices];
    let mut clock = CACHE + 1;
    let start = clock;
    for &vertex in faces.iter().flatten() {
        if clock - entered[vertex] > CACHE {
            entered[vertex] = clock;
            clock += 1;
        }
    }
    (clock - start) as f64 / faces.len().max(1) as f64
}

/// For each vertex its place by first use. All vertices are used.
fn by_first_use(faces: &[[usize; 3]], vertices: usize) -> Vec<usize> {
    let mut places = vec![None; vertices];
    let mut next = 0;
    for &vertex in faces.iter().flatten() {
        let place = &mut places[vertex];
        if place.is_none() {
            *place = Some(next);
            next += 1;
        }
    }
    places.into_iter().map(Option::unwrap_or_default).collect()
}
