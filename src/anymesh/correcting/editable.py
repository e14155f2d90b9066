"""An asset opened for corrections in Python: `anymesh.load`."""

from __future__ import annotations

import getpass
from collections.abc import Mapping, Sequence
from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import Float

from anymesh.correcting.history import History, Opened, open_asset, save_asset
from anymesh.correcting.listing import changed_rows, motion_rows, named_part, part_rows, region_rows
from anymesh.correcting.parsing import corrections_of
from anymesh.correcting.proposals import unsure
from anymesh.correcting.tree import joint_of_part, part_number
from anymesh.pipeline.results import verdict
from anymesh.types import Asset, Joint, JointType

SHOWN = 8  # joints that are printed
Value = str | int | float | Sequence[str | int | float] | np.ndarray  # of an operation, in the units of the command line


def load(folder: str | Path, *, author: str | None = None) -> EditableAsset:
    """Open an output folder to look at its asset and to correct it.

    author: name in the log of corrections, the user's by default. Nothing is written before `save`.
    Raise OutputError if the folder is not an output of anymesh, or lacks a stage.
    """
    return EditableAsset(open_asset(folder), user_name() if author is None else author)


def user_name() -> str:
    """Return the name of the user, "unknown" if the system has none."""
    try:
        return getpass.getuser()
    except (OSError, KeyError):
        return "unknown"


def now() -> str:
    """Return the time, ISO 8601."""
    return datetime.now(UTC).isoformat(timespec="seconds")


class EditableAsset:
    """An asset with its corrections. A correction that is not applicable raises CorrectionError and changes nothing.

    Angles are in degrees and lengths in metres, or texts with a unit such as "1.9rad" and "40cm"; the asset frame has Z up.
    """

    def __init__(self, opened: Opened, author: str) -> None:
        self._opened, self._author = opened, author
        self._saved = opened.history

    @property
    def folder(self) -> Path:
        """The output folder."""
        return self._opened.folder

    @property
    def asset(self) -> Asset:
        """The asset as corrected so far, in metres and radians."""
        return self._opened.history.asset

    @property
    def parts(self) -> tuple[str, ...]:
        """The names of all parts, the root first."""
        return tuple(p.name for p in self.asset.segmentation.parts)

    @property
    def joints(self) -> tuple[EditableJoint, ...]:
        """All joints."""
        return tuple(EditableJoint(self, j.child) for j in self.asset.joints)

    @property
    def proposals(self) -> tuple[EditableJoint, ...]:
        """The joints that are too unsure to be written: their parts are fixed in the files until they are accepted."""
        return tuple(EditableJoint(self, part) for part in unsure(self.asset, self._opened.precision))

    @property
    def precision(self) -> float:
        """The probability from which joints are written; 0: all are."""
        return self._opened.precision

    @property
    def warnings(self) -> tuple[str, ...]:
        """What to look at."""
        return self.asset.warnings

    def joint(self, name: str) -> EditableJoint:
        """Return a joint by its name or that of its part. Raise CorrectionError, with the valid names, if there is none."""
        part = named_part(self.asset, name)
        joint_of_part(self.asset, part)
        return EditableJoint(self, part)

    def correct(self, part: str | None = None, **operations: Value | bool) -> EditableAsset:
        """Apply operations as the command line does, such as `correct("door_1", motion=3, copies=True)`, as one step.

        The names, values and their order are those of `anymesh correct`.
        """
        corrections = corrections_of(self.asset, part, operations)
        self.take(self._opened.history.do_all(corrections, now(), self._author))
        return self

    def merge(self, part: str, into: str) -> EditableAsset:
        """Merge a part into another one, which keeps its name and joint."""
        return self.correct(merge=(part, into))

    def new_part(self, part: str, name: str, regions: Sequence[int]) -> EditableJoint:
        """Make regions of a part, by their numbers from `regions`, a new part fixed to it; return its joint."""
        before = set(self.parts)
        self.correct(part, new_part=name, region=[str(k) for k in regions])
        return EditableJoint(self, next(p for p in self.parts if p not in before))

    def regions(self, part: str) -> list[dict[str, Any]]:
        """Return the regions of a part that may become new parts: number, kind, faces, size and middle [m]."""
        return region_rows(self.asset, part)

    def undo(self) -> EditableAsset:
        """Undo the last step, also one that was saved. Raise CorrectionError if there is none."""
        self.take(self._opened.history.undo())
        return self

    def redo(self) -> EditableAsset:
        """Redo the step that was undone last. Raise CorrectionError if there is none."""
        self.take(self._opened.history.redo())
        return self

    def changes(self) -> list[dict[str, Any]]:
        """Return one row per joint that is not as it was saved."""
        return changed_rows(self._saved.asset, self.asset)

    def save(self) -> EditableAsset:
        """Write all files of the asset again, with a log of the corrections. Return this asset.

        Raise StaleError if somebody else saved it since it was opened; then nothing is written.
        """
        if self._opened.history.done != self._saved.done:
            self._opened = save_asset(self._opened)
            self._saved = self._opened.history
        return self

    def take(self, history: History) -> None:
        """Continue from another history of the same asset."""
        self._opened = replace(self._opened, history=history)

    def __repr__(self) -> str:
        rows, name = part_rows(self.asset), self.asset.name
        unsaved = "" if self._opened.history.done == self._saved.done else ", not saved"
        head = f"{name}: {len(self.parts)} parts, {len(self._opened.history.done)} corrections{unsaved} ({self.folder})"
        lines = [f"  {r['part']}: {r['motion']}, {r['range'] or 'fixed'}, {r['verdict']}" for r in rows]
        more = [f"  and {len(rows) - SHOWN} more"] if len(rows) > SHOWN else []
        return "\n".join((head, *lines[:SHOWN], *more))


