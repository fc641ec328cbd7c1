//! Scenes of many objects: culled by their bounding spheres, placed, binned into shared memory, and drawn in bands.

use super::binned::Binned;
use super::binned_faces::{bin_faces, BinnedFaces};
use super::bins::Bins;
use super::cull::Cull;
use super::drawable::ShaderFor;
use super::faces::PLANES;
use super::instance::MeshInstance;
use super::painter::Painter;
use super::pick::{pick_at, Picked};
use super::smooth_edges::{SmoothBins, SmoothEdge, SmoothMemory};
use super::statistics::Statistics;
use super::vertex_cache::TransformedMesh;
use crate::camera::{Camera, ScreenVertex, Visibility};
use crate::color::{Color, StoredPixel};
use crate::math::{Affine, Sphere};
use crate::raster::Scissor;
use crate::scene::Mesh;
use crate::shading::{Shader, SpanShader};
use crate::space::{Model, World};
use crate::surface::{drawable, rectangle, BufferError, DepthBuffer, SmoothPass, Surface, Target};
use core::convert::Infallible;
use core::ops::{Deref, DerefMut};
use embedded_graphics_core::geometry::Point;
use embedded_graphics_core::pixelcolor::PixelColor;
use embedded_graphics_core::primitives::Rectangle;
use heapless::Vec;

/// An object of a [`Scene`]: a mesh with its transform and its material.
///
/// It takes 88 bytes and the memory of its material on a 32-bit core.
#[derive(Clone, Copy, Debug)]
pub struct Object<'m, M> {
    mesh: &'m Mesh<'m>,
    /// The bounding sphere by which the object is culled, in model units. [`Object::new`] computes it; set it for a mesh whose sphere
    /// is a constant.
    pub sphere: Sphere,
    /// The transform to world space.
    pub model: Affine<Model, World>,
    /// Which faces are culled.
    pub cull: Cull,
    /// What the faces are filled with, such as a colour: closures that shade faces get it.
    pub material: M,
}

impl<'m, M> Object<'m, M> {
    /// An object whose back faces are culled. Its bounding sphere is computed from all vertices: do this once, not in every frame.
    ///
    /// Meshes with [planes](Mesh::with_planes) and without them go into one scene.
    pub fn new(mesh: &'m Mesh<'m>, model: Affine<Model, World>, material: M) -> Self {
        Self { mesh, sphere: mesh.bounding_sphere(), model, cull: Cull::Back, material }
    }

    /// The mesh.
    pub fn mesh(&self) -> &'m Mesh<'m> {
        self.mesh
    }

    /// The object before a camera.
    #[inline(always)]
    fn place(&self, camera: &Camera) -> MeshInstance<'m> {
        camera.place(self.mesh, &self.model).with_cull(self.cull)
    }
}

