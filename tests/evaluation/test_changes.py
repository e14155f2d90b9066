"""A change does to the mesh what it says, and the truth stays the truth of what is left."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from assets import cabinet

from anymesh.errors import OptionError
from anymesh.evaluation.changes import CHANGES, CRACK, ENLARGED, OFF, UpSource, changed, moved, placed_by, rotation
from anymesh.evaluation.fused_ import joined, wrapped
from anymesh.evaluation.ground_truth import EvalSample, GroundTruth, TrueJoint, example_truths, prepared
from anymesh.geometry.distance_ import distance_to_mesh
from anymesh.geometry.surface import plain_triangles
from anymesh.geometry.topology import components
from anymesh.physics.inertia import InertiaConfig, raw_inertia
from anymesh.pipeline.solving import solve
from anymesh.types import Part

TRUTHS = {t.name: t for t in example_truths(Path(__file__).parents[2] / "examples")}
MOTIONS = ("turned", "tilted", "lying", "overturned", "spun", "shrunk", "grown")
ADDED = ("detailed", "furnished", "floored")  # in test_details.py
CARELESS = ("doubled", "two-sided", "inside-out", "mixed", "cracked")


@pytest.fixture(scope="module")
def microwave() -> EvalSample:
    return prepared(TRUTHS["microwave"])


def off_the_old_surface(new: EvalSample, old: EvalSample) -> float:
    """Largest distance of the new faces of each part from that part's old faces [diagonals], whatever moved."""
    back = new.mesh.transformed(old.T @ np.linalg.inv(new.T))
    names = [p.name for p in old.truth.parts]
    off = []
    for number, part in enumerate(new.truth.parts):
        mine = old.mesh.faces[old.labels == names.index(part.name)]
        off.append(distance_to_mesh(back.triangles[new.labels == number].mean(1), old.mesh.vertices, mine)[0].max())
    return max(off) / old.mesh.diagonal


@pytest.mark.parametrize("name", MOTIONS)
def test_a_motion_moves_mesh_and_truth_alike(name: str, microwave: EvalSample) -> None:
    new = changed(name, microwave)
    M = new.T @ np.linalg.inv(microwave.T)
    assert np.linalg.norm(M - np.eye(4)) > 0.01
    assert np.linalg.det(M) > 0
    assert np.allclose(M[:3, :3] @ M[:3, :3].T, np.cbrt(np.linalg.det(M)) ** 2 * np.eye(3))
    assert off_the_old_surface(new, microwave) < 1e-9
    assert new.unit == pytest.approx(microwave.unit * np.cbrt(np.linalg.det(M)))


def test_up_stays_up_when_turned_alone(microwave: EvalSample) -> None:
    up = {name: (changed(name, microwave).T @ np.linalg.inv(microwave.T))[:3, :3] @ [0, 0, 1] for name in MOTIONS}
    assert np.allclose(up["turned"], [0, 0, 1])
    assert up["tilted"][2] == pytest.approx(np.cos(np.deg2rad(5)))
    assert up["lying"][2] == pytest.approx(0)
    assert up["overturned"][2] == pytest.approx(-1)


@pytest.mark.parametrize("name", sorted(set(CHANGES) - {"none", "fused", "ajar", *MOTIONS, *ADDED}))
def test_every_part_keeps_to_its_own_surface(name: str, microwave: EvalSample) -> None:
    new = changed(name, microwave)
    assert len(new.labels) == len(new.mesh.faces)
    assert off_the_old_surface(new, microwave) < 0.02
    assert {j.child for j in new.truth.joints} == {p.name for p in new.truth.parts[1:]}
    assert set(new.labels) == set(range(len(new.truth.parts)))


def test_the_same_seed_gives_the_same_mesh_and_another_seed_another(microwave: EvalSample) -> None:
    first, again, other = (changed("noise.001", microwave, seed).mesh.vertices for seed in (3, 3, 4))
    assert (first == again).all()
    assert not np.allclose(first, other)


def test_noise_opens_no_seam(microwave: EvalSample) -> None:
    new = changed("noise.001", microwave)
    spread = np.abs(new.mesh.vertices - microwave.mesh.vertices).mean() / microwave.mesh.diagonal
    assert 0.0006 < spread < 0.001  # of a normal distribution it is .8 of the deviation
    assert components(new.mesh.vertices, new.mesh.faces).solid.all()


def test_a_quarter_of_the_faces(microwave: EvalSample) -> None:
    label = components(microwave.mesh.vertices, microwave.mesh.faces).label
    dense = np.bincount(label).max()
    new = changed("quarter-faces", microwave)
    assert np.bincount(components(new.mesh.vertices, new.mesh.faces).label).max() <= max(60, 0.3 * dense)


