"""Messages of the page's own script (static/live_page.js) to the server: buttons in HTML, and outlines drawn over the scene.

viser has no event for these. The script writes each message into a hidden text field, whose changes viser sends.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from html import escape
from importlib.resources import files
from typing import Any

EMPTY_PICTURE = "data:image/gif;base64,R0lGODlhAQABAAAAACwAAAAAAQABAAA="
MAX_MESSAGE = 20_000  # characters of a message
MAX_OUTLINE = 500  # corners of an outline
FIELD = "Messages of the page"
Say = Callable[[str], None]
Outline = list[tuple[float, float]]  # 0..1 from the upper left corner of the picture


class PageMessages:
    """The hidden field.

    on_say: called with the words of a button; on_lasso: with a tab, an outline, and whether to take back.
    """

    def __init__(
        self, gui: Any, act: Callable[[Callable[[], None]], None], on_say: Say, on_lasso: Callable[[Any, Outline, bool], None]
    ) -> None:
        self._act, self._on_say, self._on_lasso = act, on_say, on_lasso
        style, script = _static("live_page.css"), escape(_static("live_page.js"), quote=True)
        runs = f'<img src="{EMPTY_PICTURE}" alt="" style="display:none" onload="{script}">'
        gui.add_html(f'<div id="anymesh-channel"><style>{style}</style>{runs}</div>')
        self._field = gui.add_text(FIELD, "")
        self._field.on_update(self._heard)

    def _heard(self, event: Any) -> None:
        if event.client is None:
            return
        message = parse(self._field.value)
        if isinstance(message, str):
            self._act(lambda: self._on_say(message))
        elif message is not None:
            outline, take_back = message
            self._act(lambda: self._on_lasso(event.client, outline, take_back))


def parse(text: str) -> str | tuple[Outline, bool] | None:
    """Return the words of a button, or an outline and whether its faces are taken back; None for anything else."""
    try:
        message = json.loads(text) if len(text) <= MAX_MESSAGE else None
        if isinstance(message, dict) and isinstance(message.get("say"), str):
            return message["say"]
        if isinstance(message, dict) and 3 <= len(message["lasso"]) <= MAX_OUTLINE:
            return [(_share(x), _share(y)) for x, y in message["lasso"]], bool(message.get("take"))
    except (ValueError, TypeError, KeyError, RecursionError):
        pass
    return None


def _share(value: Any) -> float:
    number = float(value)
    if not -10 <= number <= 10:
        raise ValueError(f"a corner of an outline lies in the picture, found {value!r}")
    return number


def _static(name: str) -> str:
    return files("anymesh.viewer").joinpath("static", name).read_text(encoding="utf-8")