/// Up to `OBJECTS` objects: a slice of [`Object`]s, to which [`add`](Self::add) adds one; `scene[0].model = ..` moves one. In every frame:
/// [`place`](Self::place) those that a camera sees, [bin](PlacedScene::bin_faces) their faces, and draw band by band.
///
/// `M` is the material of an object, any type, such as a colour. The closure that returns shaders also gets the object's index,
/// by which it can look up data that is stored elsewhere. A lit object has a [`Lambert`](crate::light::Lambert) in its material, made for its
/// transform, or in a list by its index: the cookbook's `samples` is an example.
///
/// **Memory** beside the objects themselves, all of it on the stack during a frame, on a 32-bit core: for each of the `OBJECTS`,
/// 4 bytes in [`PlacedScene`] and 72 in [`BinnedScene`]; and one vertex cache and one bin storage for all visible objects.
///
/// ```
/// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::Rgb565, prelude::*};
/// use pinhole::{meshes::CUBE, prelude::*, Angle};
/// let mut scene = Scene::<Rgb565, 20>::new();
/// for (number, color) in (-10..).zip([Rgb565::CSS_GOLD, Rgb565::CSS_TEAL].into_iter().cycle().take(20)) {
///     let moved = Affine::identity().rotate_y(Angle::degrees(9 * number)).translate(Vector3::from_ints(3 * number as i16, 0, 0));
///     scene.add(Object::new(&CUBE, moved, color))?;
/// }
/// let mut display = MockDisplay::<Rgb565>::new();
/// let viewport = Viewport::new(Point::zero(), display.size())?;
/// let view = ViewTransform::orbit(Point3::from_ints(0, 0, 0), Scalar::from_int(12), Angle::ZERO, Angle::degrees(20));
/// let lens = Projection::perspective(Angle::degrees(40), viewport.size(), Scalar::from_int(1), Scalar::from_int(40))?;
/// let camera = Camera::new(&view, &lens, &viewport);
/// let mut buffers = mesh_buffers!([CUBE; 8]); // for 8 visible objects
/// let mut strip = strip_buffers!(Rgb565, 64, 8);
///
/// let placed = scene.place(&camera);
/// let mut faces = placed.bin_faces(&mut buffers.cache, &mut buffers.bins)?;
/// let mut frame = Frame::new(display.bounding_box(), Rgb565::BLACK);
/// while let Some(mut band) = frame.next_band(&mut strip.colors)? {
///     let mut depth = DepthBuffer::new(band.area(), &mut strip.depths)?;
///     // Once for each object in the band, and then for each of its faces.
///     let shade = |_index: usize, object: &Object<'_, Rgb565>| {
///         let color = object.material;
///         move |face: usize| color.dim(20 * (face as u16 + 1))
///     };
///     faces.draw(shade, &mut band.pixels().depth_tested(&mut depth))?;
///     band.send(&mut display)?;
/// }
/// assert!(placed.iter().count() < 8 && faces.statistics().drawn > 0);
/// let opaque = |_index, _object: &Object<'_, Rgb565>| |_face| Rgb565::BLACK;
/// let picked = placed.pick(opaque, &mut [], Point::new(32, 32)).ok_or("background")?;
/// assert_eq!(picked.object, 10); // the one in the middle
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Scene<'m, M, const OBJECTS: usize> {
    objects: Vec<Object<'m, M>, OBJECTS>,
}

impl<M, const OBJECTS: usize> Default for Scene<'_, M, OBJECTS> {
    fn default() -> Self {
        Self::new()
    }
}

impl<'m, M, const OBJECTS: usize> Scene<'m, M, OBJECTS> {
    /// A scene without objects.
    pub const fn new() -> Self {
        Self { objects: Vec::new() }
    }

    /// Adds an object and returns its index: 0 for the first one.
    ///
    /// # Errors
    ///
    /// [`BufferError`] if there are `OBJECTS` objects already.
    pub fn add(&mut self, object: Object<'m, M>) -> Result<usize, BufferError> {
        let index = self.objects.len();
        match self.objects.push(object) {
            Ok(()) => Ok(index),
            Err(_) => Err(BufferError::Full { parameter: "OBJECTS", needed: index + 1, capacity: OBJECTS }),
        }
    }

    /// A sphere around all objects, in world units: for a [camera that frames](Camera::framing) the scene. It is made of the
    /// objects' [spheres](Object::sphere), by [`Sphere::transformed`] and [`Sphere::around`]. A scene without objects has no radius.
    ///
    /// ```
    /// use embedded_graphics::geometry::{Point, Size};
    /// use pinhole::{meshes::{CUBE, TORUS}, prelude::*, Angle};
    /// let mut scene = Scene::<(), 2>::new();
    /// scene.add(Object::new(&CUBE, Affine::identity().translate(Vector3::from_ints(-3, 0, 0)), ()))?;
    /// scene.add(Object::new(&TORUS, Affine::identity().translate(Vector3::from_ints(3, 0, 0)), ()))?;
    /// let viewport = Viewport::new(Point::zero(), Size::new(240, 240))?;
    /// let sphere = scene.bounding_sphere();
    /// let camera = Camera::framing(&sphere, &viewport, Angle::degrees(40), Angle::degrees(30), Angle::degrees(20))?;
    /// assert_eq!(scene.place(&camera).iter().count(), 2);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn bounding_sphere(&self) -> Sphere {
        Sphere::around(self.objects.iter().map(|object| object.sphere.transformed(&object.model)))
    }

    /// Removes all objects.
    pub fn clear(&mut self) {
        self.objects.clear();
    }
}

