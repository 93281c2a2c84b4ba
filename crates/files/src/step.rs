//! Smooth surfaces as STEP: ISO 10303-21 (file format) and ISO 10303-214 (schema), which every CAD
//! system reads.
//!
//! Each panel is a product of its own with one open shell: ruled strips are B-spline surfaces of
//! degree 3 × 1, flat parts are planes, and faces that meet share the edge. Millimetres. No date
//! and no author: the same design gives the same bytes.
//!
//! This module uses no crate: the known ones depend on a modelling kernel of a hundred crates, and
//! a list of numbered records is enough.

use crate::shapes::digits;
use sheetwright::math::{Frame, Point3, Vec3, unit};
use sheetwright::quads::{EdgeCurve, FaceShape, Rail, SmoothFace, SmoothSurface};
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// Points closer than this, as a share of the size, count as one: quads are planar to a tenth of
/// it.
const SAME_POINT: f64 = 1e-8;

/// The STEP file of smooth surfaces under their names.
pub fn write_step(panels: &[(&str, &SmoothSurface)]) -> Vec<u8> {
    let mut step = Records::default();
    let application =
        step.add("APPLICATION_CONTEXT('core data for automotive mechanical design processes')");
    step.add(&format!(
        "APPLICATION_PROTOCOL_DEFINITION('international standard','automotive_design',2000,{application})"
    ));
    let of_product = step.add(&format!("PRODUCT_CONTEXT('',{application},'mechanical')"));
    let of_definition =
        step.add(&format!("PRODUCT_DEFINITION_CONTEXT('part definition',{application},'design')"));
    let mm = step.add("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.))");
    let radian = step.add("(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.))");
    let steradian = step.add("(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT())");
    let origin =
        step.frame(Frame { origin: Point3::default(), x: Vec3::X, y: Vec3::Y, z: Vec3::Z });
    for (name, surface) in panels {
        let name = text(name);
        let near = real(uncertainty_mm(surface));
        let uncertainty = step.add(&format!(
            "UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE({near}),{mm},'distance_accuracy_value','')"
        ));
        let context = step.add(&format!(
            "(GEOMETRIC_REPRESENTATION_CONTEXT(3)\
             GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT(({uncertainty}))\
             GLOBAL_UNIT_ASSIGNED_CONTEXT(({mm},{radian},{steradian}))\
             REPRESENTATION_CONTEXT('',''))"
        ));
        let shell = Shell::new(&mut step, surface).written(&name);
        let model = step.add(&format!("SHELL_BASED_SURFACE_MODEL({name},({shell}))"));
        let shape = step.add(&format!(
            "MANIFOLD_SURFACE_SHAPE_REPRESENTATION({name},({origin},{model}),{context})"
        ));
        let product = step.add(&format!("PRODUCT({name},{name},'',({of_product}))"));
        step.add(&format!("PRODUCT_RELATED_PRODUCT_CATEGORY('part',$,({product}))"));
        let formation = step.add(&format!("PRODUCT_DEFINITION_FORMATION('','',{product})"));
        let definition =
            step.add(&format!("PRODUCT_DEFINITION('design','',{formation},{of_definition})"));
        let defined = step.add(&format!("PRODUCT_DEFINITION_SHAPE('','',{definition})"));
        step.add(&format!("SHAPE_DEFINITION_REPRESENTATION({defined},{shape})"));
    }
    format!(
        "ISO-10303-21;\nHEADER;\n\
         FILE_DESCRIPTION(('Surfaces of panels, one product a panel, mm'),'2;1');\n\
         FILE_NAME('surface.step','1970-01-01T00:00:00',(''),(''),'','Sheetwright','');\n\
         FILE_SCHEMA(('AUTOMOTIVE_DESIGN {{ 1 0 10303 214 1 1 1 1 }}'));\n\
         ENDSEC;\nDATA;\n{}ENDSEC;\nEND-ISO-10303-21;\n",
        step.text
    )
    .into_bytes()
}

