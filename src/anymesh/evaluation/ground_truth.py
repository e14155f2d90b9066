"""Objects whose parts and joints are known."""

from __future__ import annotations

import json
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from jaxtyping import Float, Int

from anymesh.types import Asset, Joint, JointType, Mesh, Part, Segmentation, Source


@dataclass(frozen=True, eq=False)
class TrueJoint:
    """A joint in the coordinates of the mesh file; positive opens.

    limits: (lower, upper) [rad or lengths of the file]; None for a joint that turns endlessly, or whose range is not known:
    then `range_known` is False, the axis' sign means nothing, and neither opening side nor range is scored.
    """

    child: str
    parent: str
    type: JointType
    origin: Float[np.ndarray, " 3"]
    axis: Float[np.ndarray, " 3"]
    limits: tuple[float, float] | None
    range_known: bool = True


@dataclass(frozen=True, eq=False)
class GroundTruth:
    """An object: its mesh file, its parts (0 is the base), a part number a face of the file, its joints."""

    name: str
    mesh: Path
    parts: tuple[Part, ...]
    labels: Int[np.ndarray, " F"]
    joints: tuple[TrueJoint, ...]
    category: str = "object"  # what the object is, where the data set says it


@dataclass(frozen=True, eq=False)
class EvalSample:
    """A truth on the mesh that is put to the test: placed, and perhaps changed on purpose.

    labels: (F,) true part numbers of the mesh's faces; T: (4, 4) takes the truth's coordinates to the mesh's; diagonal: of
    the whole object at rest [m], where the mesh is not that.
    """

    truth: GroundTruth
    mesh: Mesh
    labels: Int[np.ndarray, " F"]
    T: Float[np.ndarray, "4 4"]
    diagonal: float | None = None

    @property
    def unit(self) -> float:
        """Length that the field's position errors are told in [m]: the diagonal is 2 (see docs/paper_tables.md)."""
        return (self.diagonal or self.mesh.diagonal) / 2

    def joint(self, true: TrueJoint) -> TrueJoint:
        """The true joint in the mesh's coordinates, its axis a unit vector."""
        axis = self.T[:3, :3] @ true.axis
        scale = float(np.linalg.norm(axis))
        factor = scale if true.type is JointType.PRISMATIC else 1.0
        limits = None if true.limits is None else (true.limits[0] * factor, true.limits[1] * factor)
        return replace(true, axis=axis / scale, origin=self.T[:3, :3] @ true.origin + self.T[:3, 3], limits=limits)

    def segmentation(self) -> Segmentation:
        """The true parts, for the protocol in which parts are given; labels are not told."""
        return Segmentation(
            self.labels, tuple(Part(p.name, "base" if k == 0 else "part") for k, p in enumerate(self.truth.parts))
        )

    def asset(self) -> Asset:
        """The sample with its true parts and joints. A range that is not known is a small one; what has no joint is fixed
        to the base."""
        segmentation = self.segmentation()
        names = [part.name for part in segmentation.parts]
        joints = [self._known(true) for true in self.truth.joints]
        up = np.array([0.0, 0.0, 1.0])
        for name in sorted(set(names[1:]) - {j.child for j in joints}):
            joints.append(Joint(f"{name}_joint", JointType.FIXED, names[0], name, 0 * up, up, None, 1.0, "known"))
        source = Source("", "0" * 64, np.eye(4), "z")
        return Asset(self.truth.name, source, self.mesh, segmentation, tuple(joints), "oracle")

    def _known(self, true: TrueJoint) -> Joint:
        j = self.joint(true)
        limits = None
        if j.type in (JointType.REVOLUTE, JointType.PRISMATIC):
            lower, upper = j.limits or (0.0, 0.5 if j.type is JointType.REVOLUTE else 0.05 * self.mesh.diagonal)
            limits = (min(float(lower), 0.0), max(float(upper), 0.0))
        return Joint(f"{j.child}_joint", j.type, j.parent, j.child, j.origin, j.axis, limits, 1.0, "known")


def read_ground_truth(path: Path, mesh: Path) -> GroundTruth:
    """Reads NAME.json and NAME.npy (see examples/build.py)."""
    record = json.loads(path.read_text(encoding="utf-8"))
    joints = tuple(
        TrueJoint(
            j["child"],
            j["parent"],
            JointType(j["type"]),
            np.array(j["origin"], float),
            np.array(j["axis"], float),
            None if j["limits"] is None else (float(j["limits"][0]), float(j["limits"][1])),
        )
        for j in record["joints"]
    )
    parts = tuple(Part(p["name"], p["label"] or "part") for p in record["parts"])
    return GroundTruth(record["name"], mesh, parts, np.load(path.with_suffix(".npy")).astype(np.int64), joints)


def example_truths(folder: Path) -> list[GroundTruth]:
    """All objects of the folder `examples/`."""
    found = sorted((folder / "truth").glob("*.json"))
    return [read_ground_truth(path, folder / "meshes" / f"{path.stem}.glb") for path in found]
