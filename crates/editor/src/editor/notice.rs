//! What is said to the person, in a line: why something can't be done, that something was done, or
//! in passing that something is not possible now, which goes by itself.

use super::Editor;
use web_time::{Duration, Instant};

/// How long something is said in passing.
const PASSING: Duration = Duration::from_secs(4);

/// Something said to the person, in a line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Notice {
    /// What.
    pub text: String,
    /// Whether it is why something can't be done.
    pub is_refusal: bool,
    /// Whether it is said in passing: it goes after a while, and as soon as anything changes.
    pub is_passing: bool,
}

impl Editor {
    pub(super) fn refuse(&mut self, text: String) {
        self.notice = Some(Notice { text, is_refusal: true, is_passing: false });
    }

    pub(super) fn say(&mut self, text: impl Into<String>) {
        self.notice = Some(Notice { text: text.into(), is_refusal: false, is_passing: false });
    }

    pub(super) fn say_in_passing(&mut self, text: impl Into<String>) {
        self.said = Some((Instant::now(), self.history.version()));
        self.notice = Some(Notice { text: text.into(), is_refusal: false, is_passing: true });
    }

    /// Ends what was said in passing, when its time is over or something has changed since.
    pub(super) fn end_notice(&mut self) {
        if self.notice.as_ref().is_some_and(|notice| notice.is_passing)
            && self.said.is_none_or(|(since, version)| {
                since.elapsed() >= PASSING || version != self.history.version()
            })
        {
            self.notice = None;
        }
    }

    /// How long what is said in passing still stands.
    pub fn notice_ends_in(&self) -> Option<Duration> {
        self.notice.as_ref().filter(|notice| notice.is_passing)?;
        self.said.map(|(since, _)| PASSING.saturating_sub(since.elapsed()))
    }
}
