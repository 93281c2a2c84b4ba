//! Many panels in, a table out, without holding either: a curve table with a panel after the other
//! (`panels`), designs as JSON lines (`designs`), and a table with a row a panel (`row`) that is
//! read back when a batch goes on (`kept`).
//!
//! Every row is one line, whatever stands in its cells, so a table that was cut off anywhere is
//! whole up to its last line feed.

mod count;
mod designs;
mod ids;
mod kept;
mod lines;
mod panels;
mod row;

pub use count::BatchCount;
pub use designs::{DesignLine, DesignLines};
pub use ids::Ids;
pub use kept::KeptRow;
pub use panels::{TablePanel, TablePanels, holds_panels};
pub use row::{RowError, RowHead, TableForm, TableRows};
