"""Asset to files: URDF, animated GLB, meshes, asset.json."""

from __future__ import annotations

from pathlib import Path

from anymesh.export.asset_json import TIMING_FILE, asset_record, json_text
from anymesh.export.glb import glb_bytes
from anymesh.export.inertia import link_inertia
from anymesh.export.links import split_links, with_legal_names
from anymesh.export.meshes import write_meshes
from anymesh.export.settings import ExportConfig
from anymesh.export.urdf import urdf_text
from anymesh.models.transcript import write_transcript
from anymesh.types import Asset

TRANSCRIPT = "transcript"  # folder of what was asked and answered, browsable and replayable

__all__ = ["ExportConfig", "write_asset"]


def write_asset(asset: Asset, folder: Path, *, config: ExportConfig = ExportConfig()) -> None:  # noqa: B008 - frozen
    """Writes <name>.urdf, <name>.glb, meshes/, transcript/, timing.json and, last, asset.json into an existing folder.

    Names of the asset, its parts and joints are made legal where they are not (`anymesh.names.legal_names`).
    The same asset gives the same bytes, but for timing.json.
    """
    asset = with_legal_names(asset)
    links = split_links(asset)
    inertias = {link.name: link_inertia(link.triangles, config) for link in links}
    write_meshes(asset.mesh, links, folder, config)
    if asset.exchanges:
        write_transcript(asset.exchanges, folder / TRANSCRIPT)
    (folder / f"{asset.name}.glb").write_bytes(glb_bytes(asset, links, config))
    texts = {
        f"{asset.name}.urdf": urdf_text(asset, links, inertias),
        TIMING_FILE: json_text({stage: round(float(seconds), 4) for stage, seconds in asset.timing.items()}),
        "asset.json": json_text(asset_record(asset, links, inertias)),
    }
    for name, text in texts.items():
        (folder / name).write_text(text, encoding="utf-8", newline="\n")
