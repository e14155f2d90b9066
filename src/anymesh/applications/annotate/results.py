"""Columns of the ledger, read from an asset's folder."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from anymesh.runtime import read_json


def asset_columns(folder: Path) -> dict[str, Any] | None:
    """Return the columns of the ledger for a finished asset; None if there is none, or if it is incomplete."""
    asset = read_json(folder / "asset.json")
    if asset is None:
        return None
    try:
        joints = asset["joints"]
        return {
            "confidence": min((float(j["confidence"]) for j in joints), default=None),
            "parts": len(asset["parts"]) - 1,
            "joints": len(joints),
            "faces": sum(int(p["face_count"]) for p in asset["parts"]),
            "warnings": len(asset["warnings"]),
            "bytes": sum(p.lstat().st_size for p in folder.rglob("*") if p.is_file()),
            "sha256": str(asset["source"]["sha256"]),
            "stage_seconds": json.dumps(read_json(folder / str(asset["timing"])) or {}),
        }
    except (KeyError, TypeError, ValueError, OSError):
        return None
