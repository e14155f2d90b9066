"""Objects on which the shipped classifiers were trained; figures on those are not held out."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache

from anymesh.articulation import motion_classifier
from anymesh.loading.upright import up_classifier
from anymesh.segmentation import part_classifier

FOLDERS = ("urdf", "static", "labelled", "mjcf", "partnet-mobility")  # kinds of data sets whose objects may have any source


@cache
def trained_objects() -> frozenset[str]:
    """Return SOURCE/NAME of every object that a shipped classifier was trained on."""
    classifiers = (part_classifier.shipped_classifier(), motion_classifier.shipped_classifier(), up_classifier())
    return frozenset(name for classifier in classifiers for name in classifier.manifest["objects"])


def trained_on(dataset: str, names: Sequence[str]) -> int:
    """Count the objects of a data set that were used for training; in data sets of kind FOLDERS by their names alone."""
    known = trained_objects()
    if dataset in FOLDERS:
        plain = {name.partition("/")[2] for name in known}
        return sum(name in plain for name in names)
    return sum(f"{dataset}/{name}" in known for name in names)


def trained_note(dataset: str, names: Sequence[str]) -> str:
    """Describe for a report whether its figures are held out."""
    count = trained_on(dataset, names)
    if count:
        return f"{count} of {len(names)} objects: figures on them are not held out"
    if any(name.startswith(f"{dataset}/") for name in trained_objects()):
        return "other objects of this set: figures are not held out"
    return "none of these objects"