/// The objects, in the order in which they were added.
impl<'m, M, const OBJECTS: usize> Deref for Scene<'m, M, OBJECTS> {
    type Target = [Object<'m, M>];

    fn deref(&self) -> &[Object<'m, M>] {
        &self.objects
    }
}

/// The objects, to move them or change their materials.
impl<'m, M, const OBJECTS: usize> DerefMut for Scene<'m, M, OBJECTS> {
    fn deref_mut(&mut self) -> &mut [Object<'m, M>] {
        &mut self.objects
    }
}

impl<'m, M, const OBJECTS: usize> Scene<'m, M, OBJECTS> {
    /// Finds the objects that a camera may see in a frame: all except those whose bounding spheres lie
    /// [outside](Visibility::Outside) of the view volume. Such an object costs the test of its sphere and nothing else. The far plane
    /// counts, even if the camera does not clip there. Visible objects are [placed](Camera::place) one by one when they are drawn.
    pub fn place<'s>(&'s self, camera: &'s Camera) -> PlacedScene<'s, 'm, M, OBJECTS> {
        let (frustum, mut visible) = (camera.frustum(), Vec::new());
        for (index, object) in self.objects.iter().enumerate() {
            if frustum.visibility(&object.sphere, &object.model) != Visibility::Outside {
                let _ = visible.push(index); // both have the capacity `OBJECTS`
            }
        }
        PlacedScene { objects: &self.objects, camera, visible }
    }
}

/// The objects of a scene that may be seen in a frame. [`Scene::place`] makes it and has an example.
#[must_use = "`.draw(.., &mut target)` draws the objects, `.bin_faces(..)` bins them for bands"]
#[derive(Clone, Debug)]
pub struct PlacedScene<'s, 'm, M, const OBJECTS: usize> {
    objects: &'s [Object<'m, M>],
    camera: &'s Camera,
    /// The indices of the visible objects.
    visible: Vec<usize, OBJECTS>,
}

impl<'s, 'm, M, const OBJECTS: usize> PlacedScene<'s, 'm, M, OBJECTS> {
    /// The objects that may be seen, in the order of the scene, each placed when the iterator reaches it: for wireframes and other
    /// drawing that this type has no method for.
    pub fn iter(&self) -> impl Iterator<Item = (&'s Object<'m, M>, MeshInstance<'m>)> + '_ {
        self.visible().map(|(_, object)| (object, object.place(self.camera)))
    }

    /// The objects that may be seen, with their indices in the scene.
    fn visible(&self) -> impl Iterator<Item = (usize, &'s Object<'m, M>)> + '_ {
        self.visible.iter().filter_map(|&index| Some((index, self.objects.get(index)?)))
    }

