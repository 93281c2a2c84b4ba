//! The editor: people draw the outline of a panel, lift it, and have the surface that fits it best,
//! the answer to "will it bend?" and the pattern to cut, all live.
//!
//! ```text
//!            acts                           jobs
//! panes ────────────────► app ──► document ──────► engine (a thread, or a worker in the browser)
//!   ▲                      │                          │
//!   └────── scene ◄────────┴──────────────────────────┘
//! ```
//!
//! A pane looks at the scene (the document and what was last made of it), draws it, and answers
//! with acts; the app alone carries them out. The document is one plain value, so that undo is a
//! list of values. All geometry is the kernel's; all bytes are those of `sheetwright-files`.

pub mod app;
mod bars;
pub mod command;
pub mod document;
pub mod editor;
pub mod engine;
mod envelope;
mod field;
pub mod io;
mod layout;
pub mod pages;
pub mod panes;
pub mod room;
pub mod scene;
mod side;
pub mod store;
pub mod theme;
mod thumb;
mod verdicts;
pub mod views;
#[cfg(target_arch = "wasm32")]
pub mod web;
mod words;
