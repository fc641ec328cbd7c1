//! A foreign DrawTarget: what it refuses comes back unchanged, whenever it does; everything leaves as fills. Nothing
//! outside viewport ∩ target is written: `hard_cases`, E9.

mod bridge;
mod oracle;

use bridge::draw::{cube_camera as camera, turned_cube as draw, Ink, CUBE, CUBE_FACES, WAYS};
use bridge::pair::ModelBits;
use oracle::target::{Call, Recorder, Refused};
use pinhole::{Mesh, Painter};

#[test]
fn what_the_target_refuses_comes_back_at_every_call() {
    let camera = camera((0, 0, 40, 30));
    for way in WAYS {
        let mut whole = Recorder::sized(40, 30);
        draw(way, &camera, &mut whole).expect("no error");
        let calls = whole.calls.len();
        assert!(calls > 10, "{way:?}");
        for n in 0..calls {
            let mut target = Recorder::failing(40, 30, n);
            assert_eq!(draw(way, &camera, &mut target).err(), Some(Refused(n)), "{way:?}");
            // It stops right there, and what came before is the same.
            assert_eq!(target.calls, whole.calls[..=n], "{way:?}");
        }
        let mut target = Recorder::failing(40, 30, calls);
        assert!(draw(way, &camera, &mut target).is_ok());
    }
}

#[test]
fn everything_leaves_as_fills() {
    for way in WAYS {
        let mut target = Recorder::sized(40, 30);
        draw(way, &camera((0, 0, 40, 30)), &mut target).expect("no error");
        assert!(!target.pixel_by_pixel(), "{way:?}");
        for call in &target.calls {
            match call {
                Call::Solid(area, _) => {
                    assert!(area.size.width >= 1 && area.size.height >= 1, "{area:?}");
                }
                Call::Contiguous(area, n) => {
                    assert_eq!(area.size.width as usize * area.size.height as usize, *n);
                }
                other => panic!("{way:?}: {other:?}"),
            }
        }
    }
}

#[test]
fn a_painter_serves_again_after_a_target_failed() {
    let camera = camera((0, 0, 40, 30));
    let mesh = Mesh::new(&CUBE, 0, &CUBE_FACES).expect("a mesh");
    let model = ModelBits::default().library();
    let camera = camera.library();
    let placed = camera.place(&mesh, &model);
    let mut painter = Painter::<Ink, 64, 64>::new();
    painter.add(&placed, |_| Ink(1)).expect("enough room");
    let mut whole = Recorder::sized(40, 30);
    let statistics = painter.draw(&mut whole).expect("no error");
    for n in 0..whole.calls.len() {
        painter.clear();
        painter.add(&placed, |_| Ink(1)).expect("enough room");
        let mut target = Recorder::failing(40, 30, n);
        assert_eq!(painter.draw(&mut target).err(), Some(Refused(n)));
    }
    painter.clear();
    painter.add(&placed, |_| Ink(1)).expect("enough room");
    let mut target = Recorder::sized(40, 30);
    assert_eq!(painter.draw(&mut target), Ok(statistics));
    assert_eq!(target.calls, whole.calls);
}
