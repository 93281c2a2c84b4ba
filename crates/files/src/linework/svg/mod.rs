//! Drawings in SVG: what is drawn and shown, in the order of the file. Groups and layers are names
//! and maps; copies (`use`) are drawn as often as they stand there.

mod page;
mod path;
mod shapes;

use super::drawn::{Drawing, Drawn, MAX_LAYERS, MAX_NAME};
use super::segment::Affine;
use super::too_large;
use crate::names::shown;
use crate::reading::{InputError, display_name, text_of, without_utf16};
use crate::units::Units;
use page::{Lengths, PIXEL_MM, Side, fit, page, view_box};
use roxmltree::{Document, Node, ParsingOptions};
use sheetwright::design::{ReadNote, Unused};
use sheetwright::math::Vec3;
use std::collections::BTreeMap;
use std::rc::Rc;
use svgtypes::Transform;

const SVG: &str = "http://www.w3.org/2000/svg";
/// How deep groups and copies may lie in one another.
const MAX_DEPTH: usize = 64;
/// The most elements that are drawn, copies among them.
const MAX_DRAWN: usize = 300_000;
/// As many letters of data count as another element that is drawn.
const LETTERS_OF_ONE: usize = 256;
/// The most elements and texts of a file.
const MAX_NODES: u32 = 4_000_000;
/// The most classes of an element that are looked at.
const MOST_CLASSES: usize = 4;
const EXPORT: &str = "Save it again as plain SVG.";

/// Reads what is drawn. With `units`, those of the file are of this length.
pub(super) fn read(bytes: &[u8], name: &str, units: Option<Units>) -> Result<Drawing, InputError> {
    let place = display_name(name);
    if bytes.starts_with(&[0x1f, 0x8b]) {
        let hint = "Unpack it (svgz), or save it as plain SVG.";
        return Err(InputError::at(place, "the drawing is compressed", hint));
    }
    let bytes = without_utf16(bytes);
    let text = text_of(&bytes, name)?;
    let options =
        ParsingOptions { allow_dtd: true, nodes_limit: MAX_NODES, ..ParsingOptions::default() };
    let document = Document::parse_with_options(text, options).map_err(|error| {
        let at = format!("{place}:{}", error.pos().row);
        InputError::at(at, format!("the file is no XML: {error}"), EXPORT)
    })?;
    let root = document.root_element();
    if root.tag_name().name() != "svg" {
        let message =
            format!("this is XML, but no SVG: it begins with {}", shown(root.tag_name().name()));
        return Err(InputError::at(place, message, EXPORT));
    }
    let mut by_id = BTreeMap::new();
    for node in root.descendants() {
        if let Some(id) = node.attribute("id") {
            by_id.entry(id).or_insert(node);
        }
    }
    let mut reader = Reader { place, by_id, drawing: Drawing::default(), drawn: 0 };
    let page = page(root, units.map(Units::in_mm)).map_err(|words| reader.error(root, &words))?;
    if !page.has_unit {
        reader.drawing.notes.push(ReadNote::NoUnit { unit_mm: PIXEL_MM });
    }
    let at = Context {
        map: page.map,
        lengths: page.lengths,
        layers: Rc::default(),
        names: Vec::new(),
        visible: true,
        depth: 0,
    };
    reader.children(root, &at)?;
    Ok(reader.drawing)
}

struct Reader<'a, 'd> {
    place: &'a str,
    by_id: BTreeMap<&'d str, Node<'d, 'd>>,
    drawing: Drawing,
    /// The number of elements that were drawn, copies among them.
    drawn: usize,
}

/// What an element inherits.
#[derive(Clone)]
struct Context {
    map: Affine,
    lengths: Lengths,
    /// The names of the groups around it, from the innermost.
    layers: Rc<Vec<String>>,
    /// The names of the copy that it is.
    names: Vec<String>,
    visible: bool,
    depth: usize,
}

