"""Procedural furniture with exact joints (scene-synthesizer, Apache-2.0): no download, no key."""

from __future__ import annotations

import contextlib
import io
import re
import warnings
from dataclasses import dataclass, replace
from pathlib import Path

from anymesh.errors import InputError
from anymesh.evaluation.datasets.splits import check_split
from anymesh.evaluation.datasets.urdf_ import flatten_urdf
from anymesh.evaluation.ground_truth import GroundTruth

CLASSES = (
    "BaseCabinet", "WallCabinet", "SinkCabinet", "KitchenIsland", "Dishwasher", "Range", "Refrigerator", "Microwave",
    "HandWheel", "CNCMachine",
)  # fmt: skip
VARIED = ("BaseCabinet", "WallCabinet", "SinkCabinet", "Dishwasher", "Range", "Refrigerator")  # classes with random variants
VARIANTS = 7  # per class, in the subset "random"


@dataclass(frozen=True)
class SceneSynthesizer:
    """The classes in their default form; CLASS-SEED is a random variant.

    HandWheel has no visible base, so no visible part moves against another: a mesh in which no joint should be found.
    """

    name: str = "scene-synthesizer"
    splits: tuple[str, ...] = ("default", "random")

    def objects(self, split: str | None = None) -> list[str]:
        """Return the default forms, or the random variants for the subset "random"."""
        check_split(self.name, split, self.splits)
        return sorted(f"{c}-{k}" for c in VARIED for k in range(1, VARIANTS + 1)) if split == "random" else sorted(CLASSES)

    def truth(self, name: str, folder: Path) -> GroundTruth:
        return synthesize(name, folder)


def synthesize(name: str, folder: Path) -> GroundTruth:
    """Build CLASS (its default form) or CLASS-SEED and write it to `folder`: NAME/NAME.urdf and NAME.glb, flattened."""
    from scene_synthesizer import procedural_assets

    kind, _, seed = name.partition("-")
    valid = VARIED if seed else CLASSES
    if kind not in valid or not (seed.isdecimal() or name == kind):
        raise InputError(
            f"scene-synthesizer: found no object {name!r}; valid are {', '.join(CLASSES)}, {', '.join(VARIED)}-SEED"
        )
    urdf = folder / name / f"{name}.urdf"
    urdf.parent.mkdir(parents=True, exist_ok=True)
    with warnings.catch_warnings(), contextlib.redirect_stdout(io.StringIO()):
        warnings.simplefilter("ignore")
        make = getattr(procedural_assets, f"{kind}Asset")
        asset = make.random(seed=int(seed)) if seed else make()
        asset.scene(kind).export(str(urdf))
        truth = flatten_urdf(urdf, folder / f"{name}.glb", category=_words(kind))
    return replace(truth, name=name)


def _words(kind: str) -> str:
    return re.sub(r"(?<=[a-z])(?=[A-Z])", " ", kind).lower()
