"""What differs between two assets, in millimetres, and between two collections."""

import json
import math
import re
import shutil

import mujoco
import numpy as np
import pytest
import typer
from drawn import chest
from typer.testing import CliRunner

from anymesh.checking.command_line import DIFFERENT, diff
from anymesh.checking.differences import differences, lines
from anymesh.errors import InputError

HINGE = 'upper="1.6"'


@pytest.fixture
def one(tmp_path):
    (tmp_path / "a").mkdir()
    chest(tmp_path / "a")
    return tmp_path / "a"


def other(one, *changes):
    folder = one.parent / "b"
    folder.mkdir()
    chest(folder, *changes)
    return folder


def only(one, *changes):
    """Return the difference of the only part that differs after some changes to the text of a copy."""
    result = differences(one, other(one, *changes))
    assert [p["change"] for p in result["parts"]] == ["changed"], "\n".join(lines(result))
    assert not result["same"]
    return result["parts"][0]


def reach(one) -> float:
    """Return the distance of the door's farthest point from its hinge [m], by MuJoCo's reading."""
    spec = mujoco.MjSpec.from_file(str(one / "chest.urdf"))
    spec.compiler.discardvisual = False
    corners = np.loadtxt([line[2:] for line in (one / "meshes" / "door.obj").read_text().splitlines() if line.startswith("v ")])
    return float(np.linalg.norm(corners[:, :2], axis=1).max())


def test_a_copy_is_the_same_whatever_its_other_files(one) -> None:
    shutil.copytree(one, one.parent / "b")
    (one / "timing.json").write_text("{}")
    (one / "stages").mkdir()
    (one / "stages" / "mesh.json").write_text("")
    assert differences(one, one.parent / "b")["same"]
    assert lines(differences(one, one.parent / "b")) == ["the same"]


def test_limits_tell_how_far_the_part_is_apart_at_its_end(one) -> None:
    change = only(one, (HINGE, 'upper="1.4"'))
    assert change["name"] == "door"
    assert change["limits"] == [[0.0, 1.6], [0.0, 1.4]]
    assert change["displacement_mm"] == pytest.approx(2000 * reach(one) * math.sin(0.1), rel=1e-4)
    assert change["at_rest_mm"] == 0


def test_a_moved_axis_moves_the_part_by_its_chord(one) -> None:
    text = (one / "chest.urdf").read_text()
    origin = re.search(r'<joint name="hinge".*?<origin xyz="([^"]*)"', text, re.DOTALL)[1]
    x, y, z = map(float, origin.split())
    moved = only(one, (f'<origin xyz="{origin}" />', f'<origin xyz="{x + 0.01:g} {y:g} {z:g}" />'))
    assert moved["axis"] == {"degrees": 0.0, "mm": 10.0, "reversed": False}
    assert moved["at_rest_mm"] == pytest.approx(10.0)
    assert moved["displacement_mm"] == pytest.approx(10.0, rel=1e-3)  # its points moved with it


def test_a_reversed_axis(one) -> None:
    change = only(one, ('axis xyz="0 0 1"', 'axis xyz="0 0 -1"'))
    assert change["axis"]["reversed"]
    assert change["displacement_mm"] == pytest.approx(2000 * reach(one), rel=1e-3)  # 1.6 rad each way: over half a turn


def test_axis_and_limits_reversed_are_the_same_motion(one) -> None:
    change = only(one, ('axis xyz="0 0 1"', 'axis xyz="0 0 -1"'), ('lower="0" upper="1.6"', 'lower="-1.6" upper="0"'))
    assert change["axis"]["reversed"]
    assert "displacement_mm" not in change


def test_type_and_dynamics(one) -> None:
    change = only(one, ('name="hinge" type="revolute"', 'name="hinge" type="continuous"'))
    assert change["type"] == ["revolute", "continuous"]
    assert change["limits"] == [[0.0, 1.6], None]
    shutil.rmtree(one.parent / "b")
    assert only(one, ('effort="20" ', 'effort="21" '))["dynamics"] == {"effort": [20.0, 21.0]}


