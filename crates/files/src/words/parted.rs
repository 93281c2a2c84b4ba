//! Findings on panels that would bend if they were divided, in sentences.

use sheetwright::check::CutWay;

/// Where a panel would bend as several.
pub(super) fn bends_divided(parts: usize, way: CutWay, strain: &str, verdict: &str) -> String {
    let (how, size) = match way {
        CutWay::Across => ("straight across", "length"),
        CutWay::Lengthwise => ("lengthwise", "width"),
    };
    format!(
        "Divided {how} into {parts} panels of equal {size}, it takes its shape. Computed by \
         itself, 95 % of each panel stretches by less than {strain}, and it {verdict}. Draw them as panels of \
         their own: each has another pattern than its piece of this one."
    )
}

/// A panel would not bend as several either.
pub(super) fn divided_in_vain(most: usize) -> String {
    format!(
        "No division was found that helps: neither straight across nor lengthwise, into up to \
         {most} panels of equal size, does each of them clearly take its shape."
    )
}
