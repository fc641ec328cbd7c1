//! Scenes of many objects: culled by their bounding spheres, placed, binned into shared memory, and drawn in bands.

use super::binned_faces::BinnedFaces;
use super::cull::Cull;
use super::drawable::ShaderFor;
use super::instance::MeshInstance;
use super::painter::Painter;
use super::pick::{pick_at, Picked};
use super::statistics::Statistics;
use crate::camera::{Camera, ScreenVertex, Visibility};
use crate::math::{Affine, Sphere};
use crate::scene::{Mesh, MeshData, WithPlanes};
use crate::shading::{Shader, SpanShader};
use crate::space::{Model, World};
use crate::surface::{BufferError, DepthBuffer, Surface, Target};
use embedded_graphics_core::geometry::Point;
use embedded_graphics_core::pixelcolor::PixelColor;
use embedded_graphics_core::primitives::Rectangle;
use heapless::Vec;

/// An object of a [`Scene`]: a mesh with its transform and its material.
///
/// It takes 88 bytes and the memory of its material on a 32-bit core.
#[derive(Clone, Copy, Debug)]
pub struct Object<'m, M> {
    mesh: &'m MeshData<'m, i16>,
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
    pub fn new<P>(mesh: &'m Mesh<'m, i16, P>, model: Affine<Model, World>, material: M) -> Self {
        Self { mesh: mesh.data(), sphere: mesh.bounding_sphere(), model, cull: Cull::Back, material }
    }

    /// The mesh, in the type of meshes with planes, whether it has any or not.
    pub fn mesh(&self) -> Mesh<'m, i16, WithPlanes> {
        Mesh::with_data(self.mesh)
    }

    /// Sets which faces are culled.
    #[must_use]
    pub fn with_cull(self, cull: Cull) -> Self {
        Self { cull, ..self }
    }
}

/// Up to `OBJECTS` objects. In every frame: [`place`](Self::place) those that a camera sees, [bin](PlacedScene::bin_faces) their
/// faces, and draw band by band.
///
/// `M` is the material of an object, any type, such as a colour. The closure that returns shaders also gets the object's index,
/// by which it can look up data that is stored elsewhere.
///
/// **Memory** beside the objects themselves, all of it on the stack during a frame, on a 32-bit core: for each of the `OBJECTS`,
/// 184 bytes in [`PlacedScene`] (212 on a Cortex-M0) and 92 in [`BinnedScene`]; and one vertex cache and one bin storage for all
/// visible objects.
///
/// ```
/// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::Rgb565, prelude::*};
/// use pinhole::{prelude::*, Angle};
/// const VERTICES: [[i16; 3]; 4] = [[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]];
/// const FACES: [[u16; 3]; 4] = [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]];
/// const MESH: Mesh<'static> = match Mesh::new(&VERTICES, 0, &FACES) {
///     Ok(mesh) => mesh,
///     Err(_) => panic!("faces"),
/// };
/// let mut scene = Scene::<Rgb565, 20>::new();
/// for (number, color) in (-10..).zip([Rgb565::CSS_GOLD, Rgb565::CSS_TEAL].into_iter().cycle().take(20)) {
///     let moved = Affine::identity().rotate_y(Angle::degrees(9 * number)).translate(Vector3::from_ints(3 * number as i16, 0, 0));
///     scene.add(Object::new(&MESH, moved, color))?;
/// }
/// let mut display = MockDisplay::<Rgb565>::new();
/// let viewport = Viewport::new(Point::zero(), display.size())?;
/// let view = ViewTransform::orbit(Point3::from_ints(0, 0, 0), Scalar::from_int(12), Angle::ZERO, Angle::degrees(20));
/// let lens = Projection::perspective(Angle::degrees(40), viewport.size(), Scalar::from_int(1), Scalar::from_int(40))?;
/// let camera = Camera::new(&view, &lens, &viewport);
/// let mut buffers = mesh_buffers!([MESH; 8]); // for 8 visible objects
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
///         move |face: usize| color.dim(64 * (face as u16 + 1))
///     };
///     faces.draw(shade, &mut band.pixels().depth_tested(&mut depth))?;
///     band.send(&mut display)?;
/// }
/// assert!(placed.len() < 8 && faces.statistics().drawn > 0);
/// let opaque = |_index, _object: &Object<'_, Rgb565>| |_face| Rgb565::BLACK;
/// let picked = placed.faces(opaque).pick(Point::new(32, 32)).ok_or("background")?;
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
            Err(_) => Err(BufferError::Objects { capacity: OBJECTS }),
        }
    }

    /// The objects, in the order in which they were added.
    pub fn objects(&self) -> &[Object<'m, M>] {
        &self.objects
    }

    /// The objects, to move them or change their materials.
    pub fn objects_mut(&mut self) -> &mut [Object<'m, M>] {
        &mut self.objects
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
    /// assert_eq!(scene.place(&camera).len(), 2);
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

impl<'m, M, const OBJECTS: usize> Scene<'m, M, OBJECTS> {
    /// Places the objects before a camera for one frame, except those whose bounding spheres lie [outside](Visibility::Outside)
    /// of the view volume: such an object costs the test of its sphere and nothing else. The far plane counts, even if the camera
    /// does not clip there.
    pub fn place<'s>(&'s self, camera: &Camera) -> PlacedScene<'s, 'm, M, OBJECTS> {
        let frustum = camera.frustum();
        let mut placed = PlacedScene { objects: &self.objects, instances: Vec::new() };
        for (index, object) in self.objects.iter().enumerate() {
            if frustum.visibility(&object.sphere, &object.model) != Visibility::Outside {
                let instance = camera.place_data(object.mesh, &object.model).with_cull(object.cull);
                let _ = placed.instances.push((index, instance)); // both have the capacity `OBJECTS`
            }
        }
        placed
    }
}

