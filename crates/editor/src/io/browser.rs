//! Files in a browser: chosen by its own dialog, and downloaded.

use super::{Dialogs, FileAnswer, Typed};
use crate::editor::{Dropped, FileWish, Opened};
use crate::engine::Wake;
use eframe::egui::DroppedFileHandle;
use std::cell::RefCell;
use std::rc::Rc;

/// The dialogs of the browser.
pub struct SystemDialogs {
    answers: Rc<RefCell<Vec<FileAnswer>>>,
    wake: Wake,
}

impl SystemDialogs {
    /// Dialogs that wake the page when they are answered.
    pub fn new(wake: Wake) -> Self {
        Self { answers: Rc::default(), wake }
    }

    fn answer_later(&self, answer: impl Future<Output = Option<FileAnswer>> + 'static) {
        let (answers, wake) = (self.answers.clone(), self.wake.clone());
        wasm_bindgen_futures::spawn_local(async move {
            if let Some(answer) = answer.await {
                answers.borrow_mut().push(answer);
            }
            wake();
        });
    }
}

impl Dialogs for SystemDialogs {
    fn grant(&mut self, wish: FileWish) {
        self.answer_later(granted(wish));
    }

    fn answers(&mut self) -> Vec<FileAnswer> {
        self.answers.take()
    }

    fn grant_at(&mut self, _: &FileWish, path: &str, _: bool) -> Typed {
        Typed::Failed(format!("A browser has no file {path} of its own. Choose one in its dialog."))
    }

    fn read_dropped(&mut self, files: Vec<DroppedFileHandle>) {
        self.answer_later(async move {
            let mut read = Vec::with_capacity(files.len());
            for file in files {
                let path = file.path().display().to_string();
                read.push(Dropped { path, bytes: file.bytes_async().await });
            }
            Some(FileAnswer::Dropped(read))
        });
    }

    fn read(&mut self, path: &str) -> Result<Opened, String> {
        Err(format!("A browser can't open {path} by itself: choose Open."))
    }
}

async fn granted(wish: FileWish) -> Option<FileAnswer> {
    match wish {
        FileWish::Open => {
            let dialog = rfd::AsyncFileDialog::new()
                .add_filter("Designs, tables and meshes", &super::OPENED);
            Some(FileAnswer::Opened(read(dialog.pick_file().await?).await))
        }
        FileWish::Picture => {
            let pictures = crate::editor::PICTURES;
            let dialog = rfd::AsyncFileDialog::new().add_filter("Pictures", &pictures);
            Some(FileAnswer::Picture(read(dialog.pick_file().await?).await))
        }
        FileWish::Save { name, bytes, version, .. } => Some(match download(&name, &bytes) {
            Ok(()) => FileAnswer::Saved { path: name, version },
            Err(()) => FileAnswer::Failed(refused(&name)),
        }),
        FileWish::Export(files) => {
            let packed = sheetwright_files::zipped(&files).ok_or(());
            Some(match packed.and_then(|packed| download("patterns.zip", &packed)) {
                Ok(()) => FileAnswer::Exported {
                    count: files.len(),
                    folder: "patterns.zip among your downloads".to_owned(),
                },
                Err(()) => FileAnswer::Failed(refused("patterns.zip")),
            })
        }
    }
}

async fn read(file: rfd::FileHandle) -> Opened {
    Opened { path: file.file_name(), bytes: file.read().await }
}

fn refused(name: &str) -> String {
    format!("The browser does not let {name} be downloaded. Allow downloads for this page.")
}

/// Hands bytes to the browser's downloads.
fn download(name: &str, bytes: &[u8]) -> Result<(), ()> {
    use wasm_bindgen::JsCast;
    let parts = js_sys::Array::of1(&js_sys::Uint8Array::from(bytes));
    let blob = web_sys::Blob::new_with_u8_array_sequence(&parts).map_err(|_| ())?;
    let url = web_sys::Url::create_object_url_with_blob(&blob).map_err(|_| ())?;
    let document = web_sys::window().and_then(|window| window.document()).ok_or(())?;
    let link = document.create_element("a").map_err(|_| ())?;
    let link: web_sys::HtmlAnchorElement = link.dyn_into().map_err(|_| ())?;
    link.set_href(&url);
    link.set_download(name);
    link.click();
    web_sys::Url::revoke_object_url(&url).map_err(|_| ())
}
