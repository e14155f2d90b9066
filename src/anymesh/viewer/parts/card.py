"""HTML of the selected part: how it moves, whether that is sure, its motions in pictures; and of a new part in the making."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from html import escape
from types import MappingProxyType

import numpy as np

from anymesh.correcting import ChooseMotion, Correction
from anymesh.correcting.motions import motion_words
from anymesh.correcting.regions import Level
from anymesh.pipeline.results import verdict
from anymesh.rendering.preview import extent
from anymesh.types import Asset, Joint, JointType
from anymesh.viewer.panels import badge
from anymesh.viewer.scene import color_of

BY_PERSON = ("corrected by hand", "confirmed by hand")  # begins of the reasons of joints that a person set
MAX_PROPOSED = 20  # proposals that are listed
SAME_WAY = 0.99  # minimum cosine between axes of one motion
LEVEL_HINTS = {
    Level.FACET: "The flat face that is clicked",
    Level.REGION: "The surface around it, up to its creases",
    Level.PIECE: "All that is connected with it, and what is mounted on that alone",
}
ADD = "Click what belongs to the new part; Shift-click takes it back."
DRAW = "Draw around what belongs to the new part; with Shift it is taken back. Right drag turns the view."


@dataclass(frozen=True, eq=False)
class ShownMotions:
    """The motions of a selected part, the likeliest first: as corrections, as joints, in words and pictures.

    copies: what gives its copies the same joint, None until known.
    """

    choices: tuple[ChooseMotion, ...] = ()
    joints: tuple[Joint, ...] = ()
    words: tuple[str, ...] = ()
    pictures: tuple[str, ...] = ()
    copies: tuple[Correction, ...] | None = None


@dataclass
class Choosing:
    """Faces in the making of a new part. lasso: whether outlines are drawn; seen: whether these take only what is seen."""

    level: Level
    lasso: bool = False
    seen: bool = True


def button(words: str, say: str, *, pressed: bool | None = None, kind: str = "", hint: str = "") -> str:
    """Return a button that the page's script reports."""
    state = "" if pressed is None else f' aria-pressed="{str(pressed).lower()}"'
    style, title = f' class="{kind}"' if kind else "", f' title="{escape(hint)}"' if hint else ""
    return f'<button type="button" data-say="{say}"{style}{state}{title}>{escape(words)}</button>'


def levels(now: Choosing | None) -> str:
    """Return the buttons that choose what a click takes."""
    chosen = None if now is None or now.lasso else now.level
    buttons = [button(level, f"level {level}", pressed=level is chosen, hint=LEVEL_HINTS[level]) for level in Level]
    buttons.append(button("Lasso", "lasso", pressed=now is not None and now.lasso, hint="Draw an outline around it"))
    return "".join(buttons)


def nothing_selected(asset: Asset, proposals: Mapping[str, float]) -> str:
    """Return what the card says before a part is selected, with the proposals. proposals: their probabilities, by part."""
    return _card(
        f"{_proposed(asset, proposals)}<p>Click a part to see how it moves, and to correct it. "
        "Click what should be a part and is none, to make it one.</p>"
        f'<div class="row"><span>New part:</span>{levels(None)}</div>'
    )


def _proposed(asset: Asset, proposals: Mapping[str, float]) -> str:
    """Return one row per proposal, the likeliest first, with buttons to accept it and to look at it; "" without any."""
    if not proposals:
        return ""
    joints, rows = {joint.child: joint for joint in asset.joints}, []
    for name in sorted(proposals, key=lambda name: -proposals[name])[:MAX_PROPOSED]:
        words = f"<b>{escape(name)}</b>: {escape(motion_words(asset, joints[name]))} {badge(proposals[name])}"
        tools = button("Accept", f"accept {name}", kind="main") + button("Look", f"look {name}")
        rows.append(f'<div class="row"><span>{words}</span>{tools}</div>')
    more = f"<p>and {len(proposals) - MAX_PROPOSED} more</p>" if len(proposals) > MAX_PROPOSED else ""
    head = "<p><b>Proposed</b>: too unsure to be written, so these parts stay fixed until you accept them.</p>"
    return head + "".join(rows) + more


def choosing_card(now: Choosing, counts: dict[str, int]) -> str:
    """Return the card of a new part. counts: part name -> number of its faces that are chosen."""
    told = ", ".join(f"{count:,} faces of {escape(name)}" for name, count in counts.items()) or "nothing chosen yet"
    tools = [button("Grow", "grow", hint="To the whole region, the whole piece, then what touches it (G)")]
    tools += [button("Take back", "back", hint="The last choice (Backspace)")]
    if now.lasso:
        tools.append(button("Only what is seen", "seen", pressed=now.seen))
    make = button("Make it a part", "make", kind="main", hint="Enter") if counts else ""
    return _card(
        f"<p><b>New part</b>: {DRAW if now.lasso else ADD}</p>"
        f'<div class="row">{levels(now)}</div><div class="row">{"".join(tools)}</div>'
        f'<p>{told}</p><div class="row">{make}{button("Cancel", "cancel", hint="Esc")}</div>'
    )


