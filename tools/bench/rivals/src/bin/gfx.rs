//! embedded-3dgfx: record and execute with depth, record and draw without, `draw` in 2D.
#![cfg_attr(target_os = "none", no_std, no_main)]

use bench::board::{println, Clock};
use bench::cells::{Counted, Frame};
use bench::firmware;
use bench::lists::{COLOURS, LINES, SCREEN, TRIANGLES};
use bench::scene::{LINE, SIZE};
use core::convert::Infallible;
use core::f32::consts::PI;
use core::hint::black_box;
use core::iter::once;
use embedded_3dgfx::pipeline::command_buffer::RenderCommand;
use embedded_3dgfx::pipeline::rasterize::draw::draw;
use embedded_3dgfx::prelude::{
    CommandBuffer, DrawPrimitive, FrameCtx, Geometry, K3dMesh, K3dengine, RenderMode,
};
use embedded_3dgfx::ZDepth;
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::OriginDimensions;
use embedded_graphics::pixelcolor::raw::RawU16;
use embedded_graphics::pixelcolor::Rgb565;
use nalgebra::{Matrix4, Point2, Point3, Vector3};
use rivals::models::{Model, CUBE, ICO, LIGHT, TORUS};
use rivals::target::{count, Work};

const PIXELS: usize = (SIZE * SIZE) as usize;

struct Memory {
    frame: Frame,
    depth: [ZDepth; PIXELS],
    commands: CommandBuffer<2048>,
}

impl Memory {
    const NEW: Self = Self { frame: Frame::NEW, depth: [0; PIXELS], commands: CommandBuffer::new() };
}

/// Distances of the eye in C1 and C2.
const NEAR: f32 = 0.8;
const FARTHER: f32 = 1.2;

firmware!(memory: Memory = Memory::NEW, {
    let mut clock = Clock::new()?;
    let [x, y, z] = LIGHT;
    // It turns z over.
    let light = Vector3::new(x, y, -z);
    let flat = RenderMode::SolidLightDir(light);
    let clock = &mut clock;
    for (cell, model, distance) in [
        ("S1,plain", &CUBE, CUBE.distance),
        ("S3,wire", &TORUS, TORUS.distance),
        ("C1,wire", &TORUS, NEAR),
        ("C2,wire", &TORUS, FARTHER),
    ] {
        tell(cell, mesh(model, distance, RenderMode::Lines, false, memory, clock)?);
    }
    for (plain, deep, model, distance) in [
        ("S2,plain", "S2,z", &CUBE, CUBE.distance),
        ("S3,plain", "S3,z", &TORUS, TORUS.distance),
        ("S4,plain", "S4,z", &ICO, ICO.distance),
        ("C1,plain", "C1,z", &TORUS, NEAR),
        ("C2,plain", "C2,z", &TORUS, FARTHER),
    ] {
        tell(plain, mesh(model, distance, flat.clone(), false, memory, clock)?);
        tell(deep, mesh(model, distance, flat.clone(), true, memory, clock)?);
    }
    tell("S5,plain", count(clock, &mut memory.frame, &mut Screen)?);
    tell("S6,plain", count(clock, &mut memory.frame, &mut Lines)?);
    tell("S7,plain", count(clock, &mut memory.frame, &mut Triangles)?);
    tell("S8,z", mesh(&TORUS, TORUS.distance, RenderMode::GouraudLightDir(light), true, memory, clock)?);
    Some(())
});

/// The line that `report` reads: `scene,variant,instructions,drawn`.
fn tell(cell: &str, Counted { instructions, drawn, .. }: Counted) {
    println!("{cell},{instructions},{drawn}");
}

#[inline(never)]
fn mesh(
    model: &'static Model,
    distance: f32,
    mode: RenderMode,
    deep: bool,
    memory: &mut Memory,
    clock: &mut Clock,
) -> Option<Counted> {
    let size = black_box(SIZE as u16);
    let mut engine = K3dengine::new(size, size);
    engine.camera.set_fovy(black_box(PI / 3.0));
    engine.camera.set_near_far(0.5, 20.0);
    engine.camera.set_position(Point3::new(0.0, 0.0, distance));
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
    count(clock, frame, &mut Recorded { engine: &mut engine, mesh: &mesh, depth, commands, deep })
}

/// A mesh that is recorded, then drawn.
struct Recorded<'m> {
    engine: &'m mut K3dengine,
    mesh: &'m K3dMesh<'static>,
    depth: &'m mut [ZDepth],
    commands: &'m mut CommandBuffer<2048>,
    deep: bool,
}

impl Work for Recorded<'_> {
    #[inline(always)]
    fn draw<D>(&mut self, target: &mut D) -> Option<()>
    where
        D: DrawTarget<Color = Rgb565, Error = Infallible> + OriginDimensions,
    {
        let Self { engine, mesh, depth, commands, deep } = self;
        let engine = black_box(engine);
        engine.record(once(black_box(*mesh)), commands, None).ok()?;
        if *deep {
            let size = SIZE as usize;
            let mut whole = FrameCtx { zbuffer: depth, width: black_box(size), height: black_box(size) };
            engine.execute(target, &mut whole, commands, None).ok()?;
        } else {
            for command in commands.iter() {
                if let RenderCommand::Draw(primitive) = command {
                    draw(primitive.clone(), target);
                }
            }
        }
        Some(())
    }
}

struct Screen;

impl Work for Screen {
    #[inline(always)]
    fn draw<D>(&mut self, target: &mut D) -> Option<()>
    where
        D: DrawTarget<Color = Rgb565, Error = Infallible> + OriginDimensions,
    {
        fill(black_box(&SCREEN), black_box(LINE), target);
        Some(())
    }
}

struct Lines;

impl Work for Lines {
    #[inline(always)]
    fn draw<D>(&mut self, target: &mut D) -> Option<()>
    where
        D: DrawTarget<Color = Rgb565, Error = Infallible> + OriginDimensions,
    {
        let colour = black_box(LINE);
        for &[x0, y0, x1, y1] in black_box(&LINES) {
            draw(DrawPrimitive::Line([point(x0, y0), point(x1, y1)], colour), target);
        }
        Some(())
    }
}

struct Triangles;

impl Work for Triangles {
    #[inline(always)]
    fn draw<D>(&mut self, target: &mut D) -> Option<()>
    where
        D: DrawTarget<Color = Rgb565, Error = Infallible> + OriginDimensions,
    {
        for (triangle, &colour) in black_box(&TRIANGLES).iter().zip(black_box(&COLOURS)) {
            fill(triangle, RawU16::new(colour).into(), target);
        }
        Some(())
    }
}

#[inline(always)]
fn fill<D>(&[ax, ay, bx, by, cx, cy]: &[i16; 6], colour: Rgb565, target: &mut D)
where
    D: DrawTarget<Color = Rgb565, Error = Infallible>,
{
    let corners = [point(ax, ay), point(bx, by), point(cx, cy)];
    draw(DrawPrimitive::ColoredTriangle(corners, colour), target);
}

fn point(x: i16, y: i16) -> Point2<i32> {
    Point2::new(x.into(), y.into())
}
