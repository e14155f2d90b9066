"""Variants of an asset for domain randomisation: each part moves by one of its articulations, drawn by their weights."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from anymesh.correcting.articulations import articulations, weights_of
from anymesh.errors import OptionError
from anymesh.export import write_asset
from anymesh.export.options import ExportOptions
from anymesh.mechanisms.closing import giving_way
from anymesh.runtime import Progress, cache_folder, silent, write_json
from anymesh.types import Asset
from anymesh.types.motion import leaders

FOLDER, MANIFEST = "samples", "samples.json"
MAX_SAMPLES = 1000


@dataclass(frozen=True)
class Variants:
    """Variants that are asked for. Raise OptionError for an invalid number of them or seed; 0 for none."""

    count: int
    seed: int

    def __post_init__(self) -> None:
        if not 0 <= self.count <= MAX_SAMPLES:
            raise OptionError(f"--sample: found {self.count}; valid are 1 to {MAX_SAMPLES} variants, or 0 for none")
        if self.seed < 0:
            raise OptionError(f"--seed: found {self.seed}; valid is 0 or more")

    def write(self, asset: Asset, folder: Path, how: ExportOptions, progress: Progress = silent) -> None:
        """Write variants of an asset into `samples/NAME_0001`, .., and which articulation each joint has into `samples.json`.

        The same seed gives the same variants, and more of them begin with the same ones.
        """
        variants, how = [], replace(how, precision=0.0)
        for k in range(self.count):
            name = f"{asset.name}_{k + 1:04d}"
            progress("samples", name, k, self.count)
            place, choices = folder / FOLDER / name, drawn(asset, np.random.default_rng((self.seed, k)))
            chosen, ways = [articulations(j)[choices[j.name]] for j in asset.joints], leaders(asset.joints)
            lead = {n: way for n, way in ways.items() if not choices[n] and not choices[way.joint]}  # others follow none
            joints = tuple(replace(j, mimic=lead.get(j.name)) for j in chosen)
            place.mkdir(parents=True)
            variant = replace(asset, name=name, joints=joints, exchanges=(), proposals=(), warnings=())
            write_asset(variant, place, how, cache=cache_folder("shapes"))
            variants.append({"name": name, "folder": f"{FOLDER}/{name}", "choices": choices})
        if self.count:
            weights = {joint.name: weights_of(joint).tolist() for joint in asset.joints}
            record = {"asset": asset.name, "seed": self.seed, "weights": weights, "variants": variants}
            write_json(folder / FOLDER / MANIFEST, record)


def drawn(asset: Asset, rng: np.random.Generator) -> Mapping[str, int]:
    """Return the number of the articulation of each joint, by its name.

    Parts with the same label and parent whose articulations are of the same types in the same order, such as the drawers of a
    chest, all take the same one. Joints on closed loops keep the one that closes them.
    """
    at: dict[Any, float] = {}
    choices, looped = {}, {joint.name for joint in giving_way(asset)}
    for joint in asset.joints:
        label = next(part.label for part in asset.segmentation.parts if part.name == joint.child)
        alike = label, joint.parent, tuple(way.type for way in articulations(joint))
        u = at.setdefault(alike, float(rng.random()))
        free = joint.name not in looped
        choices[joint.name] = free * int(np.searchsorted(np.cumsum(weights_of(joint))[:-1], u, side="right"))
    return choices