/// The uncertainty of coordinates for the file, mm: [`SAME_POINT`] of the size, rounded up to a
/// power of ten.
fn uncertainty_mm(surface: &SmoothSurface) -> f64 {
    let origin = surface.vertices.first().copied().unwrap_or_default();
    let reach = |p: &Point3| (*p - origin).abs().max_element();
    let size = surface.vertices.iter().map(reach).fold(0.0, f64::max);
    let powers = [1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1, 1.0, 10.0];
    powers.into_iter().find(|power| SAME_POINT * size <= *power).unwrap_or(10.0)
}

/// The numbered records written so far.
#[derive(Default)]
struct Records {
    text: String,
    count: usize,
}

impl Records {
    /// Writes a record, and returns the name by which others refer to it.
    fn add(&mut self, record: &str) -> String {
        self.count += 1;
        // Writing to a string does not fail.
        let _ = writeln!(self.text, "#{}={record};", self.count);
        format!("#{}", self.count)
    }

    fn point(&mut self, p: Point3) -> String {
        self.add(&format!("CARTESIAN_POINT('',({},{},{}))", real(p.x), real(p.y), real(p.z)))
    }

    fn direction(&mut self, d: Vec3) -> String {
        self.add(&format!("DIRECTION('',({},{},{}))", real(d.x), real(d.y), real(d.z)))
    }

    fn frame(&mut self, frame: Frame) -> String {
        let origin = self.point(frame.origin);
        let (z, x) = (self.direction(frame.z), self.direction(frame.x));
        self.add(&format!("AXIS2_PLACEMENT_3D('',{origin},{z},{x})"))
    }
}

/// A surface while it is written.
struct Shell<'a> {
    step: &'a mut Records,
    surface: &'a SmoothSurface,
    vertices: BTreeMap<usize, String>,
    edges: BTreeMap<usize, String>,
    /// The control points of the splines that edges run along.
    controls: BTreeMap<usize, Vec<String>>,
}

impl<'a> Shell<'a> {
    fn new(step: &'a mut Records, surface: &'a SmoothSurface) -> Self {
        let (vertices, edges, controls) = (BTreeMap::new(), BTreeMap::new(), BTreeMap::new());
        Self { step, surface, vertices, edges, controls }
    }

    fn written(mut self, name: &str) -> String {
        let surface = self.surface;
        let faces: Vec<String> = surface.faces.iter().map(|face| self.face(face)).collect();
        self.step.add(&format!("OPEN_SHELL({name},({}))", faces.join(",")))
    }

    fn face(&mut self, face: &SmoothFace) -> String {
        let uses: Vec<String> = face
            .border
            .iter()
            .map(|&(edge, reversed)| {
                let curve = self.edge(edge);
                let way = if reversed { ".F." } else { ".T." };
                self.step.add(&format!("ORIENTED_EDGE('',*,*,{curve},{way})"))
            })
            .collect();
        let border = self.step.add(&format!("EDGE_LOOP('',({}))", uses.join(",")));
        let bound = self.step.add(&format!("FACE_OUTER_BOUND('',{border},.T.)"));
        let shape = match face.shape {
            FaceShape::Ruled(rails) => self.ruled(rails),
            FaceShape::Plane(normal) => self.plane(face, normal),
        };
        self.step.add(&format!("ADVANCED_FACE('',({bound}),{shape},.T.)"))
    }

    fn ruled(&mut self, rails: [usize; 2]) -> String {
        let [right, left] = rails.map(|edge| self.control(edge));
        let across: Vec<String> =
            right.iter().zip(&left).map(|(p, q)| format!("({p},{q})")).collect();
        let knots = self.rail(rails[0]).map_or(&[][..], |rail| &rail.knots);
        let (counts, knots) = (multiplicities(knots), reals(knots));
        self.step.add(&format!(
            "B_SPLINE_SURFACE_WITH_KNOTS('',3,1,({}),.RULED_SURF.,.F.,.F.,.F.,\
             ({counts}),(2,2),({knots}),(0.,1.),.UNSPECIFIED.)",
            across.join(",")
        ))
    }

    fn plane(&mut self, face: &SmoothFace, normal: Vec3) -> String {
        let (edge, reversed) = face.border[0];
        let origin = self.surface.vertices[self.surface.edges[edge].ends[usize::from(reversed)]];
        let upright = Frame { origin, x: Vec3::X, y: Vec3::Y, z: Vec3::Z };
        let frame = Frame::with_normal(origin, normal).unwrap_or(upright);
        let placed = self.step.frame(frame);
        self.step.add(&format!("PLANE('',{placed})"))
    }