    /// Draws all objects, in the order of the scene and in one piece: usually into a target [with a depth
    /// buffer](crate::target::Surface::depth_tested). [`Faces::draw`](crate::draw::Faces::draw) says how faces are drawn.
    ///
    /// `shade` is called once for each visible object, with its index in the scene, and returns a closure that is called once for each face
    /// that is drawn, with the face's index. Where this closure borrows from the object, write it in the call itself: Rust cannot infer its
    /// type in a variable.
    ///
    /// The objects share `cache`, memory for transformed vertices, one after the other: it should have room for the largest mesh, and may be
    /// shorter, as in [`Faces::cached`](crate::draw::Faces::cached).
    ///
    /// ```
    /// use embedded_graphics::{pixelcolor::Gray8, prelude::*};
    /// use pinhole::{meshes::{CUBE, TORUS}, prelude::*, Angle};
    /// let mut scene = Scene::<Gray8, 2>::new(); // a colour is the material here
    /// scene.add(Object::new(&CUBE, Affine::identity(), Gray8::new(200)))?;
    /// scene.add(Object::new(&TORUS, Affine::identity().translate(Vector3::from_ints(2, 0, 0)), Gray8::new(90)))?;
    /// let viewport = Viewport::new(Point::zero(), Size::new(64, 64))?;
    /// let camera = Camera::framing(&scene.bounding_sphere(), &viewport, Angle::degrees(40), Angle::ZERO, Angle::ZERO)?;
    ///
    /// let (mut pixels, mut depths) = ([Gray8::BLACK; 64 * 64], [0; 64 * 64]);
    /// let mut picture = Picture::new(&mut pixels, viewport.size())?;
    /// let mut depth = DepthBuffer::new(picture.bounding_box(), &mut depths)?;
    /// let placed = scene.place(&camera);
    /// let mut cache = [ScreenVertex::EMPTY; 200]; // as the largest mesh needs: `TORUS.vertices().len()`
    /// let mut target = picture.pixels();
    /// let statistics = placed.draw(|_, object| |_| object.material, &mut cache, &mut target.depth_tested(&mut depth))?;
    /// assert!(statistics.drawn > 100);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// The target's error, at the first span that it refuses.
    pub fn draw<T: Target, S: ShaderFor<T::Surface>, F: FnMut(usize) -> S>(
        &self,
        mut shade: impl FnMut(usize, &'s Object<'m, M>) -> F,
        cache: &mut [ScreenVertex],
        target: &mut T,
    ) -> Result<Statistics, T::Error> {
        let mut statistics = Statistics::NONE;
        for (index, object) in self.visible() {
            let instance = object.place(self.camera);
            let faces = instance.faces(shade(index, object)).culled_by_planes();
            let drawn = faces.cached(cache).draw(target)?;
            statistics = statistics + drawn;
        }
        Ok(statistics)
    }

    /// Stores the faces of all objects in a painter, which draws them from far to near, in one piece or in bands: without a depth buffer.
    /// `shade` is that of [`draw`](Self::draw).
    ///
    /// # Errors
    ///
    /// [`BufferError`] if an object has no room. The objects before it are stored then.
    pub fn sorted<S: Shader, F: FnMut(usize) -> S, const VERTICES: usize, const FACES: usize>(
        &self,
        mut shade: impl FnMut(usize, &'s Object<'m, M>) -> F,
        painter: &mut Painter<S, VERTICES, FACES>,
    ) -> Result<(), BufferError> {
        self.visible().try_for_each(|(index, object)| {
            object.place(self.camera).faces(shade(index, object)).culled_by_planes().sorted(painter)
        })
    }

    /// The visible point in a pixel of the target, without drawing: the object, the face and the depth that
    /// [`draw`](Self::draw) shows there with a depth test. Of faces with equal depth it is that of the object that was added first.
    /// `shade` and `cache` are those of `draw`. See [`Faces::pick`](crate::draw::Faces::pick).
    pub fn pick<C: PixelColor, S: SpanShader<C>, F: FnMut(usize) -> S>(
        &self,
        mut shade: impl FnMut(usize, &'s Object<'m, M>) -> F,
        cache: &mut [ScreenVertex],
        pixel: Point,
    ) -> Option<Picked> {
        pick_at(pixel, |depth| {
            let mut nearest = None;
            for (index, object) in self.visible() {
                let instance = object.place(self.camera);
                let face = instance.pick_nearer::<_, _, PLANES>(depth, shade(index, object), cache);
                nearest = face.map(|face| (index, face)).or(nearest);
            }
            nearest
        })
    }

