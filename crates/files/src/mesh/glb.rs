//! glTF in one binary file (`.glb`, version 2): the triangles of every node, where the node puts
//! them.
//!
//! Such files give a corner several points where normals or colours differ; the reader makes points
//! with equal coordinates, to the last bit, one again.

use super::build::Builder;
use super::limited::limited;
use super::scan::{Cursor, cut_off};
use super::{NO_SURFACE, too_many};
use crate::reading::InputError;
use serde::Deserialize;
use serde::de::IgnoredAny;
use sheetwright::math::Vec3;
use sheetwright::mesh::MAX_TRIANGLES;

const DAMAGED: &str = "The file is damaged: export it again.";
const EXPORT: &str = "Export it as one .glb file without compression, or as OBJ, PLY or STL.";
/// The standard's numbers for types of chunks and for types of the numbers in accessors.
const JSON_CHUNK: u32 = 0x4e4f_534a;
const BINARY_CHUNK: u32 = 0x004e_4942;
const U8: u32 = 5121;
const U16: u32 = 5123;
const U32: u32 = 5125;
const F32: u32 = 5126;
const TRIANGLES: u32 = 4;
const STRIP: u32 = 5;
const FAN: u32 = 6;
/// The most bytes of the JSON: in memory, an entry may take ten times the bytes that it has in the
/// file.
const MOST_JSON: usize = 64 << 20;

#[derive(Deserialize)]
#[serde(rename_all = "camelCase", default)]
#[derive(Default)]
struct Document {
    scene: Option<usize>,
    #[serde(deserialize_with = "limited")]
    scenes: Vec<Scene>,
    #[serde(deserialize_with = "limited")]
    nodes: Vec<Node>,
    #[serde(deserialize_with = "limited")]
    meshes: Vec<GltfMesh>,
    #[serde(deserialize_with = "limited")]
    accessors: Vec<Accessor>,
    #[serde(deserialize_with = "limited")]
    buffer_views: Vec<BufferView>,
    #[serde(deserialize_with = "limited")]
    buffers: Vec<Buffer>,
    #[serde(deserialize_with = "limited")]
    extensions_required: Vec<String>,
}

#[derive(Deserialize, Default)]
#[serde(default)]
struct Scene {
    nodes: Vec<usize>,
}

#[derive(Deserialize, Default)]
#[serde(default)]
struct Node {
    name: String,
    mesh: Option<usize>,
    children: Vec<usize>,
    matrix: Option<[f64; 16]>,
    translation: Option<[f64; 3]>,
    rotation: Option<[f64; 4]>,
    scale: Option<[f64; 3]>,
}

#[derive(Deserialize, Default)]
#[serde(default)]
struct GltfMesh {
    name: String,
    #[serde(deserialize_with = "limited")]
    primitives: Vec<Primitive>,
}

#[derive(Deserialize, Default)]
#[serde(default)]
struct Primitive {
    attributes: Attributes,
    indices: Option<usize>,
    mode: Option<u32>,
}

#[derive(Deserialize, Default)]
#[serde(default)]
struct Attributes {
    #[serde(rename = "POSITION")]
    position: Option<usize>,
}

#[derive(Deserialize, Default)]
#[serde(rename_all = "camelCase", default)]
struct Accessor {
    buffer_view: Option<usize>,
    byte_offset: usize,
    component_type: u32,
    count: usize,
    r#type: String,
    sparse: Option<IgnoredAny>,
}

#[derive(Deserialize, Default)]
#[serde(rename_all = "camelCase", default)]
struct BufferView {
    buffer: usize,
    byte_offset: usize,
    byte_length: usize,
    byte_stride: Option<usize>,
}

#[derive(Deserialize, Default)]
#[serde(default)]
struct Buffer {
    uri: Option<String>,
}

/// An affine map: three columns and the image of the origin.
#[derive(Clone, Copy)]
struct Transform([Vec3; 4]);

impl Transform {
    const NONE: Self = Self([Vec3::X, Vec3::Y, Vec3::Z, Vec3::ZERO]);