impl<'d> Reader<'_, 'd> {
    fn error(&self, node: Node<'_, '_>, words: &str) -> InputError {
        let line = node.document().text_pos_at(node.range().start).row;
        let named = names(node).first().map_or(String::new(), |name| format!(" {}", shown(name)));
        let message =
            format!("the element <{}>{named} can't be read: {words}", node.tag_name().name());
        InputError::at(format!("{}:{line}", self.place), message, EXPORT)
    }

    fn children(&mut self, node: Node<'d, 'd>, at: &Context) -> Result<(), InputError> {
        node.children().filter(Node::is_element).try_for_each(|child| self.element(child, at))
    }

    fn element(&mut self, node: Node<'d, 'd>, outer: &Context) -> Result<(), InputError> {
        if node.tag_name().namespace().is_some_and(|namespace| namespace != SVG) {
            return Ok(());
        }
        let tag = node.tag_name().name();
        let is_group = matches!(tag, "g" | "a" | "switch" | "svg" | "use" | "symbol");
        let is_shape = shapes::SHAPES.contains(&tag);
        // Each copy takes as long as what it has in its attributes.
        let data = ["d", "points", "style"].iter().filter_map(|name| node.attribute(*name));
        self.drawn += 1 + data.map(str::len).sum::<usize>() / LETTERS_OF_ONE;
        if self.drawn > MAX_DRAWN {
            return Err(too_large(self.place));
        }
        let name = names(node).into_iter().next().unwrap_or_default();
        if !is_group && !is_shape {
            match tag {
                "text" | "flowRoot" => self.drawing.unused.add(Unused::Text, &name, None),
                "image" => self.drawing.unused.add(Unused::Image, &name, None),
                "foreignObject" => self.drawing.unused.add(Unused::Other, tag, None),
                // Nothing that is drawn by itself: definitions, styles, titles and the like.
                _ => {}
            }
            return Ok(());
        }
        if outer.depth == MAX_DEPTH {
            return Err(self.error(node, "it lies in more than 64 groups or copies"));
        }
        if property(node, "display") == Some("none") {
            self.drawing.unused.add(Unused::Hidden, &name, None);
            return Ok(());
        }
        let mut at = outer.clone();
        at.depth += 1;
        at.visible = match property(node, "visibility") {
            Some("hidden" | "collapse") => false,
            Some("visible") => true,
            _ => outer.visible,
        };
        if let Some(text) = node.attribute("transform") {
            let map = transform(text)
                .ok_or_else(|| self.error(node, &format!("its transform is {}", shown(text))))?;
            at.map = at.map.after(&map);
        }
        match tag {
            "use" => self.copy(node, at),
            "svg" => self.inner_page(node, [None; 2], at),
            _ if is_shape => self.shape(node, at),
            // A symbol is drawn by its copies alone.
            "symbol" => Ok(()),
            _ => {
                at.enter(node);
                self.children(node, &at)
            }
        }
    }

    fn shape(&mut self, node: Node<'d, 'd>, at: Context) -> Result<(), InputError> {
        let Context { map, lengths, layers, names: mut called, visible, .. } = at;
        called.extend(names(node));
        if !visible {
            let name = called.first().map_or("", String::as_str);
            self.drawing.unused.add(Unused::Hidden, name, None);
            return Ok(());
        }
        let strokes = shapes::drawn(node, &lengths).map_err(|words| self.error(node, &words))?;
        for stroke in strokes {
            let segments: Vec<_> = stroke.segments.iter().map(|it| it.mapped(&map)).collect();
            if !segments.iter().all(|segment| segment.end().is_finite()) || !map.is_finite() {
                return Err(self.error(node, "its coordinates are out of range"));
            }
            let (names, layers, closed) = (called.clone(), layers.clone(), stroke.closed);
            if !self.drawing.add(Drawn { names, layers, segments, closed }) {
                return Err(too_large(self.place));
            }
        }
        Ok(())
    }

    /// A copy of another element.
    fn copy(&mut self, node: Node<'d, 'd>, mut at: Context) -> Result<(), InputError> {
        let href = node.attributes().find(|attribute| attribute.name() == "href");
        let href = href.map_or("", |attribute| attribute.value());
        let Some(&target) = href.strip_prefix('#').and_then(|id| self.by_id.get(id)) else {
            self.drawing.unused.add(Unused::Other, &format!("use of {href}"), None);
            return Ok(());
        };
        let side = |name: &str, side| at.lengths.of(node, name, side);
        let read = || {
            let (x, y) = (side("x", Side::Width)?, side("y", Side::Height)?);
            let size = [side("width", Side::Width)?, side("height", Side::Height)?];
            Ok::<_, String>((Vec3::new(x.unwrap_or(0.0), y.unwrap_or(0.0), 0.0), size))
        };
        let (by, size) = read().map_err(|words| self.error(node, &words))?;
        at.map = at.map.after(&Affine::translation(by));
        if shapes::SHAPES.contains(&target.tag_name().name()) {
            at.names.extend(names(node));
            return self.element(target, &at);
        }
        at.enter(node);
        match target.tag_name().name() {
            "symbol" | "svg" => self.inner_page(target, size, at),
            _ => self.element(target, &at),
        }
    }

    /// A page inside the page: a nested `svg`, or a symbol where a copy of it stands.
    fn inner_page(
        &mut self,
        node: Node<'d, 'd>,
        size: [Option<f64>; 2],
        mut at: Context,
    ) -> Result<(), InputError> {
        // A page that copies itself would go on without end.
        if at.depth >= MAX_DEPTH {
            return Err(self.error(node, "it lies in more than 64 groups or copies"));
        }
        at.depth += 1;
        at.enter(node);
        let read = || {
            let side = |name: &str, side| at.lengths.of(node, name, side);
            let (x, y) = (side("x", Side::Width)?, side("y", Side::Height)?);
            let (width, height) = (side("width", Side::Width)?, side("height", Side::Height)?);
            let size = [
                size[0].or(width).unwrap_or(at.lengths.width),
                size[1].or(height).unwrap_or(at.lengths.height),
            ];
            let view = view_box(node)?;
            Ok::<_, String>((Vec3::new(x.unwrap_or(0.0), y.unwrap_or(0.0), 0.0), size, view))
        };
        let (by, size, view) = read().map_err(|words| self.error(node, &words))?;
        at.map = at.map.after(&Affine::translation(by));
        at.lengths = Lengths { width: size[0], height: size[1] };
        if let Some(view) = view {
            at.map = at.map.after(&fit(node, view, size));
            at.lengths = Lengths { width: view.w, height: view.h };
        }
        self.children(node, &at)
    }
}

