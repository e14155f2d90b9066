"""PartNet-Mobility, the paper's benchmark: ID/{mobility.urdf, semantics.txt, meta.json, textured_objs/*.obj, images/*}.

The data are gated and non-commercial (SAPIEN's terms), so they are not shipped. Users who have accepted the terms unpack them
into a folder with one sub-folder per object.
Parts, joints and ranges come from mobility.urdf (which agrees with mobility_v2.json), labels from semantics.txt (`link_0 hinge
door`), the category from meta.json (model_cat). For a part that slides and rotates (slider+), the joint nearest to it is used;
loose parts (free) belong to the base.

Subsets. ID, OOD: the paper's five in-domain categories, and all others. cage-ID: CAGE's test objects; cage-OOD: categories that
CAGE does not train on. OneDoor: a single hinged door and no other moving part (the fixed tree of ANCSH).
The paper does not state which of these objects it used; a file split_NAME.txt in the folder, with one id per line, adds or
replaces a subset.
"""

from __future__ import annotations

import json
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

from anymesh.errors import InputError
from anymesh.evaluation.datasets.dataset import FolderDataset
from anymesh.evaluation.datasets.urdf_ import flatten_urdf
from anymesh.evaluation.ground_truth import GroundTruth

_TEST = {
    "Table":
    "19855 22241 23807 25144 25959 26503 30238 31601 32566 33914",
    "StorageFurniture":
    "35059 41086 44826 45135 45162 45173 45219 45235 45323 45415 45423 45573 45575 45600 45612 45620 45661 45662 "
    "45696 45699 45717 45908 45915 46002 46029 46045 46107 46108 46179 46439 46480 46549 46655 46787 46896 46955 "
    "46981 47168 47180 47185 47227 47233 47315 47648 47701 47747 48023 48167 48177 48513 48721 48740 48797 49038 "
    "49133",
    "WashingMachine":
    "103425",
    "Safe":
    "101594 102309 102311 102318 102380",
    "Dishwasher":
    "12414 12562 12578 12587 12592",
    "Refrigerator":
    "10347 10685 11231 11846 12252",
}  # fmt: skip
CAGE_CATEGORIES = frozenset(_TEST) | {"Oven", "Microwave"}
CAGE_TEST = frozenset(number for ids in _TEST.values() for number in ids.split())


URDFORMER = frozenset({"Oven", "Refrigerator", "StorageFurniture", "WashingMachine", "Dishwasher"})  # in-domain, section 4.1
MOVING = frozenset({"hinge", "slider", "slider+"})
SPLITS = ("ID", "OOD", "cage-ID", "cage-OOD", "OneDoor")


@dataclass(frozen=True)
class ObjectInfo:
    """Metadata of an object. links: (name, kind of joint, label) each."""

    category: str
    links: tuple[tuple[str, str, str], ...]

    @property
    def moving(self) -> list[tuple[str, str]]:
        """(kind, label) of each link that rotates or slides."""
        return [(kind, label) for _, kind, label in self.links if kind in MOVING]


@dataclass(frozen=True)
class PartNetMobility(FolderDataset):
    """PartNet-Mobility data set. folder: holds the objects' folders, each named by its id."""

    name: str = "partnet-mobility"

    @property
    def splits(self) -> tuple[str, ...]:
        return tuple(dict.fromkeys([*SPLITS, *self.listed]))

    def _names(self) -> list[str]:
        """Return the ids of the objects with a rotating or sliding part."""
        return sorted(self._entries)

    def _members(self, split: str, names: list[str]) -> list[str]:
        if split in self.listed:
            return super()._members(split, names)
        return [name for name in names if _belongs(split, name, self._entries[name])]

    def truth(self, name: str, folder: Path) -> GroundTruth:
        place = self.folder / name
        if not (place / "mobility.urdf").is_file():
            raise InputError(f"{self.folder.name}: found no object {name!r}; valid are ids such as {self.objects()[:3]}")
        entry = _read(place)
        labels = {link: label for link, _, label in entry.links}
        path = folder / f"{name}.glb"
        try:
            truth = flatten_urdf(place / "mobility.urdf", path, root=place, labels=labels, category=entry.category)
        except InputError as error:
            raise InputError(f"{name}/{error}") from None
        return replace(truth, name=name)

    @cached_property
    def _entries(self) -> dict[str, ObjectInfo]:
        places = [path.parent for path in self.folder.glob("*/mobility.urdf")]
        if not places:
            raise InputError(f"{self.folder}: found no ID/mobility.urdf; a folder with PartNet-Mobility's objects is expected")
        entries = {place.name: _read(place) for place in places}
        return {name: entry for name, entry in entries.items() if entry.moving}


def _read(place: Path) -> ObjectInfo:
    try:
        category = json.loads((place / "meta.json").read_text(encoding="utf-8"))["model_cat"]
        lines = (place / "semantics.txt").read_text(encoding="utf-8").splitlines()
    except (OSError, ValueError, KeyError, TypeError) as error:
        reason = "model_cat is missing" if isinstance(error, KeyError) else error
        raise InputError(f"{place.name}: meta.json or semantics.txt cannot be used ({reason})") from None
    rows = [line.split() for line in lines if line.strip()]
    if any(len(row) != 3 for row in rows):
        raise InputError(f"{place.name}/semantics.txt: each line needs a link, a kind and a label, such as `link_0 hinge door`")
    return ObjectInfo(str(category), tuple((link, kind, label) for link, kind, label in rows))


def _belongs(split: str, name: str, entry: ObjectInfo) -> bool:
    match split:
        case "ID":
            return entry.category in URDFORMER
        case "OOD":
            return entry.category not in URDFORMER
        case "cage-ID":
            return name in CAGE_TEST
        case "cage-OOD":
            return entry.category not in CAGE_CATEGORIES
        case _:
            return entry.moving == [("hinge", "door")]
