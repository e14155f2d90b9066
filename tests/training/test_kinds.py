"""The kinds that training/kinds makes: truths that a person would agree with, the same for the same seed."""

from pathlib import Path
from zlib import crc32

import numpy as np
import pytest
import trimesh

from anymesh.evaluation.datasets.urdf_ import flatten_urdf
from anymesh.types import JointType
from training.kinds import registry as kinds
from training.kinds.model import Link, Model, without_hidden

SAMPLE = 40  # kinds that the default suite builds; those marked slow build them all


@pytest.fixture(scope="module", params=["sample", pytest.param("all", marks=pytest.mark.slow)])
def models(request: pytest.FixtureRequest) -> dict[str, Model]:
    """One of each kind, upright and complete."""
    chosen = sorted(kinds.ALL)
    if request.param == "sample":
        chosen = np.random.default_rng(0).choice(chosen, SAMPLE, replace=False).tolist()
    made = {kind: Model(np.random.default_rng([7, crc32(kind.encode())])) for kind in chosen}
    for kind, model in made.items():
        kinds.ALL[kind](model)
    return made


def _opened(mesh: trimesh.Trimesh, joint: Link, share: float) -> trimesh.Trimesh:
    at = (joint.limits[1] if joint.limits[1] >= -joint.limits[0] else joint.limits[0]) * share
    done = mesh.copy()
    if joint.type == "prismatic":
        done.apply_translation(at * joint.axis)
    else:
        done.apply_transform(trimesh.transformations.rotation_matrix(at, joint.axis, joint.origin))
    return done


def test_there_are_many_kinds() -> None:
    assert len(kinds.KINDS) >= 40


def test_every_part_has_a_joint_and_hangs_on_another(models: dict[str, Model]) -> None:
    for kind, model in models.items():
        parts = {part for part, _ in model.pieces}
        assert parts == {"base", *model.joints}, kind
        for joint in model.joints.values():
            assert joint.parent in parts, kind
            assert np.linalg.norm(joint.axis) == pytest.approx(1)
            assert joint.limits is None or joint.limits[0] <= 0 <= joint.limits[1], kind


def test_hinges_lie_on_their_part(models: dict[str, Model]) -> None:
    for kind, model in models.items():
        for part, joint in model.joints.items():
            if joint.type == "prismatic":
                continue
            mesh = model.of(part)
            center = mesh.bounds.mean(0)
            foot = joint.origin + ((center - joint.origin) @ joint.axis) * joint.axis
            assert np.linalg.norm(foot - center) < 0.62 * np.linalg.norm(mesh.extents), f"{kind} {part}"


def test_parts_move_but_stay_near_what_they_hang_on(models: dict[str, Model]) -> None:
    for kind, model in models.items():
        size = np.linalg.norm(np.ptp(np.concatenate([s.bounds for _, s in model.pieces]), axis=0))
        for part, joint in model.joints.items():
            if joint.limits is None:
                continue
            mesh = model.of(part)
            half = _opened(mesh, joint, 0.5)
            assert np.linalg.norm(half.vertices - mesh.vertices, axis=1).max() > 0.0004 * size, f"{kind} {part}"
            if joint.type == "prismatic":  # the front of a drawer without a box may leave its cabinet
                assert joint.limits[1] < 1.1 * np.ptp(model.of(joint.parent).vertices @ joint.axis), f"{kind} {part}"
                continue
            parent = model.of(joint.parent).bounds
            apart = np.maximum(np.maximum(parent[0] - half.bounds[1], half.bounds[0] - parent[1]), 0)
            assert np.linalg.norm(apart) < 0.05 * size, f"{kind} {part}"


def test_control_surfaces_hang_at_their_leading_edge_and_turn_down() -> None:
    model = Model(np.random.default_rng(3))
    kinds.KINDS["jet"](model)
    for part in ("aileron_left", "aileron_right", "flap_left", "flap_right", "elevator_left", "elevator_right"):
        mesh, joint = model.of(part), model.joints[part]
        away = np.linalg.norm(np.cross(mesh.vertices - joint.origin, joint.axis), axis=1)
        trailing = mesh.vertices[away.argmax()]
        assert away.min() < 0.2 * away.max(), part
        assert np.cross(joint.axis, trailing - joint.origin)[2] < -0.9 * away.max(), part
    assert abs(model.joints["aileron_left"].axis @ model.joints["aileron_right"].axis) < 0.99  # swept: not parallel


def test_doors_open_to_one_side_of_their_wall() -> None:
    for number in range(6):
        model = Model(np.random.default_rng(number))
        kinds.KINDS["hinged_door"](model)
        leaf, joint = model.of("leaf"), model.joints["leaf"]
        moved = _opened(leaf, joint, 0.5).bounds.mean(0) - leaf.bounds.mean(0)
        assert abs(moved[1]) > 0.2


def test_the_same_seed_makes_the_same_object() -> None:
    for kind in ("light_aircraft", "gate", "desk_lamp"):
        a, b, other = (kinds.build(kind, seed, 1) for seed in (5, 5, 6))
        assert [p for p, _ in a.pieces] == [p for p, _ in b.pieces]
        assert all(np.array_equal(s.triangles, t.triangles) for (_, s), (_, t) in zip(a.pieces, b.pieces, strict=True))
        mine, theirs = (np.concatenate([s.bounds for _, s in m.pieces[:3]]) for m in (a, other))
        assert not np.allclose(mine, theirs)


@pytest.mark.parametrize("number", [0, 1], ids=["obj", "stl"])
def test_urdf_reads_back_as_it_was_made(number: int, tmp_path: Path) -> None:
    model = kinds.build("safe", 0, number)
    truth = flatten_urdf(kinds.write("safe", 0, number, tmp_path), tmp_path / "flat" / "safe.glb")
    assert {p.name for p in truth.parts} == {"base", *model.joints}
    assert sum(len(s.faces) for _, s in model.pieces) == len(truth.labels)
    for joint in truth.joints:
        made = model.joints[joint.child]
        assert joint.parent == made.parent
        assert joint.type is JointType(made.type)
        assert joint.axis @ [made.axis[0], made.axis[2], -made.axis[1]] == pytest.approx(1)
        assert joint.limits == (None if made.limits is None else pytest.approx(made.limits))
        at = np.array([made.origin[0], made.origin[2], -made.origin[1]])
        assert np.linalg.norm(joint.origin - at) < 1e-6


def test_unseen_faces_go_when_an_artist_deletes_them() -> None:
    made = Model(np.random.default_rng(1))
    made.add("base", trimesh.creation.box((1, 1, 1)), trimesh.creation.box((0.5, 0.5, 0.5)))
    assert sum(len(s.faces) for _, s in without_hidden(made).pieces) == 12