/// The objects of a scene that may be seen in a frame. [`Scene::place`] makes it and has an example.
#[derive(Clone, Debug)]
pub struct PlacedScene<'s, 'm, M, const OBJECTS: usize> {
    objects: &'s [Object<'m, M>],
    /// The visible objects by their indices.
    instances: Vec<(usize, MeshInstance<'m, i16, WithPlanes>), OBJECTS>,
}

impl<'s, 'm, M, const OBJECTS: usize> PlacedScene<'s, 'm, M, OBJECTS> {
    /// The number of objects that may be seen: all others are culled.
    pub fn len(&self) -> usize {
        self.instances.len()
    }

    /// Whether no object can be seen.
    pub fn is_empty(&self) -> bool {
        self.instances.is_empty()
    }

    /// The objects that may be seen, in the order of the scene, with their instances: for wireframes and other
    /// drawing that this type has no method for.
    pub fn iter(&self) -> impl Iterator<Item = (&'s Object<'m, M>, &MeshInstance<'m, i16, WithPlanes>)> {
        self.indexed().map(|(_, object, instance)| (object, instance))
    }

    /// With the indices of the objects in the scene.
    fn indexed(
        &self,
    ) -> impl Iterator<Item = (usize, &'s Object<'m, M>, &MeshInstance<'m, i16, WithPlanes>)> {
        let object = |index: usize| self.objects.get(index);
        self.instances.iter().filter_map(move |(index, instance)| Some((*index, object(*index)?, instance)))
    }

    /// How many vertices all visible objects have: the length of a vertex cache with room for all of them.
    pub fn cache_len(&self) -> usize {
        self.instances.iter().map(|(_, instance)| instance.mesh().cache_len()).sum()
    }

    /// How many numbers of bin storage suffice for all visible objects.
    pub fn face_bins_len(&self) -> usize {
        self.instances.iter().map(|(_, instance)| instance.mesh().face_bins_len()).sum()
    }

    /// The faces of all objects, to be drawn or picked. `shade` is called once for each visible object, with its index in the scene,
    /// and returns a closure that is called once for each face that is drawn, with the face's index. Where this closure borrows from
    /// the object, write it in the call itself: Rust cannot infer its type in a variable.
    #[inline(always)]
    pub fn faces<S, F: FnMut(usize) -> S, G: FnMut(usize, &'s Object<'m, M>) -> F>(
        &self,
        shade: G,
    ) -> SceneFaces<'_, 's, 'm, M, G, OBJECTS> {
        SceneFaces { scene: self, shade, cache: &mut [] }
    }

    /// Stores all objects in a painter, which draws their faces from far to near, in one piece or in bands: without a depth buffer.
    /// `shade` is as in [`faces`](Self::faces).
    ///
    /// # Errors
    ///
    /// [`BufferError`] if an object has no room. The objects before it are stored then.
    pub fn paint<S: Shader, F: FnMut(usize) -> S, const VERTICES: usize, const FACES: usize>(
        &self,
        mut shade: impl FnMut(usize, &'s Object<'m, M>) -> F,
        painter: &mut Painter<S, VERTICES, FACES>,
    ) -> Result<(), BufferError> {
        self.indexed().try_for_each(|(index, object, instance)| painter.add(instance, shade(index, object)))
    }

    /// Transforms the vertices of all visible objects and bins their faces, for drawing in bands. The objects share both
    /// buffers, each taking a part: [`face_bins_len`](Self::face_bins_len) numbers of bin storage, and
    /// [`cache_len`](Self::cache_len) vertices. With a shorter cache the picture is equal, but vertices beyond its end are
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
        let (needed, given) = (self.face_bins_len(), bins.len());
        if given < needed {
            return Err(BufferError::Bins { needed, given });
        }
        let (mut cache, mut bins, mut binned) = (cache, bins, Vec::new());
        for (index, instance) in &self.instances {
            let vertices = instance.mesh().cache_len().min(cache.len());
            let (own_cache, other_cache) = cache.split_at_mut_checked(vertices).unwrap_or_default();
            let numbers = instance.mesh().face_bins_len();
            let (own_bins, other_bins) = bins.split_at_mut_checked(numbers).unwrap_or_default();
            (cache, bins) = (other_cache, other_bins);
            let faces = instance.bin_faces_with_depth(own_cache, own_bins)?;
            let _ = binned.push((*index, faces)); // both have the capacity `OBJECTS`
        }
        Ok(BinnedScene { objects: self.objects, binned })
    }
}

