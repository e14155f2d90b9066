"""The paper's single-observation setting (appendix A, table 3): joints from one depth image with segmented parts.

As in OPDSynth, pictures are 256 pixels wide, and in some of them one part is partly open. Our choices where the paper is
unspecified:
- The masks are those of the true parts (the paper's come from SAM and a vision-language model).
- Cameras look from the side that shows most of the movable parts, up to 60 degrees aside and 10 to 40 above.
- Every other picture shows the object at rest.
- The unseen surface is filled before joints are estimated (see `geometry.unseen`), without ground truth.
"""

from __future__ import annotations

import zlib
from dataclasses import replace

import numpy as np
from jaxtyping import Int
from scipy.ndimage import maximum_filter

from anymesh.errors import InputError
from anymesh.evaluation.ground_truth import EvalSample, GroundTruth, TrueJoint
from anymesh.evaluation.hidden_base import hidden_base
from anymesh.evaluation.partial import visible_surface
from anymesh.evaluation.posing import posed
from anymesh.geometry.raycast_ import RayScene
from anymesh.rendering.render import View, render
from anymesh.rendering.viewpoints import orbit_camera
from anymesh.types import Mesh
from anymesh.types.camera import Camera

SIZE = 256  # [px] per side
ASIDE = 60.0  # [deg] maximum azimuth of a camera from the front
ELEVATION = (10.0, 40.0)  # [deg] range
MIN_PART_SHARE = 1e-3  # minimum share of the picture for a part to count as visible
OPEN = (0.1, 1.0)  # range of positions of an open joint, as shares of its range
TRIES = 50  # number of cameras tried before the object is rejected
DIRECTIONS = 24  # number of azimuths tried for the front


def observations(sample: EvalSample, count: int, seed: int) -> list[EvalSample]:
    """Return the first `count` observations of a sample."""
    return [observation(sample, number, seed) for number in range(count)]


def observation(sample: EvalSample, number: int, seed: int) -> EvalSample:
    """Return the surface visible in one picture: even numbers at rest, odd ones with one joint partly open.

    Raise InputError if no camera sees a movable part and the base.
    """
    rng = np.random.default_rng([seed, number, zlib.crc32(sample.truth.name.encode())])
    around, seen = front(sample)
    scene = opened(sample, seen, rng) if number % 2 else sample
    rays = RayScene(scene.mesh.vertices, scene.mesh.faces)
    for _ in range(TRIES):
        azimuth = around + np.deg2rad(rng.uniform(-ASIDE, ASIDE))
        camera = orbit_camera(scene.mesh.bounds, azimuth, np.deg2rad(rng.uniform(*ELEVATION)), SIZE)
        visible_sample = observed(scene, camera, rays)
        if visible_sample is not None:
            return visible_sample
    raise InputError(f"{sample.truth.name}: no picture shows a movable part and the base; found none in {TRIES} views")


def observed(sample: EvalSample, camera: Camera, rays: RayScene | None = None) -> EvalSample | None:
    """Return the part of the sample visible to a camera, with the ground truth of the visible parts.

    None if no movable part or no base is visible. Lengths of scores stay relative to the whole object's diagonal.
    """
    view = render(sample.mesh, camera, scene=rays)
    part = np.where(view.face >= 0, sample.labels[view.face], -1)
    bordering = (part == 0) & (maximum_filter(part, 3) > 0)  # one pixel of clearance, since edges are not known more precisely
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
    """Add the unseen walls of the object's box behind the surface, as base."""
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
    """Partly open the joint of one random part among these; return the sample unchanged if none has limits."""
    names = {sample.truth.parts[k].name for k in among}
    able = [j for j in sample.truth.joints if j.limits is not None and j.range_known and j.child in names]
    if not able:
        return sample
    joint = able[int(rng.integers(len(able)))]
    lower, upper = joint.limits or (0.0, 0.0)
    return posed(sample, {joint.child: lower + float(rng.uniform(*OPEN)) * (upper - lower)})


def front(sample: EvalSample) -> tuple[float, Int[np.ndarray, " k"]]:
    """Return the azimuth [rad] with most pixels of movable parts at rest, and the indices of the parts visible there."""
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
    return replace(truth, parts=parts, labels=number[truth.labels], joints=joints), number
