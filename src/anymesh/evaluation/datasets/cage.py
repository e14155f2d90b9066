"""The split of CAGE (Liu et al., CVPR 2024), as published ids of PartNet-Mobility.

The ids are from indexes/data_split.json of the authors' repository (MIT). 81 objects of six categories are tested; two more
categories are only used for training.
"""

from __future__ import annotations

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