def test_what_is_behind_a_door_is_gone_and_not_to_be_found(microwave: EvalSample) -> None:
    hidden = [changed(name, microwave).truth for name in ("unseen-gone", "fused-coarse")]
    assert [len(t.parts) for t in (microwave.truth, *hidden)] == [4, 3, 3]  # without the turntable
    assert [len(t.joints) for t in hidden] == [2, 2]


def test_what_moved_on_a_part_that_is_gone_moves_on_its_carrier() -> None:
    mesh = cabinet().mesh
    joint = TrueJoint(cabinet().joints[0].type, np.zeros(3), np.array([0, 0, 1.0]), (0.0, 1.0), child="a", parent="base")
    parts = tuple(Part(name, "part") for name in ("base", "a", "b"))
    inside = np.zeros(len(mesh.faces), np.int64)
    inside[-1] = 2
    sample = EvalSample(
        GroundTruth("x", Path("x.glb"), parts, inside, (joint, replace(joint, child="b", parent="a"))), mesh, inside, np.eye(4)
    )
    new = changed("noise.0001", sample)
    assert new.truth is sample.truth  # faces stay
    left = changed("half-faces", sample).truth
    assert [(j.child, j.parent) for j in left.joints] == [("b", "base")]


def box(low: list[float], high: list[float]) -> np.ndarray:
    """12 triangles, outward."""
    at = np.array([low, high])
    v = np.array([[at[i, 0], at[j, 1], at[k, 2]] for i in (0, 1) for j in (0, 1) for k in (0, 1)], float)
    quads = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    return np.array([v[[q[0], q[a], q[a + 1]]] for q in quads for a in (1, 2)])


def volume(t: np.ndarray) -> float:
    return float(np.einsum("ij,ij->i", t[:, 0], np.cross(t[:, 1], t[:, 2])).sum() / 6)


def test_a_union_has_no_walls_inside() -> None:
    whole = joined([box([0, 0, 0], [1, 1, 1]), box([1, 0, 0], [2, 1, 1]), box([0.5, 0.5, 0.5], [1.5, 0.9, 1.5])])
    assert volume(whole) == pytest.approx(2.2, abs=1e-4)
    assert components(whole.reshape(-1, 3), np.arange(3 * len(whole)).reshape(-1, 3)).count == 1


def test_a_wrap_closes_narrow_gaps_and_leaves_wide_ones() -> None:
    one = box([0, 0, 0], [1, 1, 1])
    for gap, bodies in ((0.02, 1), (0.2, 2)):
        vertices, faces = wrapped(np.concatenate([one, one + np.array([1 + gap, 0, 0])]), 0.05)
        found = components(vertices, faces)
        assert (found.count, found.solid.all(), found.flip.any()) == (bodies, True, False)


def test_a_wrap_keeps_its_distance_and_needs_no_closed_surface() -> None:
    sheet = box([0, 0, 0], [1, 1, 1])[2:]  # a side is missing: an open box stays open
    vertices, faces = wrapped(sheet, 0.05)
    gap = distance_to_mesh(vertices, sheet.reshape(-1, 3), np.arange(3 * len(sheet)).reshape(-1, 3))[0]
    assert gap == pytest.approx(0.03, abs=0.004)
    assert volume(vertices[faces]) == pytest.approx(5 * 0.06, rel=0.2)  # five sides, each as thick as twice the distance


def test_an_unknown_change_is_told_with_the_known_ones(microwave: EvalSample) -> None:
    with pytest.raises(OptionError, match=r"'melted'.*turned.*fused"):
        changed("melted", microwave)


def test_moving_twice_is_moving_by_the_product(microwave: EvalSample) -> None:
    a, b = rotation(np.array([0, 0, 1.0]), 0.4), rotation(np.array([1.0, 0, 0]), -1.0)
    assert np.allclose(moved(moved(microwave, a), b).mesh.vertices, moved(microwave, b @ a).mesh.vertices)


def test_a_changed_mesh_is_stood_up_by_its_true_or_inferred_up_direction(microwave: EvalSample) -> None:
    spun = changed("spun", microwave)
    assert spun.up @ [0, 0, 1] < 0.99
    np.testing.assert_allclose(spun.up, (spun.T @ np.linalg.inv(microwave.T))[:3, :3] @ [0, 0, 1], atol=1e-12)
    assert placed_by(UpSource.MESH, spun) is spun
    stood = placed_by(UpSource.GIVEN, spun)
    np.testing.assert_allclose(stood.up, [0, 0, 1], atol=1e-12)
    assert off_the_old_surface(stood, microwave) < 1e-9
    assert stood.mesh.extents[2] == pytest.approx(microwave.mesh.extents[2])
    assert stood.unit == pytest.approx(microwave.unit)
    bucket = changed("spun", prepared(TRUTHS["bucket"]))
    np.testing.assert_allclose(placed_by(UpSource.INFER, bucket).up, [0, 0, 1], atol=0.01)


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
