"""Assembly of links and joints from any source into an object with known joints: a nameless mesh file and its truth."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from jaxtyping import Float, Int

from anymesh.errors import InputError
from anymesh.evaluation.ground_truth import Following, GroundTruth, TrueJoint, with_leaders
from anymesh.export.glb import glb_bytes
from anymesh.export.links import Link, Primitive, split_links
from anymesh.export.model import ExportConfig
from anymesh.loading.join import join
from anymesh.names import legal_names
from anymesh.types import Asset, Joint, JointType, KnownJoint, Material, Mesh, Part, Segmentation
from anymesh.types.asset import Source

Z_UP = np.array([[1.0, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0], [0, 0, 0, 1]])  # from the file's Y-up to an asset's Z-up
Y_UP = np.array([[1.0, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]])  # from Z-up, as in robotics, to glTF's Y-up


def write_nameless(pieces: Sequence[Mesh], path: Path) -> Int[np.ndarray, " F"]:
    """Write the meshes (Y up) to a GLB; return the mesh index of each face, in the order of the file's faces.

    Faces are sorted by material, as primitives of one node; materials and textures are kept without their names.
    """
    mesh = join([_anonymous(piece) for piece in pieces]).transformed(Z_UP)
    number = np.repeat(np.arange(len(pieces)), [len(p.faces) for p in pieces])
    names = [f"piece{k}" for k in range(len(pieces))]
    zero, up = np.zeros(3), np.array([0.0, 0.0, 1.0])
    fixed = tuple(Joint(n, JointType.FIXED, names[0], n, zero, up, None, 1.0, "fixed") for n in names[1:])
    source = Source("", "", np.eye(4), "z")
    split = Asset("object", source, mesh, Segmentation(number, tuple(Part(n, "part") for n in names)), fixed, "truth")
    part = Part("object", "object")
    whole = replace(split, segmentation=Segmentation(np.zeros_like(number), (part,)), joints=())
    by_material: dict[int, list[Primitive]] = {}
    for link in split_links(split):
        for primitive in link.primitives:
            by_material.setdefault(primitive.material, []).append(primitive)
    textured = [k for k, m in enumerate(mesh.materials) if m.textures]
    primitives = tuple(_merged(by_material[k], k in textured) for k in sorted(by_material))
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(glb_bytes(whole, [Link(part, None, zero, np.arange(len(number)), primitives)], ExportConfig()))
    return number[np.lexsort((number, mesh.face_material))]


def _anonymous(mesh: Mesh) -> Mesh:
    return replace(mesh, materials=tuple(_nameless(m) for m in mesh.materials))


def _nameless(m: Material) -> Material:
    return replace(m, name="material", textures={slot: replace(t, name="") for slot, t in m.textures.items()})


def _merged(primitives: list[Primitive], textured: bool) -> Primitive:
    """Merge primitives of one material; their corners stay separate. Texture coordinates are kept only if used."""
    start = np.cumsum([0, *(len(p.positions) for p in primitives)])[:-1]

    def rows(values: list, fill: int) -> np.ndarray | None:
        width = next((v.shape[1] for v in values if v is not None), 0)
        if not width:
            return None
        kind = next(v.dtype for v in values if v is not None)
        pairs = zip(values, primitives, strict=True)
        return np.concatenate([np.full((len(p.positions), width), fill, kind) if v is None else v for v, p in pairs])

    return Primitive(
        primitives[0].material,
        np.concatenate([p.positions for p in primitives]),
        np.concatenate([p.triangles + s for p, s in zip(primitives, start, strict=True)]),
        rows([p.uv for p in primitives], 0) if textured else None,
        rows([p.normals for p in primitives], 0),
        rows([p.colors for p in primitives], 255),
    )


@dataclass(frozen=True, eq=False)
class DatasetLink:
    """A link of an object.

    meshes: at rest, in the coordinates of the file to be written (Y up); empty for an invisible link.
    motion: None if the link is fixed to its parent; parent: None for the root, of which there is one; follows: by link names.
    """

    name: str
    parent: str | None = None
    motion: KnownJoint | None = None
    meshes: tuple[Mesh, ...] = ()
    label: str = "part"
    follows: Following | None = None
    freedoms: int = 1


def assemble(name: str, links: Sequence[DatasetLink], path: Path, category: str = "object") -> GroundTruth:
    """Write the links to a nameless GLB at `path`; links that are fixed to each other form one part.

    An invisible link is not a part: its children are attached to the next visible link towards the root, with their own joints.
    If the root is invisible, its visible child becomes the base, or the largest of several.
    Axes are flipped so that the positive direction is towards the larger limit. Raise InputError if the links form no tree, or
    nothing is visible.
    """
    known = {b.name: b for b in links}
    _check_tree(name, known)

    def head(name: str) -> str:
        """Return the link that a fixed link belongs to."""
        while known[name].motion is None and known[name].parent is not None:
            name = str(known[name].parent)
        return name

    meshes: dict[str, list[Mesh]] = {}
    for body in links:
        meshes.setdefault(head(body.name), []).extend(body.meshes)
    seen = {k: v for k, v in meshes.items() if v}
    if not seen:
        raise InputError(f"{name}: found no body with a visible surface; at least one is needed")

    def below(name: str) -> str | None:
        """Return the next visible link towards the root."""
        at = known[name].parent
        while at is not None and head(at) not in seen:
            at = known[head(at)].parent
        return None if at is None else head(at)

    base = max((k for k in seen if below(k) is None), key=lambda k: (known[k].parent is None, _area(seen[k])))
    order = [base, *sorted(k for k in seen if k != base)]
    legal = dict(zip(order, legal_names(order), strict=True))
    pieces = [(number, mesh) for number, key in enumerate(order) for mesh in seen[key]]
    piece = write_nameless([mesh for _, mesh in pieces], path)
    joints = with_leaders(_joint(known[k], legal, legal[below(k) or base], known) for k in order[1:])
    parts = tuple(Part(legal[k], known[k].label) for k in order)
    return GroundTruth(name, path, parts, np.array([n for n, _ in pieces], np.int64)[piece], joints, category)


def _check_tree(name: str, known: Mapping[str, DatasetLink]) -> None:
    """Check that the parents of every link lead to a root."""
    for link in known:
        path, at = [link], known[link].parent
        while at is not None:
            if at not in known or at in path:
                raise InputError(
                    f"{name}: found the parents {' > '.join([*path, at])}; valid is a tree of the links {sorted(known)}"
                )
            path.append(at)
            at = known[at].parent


def _area(meshes: list[Mesh]) -> float:
    return sum(float(m.face_areas.sum()) for m in meshes)


def _joint(link: DatasetLink, legal: Mapping[str, str], parent: str, known: Mapping[str, DatasetLink]) -> TrueJoint:
    motion, child, follows = link.motion, legal[link.name], link.follows
    if motion is None:
        raise InputError(f"found the root link {child} beside the base; valid is a tree with one")
    axis, limits = motion.axis / np.linalg.norm(motion.axis), motion.limits
    if limits is not None and _turned(motion):
        axis, limits = -axis, (-limits[1], -limits[0])
    limits = None if limits is None else (limits[0] + 0.0, limits[1] + 0.0)  # no -0.0
    if follows is not None:
        lead = known[follows.leader].motion if follows.leader in known else None
        other_way = lead is not None and _turned(lead) != _turned(motion)
        ratio = follows.ratio if follows.ratio is None or not other_way else -follows.ratio
        follows = Following(legal.get(follows.leader, ""), ratio)
    told = {"child": child, "parent": parent, "follows": follows, "freedoms": link.freedoms}
    return TrueJoint(motion.type, motion.origin, axis + 0.0, limits, motion.range_known, motion.pitch, **told)


def _turned(motion: KnownJoint) -> bool:
    """Return whether the axis is flipped, so that positive is towards the larger limit."""
    return motion.limits is not None and -motion.limits[0] > motion.limits[1]


def moved(body: DatasetLink, T: Float[np.ndarray, "4 4"]) -> DatasetLink:
    """Transform the link to other coordinates; T: rigid."""
    motion = body.motion
    if motion is not None:
        motion = replace(motion, origin=T[:3, :3] @ motion.origin + T[:3, 3], axis=T[:3, :3] @ motion.axis)
    return replace(body, motion=motion, meshes=tuple(m.transformed(T) for m in body.meshes))
