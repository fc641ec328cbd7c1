//! Screen-door transparency: which pixels are drawn, against the recursive definition of Bayer's matrix.

use crate::levels::rank;
use crate::rays::{everywhere, floor, in_memory, Faces, AREA, SKY};
use embedded_graphics::pixelcolor::{Rgb888, RgbColor};
use embedded_graphics::primitives::PointsIter;
use pinhole::{DepthBuffer, Gouraud, ScreenDoor};
use support::oracle::rng::Rng;

#[test]
fn the_pixels_of_low_ranks_are_drawn_with_their_depth() {
    let scene = Faces::quad(floor(0.5, 9.5, 6.0), 25.0, 40, -10);
    let shade = |face: usize| {
        let [a, b, c] = [[9, 200, 40], [250, 3, 77], [20, 90, 255]].map(|[r, g, b]| Rgb888::new(r, g, b));
        Gouraud::new(if face == 0 { [a, b, c] } else { [a, c, b] })
    };
    let full = in_memory(&scene, &shade);
    assert!(full.deep.iter().filter(|&&pixel| pixel != SKY).count() > 10_000);
    for coverage in [0, 1, 7, 16, 32, 33, 48, 63, 64, 200] {
        let drawn = everywhere(&scene, &|face| ScreenDoor::new(shade(face), coverage));
        for (i, at) in AREA.points().enumerate() {
            let is_drawn = rank(at) < i128::from(coverage);
            let wanted = if is_drawn { (full.deep[i], full.depths[i]) } else { (SKY, DepthBuffer::NOTHING) };
            assert_eq!((drawn.deep[i], drawn.depths[i]), wanted, "{at}, {coverage} of 64");
            assert_eq!(drawn.solid[i], if is_drawn { full.solid[i] } else { SKY });
        }
    }
}

/// Plain colours, faces of any shape: of two faces with one coverage the nearer hides the other.
#[test]
fn of_faces_with_equal_coverage_the_nearer_is_seen() {
    let scene = Faces::soup(&mut Rng::new(9), 120, 1200, 3000, |_| 0);
    let color = |face: usize| Rgb888::new(face as u8, 255 - face as u8, 100);
    let full = in_memory(&scene, &color);
    let drawn = everywhere(&scene, &|face| ScreenDoor::new(color(face), 40));
    for (i, at) in AREA.points().enumerate() {
        assert_eq!(drawn.deep[i], if rank(at) < 40 { full.deep[i] } else { SKY });
    }
    // Where coverages differ, what is behind shows through.
    let mixed = everywhere(&scene, &|face| ScreenDoor::new(color(face), if face % 2 == 0 { 20 } else { 64 }));
    let through =
        mixed.deep.iter().zip(&full.deep).filter(|(mixed, full)| mixed.r() % 2 == 1 && full.r() % 2 == 0);
    assert!(through.count() > 1000);
}
