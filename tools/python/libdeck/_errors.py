"""What libdeck raises."""
from __future__ import annotations

from typing import Any, Dict, List, Optional


class DeckError(Exception):
    """A deck that cannot be read, is no Starter deck, or cannot be converted.

    ``diagnostics`` is a list of findings as dictionaries with ``rule``, ``severity``, ``file``, ``line``,
    ``column``, ``end_column``, ``message`` and ``help``; it may be empty.
    """

    def __init__(self, message: str, diagnostics: Optional[List[Dict[str, Any]]] = None) -> None:
        super().__init__(message)
        self.diagnostics: List[Dict[str, Any]] = list(diagnostics or [])
