"""One asset of a report: its texts, and the data of its 3D view."""

from __future__ import annotations

import gzip
import hashlib
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from anymesh.errors import InputError
from anymesh.export.links import with_legal_names
from anymesh.types import Asset
from anymesh.viewer.report_asset import glb_path, read_asset
from anymesh.viewer.report_display import display_glb, displayed, jpeg, materials_shown
from anymesh.viewer.report_scene import scene

PREVIEW = "preview.png"
WIDTH, QUALITY = 1280, 82  # [px] width of the preview, and its JPEG quality
ASKED_WIDTH, ASKED_QUALITY = 800, 75  # of the pictures shown to a model


@dataclass(frozen=True, eq=False)
class ReportEntry:
    """An asset of a report. title: its location; glb: gzipped; pictures: those shown to a model, as JPEG by SHA-256."""

    title: str
    asset: Asset | None  # None if it cannot be read
    problem: str = ""  # the reason
    scene: Mapping[str, Any] | None = None
    glb: bytes = b""
    preview: bytes = b""  # JPEG
    pictures: Mapping[str, bytes] = field(default_factory=dict)
    notes: tuple[str, ...] = ()  # reductions for display

    @property
    def least(self) -> float:
        """The lowest confidence of a joint; 1 if nothing moves."""
        return min((j.confidence for j in self.asset.joints), default=1.0) if self.asset else 0.0

    @property
    def size(self) -> int:
        """Approximate bytes of this asset in the page: base64 makes 4 of 3."""
        return (len(self.glb) + len(self.preview) + sum(map(len, self.pictures.values()))) * 4 // 3


def folder_entry(folder: Path, title: str, *, faces: int) -> ReportEntry:
    """Return the entry of an asset's folder; if it cannot be read, the entry states the reason."""
    try:
        asset = read_asset(folder)
    except InputError as error:
        return ReportEntry(title, None, problem=str(error))
    shown, notes = displayed(asset, faces=faces)
    glb = display_glb(shown) if notes else glb_path(folder).read_bytes()
    return _entry(title, asset, shown, glb, notes, _preview(folder / PREVIEW))


def asset_entry(asset: Asset, *, faces: int) -> ReportEntry:
    """Return the entry of an asset in memory, without a preview, which would take longest."""
    asset = with_legal_names(asset)
    shown, notes = displayed(asset, faces=faces)
    return _entry(asset.name, asset, shown, display_glb(shown), notes, b"")


def within(entries: list[ReportEntry], megabytes: float) -> list[ReportEntry]:
    """Limit the size of the page, leaving out pictures of questions first, then 3D views."""
    left = int(min(megabytes, 1e6) * 1e6) - sum(len(e.preview) * 4 // 3 for e in entries)
    limited_entries = []
    for entry in entries:
        notes = entry.notes
        if entry.glb and len(entry.glb) * 4 // 3 > left:
            entry = replace(entry, glb=b"", notes=(*notes, f"No 3D view: the page is limited to {megabytes:g} MB."))
        left -= len(entry.glb) * 4 // 3
        limited_entries.append(entry)
    for k, entry in enumerate(limited_entries):
        taken = sum(map(len, entry.pictures.values())) * 4 // 3
        if taken > left:
            note = f"Pictures of the questions are left out: the page is limited to {megabytes:g} MB."
            limited_entries[k] = replace(entry, pictures={}, notes=(*entry.notes, note))
        else:
            left -= taken
    return limited_entries


def picture_key(png: bytes) -> str:
    """Return the key of a picture that was shown to a model."""
    return hashlib.sha256(png).hexdigest()[:16]


def _entry(title: str, asset: Asset, shown: Asset, glb: bytes, notes: tuple[str, ...], preview: bytes) -> ReportEntry:
    mesh = asset.mesh
    return ReportEntry(
        title=title,
        asset=asset,
        scene=scene(shown, looks=materials_shown(mesh.materials, mesh.corner_color)),
        glb=gzip.compress(glb, 6, mtime=0),
        preview=preview,
        pictures=_pictures(asset),
        notes=notes,
    )


def _pictures(asset: Asset) -> dict[str, bytes]:
    pictures: dict[str, bytes] = {}
    for picture in (p for e in asset.exchanges for p in e.pictures):
        key = picture_key(picture.png)
        if key not in pictures:
            pictures[key] = _jpeg(picture.png, ASKED_WIDTH, ASKED_QUALITY)
    return {key: data for key, data in pictures.items() if data}


def _preview(path: Path) -> bytes:
    return _jpeg(path.read_bytes(), WIDTH, QUALITY) if path.is_file() else b""


def _jpeg(picture: bytes, width: int, quality: int) -> bytes:
    """Convert a picture to JPEG; empty if it is not a picture."""
    try:
        return jpeg(picture, width, quality)
    except (OSError, ValueError, SyntaxError):
        return b""