    /// Transforms the vertices of all visible objects and bins their faces, for drawing in bands. The objects share both
    /// buffers, each taking a part: as many numbers of bin storage as its mesh [needs](Mesh::face_bins_len), and
    /// as many vertices as its mesh has. With a shorter cache the picture is equal, but vertices beyond its end are
    /// transformed for each face.
    ///
    /// # Errors
    ///
    /// [`BufferError`] if the bin storage is too short, or a mesh has more than 65535 faces.
    pub fn bin_faces<'f>(
        &'f self,
        cache: &'f mut [ScreenVertex],
        bins: &'f mut [u16],
    ) -> Result<BinnedScene<'f, 'm, M, OBJECTS>, BufferError> {
        let needed = self.visible().map(|(_, object)| object.mesh.face_bins_len()).sum();
        let given = bins.len();
        if given < needed {
            return Err(BufferError::Bins { needed, given });
        }
        let (mut cache, mut bins) = (cache, bins);
        let Self { objects, camera, .. } = *self;
        let mut scene = BinnedScene { objects, camera, binned: Vec::new(), statistics: Statistics::NONE };
        for (index, object) in self.visible() {
            let vertices = object.mesh().vertices().len().min(cache.len());
            let (own_cache, other_cache) = cache.split_at_mut_checked(vertices).unwrap_or_default();
            let numbers = object.mesh().face_bins_len();
            let (own_bins, other_bins) = bins.split_at_mut_checked(numbers).unwrap_or_default();
            (cache, bins) = (other_cache, other_bins);
            let (binned, statistics) = BinnedObject::new(index, object, camera, own_cache, own_bins)?;
            scene.statistics = scene.statistics + statistics;
            let _ = scene.binned.push(binned); // both have the capacity `OBJECTS`
        }
        Ok(scene)
    }
}

/// The faces of all visible objects, binned for bands. [`PlacedScene::bin_faces`] makes it; [`Scene`] has an example.
#[derive(Debug)]
pub struct BinnedScene<'f, 'm, M, const OBJECTS: usize> {
    objects: &'f [Object<'m, M>],
    camera: &'f Camera,
    /// The visible objects.
    binned: Vec<BinnedObject<'f>, OBJECTS>,
    statistics: Statistics,
}

/// The binned faces of an object without its instance, which takes more memory than all of this and is made again in each band.
#[derive(Debug)]
struct BinnedObject<'f> {
    /// The index of the object in the scene.
    index: usize,
    /// Its vertices, as far as there was room for them.
    cache: &'f [ScreenVertex],
    bins: Bins<'f>,
    /// Whether all vertices of its visible faces are in the cache and on the screen.
    is_cached: bool,
}

impl<'f> BinnedObject<'f> {
    /// Places an object and bins its faces, with depth.
    #[inline(never)] // the instance is off the stack when it returns
    fn new<M>(
        index: usize,
        object: &Object<'_, M>,
        camera: &Camera,
        cache: &'f mut [ScreenVertex],
        storage: &'f mut [u16],
    ) -> Result<(Self, Statistics), BufferError> {
        let instance = &object.place(camera);
        let (bins, statistics) = bin_faces(&TransformedMesh::<i16, true>::new(instance, cache), storage)?;
        let is_outside = |vertex: &ScreenVertex| vertex.planes().is_some();
        let is_cached = cache.len() >= object.mesh.vertices.len() && !cache.iter().any(is_outside);
        Ok((Self { index, cache, bins, is_cached }, statistics))
    }
}

impl<'f, 'm, M, const OBJECTS: usize> BinnedScene<'f, 'm, M, OBJECTS> {
    /// Draws the faces that lie in a band: usually with a depth buffer of the band's area. `shade` is called once for each object whose
    /// bounds meet the band, with the object's index in the scene, and returns a closure that is called once for each face that is drawn, with the face's index.
    /// Where this closure borrows from the object, write it in the call itself: Rust cannot infer its type in a
    /// variable. All bands together are, pixel by pixel, the picture of [`PlacedScene::draw`], with two exceptions. Without a depth buffer, bands clip at
    /// the far plane, because faces are binned with depth. And bands cull faces by their area on the screen, not by planes, so they may draw, and count,
    /// slivers thinner than 1/256 pixel that rounding turned to the front.
    ///
    /// # Errors
    ///
    /// The target's error, at the first span that it refuses.
    pub fn draw<T: Target, S: ShaderFor<T::Surface>, F: FnMut(usize) -> S>(
        &mut self,
        shade: impl FnMut(usize, &'f Object<'m, M>) -> F,
        target: &mut T,
    ) -> Result<(), T::Error> {
        target.dispatch(
            (self, shade),
            |(scene, mut shade), surface| {
                let area = surface.area();
                scene.each_in_band(&area, S::NEEDS_W, |index, object, faces| {
                    faces.draw(shade(index, object), surface)
                })
            },
            |(scene, mut shade), surface, depth| {
                let area = surface.area();
                let mut target = surface.depth_tested(depth);
                scene.each_in_band(&area, S::NEEDS_W, |index, object, faces| {
                    faces.draw(shade(index, object), &mut target)
                })
            },
        )
    }

