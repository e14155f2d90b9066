"""Test that free names are matched by words in any spelling, and give nothing without a known word."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from anymesh.types import JointType
from anymesh.vocabulary import FIXED, WORDS, is_fixed_name, recognize, typical_motion, words_of


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("LeftDoors_02", ["left", "door"]),
        ("door-handle.001", ["door", "handle"]),
        ("frontGlass", ["front", "glass"]),
        ("DRAWERS", ["drawer"]),
        ("chassis_Corpus", ["chassis", "corpus"]),  # no plurals
        ("axis glass radius", ["axis", "glass", "radius"]),
        ("switches latches bodies tapes", ["switch", "latch", "body", "tape"]),
        ("Türe", ["tuere"]),
        ("Tu\u0308re", ["tuere"]),
        ("door世界Handle", ["door", "handle"]),
        ("42", []),
        ("", []),
    ],
)
def test_names_fall_into_words(name: str, words: list[str]) -> None:
    assert words_of(name) == words


@pytest.mark.parametrize(
    ("name", "label"),
    [
        ("door", "door"),
        ("Cabinet_Door.003", "door"),
        ("doorHandle", "handle"),  # the last recognized word counts
        ("handle of the door", "door"),
        ("Schublade_2", "drawer"),
        ("steering_wheel", "wheel"),
        ("keycaps", "button"),
        ("Switches", "lever"),
        ("latches.001", "lever"),
        ("hatches", "door"),
        ("Poignée_2", "handle"),
        ("Tür_2", "door"),
        ("cajón", "drawer"),
        ("door_frame", None),  # a frame is static
        ("frame_door", "door"),
    ],
)
def test_names_that_speak_of_a_part(name: str, label: str | None) -> None:
    found = recognize(name)
    assert (None if found is None else found.label) == label


@pytest.mark.parametrize(
    "name", ["", "Mesh_042", "polySurface7", "Object", "outdoors_scene", "doorbell", "capital", "keystone", "Body2", "Body1_3"]
)
def test_names_that_mean_nothing(name: str) -> None:
    assert recognize(name) is None
    assert not is_fixed_name(name)
    assert typical_motion(name) is None


@pytest.mark.parametrize("name", ["chassis", "Corpus_01", "CHASSIS", "lower_shelves", "glass panels", "bodies"])
def test_names_of_what_stays(name: str) -> None:
    assert is_fixed_name(name)
    assert recognize(name) is None


@pytest.mark.parametrize(
    ("name", "label", "fixed"),
    [("drawer_top_wood", "drawer", False), ("drawer_bottom", "drawer", False), ("table_top", None, True), ("top", None, True)],
)
def test_where_a_part_is_does_not_say_what_it_is(name: str, label: str | None, fixed: bool) -> None:
    found = recognize(name)
    assert (None if found is None else found.label) == label
    assert is_fixed_name(name) is fixed


@pytest.mark.parametrize("name", ["tapes", "capes", "Türe"])
def test_an_ending_is_not_cut_to_make_a_word(name: str) -> None:
    assert recognize(name) is None


@given(st.text(max_size=40))
def test_a_name_never_speaks_both_ways(name: str) -> None:
    assert not (recognize(name) is not None and is_fixed_name(name))


@pytest.mark.parametrize("ending", ["", "_01", ".002"])
def test_every_word_is_known_in_every_spelling(ending: str) -> None:
    for name in (n for w in WORDS for n in w.names):
        for spelled in (name, name.upper(), name.capitalize(), f"Left{name.capitalize()}"):
            found = recognize(spelled + ending)
            assert found is not None, spelled
            assert name in found.names


def test_every_fixed_word_is_known_as_it_is_written() -> None:
    assert all(is_fixed_name(name) for name in FIXED)


def test_no_word_is_in_two_kinds() -> None:
    names = [n for w in WORDS for n in w.names]
    assert len(names) == len(set(names))
    assert not FIXED & set(names)
    assert all(typical_motion(w.label) is w.motion for w in WORDS)
    assert {w.motion for w in WORDS} == {JointType.REVOLUTE, JointType.PRISMATIC, JointType.CONTINUOUS, None}
