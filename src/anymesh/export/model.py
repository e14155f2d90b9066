"""Input of all format writers: links with inertia and collision shapes, joints, a base, and drives.

A drive is a spring and a damper towards a commanded position, with the same values in every format.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from anymesh.entry_points import CHOOSE_MECHANISMS, HANDLE_FRAMES, NAMED_STATES, PLACES, RESISTANCES, USUAL_BODIES, resolve
from anymesh.export.flat_looks import losses, tiled, tinted, with_materials
from anymesh.export.links import Link, split_links, with_legal_names
from anymesh.export.options import Driven, ExportOptions, Shapes, TargetProject, Visuals
from anymesh.geometry.surface import plain_triangles
from anymesh.physics.collision import CollisionConfig, collision_shapes
from anymesh.physics.convex import as_hull, planes
from anymesh.physics.inertia import Inertia, InertiaConfig, MadeOf, link_inertia, numbered
from anymesh.physics.mechanism import HandleFrame, Mechanism
from anymesh.physics.resistance import Resistance, crossing
from anymesh.physics.substances import Substance, substance_of, usual_substance
from anymesh.runtime import Deadline
from anymesh.types import Asset, Hull, Joint, JointType, Mesh, Shape
from anymesh.types.triangles import normals_and_areas

FOLDER = "meshes"
VOTERS = 5000  # maximum number of triangles that decide on the substances of shapes
OVERLAP = "their surfaces overlap at rest"
TIGHT = "their collision shapes touch where the surfaces do not, or while one moves"
LOOPED = "a loop joins them"
WITHIN = 0.02  # of a joint's range: maximum steady-state error of a drive under its load


@dataclass(frozen=True)
class SubstanceShare:
    """What a share of a link's area is made of. source: "material" (by its name), "kind" (of part or object) or "default"."""

    substance: Substance | None
    source: str
    share: float


@dataclass(frozen=True, eq=False)
class ExportLink:
    """A link with its physical properties.

    shapes: convex collision shapes, in the link frame; openings: share of its openings that they keep, if they were limited;
    substances: what it is made of, by area, the most first; surfaces: the substance of each shape, () if none is known.
    """

    link: Link
    inertia: Inertia
    shapes: tuple[Shape, ...]
    openings: float | None = None
    substances: tuple[SubstanceShare, ...] = ()
    surfaces: MadeOf = ()

    @property
    def name(self) -> str:
        return self.link.name

    def visual_path(self, kind: Visuals = Visuals.OBJ) -> str:
        """Return the path relative to the asset folder, with forward slashes."""
        return f"{FOLDER}/{self.name}.{kind}"

    def collisions(self) -> Iterator[tuple[Shape, str | None, Substance | None]]:
        """Yield each collision shape with its path as of `hull_paths`, and its substance."""
        return zip(self.shapes, self.hull_paths(), self.surfaces or (None,) * len(self.shapes), strict=True)

    def hull_paths(self) -> tuple[str | None, ...]:
        """Return a path relative to the asset folder for each shape; None for boxes and cylinders, which need no file."""
        hulls = sum(isinstance(s, Hull) for s in self.shapes)
        paths: list[str | None] = []
        for shape in self.shapes:
            number = f"_{len(paths) - paths.count(None)}" if hulls > 1 else ""
            paths.append(f"{FOLDER}/{self.name}_collision{number}.obj" if isinstance(shape, Hull) else None)
        return tuple(paths)


def faces_path(name: str) -> str:
    """Return the path of the face indices of a link or proposal in the source (an int64 .npy), relative to the asset folder."""
    return f"{FOLDER}/{name}.faces.npy"


@dataclass(frozen=True)
class Exclusion:
    """Two links whose contact engines should ignore, and why."""

    a: str
    b: str
    why: str