    /// Calls `draw` for each object whose bounds meet a band, with the object's index and its faces. `transforms`: vertices that are in
    /// the cache and on the screen are transformed, too.
    #[inline(always)]
    fn each_in_band<E>(
        &mut self,
        band: &Rectangle,
        transforms: bool,
        mut draw: impl FnMut(usize, &'f Object<'m, M>, &mut BinnedFaces<'_>) -> Result<(), E>,
    ) -> Result<(), E> {
        let Self { objects, camera, ref mut binned, .. } = *self;
        let band = drawable(band);
        for BinnedObject { index, cache, bins, is_cached } in binned {
            let is_in_band = !bins.bounds().intersection(&band).is_empty();
            let Some(object) = objects.get(*index).filter(|_| is_in_band) else { continue };
            let instance = match transforms || !*is_cached {
                true => object.place(camera),
                false => camera.place_cached(object.mesh),
            };
            let transformed = TransformedMesh::with_cache(&instance, true, cache);
            let binned = Binned { transformed, bins: bins.reborrowed(), statistics: Statistics::NONE };
            let mut faces = binned.into();
            let drawn = draw(*index, object, &mut faces);
            bins.cursor = faces.binned.bins.cursor; // after an error, too: the bins know which faces are active
            drawn?;
        }
        Ok(())
    }

    /// Splits the binned faces of all objects into two, one for each of two cores, as [`BinnedFaces::fork`] splits those of one
    /// mesh. `cursor` is the second one's storage: for each object one number per 16 faces of its mesh, rounded up.
    /// As many numbers as the bin storage has are always enough. `drop` the forks before the scene is drawn
    /// or asked for its bounds again.
    ///
    /// # Errors
    ///
    /// [`BufferError::Bins`] if `cursor` is too short; the error says how many numbers the first object without room needs, and
    /// how many are left for it.
    pub fn fork<'b>(
        &'b mut self,
        cursor: &'b mut [u16],
    ) -> Result<[BinnedScene<'b, 'm, M, OBJECTS>; 2], BufferError> {
        let Self { objects, camera, ref mut binned, statistics } = *self;
        let half = || BinnedScene { objects, camera, binned: Vec::new(), statistics };
        let (mut cursor, mut forks) = (cursor, [half(), half()]);
        for BinnedObject { index, cache, bins, is_cached } in binned {
            let faces_of_mesh = objects.get(*index).map_or(0, |object| object.mesh.faces.len());
            let numbers = faces_of_mesh.div_ceil(16).min(cursor.len());
            let (own, other) = cursor.split_at_mut_checked(numbers).unwrap_or_default();
            cursor = other;
            for (fork, bins) in forks.iter_mut().zip(bins.fork(own)?) {
                let object = BinnedObject { index: *index, cache, bins, is_cached: *is_cached };
                let _ = fork.binned.push(object); // all three have the capacity `OBJECTS`
            }
        }
        Ok(forks)
    }

