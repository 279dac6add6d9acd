"""The page of a film: matplotlib's player, without what it would fetch from elsewhere."""

from __future__ import annotations

import html
import re

__all__ = ["page", "player"]

FETCHED = re.compile(r'<link rel="stylesheet"\s*href="https?:[^>]*>')
ICON = re.compile(r'<i class="fa ([\w -]+)"></i>')
SYMBOLS = {
    "fa-minus": "&minus;",
    "fa-fast-backward": "|&#x25C0;&#xFE0E;",
    "fa-step-backward": "&#x25C1;&#xFE0E;",
    "fa-play fa-flip-horizontal": "&#x25C0;&#xFE0E;",
    "fa-pause": "||",
    "fa-play": "&#x25B6;&#xFE0E;",
    "fa-step-forward": "&#x25B7;&#xFE0E;",
    "fa-fast-forward": "&#x25B6;&#xFE0E;|",
    "fa-plus": "+",
}
"""signs that most fonts have; U+FE0E asks for a letter in place of a coloured picture"""


def player(jshtml: str) -> str:
    """The player with symbols of text in place of a font of icons that it would fetch."""
    return ICON.sub(lambda icon: SYMBOLS.get(icon[1], icon[1]), FETCHED.sub("", jshtml))


def page(title: str, body: str) -> str:
    """One page of HTML."""
    return (
        f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">'
        f"<title>{html.escape(title)}</title></head>\n<body>{body}</body></html>\n"
    )
