"""The sides of an object by their names: motions in words, and a small compass in pictures."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float, Shaped, UInt8
from PIL import Image, ImageDraw

from anymesh.rendering.marks import draw_arrow, font
from anymesh.rendering.viewpoints import away
from anymesh.types import JointType, Motion
from anymesh.types.brief import Brief
from anymesh.types.camera import Camera

ALONG = 0.94  # cosine of 20 degrees: a line nearer to the vertical, or to the level, is called so
NAMED = 0.38  # sine of 22 degrees: a direction with a larger share along a side is named after it
EDGE, THIN = 0.5, 0.1  # shares of half the part's extent there, and of its largest one: an axis farther off is at an edge
BEYOND = 1.3  # share of half the part's extent: an axis farther off lies beyond it
FARTHER = 1.1  # ratio of amounts from which the words differ
LEAST_TOLD = 0.5  # offset [% of the part's size] or angle [degrees] between axes from which the words differ
IN_PLACE = 0.1  # share of the part's size across the axis: a part whose middle moves less turns in place
WAYS = {"top": "up", "bottom": "down"}
OPPOSITE = "the opposite way"
COMPASS, LETTERS, ARM = 104, 14, 30  # [px] in a panel of 400: size of a compass, font size, length of an arrow
WORDS = 66  # [px] height of the words of a panel of that size, three lines
REFERENCE = 400  # [px] size of a panel that these refer to
CLEAR = 235  # brightness of the ground of a compass


@dataclass(frozen=True, eq=False)
class Sides:
    """The sides of an object, as seen by somebody before its front.

    front: azimuth from which the front is seen [deg], None if unknown; then only top and bottom have names.
    """

    front: float | None = None

    @property
    def axes(self) -> tuple[tuple[Float[np.ndarray, " 3"], str, str], ...]:
        """Return unit directions with the names of their two ends."""
        up = (np.array([0.0, 0.0, 1.0]), "top", "bottom")
        if self.front is None:
            return (up,)
        right, ahead = (away(float(np.deg2rad(self.front + a)), 0.0) for a in (90.0, 0.0))
        return up, (right, "right", "left"), (ahead, "front", "back")

    def direction(self, way: Float[np.ndarray, " 3"]) -> str:
        """Name a direction, by up to two sides, the larger share first; "sideways" where none has a name."""
        unit = way / max(float(np.linalg.norm(way)), 1e-12)
        shares = sorted(((float(unit @ axis), plus, minus) for axis, plus, minus in self.axes), key=lambda s: -abs(s[0]))
        names = [plus if share > 0 else minus for share, plus, minus in shares if abs(share) > NAMED][:2]
        level = " and ".join(name for name in names if name not in WAYS)
        ways = [*(WAYS[name] for name in names if name in WAYS), *([f"to the {level}"] if level else [])]
        return " and ".join(ways) or "sideways"

    def side(self, offset: Float[np.ndarray, " 3"]) -> str:
        """Name the side on which an offset from the middle lies."""
        share, plus, minus = max(
            ((float(offset @ axis), plus, minus) for axis, plus, minus in self.axes), key=lambda s: abs(s[0])
        )
        return plus if share > 0 else minus

    def words(self, motion: Motion, amount: float, points: Float[np.ndarray, "n 3"]) -> str:
        """Describe a motion: about which edge the part turns, and where to its middle goes.

        amount: [rad or m]; points: on the part [m].
        """
        middle = (points.min(0) + points.max(0)) / 2
        goes = "in place" if (way := _way(motion, amount, points)) is None else self.direction(way)
        if motion.kind is JointType.PRISMATIC:
            return f"slides {goes}"
        return f"turns {self._place(motion, middle, points)}, {goes}"

    def all_words(
        self, motions: Sequence[Motion], amounts: Sequence[float], points: Float[np.ndarray, "n 3"]
    ) -> tuple[str, ...]:
        """Describe motions of one part in words that differ, as in `words`."""
        words = [self.words(motion, amount, points) for motion, amount in zip(motions, amounts, strict=True)]
        size = max(float(np.linalg.norm(np.ptp(points, axis=0))), 1e-12)
        ways = [_way(motion, amount, points) for motion, amount in zip(motions, amounts, strict=True)]

        def further(k: int, first: int) -> str:
            axis, there, here = self._further(motions[k], motions[first], size), ways[k], ways[first]
            if there is None or here is None:
                there, here = (motions[n].axis * np.sign(amounts[n]) for n in (k, first))
            if float(there @ here) < -NAMED * float(np.linalg.norm(there) * np.linalg.norm(here)):
                return f"{axis} and {OPPOSITE}" if axis else OPPOSITE
            ratio = abs(amounts[k]) / max(abs(amounts[first]), 1e-12)
            return axis or ("farther" if ratio > FARTHER else "less far" if ratio < 1 / FARTHER else "")

        return told_apart(words, further)

    def _further(self, motion: Motion, first: Motion, size: float) -> str:
        """Tell where the axis of a motion is, from that of another motion of a part of this size [m]."""
        offset = motion.origin - first.origin
        offset = offset - (offset @ motion.axis) * motion.axis
        share = 100 * float(np.linalg.norm(offset)) / size
        if motion.kind is JointType.REVOLUTE and share >= LEAST_TOLD:
            return f"its axis {share:.0f} % of its size further {self.direction(offset)}"
        turned = np.degrees(np.arccos(min(abs(float(motion.axis @ first.axis)), 1.0)))
        return f"tilted by {turned:.0f} degrees" if turned >= LEAST_TOLD else ""

    def _place(self, motion: Motion, middle: Float[np.ndarray, " 3"], points: Float[np.ndarray, "n 3"]) -> str:
        """Name the edge of the part that the axis runs along, or its direction through the part."""
        off = motion.origin - middle
        off = off - (off @ motion.axis) * motion.axis
        extents = [float(np.ptp(points @ axis)) / 2 for axis, _, _ in self.axes]
        largest, names, beyond = max(float(np.ptp(points, axis=0).max()) / 2, 1e-12), [], False
        for (axis, plus, minus), half in zip(self.axes, extents, strict=True):
            share = float(off @ axis)
            if abs(share) > max(EDGE * half, THIN * largest):
                names.append(plus if share > 0 else minus)
                beyond |= abs(share) > max(BEYOND * half, half + THIN * largest)
        if len(names) > 1:
            return f"{'beyond' if beyond else 'at'} its {' '.join(names)}{'' if beyond else ' edge'}"
        if names:
            return f"about {self._line(motion.axis)} {'beyond' if beyond else 'at'} its {names[0]}"
        way, line = off / max(float(np.linalg.norm(off)), 1e-12), self._line(motion.axis)
        if float(off @ way) > max(EDGE / 2 * float(np.ptp(points @ way)), THIN * largest):
            return f"about {line} off its middle{'' if self.front is None else f' {self.direction(way)}'}"
        return f"about {line} through its middle"

    def _line(self, axis: Float[np.ndarray, " 3"]) -> str:
        """Name the direction of a line."""
        words = {"top": "an upright axis", "right": "a left-right axis", "front": "a front-back axis"}
        named = next((words[plus] for along, plus, _ in self.axes if abs(float(axis @ along)) > ALONG), None)
        return named or ("a level axis" if abs(axis[2]) < np.sqrt(1 - ALONG**2) else "a slanted axis")

    def compass(self, camera: Camera) -> UInt8[np.ndarray, "h w 3"]:
        """Draw arrows up, to the front and to the left as a camera sees them; the last two where the front is known."""
        drawn = Image.new("RGB", (2 * COMPASS, 2 * COMPASS), (CLEAR,) * 3)
        draw = ImageDraw.Draw(drawn)
        ways = [(self.axes[0][0], "up", (30, 110, 40))]
        if self.front is not None:
            ways += [(-self.axes[1][0], "left", (150, 60, 10)), (self.axes[2][0], "front", (30, 60, 170))]
        flat = camera.T_world_camera[:3, :2].T
        arms = [2 * ARM * (flat @ way) for way, _, _ in ways]
        for arm, (_, _, color) in zip(arms, ways, strict=True):
            draw_arrow(draw, np.stack([np.full(2, float(COMPASS)), COMPASS + arm]), color, scale=1.6)
        low = np.array([2.6, 1.0]) * LETTERS
        for arm, (_, name, color) in zip(arms, ways, strict=True):
            beyond = 2.6 * LETTERS / max(float(np.linalg.norm(arm)), 2.0 * LETTERS)
            x, y = np.clip(COMPASS + arm * (1 + beyond), low, 2 * COMPASS - low).tolist()
            draw.text((x, y), name, fill=color, font=font(2 * LETTERS), anchor="mm", stroke_width=4, stroke_fill=(CLEAR,) * 3)
        return np.asarray(drawn)


def _way(motion: Motion, amount: float, points: Float[np.ndarray, "n 3"]) -> Float[np.ndarray, " 3"] | None:
    """Return where the middle of a part goes, None if it turns in place."""
    if motion.kind is JointType.PRISMATIC:
        return motion.axis * (np.sign(amount) or 1.0)  # also of one that is blocked at once
    middle, T = (points.min(0) + points.max(0)) / 2, motion.transform(amount)
    size = float(np.linalg.norm(np.ptp(points - np.outer(points @ motion.axis, motion.axis), axis=0)))
    way = T[:3, :3] @ middle + T[:3, 3] - middle
    return way if np.linalg.norm(way) > IN_PLACE * size else None


def told_apart(words: Sequence[str], further: Callable[[int, int], str]) -> tuple[str, ...]:
    """Return words about motions that differ. further: how a motion differs from an earlier one, by indices, "" if unknown."""
    told: list[str] = []
    last: dict[str, int] = {}  # the last motion that these words alone describe
    for k, word in enumerate(words):
        more = further(k, words.index(word)) if word in words[:k] else ""
        text = f"{word}, {more}" if more else word
        told.append(text)
        if (like := last.get(text)) is not None:
            more = further(k, like)
            told[k] = f"as {like + 1}, but {more}" if more else f"the same as {like + 1}"
        last[text] = k
    return tuple(told)


def with_compass(
    panel: UInt8[np.ndarray, "H W 3"], compass: UInt8[np.ndarray, "h w 3"], corner: tuple[bool, bool]
) -> UInt8[np.ndarray, "H W 3"]:
    """Return a panel with a compass in a corner, below its words. corner: whether it is the lower, and the right one."""
    size, top, drawn = *(round(n * panel.shape[0] / REFERENCE) for n in (COMPASS, WORDS)), panel.copy()
    y, x = (n - size - 2 if far else near for n, far, near in zip(panel.shape[:2], corner, (top, 2), strict=True))
    drawn[y : y + size, x : x + size] = np.asarray(Image.fromarray(compass).resize((size, size), Image.Resampling.BOX))
    return drawn


def in_corner(used: Shaped[np.ndarray, "H W"], corner: tuple[bool, bool]) -> int:
    """Add up the used pixels of a panel, or their weights, that a compass in a corner covers."""
    size, top = (round(n * used.shape[0] / REFERENCE) for n in (COMPASS, WORDS))
    rows, columns = (
        (slice(-size, None) if far else slice(near, near + size)) for far, near in zip(corner, (top, 0), strict=True)
    )
    return int(used[rows, columns].sum())


def emptiest_corner(used: Shaped[np.ndarray, "H W"]) -> tuple[bool, bool]:
    """Return the corner of a panel, except for the upper left one, in which a compass covers the fewest used pixels."""
    return min(((True, False), (True, True), (False, True)), key=lambda corner: in_corner(used, corner))


UNNAMED = Sides()


@dataclass(frozen=True, eq=False)
class SeenFrom(Brief):
    """Where pictures are taken from.

    facing: direction to the side that the camera is on, None for any; sides: of the object.
    """

    facing: Float[np.ndarray, " 3"] | None = None
    sides: Sides = UNNAMED


ANYWHERE = SeenFrom()
