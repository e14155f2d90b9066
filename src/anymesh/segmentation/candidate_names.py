"""Names of nodes and materials as evidence for or against candidate parts."""

from __future__ import annotations

import itertools
from enum import IntEnum

import numpy as np

from anymesh.segmentation.part_candidates import PartCandidates
from anymesh.vocabulary import is_fixed_name, recognize, words_of


class NameClass(IntEnum):
    """Classes of the names of candidates."""

    NONE = 0  # no name, or an unknown one
    MOVABLE = 1
    FIXED = 2
    HANDLE = 3  # moves on its own or with the part that it is attached to


# [log-odds] added to the score for the class of a name
NAME_SCORE = {NameClass.NONE: 0.0, NameClass.MOVABLE: 5.0, NameClass.FIXED: -6.0, NameClass.HANDLE: 0.3}


def name_class(name: str) -> NameClass:
    """Return the class of a name."""
    word = recognize(name)
    if word is None:
        return NameClass.FIXED if is_fixed_name(name) else NameClass.NONE
    return NameClass.HANDLE if word.label == "handle" else NameClass.MOVABLE


def shared_name(candidates: PartCandidates, candidate: int) -> str:
    """Return the recognized name shared by all patches of a candidate, or the words that all their names begin with."""
    names = {candidates.names[p] for p in np.flatnonzero(candidates.members[candidate])}
    if len(names) == 1:
        return names.pop()
    # the common prefix of the first and last name in order is common to all
    first, *_, last = sorted(words_of(name) for name in names)
    return " ".join(a for a, _ in itertools.takewhile(lambda pair: pair[0] == pair[1], zip(first, last, strict=False)))
