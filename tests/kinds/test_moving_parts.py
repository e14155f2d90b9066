"""Test which parts of a kind of object usually move, and how they count in both stages."""

import json
from importlib.resources import files

import numpy as np
import pytest
from assets import box, mesh_of

from anymesh.config import Config
from anymesh.kinds.moving_parts import MOVES, PartTable, move_of, shipped_table, usual_parts
from anymesh.pipeline.solving import Solver
from anymesh.segmentation.naming import whole_as_base
from anymesh.segmentation.part_classifier import shipped_classifier
from anymesh.types.motion import Recognition

BIN = {
    "words": "wheelie_bin garbage_bin", "objects": 4, "longest": [1, 1, 1], "moving": [3, 3, 3, 3],
    "parts": [
        {"name": "lid", "count": 4, "size": [0.5, 0.6, 0.7], "moves": {"turns level": 4}},
        {"name": "wheel", "count": 8, "size": [0.15, 0.2, 0.25], "moves": {"turns level": 8}},
    ],
}  # fmt: skip
CHEST = {
    "words": "chest_of_drawers", "objects": 4, "longest": [1, 1, 1], "moving": [2, 4, 6, 4],
    "parts": [{"name": "drawer", "count": 16, "size": [0.5, 0.6, 0.7], "moves": {"slides level": 16}}],
}  # fmt: skip
KEYBOARD = {
    "words": "keyboard", "objects": 2, "longest": [1, 1, 1], "moving": [60, 80],
    "parts": [{"name": "key", "count": 140, "size": [0.02, 0.03, 0.04], "moves": {"slides upright": 140}}],
}  # fmt: skip
TABLE = PartTable((BIN, CHEST, KEYBOARD))
AXES = np.array([[0, 1, 0], [0, 0, 1], [0, 1, 0], [0, 0, 1]], float)
SLIDES = np.array([False, False, True, True])


class Silent:
    name, exchanges, warnings = "silent", (), ()

    def ask(self, question):
        raise AssertionError(f"asked {question.kind}")


def places(sizes: list[float]) -> np.ndarray:
    place = np.zeros((len(sizes), 12))
    place[:, 3] = sizes
    return place


def test_the_table_is_whole():
    told = json.loads(files("anymesh.kinds").joinpath("moving_parts.json").read_text(encoding="utf-8"))
    assert "CC BY 4.0" in told["source"]
    names = [row["words"].split()[0] for row in told["kinds"]]
    assert len(set(names)) == len(names) > 80
    for row in told["kinds"]:
        assert len(row["moving"]) == row["objects"] > 0
        assert sum(part["count"] for part in row["parts"]) == sum(row["moving"])
        for part in row["parts"]:
            assert set(part["moves"]) <= set(MOVES)
            assert sum(part["moves"].values()) == part["count"]
            for low, middle, high in [part["size"], row["longest"], *([part["range"]] if "range" in part else [])]:
                assert 0 <= low <= middle <= high


@pytest.mark.parametrize(
    ("texts", "names"),
    [
        ((None, "Wheelie-Bin_02"), ("wheelie_bin",)),
        (("garbagebins",), ("wheelie_bin",)),
        (("dresser",), ("chest_of_drawers",)),  # another name of it in kinds.json
        (("object", "dresser_old"), ("chest_of_drawers",)),
        (("wheelie bin on a table",), None),  # a table, of which nothing is known
        (("bin",), None),
        (("", None), None),
    ],
)
def test_a_kind_is_known_by_its_names(texts, names):
    found = TABLE.find(*texts)
    assert (None if found is None else found.names) == names


def test_names_of_one_kind_share_their_rows():
    assert usual_parts("fridge").names == usual_parts("refrigerator").names == ("refrigerator",)
    assert set(usual_parts("kitchen_cabinet_1").names) == {"drawer_cabinet", "hingeddoor_cabinet"}
    assert shipped_table() is shipped_table()


def test_moves_are_told_by_the_axis():
    assert [move_of(a, slides=bool(s)) for a, s in zip(2 * AXES, SLIDES, strict=True)] == list(MOVES)


def test_motions_that_parts_of_this_size_have_gain():
    level, _, slide, _ = TABLE.find("wheelie_bin").gain_of_motions(0.6, AXES, SLIDES)
    assert level > 0 > slide
    level, _, slide, _ = TABLE.find("chest_of_drawers").gain_of_motions(0.6, AXES, SLIDES)
    assert level < 0 < slide
    assert not TABLE.find("bin")


def test_a_motion_in_no_table_is_not_excluded():
    """As objects like those of all kinds are added."""
    assert np.isfinite(TABLE.find("wheelie_bin").gain_of_motions(0.01, AXES, SLIDES)).all()


def test_about_as_many_parts_are_likely_as_usual():
    apart = np.zeros((12, 12), bool)
    bin_, chance = TABLE.find("wheelie_bin"), shipped_classifier().probability
    for score, more in ((np.full(12, 1.0), False), (np.array([-1.0] * 3 + [-5.0] * 9), True)):
        changed = bin_.part_scores(score, places([0.6, 0.2, 0.2] + [0.2] * 9), apart)
        before, after = chance(score).sum(), chance(changed).sum()
        assert abs(np.log(after / 3)) < abs(np.log(before / 3))
        assert (after > before) == more


def test_parts_of_a_usual_size_gain_most():
    score = TABLE.find("wheelie_bin").part_scores(np.zeros(3), places([0.6, 0.2, 0.03]), np.zeros((3, 3), bool))
    assert score[2] < min(score[:2])


def test_the_kind_comes_from_the_category_before_the_name_and_from_a_model():
    mesh = mesh_of([box((0, 0, 0), (1, 1, 1))])[0]
    assert Solver(mesh, name="crate").geometry._usual is None
    assert Solver(mesh, name="microwave_3").geometry._usual.names == ("microwave_oven",)
    assert Solver(mesh, Config(category="fridge"), name="microwave").geometry._usual.names == ("refrigerator",)


def test_what_a_model_recognizes_is_the_kind_unless_a_user_names_it():
    mesh = mesh_of([box((0, 0, 0), (1, 1, 1))])[0]
    for category, kind in ((None, "refrigerator"), ("microwave", "microwave_oven")):
        solver = Solver(mesh, Config(category=category), lambda _: Silent(), name="desk")
        solver.joints(whole_as_base(mesh), Recognition("fridge", None, ()))
        assert solver.geometry._usual.names == (kind,)
