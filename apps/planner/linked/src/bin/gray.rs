//! Faces with depth in bands, on a display of 16 greys or of one bit a pixel, in the shading that the image is named for.
#![no_std]
#![no_main]

use linked::*;

static TEXELS: [u8; SIDE * SIDE] = [1; SIDE * SIDE];
static PALETTE: [Color; 256] = [WHITE; 256];

firmware!(|camera, turn, display: Color|
    mesh: MeshBuffers!(MODEL) = mesh_buffers!(MODEL),
    strip: StripBuffers!(Color, WIDTH, ROWS) = strip_buffers!(Color, WIDTH, ROWS),
    {
        let model = Affine::rotation_y(turn);
        let light = light(&model)?;
        let level = |face| level(&MODEL, &light, face);
        let smooth = |face| {
            let normals = MODEL.corners_of(face, MODEL.vertex_normals());
            Gouraud::lit(LIT, normals.map(|normal| light.level(normal)))
        };
        let texture = Texture::new(IndexedTexels::<_, 8>::new(&TEXELS, SIDE, SIDE, &PALETTE).ok()?);
        let texture = texture.with_exponent(UNIT).ok()?;
        let instance = camera.place(&MODEL, &model);
        let mut faces = instance.transform_depth(&mut mesh.cache).bin_faces(&mut mesh.bins).ok()?;
        let mut frame = Frame::new(area(display), Color::from(BinaryColor::Off));
        while let Some(mut band) = frame.next_band(&mut strip.colors).ok()? {
            let mut depth = DepthBuffer::new(band.area(), &mut strip.depths).ok()?;
            let (depth, target) = (&mut depth, &mut band);
            let Ok(()) = match SHADING {
                "flat" => faces.draw(|face| Color::from(LIT).dim(level(face)), &mut target.depth_tested(depth)),
                "smooth" => faces.draw(smooth, &mut target.depth_tested(depth)),
                "dithered" => faces.draw(|face| Dithered(Flat::lit(LIT, level(face))), &mut target.depth_tested(depth)),
                _ => {
                    let shade = |face| texture.at(coordinates(&MODEL, face)).lit([level(face); 3]);
                    faces.draw(shade, &mut target.depth_tested(depth))
                }
            };
            band.send(display).ok()?;
        }
        Some(())
    }
);