class EditableJoint:
    """A joint of an `EditableAsset`, known by its part. What is set applies at once, and is written by `EditableAsset.save`."""

    def __init__(self, asset: EditableAsset, part: str) -> None:
        self._asset, self._part = asset, part

    @property
    def part(self) -> str:
        """The name of the part that the joint carries."""
        return self._part

    @property
    def name(self) -> str:
        """The name of the joint."""
        return self._joint.name

    @property
    def type(self) -> JointType:
        """The type; set it to revolute, prismatic, continuous or fixed, which brings the usual limits."""
        return self._joint.type

    @type.setter
    def type(self, value: JointType | str) -> None:
        self._do(type=str(value))

    @property
    def limits(self) -> tuple[float, float] | None:
        """The limits [deg, or m for a slide]; set two numbers, or texts with units such as "0,40cm"."""
        joint = self._joint
        if joint.limits is None or joint.type is JointType.PRISMATIC:
            return joint.limits
        lower, upper = np.rad2deg(joint.limits)
        return float(lower), float(upper)

    @limits.setter
    def limits(self, value: Value) -> None:
        self._do(limits=value)

    @property
    def axis(self) -> Float[np.ndarray, " 3"]:
        """The unit axis in the asset frame; set three numbers, or a text such as "-z"."""
        return self._joint.axis

    @axis.setter
    def axis(self, value: Value) -> None:
        self._do(axis=value)

    @property
    def origin(self) -> Float[np.ndarray, " 3"]:
        """A point on the axis [m]; set one for a hinge that is elsewhere."""
        return self._joint.origin

    @origin.setter
    def origin(self, value: Value) -> None:
        self._do(through=value)

    @property
    def parent(self) -> str:
        """The part that carries this one; set another."""
        return self._joint.parent

    @parent.setter
    def parent(self, value: str) -> None:
        self._do(parent=value)

    @property
    def label(self) -> str:
        """What the part is, such as drawer; set another."""
        return self._asset.asset.segmentation.parts[part_number(self._asset.asset, self._part)].label

    @label.setter
    def label(self, value: str) -> None:
        self._do(label=value)

    @property
    def verdict(self) -> str:
        """How far the joint is to be trusted: sure, check or guess."""
        asset = self._asset.asset
        return verdict(asset.segmentation, self._joint, asset.warnings).word

    @property
    def confidence(self) -> float:
        """0..1; 1 for what was corrected or confirmed."""
        return self._joint.confidence

    def motions(self) -> list[dict[str, Any]]:
        """Return the free motions, the likeliest first: number (for `choose`), motion in words, range, share, reason."""
        return motion_rows(self._asset.asset, self._part)

    def choose(self, number: int) -> EditableJoint:
        """Take one of the free motions, by its number."""
        return self._do(motion=number)

    def flip(self) -> EditableJoint:
        """Reverse the direction in which the part opens; the limits keep their numbers."""
        return self._do(flip=True)

    def press(self, travel: float | str) -> EditableJoint:
        """Let the part be pushed in by this travel [m], as a button or a trigger."""
        return self._do(press=travel)

    def confirm(self) -> EditableJoint:
        """State that the joint is right; this clears its warnings."""
        return self._do(right=True)

    def accept(self) -> EditableJoint:
        """Accept a proposal: the joint is right, and is written."""
        return self._do(accept=True)

    def same_for_copies(self) -> EditableJoint:
        """Give the copies of the part its label and its joint, mirrored where they are mirror images."""
        return self._do(copies=True)

    def rename(self, name: str) -> EditableJoint:
        """Give the part's link another name."""
        self._do(rename=name)
        self._part = name
        return self

    def remove(self) -> None:
        """Merge the part into its parent, so that it no longer moves."""
        self._do(remove=True)

    @property
    def _joint(self) -> Joint:
        return joint_of_part(self._asset.asset, self._part)

    def _do(self, **operations: Value | bool) -> EditableJoint:
        self._asset.correct(self._part, **operations)
        return self

    def __repr__(self) -> str:
        row: Mapping[str, Any] = next(r for r in part_rows(self._asset.asset) if r["part"] == self._joint.child)
        parts = (f"{row['joint']}: {row['motion']}", row["range"], f"part {row['part']} on {row['parent']}")
        return ", ".join((*(p for p in parts if p), row["verdict"]))
