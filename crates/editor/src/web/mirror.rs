//! What is in the canvas, as elements that screen readers find.
//!
//! A canvas is a picture to a screen reader. So each named thing in it has an element over it that
//! is not seen and that the pointer passes through: with its role, its name, its state and its
//! place. What a screen reader activates there happens in the canvas. The elements are those of the
//! tree that desktop systems get (AccessKit), written at most a few times a second and only where
//! something has changed.

use super::document;
use eframe::egui::accesskit::{
    Action, ActionRequest, Live, Node, NodeId, Role, Toggled, TreeId, TreeUpdate,
};
use eframe::egui::{self, Context, Event, FullOutput, RawInput};
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;
use wasm_bindgen::prelude::*;
use web_sys::{Document, Element};
use web_time::Instant;

/// The element of the page that holds the copies.
const PLACE: &str = "mirror";
/// The least time between two writings.
const PAUSE: Duration = Duration::from_millis(200);

/// What a node is like: all that is written of it.
type Attributes = BTreeMap<&'static str, String>;

/// Keeps the elements like the tree.
#[derive(Default)]
pub(super) struct Mirror {
    shown: Vec<(u64, Attributes)>,
    written: Option<Instant>,
    asked: Arc<Mutex<Vec<u64>>>,
    listens: bool,
}

impl egui::Plugin for Mirror {
    fn debug_name(&self) -> &'static str {
        "mirror"
    }

    fn input_hook(&mut self, ctx: &Context, input: &mut RawInput) {
        if !self.listens {
            self.listens = listen(ctx, &self.asked).is_some();
        }
        for node in self.asked.lock().unwrap_or_else(PoisonError::into_inner).drain(..) {
            input.events.push(Event::AccessKitActionRequest(ActionRequest {
                action: Action::Click,
                target_tree: TreeId::ROOT,
                target_node: NodeId(node),
                data: None,
            }));
        }
    }

    fn output_hook(&mut self, ctx: &Context, output: &mut FullOutput) {
        let Some(tree) = &output.platform_output.accesskit_update else { return };
        let now = Instant::now();
        if let Some(left) = self.written.and_then(|at| PAUSE.checked_sub(now - at)) {
            // This tree may be the last for long.
            ctx.request_repaint_after(left);
            return;
        }
        let nodes = listed(tree, f64::from(ctx.zoom_factor()));
        if nodes == self.shown && self.written.is_some() {
            return;
        }
        if document()
            .and_then(|document| write(&document, &self.shown, &nodes, tree.focus.0))
            .is_some()
        {
            self.shown = nodes;
            self.written = Some(now);
        }
    }
}

/// The nodes that have something to say, in the order of the tree.
fn listed(tree: &TreeUpdate, zoom: f64) -> Vec<(u64, Attributes)> {
    let nodes: BTreeMap<u64, &Node> = tree.nodes.iter().map(|(id, node)| (id.0, node)).collect();
    let mut found = Vec::new();
    let mut left: Vec<u64> = tree.tree.iter().map(|info| info.root.0).collect();
    // No node is a child of two, so each comes once; the bound is for trees that are none.
    for _ in 0..tree.nodes.len() {
        let Some(id) = left.pop() else { break };
        let Some(node) = nodes.get(&id) else { continue };
        left.extend(node.children().iter().rev().map(|child| child.0));
        let label_of =
            |id: &NodeId| nodes.get(&id.0).and_then(|node| node.value().or(node.label()));
        let name = node.label().map(str::to_owned).or_else(|| {
            let texts: Vec<&str> = node.labelled_by().iter().filter_map(label_of).collect();
            (!texts.is_empty()).then(|| texts.join(" "))
        });
        if let Some(attributes) = attributes(node, name, zoom) {
            found.push((id, attributes));
        }
    }
    found
}

/// What is written of a node; `None` if it says nothing.
fn attributes(node: &Node, name: Option<String>, zoom: f64) -> Option<Attributes> {
    let role = role(node.role())?;
    let mut all = Attributes::new();
    all.insert("role", role.to_owned());
    let text = match node.role() {
        Role::Label => node.value().map(str::to_owned).or(name),
        _ => name,
    };
    all.insert("aria-label", text.filter(|text| !text.is_empty())?);
    if let (Some(value), true) = (node.value(), node.role() != Role::Label) {
        all.insert("aria-valuetext", value.to_owned());
    } else if let Some(value) = node.numeric_value() {
        all.insert("aria-valuetext", value.to_string());
    }
    if let Some(live) = node.live().filter(|live| *live != Live::Off) {
        all.insert("role", "status".to_owned());
        let how = if live == Live::Assertive { "assertive" } else { "polite" };
        all.insert("aria-live", how.to_owned());
    }
    if let Some(description) = node.description() {
        all.insert("aria-description", description.to_owned());
    }
    if node.is_disabled() {
        all.insert("aria-disabled", "true".to_owned());
    }
    if let Some(toggled) = node.toggled() {
        let state = match toggled {
            Toggled::False => "false",
            Toggled::True => "true",
            Toggled::Mixed => "mixed",
        };
        let name = if matches!(role, "button") { "aria-pressed" } else { "aria-checked" };
        all.insert(name, state.to_owned());
    }
    if let Some(r) = node.bounds() {
        let [x, y, w, h] = [r.x0, r.y0, r.x1 - r.x0, r.y1 - r.y0].map(|v| (v * zoom).round());
        all.insert("style", format!("left:{x}px;top:{y}px;width:{w}px;height:{h}px"));
    }
    Some(all)
}

