//! The desktop program.

#[cfg(not(target_arch = "wasm32"))]
fn main() -> eframe::Result {
    use eframe::egui::ViewportBuilder;
    let viewport = ViewportBuilder::default()
        .with_title("Sheetwright")
        .with_app_id("sheetwright")
        .with_inner_size([1280.0, 800.0])
        .with_min_inner_size([640.0, 420.0]);
    let options = eframe::NativeOptions { viewport, ..eframe::NativeOptions::default() };
    eframe::run_native(
        "Sheetwright",
        options,
        Box::new(|cc| {
            let mut app = sheetwright_editor::app::App::new(cc);
            if let Some(path) = std::env::args().nth(1) {
                app.open_path(&path);
            }
            Ok(Box::new(app))
        }),
    )
}

/// In a browser the page starts the editor through the library.
#[cfg(target_arch = "wasm32")]
fn main() {}
