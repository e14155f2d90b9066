"""Articulated URDF files as objects with known joints: the visuals as one mesh without names, and its ground truth.

In the rest pose all joints are at 0. Every rotating or sliding joint counts, including mimicking ones. If links without visuals
lie between two parts, so that a part has several degrees of freedom, the joint nearest to the part is used.
"""

from __future__ import annotations

import contextlib
import io
import re
import warnings
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from yourdfpy import URDF
from yourdfpy import urdf as parsed

from anymesh.errors import InputError
from anymesh.evaluation.datasets.dataset import Dataset, FolderDataset
from anymesh.evaluation.datasets.links import Y_UP, DatasetLink, assemble, moved
from anymesh.evaluation.datasets.meshes_ import box, cylinder, ellipsoid, find_mesh, read_visual
from anymesh.evaluation.ground_truth import Following, GroundTruth
from anymesh.types import JointType, KnownJoint, Material, Mesh
from anymesh.types.mesh import to_linear

MOVING = {"revolute", "continuous", "prismatic"}
JOINT = re.compile(r"""<joint[^>]*type\s*=\s*["'](revolute|continuous|prismatic)["']""")
CLASSES = (
    "BaseCabinet", "WallCabinet", "SinkCabinet", "KitchenIsland", "Dishwasher", "Range", "Refrigerator", "Microwave",
    "HandWheel", "CNCMachine",
)  # fmt: skip
VARIED = ("BaseCabinet", "WallCabinet", "SinkCabinet", "Dishwasher", "Range", "Refrigerator")  # classes with random variants
VARIANTS = 7  # per class, in the subset "random"


@dataclass(frozen=True)
class UrdfFolder(FolderDataset):
    """Every *.urdf below a folder with a moving joint; with `static`, those without one, so that every found part is wrong.

    Their names are the paths without suffix, with - between folders.
    """

    name: str = "urdf"
    static: bool = False

    def _names(self) -> list[str]:
        moving = {name: bool(JOINT.search(path.read_text(errors="replace"))) for name, path in self._files().items()}
        names = sorted(name for name, moves in moving.items() if moves is not self.static)
        if not names:
            wanted = "without" if self.static else "with"
            raise InputError(f"{self.folder}: found no .urdf file {wanted} a joint that moves; at least one is needed")
        return names

    def truth(self, name: str, folder: Path) -> GroundTruth:
        path = self._files().get(name)
        if path is None:
            raise InputError(f"{self.folder.name}: found no object {name!r}; valid are names such as {self.objects()[:3]}")
        return replace(flatten_urdf(path, folder / f"{name}.glb", root=self.folder), name=name)

    def _files(self) -> dict[str, Path]:
        files = sorted(self.folder.rglob("*.urdf"))
        return {"-".join(path.relative_to(self.folder).with_suffix("").parts): path for path in files}


def flatten_urdf(
    urdf: Path, mesh: Path, *, root: Path | None = None, labels: Mapping[str, str] | None = None, category: str = "object"
) -> GroundTruth:
    """Write the visuals at rest as a nameless GLB at `mesh`; return the ground truth in that file's coordinates.

    root: files of the visuals must lie below it (None: below the URDF's folder); labels: of links. Links that do not move
    against each other form one part; see `assemble`. Raise InputError, with the URDF's name, if it cannot be used.
    """
    try:
        return assemble(urdf.stem, read_bodies(urdf, root or urdf.parent, labels or {}), mesh, category)
    except InputError as error:
        raise InputError(f"{urdf.name}: {error}") from None


def read_bodies(urdf: Path, root: Path, labels: Mapping[str, str]) -> list[DatasetLink]:
    """Return a dataset link per URDF link, Y up. Raise InputError for an invalid file."""
    try:
        robot = URDF.load(str(urdf), build_scene_graph=False, load_meshes=False)
        carrier = {j.child: j for j in robot.joint_map.values()}
        roots = [link for link in robot.link_map if link not in carrier]
    except Exception as error:  # the reader raises many types of errors for a broken file
        raise InputError(f"it is not a valid URDF ({type(error).__name__}: {' '.join(str(error).split())[:150]})") from None
    if len(roots) != 1:
        raise InputError(f"found the root links {sorted(roots)}; valid is a tree with one")
    colors = {m.name: m.color for m in robot.robot.materials if m.color is not None}
    bodies = []
    for name, link in robot.link_map.items():
        T = _rest(name, carrier, robot.link_map)
        visuals = [_visual(v, urdf.parent, root, colors) for v in link.visuals]
        meshes = tuple(m.transformed(T) for m in visuals)
        joint = carrier.get(name)
        motion = _motion(joint, T) if joint is not None and joint.type in MOVING else None
        follows = None if joint is None or joint.mimic is None else _follows(joint.mimic, robot.joint_map)
        body = DatasetLink(name, None if joint is None else joint.parent, motion, meshes, labels.get(name, "part"), follows)
        bodies.append(moved(body, Y_UP))
    return bodies


def _follows(mimic: parsed.Mimic, joints: Mapping[str, parsed.Joint]) -> Following:
    ratio = 1.0 if mimic.multiplier is None else float(mimic.multiplier)
    return Following(joints[mimic.joint].child if mimic.joint in joints else "", ratio)


