"""Objects whose parts and joints are known."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from jaxtyping import Float, Int

from anymesh.types import JointType, Part, Segmentation


@dataclass(frozen=True, eq=False)
class TrueJoint:
    """A joint in the coordinates of the mesh file; positive opens."""

    child: str
    parent: str
    type: JointType
    origin: Float[np.ndarray, " 3"]
    axis: Float[np.ndarray, " 3"]
    limits: tuple[float, float] | None


@dataclass(frozen=True, eq=False)
class Truth:
    """An object: its mesh file, its parts (0 is the base), a part number a face of the file, its joints."""

    name: str
    mesh: Path
    parts: tuple[Part, ...]
    labels: Int[np.ndarray, " F"]
    joints: tuple[TrueJoint, ...]

    def segmentation(self) -> Segmentation:
        """The true parts, for the protocol in which parts are given; labels are not told."""
        return Segmentation(self.labels, tuple(Part(p.name, "base" if k == 0 else "part") for k, p in enumerate(self.parts)))


def read_truth(path: Path, mesh: Path) -> Truth:
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
    return Truth(record["name"], mesh, parts, np.load(path.with_suffix(".npy")).astype(np.int64), joints)


def example_truths(folder: Path) -> list[Truth]:
    """All objects of the folder `examples/`."""
    found = sorted((folder / "truth").glob("*.json"))
    return [read_truth(path, folder / "meshes" / f"{path.stem}.glb") for path in found]
