"""The paper's single-observation setting (appendix A, table 3): one picture with depth, its parts told by the segmentation
of that picture, is all there is for the joints.

Like OPDSynth's, pictures are 256 pixels wide, and one part stands part way open in some. Ours, where the paper does not say:
- The masks are the true parts' (the paper's come from SAM and a vision-language model).
- Cameras look from the side on which most of the movable parts is seen, up to 60 degrees aside and 10 to 40 above.
- Every other picture shows the object at rest.
- What the picture leaves open is filled before the joints are asked for (see `geometry.unseen`); the truth has no say in that.
"""

from __future__ import annotations

import zlib
from dataclasses import replace

import numpy as np
from jaxtyping import Int
from scipy.ndimage import maximum_filter

from anymesh.errors import InputError
from anymesh.evaluation.ground_truth import EvalSample, GroundTruth, TrueJoint
from anymesh.evaluation.partial import visible_surface
from anymesh.evaluation.posing import posed
from anymesh.geometry.hidden_base import hidden_base
from anymesh.rendering.raycast_ import RayScene
from anymesh.rendering.render import View, render
from anymesh.rendering.viewpoints import orbit_camera
from anymesh.types import Mesh
from anymesh.types.camera import Camera

SIZE = 256  # [px] both ways
ASIDE = 60.0  # [deg] most of a camera's azimuth from the front
ELEVATION = (10.0, 40.0)  # [deg]
MIN_PART_SHARE = 1e-3  # share of the picture that a part covers to be seen
OPEN = (0.1, 1.0)  # share of its range at which an open joint stands
TRIES = 50  # cameras before an object counts as one that no picture shows
DIRECTIONS = 24  # among which the front is


def observations(sample: EvalSample, count: int, seed: int) -> list[EvalSample]:
    """The first `count` observations of a sample."""
    return [observation(sample, number, seed) for number in range(count)]


def observation(sample: EvalSample, number: int, seed: int) -> EvalSample:
    """What one picture shows: every even-numbered one at rest, every odd one with one joint part way open.

    InputError when no camera sees a movable part.
    """
    rng = np.random.default_rng([seed, number, zlib.crc32(sample.truth.name.encode())])
    around, seen = front(sample)
    scene = opened(sample, seen, rng) if number % 2 else sample
    rays = RayScene(scene.mesh.vertices, scene.mesh.faces)
    for _ in range(TRIES):
        azimuth = around + np.deg2rad(rng.uniform(-ASIDE, ASIDE))
        camera = orbit_camera(scene.mesh.bounds, azimuth, np.deg2rad(rng.uniform(*ELEVATION)), SIZE)
        found = observed(scene, camera, rays)
        if found is not None:
            return found
    raise InputError(f"{sample.truth.name}: no picture shows a movable part and the base; found none in {TRIES} views")


def observed(sample: EvalSample, camera: Camera, rays: RayScene | None = None) -> EvalSample | None:
    """The part of the sample that a camera sees, with the truth about the parts that it sees, or None where it sees no
    movable part or no base. Lengths of scores stay shares of the whole object's diagonal."""
    view = render(sample.mesh, camera, scene=rays)
    part = np.where(view.face >= 0, sample.labels[view.face], -1)
    bordering = (part == 0) & (maximum_filter(part, 3) > 0)  # a pixel of clearance: edges are known no better than that
    try:
        mesh, labels = visible_surface(view, np.where(bordering, -1, part))
    except ValueError:
        return None
    covered = np.bincount(part[part >= 0], minlength=len(sample.truth.parts)) >= MIN_PART_SHARE * part.size
    covered &= np.isin(np.arange(len(covered)), labels)
    if not covered[0] or not covered[1:].any():
        return None
    kept = np.flatnonzero(covered[labels])
    truth, number = _of_parts(sample.truth, np.flatnonzero(covered))
    mesh, labels = _closed(mesh.subset(kept), number[labels[kept]], view)
    return replace(sample, truth=truth, mesh=mesh, labels=labels, diagonal=2 * sample.unit)


def _closed(mesh: Mesh, labels: Int[np.ndarray, " F"], view: View) -> tuple[Mesh, Int[np.ndarray, " G"]]:
    """The surface with the unseen walls of its box behind it, as base."""
    walls = hidden_base(mesh, labels, view.camera, view.depth)
    count, first = len(walls), len(mesh.vertices)
    if not count:
        return mesh, labels
    more = np.arange(first, first + 3 * count).reshape(-1, 3)
    color = np.broadcast_to(np.array([128, 128, 128, 255], np.uint8), (count, 3, 4))
    closed = replace(
        mesh,
        vertices=np.concatenate([mesh.vertices, walls.reshape(-1, 3)]),
        faces=np.concatenate([mesh.faces, more]),
        face_node=np.zeros(len(mesh.faces) + count, np.int64),
        face_material=np.full(len(mesh.faces) + count, -1),
        corner_color=np.concatenate([mesh.corner_color, color]),
    )
    return closed, np.concatenate([labels, np.zeros(count, np.int64)])


def opened(sample: EvalSample, among: Int[np.ndarray, " k"], rng: np.random.Generator) -> EvalSample:
    """The sample with the joint of one of these parts, drawn at random, part way open; as it is where none has limits."""
    names = {sample.truth.parts[k].name for k in among}
    able = [j for j in sample.truth.joints if j.limits is not None and j.range_known and j.child in names]
    if not able:
        return sample
    joint = able[int(rng.integers(len(able)))]
    lower, upper = joint.limits or (0.0, 0.0)
    return posed(sample, {joint.child: lower + float(rng.uniform(*OPEN)) * (upper - lower)})


def front(sample: EvalSample) -> tuple[float, Int[np.ndarray, " k"]]:
    """The azimuth [rad] from which the movable parts cover most of a picture at rest, and the numbers of those seen there."""
    rays = RayScene(sample.mesh.vertices, sample.mesh.faces)
    high = np.deg2rad(sum(ELEVATION) / 2)
    best, most = 0.0, np.zeros(len(sample.truth.parts), np.int64)
    for azimuth in 2 * np.pi * np.arange(DIRECTIONS) / DIRECTIONS:
        view = render(sample.mesh, orbit_camera(sample.mesh.bounds, azimuth, high, SIZE // 4), scene=rays)
        pixels = np.bincount(sample.labels[view.face[view.face >= 0]], minlength=len(most))
        if pixels[1:].sum() > most[1:].sum():
            best, most = float(azimuth), pixels
    return best, 1 + np.flatnonzero(most[1:])


def _of_parts(truth: GroundTruth, kept: Int[np.ndarray, " k"]) -> tuple[GroundTruth, Int[np.ndarray, " p"]]:
    """The truth about some of the parts (numbers, the base first), and the new number of each old one.

    A part that is left out counts as base, and what hangs on it hangs on what it hangs on.
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
    return replace(truth, parts=parts, labels=number[truth.labels], joints=joints), number