    /// Finds the edges of all visible objects that are smoothed, as [`TransformedMesh::bin_smooth_edges`] does for one mesh: only edges that a
    /// mesh lists are smoothed. `is_crease` tells of an edge, by the index of its object in the scene, the object and the edge's index, whether it is a
    /// crease. The objects share `storage`: as many numbers as their meshes [need](Mesh::smooth_bins_len) together.
    ///
    /// ```
    /// use embedded_graphics::{pixelcolor::Gray8, prelude::*};
    /// use pinhole::{meshes::CUBE, prelude::*, Angle};
    /// let mut scene = Scene::<Gray8, 2>::new();
    /// scene.add(Object::new(&CUBE, Affine::identity(), Gray8::new(200)))?;
    /// scene.add(Object::new(&CUBE, Affine::rotation_y(Angle::degrees(30)), Gray8::new(90)))?;
    /// let viewport = Viewport::new(Point::zero(), Size::new(64, 64))?;
    /// let camera = Camera::framing(&scene.bounding_sphere(), &viewport, Angle::degrees(40), Angle::ZERO, Angle::ZERO)?;
    /// let (mut pixels, mut depths) = ([Gray8::BLACK; 64 * 64], [0; 64 * 64]);
    /// let mut picture = Picture::new(&mut pixels, viewport.size())?;
    /// let mut depth = DepthBuffer::new(picture.bounding_box(), &mut depths)?;
    ///
    /// let placed = scene.place(&camera);
    /// let mut buffers = mesh_buffers!(smooth: [CUBE; 2]);
    /// let mut faces = placed.bin_faces(&mut buffers.cache, &mut buffers.bins)?;
    /// let mut edges = faces.bin_smooth_edges(|_index, _object, _edge| false, &mut buffers.edge_bins)?;
    /// faces.draw(|_, object| |_| object.material, &mut picture.pixels().depth_tested(&mut depth))?;
    /// picture.pixels().depth_tested(&mut depth).smooth(|pass| edges.draw(pass));
    /// // In bands: `band.smooth(|pass| edges.draw(pass))` of a `SmoothFrame`.
    /// # assert!(picture.colors().iter().filter(|color| ![0, 90, 200].contains(&color.luma())).count() > 50);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`BufferError`] if the storage is too short, or a mesh has more than 65535 edges.
    #[inline(never)] // the result is large
    pub fn bin_smooth_edges(
        &self,
        mut is_crease: impl FnMut(usize, &'f Object<'m, M>, usize) -> bool,
        storage: &'f mut [u16],
    ) -> Result<SmoothScene<'f, 'm, M, OBJECTS>, BufferError> {
        const { assert!(OBJECTS <= 1 << 16, "edges are smoothed of at most 65536 objects") };
        let Self { objects, camera, ref binned, .. } = *self;
        let visible = || binned.iter().filter_map(|binned| Some((binned, objects.get(binned.index)?)));
        let needed = visible().map(|(_, object)| object.mesh.smooth_bins_len()).sum();
        let (given, mut storage) = (storage.len(), storage);
        if given < needed {
            return Err(BufferError::Bins { needed, given });
        }
        let mut scene = SmoothScene { objects, camera, smooth: Vec::new(), memory: SmoothMemory::new() };
        for (&BinnedObject { index, cache, ref bins, is_cached }, object) in visible() {
            let numbers = object.mesh.smooth_bins_len();
            let (own, other) = storage.split_at_mut_checked(numbers).unwrap_or_default();
            storage = other;
            let instance = object.place(camera);
            let transformed = TransformedMesh::<_, true>::with_cache(&instance, true, cache);
            let edges = transformed.smooth_bins(|edge| is_crease(index, object, edge), own)?;
            let bounds = edges.bounds_with(&bins.bounds());
            let _ = scene.smooth.push(SmoothObject { index, cache, edges, bounds, is_cached });
            // both have the capacity `OBJECTS`
        }
        Ok(scene)
    }

    /// Stores the depth of the faces that lie in a band, and draws nothing: see [`BinnedFaces::depth_only`].
    pub fn depth_only(&mut self, depth: &mut DepthBuffer<'_>) {
        let Ok(()) = self.each_in_band(&depth.area(), false, |_, _, faces| {
            faces.depth_only(depth);
            Ok::<(), Infallible>(())
        });
    }

    /// The objects, in the order of the scene, each with a rectangle around its visible faces: for
    /// [`Tracked`](crate::bands::Tracked).
    pub fn bounds(&self) -> impl Iterator<Item = (&'f Object<'m, M>, Rectangle)> + '_ {
        self.binned
            .iter()
            .filter_map(|object| Some((self.objects.get(object.index)?, rectangle(&object.bins.bounds()))))
    }

    /// Counts for the whole frame, summed over all visible objects, whichever bands were drawn.
    pub const fn statistics(&self) -> Statistics {
        self.statistics
    }
}

