"""What the panels of the live page share: its protocol, and texts as HTML.

Names from files are escaped, so that they cannot inject code.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from html import escape
from pathlib import Path
from typing import Any, Protocol, runtime_checkable

import numpy as np

from anymesh.correcting import Correction
from anymesh.names import confidence_word
from anymesh.pipeline.results import verdict
from anymesh.rendering.preview import extent
from anymesh.types import Asset, Joint, JointType
from anymesh.types.motion import SLIDING
from anymesh.viewer.scene import color_of
from anymesh.viewer.session import Session

COLORS = {"sure": ("#2b8a3e", "#fff"), "check": ("#f2b01e", "#201500"), "guess": ("#c92a2a", "#fff")}  # green, amber, red
SMALL = 'style="font-size:0.8em;line-height:1.35;padding:0 0.8em 0.4em;overflow-wrap:anywhere"'


def badge(value: float, word: str = "") -> str:
    """Return a confidence as a coloured label. word: sure, check or guess, by default as the confidence says."""
    word = word or confidence_word(value)
    ground, text = COLORS[word]
    style = f"background:{ground};color:{text};border-radius:3px;padding:0 0.35em"
    return f'<span role="img" aria-label="{value:.2f}: {word}" style="{style}">{value:.2f}</span>'


def head(asset: Asset, *, unsaved: int, note: str, tool: str) -> str:
    """Return the head of the page, with warnings first."""
    lines = [_line("#c92a2a", w) for w in asset.warnings]
    lines += [_line("#1864ab", note)] if note else []
    lines += [_line("#862e9c", tool)] if tool else []
    moving = sum(j.type is not JointType.FIXED for j in asset.joints)
    summary = f"<b>{escape(asset.name)}</b>: {_count(len(asset.segmentation.parts), 'part')}, {_count(moving, 'moving joint')}"
    left = f" · <b>{_count(unsaved, 'correction')} not saved</b>" if unsaved else ""
    return f"<div {SMALL}>{summary}{left}{''.join(lines)}</div>"


def _count(count: int, what: str) -> str:
    return f"{count} {what}{'' if count == 1 else 's'}"


def _line(color: str, text: str) -> str:
    return f'<div style="border-left:3px solid {color};padding-left:0.5em;margin-top:0.25em">{escape(text)}</div>'


def joint_table(asset: Asset) -> str:
    """Return a table of joints with range, confidence and reason, least confident first."""
    number = {p.name: k for k, p in enumerate(asset.segmentation.parts)}
    rows = [_row(number[j.child], j, asset) for j in sorted(asset.joints, key=lambda j: j.confidence)]
    return f"<div {SMALL}>{''.join(rows) or 'Nothing moves.'}</div>"


def _row(number: int, joint: Joint, asset: Asset) -> str:
    r, g, b = color_of(number)
    dot = f'<span style="display:inline-block;width:0.8em;height:0.8em;border-radius:2px;background:rgb({r},{g},{b})"></span>'
    outcome = verdict(asset.segmentation, joint, asset.warnings)
    summary = f"{badge(joint.confidence, outcome.word)} {dot} <b>{escape(joint.child)}</b> {joint.type} {escape(extent(joint))}"
    return f'<div style="margin-top:0.3em">{summary}<br><span style="opacity:0.75">{escape(joint.reason)}</span></div>'


def selection(asset: Asset, name: str | None) -> str:
    """Describe the selected part: its label, its motion, and the reasons."""
    if name is None:
        return f"<div {SMALL}>Click a part to select it.</div>"
    number, part = next((k, p) for k, p in enumerate(asset.segmentation.parts) if p.name == name)
    faces = f"{len(asset.segmentation.faces(number)):,} faces"
    summary = f"<b>{escape(part.name)}</b> ({escape(part.label)}), {faces} {badge(part.confidence)} {escape(part.reason)}"
    joint = next((j for j in asset.joints if j.child == name), None)
    if joint is None:
        return f"<div {SMALL}>{summary}<br>The root: it carries the others and has no joint.</div>"
    return f"<div {SMALL}>{summary}{_row(number, joint, asset)}parent: {escape(joint.parent)}</div>"


def scale_of(joint: Joint) -> tuple[float, str]:
    """Return the display factor of a joint's positions, and its unit: degrees or centimetres."""
    return (100.0, "cm") if joint.type in SLIDING else (float(np.rad2deg(1)), "°")


def shortened(text: str, most: int = 60) -> str:
    """Shorten a text for a dropdown list."""
    return text if len(text) <= most else f"{text[: most - 1]}…"


def distinct(labels: Sequence[str]) -> list[str]:
    """Number the labels, so that no two are equal."""
    return [f"{k}. {label}" for k, label in enumerate(labels, 1)]


@runtime_checkable
class Page(Protocol):
    """A page with at most one asset. server, gui: of the viewer library; view: draws the scene."""

    server: Any
    gui: Any
    view: Any
    session: Session | None

    def is_browsing(self) -> bool:
        """Return whether arrow keys go through the motions of a part."""
        ...

    def act(self, what: Callable[[], None]) -> None:
        """Run a person's action under the lock; errors are shown, and nothing changes then."""
        ...

    def open(self, folder: Path) -> None:
        """Show the asset of an output folder. Raise OutputError if there is none."""
        ...

    def shut(self) -> None:
        """Remove the asset from the page."""
        ...

    def refresh(self) -> None:
        """Draw everything from the session."""
        ...

    def tell_head(self) -> None:
        """Update the head of the page."""
        ...

    def correct(self, *corrections: Correction, joined: bool = False) -> None:
        """Apply corrections to the displayed asset as one step, or joined to the step before."""
        ...

    def select(self, name: str | None) -> None:
        """Select the part to correct."""
        ...

    def show_message(self, text: str, *, bad: bool = False) -> None:
        """Show a message in every tab."""
        ...

    def play_joint(self, joint: str | None) -> None:
        """Move a joint back and forth ("" for all, None to stop)."""
        ...

    def key(self, label: str, key: str, what: Callable[[], None], modifier: str | None = None) -> None:
        """Add a keyboard shortcut to the page, and to its list of commands (Ctrl-K)."""
        ...


def offer(dropdown: Any, options: tuple[str, ...], value: str) -> None:
    """Set the options and value of a dropdown list, only if they change."""
    if tuple(dropdown.options) != options:
        dropdown.options = options
    if dropdown.value != value:
        dropdown.value = value
