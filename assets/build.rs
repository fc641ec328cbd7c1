//! Makes the arrays of `lib.rs` from `teapot.obj`. `pinhole-import` makes equal arrays, which its tests compare, but the examples would
//! wait for its compilation.

use std::collections::{BTreeSet, HashMap};

/// Steps of a coordinate in a unit of the file: the finest power of two with which all coordinates fit 16 bits.
const EXPONENT: i32 = -10;

fn main() {
    println!("cargo::rerun-if-changed=teapot.obj");
    let file = std::fs::read_to_string("teapot.obj").expect("teapot.obj");
    let rows = |start: &'static str| {
        let lines = file.lines().filter_map(move |line| line.strip_prefix(start));
        let number = |word: &str| word.parse().expect("a number");
        lines.map(move |line| line.split(' ').map(number).collect::<Vec<f64>>())
    };
    let rounded = |c: &f64| (c * f64::from(-EXPONENT).exp2()).round() as i16;
    let read: Vec<Vec<i16>> = rows("v ").map(|row| row.iter().map(rounded).collect()).collect();

    // Vertices at one place are one, numbered by their first use.
    let (mut vertices, mut numbers, mut edges) = (Vec::new(), HashMap::new(), BTreeSet::new());
    let (mut faces, mut normals) = (Vec::new(), Vec::new());
    for row in rows("f ") {
        let [a, b, c] = [0, 1, 2].map(|corner| &read[row[corner] as usize - 1]);
        let [i, j, k] = [a, b, c].map(|vertex| {
            *numbers.entry(vertex).or_insert_with(|| {
                vertices.push(vertex);
                vertices.len() - 1
            })
        });
        faces.push([i, j, k]);
        edges.extend([[i, j], [j, k], [k, i]].map(|[from, to]| [from.min(to), from.max(to)]));
        let side = |to: &[i16], axis: usize| f64::from(to[axis]) - f64::from(a[axis]);
        let cross = [(1, 2), (2, 0), (0, 1)].map(|(x, y)| side(b, x) * side(c, y) - side(b, y) * side(c, x));
        let length = cross.iter().map(|c| c * c).sum::<f64>().sqrt();
        normals.push(cross.map(|c| (c / length * 32767.0).round() as i16));
    }
    let source = format!(
        "pub const EXPONENT: i8 = {EXPONENT};\npub const VERTICES: [[i16; 3]; {}] = {vertices:?};\n\
         pub const FACES: [[u16; 3]; {}] = {faces:?};\npub const EDGES: [[u16; 2]; {}] = {edges:?};\n\
         pub const NORMALS: [[i16; 3]; {}] = {normals:?};\n",
        vertices.len(),
        faces.len(),
        edges.len(),
        normals.len(),
    )
    // A set is written in braces.
    .replace('{', "[")
    .replace('}', "]");
    let out = std::env::var("OUT_DIR").expect("cargo sets OUT_DIR");
    std::fs::write(format!("{out}/teapot.rs"), source).expect("OUT_DIR can be written");
}