/// The edges of all visible objects that are smoothed. [`BinnedScene::bin_smooth_edges`] makes it and has an example.
///
/// For each of the `OBJECTS` it takes 96 bytes on a 32-bit core.
#[derive(Debug)]
pub struct SmoothScene<'f, 'm, M, const OBJECTS: usize> {
    objects: &'f [Object<'m, M>],
    camera: &'f Camera,
    smooth: Vec<SmoothObject<'f>, OBJECTS>,
    memory: SmoothMemory<'f>,
}

/// The smoothed edges of an object without its instance: as [`BinnedObject`].
#[derive(Debug)]
struct SmoothObject<'f> {
    index: usize,
    cache: &'f [ScreenVertex],
    edges: SmoothBins<'f>,
    /// Of faces and edges.
    bounds: Scissor,
    is_cached: bool,
}

impl<'f, 'm, M, const OBJECTS: usize> SmoothScene<'f, 'm, M, OBJECTS> {
    /// Keeps edges of all objects that are set up: see [`SmoothEdges::keep_in`](crate::draw::SmoothEdges::keep_in).
    pub fn keep_in(&mut self, list: &'f mut [SmoothEdge]) {
        self.memory.keep_in(list);
    }

    /// The objects, in the order of the scene, each with a rectangle around the pixels that its faces draw and that smoothing may change: for
    /// [`Tracked`](crate::bands::Tracked), in place of [`BinnedScene::bounds`].
    pub fn bounds(&self) -> impl Iterator<Item = (&'f Object<'m, M>, Rectangle)> + '_ {
        let bounds =
            |object: &SmoothObject<'_>| Some((self.objects.get(object.index)?, rectangle(&object.bounds)));
        self.smooth.iter().filter_map(bounds)
    }

    /// Smooths the edges of all objects in a pass, in the order of the scene: see [`SmoothEdges::draw`](crate::draw::SmoothEdges::draw).
    #[inline(never)] // its stack frame does not exist while faces are drawn
    pub fn draw<C: Color + StoredPixel<Cell>, Cell: Copy>(&mut self, pass: &mut SmoothPass<'_, C, Cell>) {
        let Self { objects, camera, ref mut smooth, ref mut memory } = *self;
        let pixels = pass.pixels();
        for SmoothObject { index, cache, edges, is_cached, .. } in smooth {
            let Some(object) = objects.get(*index).filter(|_| pixels.meets(&edges.bounds)) else { continue };
            let instance = match *is_cached {
                true => camera.place_cached(object.mesh).with_cull(object.cull),
                false => object.place(camera),
            };
            edges.draw(&TransformedMesh::with_cache(&instance, true, cache), *index, memory, pass);
        }
    }
}

/// The figures of the documentation.
#[cfg(target_pointer_width = "32")]
const _: () = {
    assert!(size_of::<Object<'static, ()>>() == 88);
    assert!(size_of::<BinnedObject<'static>>() == 72);
    assert!(size_of::<SmoothObject<'static>>() == 96);
};

// Materials are not printed: they need not implement `Format`.
defmt_format!([M] Object<'_, M>, self, "object of {} in {}, cull {}", self.mesh, self.sphere, self.cull);

defmt_format!(
    [M, const OBJECTS: usize] Scene<'_, M, OBJECTS>, self,
    "scene of {=usize}/{=usize} objects", self.objects.len(), OBJECTS
);

defmt_format!(
    [M, const OBJECTS: usize] PlacedScene<'_, '_, M, OBJECTS>, self,
    "{=usize}/{=usize} objects placed", self.visible.len(), self.objects.len()
);

defmt_format!(
    [M, const OBJECTS: usize] BinnedScene<'_, '_, M, OBJECTS>, self,
    "{=usize} objects binned: {}", self.binned.len(), self.statistics
);

defmt_format!(
    [M, const OBJECTS: usize] SmoothScene<'_, '_, M, OBJECTS>, self,
    "edges of {=usize} objects to smooth", self.smooth.len()
);