    fn of(node: &Node) -> Self {
        if let Some(m) = node.matrix {
            return Self([0, 4, 8, 12].map(|n| Vec3::new(m[n], m[n + 1], m[n + 2])));
        }
        let [x, y, z, w] = node.rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]);
        let [s, t, u] = node.scale.unwrap_or([1.0; 3]);
        Self([
            Vec3::new(1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + z * w), 2.0 * (x * z - y * w))
                * s,
            Vec3::new(2.0 * (x * y - z * w), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + x * w))
                * t,
            Vec3::new(2.0 * (x * z + y * w), 2.0 * (y * z - x * w), 1.0 - 2.0 * (x * x + y * y))
                * u,
            Vec3::from_array(node.translation.unwrap_or([0.0; 3])),
        ])
    }

    fn way(&self, v: Vec3) -> Vec3 {
        let [x, y, z, _] = self.0;
        x * v.x + y * v.y + z * v.z
    }

    fn point(&self, p: Vec3) -> Vec3 {
        self.way(p) + self.0[3]
    }

    /// The composed map: first `inner`, then this one.
    fn after(&self, inner: &Self) -> Self {
        let [x, y, z, origin] = inner.0;
        Self([self.way(x), self.way(y), self.way(z), self.point(origin)])
    }

    /// Whether it reverses orientation, as a mirror does.
    fn mirrors(&self) -> bool {
        let [x, y, z, _] = self.0;
        x.cross(y).dot(z) < 0.0
    }
}

pub(super) fn read(bytes: &[u8], place: &str, builder: &mut Builder) -> Result<(), InputError> {
    builder.weld();
    let (json, binary) = chunks(bytes, place)?;
    if json.len() > MOST_JSON {
        let message = format!("the JSON of the file is larger than {} MiB", MOST_JSON >> 20);
        return Err(InputError::at(place, message, EXPORT));
    }
    let mut deserializer = serde_json::Deserializer::from_slice(json);
    let document: Document =
        serde_path_to_error::deserialize(&mut deserializer).map_err(|error| {
            let at = format!("{place}: {}", error.path());
            let hint = "The file is damaged, or no glTF of version 2: export it again.";
            InputError::at(
                at,
                format!("the JSON of the file can't be read: {}", error.inner()),
                hint,
            )
        })?;
    if let Some(name) = document.extensions_required.first() {
        // Extensions for units, lights and materials change no shape, but files never require them.
        let message = format!("the file needs the extension '{name}', which is not supported");
        return Err(InputError::at(place, message, EXPORT));
    }
    let file = File { document: &document, binary, place };
    let mut triangles = 0;
    for (node, transform) in file.placed()? {
        let Some(mesh) = document.nodes[node].mesh else { continue };
        let at = || format!("{place}: meshes[{mesh}]");
        let Some(found) = document.meshes.get(mesh) else { return Err(file.missing(at())) };
        let name = [&document.nodes[node].name, &found.name];
        let name = name.into_iter().find(|name| !name.is_empty());
        builder.begin(name.map_or("", |name| name), at)?;
        for (n, primitive) in found.primitives.iter().enumerate() {
            let at = format!("{place}: meshes[{mesh}].primitives[{n}]");
            file.primitive(primitive, &transform, &at, &mut triangles, builder)?;
        }
    }
    Ok(())
}