/// The faces of all visible objects, with the closure that shades them: drawn or picked by one more call. [`PlacedScene::faces`] makes it.
#[must_use = "`draw` draws the faces, `pick` finds the one in a pixel"]
#[derive(Debug)]
pub struct SceneFaces<'a, 's, 'm, M, G, const OBJECTS: usize> {
    scene: &'a PlacedScene<'s, 'm, M, OBJECTS>,
    shade: G,
    cache: &'a mut [ScreenVertex],
}

impl<'a, 's, 'm, M, G, const OBJECTS: usize> SceneFaces<'a, 's, 'm, M, G, OBJECTS> {
    /// With memory for transformed vertices, which the objects share one after the other: it should have room for the largest mesh, and
    /// may be shorter, as in [`Faces::cached`](crate::draw::Faces::cached).
    #[inline(always)]
    pub fn cached(self, cache: &'a mut [ScreenVertex]) -> Self {
        Self { cache, ..self }
    }

    /// Draws all objects, in the order of the scene and in one piece: usually into a target [with a depth
    /// buffer](crate::target::Surface::depth_tested). [`Faces::draw`](crate::draw::Faces::draw) says how faces are drawn.
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
    /// let mut cache = [ScreenVertex::EMPTY; 200]; // as the largest mesh needs: `TORUS.cache_len()`
    /// let faces = placed.faces(|_, object| |_| object.material).cached(&mut cache);
    /// let statistics = faces.draw(&mut picture.pixels().depth_tested(&mut depth))?;
    /// assert!(statistics.drawn > 100);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// The target's error, at the first span that it refuses.
    pub fn draw<T: Target, S: ShaderFor<T::Surface>, F: FnMut(usize) -> S>(
        self,
        target: &mut T,
    ) -> Result<Statistics, T::Error>
    where
        G: FnMut(usize, &'s Object<'m, M>) -> F,
    {
        let Self { scene, mut shade, cache } = self;
        let mut statistics = Statistics::NONE;
        for (index, object, instance) in scene.indexed() {
            let drawn = instance.faces(shade(index, object)).cached(cache).draw(target)?;
            statistics = statistics.and(drawn);
        }
        Ok(statistics)
    }

    /// The visible point in a pixel of the target, without drawing: the object, the face and the depth that
    /// [`draw`](Self::draw) shows there with a depth test. Of faces with equal depth it is that of the object that was added first.
    /// See [`Faces::pick`](crate::draw::Faces::pick).
    pub fn pick<C: PixelColor, S: SpanShader<C>, F: FnMut(usize) -> S>(self, pixel: Point) -> Option<Picked>
    where
        G: FnMut(usize, &'s Object<'m, M>) -> F,
    {
        let Self { scene, mut shade, cache } = self;
        pick_at(pixel, |depth| {
            let mut nearest = None;
            for (index, object, instance) in scene.indexed() {
                let face = instance.pick_nearer(depth, shade(index, object), cache);
                nearest = face.map(|face| (index, face)).or(nearest);
            }
            nearest
        })
    }
}

/// The faces of all visible objects, binned for bands. [`PlacedScene::bin_faces`] makes it; [`Scene`] has an example.
#[derive(Debug)]
pub struct BinnedScene<'f, 'm, M, const OBJECTS: usize> {
    objects: &'f [Object<'m, M>],
    /// The visible objects by their indices.
    binned: Vec<(usize, BinnedFaces<'f, i16, true>), OBJECTS>,
}

