"""Procedural furniture with exact joints (scene-synthesizer, Apache-2.0): no download, no key."""

from __future__ import annotations

import contextlib
import io
import warnings
from pathlib import Path

from anymesh.evaluation.datasets.urdf_ import flatten_urdf
from anymesh.evaluation.truth import Truth

CLASSES = (
    "BaseCabinet", "WallCabinet", "SinkCabinet", "KitchenIsland", "Dishwasher", "Range", "Refrigerator", "Microwave",
    "HandWheel", "CNCMachine",
)  # fmt: skip


def synthesize(name: str, folder: Path) -> Truth:
    """Builds one of CLASSES in its default form and writes it under `folder`: NAME/NAME.urdf and NAME.glb, flattened."""
    from scene_synthesizer import procedural_assets

    urdf = folder / name / f"{name}.urdf"
    urdf.parent.mkdir(parents=True, exist_ok=True)
    with warnings.catch_warnings(), contextlib.redirect_stdout(io.StringIO()):
        warnings.simplefilter("ignore")
        getattr(procedural_assets, f"{name}Asset")().scene(name).export(str(urdf))
        return flatten_urdf(urdf, folder / f"{name}.glb")
