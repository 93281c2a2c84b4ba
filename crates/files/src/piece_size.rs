//! The largest size of a piece of facets, as it is typed.

use crate::pdf::Paper;
use crate::stock::{size_text, stock_sheet};
use sheetwright::design::{SheetForm, StockSheet};

/// The width and height that no piece exceeds, mm, as they are typed: the name of a paper, on one
/// sheet of which a piece is printed (`a4`), or `280x200`, `28x20cm`.
///
/// # Errors
/// Another text; the error says what to type.
pub fn piece_size(text: &str) -> Result<[f64; 2], String> {
    if let Some(paper) = Paper::from_name(text.trim()) {
        return Ok(paper.whole_piece_mm());
    }
    match stock_sheet(text) {
        Ok(StockSheet { form: SheetForm::Rectangle { size }, count: None, .. }) => Ok(size),
        _ => Err("give a4, letter or another size of paper, or a width and a height such as \
                  280x200"
            .to_owned()),
    }
}

/// That size as it is typed: the name of the paper on one sheet of which such a piece just fits, or
/// its width and height.
pub fn piece_size_text(size: [f64; 2]) -> String {
    let paper = Paper::SHEETS.into_iter().find(|paper| paper.whole_piece_mm() == size);
    paper.map_or_else(|| size_text(size), |paper| paper.title())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_of_pieces_are_read_as_they_are_typed_and_written_so() {
        assert_eq!(piece_size("280x200"), Ok([280.0, 200.0]));
        assert_eq!(piece_size("28 × 20 cm"), Ok([280.0, 200.0]));
        assert_eq!(piece_size("28cmx200mm"), Ok([280.0, 200.0]));
        assert_eq!(piece_size_text([280.0, 200.5]), "280x200.5mm");
        for paper in Paper::SHEETS {
            let text = piece_size_text(paper.whole_piece_mm());
            assert_eq!(piece_size(&text), Ok(paper.whole_piece_mm()), "{text}");
            assert_eq!(piece_size(&text.to_lowercase()), Ok(paper.whole_piece_mm()));
        }
        for text in ["", "a9", "280", "0x20", "3x280x200", "roll:900mm", "-1x2"] {
            assert!(piece_size(text).is_err(), "{text}");
        }
    }
}
