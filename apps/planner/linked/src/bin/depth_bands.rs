//! Faces with depth in bands, as the templates draw them, in the shading that the image is named for.
#![no_std]
#![no_main]

use linked::*;

static TEXELS: [u8; SIDE * SIDE] = [1; SIDE * SIDE];
static PALETTE: [Rgb565; 256] = [COLOR; 256];

firmware!(|camera, turn, display: Rgb565|
    mesh: MeshBuffers!(MODEL) = mesh_buffers!(MODEL),
    strip: StripBuffers!(Rgb565, WIDTH, ROWS) = strip_buffers!(Rgb565, WIDTH, ROWS),
    {
        let model = Affine::rotation_y(turn);
        let light = light(&model)?;
        let instance = camera.place(&MODEL, &model);
        let mut faces = instance.transform_depth(&mut mesh.cache).bin_faces(&mut mesh.bins).ok()?;
        let mut frame = Frame::new(area(display), Rgb565::BLACK);
        let level = |face| level(&MODEL, &light, face);
        let smooth = |face| {
            let normals = MODEL.corners_of(face, MODEL.vertex_normals());
            Gouraud::lit(LIT, normals.map(|normal| light.level(normal)))
        };
        let texture = Texture::new(IndexedTexels::<_, 8>::new(&TEXELS, SIDE, SIDE, &PALETTE).ok()?);
        let texture = texture.with_exponent(UNIT).ok()?;
        while let Some(mut band) = frame.next_band(&mut strip.colors).ok()? {
            let mut depth = DepthBuffer::new(band.area(), &mut strip.depths).ok()?;
            let (depth, pixels) = (&mut depth, &mut band.pixels());
            let Ok(()) = match SHADING {
                "flat" => faces.draw(|face| COLOR.dim(level(face)), &mut pixels.depth_tested(depth)),
                "smooth" => faces.draw(smooth, &mut pixels.depth_tested(depth)),
                "dithered" => faces.draw(|face| Dithered(Flat::lit(LIT, level(face))), &mut pixels.depth_tested(depth)),
                "smooth dithered" => faces.draw(|face| Dithered(smooth(face)), &mut pixels.depth_tested(depth)),
                _ => {
                    let shade = |face| texture.at(coordinates(&MODEL, face)).lit([level(face); 3]);
                    faces.draw(shade, &mut pixels.depth_tested(depth))
                }
            };
            band.send(display).ok()?;
        }
        Some(())
    }
);