/// What pages call a role; `None` for what only holds others or draws text.
fn role(role: Role) -> Option<&'static str> {
    Some(match role {
        Role::Button | Role::DefaultButton | Role::ColorWell => "button",
        Role::CheckBox => "checkbox",
        Role::RadioButton => "radio",
        Role::Switch => "switch",
        Role::Label | Role::Paragraph => "note",
        Role::Heading => "heading",
        Role::Link => "link",
        Role::Image | Role::Canvas | Role::GraphicsObject | Role::GraphicsDocument => "img",
        Role::TextInput | Role::MultilineTextInput | Role::SearchInput | Role::PasswordInput => {
            "textbox"
        }
        Role::SpinButton | Role::NumberInput => "spinbutton",
        Role::Slider => "slider",
        Role::ComboBox => "combobox",
        Role::Tab => "tab",
        Role::MenuItem | Role::MenuItemCheckBox | Role::MenuItemRadio => "menuitem",
        Role::ListItem | Role::ListBoxOption => "option",
        Role::ProgressIndicator | Role::Meter => "progressbar",
        Role::Alert | Role::AlertDialog | Role::Status => "status",
        Role::Dialog => "dialog",
        Role::Group | Role::Pane | Role::Region | Role::Toolbar => "group",
        _ => return None,
    })
}

/// Makes the elements like the nodes.
fn write(
    document: &Document,
    before: &[(u64, Attributes)],
    nodes: &[(u64, Attributes)],
    focus: u64,
) -> Option<()> {
    let place = document.get_element_by_id(PLACE)?;
    let old: BTreeMap<u64, &Attributes> = before.iter().map(|(id, node)| (*id, node)).collect();
    let new: BTreeMap<u64, &Attributes> = nodes.iter().map(|(id, node)| (*id, node)).collect();
    for id in old.keys().filter(|id| !new.contains_key(id)) {
        if let Some(element) = document.get_element_by_id(&id_of(*id)) {
            element.remove();
        }
    }
    // Elements stand in the order of the tree, which is that in which they are read.
    let mut next = place.first_element_child();
    for (id, node) in nodes {
        let element = match document.get_element_by_id(&id_of(*id)) {
            Some(element) => element,
            None => {
                let element = document.create_element("div").ok()?;
                element.set_id(&id_of(*id));
                element
            }
        };
        if next.as_ref() == Some(&element) {
            next = element.next_element_sibling();
        } else {
            place.insert_before(&element, next.as_deref()).ok()?;
        }
        change(&element, old.get(id).copied(), node);
    }
    if let Some(canvas) = document.query_selector("canvas").ok().flatten() {
        let _ = canvas.set_attribute("aria-activedescendant", &id_of(focus));
    }
    // For whoever waits for the editor to be there.
    let _ = document.document_element()?.set_attribute("data-ready", "true");
    Some(())
}

fn change(element: &Element, before: Option<&Attributes>, node: &Attributes) {
    for name in before.into_iter().flat_map(|before| before.keys()) {
        if !node.contains_key(name) {
            let _ = element.remove_attribute(name);
        }
    }
    for (name, value) in node {
        if before.and_then(|before| before.get(name)) != Some(value) {
            let _ = element.set_attribute(name, value);
            // Of what is live, screen readers say the text when it changes, not the name.
            if *name == "aria-label" && node.contains_key("aria-live") {
                element.set_text_content(Some(value));
            }
        }
    }
}

fn id_of(node: u64) -> String {
    format!("node-{node:x}")
}

/// Hears what is activated among the copies.
fn listen(ctx: &Context, asked: &Arc<Mutex<Vec<u64>>>) -> Option<()> {
    let place = document()?.get_element_by_id(PLACE)?;
    let (ctx, asked) = (ctx.clone(), Arc::clone(asked));
    let heard = Closure::<dyn Fn(web_sys::Event)>::new(move |event: web_sys::Event| {
        let target = event.target().and_then(|target| target.dyn_into::<Element>().ok());
        let id = target.map(|element| element.id()).unwrap_or_default();
        let node = id.strip_prefix("node-").and_then(|hex| u64::from_str_radix(hex, 16).ok());
        if let Some(node) = node {
            asked.lock().unwrap_or_else(PoisonError::into_inner).push(node);
            ctx.request_repaint();
        }
    });
    place.add_event_listener_with_callback("click", heard.as_ref().unchecked_ref()).ok()?;
    // As long as the page.
    heard.forget();
    Some(())
}