def _rest(link: str, carrier: Mapping[str, parsed.Joint], links: Mapping[str, parsed.Link]) -> np.ndarray:
    """Return the transform from a link's frame to the root's, with all joints at 0."""
    T = np.eye(4)
    for _ in range(len(links)):
        joint = carrier.get(link)
        if joint is None:
            return T
        if joint.parent not in links:
            raise InputError(f"joint {joint.name!r} refers to a link {joint.parent!r} that is not there")
        T = (np.eye(4) if joint.origin is None else joint.origin) @ T
        link = joint.parent
    raise InputError(f"its joints form a cycle through the link {link!r}; valid is a tree")


def _motion(joint: parsed.Joint, T: np.ndarray) -> KnownJoint | None:
    """Return the motion in the root's frame; None for a joint with an empty range."""
    axis = np.array([1.0, 0, 0]) if joint.axis is None else np.asarray(joint.axis, float)
    if not (np.isfinite(axis).all() and np.linalg.norm(axis) > 0):
        raise InputError(f"joint {joint.name!r}: found the axis {joint.axis}; valid is a direction")
    axis, origin, kind = T[:3, :3] @ axis, T[:3, 3], JointType(joint.type)
    if kind is JointType.CONTINUOUS:
        return KnownJoint(kind, origin, axis, None)
    lower, upper = (None, None) if joint.limit is None else (joint.limit.lower, joint.limit.upper)
    if lower is None and upper is None:
        return KnownJoint(kind, origin, axis, None, range_known=False)
    limits = (float(lower or 0.0), float(upper or 0.0))
    if not (np.isfinite(limits).all() and limits[0] <= limits[1]):
        raise InputError(f"joint {joint.name!r}: found the limits {limits}; valid are finite ones, the lower first")
    return KnownJoint(kind, origin, axis, limits) if limits[0] < limits[1] else None


def _visual(visual: parsed.Visual, folder: Path, root: Path, colors: Mapping) -> Mesh:
    """Return a visual in the link's frame; colours of the mesh file take precedence over those of the URDF."""
    T = np.eye(4) if visual.origin is None else visual.origin
    color = None if visual.material is None else visual.material.color or colors.get(visual.material.name)
    material = None
    if color is not None:
        rgba = np.r_[np.asarray(color.rgba, float), 1.0][:4]
        base = (*to_linear(rgba[:3]).tolist(), float(rgba[3]))
        material = Material(base_color=base, alpha_mode="BLEND" if rgba[3] < 1 else "OPAQUE")
    shape = visual.geometry
    if shape is None:
        raise InputError("found a visual without a geometry; valid are box, cylinder, sphere and mesh")
    if shape.box is not None:
        return box(shape.box.size, material).transformed(T)
    if shape.cylinder is not None:
        return cylinder(shape.cylinder.radius, shape.cylinder.length, material).transformed(T)
    if shape.sphere is not None:
        return ellipsoid([shape.sphere.radius] * 3, material).transformed(T)
    if shape.mesh is None:
        raise InputError("found a visual without a geometry; valid are box, cylinder, sphere and mesh")
    scale = np.ones(3) * (1.0 if shape.mesh.scale is None else shape.mesh.scale)
    mesh = read_visual(find_mesh(shape.mesh.filename, folder), root)
    if material is not None and not mesh.materials:
        mesh = replace(mesh, face_material=np.zeros(len(mesh.faces), np.int64), materials=(material,))
    return mesh.transformed(T @ np.diag([*scale, 1.0]))


@dataclass(frozen=True)
class SceneSynthesizer(Dataset):
    """The classes in their default form; CLASS-SEED is a random variant.

    HandWheel has no visible base, so no visible part moves against another: a mesh in which no joint should be found.
    """

    name: str = "scene-synthesizer"

    @property
    def splits(self) -> tuple[str, ...]:
        return ("default", "random")

    def _names(self) -> list[str]:
        return sorted(CLASSES)

    def _members(self, split: str, names: list[str]) -> list[str]:
        return sorted(f"{c}-{k}" for c in VARIED for k in range(1, VARIANTS + 1)) if split == "random" else names

    def truth(self, name: str, folder: Path) -> GroundTruth:
        return synthesize(name, folder)


def synthesize(name: str, folder: Path) -> GroundTruth:
    """Build CLASS (its default form) or CLASS-SEED and write it to `folder`: NAME/NAME.urdf and NAME.glb, flattened."""
    from scene_synthesizer import procedural_assets

    kind, _, seed = name.partition("-")
    valid = VARIED if seed else CLASSES
    if kind not in valid or not (seed.isdecimal() or name == kind):
        raise InputError(
            f"scene-synthesizer: found no object {name!r}; valid are {', '.join(CLASSES)}, {', '.join(VARIED)}-SEED"
        )
    urdf = folder / name / f"{name}.urdf"
    urdf.parent.mkdir(parents=True, exist_ok=True)
    with warnings.catch_warnings(), contextlib.redirect_stdout(io.StringIO()):
        warnings.simplefilter("ignore")
        make = getattr(procedural_assets, f"{kind}Asset")
        asset = make.random(seed=int(seed)) if seed else make()
        asset.scene(kind).export(str(urdf))
        truth = flatten_urdf(urdf, folder / f"{name}.glb", category=_words(kind))
    return replace(truth, name=name)


def _words(kind: str) -> str:
    return re.sub(r"(?<=[a-z])(?=[A-Z])", " ", kind).lower()
