"""Export of an asset to files: URDF, MJCF, USD, SDFormat, animated GLB, meshes, asset.json."""

from __future__ import annotations

from pathlib import Path

from anymesh.entry_points import WRITE_DAE, WRITE_TRANSCRIPT, resolve
from anymesh.export.asset_json import TIMING_FILE, asset_record, json_text
from anymesh.export.formats import load_libraries, write_formats
from anymesh.export.meshes import write_meshes
from anymesh.export.model import ExportConfig, Model, build_model
from anymesh.export.options import Base, Driven, ExportOptions, Format, Visuals, parse_formats
from anymesh.runtime import Deadline
from anymesh.types import Asset

TRANSCRIPT = "transcript"  # folder of the questions and answers, browsable and replayable

__all__ = ["Base", "Driven", "ExportConfig", "ExportOptions", "Format", "load_libraries", "parse_formats", "write_asset"]


def write_asset(
    asset: Asset,
    folder: Path,
    how: ExportOptions = ExportOptions(),  # noqa: B008 - frozen
    *,
    config: ExportConfig = ExportConfig(),  # noqa: B008 - frozen
    cache: Path | None = None,
    deadline: Deadline | None = None,
) -> Model:
    """Write each format, meshes/, transcript/, timing.json and, last, asset.json into an existing folder.

    Names of the asset, its parts and joints are made legal where necessary (`anymesh.names.legal_names`). The same asset gives
    the same bytes, except for timing.json.

    cache: folder for convex decompositions.
    """
    model = build_model(how.written(asset), how, config=config, cache=cache, deadline=deadline)
    write_meshes(model, folder, config)
    if how.visuals is Visuals.DAE:
        resolve(WRITE_DAE)(model, folder, config)
    write_formats(model, folder, how.formats, config)
    if asset.exchanges:
        resolve(WRITE_TRANSCRIPT)(asset.exchanges, folder / TRANSCRIPT)
    texts = {
        TIMING_FILE: json_text({stage: round(float(seconds), 4) for stage, seconds in asset.timing.items()}),
        "asset.json": json_text(asset_record(model)),
    }
    for name, text in texts.items():
        (folder / name).write_text(text, encoding="utf-8", newline="\n")
    return model