def part_card(
    asset: Asset, name: str, motions: ShownMotions | None, at: int | None, proposals: Mapping[str, float] = MappingProxyType({})
) -> str:
    """Return the card of a selected part.

    motions: None while they are searched for; at: which of its motions is shown; proposals: as in `nothing_selected`.
    """
    number = next(k for k, p in enumerate(asset.segmentation.parts) if p.name == name)
    joint = next((j for j in asset.joints if j.child == name), None)
    r, g, b = color_of(number)
    title = f'<span class="swatch" style="background:rgb({r},{g},{b})"></span> <b>{escape(name)}</b>'
    more = f'<div class="row"><span>New part from here:</span>{levels(None)}</div>'
    if joint is None:
        return _card(f"<p>{title}: carries the others and has no joint.</p>{more}")
    state, buttons = _state(asset, joint, title, proposals.get(name)), _buttons(joint, motions, name in proposals)
    return _card(f"{state}{buttons}{_gallery(asset, joint, motions, at)}{more}")


def _state(asset: Asset, joint: Joint, title: str, proposed: float | None) -> str:
    """Return how a part moves, and how sure that is. proposed: the probability of a proposal."""
    what = f"{escape(motion_words(asset, joint))} <span class='quiet'>{escape(extent(joint))}</span>"
    if joint.reason.startswith(BY_PERSON):
        return f'<p>{title}: {what} <span class="now">✓ {joint.reason.partition(":")[0]}</span></p>'
    said = verdict(asset.segmentation, joint, asset.warnings)
    why = f'<p class="why">{escape(said.why)}</p>' if said.why else ""
    if proposed is not None:
        why = f"<p><b>Proposed</b>, not written: right with probability {proposed:.2f}</p>{why}"
    return f"<p>{title}: {what} {badge(joint.confidence, said.word)}</p>{why}"


def _buttons(joint: Joint, motions: ShownMotions | None, proposed: bool) -> str:
    buttons = []
    if proposed:
        buttons.append(button("Accept", "confirm", kind="main", hint="The joint is right, and is written"))
    elif not joint.reason.startswith(BY_PERSON):
        buttons.append(button("This joint is right", "confirm", hint="Clears its warning"))
    if joint.type is not JointType.FIXED:
        buttons.append(button("Flip direction", "flip", hint="Opens the other way"))
    buttons.append(button("Not a part", "remove", hint=f"It becomes a piece of {joint.parent} again"))
    copies = () if motions is None or motions.copies is None else motions.copies
    count = sum(isinstance(c, ChooseMotion) for c in copies)
    if count:
        words = f"The same for its {count} copies" if count > 1 else "The same for its copy"
        buttons.insert(0, button(words, "copies", kind="main" if joint.confidence == 1 else ""))
    return f'<div class="row">{"".join(buttons)}</div>'


def _gallery(asset: Asset, joint: Joint, motions: ShownMotions | None, at: int | None) -> str:
    """Return the motions in pictures."""
    if motions is None:
        return '<p class="quiet" role="status">Looking for its motions …</p>'
    if not motions.joints:
        return "<p>No free motion was found. Give it an axis in the tab Correct: click an edge, or drag it.</p>"
    cards = []
    for k, (words, picture) in enumerate(zip(motions.words, motions.pictures, strict=True)):
        now = '<span class="now">now</span>' if same_motion(joint, motions.joints[k]) else ""
        cards.append(
            f'<button type="button" data-say="motion {k}" aria-pressed="{str(k == at).lower()}">'
            f'<img src="{picture}" alt="">{escape(words)} {now}</button>'
        )
    take = button("Take this one", "take", kind="main", hint="Enter") + button("Leave it", "leave", hint="Esc")
    head = '<span class="quiet">How else it may move (arrow keys, Enter):</span>' if at is None else take
    return f'<div class="row">{head}</div><div class="grid">{"".join(cards)}</div>'


def same_motion(a: Joint, b: Joint, near: float = 1e-6) -> bool:
    """Return whether two joints of a part are the same motion. near: maximum distance of their axes [m]."""
    if a.type is not b.type or a.type is JointType.FIXED:
        return a.type is b.type
    off = np.linalg.norm(np.cross(b.origin - a.origin, a.axis))
    return float(a.axis @ b.axis) > SAME_WAY and (a.type is JointType.PRISMATIC or float(off) <= near)


def _card(content: str) -> str:
    return f'<div class="am">{content}</div>'
