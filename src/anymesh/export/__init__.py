"""Export of an asset to files: URDF, MJCF, USD, SDFormat, animated GLB, meshes, asset.json."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from anymesh.entry_points import WRITE_TRANSCRIPT, resolve
from anymesh.export.asset_json import TIMING_FILE, asset_record, json_text
from anymesh.export.formats import DEFAULT, Format, load_libraries, parse_formats, write_formats
from anymesh.export.meshes import write_meshes
from anymesh.export.model import Base, Driven, ExportConfig, Model, build_model
from anymesh.runtime import Deadline
from anymesh.types import Asset

TRANSCRIPT = "transcript"  # folder of the questions and answers, browsable and replayable

__all__ = ["Base", "Driven", "ExportConfig", "Format", "load_libraries", "parse_formats", "write_asset"]


def write_asset(
    asset: Asset,
    folder: Path,
    *,
    base: Base = Base.FIXED,
    formats: Sequence[Format] = DEFAULT,
    driven: Driven = Driven.PASSIVE,
    hulls: int | None = None,
    config: ExportConfig = ExportConfig(),  # noqa: B008 - frozen
    cache: Path | None = None,
    deadline: Deadline | None = None,
) -> Model:
    """Write each format, meshes/, transcript/, timing.json and, last, asset.json into an existing folder.

    Names of the asset, its parts and joints are made legal where necessary (`anymesh.names.legal_names`). The same asset gives
    the same bytes, except for timing.json.

    hulls: maximum number of collision shapes per link; cache: folder for convex decompositions.
    """
    config = config if hulls is None else replace(config, collision=replace(config.collision, hulls=hulls))
    model = build_model(asset, base=base, driven=driven, config=config, cache=cache, deadline=deadline)
    write_meshes(model, folder, config)
    write_formats(model, folder, formats, config)
    if asset.exchanges:
        resolve(WRITE_TRANSCRIPT)(asset.exchanges, folder / TRANSCRIPT)
    texts = {
        TIMING_FILE: json_text({stage: round(float(seconds), 4) for stage, seconds in asset.timing.items()}),
        "asset.json": json_text(asset_record(model, formats)),
    }
    for name, text in texts.items():
        (folder / name).write_text(text, encoding="utf-8", newline="\n")
    return model
