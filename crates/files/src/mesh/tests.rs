use super::*;
use crate::Units;

/// A mesh: its name, and its groups.
#[derive(Debug, PartialEq)]
struct Groups {
    name: String,
    groups: Vec<Group>,
}

#[derive(Debug, PartialEq)]
struct Group {
    name: String,
    positions: Vec<Point3>,
    triangles: Vec<[VertexIndex; 3]>,
    left_out: usize,
}

fn groups_of(design: Design) -> Groups {
    let group = |panel: DesignPanel| {
        let PanelShape::Mesh(mesh) = panel.shape else { panic!("{}", panel.name) };
        let Triangles { positions, triangles, left_out } = (*mesh.triangles).clone();
        Group { name: panel.name, positions, triangles, left_out }
    };
    let groups = design.panels.into_iter().map(group).collect();
    Groups { name: design.name, groups }
}

fn read_mesh(format: MeshFormat, bytes: &[u8]) -> Result<Groups, InputError> {
    let name = format!("some/shape.{}", format.ending());
    read(format, bytes, &name, &ReadOptions::default()).map(|(design, _)| groups_of(design))
}

fn obj(text: &str) -> Result<Groups, InputError> {
    read_mesh(MeshFormat::Obj, text.as_bytes())
}

/// The triangles of a group by their places.
fn places(group: &Group) -> Vec<[[f64; 3]; 3]> {
    let at = |v: VertexIndex| {
        let p = group.positions[v.get()];
        [p.x, p.y, p.z]
    };
    group.triangles.iter().map(|t| t.map(at)).collect()
}

fn sizes(design: &Groups) -> Vec<(&str, usize, usize)> {
    let size = |g: &Group| (g.positions.len(), g.triangles.len());
    design.groups.iter().map(|g| (g.name.as_str(), size(g).0, size(g).1)).collect()
}

const SQUARE: &str = "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\n";

#[test]
fn groups_of_obj_are_panels_with_the_points_that_they_use() {
    let text = format!(
        "\u{feff}# a comment\nmtllib a.mtl\n{SQUARE}vt 0 0\nvn 0 0 1\n\
         o left\nusemtl red\nf 1/1/1 2/1/1 3//1\nusemtl blue\nf 1 3 4 # that's all\n\
         g right side\nv 4 0 0\nf -4 -1 -3\ns off\no left\nf 2 \\\n 3 5\n"
    );
    let design = obj(&text).unwrap();
    assert_eq!(design.name, "shape");
    assert_eq!(sizes(&design), [("left", 5, 3), ("right side", 3, 1)]);
    assert_eq!(places(&design.groups[1]), [[[2., 0., 0.], [4., 0., 0.], [2., 1., 0.]]]);
}

#[test]
fn a_file_without_groups_is_called_after_itself_and_units_count() {
    let options = ReadOptions { units: Some(Units::Inches), ..ReadOptions::default() };
    let text = format!("{SQUARE}f 1 2 3 4\n");
    let design =
        groups_of(read(MeshFormat::Obj, text.as_bytes(), "a/hood.OBJ", &options).unwrap().0);
    assert_eq!(sizes(&design), [("hood", 4, 2)]);
    assert_eq!(design.groups[0].positions[2], Point3::new(50.8, 25.4, 0.0));
}

#[test]
fn names_that_no_file_could_have_are_made_fit_and_told_apart() {
    let text = format!("{SQUARE}g a/b\nf 1 2 3\ng a:b\nf 1 3 4\ng A_B\nf 2 3 4\ng ..\nf 1 2 4\n");
    let names: Vec<String> = obj(&text).unwrap().groups.into_iter().map(|g| g.name).collect();
    assert_eq!(names, ["a_b", "a_b 2", "A_B 3", "shape"]);
}

