"""Objects with known parts and joints."""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
from jaxtyping import Float, Int

from anymesh.loading import load_mesh, place_mesh
from anymesh.types import MOVING, Asset, Brief, Joint, JointType, KnownJoint, Mesh, Mimic, Part, Segmentation, Source
from anymesh.types.motion import with_implied_limits


@dataclass(frozen=True)
class Following:
    """That a part follows another one. leader: that part, "" if it is not told; ratio: of their amounts, None if not told."""

    leader: str
    ratio: float | None = None


@dataclass(frozen=True, eq=False)
class TrueJoint(KnownJoint):
    """A true joint in the coordinates of the mesh file. If its range is unknown, neither opening side nor range is scored.

    freedoms: of the part on its parent; where there are two, turning and sliding are both right.
    """

    child: str = field(kw_only=True)
    parent: str = field(kw_only=True)
    follows: Following | None = field(default=None, kw_only=True)
    freedoms: int = field(default=1, kw_only=True)


@dataclass(frozen=True, eq=False)
class GroundTruth(Brief):
    """An object: its mesh file, its parts (0 is the base), a part index per face of the file, and its joints."""

    name: str
    mesh: Path
    parts: tuple[Part, ...]
    labels: Int[np.ndarray, " F"]
    joints: tuple[TrueJoint, ...]
    category: str = "object"  # category of the object, if given by the data set


@dataclass(frozen=True, eq=False)
class EvalSample(Brief):
    """Ground truth on the evaluated mesh, which is placed and possibly changed.

    labels: (F,) true part indices of the mesh's faces; T: (4, 4) from the truth's coordinates to the mesh's; diagonal: of the
    whole object at rest [m], None if the mesh is the whole object at rest; up: (3,) unit, what points up in the mesh.
    """

    truth: GroundTruth
    mesh: Mesh
    labels: Int[np.ndarray, " F"]
    T: Float[np.ndarray, "4 4"]
    diagonal: float | None = None
    up: Float[np.ndarray, " 3"] = field(default_factory=lambda: np.array([0.0, 0.0, 1.0]))

    @property
    def unit(self) -> float:
        """Unit of position errors [m]: half the diagonal, so that the diagonal is 2 (see docs/paper_tables.md)."""
        return (self.diagonal or self.mesh.diagonal) / 2

    def joint(self, true: TrueJoint) -> TrueJoint:
        """Return the true joint in the mesh's coordinates, with a unit axis."""
        axis = self.T[:3, :3] @ true.axis
        scale = float(np.linalg.norm(axis))
        factor = scale if true.type is JointType.PRISMATIC else 1.0
        limits = None if true.limits is None else (true.limits[0] * factor, true.limits[1] * factor)
        origin, follows = self.T[:3, :3] @ true.origin + self.T[:3, 3], true.follows
        if follows is not None and follows.ratio is not None:
            lead = next(j for j in self.truth.joints if j.child == follows.leader)
            follows = replace(follows, ratio=follows.ratio * factor / (scale if lead.type is JointType.PRISMATIC else 1.0))
        return replace(true, axis=axis / scale, origin=origin, limits=limits, pitch=scale * true.pitch, follows=follows)

    def segmentation(self) -> Segmentation:
        """Return the true parts without their labels, for protocols in which parts are given."""
        return Segmentation(
            self.labels, tuple(Part(p.name, "base" if k == 0 else "part") for k, p in enumerate(self.truth.parts))
        )

    def asset(self) -> Asset:
        """Return the sample as an asset with its true parts and joints.

        Unknown ranges are replaced by small ones, an unknown ratio of a follower by that of the ranges, 1 if one is endless.
        Parts without a joint are fixed to the base.
        """
        segmentation = self.segmentation()
        names = [part.name for part in segmentation.parts]
        joints = [self._known(true) for true in self.truth.joints]
        up = np.array([0.0, 0.0, 1.0])
        for name in sorted(set(names[1:]) - {j.child for j in joints}):
            joints.append(Joint(f"{name}_joint", JointType.FIXED, names[0], name, 0 * up, up, None, 1.0, "known"))
        source = Source("", "0" * 64, np.eye(4), "z")
        return Asset(self.truth.name, source, self.mesh, segmentation, with_implied_limits(joints), "oracle")

    def _known(self, true: TrueJoint) -> Joint:
        j = self.joint(true)
        limits = None
        if j.type in (JointType.REVOLUTE, JointType.PRISMATIC):
            lower, upper = j.limits or (0.0, 0.5 if j.type is JointType.REVOLUTE else 0.05 * self.mesh.diagonal)
            limits = (min(float(lower), 0.0), max(float(upper), 0.0))
        return Joint(
            f"{j.child}_joint",
            j.type,
            j.parent,
            j.child,
            j.origin,
            j.axis,
            limits,
            1.0,
            "known",
            mimic=self._mimic(j),
            pitch=j.pitch,
        )

    def _mimic(self, joint: TrueJoint) -> Mimic | None:
        if joint.follows is None or not joint.follows.leader:
            return None
        lead = self.joint(next(j for j in self.truth.joints if j.child == joint.follows.leader))
        ratio = joint.follows.ratio
        if ratio is None:
            spans = [0.0 if j.limits is None else j.limits[1] - j.limits[0] for j in (joint, lead)]
            ratio = spans[0] / spans[1] if all(spans) else 1.0
        return Mimic(f"{lead.child}_joint", ratio)