impl<'f, 'm, M, const OBJECTS: usize> BinnedScene<'f, 'm, M, OBJECTS> {
    /// Draws the faces that lie in a band: usually with a depth buffer of the band's area. `shade` is called once for each object whose
    /// bounds meet the band, with the object's index in the scene, and returns a closure that is called once for each face that is drawn, with the face's index.
    /// Where this closure borrows from the object, write it in the call itself: Rust cannot infer its type in a
    /// variable. All bands together are, pixel by pixel, the picture of [`SceneFaces::draw`].
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
                let mut in_band = scene.in_band(surface.area());
                in_band.try_for_each(|(index, object, faces)| faces.draw(shade(index, object), surface))
            },
            |(scene, mut shade), surface, depth| {
                let mut in_band = scene.in_band(surface.area());
                let mut target = surface.depth_tested(depth);
                in_band.try_for_each(|(index, object, faces)| faces.draw(shade(index, object), &mut target))
            },
        )
    }

    /// The objects whose bounds meet a band, with their indices and faces.
    fn in_band(
        &mut self,
        band: Rectangle,
    ) -> impl Iterator<Item = (usize, &'f Object<'m, M>, &mut BinnedFaces<'f, i16, true>)> {
        let objects = self.objects;
        self.binned.iter_mut().filter_map(move |(index, faces)| {
            let is_in_band = !faces.bounds().intersection(&band).is_zero_sized();
            let object = objects.get(*index).filter(|_| is_in_band)?;
            Some((*index, object, faces))
        })
    }

    /// Splits the binned faces of all objects into two, one for each of two cores, as [`BinnedFaces::fork`] splits those of one
    /// mesh. `cursor` is the second one's storage: for each object one number per 16 faces of its mesh, rounded up.
    /// [`PlacedScene::face_bins_len`] numbers are always enough.
    ///
    /// # Errors
    ///
    /// [`BufferError::Bins`] if `cursor` is too short; the error says how many numbers the first object without room needs, and
    /// how many are left for it.
    pub fn fork<'b>(
        &'b mut self,
        cursor: &'b mut [u16],
    ) -> Result<[BinnedScene<'b, 'm, M, OBJECTS>; 2], BufferError> {
        let (mut cursor, mut first, mut second) = (cursor, Vec::new(), Vec::new());
        for (index, faces) in &mut self.binned {
            let faces_of_mesh = self.objects.get(*index).map_or(0, |object| object.mesh.faces.len());
            let numbers = faces_of_mesh.div_ceil(16).min(cursor.len());
            let (own, other) = cursor.split_at_mut_checked(numbers).unwrap_or_default();
            cursor = other;
            let [ours, theirs] = faces.fork(own)?;
            let _ = first.push((*index, ours)); // all three have the capacity `OBJECTS`
            let _ = second.push((*index, theirs));
        }
        let objects = self.objects;
        Ok([BinnedScene { objects, binned: first }, BinnedScene { objects, binned: second }])
    }

    /// Stores the depth of the faces that lie in a band, and draws nothing: see [`BinnedFaces::depth_only`].
    pub fn depth_only(&mut self, depth: &mut DepthBuffer<'_>) {
        for (_, faces) in &mut self.binned {
            faces.depth_only(depth);
        }
    }

    /// The objects with their binned faces, in the order of the scene: for the [bounds](BinnedFaces::bounds) of each, which
    /// [`Tracked`](crate::bands::Tracked) takes.
    pub fn iter(&self) -> impl Iterator<Item = (&'f Object<'m, M>, &BinnedFaces<'f, i16, true>)> {
        self.binned.iter().filter_map(|(index, faces)| Some((self.objects.get(*index)?, faces)))
    }

    /// Counts for the whole frame, summed over all visible objects, whichever bands were drawn.
    pub fn statistics(&self) -> Statistics {
        self.binned.iter().fold(Statistics::NONE, |sum, (_, faces)| sum.and(faces.statistics()))
    }
}

/// The figures of the documentation.
#[cfg(target_pointer_width = "32")]
const _: () = {
    assert!(size_of::<Object<'static, ()>>() == 88);
    let placed = size_of::<(usize, MeshInstance<'static>)>();
    assert!(if cfg!(all(target_arch = "arm", target_has_atomic = "32")) {
        placed == 184
    } else {
        placed <= 212
    });
    assert!(size_of::<(usize, BinnedFaces<'static, i16, true>)>() == 92);
};

// Materials are not printed: they need not implement `Format`.
defmt_format!([M] Object<'_, M>, self, "object of {} in {}, cull {}", self.mesh, self.sphere, self.cull);

defmt_format!(
    [M, const OBJECTS: usize] Scene<'_, M, OBJECTS>, self,
    "scene of {=usize}/{=usize} objects", self.objects.len(), OBJECTS
);

defmt_format!(
    [M, const OBJECTS: usize] PlacedScene<'_, '_, M, OBJECTS>, self,
    "{=usize}/{=usize} objects placed", self.instances.len(), self.objects.len()
);

defmt_format!(
    [M, const OBJECTS: usize] BinnedScene<'_, '_, M, OBJECTS>, self,
    "{=usize} objects binned: {}", self.binned.len(), self.statistics()
);

defmt_format!(
    [M, G, const OBJECTS: usize] SceneFaces<'_, '_, '_, M, G, OBJECTS>, self,
    "faces of {}", self.scene
);