/// The JSON chunk, which describes the file, and the binary chunk with its numbers.
fn chunks<'a>(bytes: &'a [u8], place: &str) -> Result<(&'a [u8], &'a [u8]), InputError> {
    let mut cursor = Cursor::new(bytes, 0);
    if bytes.is_empty() {
        return Err(InputError::at(place, "the input is empty", NO_SURFACE));
    }
    if cursor.take(4) != Some(b"glTF") {
        let message = "a .glb file begins with 'glTF', and this one does not";
        return Err(InputError::at(place, message, EXPORT));
    }
    let u32_of = |cursor: &mut Cursor<'a>| cursor.array().map(u32::from_le_bytes);
    let version = u32_of(&mut cursor).ok_or_else(|| cut_off(place, "the header"))?;
    if version != 2 {
        let message = format!("the glTF version is {version}; version 2 is supported");
        return Err(InputError::at(place, message, EXPORT));
    }
    let mut found: [Option<&[u8]>; 2] = [None, None];
    // Skips the total length, since every chunk states its own.
    u32_of(&mut cursor).ok_or_else(|| cut_off(place, "the header"))?;
    while cursor.left() > 0 {
        let at = format!("{place}, byte {}", cursor.at());
        let length = u32_of(&mut cursor);
        let kind = u32_of(&mut cursor);
        let chunk = length.and_then(|length| cursor.take(length as usize));
        let (Some(kind), Some(chunk)) = (kind, chunk) else { return Err(cut_off(&at, "a chunk")) };
        let slot = match kind {
            JSON_CHUNK => 0,
            BINARY_CHUNK => 1,
            _ => continue,
        };
        found[slot].get_or_insert(chunk);
    }
    let json = found[0].ok_or_else(|| cut_off(place, "the header"))?;
    Ok((json, found[1].unwrap_or(&[])))
}

struct File<'a> {
    document: &'a Document,
    binary: &'a [u8],
    place: &'a str,
}