def test_inertia_collision_and_textures(one) -> None:
    change = only(one, ('mass value="3.864"', 'mass value="4"'))
    assert change["inertia"] == {"mass": [3.864, 4.0], "center_mm": 0.0, "tensor": 0.0}
    shutil.rmtree(one.parent / "b")
    text = (one / "chest.urdf").read_text()
    size = re.search(r'(?s)<link name="door">.*?<box (size="[^"]*")', text)[1]
    numbers = [float(v) for v in size[6:-1].split()]
    larger = 'size="' + " ".join(f"{v:g}" for v in (numbers[0] + 0.02, *numbers[1:])) + '"'
    assert only(one, (size, larger))["collision"] == {"shapes": [1, 1], "mm": pytest.approx(10.0)}
    shutil.rmtree(one.parent / "b")
    b = other(one)
    (b / "meshes" / "all.mtl").write_text("newmtl wood\nKd 1 0 0\n")
    assert [p["textures"] for p in differences(one, b)["parts"]] == ["changed"] * 3


def test_parts_are_matched_by_place_then_name_then_shape(one) -> None:
    swapped = [('"door"', '"x"'), ('"drawer"', '"door"'), ('"x"', '"drawer"')]
    result = differences(one, other(one, *swapped))
    assert sorted(p["renamed"] for p in result["parts"] if "renamed" in p) == [["door", "drawer"], ["drawer", "door"]]
    assert result["displacement_mm"] == 0


def test_added_and_removed_parts(one) -> None:
    b = other(one)
    text = (b / "chest.urdf").read_text()
    text = re.sub(r'(?s)<link name="drawer">.*?</link>', "", text)
    (b / "chest.urdf").write_text(re.sub(r'(?s)<joint name="slide".*?</joint>', "", text))
    assert differences(one, b)["parts"] == [{"name": "drawer", "change": "removed"}]
    assert differences(b, one)["parts"] == [{"name": "drawer", "change": "added"}]


def test_another_shape_is_measured_by_its_surface(one) -> None:
    b = other(one)
    obj = b / "meshes" / "door.obj"
    text = obj.read_text()
    first = next(line for line in text.splitlines() if line.startswith("v "))
    x, y, z = map(float, first.split()[1:])
    obj.write_text(text.replace(first, f"v {x} {y - 0.005} {z}", 1))
    (change,) = differences(one, b)["parts"]
    assert change["shape"] == "changed"
    assert 0 < change["at_rest_mm"] <= 5.001


def test_collections_are_matched_by_name(tmp_path) -> None:
    for side in "ab":
        for name in ("kitchen/one", "kitchen/two", "three"):
            (tmp_path / side / name).mkdir(parents=True)
            chest(tmp_path / side / name)
    assert differences(tmp_path / "a", tmp_path / "b")["same"]
    chest(tmp_path / "b" / "kitchen" / "two", (HINGE, 'upper="1.4"'))
    (tmp_path / "b" / "three").rename(tmp_path / "b" / "four")
    chest(tmp_path / "b" / "kitchen" / "one").write_text("<robot>")
    app = typer.Typer()
    app.command()(diff)
    ran = CliRunner().invoke(app, [str(tmp_path / "a"), str(tmp_path / "b"), "--json"])
    assert ran.exit_code == DIFFERENT
    result = json.loads(ran.stdout)
    assert (result["added"], result["removed"], list(result["changed"])) == (
        ["four"],
        ["three"],
        ["kitchen/one", "kitchen/two"],
    )
    assert "cannot be read" in result["changed"]["kitchen/one"]["error"]
    assert result["changed"]["kitchen/two"]["parts"][0]["limits"] == [[0.0, 1.6], [0.0, 1.4]]
    shown = CliRunner().invoke(app, [str(tmp_path / "a"), str(tmp_path / "b")]).stdout
    assert shown.endswith("2 of 2 assets differ, 1 added, 1 removed\n")


def test_what_cannot_be_compared(one, tmp_path) -> None:
    with pytest.raises(InputError, match="is not there"):
        differences(one, tmp_path / "nowhere")
    with pytest.raises(InputError, match="one is an asset"):
        differences(one, tmp_path)
    (tmp_path / "empty").mkdir()
    with pytest.raises(InputError, match="holds no asset"):
        differences(tmp_path, tmp_path / "empty")


def test_a_loop_that_was_moved_is_told(one):
    theirs = other(one)
    for folder, x in ((one, 0.5), (theirs, 0.51)):
        (folder / "asset.json").write_text(json.dumps({"loops": [{"name": "pin", "origin": [x, 0.0, 0.0]}]}))
    result = differences(one, theirs)
    assert [loops[0]["origin"][0] for loops in result["loops"]] == [0.5, 0.51]
    assert lines(result)[0] == "loops name pin, origin [0.5, 0.0, 0.0] -> name pin, origin [0.51, 0.0, 0.0]"
    assert "loops" not in differences(one, one)
