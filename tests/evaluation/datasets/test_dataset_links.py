"""Bodies and joints as one nameless mesh and the truth about it."""

from pathlib import Path

import numpy as np
import pytest
from assets import box, checker, mesh_of
from small_sets import loaded, part_box

from anymesh.errors import InputError
from anymesh.evaluation.datasets.links import DatasetLink, assemble
from anymesh.loading import load_mesh
from anymesh.types import JointType, KnownJoint, Material, Mesh, Texture

UP = np.array([0.0, 1.0, 0.0])


def shape(low, high) -> tuple[Mesh, ...]:
    return (mesh_of([box(low, high)])[0],)


def hinge(*limits: float, axis=UP) -> KnownJoint:
    known = (float(limits[0]), float(limits[1])) if limits else None
    return KnownJoint(JointType.REVOLUTE, np.zeros(3), np.asarray(axis, float), known, known is not None)


FRAME, DOOR, HANDLE = shape((0, 0, 0), (4, 4, 4)), shape((0, 0, 4), (4, 4, 4.1)), shape((3, 2, 4.1), (3.2, 2.2, 4.3))


def test_fixed_bodies_are_one_part(tmp_path: Path) -> None:
    bodies = [
        DatasetLink("frame", meshes=FRAME),
        DatasetLink("door", "frame", hinge(0, 1), DOOR),
        DatasetLink("knob", "door", None, HANDLE),
    ]
    truth = assemble("box", bodies, tmp_path / "box.glb", "cabinet")
    assert [p.name for p in truth.parts] == ["frame", "door"]
    assert truth.category == "cabinet"
    assert np.allclose(part_box(truth, "door"), [[0, 0, 4], [4, 4, 4.3]])
    assert np.allclose(part_box(truth, "frame"), [[0, 0, 0], [4, 4, 4]])


@pytest.mark.parametrize(
    ("limits", "sign", "kept"), [((-2, 0.5), -1, (-0.5, 2)), ((-0.5, 2), 1, (-0.5, 2)), ((0.2, 2), 1, (0.2, 2))]
)
def test_positive_goes_towards_the_larger_limit(tmp_path: Path, limits, sign: int, kept) -> None:
    bodies = [DatasetLink("frame", meshes=FRAME), DatasetLink("door", "frame", hinge(*limits, axis=2 * UP), DOOR)]
    joint = assemble("box", bodies, tmp_path / "box.glb").joints[0]
    assert joint.limits == kept
    assert np.allclose(joint.axis, sign * UP)
    assert joint.range_known


def test_an_unknown_range_stays_unknown(tmp_path: Path) -> None:
    joint = assemble(
        "b", [DatasetLink("frame", meshes=FRAME), DatasetLink("d", "frame", hinge(), DOOR)], tmp_path / "b.glb"
    ).joints[0]
    assert joint.limits is None
    assert not joint.range_known


def test_a_part_on_an_unseen_body_moves_against_the_next_that_is_seen(tmp_path: Path) -> None:
    unseen = DatasetLink("helper", "door", hinge(0, 3, axis=(1, 0, 0)))
    bodies = [DatasetLink("frame", meshes=FRAME), DatasetLink("door", "frame", hinge(0, 1), DOOR), unseen]
    bodies.append(DatasetLink("knob", "helper", hinge(0, 2, axis=(0, 0, 1)), HANDLE))
    truth = assemble("box", bodies, tmp_path / "box.glb")
    knob = next(j for j in truth.joints if j.child == "knob")
    assert knob.parent == "door"
    assert knob.limits == (0, 2)
    assert np.allclose(knob.axis, (0, 0, 1))


def test_an_unseen_root_is_stood_for_by_what_carries_the_others(tmp_path: Path) -> None:
    bodies = [
        DatasetLink("world"),
        DatasetLink("cart", "world", hinge(0, 1), HANDLE),
        DatasetLink("big", "cart", hinge(0, 1), FRAME),
    ]
    truth = assemble("cart", bodies, tmp_path / "cart.glb")
    assert [p.name for p in truth.parts] == ["cart", "big"]