impl File<'_> {
    fn missing(&self, at: String) -> InputError {
        InputError::at(at, "the file refers to it, and it is missing", DAMAGED)
    }

    /// The nodes of the scene, each with its map into the scene, in the order of the lists of
    /// nodes.
    fn placed(&self) -> Result<Vec<(usize, Transform)>, InputError> {
        let Document { nodes, scenes, scene, .. } = self.document;
        let mut roots: Vec<usize> = match scenes.get(scene.unwrap_or(0)) {
            Some(scene) => scene.nodes.clone(),
            // Without a scene, every node without a parent is a root.
            None => {
                let mut is_child = vec![false; nodes.len()];
                let children = nodes.iter().flat_map(|node| &node.children);
                children.for_each(|&child| {
                    if let Some(is_child) = is_child.get_mut(child) {
                        *is_child = true;
                    }
                });
                (0..nodes.len()).filter(|&n| !is_child[n]).collect()
            }
        };
        roots.reverse();
        let mut left: Vec<(usize, Transform)> =
            roots.into_iter().map(|root| (root, Transform::NONE)).collect();
        let mut placed = Vec::new();
        let mut seen = vec![false; nodes.len()];
        while let Some((n, outer)) = left.pop() {
            let at = format!("{}: nodes[{n}]", self.place);
            let Some(node) = nodes.get(n) else { return Err(self.missing(at)) };
            if std::mem::replace(&mut seen[n], true) {
                let message = "the node has two parents, or is its own";
                return Err(InputError::at(at, message, DAMAGED));
            }
            let transform = outer.after(&Transform::of(node));
            placed.push((n, transform));
            left.extend(node.children.iter().rev().map(|&child| (child, transform)));
        }
        Ok(placed)
    }

    fn primitive(
        &self,
        primitive: &Primitive,
        transform: &Transform,
        at: &str,
        triangles: &mut usize,
        builder: &mut Builder,
    ) -> Result<(), InputError> {
        let mode = primitive.mode.unwrap_or(TRIANGLES);
        let Some(position) = primitive.attributes.position else { return Ok(()) };
        if ![TRIANGLES, STRIP, FAN].contains(&mode) {
            return Ok(());
        }
        let wanted = (&[F32][..], "VEC3");
        let (points, count) = self.rows::<3>(position, wanted)?;
        let first = builder.points();
        for n in 0..count {
            let [x, y, z] = points(n);
            let at = || format!("{}: accessors[{position}]", self.place);
            builder.point(transform.point(Vec3::new(x, y, z)).to_array(), at)?;
        }
        let corners: Vec<usize> = match primitive.indices {
            None => (0..count).collect(),
            Some(indices) => {
                let (rows, count) = self.rows::<1>(indices, (&[U8, U16, U32], "SCALAR"))?;
                (0..count).map(|n| rows(n)[0] as usize).collect()
            }
        };
        if let Some(beyond) = corners.iter().find(|&&corner| corner >= count) {
            let message =
                format!("an index is {beyond}, and there are {count} points, counted from 0");
            return Err(InputError::at(at, message, DAMAGED));
        }
        let list: Vec<[usize; 3]> = match mode {
            TRIANGLES => corners.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect(),
            // Every other triangle of a strip runs the other way round.
            STRIP => corners
                .windows(3)
                .enumerate()
                .map(|(n, c)| if n % 2 == 0 { [c[0], c[1], c[2]] } else { [c[1], c[0], c[2]] })
                .collect(),
            _ => corners.windows(2).skip(1).map(|c| [corners[0], c[0], c[1]]).collect(),
        };
        *triangles += list.len();
        if *triangles > MAX_TRIANGLES {
            return Err(too_many(at));
        }
        for [a, b, c] in list {
            let triangle = if transform.mirrors() { [a, c, b] } else { [a, b, c] };
            builder.polygon(&triangle.map(|corner| first + corner), || at.to_owned())?;
        }
        Ok(())
    }

    /// A function from the index of a row of an accessor to its numbers, and the number of rows.
    /// Checks first that all rows lie within the file.
    fn rows<const N: usize>(
        &self,
        accessor: usize,
        (types, shape): (&[u32], &str),
    ) -> Result<(impl Fn(usize) -> [f64; N], usize), InputError> {
        let at = format!("{}: accessors[{accessor}]", self.place);
        let Some(found) = self.document.accessors.get(accessor) else {
            return Err(self.missing(at));
        };
        if !types.contains(&found.component_type) || found.r#type != shape {
            let message = format!(
                "numbers of type {} {} can't be read here",
                found.component_type,
                crate::names::shown(&found.r#type)
            );
            return Err(InputError::at(at, message, EXPORT));
        }
        let outside = |what: &str| InputError::at(at.clone(), what, EXPORT);
        if found.sparse.is_some() {
            return Err(outside("its numbers are stored as differences from others (sparse)"));
        }
        let view = found.buffer_view.ok_or_else(|| outside("its numbers are not in the file"))?;
        let view = self.document.buffer_views.get(view).ok_or_else(|| self.missing(at.clone()))?;
        let buffer = self.document.buffers.get(view.buffer);
        if view.buffer != 0 || buffer.is_none_or(|buffer| buffer.uri.is_some()) {
            return Err(outside("its numbers lie in another file"));
        }
        let size = match found.component_type {
            U8 => 1,
            U16 => 2,
            _ => 4,
        };
        let stride = view.byte_stride.unwrap_or(N * size);
        if stride < N * size {
            return Err(outside("its numbers lie on top of one another"));
        }
        let bytes = view
            .byte_offset
            .checked_add(view.byte_length)
            .and_then(|end| self.binary.get(view.byte_offset..end))
            .and_then(|view| view.get(found.byte_offset..));
        let needed = found.count.checked_sub(1).map_or(Some(0), |last| {
            last.checked_mul(stride).and_then(|bytes| bytes.checked_add(N * size))
        });
        let (Some(bytes), Some(needed)) = (bytes, needed) else {
            return Err(outside("its numbers lie beyond the end of the file"));
        };
        if needed > bytes.len() {
            return Err(outside("its numbers lie beyond the end of the file"));
        }
        if found.count > 3 * MAX_TRIANGLES {
            return Err(too_many(at));
        }
        let kind = found.component_type;
        let row = move |n: usize| {
            let mut row = Cursor::new(bytes, n * stride);
            [0; N].map(|_| {
                let value = match kind {
                    U8 => row.array().map(|b| f64::from(u8::from_le_bytes(b))),
                    U16 => row.array().map(|b| f64::from(u16::from_le_bytes(b))),
                    U32 => row.array().map(|b| f64::from(u32::from_le_bytes(b))),
                    _ => row.array().map(|b| f64::from(f32::from_le_bytes(b))),
                };
                // The checks above found all rows within the file.
                value.unwrap_or(f64::NAN)
            })
        };
        Ok((row, found.count))
    }
}
