//! A cube, solid and as a wireframe, by the library and by the oracles: the exact corners snapped, then exact coverage and exact
//! lines.

use pinhole::space::{Model, World};
use pinhole::{Affine, Camera, Mesh, Painter};
use std::collections::BTreeSet;
use support::bridge::draw::{solid, wireframe, Shader, CUBE_EDGES, CUBE_FACES};
use support::oracle::chain::snap;
use support::oracle::coverage::{covers, edge, Area};
use support::oracle::line;
use support::oracle::target::Recorder;

pub(crate) struct Picture {
    pub(crate) camera: Camera,
    pub(crate) model: Affine<Model, World>,
    pub(crate) vertices: [[i16; 3]; 8],
    /// The vertices on the screen, by the oracle.
    pub(crate) exact: Vec<(f64, f64)>,
    pub(crate) size: (u32, u32),
    /// Of the sides, each of two faces.
    pub(crate) letters: &'static [u8; 6],
}

impl Picture {
    fn letter(&self, face: usize) -> char {
        char::from(self.letters[face / 2 % 6])
    }

    /// Solid and wireframe as the oracles draw them, after the library has drawn the same.
    pub(crate) fn as_the_oracle(&self) -> [String; 2] {
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
        painter.add(&instance, |face| Shader(face as u16)).expect("room");
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
