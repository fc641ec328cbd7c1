//! A picture in memory, some rows of one, drawn at once, a firmware each: lit faces without depth and with it, a
//! scene of twelve objects with depth, and anti-aliased lines.
#![cfg_attr(target_os = "none", no_std, no_main)]
use bench::image::prelude::*;

/// The firmware that is built.
const IMAGE: &str = env!("CARGO_BIN_NAME");
/// The number of objects in the scene, and of depths in the depth buffer.
const IS_SCENE: bool = is_equal(IMAGE, "flash_scene");
const OBJECTS: usize = if IS_SCENE { 12 } else { 0 };
const DEPTHS: usize = if IS_SCENE || is_equal(IMAGE, "flash_depth_picture") { pixels(ROWS) } else { 0 };

image!(
    cube,
    corners: [ScreenVertex; CORNERS] = [ScreenVertex::EMPTY; CORNERS],
    memory: [Rgb565; pixels(ROWS)] = [scene::BACKGROUND; pixels(ROWS)],
    storage: [u16; DEPTHS] = [0; DEPTHS],
    objects: pinhole::draw::Scene<'static, Rgb565, OBJECTS> = pinhole::draw::Scene::new(),
    {
        let scene = Turntable::turned();
        let size = black_box(Size::new(scene::SIZE, ROWS));
        let instance = scene.place(cube);
        let mut picture = Picture::new(memory, size).ok()?;
        let target = &mut picture.pixels();
        match IMAGE {
            "flash_picture" => {
                let light = scene.rigid_light()?;
                let Ok(_) = instance.faces(scene::flat(&cube.mesh, |normal| light.level(normal))).cached(corners).draw(target);
            }
            "flash_depth_picture" => {
                let light = scene.light();
                let light = light.as_ref()?;
                let shade = scene::flat(&cube.mesh, |normal| light.level(normal));
                let mut depth = DepthBuffer::new(Rectangle::new(Point::zero(), size), storage).ok()?;
                let Ok(_) = instance.faces(shade).cached(corners).draw(&mut target.depth_tested(&mut depth));
            }
            "flash_scene" => {
                objects.clear();
                while objects.add(Object::new(&cube.mesh, scene.model, scene::LINE)).is_ok() {}
                let mut depth = DepthBuffer::new(Rectangle::new(Point::zero(), size), storage).ok()?;
                let placed = objects.place(scene.camera());
                let target = &mut target.depth_tested(&mut depth);
                let Ok(_) = placed.draw(|_, object| |_| object.material, corners, target);
            }
            "flash_wireframe_smooth" => {
                let Ok(_) = instance.edges(|_| AntiAliased(scene::LINE)).cached(corners).draw(target);
            }
            _ => return None,
        }
        black_box(picture.colors());
        Some(())
    }
);