def read_ground_truth(path: Path, mesh: Path) -> GroundTruth:
    """Read NAME.json and NAME.npy (see examples/build.py)."""
    record = json.loads(path.read_text(encoding="utf-8"))
    joints = tuple(
        TrueJoint(
            JointType(j["type"]),
            np.array(j["origin"], float),
            np.array(j["axis"], float),
            _limits(j["limits"]),
            child=j["child"],
            parent=j["parent"],
        )
        for j in record["joints"]
    )
    parts = tuple(Part(p["name"], p["label"] or "part") for p in record["parts"])
    return GroundTruth(record["name"], mesh, parts, np.load(path.with_suffix(".npy")).astype(np.int64), joints)


def _limits(limits: list[float] | None) -> tuple[float, float] | None:
    return None if limits is None else (float(limits[0]), float(limits[1]))


def example_truths(folder: Path) -> list[GroundTruth]:
    """Read all objects of the folder `examples/`."""
    paths = sorted((folder / "truth").glob("*.json"))
    return [read_ground_truth(path, folder / "meshes" / f"{path.stem}.glb") for path in paths]


def prepared(truth: GroundTruth) -> EvalSample:
    """Load the truth's mesh and place it."""
    placed = place_mesh(load_mesh(truth.mesh))
    return EvalSample(truth, placed.mesh, truth.labels, placed.T_asset_source)


def of_parts(truth: GroundTruth, kept: Int[np.ndarray, " k"]) -> tuple[GroundTruth, Int[np.ndarray, " p"]]:
    """Return the ground truth of some parts (indices, base first), and the new index of each old part.

    Omitted parts become base, and their children get the nearest remaining ancestor as parent.
    """
    number = np.zeros(len(truth.parts), np.int64)
    number[kept] = np.arange(len(kept))
    parts = tuple(truth.parts[k] for k in kept)
    names = {p.name for p in parts}
    by_child = {j.child: j for j in truth.joints}

    def parent(joint: TrueJoint) -> str:
        at = joint.parent
        while at not in names and at in by_child:
            at = by_child[at].parent
        return at if at in names else parts[0].name

    joints = tuple(replace(j, parent=parent(j)) for j in truth.joints if j.child in names)
    return replace(truth, parts=parts, labels=number[truth.labels], joints=with_leaders(joints)), number


def with_leaders(joints: Iterable[TrueJoint]) -> tuple[TrueJoint, ...]:
    """Return the joints, without the leader those that follow what is not among them, cannot lead, or follows them."""
    known = tuple(joints)
    by_child = {j.child: j for j in known}

    def is_led(joint: TrueJoint) -> bool:
        seen, at = {joint.child}, joint
        while at.follows is not None:
            if at.follows.leader in seen or at.follows.leader not in by_child:
                return False
            at = by_child[at.follows.leader]
            seen.add(at.child)
        return at.type in MOVING

    return tuple(j if j.follows is None or is_led(j) else replace(j, follows=Following("")) for j in known)