def test_an_unseen_root_of_several_is_stood_for_by_the_largest(tmp_path: Path) -> None:
    bodies = [
        DatasetLink("world"),
        DatasetLink("a", "world", hinge(0, 1), HANDLE),
        DatasetLink("b", "world", hinge(0, 1), FRAME),
    ]
    truth = assemble("two", bodies, tmp_path / "two.glb")
    assert [p.name for p in truth.parts] == ["b", "a"]
    assert truth.joints[0].parent == "b"


def test_a_lone_body_has_no_joint(tmp_path: Path) -> None:
    truth = assemble("wheel", [DatasetLink("world"), DatasetLink("wheel", "world", hinge(0, 1), DOOR)], tmp_path / "wheel.glb")
    assert len(truth.parts) == 1
    assert not truth.joints


def test_nothing_to_be_seen_is_an_input_error(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="no body with a visible surface"):
        assemble("empty", [DatasetLink("base"), DatasetLink("door", "base", hinge(0, 1))], tmp_path / "empty.glb")


@pytest.mark.parametrize("motion", [None, hinge(0, 1)])
@pytest.mark.parametrize(
    ("parents", "words"),
    [
        (("knob", "door"), "door > knob > door; valid is a tree"),
        (("door", "door"), "door > door; valid is a tree"),
        (("wall", "door"), r"door > wall; valid is a tree of the links \['door', 'frame', 'knob'\]"),
    ],
)
def test_links_that_form_no_tree_are_an_input_error(tmp_path: Path, motion, parents: tuple[str, str], words: str) -> None:
    """Else the search for the root would not end."""
    door, knob = (DatasetLink(n, p, motion, m) for n, p, m in zip(("door", "knob"), parents, (DOOR, HANDLE), strict=True))
    with pytest.raises(InputError, match=words):
        assemble("box", [DatasetLink("frame", meshes=FRAME), door, knob], tmp_path / "box.glb")


def test_a_second_root_is_an_input_error(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="found the root link b beside the base"):
        assemble("two", [DatasetLink("a", meshes=FRAME), DatasetLink("b", meshes=DOOR)], tmp_path / "two.glb")


def test_looks_stay_and_names_do_not(tmp_path: Path) -> None:
    look = Material(
        "door_material", (1.0, 0.0, 0.0, 1.0), textures={"base_color": Texture(checker(), "image/png", "door_texture")}
    )
    uv = np.zeros((12, 3, 2), np.float32)
    painted, _ = mesh_of([box((0, 0, 4), (4, 4, 4.1))], face_material=np.zeros(12, int), materials=(look,), corner_uv=uv)
    bodies = [DatasetLink("frame", meshes=FRAME), DatasetLink("secret_door", "frame", hinge(0, 1), (painted,))]
    truth = assemble("secret_cabinet", bodies, tmp_path / "object.glb")
    mesh = loaded(truth)
    door = mesh.face_material[truth.labels == 1]
    assert {mesh.materials[k].base_color for k in door} == {(1, 0, 0, 1)}
    assert mesh.materials[int(door[0])].textures["base_color"].data == checker()
    assert b"secret" not in truth.mesh.read_bytes()
    assert b"door" not in truth.mesh.read_bytes()


def test_pieces_that_touch_share_no_corner(tmp_path: Path) -> None:
    """Else the file would join what the source keeps apart."""
    stacked = [
        DatasetLink("low", meshes=shape((0, 0, 0), (1, 1, 1))),
        DatasetLink("high", "low", hinge(0, 1), shape((0, 1, 0), (1, 2, 1))),
    ]
    truth = assemble("stack", stacked, tmp_path / "stack.glb")
    mesh = load_mesh(truth.mesh).mesh
    assert not set(mesh.faces[truth.labels == 0].ravel()) & set(mesh.faces[truth.labels == 1].ravel())