@dataclass(frozen=True, eq=False)
class Model:
    """An asset with legal names and a material for each face, ready for export.

    bodies: in the order of the parts, the root first; resistances: of the moving joints, by name; states: by name, positions of
    joints [rad or m].
    """

    asset: Asset
    bodies: tuple[ExportLink, ...]
    resistances: Mapping[str, Resistance]
    how: ExportOptions = field(default_factory=ExportOptions)
    exclusions: tuple[Exclusion, ...] = ()
    mechanisms: Mapping[str, Mechanism] = field(default_factory=dict)
    handles: tuple[HandleFrame, ...] = ()
    states: Mapping[str, Mapping[str, float]] = field(default_factory=dict)
    places: tuple[Any, ...] = ()  # `PlaceFrame` of `mechanisms`

    @property
    def links(self) -> Sequence[Link]:
        return tuple(body.link for body in self.bodies)

    @cached_property
    def tinted(self) -> Model:
        """Return the model without vertex colours that a material can hold, and with alpha only where it counts."""
        return self._with(tinted(self.asset.mesh, self.asset.segmentation.face_part))

    @cached_property
    def tiled(self) -> Model:
        """Return the tinted model with pictures that repeat and share their coordinates."""
        return self.tinted._with(tiled(self.tinted.asset.mesh))

    def _with(self, mesh: Mesh) -> Model:
        if mesh is self.asset.mesh:
            return self
        asset = replace(self.asset, mesh=mesh)
        links = split_links(asset)
        bodies = tuple(replace(body, link=link) for body, link in zip(self.bodies, links, strict=True))
        return replace(self, asset=asset, bodies=bodies)


@dataclass(frozen=True)
class ExportConfig(InertiaConfig):
    """Physical properties that a mesh does not state, and sizes in the output."""

    collision: CollisionConfig = field(default_factory=CollisionConfig)
    seconds_a_way: float = 2.0  # [s] of the animation: from rest to one limit and back
    degrees_a_key: float = 15.0  # [deg] maximum angle between two rotation keys; slerp is unique below 180


def build_model(
    asset: Asset, how: ExportOptions, *, config: ExportConfig, cache: Path | None, deadline: Deadline | None = None
) -> Model:
    """Build the model of an asset, with legal names and the warnings of its collision shapes.

    cache: folder of decompositions, None for none.
    """
    asset = with_legal_names(asset)
    asset = replace(asset, mesh=with_materials(asset.mesh))
    links = split_links(asset)
    plain = {link.name: plain_triangles(link.triangles, asset.mesh.diagonal) for link in links}
    triangles = {name: surface for name, (surface, _) in plain.items()}
    origins = {link.name: link.origin for link in links}
    shapes = replace(config.collision, hulls=how.hulls)
    collision = collision_shapes(asset, triangles, origins, shapes, cache, deadline=deadline)
    warnings = (*asset.warnings, *collision.warnings, *losses(asset.mesh, asset.segmentation.face_part))
    asset = replace(asset, warnings=tuple(dict.fromkeys(warnings)))
    bodies, usual = [], resolve(USUAL_BODIES)(asset)
    for link in links:
        shapes, (surface, kept) = collision.shapes[link.name], plain[link.name]
        shapes = tuple(map(as_hull, shapes)) if how.shapes is Shapes.HULLS else shapes
        shares, made_of = _shares(asset, link, usual)
        inertia = link_inertia(surface, config, [made_of[k] for k in kept])
        surfaces = _surfaces(link.triangles, made_of, shapes, shares[0].substance)
        bodies.append(ExportLink(link, inertia, shapes, collision.openings.get(link.name), shares, surfaces))
    bodies = bodies if how.mass is None else _weighing(bodies, how.mass, config)
    labelled = [(body.link.part.label or body.name, body.inertia.mass) for body in bodies]
    doubts = usual.doubts(asset, labelled, given=how.mass is not None)
    asset = replace(asset, warnings=tuple(dict.fromkeys((*asset.warnings, *doubts))))
    excluded = [Exclusion(a, b, OVERLAP) for a, b in collision.overlapping]
    excluded += [Exclusion(a, b, TIGHT) for a, b in collision.tight]
    apart = {pair for e in excluded for pair in ((e.a, e.b), (e.b, e.a))}
    excluded += [Exclusion(a, b, LOOPED) for a, b in sorted({(loop.first, loop.second) for loop in asset.loops} - apart)]
    inertias = {body.name: body.inertia for body in bodies}
    resistances = resolve(RESISTANCES)(asset, inertias, how.resistance)
    chosen, resisting = resolve(CHOOSE_MECHANISMS)(asset, inertias, resistances, how.mechanisms)
    handles = resolve(HANDLE_FRAMES)(asset, resisting)
    states = resolve(NAMED_STATES)(asset, {b.name: b.shapes for b in bodies}, [(e.a, e.b) for e in excluded])
    finished = asset.source_face is not None  # before, insides are not hollow
    taken = [handle.name for handle in handles]
    places = resolve(PLACES)(asset, states, taken) if finished or how.target is TargetProject.ROBOCASA else ()
    return Model(asset, tuple(bodies), resisting, how, tuple(excluded), chosen, handles, states, places)


