"""A careless export keeps the look of a mesh, its truth, and what geometry finds in it."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from anymesh.evaluation.careless import CRACK, ENLARGED, OFF
from anymesh.evaluation.changes import changed
from anymesh.evaluation.ground_truth import EvalSample, example_truths
from anymesh.evaluation.protocols import prepared
from anymesh.geometry.distance_ import distance_to_mesh
from anymesh.geometry.surface import plain_triangles
from anymesh.geometry.topology import components
from anymesh.physics.inertia import InertiaConfig, raw_inertia
from anymesh.pipeline.solving import solve

CARELESS = ("doubled", "two-sided", "inside-out", "mixed", "cracked")


@pytest.fixture(scope="module")
def sample() -> EvalSample:
    truths = {t.name: t for t in example_truths(Path(__file__).parents[2] / "examples")}
    whole = prepared(truths["microwave"])
    count = len(whole.mesh.faces)
    numbers = np.arange(3 * count).reshape(count, 3)
    return replace(
        whole,
        mesh=replace(
            whole.mesh,
            corner_uv=np.stack([numbers, -numbers], 2).astype(np.float32),
            corner_normal=np.repeat(whole.mesh.face_normals[:, None], 3, 1).astype(np.float32),
        ),
    )


def corners(s: EvalSample) -> dict[tuple[float, ...], set[float]]:
    """Return the texture coordinates at each corner position, of whatever face."""
    at: dict[tuple[float, ...], set[float]] = {}
    for place, uv in zip(np.round(s.mesh.triangles, 4).reshape(-1, 3), s.mesh.corner_uv.reshape(-1, 2), strict=True):
        at.setdefault(tuple(place.tolist()), set()).add(float(uv[0]))
    return at


@pytest.mark.parametrize("name", CARELESS)
def test_every_corner_keeps_its_texture_and_every_part_its_surface(name: str, sample: EvalSample) -> None:
    new = changed(name, sample)
    assert new.truth is sample.truth
    if name != "cracked":
        assert corners(new) == corners(sample)
    normal = new.mesh.corner_normal
    assert np.einsum("fkd,fd->fk", normal, new.mesh.face_normals).min() > 0.9
    area = [np.bincount(s.labels, s.mesh.face_areas) for s in (new, sample)]
    assert area[0] == pytest.approx((2 if name in ("doubled", "two-sided") else 1) * area[1], rel=1e-3)


def test_what_each_change_does_to_the_faces(sample: EvalSample) -> None:
    t, count = sample.mesh.triangles, len(sample.labels)
    same = {name: (changed(name, sample).mesh.triangles[-count:] == t).all((1, 2)) for name in CARELESS[:4]}
    back = {name: (changed(name, sample).mesh.triangles[-count:] == t[:, ::-1]).all((1, 2)) for name in CARELESS[:4]}
    assert same["doubled"].all()
    assert back["two-sided"].all()
    assert back["inside-out"].all()
    assert (same["mixed"] ^ back["mixed"]).all()
    assert 0.4 < back["mixed"].mean() < 0.6
    cracked = changed("cracked", sample).mesh
    assert len(np.unique(cracked.faces)) == 3 * count
    off = np.abs(cracked.triangles - t).max()
    assert 0.4 * CRACK * sample.mesh.diagonal < off <= 0.5 * CRACK * sample.mesh.diagonal * (1 + 1e-9)


@pytest.mark.parametrize("name", CARELESS)
def test_geometry_finds_the_same_parts_and_joints(name: str, sample: EvalSample) -> None:
    plain = replace(sample, mesh=replace(sample.mesh, corner_uv=None, corner_normal=None))
    segmentation, joints = solve(plain.mesh)
    new = changed(name, plain)
    other, others = solve(new.mesh)
    assert [p.label for p in other.parts] == [p.label for p in segmentation.parts]
    assert (other.face_part[: len(segmentation.face_part)] == segmentation.face_part).all()
    assert (other.face_part[-len(segmentation.face_part) :] == segmentation.face_part).all()
    assert [j.type for j in others] == [j.type for j in joints]
    for one, two in zip(joints, others, strict=True):
        assert one.axis @ two.axis > 0.999
        assert (
            np.linalg.norm(np.cross(two.origin - one.origin, one.axis)) < 0.02 * plain.mesh.diagonal
        )  # half the thickness of the door


@pytest.mark.parametrize("name", CARELESS)
def test_the_mass_is_the_same(name: str, sample: EvalSample) -> None:
    door = sample.labels == 1
    diagonal = sample.mesh.diagonal
    mass = raw_inertia(sample.mesh.triangles[door], InertiaConfig())
    new = changed(name, sample)
    other = raw_inertia(plain_triangles(new.mesh.triangles[new.labels == 1], diagonal)[0], InertiaConfig())
    assert other.mass == pytest.approx(mass.mass, rel=1e-3)
    assert other.tensor == pytest.approx(mass.tensor, rel=1e-2, abs=1e-3 * np.trace(mass.tensor))


def test_what_is_placed_by_eye_moves_as_a_whole(sample: EvalSample) -> None:
    shift = (changed("misplaced", sample).mesh.triangles - sample.mesh.triangles) / sample.mesh.diagonal
    label = components(sample.mesh.vertices, sample.mesh.faces).label
    each = [shift[label == k].reshape(-1, 3) for k in range(label.max() + 1)]
    assert max(np.ptp(moves, axis=0).max() for moves in each) < 1e-12
    assert 0.3 * OFF < np.mean([np.abs(moves[0]) for moves in each]) < 0.7 * OFF
    assert max(np.abs(moves).max() for moves in each) <= OFF


def test_tight_parts_touch_what_they_fit_into(sample: EvalSample) -> None:
    """The door, knob and turntable of the microwave have clearances of .0028, .0011 and .0042 of the diagonal."""
    new, diagonal = changed("tight", sample), sample.mesh.diagonal
    moved = np.abs(new.mesh.triangles - sample.mesh.triangles).max((1, 2)) > 1e-9
    assert moved.tolist() == (sample.labels > 0).tolist()
    for part, clearance in enumerate((0.0028, 0.0011, 0.0042), start=1):
        own = sample.labels == part
        corners = [s.mesh.triangles[own].reshape(-1, 3) for s in (sample, new)]
        gap = [
            distance_to_mesh(c, s.mesh.vertices, s.mesh.faces[~own])[0].min() / diagonal
            for c, s in zip(corners, (sample, new), strict=True)
        ]
        assert gap[0] == pytest.approx(clearance, abs=5e-5)
        assert gap[1] < 2e-4
        wider = (np.ptp(corners[1], axis=0) - np.ptp(corners[0], axis=0)) / diagonal
        assert (wider > 1.99 * gap[0]).all()
        assert (wider < 2.01 * ENLARGED[1] * gap[0]).all()