#[test]
fn a_group_of_which_nothing_is_left_is_no_panel_and_is_counted() {
    // Corners shared by number, and by coordinates where every triangle has corners of its own.
    let by_number = "v 0 0 0\nv 1 0 0\nv 0 1 0\no a\nf 1 2 1\no b\nf 1 2 3\nf 3 2 1\n";
    let by_place = "v 0 0 0\nv 1 0 0\nv 1 0 0\no a\nf 1 2 3\n\
                    v 0 0 0\nv 1 0 0\nv 0 1 0\no b\nf 4 5 6\n";
    for text in [by_number, by_place] {
        let design = obj(text).unwrap();
        assert_eq!(design.groups.len(), 1, "{text}");
        assert_eq!((design.groups[0].name.as_str(), design.groups[0].left_out), ("b", 1));
    }
    let nothing = obj("v 0 0 0\nv 1 0 0\nv 1 0 0\no a\nf 1 2 3\n").unwrap_err();
    assert_eq!(nothing.message, "the mesh has no triangle");
}

#[test]
fn what_is_no_triangle_is_left_out_and_counted() {
    let text = format!("{SQUARE}v 2 0 0\nf 1 2 5 3\nf 2 5 3\nf 1 3 4\n");
    let design = obj(&text).unwrap();
    assert_eq!(design.groups[0].left_out, 1);
    assert_eq!(design.groups[0].triangles.len(), 2);
}

#[test]
fn broken_obj_is_refused_by_line() {
    for (text, said) in [
        (format!("{SQUARE}f 1 2\n"), "shape.obj:5: the face has 2 corners"),
        (format!("{SQUARE}f 1 2 9\n"), "shape.obj:5: the face names point 9; the file has 4"),
        (format!("{SQUARE}f 1 2 0\n"), "shape.obj:5: '0' names no point"),
        (format!("{SQUARE}f 1 2 -5\n"), "shape.obj:5: '-5' names no point"),
        (format!("{SQUARE}f 1 2 x\n"), "shape.obj:5: 'x' names no point"),
        ("v 1 2\n".to_owned(), "shape.obj:1: the point has no z"),
        ("v 1 2 1,5\n".to_owned(), "shape.obj:1: '1,5' is no number"),
        (
            "\nv 1 2 nan\n".to_owned(),
            "shape.obj:2: a coordinate is not a finite number within ±1e11 mm",
        ),
        (
            "v 1 2 1e12\n".to_owned(),
            "shape.obj:1: a coordinate is not a finite number within ±1e11 mm",
        ),
        (SQUARE.to_owned(), "shape.obj: the mesh has no triangle"),
        (String::new(), "shape.obj: the mesh has no triangle"),
    ] {
        let error = obj(&text).unwrap_err();
        assert_eq!(error.to_string(), format!("some/{said}"));
        assert!(error.hint.ends_with('.'));
    }
}

/// Two triangles of a square as STL of both kinds.
fn stl_text() -> String {
    let facet = |corners: [&str; 3]| {
        let vertices = corners.map(|c| format!("vertex {c}\n")).concat();
        format!(" facet normal 0 0 1\n  outer loop\n{vertices}  endloop\n endfacet\n")
    };
    let first = facet(["0 0 0", "2 0 0", "2 1 -0"]);
    let second = facet(["0 0 0", "2 1 0", "0 1 0.0"]);
    format!("solid one\n{first}{second}endsolid one\nsolid two\n{first}endsolid\n")
}

fn stl_bytes(header: &str) -> Vec<u8> {
    let mut bytes = header.as_bytes().to_vec();
    bytes.resize(80, b' ');
    bytes.extend(2u32.to_le_bytes());
    let corners =
        [[0f32, 0., 0.], [2., 0., 0.], [2., 1., -0.0], [0., 0., 0.], [2., 1., 0.], [0., 1., 0.]];
    for triangle in corners.chunks(3) {
        bytes.extend([0; 12]);
        bytes.extend(triangle.iter().flatten().flat_map(|c| c.to_le_bytes()));
        bytes.extend([0; 2]);
    }
    bytes
}