def _weighing(bodies: Sequence[ExportLink], mass: float, config: InertiaConfig) -> list[ExportLink]:
    """Return the links with a mass [kg] of them all, in proportion."""
    factor = mass / sum(body.inertia.mass for body in bodies)
    return [replace(body, inertia=body.inertia.scaled(factor, config)) for body in bodies]


def _shares(asset: Asset, link: Link, of_object: Any) -> tuple[tuple[SubstanceShare, ...], MadeOf]:
    """Return what a link is made of, the most first, and the substance of each of its triangles."""
    usual = of_object.walled(usual_substance(f"{link.name} {link.part.label}") or of_object.substance)
    areas, made_of = dict[tuple[Substance | None, str], float](), list[Substance | None]()
    for p in link.primitives:
        named = of_object.walled(substance_of(asset.mesh.materials[p.material].name))
        answer = (named, "material") if named else (usual, "kind" if usual else "default")
        areas[answer] = areas.get(answer, 0.0) + float(normals_and_areas(p.positions[p.triangles])[1].sum())
        made_of += [answer[0]] * len(p.triangles)
    whole = max(sum(areas.values()), 1e-300)
    return tuple(SubstanceShare(*answer, area / whole) for answer, area in sorted(areas.items(), key=lambda a: -a[1])), made_of


def _surfaces(triangles: np.ndarray, made_of: MadeOf, shapes: Sequence[Shape], usual: Substance | None) -> MadeOf:
    """Return the substance of each shape: that with most area among the triangles nearest to it, `usual` without any."""
    kinds, number = numbered(made_of)
    if len(kinds) < 2:
        return (usual,) * len(shapes)
    some = slice(None, None, 1 + len(triangles) // VOTERS)
    centers, areas = np.c_[triangles[some].mean(1), np.ones(len(number[some]))], normals_and_areas(triangles[some])[1]
    outside = [(centers @ planes(as_hull(shape)).T).max(1) for shape in shapes]
    votes = np.zeros((len(shapes), len(kinds)))
    np.add.at(votes, (np.argmin(outside, 0), number[some]), areas)
    return tuple(kinds[int(v.argmax())] if v.any() else usual for v in votes)


@dataclass(frozen=True)
class Drive:
    """Gains of a drive. stiffness [N m/rad or N/m]; damping [N m s/rad or N s/m]; effort: maximum [N m or N]."""

    stiffness: float
    damping: float
    effort: float


def drives(model: Model) -> Mapping[str, Drive]:
    """Return a drive for each moving joint that follows none, by name. A passive one has neither stiffness nor damping.

    Damping over stiffness is the time in which the joint crosses its range at its velocity, at least .1 s.
    The stiffness keeps the error due to friction and weight within a share of the range. It is at least that of critical
    damping, so that no drive oscillates or overshoots.
    """
    resisting = {j: r for j in model.asset.joints if (r := model.resistances.get(j.name))}
    leading = {j: r for j, r in resisting.items() if j.mimic is None and j.type is not JointType.BALL}
    return {j.name: _drive(j, r, passive=model.how.drives is Driven.PASSIVE) for j, r in leading.items()}


def _drive(joint: Joint, r: Resistance, *, passive: bool) -> Drive:
    if passive:
        return Drive(0.0, 0.0, r.effort)
    span = joint.span[1] - joint.span[0]
    seconds = crossing(joint, r.velocity)
    stiffness = max(4 * (r.inertia + r.armature) / seconds**2, (r.friction + r.load) / (WITHIN * span))
    return Drive(float(stiffness), float(stiffness * seconds), r.effort)
