//! The verdict and the findings of a part, as the page shows them.

use crate::wording::verdict_word;
use crate::words::{finding_place, finding_text};
use maud::{Markup, html};
use sheetwright::check::{Checked, Finding, Place, Severity, Verdict};

/// The worst severity of the findings and of the verdict.
pub(super) fn severity(checked: &Checked) -> Severity {
    let of_verdict = match checked.verdict {
        Verdict::Bends => Severity::Note,
        Verdict::BendsWithForce | Verdict::Roll | Verdict::BendsAndFolds | Verdict::Undecided => {
            Severity::Warning
        }
        Verdict::WillNotBend => Severity::Error,
    };
    checked.findings.iter().map(Finding::severity).fold(of_verdict, Severity::max)
}

/// The verdict with its mark.
pub(super) fn verdict(checked: &Checked) -> Markup {
    let severity = severity(checked);
    let mark = match severity {
        Severity::Note => "✓",
        Severity::Warning => "!",
        Severity::Error => "×",
    };
    let word = verdict_word(checked.verdict);
    // A sheet that bends may have an error that forbids cutting it.
    let but = match (checked.verdict, severity) {
        (Verdict::WillNotBend, _) => "",
        (_, Severity::Error) => ", but do not cut it",
        (Verdict::Bends, Severity::Warning) => ", but read the warnings before you cut",
        _ => "",
    };
    html! {
        span class={ "verdict " (severity.name()) } {
            b aria-hidden="true" { i { (mark) } }
            span { (word) (but) }
        }
    }
}

/// All findings, each with its place and its code.
pub(super) fn findings(checked: &Checked) -> Markup {
    html! {
        @if checked.findings.is_empty() {
            p { "No findings." }
        } @else {
            ul.findings {
                @for finding in &checked.findings {
                    li class=(finding.severity().name()) {
                        span.kind { (severity_word(finding.severity())) } " "
                        (finding_text(finding))
                        span.where {
                            @if finding.place != Place::Whole {
                                "Where: " (finding_place(finding)) ". "
                            }
                            code { (finding.code()) }
                        }
                    }
                }
            }
        }
    }
}

fn severity_word(severity: Severity) -> &'static str {
    match severity {
        Severity::Note => "Note:",
        Severity::Warning => "Warning:",
        Severity::Error => "Error:",
    }
}
