//! The door from the page: its script calls [`start`], and everything else happens in the canvas.
//!
//! What the canvas can't say is said in the page itself, in plain words: that there are no
//! graphics, or that the program has a fault. The page also has a copy of the names and places of
//! everything in the canvas, for screen readers ([`mirror`]).

mod mirror;

use crate::app::App;
use crate::store::{Prepared, prepare};
use js_sys::{Function, Uint8Array};
use wasm_bindgen::prelude::*;
use web_sys::{Document, Event, HtmlCanvasElement};

/// Starts the editor on the canvas of this id. `slot` is where this tab keeps its work, `left` are
/// slots of tabs that run no more, with their `bytes`; `keep` takes a slot and bytes to keep in it,
/// or nothing to empty it, and gives a promise. Without it nothing is kept.
///
/// # Errors
/// A text for people: there is no such canvas, or the browser gives no graphics.
#[wasm_bindgen]
pub async fn start(
    canvas: String,
    slot: String,
    left: Vec<String>,
    bytes: Vec<Uint8Array>,
    keep: Option<Function>,
) -> Result<(), JsValue> {
    say_panics();
    if let Some(keep) = keep {
        let left = left.into_iter().zip(bytes.iter().map(Uint8Array::to_vec)).collect();
        prepare(Prepared { slot, left, keep });
    }
    let canvas = document()
        .and_then(|document| document.get_element_by_id(&canvas))
        .and_then(|element| element.dyn_into::<HtmlCanvasElement>().ok())
        .ok_or_else(|| JsValue::from_str("The page has no place to draw on."))?;
    let runner = eframe::WebRunner::new();
    let options = eframe::WebOptions::default();
    let app: eframe::AppCreator<'static> = Box::new(|cc| {
        cc.egui_ctx.enable_accesskit();
        cc.egui_ctx.add_plugin(mirror::Mirror::default());
        Ok(Box::new(App::new(cc)))
    });
    runner.start(canvas, options, app).await?;
    ask_before_leaving(&runner)
}

/// The browser asks before it closes or leaves the page while there is work that no file has. Its
/// words are its own.
fn ask_before_leaving(runner: &eframe::WebRunner) -> Result<(), JsValue> {
    let Some(window) = web_sys::window() else { return Ok(()) };
    runner.add_event_listener(&window, "beforeunload", |event: Event, runner| {
        if runner.app_mut::<App>().editor().would_lose() {
            event.prevent_default();
        }
    })
}

fn document() -> Option<Document> {
    web_sys::window()?.document()
}

/// Shows in the page what a panic says; `eframe` writes it to the console.
fn say_panics() {
    let before = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |info| {
        if let Some(page) = document().and_then(|document| document.document_element()) {
            let _ = page.set_attribute("data-fault", &info.to_string());
        }
        before(info);
    }));
}