    fn edge(&mut self, edge: usize) -> String {
        if let Some(known) = self.edges.get(&edge) {
            return known.clone();
        }
        let surface = self.surface;
        let [from, to] = surface.edges[edge].ends.map(|i| self.vertex(i));
        let curve = match &surface.edges[edge].curve {
            EdgeCurve::Line => {
                let [a, b] = surface.edges[edge].ends.map(|i| surface.vertices[i]);
                let point = self.step.point(a);
                let along = self.step.direction(unit(b - a).unwrap_or(Vec3::X));
                let vector = self.step.add(&format!("VECTOR('',{along},1.)"));
                self.step.add(&format!("LINE('',{point},{vector})"))
            }
            EdgeCurve::Spline(rail) => {
                let control = self.control(edge).join(",");
                let (counts, knots) = (multiplicities(&rail.knots), reals(&rail.knots));
                self.step.add(&format!(
                    "B_SPLINE_CURVE_WITH_KNOTS('',3,({control}),.UNSPECIFIED.,.F.,.F.,\
                     ({counts}),({knots}),.UNSPECIFIED.)"
                ))
            }
        };
        let written = self.step.add(&format!("EDGE_CURVE('',{from},{to},{curve},.T.)"));
        self.edges.insert(edge, written.clone());
        written
    }

    fn vertex(&mut self, i: usize) -> String {
        if let Some(known) = self.vertices.get(&i) {
            return known.clone();
        }
        let point = self.step.point(self.surface.vertices[i]);
        let written = self.step.add(&format!("VERTEX_POINT('',{point})"));
        self.vertices.insert(i, written.clone());
        written
    }

    fn rail(&self, edge: usize) -> Option<&'a Rail> {
        match &self.surface.edges[edge].curve {
            EdgeCurve::Spline(rail) => Some(rail),
            EdgeCurve::Line => None,
        }
    }

    /// The control points of the spline of an edge, which surfaces share.
    fn control(&mut self, edge: usize) -> Vec<String> {
        if let Some(known) = self.controls.get(&edge) {
            return known.clone();
        }
        let control = self.rail(edge).map_or(&[][..], |rail| &rail.control);
        let points: Vec<String> = control.iter().map(|&p| self.step.point(p)).collect();
        self.controls.insert(edge, points.clone());
        points
    }
}

/// The multiplicity of each knot, as a list.
fn multiplicities(knots: &[f64]) -> String {
    let last = knots.len().saturating_sub(1);
    let counts = (0..knots.len()).map(|n| if n == 0 || n == last { "4" } else { "2" });
    counts.collect::<Vec<_>>().join(",")
}

fn reals(numbers: &[f64]) -> String {
    numbers.iter().map(|&x| real(x)).collect::<Vec<_>>().join(",")
}

/// A number with all its digits, and the point that makes it a real.
fn real(x: f64) -> String {
    let mut real = digits(x);
    if !real.contains('.') {
        real.push('.');
    }
    real
}

/// A string of ISO 10303-21; characters beyond ASCII become UTF-16 code units.
fn text(name: &str) -> String {
    let mut written = String::from("'");
    for c in name.chars() {
        match c {
            '\'' => written.push_str("''"),
            '\\' => written.push_str("\\\\"),
            ' '..='~' => written.push(c),
            _ => {
                let mut units = [0; 2];
                written.push_str("\\X2\\");
                for unit in c.encode_utf16(&mut units) {
                    let _ = write!(written, "{unit:04X}");
                }
                written.push_str("\\X0\\");
            }
        }
    }
    written.push('\'');
    written
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_numbers_are_written_as_the_standard_has_it() {
        assert_eq!(text("it's a\\b"), "'it''s a\\\\b'");
        assert_eq!(text("Dächer 🛶"), "'D\\X2\\00E4\\X0\\cher \\X2\\D83DDEF6\\X0\\'");
        assert_eq!([1.0, -0.0, 0.5, 1e-7].map(real), ["1.", "0.", "0.5", "0.0000001"]);
        assert_eq!(multiplicities(&[0.0, 1.0, 2.0]), "4,2,4");
    }
}
