//! embedded-3dgfx: record and execute with depth, record and draw without, `draw` in 2D.
#![cfg_attr(target_os = "none", no_std, no_main)]

use bench::board::{println, Clock};
use bench::cells::{count_by, Counted, Frame, Picture};
use bench::firmware;
use bench::lists::{COLOURS, LINES, SCREEN, TRIANGLES};
use bench::scene::{LINE, SIZE};
use core::f32::consts::PI;
use core::hint::black_box;
use core::iter::once;
use embedded_3dgfx::pipeline::command_buffer::RenderCommand;
use embedded_3dgfx::pipeline::rasterize::draw::draw;
use embedded_3dgfx::prelude::{
    CommandBuffer, DrawPrimitive, FrameCtx, Geometry, K3dMesh, K3dengine, RenderMode,
};
use embedded_graphics::pixelcolor::raw::RawU16;
use nalgebra::{Matrix4, Point2, Point3, Vector3};
use rivals::models::{Model, CUBE, ICO, LIGHT, TORUS};
use rivals::target::Framebuffer;

const PIXELS: usize = (SIZE * SIZE) as usize;

struct Memory {
    frame: Frame,
    depth: [u16; PIXELS],
    commands: CommandBuffer<2048>,
}

impl Memory {
    const NEW: Self = Self { frame: Frame::NEW, depth: [0; PIXELS], commands: CommandBuffer::new() };
}

firmware!(memory: Memory = Memory::NEW, {
    let mut clock = Clock::new()?;
    let [x, y, z] = LIGHT;
    // It turns z over.
    let light = Vector3::new(x, y, -z);
    let flat = RenderMode::SolidLightDir(light);
    let clock = &mut clock;
    tell("S1,plain", mesh(&CUBE, RenderMode::Lines, false, memory, clock)?);
    for (plain, deep, model) in [("S2,plain", "S2,z", &CUBE), ("S3,plain", "S3,z", &TORUS), ("S4,plain", "S4,z", &ICO)] {
        tell(plain, mesh(model, flat.clone(), false, memory, clock)?);
        tell(deep, mesh(model, flat.clone(), true, memory, clock)?);
    }
    tell("S5,plain", flat_triangle(&mut memory.frame, clock)?);
    tell("S6,plain", lines(&mut memory.frame, clock)?);
    tell("S7,plain", triangles(&mut memory.frame, clock)?);
    tell("S8,z", mesh(&TORUS, RenderMode::GouraudLightDir(light), true, memory, clock)?);
    Some(())
});

/// The line that `report` reads: `scene,variant,instructions,drawn`.
fn tell(cell: &str, Counted { instructions, drawn, .. }: Counted) {
    println!("{cell},{instructions},{drawn}");
}

#[inline(never)]
fn mesh(
    model: &'static Model,
    mode: RenderMode,
    deep: bool,
    memory: &mut Memory,
    clock: &mut Clock,
) -> Option<Counted> {
    let size = black_box(SIZE as u16);
    let mut engine = K3dengine::new(size, size);
    engine.camera.set_fovy(black_box(PI / 3.0));
    engine.camera.set_near_far(0.5, 20.0);
    engine.camera.set_position(Point3::new(0.0, 0.0, model.distance));
    engine.camera.set_target(Point3::origin());
    engine.set_depth_clear_enabled(deep);
    let Model { vertices, faces, edges, normals, vertex_normals, rotation, .. } = black_box(model);
    let geometry = Geometry::new(vertices, faces).with_normals(normals).with_vertex_normals(vertex_normals);
    let mut mesh = K3dMesh::new(geometry.with_lines(edges));
    mesh.model_matrix = Matrix4::identity();
    mesh.model_matrix
        .fixed_view_mut::<3, 3>(0, 0)
        .copy_from(&nalgebra::Matrix3::from_fn(|r, c| rotation[r][c]));
    mesh.set_color(LINE);
    mesh.set_render_mode(mode);
    let Memory { frame, depth, commands } = memory;
    count_by(clock, frame, &mut |picture| {
        let (engine, mut target) = (black_box(&engine), Framebuffer(picture));
        engine.record(once(black_box(&mesh)), commands, None).ok()?;
        if deep {
            let mut whole = FrameCtx { zbuffer: depth, width: size.into(), height: size.into() };
            engine.execute(&mut target, &mut whole, commands, None).ok()?;
        } else {
            for command in commands.iter() {
                if let RenderCommand::Draw(primitive) = command {
                    draw(primitive.clone(), &mut target);
                }
            }
        }
        Some(())
    })
}

#[inline(never)]
fn flat_triangle(frame: &mut Frame, clock: &mut Clock) -> Option<Counted> {
    count_by(clock, frame, &mut |picture| {
        fill(black_box(&SCREEN), black_box(LINE), picture);
        Some(())
    })
}

#[inline(never)]
fn lines(frame: &mut Frame, clock: &mut Clock) -> Option<Counted> {
    count_by(clock, frame, &mut |picture| {
        let (colour, mut target) = (black_box(LINE), Framebuffer(picture));
        for &[x0, y0, x1, y1] in black_box(&LINES) {
            draw(DrawPrimitive::Line([point(x0, y0), point(x1, y1)], colour), &mut target);
        }
        Some(())
    })
}

#[inline(never)]
fn triangles(frame: &mut Frame, clock: &mut Clock) -> Option<Counted> {
    count_by(clock, frame, &mut |picture| {
        for (triangle, &colour) in black_box(&TRIANGLES).iter().zip(black_box(&COLOURS)) {
            fill(triangle, RawU16::new(colour).into(), picture);
        }
        Some(())
    })
}

#[inline(always)]
fn fill(
    &[ax, ay, bx, by, cx, cy]: &[i16; 6],
    colour: embedded_graphics::pixelcolor::Rgb565,
    picture: &mut Picture<'_>,
) {
    let corners = [point(ax, ay), point(bx, by), point(cx, cy)];
    draw(DrawPrimitive::ColoredTriangle(corners, colour), &mut Framebuffer(picture));
}

fn point(x: i16, y: i16) -> Point2<i32> {
    Point2::new(x.into(), y.into())
}