#[test]
fn stl_is_welded_and_its_solids_are_panels() {
    let text = read_mesh(MeshFormat::Stl, stl_text().as_bytes()).unwrap();
    assert_eq!(sizes(&text), [("one", 4, 2), ("two", 3, 1)]);
    // Some programs begin the header of a binary file with `solid`.
    for header in ["made by someone", "solid made by someone"] {
        let binary = read_mesh(MeshFormat::Stl, &stl_bytes(header)).unwrap();
        assert_eq!(sizes(&binary), [("shape", 4, 2)]);
        assert_eq!(places(&binary.groups[0]), places(&text.groups[0]));
    }
}

#[test]
fn broken_stl_is_refused_by_line_or_byte() {
    let bytes = stl_bytes("");
    let mut many = bytes.clone();
    many[80..84].copy_from_slice(&u32::MAX.to_le_bytes());
    let mut nan = bytes.clone();
    nan[96..100].copy_from_slice(&f32::NAN.to_le_bytes());
    let cut = stl_text().split("endfacet").next().unwrap().to_owned();
    for (bytes, said) in [
        (bytes[..170].to_vec(), "shape.stl, byte 170: the file ends after 1 of 2 triangles"),
        (many, "shape.stl, byte 184: the file ends after 2 of 4294967295 triangles"),
        (nan, "shape.stl, byte 84: a coordinate is not a finite number within ±1e11 mm"),
        (bytes[..30].to_vec(), "shape.stl: the file ends within the header"),
        (cut.into_bytes(), "shape.stl:2: the file ends within a facet"),
        (
            b"solid\nfacet\nvertex 0 0 0\nendfacet\n".to_vec(),
            "shape.stl:4: the facet has one corner",
        ),
        (b"solid\nfacet\nvertex 0 0 0\nfacet\n".to_vec(), "shape.stl:2: the facet has one corner"),
        (b"solid\nvertices 0 0 0\n".to_vec(), "shape.stl:2: 'vertices' is no word of an STL file"),
        (b"solid box\nendsolid box\n".to_vec(), "shape.stl: the mesh has no triangle"),
        (Vec::new(), "shape.stl: the input is empty"),
    ] {
        let error = read_mesh(MeshFormat::Stl, &bytes).unwrap_err();
        assert_eq!(error.to_string(), format!("some/{said}"));
    }
}

/// A square with a colour per point, faces before points, and an element that the reader skips.
fn ply(encoding: &str) -> Vec<u8> {
    let mut bytes = format!(
        "ply\r\nformat {encoding} 1.0\ncomment by hand\nelement face 1\nproperty uchar flag\n\
         property list uchar int vertex_indices\nelement vertex 4\nproperty float x\n\
         property double y\nproperty float z\nproperty uchar red\nelement other 1\n\
         property list ushort short things\nend_header\n"
    )
    .into_bytes();
    let corners = [[0., 0., 0.], [2., 0., 0.], [2., 1., 0.], [0., 1., 0.]];
    if encoding == "ascii" {
        bytes.extend(b"7 4 0 1 2 3\n");
        corners.iter().for_each(|[x, y, z]| bytes.extend(format!("{x} {y} {z} 255\n").bytes()));
        bytes.extend(b"2 -1 -2\n");
        return bytes;
    }
    let little = encoding == "binary_little_endian";
    let mut put = |mut value: Vec<u8>| {
        if !little {
            value.reverse();
        }
        bytes.extend(value);
    };
    put(vec![7]);
    put(vec![4]);
    (0..4i32).for_each(|n| put(n.to_le_bytes().to_vec()));
    for [x, y, z] in corners {
        put((x as f32).to_le_bytes().to_vec());
        put(f64::to_le_bytes(y).to_vec());
        put((z as f32).to_le_bytes().to_vec());
        put(vec![255]);
    }
    put(2u16.to_le_bytes().to_vec());
    (1..3i16).for_each(|n| put((-n).to_le_bytes().to_vec()));
    bytes
}

