"""PartNet-Mobility's format, written here: nothing of the data themselves."""

from pathlib import Path

import numpy as np
import pytest
from small_sets import SEMANTICS, loaded, part_box, write_partnet

from anymesh.errors import InputError, OptionError
from anymesh.evaluation.datasets.dataset import Dataset
from anymesh.evaluation.datasets.partnet_mobility import PartNetMobility
from anymesh.types import JointType

DOOR = "link_0 hinge door\nlink_1 heavy drawer\nlink_2 heavy body\nlink_3 free knob\n"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    write_partnet(tmp_path, "46002", "StorageFurniture")
    write_partnet(tmp_path, "7128", "Microwave", semantics=DOOR)
    write_partnet(tmp_path, "102380", "Safe", semantics=DOOR)
    write_partnet(tmp_path, "3763", "Bottle")
    write_partnet(tmp_path, "1", "Rock", semantics="link_0 static door\nlink_1 heavy drawer\nlink_2 free body\n")
    return tmp_path


def test_truth(folder: Path, tmp_path: Path) -> None:
    truth = PartNetMobility(folder).truth("46002", tmp_path / "out")
    mesh = loaded(truth)
    assert (truth.name, truth.category) == ("46002", "StorageFurniture")
    assert [(p.name, p.label) for p in truth.parts[1:]] == [("link_0", "door"), ("link_1", "drawer"), ("link_3", "knob")]
    door, drawer, knob = truth.joints
    assert {door.parent, drawer.parent, knob.parent} == {truth.parts[0].name}
    # the fixed joint to the base turns Y up to Z up, and the front to -x; in the file Y is up again
    assert door.type is JointType.REVOLUTE
    assert np.allclose(door.axis, (0, -1, 0))
    assert np.allclose(door.origin[[0, 2]], (-0.3, -0.5))
    assert door.limits == (0, 1.5)
    assert drawer.type is JointType.PRISMATIC
    assert np.allclose(drawer.axis, (-1, 0, 0))
    assert knob.type is JointType.CONTINUOUS
    assert np.allclose(part_box(truth, "link_0"), [[-0.4, 0, -0.5], [-0.3, 0.5, 0.5]])
    looks = [mesh.materials[k] for k in mesh.face_material[truth.labels == 0]]
    assert all("base_color" in m.textures for m in looks)


def test_subsets(folder: Path) -> None:
    data = PartNetMobility(folder)
    assert isinstance(data, Dataset)
    assert data.objects() == ["102380", "3763", "46002", "7128"]  # the rock does not move
    assert data.objects("ID") == ["46002"]
    assert data.objects("OOD") == ["102380", "3763", "7128"]
    assert data.objects("cage-ID") == ["102380", "46002"]
    assert data.objects("cage-OOD") == ["3763"]
    assert data.objects("OneDoor") == ["102380", "7128"]
    with pytest.raises(OptionError, match="cage-ID"):
        data.objects("cage")


def test_a_list_in_the_folder_replaces_a_subset(folder: Path) -> None:
    (folder / "split_OneDoor.txt").write_text("7128\n")
    (folder / "split_mine.txt").write_text("3763\n46002\n")
    data = PartNetMobility(folder)
    assert data.objects("OneDoor") == ["7128"]
    assert data.objects("mine") == ["3763", "46002"]


@pytest.mark.parametrize(
    ("file", "text", "said"),
    [
        ("meta.json", "{}", "model_cat"),
        ("meta.json", "{", "meta.json"),
        ("semantics.txt", "link_0 door\n", "a link, a kind and a label"),
        ("mobility.urdf", "<robot>", "mobility.urdf"),
    ],
)
def test_a_bad_file_is_named(tmp_path: Path, file: str, text: str, said: str) -> None:
    write_partnet(tmp_path, "12", "Box", semantics=SEMANTICS)
    (tmp_path / "12" / file).write_text(text)
    with pytest.raises(InputError, match=said) as error:
        PartNetMobility(tmp_path).truth("12", tmp_path / "out")
    assert "12" in str(error.value)


def test_another_folder_is_an_input_error(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"mobility\.urdf"):
        PartNetMobility(tmp_path).objects()
