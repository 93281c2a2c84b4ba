use super::*;
use samples::*;
use sheetwright::check::{Checked, Verdict};
use sheetwright::design::Made;

fn all() -> Vec<Made> {
    vec![hull(40, "steel-5mm"), concave(), triangle(), quarter(), cone(), helicoid()]
}

fn checks(made: &Made) -> (Vec<f64>, Vec<Checked>) {
    let errors = made.panels.iter().map(|_| 2e-10).collect();
    (errors, made.panels.iter().map(|p| p.checked.clone()).collect())
}

fn html(made: &Made) -> String {
    let (errors, checked) = checks(made);
    String::from_utf8(report_html(made, &errors, &checked)).unwrap()
}

fn json(made: &Made) -> serde_json::Value {
    let (errors, checked) = checks(made);
    serde_json::from_slice(&report_json(made, &errors, &checked)).unwrap()
}

/// The inline pictures of a page.
fn pictures(page: &str) -> Vec<&str> {
    page.match_indices("<svg")
        .map(|(from, _)| {
            let to = page[from..].find("</svg>").unwrap();
            &page[from..from + to + "</svg>".len()]
        })
        .collect()
}

#[test]
#[ignore = "writes pages to look at"]
fn pages_to_look_at() {
    let dir = std::env::var("REPORT_PAGES").unwrap();
    let mut list = all();
    list.push(hull(200, "steel-5mm"));
    list.push(hull(200, "plywood-9mm"));
    for (n, made) in list.iter().enumerate() {
        std::fs::write(format!("{dir}/{n}.html"), html(made)).unwrap();
        let (errors, checked) = checks(made);
        std::fs::write(format!("{dir}/{n}.json"), report_json(made, &errors, &checked)).unwrap();
    }
}