impl Context {
    /// Inside a group: its names are those of a layer.
    fn enter(&mut self, node: Node<'_, '_>) {
        let inner = names(node).into_iter().chain(std::mem::take(&mut self.names));
        let layers = inner.chain(self.layers.iter().cloned()).take(MAX_LAYERS).collect();
        self.layers = Rc::new(layers);
    }
}

/// The names of an element: its label in Inkscape, Illustrator or Affinity, its id, its classes.
fn names(node: Node<'_, '_>) -> Vec<String> {
    let find = |wanted: &dyn Fn(&roxmltree::Attribute<'_, '_>) -> bool| {
        node.attributes().find(wanted).map(|attribute| attribute.value().trim().to_owned())
    };
    let label = find(&|it| it.name() == "label" && it.namespace().is_some());
    let data = find(&|it| it.name() == "data-name");
    let other_id = find(&|it| it.name() == "id" && it.namespace().is_some());
    let id = find(&|it| it.name() == "id" && it.namespace().is_none());
    let classes = node.attribute("class").unwrap_or_default().split_whitespace();
    let classes = classes.take(MOST_CLASSES).map(str::to_owned);
    let named = [label, data, other_id, id].into_iter().flatten().chain(classes);
    let short = named.map(|name| name.chars().take(MAX_NAME).collect::<String>());
    short.filter(|name| !name.is_empty()).collect()
}

/// A property of how an element looks, from its style or its attribute.
fn property<'a>(node: Node<'a, '_>, name: &str) -> Option<&'a str> {
    let in_style = node.attribute("style").into_iter().flat_map(|style| style.split(';'));
    let mut in_style = in_style.filter_map(|rule| rule.split_once(':'));
    let found = in_style.rfind(|(key, _)| key.trim() == name);
    let found = found.map(|(_, value)| value.trim().trim_end_matches("!important").trim_end());
    found.or_else(|| node.attribute(name).map(str::trim))
}

fn transform(text: &str) -> Option<Affine> {
    let Transform { a, b, c, d, e, f } = text.parse().ok()?;
    let map = Affine {
        axes: [Vec3::new(a, b, 0.0), Vec3::new(c, d, 0.0), Vec3::Z],
        origin: Vec3::new(e, f, 0.0),
    };
    map.is_finite().then_some(map)
}