#[test]
fn ply_reads_the_same_in_every_encoding() {
    let wanted = obj(&format!("{SQUARE}f 1 2 3 4\n")).unwrap();
    for encoding in ["ascii", "binary_little_endian", "binary_big_endian"] {
        assert_eq!(read_mesh(MeshFormat::Ply, &ply(encoding)).unwrap(), wanted, "{encoding}");
    }
}

#[test]
fn broken_ply_is_refused() {
    let text = String::from_utf8(ply("ascii")).unwrap();
    let binary = ply("binary_little_endian");
    for (bytes, said) in [
        (
            b"solid\n".to_vec(),
            "shape.ply:1: a PLY file begins with the line 'ply', and this one does not",
        ),
        (b"ply\nformat ascii 1.0\n".to_vec(), "shape.ply: the file ends within the header"),
        (
            b"ply\nelement face 1\nelements 7\n".to_vec(),
            "shape.ply:3: 'elements 7' is no line of a PLY header",
        ),
        (
            b"ply\nproperty float x\n".to_vec(),
            "shape.ply:2: 'property float x' is no line of a PLY header",
        ),
        (b"ply\nend_header\n".to_vec(), "shape.ply:2: the header names no format"),
        (
            text.replace("vertex 4", "vertex 4000000000").into_bytes(),
            "shape.ply: the file ends before its 4000000000 elements 'vertex'",
        ),
        (
            text.replace("0 1 2 3", "0 1 2 4").into_bytes(),
            "shape.ply:15: the face names point 4; there are 4, counted from 0",
        ),
        (text.replace("0 1 2 3", "0 1 2 x").into_bytes(), "shape.ply:15: 'x' is no number"),
        (text.replace("4 0 1 2 3", "4 0 1 -2 3").into_bytes(), "shape.ply:15: -2 is no count"),
        (
            binary[..binary.len() - 3].to_vec(),
            "shape.ply, byte 379: the file ends within its elements",
        ),
    ] {
        let error = read_mesh(MeshFormat::Ply, &bytes).unwrap_err();
        let (said, found) = (format!("some/{said}"), error.to_string());
        // Where a binary file ends depends on the length of its header alone.
        let same =
            found == said || (said.contains("byte") && found.contains("within its elements"));
        assert!(same, "{found}\n{said}");
    }
}

/// A file with one mesh of a triangle and a strip of two, put twice, once mirrored.
fn glb(change: impl Fn(String) -> String) -> Vec<u8> {
    let mut binary: Vec<u8> = Vec::new();
    for corner in [[0f32, 0., 0.], [2., 0., 0.], [2., 1., 0.], [0., 1., 0.]] {
        binary.extend(corner.iter().flat_map(|c| c.to_le_bytes()));
    }
    binary.extend([0u16, 1, 2, 0, 2, 3].iter().flat_map(|n| n.to_le_bytes()));
    binary.extend([0u8, 1, 3, 2]);
    let mut json = change(
        r#"{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,2]}],
        "nodes":[{"name":"up","translation":[0,0,5],"children":[1]},
                 {"mesh":0,"scale":[2,1,1]},
                 {"name":"back","mesh":1,"matrix":[-1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]}],
        "meshes":[{"name":"plate","primitives":[{"attributes":{"POSITION":0,"NORMAL":7},"indices":1}]},
                  {"primitives":[{"attributes":{"POSITION":0},"indices":2,"mode":5},
                                 {"attributes":{"POSITION":0},"mode":1}]}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},
                     {"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"},
                     {"bufferView":1,"byteOffset":12,"componentType":5121,"count":4,"type":"SCALAR"}],
        "bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":16}],
        "buffers":[{"byteLength":64}]}"#
            .to_owned(),
    );
    while !json.len().is_multiple_of(4) {
        json.push(' ');
    }
    let mut bytes = b"glTF".to_vec();
    let mut put = |n: usize| bytes.extend((n as u32).to_le_bytes());
    put(2);
    put(12 + 8 + json.len() + 8 + binary.len());
    put(json.len());
    bytes.extend(b"JSON");
    bytes.extend(json.bytes());
    bytes.extend((binary.len() as u32).to_le_bytes());
    bytes.extend(b"BIN\0");
    bytes.extend(binary);
    bytes
}

