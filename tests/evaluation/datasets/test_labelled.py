"""Folders of a mesh with labels and a record of joints."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from assets import box, mesh_of

from anymesh.errors import InputError
from anymesh.evaluation.datasets.labelled import LabelledFolder
from anymesh.evaluation.datasets.named import open_dataset
from anymesh.evaluation.ground_truth import Following, prepared
from anymesh.evaluation.score import score
from anymesh.types import JointType, Mimic


def written(folder: Path, **changes) -> Path:
    """A case with a door in front, hinged at its left, and a drawer; Z up."""
    mesh, piece = mesh_of(
        [box((0, 0, 0), (0.6, 0.4, 0.5)), box((0, -0.02, 0), (0.6, 0, 0.3)), box((0, -0.02, 0.3), (0.6, 0, 0.5))]
    )
    rows = "\n".join(" ".join(f"{x:.9g}" for x in v) for v in mesh.vertices)
    faces = "\n".join(f"3 {a} {b} {c}" for a, b, c in mesh.faces)
    head = (
        f"ply\nformat ascii 1.0\nelement vertex {len(mesh.vertices)}\nproperty float x\nproperty float y\nproperty float z\n"
        f"element face {len(mesh.faces)}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    place = folder / "some_1"
    place.mkdir()
    (place / "rigid.ply").write_text(f"{head}{rows}\n{faces}\n")
    np.save(place / "labels.npy", piece.astype(np.int16))
    door = {"part": 1, "parent_part": 0, "type": "revolute", "axis": [0, 0, -1], "origin": [0, -0.01, 0], "limits": [0, 1.5]}
    drawer = {"part": 2, "parent_part": 0, "type": "prismatic", "axis": [0, 1, 0], "origin": [0, 0, 0], "limits": [-0.3, 0]}
    record = {"category": "case", "up": [0, 0, 1], "joints": [door, drawer], **changes}
    (place / "gt.json").write_text(json.dumps(record))
    return place


def test_parts_and_joints_are_where_they_were(tmp_path: Path) -> None:
    written(tmp_path)
    data = open_dataset(f"labelled:{tmp_path}")
    assert list(data.objects()) == ["some_1"]
    out = tmp_path / "out"
    truth = data.truth("some_1", out)
    sample = prepared(truth)
    assert truth.category == "case"
    assert "part_1" not in (out / "some_1.glb").read_bytes().decode("latin-1")  # the file gives nothing away
    door, drawer = (sample.joint(j) for j in truth.joints)
    assert (door.type, drawer.type) == (JointType.REVOLUTE, JointType.PRISMATIC)
    assert np.allclose(door.axis, (0, 0, -1), atol=1e-6)
    assert np.allclose(drawer.axis, (0, -1, 0), atol=1e-6)
    assert drawer.limits == pytest.approx((0, 0.3))
    corners = sample.mesh.triangles[sample.labels == 1].reshape(-1, 3)
    assert door.origin[0] == pytest.approx(corners[:, 0].min())


def test_what_cannot_be_used_is_told(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"gt\.json"):
        open_dataset(f"labelled:{tmp_path}").objects()
    place = written(tmp_path, up=[1, 0, 0])
    with pytest.raises(InputError, match="some_1"):
        open_dataset(f"labelled:{tmp_path}").truth("some_1", tmp_path / "out")
    np.save(place / "labels.npy", np.zeros(3, np.int16))
    with pytest.raises(InputError, match="cannot be used"):
        open_dataset(f"labelled:{tmp_path}").truth("some_1", tmp_path / "out")


JOINT = {"part": 1, "parent_part": 0, "type": "revolute", "axis": [0, 0, 1], "origin": [0, 0, 0], "limits": [0, 1.5]}


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"axis": [0, 0, 0]}, "joint 1: found an axis without a direction"),
        ({"axis": [0, float("nan"), 1]}, "joint 1: found axis .*; valid is three finite numbers"),
        ({"origin": [0, float("inf"), 1]}, "valid is three finite numbers"),
        ({"limits": [1, -1]}, "valid are two in order"),
        ({"limits": [0, float("inf")]}, "valid is two numbers, or null"),
        ({"limits": [1]}, "valid is two numbers, or null"),
        ({"parent_part": 9}, r"found parent_part 9; valid is one of \[0, 1, 2\]"),
        ({"parent_part": 1}, "part_1 > part_1; valid is a tree"),
        ({"part": float("inf")}, "found part inf; valid is one of"),
        ({"part": 2}, "at most one of each"),
        ({"type": "wobbly"}, "found type wobbly; valid is revolute, "),
    ],
)
def test_a_truth_that_makes_no_sense_is_told(tmp_path: Path, change: dict, words: str) -> None:
    written(tmp_path, joints=[{**JOINT, **change}, {**JOINT, "part": 2}])
    with pytest.raises(InputError, match=words):
        open_dataset(f"labelled:{tmp_path}").truth("some_1", tmp_path / "out")


@pytest.mark.parametrize("change", [lambda a: a.astype(str), lambda a: a.astype(float), lambda a: a + 1, lambda a: a - 1])
def test_labels_are_whole_numbers_from_0(tmp_path: Path, change) -> None:
    place = written(tmp_path)
    np.save(place / "labels.npy", change(np.load(place / "labels.npy")))
    with pytest.raises(InputError, match="valid is one integer per face, 0 for the base"):
        open_dataset(f"labelled:{tmp_path}").truth("some_1", tmp_path / "out")


def test_what_a_part_follows_is_read_from_a_ratio_or_a_name(tmp_path: Path) -> None:
    door, drawer = ({**JOINT, "name": "door"}, {**JOINT, "part": 2, "name": "flap", "limits": [0, 0.75]})
    for mimic, ratio in (("base_to_door", None), ("top_hinge", None), ({"joint": "door", "ratio": -0.5}, -0.5)):
        folder = tmp_path / str(len(list(tmp_path.iterdir())))
        folder.mkdir()
        written(folder, joints=[door, drawer | {"mimic": mimic, "dof_of_link": 2}])
        sample = prepared(LabelledFolder(folder).truth("some_1", tmp_path / "out"))
        _, flap = sample.truth.joints
        assert flap.follows == Following("part_1", ratio)
        assert flap.freedoms == 2
        led = sample.asset().joints[1]
        assert led.mimic == Mimic("part_1_joint", 0.5 if ratio is None else ratio)  # not told: that of the ranges
        scored = score(sample, sample.segmentation(), sample.asset().joints).followers
        assert (scored.true, scored.found, scored.right, scored.invented) == (1, 1, 1, 0)
        free = tuple(replace(j, mimic=None) for j in sample.asset().joints)
        assert score(sample, sample.segmentation(), free).followers.found == 0


def test_followers_that_are_none_are_counted(tmp_path: Path) -> None:
    written(tmp_path, joints=[JOINT, {**JOINT, "part": 2}])
    sample = prepared(LabelledFolder(tmp_path).truth("some_1", tmp_path / "out"))
    first, second = sample.asset().joints
    made = score(sample, sample.segmentation(), (first, replace(second, mimic=Mimic(first.name, 1.0)))).followers
    assert (made.true, made.found, made.invented) == (0, 0, 1)
