"""The error of the package."""

from __future__ import annotations


class SheetwrightError(ValueError):
    """An input or a call that can't be used, and what to do about it."""

    message: str
    """What is wrong."""
    hint: str
    """What to do."""
    place: str | None
    """Where: a file, with a line (``leaf.csv:12``) or a JSON path; None where it is no file."""

    def __init__(self, message: str, hint: str = "", place: str | None = None) -> None:
        """Keep the message, the hint and the place."""
        super().__init__(message, hint, place)
        self.message = message
        self.hint = hint
        self.place = place

    def __str__(self) -> str:
        """Say where, what, and in a second line what to do."""
        said = f"{self.place}: {self.message}" if self.place else self.message
        return f"{said}\nhint: {self.hint}" if self.hint else said
