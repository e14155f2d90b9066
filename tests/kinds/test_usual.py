"""Test what is usual for kinds of objects: how they are named, their sizes and masses, and doubts about others."""

import json
from importlib.resources import files

import numpy as np
import pytest

from anymesh.kinds.usual import FACTOR, HEAVIEST, KINDS, LIGHTEST, doubts, kind_of
from anymesh.physics.substances import SUBSTANCES

FRIDGE = np.array([0.7, 0.7, 1.8])


def test_the_table_is_whole():
    table = json.loads(files("anymesh.kinds").joinpath("kinds.json").read_text(encoding="utf-8"))
    names = [name for row in table["kinds"] for name in row["words"].split()]
    assert len(set(names)) == len(names) == len(KINDS) > 100
    for row in table["kinds"]:
        kind = kind_of(row["words"].split()[0])
        assert kind.name == row["words"].split()[0]
        assert not kind.substance or kind.substance in SUBSTANCES
        assert kind.substance or not (kind.closed or kind.wall)
        for low, high in filter(None, (kind.longest, kind.height, kind.mass)):
            assert 0 < low < high
        assert kind.usual is None or kind.longest[0] <= kind.usual <= kind.longest[1]
        known = [any(name in row["source"] for name in table["sources"])]
        assert all(known) or row.keys() <= {"words", "wikidata", "source"}


def test_a_usual_box_of_each_closed_kind_weighs_what_is_usual():
    """Within the factor, as a shell of its walls, a side of its box being two thirds of the longest one."""
    for kind in KINDS.values():
        if kind.closed and kind.usual:
            substance = SUBSTANCES[kind.substance]
            a, b = kind.usual, kind.usual * 2 / 3
            mass = substance.density * (kind.wall or substance.sheet) * 2 * (2 * a * b + b * b)
            assert kind.mass[0] / FACTOR <= mass <= FACTOR * kind.mass[1], kind.name


@pytest.mark.parametrize(
    ("texts", "name"),
    [
        (("kitchenFridge_03",), "fridge"),
        ((None, "table_lamp"), "lamp"),
        (("chest of drawers",), "chest_of_drawers"),
        (("thing", "scene", "Chairs"), "chair"),
        (("fridge", "cabinet_2"), "fridge"),
        (("scissors",), "scissors"),
        (("kitchencabinet",), "cabinet"),
        (("kitchencounter_straight_A",), "kitchen_counter"),
        (("car", "toy_car"), "toy_car"),
        (("mini car", "car"), None),
        (("carpet",), None),
        ((None, ""), None),
    ],
)
def test_the_first_text_with_a_known_kind_counts(texts, name):
    kind = kind_of(*texts)
    assert (None if kind is None else kind.name) == name


def told(name, extents, masses, **more):
    return doubts(kind_of(name), np.asarray(extents, float), masses, **more)


def test_one_warning_says_what_is_usual_and_what_to_do():
    assert told("fridge", FRIDGE, [("base", 2800.0), ("door", 83.0)]) == (
        "mass 2,883 kg; a fridge usually has 22 to 157 kg; say --mass KG",
    )
    assert told("car", [0.44, 0.2, 0.15], [("base", 0.22)]) == (
        "mass 0.22 kg and longest side 0.44 m; a car usually has 800 to 2,500 kg and is 2.5 to 6 m long; "
        "say --mass KG or --scale 4.4:longest",
    )
    assert "mass 24 kg and longest side 0.94 m" in told("car", [0.94, 0.4, 0.4], [("base", 24.0)])[0]
    assert told("car", [0.94, 0.4, 0.4], [("base", 900.0)]) == ()  # the size alone is within the factor
    assert "height 0.08 m" in told("desk", [1.4, 0.7, 0.08], [("base", 30.0)])[0]


def test_what_is_usual_given_or_unknown_is_not_doubted():
    kind = kind_of("fridge")
    assert told("fridge", FRIDGE, [("base", kind.mass[1] * FACTOR)]) == ()
    assert told("fridge", FRIDGE, [("base", 2883.0)], given=True) == ()
    assert told("fridge", FRIDGE, []) == ()
    assert told("gizmo", FRIDGE, [("base", 300.0), ("knob", 1.0)]) == ()


@pytest.mark.parametrize(("density", "words"), [(1.1 * HEAVIEST, "metal"), (0.9 * LIGHTEST, "foam"), (700.0, None)])
def test_only_an_absurd_density_is_doubted_where_the_kind_is_unknown(density, words):
    found = told("gizmo", [0.1, 0.2, 0.3], [("base", 0.006 * density)])
    assert [words in text for text in found] == ([] if words is None else [True])


def test_the_part_that_is_heaviest_for_its_label_is_doubted_but_not_of_toys():
    masses = [("base", 20.0), ("knob", 30.0), ("button", 2.0)]
    assert told("gizmo", [1, 0.6, 0.5], masses)[0].startswith("mass 30 kg of a knob, which usually has up to 2 kg")
    assert told("toy", [0.3, 0.2, 0.2], [("base", 1.0), ("knob", 7.0)]) == ()
