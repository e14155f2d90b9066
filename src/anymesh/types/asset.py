"""The articulated asset: the mesh in the asset frame, its parts, its joints, and their source."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from jaxtyping import Float, Int

from anymesh.entry_points import ASSET_HTML, resolve
from anymesh.types.brief import Brief
from anymesh.types.exchange import Exchange
from anymesh.types.mesh import Mesh
from anymesh.types.motion import Joint, Loop, with_implied_limits

SHOWN = 7  # parts or joints that are printed


@dataclass(frozen=True)
class Part:
    """One rigid part. label: standard term ("door", "knob"); name: unique link name."""

    name: str
    label: str
    confidence: float = 1.0  # 0..1, that this is a separate part
    reason: str = ""  # evidence in words

    def __post_init__(self) -> None:
        if not self.name:
            raise ValueError("a part needs a name")
        if not 0 <= self.confidence <= 1:
            raise ValueError(f"part {self.name!r}: confidence must lie in 0..1, found {self.confidence}")


@dataclass(frozen=True, eq=False)
class Segmentation:
    """Result of Stage A: one part index per face. Part 0 is the root (the base) and always exists.

    face_part: (F,) index into parts; nearly: what would be parts next, in words, if there are none.
    """

    face_part: Int[np.ndarray, " F"]
    parts: tuple[Part, ...]
    nearly: str = ""

    def __post_init__(self) -> None:
        if not self.parts:
            raise ValueError("a segmentation needs at least the root part")
        names = [p.name for p in self.parts]
        if len(set(names)) != len(names):
            raise ValueError(f"part names must be unique, found {sorted(n for n in names if names.count(n) > 1)}")
        least, most = int(self.face_part.min()), int(self.face_part.max())
        if least < 0 or most >= len(self.parts):
            raise ValueError(f"face_part must lie in 0..{len(self.parts) - 1}, found {least if least < 0 else most}")
        missing = [p.name for i, p in enumerate(self.parts) if not (self.face_part == i).any()]
        if missing:
            raise ValueError(f"parts without faces: {missing}")

    def __repr__(self) -> str:
        return f"Segmentation of {len(self.face_part)} faces into {len(self.parts)} parts, the root {self.parts[0].name!r}"

    @property
    def numbers(self) -> dict[str, int]:
        """Return the index of each part by name."""
        return {part.name: k for k, part in enumerate(self.parts)}

    def faces(self, part: int) -> Int[np.ndarray, " n"]:
        """Return the face indices of one part."""
        return np.flatnonzero(self.face_part == part)


@dataclass(frozen=True, eq=False)
class Source(Brief):
    """The file that an asset was made from.

    T_asset_source: (4, 4), from file coordinates as stored to the asset frame [m, Z up]; credits: of `formats.credits`.
    """

    path: str
    sha256: str
    T_asset_source: Float[np.ndarray, "4 4"]
    up: str  # an axis such as "z" or "-y", or three numbers
    notes: tuple[str, ...] = ()  # how up and scale were determined, in words
    credits: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True, eq=False)
class ProposedJoint(Brief):
    """A joint that is too unsure to be written, and its part, which is fixed instead.

    probability: that both are right; faces: (n,) of the mesh, now of the part that carries it; motion: in words.
    """

    part: Part
    joint: Joint
    probability: float
    motion: str
    faces: Int[np.ndarray, " n"]


@dataclass(frozen=True, eq=False)
class Asset:
    """Everything the exporters need. `mesh` is in the asset frame at rest [m, Z up]."""

    name: str  # stem of the output files
    source: Source
    mesh: Mesh
    segmentation: Segmentation
    joints: tuple[Joint, ...]  # one per part except the root, forming a tree
    answerer: str
    warnings: tuple[str, ...] = ()
    timing: Mapping[str, float] = field(default_factory=dict)  # stage -> seconds
    exchanges: tuple[Exchange, ...] = ()  # with a model, in order
    source_face: Int[np.ndarray, " F"] | None = None  # face index in the source, -1 for faces added by Stage C
    notes: tuple[str, ...] = ()  # changes by Stage C, in words
    category: str = ""  # kind of object as given or answered, "" if only the name tells
    front: float | None = None  # answered azimuth that shows the front [deg], 0 looks along +y
    proposals: tuple[ProposedJoint, ...] = ()  # with --precision
    loops: tuple[Loop, ...] = ()

    def __post_init__(self) -> None:
        names = [p.name for p in self.segmentation.parts]
        children = [j.child for j in self.joints]
        if sorted(children) != sorted(names[1:]):
            raise ValueError(f"each part but the root {names[0]!r} needs one joint; parts {names[1:]}, joints for {children}")
        joints = [*(j.name for j in self.joints), *(loop.name for loop in self.loops)]
        if len(set(joints)) != len(joints):
            raise ValueError(f"joint names must be unique, found {sorted(n for n in joints if joints.count(n) > 1)}")
        for loop in self.loops:
            if {loop.first, loop.second} - {*names}:
                raise ValueError(f"loop {loop.name!r} joins {loop.first!r} and {loop.second!r}; parts are {names}")
        for joint, implied in zip(self.joints, with_implied_limits(self.joints), strict=True):
            if joint.type is not implied.type or not np.allclose(joint.limits or (), implied.limits or (), 1e-6, 1e-9):
                limits = f"it is {implied.type} with limits {implied.limits}, found {joint.type} with {joint.limits}"
                raise ValueError(f"joint {joint.name!r} follows {joint.mimic}: {limits}")
        parent = {j.child: j.parent for j in self.joints}
        for name in names[1:]:
            seen, at = set(), name
            while at != names[0]:
                if at in seen or at not in parent:
                    raise ValueError(f"joints do not form a tree rooted at {names[0]!r}: {name!r} does not reach it")
                seen.add(at)
                at = parent[at]

    def __repr__(self) -> str:
        head = f"Asset {self.name!r}: {len(self.segmentation.parts)} parts, {len(self.mesh.faces)} faces, by {self.answerer}"
        more = [f"  and {len(self.joints) - SHOWN} more joints"] if len(self.joints) > SHOWN else []
        more += [f"  {len(self.proposals)} proposals, which are fixed"] if self.proposals else []
        more += [f"  {len(self.warnings)} warnings"] if self.warnings else []
        return "\n".join((head, *(f"  {joint!r}" for joint in self.joints[:SHOWN]), *more))

    def source_faces(self, faces: Int[np.ndarray, " m"]) -> Int[np.ndarray, " n"]:
        """Return the indices of faces in the source file, without those added by Stage C."""
        if self.source_face is not None:
            faces = self.source_face[faces]
        return faces[faces >= 0].astype(np.int64)

    def _repr_html_(self) -> str:
        """Return what a notebook shows of the asset: its report, in a frame."""
        return resolve(ASSET_HTML)(self)