#[test]
fn nodes_of_glb_are_panels_where_they_are_put() {
    let design = read_mesh(MeshFormat::Glb, &glb(|json| json)).unwrap();
    assert_eq!(sizes(&design), [("plate", 4, 2), ("back", 4, 2)]);
    assert_eq!(places(&design.groups[0])[0], [[0., 0., 5.], [4., 0., 5.], [4., 1., 5.]]);
    // Mirrored, and turned round so that it shows the same side.
    assert_eq!(places(&design.groups[1])[0], [[0., 0., 0.], [0., 1., 0.], [-2., 0., 0.]]);
}

#[test]
fn broken_glb_is_refused_by_its_part() {
    let good = glb(|json| json);
    let changed = |from: &'static str, to: &'static str| {
        let bytes = glb(|json| json.replace(from, to));
        assert_ne!(bytes, good, "{from}");
        bytes
    };
    for (bytes, said) in [
        (good[..50].to_vec(), ", byte 12: the file ends within a chunk"),
        (b"glTF\x01\0\0\0".to_vec(), ": the glTF version is 1; version 2 is supported"),
        (b"{}".to_vec(), ": a .glb file begins with 'glTF', and this one does not"),
        (
            changed(r#""count":4,"type":"VEC3""#, r#""count":4000000000,"type":"VEC3""#),
            ": accessors[0]: its numbers lie beyond the end of the file",
        ),
        (
            changed(r#""byteLength":48"#, r#""byteLength":18446744073709551615"#),
            ": accessors[0]: its numbers lie beyond the end of the file",
        ),
        (changed("5126", "5122"), ": accessors[0]: numbers of type 5122 'VEC3' can't be read here"),
        (
            changed(r#""indices":1"#, r#""indices":9"#),
            ": accessors[9]: the file refers to it, and it is missing",
        ),
        (
            changed(r#""children":[1]"#, r#""children":[0]"#),
            ": nodes[0]: the node has two parents, or is its own",
        ),
        (
            changed(r#""mesh":1"#, r#""mesh":5"#),
            ": meshes[5]: the file refers to it, and it is missing",
        ),
        (
            changed(r#""byteOffset":48"#, r#""byteOffset":0"#),
            ": meshes[0].primitives[0]: an index is 16256, and there are 4 points, counted from 0",
        ),
        (
            changed(r#""scene":0"#, r#""extensionsRequired":["KHR_draco_mesh_compression"]"#),
            ": the file needs the extension 'KHR_draco_mesh_compression', which is not supported",
        ),
        (
            changed(r#"{"byteLength":64}"#, r#"{"uri":"a.bin"}"#),
            ": accessors[0]: its numbers lie in another file",
        ),
    ] {
        let error = read_mesh(MeshFormat::Glb, &bytes).unwrap_err();
        let found = error.to_string();
        let same = found == format!("some/shape.glb{said}")
            || (said.contains("16256") && found.contains("primitives[0]: an index is "));
        assert!(same, "{found}\n{said}");
    }
    let error =
        read_mesh(MeshFormat::Glb, &changed(r#""nodes":[0,2]"#, r#""nodes":"all""#)).unwrap_err();
    assert!(
        error
            .to_string()
            .starts_with("some/shape.glb: scenes[0].nodes: the JSON of the file can't be read"),
        "{error}"
    );
}

#[test]
fn a_file_in_which_no_corner_is_shared_is_welded() {
    let soup = "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 0 0\nv 2 1 0\nv 0 1 0\nf 1 2 3\nf 4 5 6\n";
    assert_eq!(sizes(&obj(soup).unwrap()), [("shape", 4, 2)]);
    // A file that shares some points by number has no other shared points.
    let cut = format!("{soup}v 4 0 0\nf 2 7 3\n");
    assert_eq!(sizes(&obj(&cut).unwrap()), [("shape", 7, 3)]);
}

#[test]
fn lines_of_obj_along_sides_are_seams() {
    // Two triangles; a step of the second line, and the third line, are no sides.
    let text =
        format!("{SQUARE}v 9 9 9\nf 1 2 3\nf 1 3 4\nl 1 3 # the diagonal\nl 4/1 1/2 2 4\nl 5 1\n");
    let seams = |text: &str| {
        let options = ReadOptions::default();
        let (design, _) = read(MeshFormat::Obj, text.as_bytes(), "a.obj", &options).unwrap();
        let PanelShape::Mesh(mesh) = &design.panels[0].shape else { panic!() };
        mesh.seams
            .iter()
            .map(|way| way.iter().map(|p| [p.x, p.y]).collect())
            .collect::<Vec<Vec<_>>>()
    };
    let way = [[0.0, 1.0], [0.0, 0.0], [2.0, 0.0]];
    assert_eq!(seams(&text), [vec![[0.0, 0.0], [2.0, 1.0]], way.to_vec()]);
    let (_, lines) =
        read(MeshFormat::Obj, text.as_bytes(), "a.obj", &ReadOptions::default()).unwrap();
    // The second is used in part alone.
    assert_eq!(lines, 1);
    // Triangles with corners of their own are welded, and the lines with them.
    let apart = "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 0 0\nv 2 1 0\nv 0 1 0\nf 1 2 3\nf 4 5 6\nl 4 3\n";
    assert_eq!(seams(apart), [vec![[0.0, 0.0], [2.0, 1.0]]]);
    let error = obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nl 1 7\n").unwrap_err();
    assert_eq!(error.message, "the line names point 7; the file has 3");
}

#[test]
fn lines_of_obj_are_seams_once_and_of_the_groups_that_they_run_along() {
    // A line along two groups, twice: each group has its run, and both lines are used.
    let text = format!(
        "{SQUARE}v 4 0 0\nv 4 1 0\ng a\nf 1 2 3 4\ng b\nf 2 5 6 3\nl 4 1 2 5\nl 1 2\nl 3 3\nl 1\n"
    );
    let (design, lines) =
        read(MeshFormat::Obj, text.as_bytes(), "a.obj", &ReadOptions::default()).unwrap();
    let seams = |n: usize| {
        let PanelShape::Mesh(mesh) = &design.panels[n].shape else { panic!() };
        mesh.seams.iter().map(|way| way.iter().map(|p| p.x).collect()).collect::<Vec<Vec<_>>>()
    };
    assert_eq!((seams(0), seams(1)), (vec![vec![0.0, 0.0, 2.0]], vec![vec![2.0, 4.0]]));
    assert_eq!(lines, 2);
}

#[test]
fn lines_with_too_many_points_are_refused() {
    let line = format!("l{}\n", " 1 2".repeat(3 * MAX_TRIANGLES / 2));
    let text = |more: &str| format!("{SQUARE}f 1 2 3\n{line}{more}");
    assert_eq!(sizes(&obj(&text("")).unwrap()), [("shape", 3, 1)]);
    let error = obj(&text("l 2 3\n")).unwrap_err();
    assert_eq!(error.place.as_deref(), Some("some/shape.obj:7"));
    assert!(error.message.starts_with("the mesh has more than"), "{}", error.message);
}
