"""Names for every format."""

import re

from hypothesis import given
from hypothesis import strategies as st

from anymesh.names import RESERVED, legal_names, listed


@given(st.lists(st.text(max_size=100), max_size=12))
def test_any_names_become_legal_unique_and_stay(names):
    found = legal_names(names)
    assert all(re.fullmatch(r"[A-Za-z][A-Za-z0-9_]*", n) for n in found)
    assert len({n.lower() for n in found}) == len(names)
    assert not any(n.lower() in RESERVED or n.lower().endswith("_collision") for n in found)
    assert legal_names(found) == found


def test_names_stay_readable():
    assert legal_names(["Tür", "door", "Door", "1a", "日本", "a b&<c>", "world", "door_collision"]) == [
        "Tur",
        "door",
        "Door_2",
        "part_1a",
        "part",
        "a_b_c",
        "world_part",
        "door_collision_part",
    ]


def test_a_legal_name_keeps_itself_when_another_becomes_it():
    assert legal_names(["a b", "a_b"]) == ["a_b_2", "a_b"]


def test_of_many_names_the_first_are_listed():
    assert listed(["a", "b"], 2) == "a, b"
    assert listed(["a", "b", "c", "d"], 2) == "a, b, and 2 more"
