//! Screen-door transparency: which pixels are drawn, against the recursive definition of Bayer's matrix.

use crate::every_target::{on_every_target, SKY};
use crate::textures::{floor, quad, soup, SIDE};
use embedded_graphics::pixelcolor::{Rgb888, RgbColor};
use pinhole::{DepthBuffer, Gouraud, ScreenDoor};

/// Bayer's matrix of 2^n × 2^n ranks: 4 times the matrix of half the size in each quarter, plus 0, 2, 3 and 1.
fn bayer(n: u32) -> Vec<Vec<u32>> {
    if n == 0 {
        return vec![vec![0]];
    }
    let quarter = bayer(n - 1);
    let half = quarter.len();
    let rank = |x: usize, y: usize| 4 * quarter[y % half][x % half] + [[0, 2], [3, 1]][y / half][x / half];
    (0..2 * half).map(|y| (0..2 * half).map(|x| rank(x, y)).collect()).collect()
}

#[test]
fn the_pixels_of_low_ranks_are_drawn_with_their_depth() {
    let ranks = bayer(3);
    let scene = quad(floor(0.5, 9.5, 6.0), 25.0, 40, -10);
    let shade = |face: usize| {
        let [a, b, c] = [[9, 200, 40], [250, 3, 77], [20, 90, 255]].map(|[r, g, b]| Rgb888::new(r, g, b));
        Gouraud::new(if face == 0 { [a, b, c] } else { [a, c, b] })
    };
    let full = on_every_target(&scene, &shade);
    assert!(full.deep.iter().filter(|&&pixel| pixel != SKY).count() > 10_000);
    for coverage in [0, 1, 7, 16, 32, 33, 48, 63, 64, 200] {
        let drawn = on_every_target(&scene, &|face| ScreenDoor::new(shade(face), coverage));
        for i in 0..full.deep.len() {
            let (x, y) = (i % SIDE as usize, i / SIDE as usize);
            let is_drawn = ranks[y % 8][x % 8] < u32::from(coverage);
            let wanted = if is_drawn { (full.deep[i], full.depths[i]) } else { (SKY, DepthBuffer::NOTHING) };
            assert_eq!((drawn.deep[i], drawn.depths[i]), wanted, "({x}, {y}), {coverage} of 64");
            assert_eq!(drawn.solid[i], if is_drawn { full.solid[i] } else { SKY });
        }
    }
}

/// Plain colours, faces of any shape: of two faces with one coverage the nearer hides the other.
#[test]
fn of_faces_with_equal_coverage_the_nearer_is_seen() {
    let ranks = bayer(3);
    let scene = soup(9, 1200, 1);
    let color = |face: usize| Rgb888::new(face as u8, 255 - face as u8, 100);
    let full = on_every_target(&scene, &color);
    let drawn = on_every_target(&scene, &|face| ScreenDoor::new(color(face), 40));
    for i in 0..full.deep.len() {
        let is_drawn = ranks[i / SIDE as usize % 8][i % SIDE as usize % 8] < 40;
        assert_eq!(drawn.deep[i], if is_drawn { full.deep[i] } else { SKY });
    }
    // Where coverages differ, what is behind shows through.
    let mixed =
        on_every_target(&scene, &|face| ScreenDoor::new(color(face), if face % 2 == 0 { 20 } else { 64 }));
    let through =
        mixed.deep.iter().zip(&full.deep).filter(|(mixed, full)| mixed.r() % 2 == 1 && full.r() % 2 == 0);
    assert!(through.count() > 1000);
}
