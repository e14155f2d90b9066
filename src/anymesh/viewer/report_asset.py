"""Assets of a report: their reading from a folder, their reduction for display, and the data of their part of the page.

Of a folder, asset.json, the GLB and the transcript are read; saved stages are not needed.
"""

from __future__ import annotations

import gzip
import hashlib
import io
import json
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import Float
from PIL import Image

from anymesh.errors import InputError
from anymesh.export import Format
from anymesh.export.flat_looks import with_materials
from anymesh.export.formats import main_file
from anymesh.export.glb import glb_bytes
from anymesh.export.links import split_links, with_legal_names
from anymesh.export.model import ExportConfig
from anymesh.geometry.distance_ import distance_to_mesh
from anymesh.geometry.simplify_ import simplify
from anymesh.loading import load_mesh
from anymesh.rendering.render import face_colors
from anymesh.types import (
    Asset,
    Brief,
    Exchange,
    Joint,
    JointType,
    Loop,
    Material,
    Mesh,
    Mimic,
    Part,
    Picture,
    ProposedJoint,
    Segmentation,
    Source,
    Texture,
)
from anymesh.types.motion import with_implied_limits
from anymesh.types.triangles import normals_and_areas
from anymesh.viewer.scene import GripperMark, read_grippers, report_scene

PREVIEW = "preview.png"
THUMBNAIL = (240, 180)  # [px]
WIDTH, QUALITY = 1280, 82  # [px] width of the preview, and its JPEG quality
ASKED_WIDTH, ASKED_QUALITY = 800, 75  # of the pictures shown to a model
RECORD = "asset.json"
TRANSCRIPT = "transcript"
ASKED = re.compile(r"\d{3,}_[a-z0-9-]+\.json")
DRAWN = re.compile(r"[0-9a-f]{64}\.png")
WORDS = ("kind", "key", "model", "text", "answer", "verdict")
FROM_Y_UP = np.array([[1, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0], [0, 0, 0, 1.0]])  # glTF has Y up, an asset Z
FACES = 60_000  # number of faces above which an asset is decimated: about a megabyte of the page
PIXELS = 1024  # longest side of a texture
COARSE = 4  # multiple of the wanted faces that the clustering keeps for the exact decimation
FINEST = 1e-5  # minimum cell size of the clustering, as a share of the part's longest side, to limit the number of cells
MIN_PART_FACES = 200  # minimum number of faces of a part
FORMATS = {"image/png": "PNG", "image/jpeg": "JPEG"}
COATED = Material("display", (1.0, 1.0, 1.0, 1.0), double_sided=True)  # used with vertex colours


def find_assets(folder: Path) -> list[Path]:
    """Return the folder itself if it is an asset's, else all asset folders below it, in order of their paths.

    Hidden folders are skipped. Raise InputError if there is none.
    """
    if (folder / RECORD).is_file():
        return [folder]
    folders = sorted({path.parent for path in folder.glob(f"**/{RECORD}") if path.is_file()})
    shown = [path for path in folders if not any(part.startswith(".") for part in path.relative_to(folder).parts)]
    if not shown:
        raise InputError(f"{folder} holds no {RECORD}; valid is a folder that `anymesh articulate` made, or a folder of such")
    return shown


def glb_path(folder: Path) -> Path:
    """Return the path of an asset's GLB. Raise InputError if it has none."""
    named = main_file(Format.GLB, str(_record(folder).get("name")))
    if Path(named).name != named or not (folder / named).is_file():
        raise InputError(f"{folder} has no GLB; `anymesh export {folder} --formats glb` writes one")
    return folder / named


def read_asset(folder: Path) -> Asset:
    """Read the asset of a folder. Raise InputError if it is not an asset, or if asset.json and the GLB do not match."""
    record = _record(folder)
    mesh = load_mesh(glb_path(folder)).mesh.transformed(FROM_Y_UP)
    try:
        parts = tuple(Part(p["name"], p["label"], p["confidence"], p["reason"]) for p in record["parts"])
        source = record["source"]
        T = np.array(source["T_asset_source"], float)
        return Asset(
            name=record["name"],
            source=Source(source["path"], source["sha256"], T, source["up"], tuple(source["notes"]), source.get("credits", {})),
            mesh=mesh,
            segmentation=Segmentation(_face_part(mesh, parts), parts),
            joints=with_implied_limits([_joint(joint) for joint in record["joints"]]),
            answerer=record["answerer"],
            warnings=tuple(map(str, record["warnings"])),
            exchanges=read_transcript(folder / TRANSCRIPT),
            notes=tuple(map(str, record.get("finish", ()))),  # since schema 1.2
            loops=tuple(map(_loop, record.get("loops", ()))),
            proposals=tuple(_proposal(p) for p in record.get("proposals", ())),  # since schema 1.4
        )
    except (KeyError, TypeError, ValueError, AttributeError) as error:
        raise InputError(f"{folder / RECORD} is not what anymesh writes: {type(error).__name__}: {error}") from error


def read_transcript(folder: Path) -> tuple[Exchange, ...]:
    """Read the questions and answers of a transcript, in order; unreadable ones are left out."""
    if not folder.is_dir():
        return ()
    exchanges = (_exchange(folder, path) for path in sorted(folder.iterdir()) if ASKED.fullmatch(path.name))
    return tuple(exchange for exchange in exchanges if exchange is not None)


def _record(folder: Path) -> Mapping[str, Any]:
    try:
        record = json.loads((folder / RECORD).read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError) as error:
        raise InputError(f"{folder / RECORD} cannot be read: {error}") from error
    if not isinstance(record, dict):
        raise InputError(f"{folder / RECORD} is not what anymesh writes: found a {type(record).__name__}")
    return record


def _face_part(mesh: Mesh, parts: Sequence[Part]) -> np.ndarray:
    """Return the part of each face; each link is a node with its name."""
    number = {part.name: k for k, part in enumerate(parts)}
    unknown = [node.name for node in mesh.nodes if node.name not in number]
    if unknown:
        raise ValueError(f"the GLB has nodes {unknown[:5]} that are not parts; parts are {list(number)[:20]}")
    return np.array([number[node.name] for node in mesh.nodes])[mesh.face_node]


def _joint(record: Mapping[str, Any]) -> Joint:
    axis, limits, mimic = np.array(record["axis"], float), record["limits"], record.get("mimic")
    names = record["name"], JointType(record["type"]), record["parent"], record["child"]
    ends = None if limits is None else (float(limits[0]), float(limits[1]))
    motion = np.array(record["origin"], float), axis / np.linalg.norm(axis), ends
    led, pitch = None if mimic is None else Mimic(**mimic), float(record.get("pitch", 0.0))
    return Joint(*names, *motion, record["confidence"], record["reason"], mimic=led, pitch=pitch)


def _loop(record: Mapping[str, Any]) -> Loop:
    origin, axis = (np.array(record[key], float) for key in ("origin", "axis"))
    return Loop(record["name"], *record["links"], origin, axis / np.linalg.norm(axis), JointType(record["type"]))


def _proposal(record: Mapping[str, Any]) -> ProposedJoint:
    part = Part(record["child"], record["label"], record["part_confidence"], record["part_reason"])
    return ProposedJoint(part, _joint(record), float(record["probability"]), str(record["motion"]), np.zeros(0, int))


def _exchange(folder: Path, path: Path) -> Exchange | None:
    try:
        record: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
        if not all(isinstance(record[word], str) for word in WORDS):
            return None
        record["pictures"] = tuple(
            Picture((folder / drawn["file"]).read_bytes(), str(drawn["caption"]))
            for drawn in record["pictures"]
            if DRAWN.fullmatch(drawn["file"]) and (folder / drawn["file"]).is_file()
        )
        return Exchange(**record)
    except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError):
        return None


def displayed(asset: Asset, *, faces: int = FACES, pixels: int = PIXELS) -> tuple[Asset, tuple[str, ...]]:
    """Reduce the asset to about `faces` faces and textures of at most `pixels`; also return notes, () if unchanged.

    Parts, joints and names are unchanged. Decimated parts lose their textures; vertices have the colours instead.
    """
    count = len(asset.mesh.faces)
    if count > faces:
        asset = _decimated(asset, faces)
        return asset, (f"Decimated for display: {len(asset.mesh.faces):,} of {count:,} faces. The files are unchanged.",)
    largest, materials = 0, []
    for material in asset.mesh.materials:
        textures = {slot: _smaller(texture, pixels) for slot, texture in material.textures.items()}
        largest = max([largest, *(size for _, size in textures.values())])
        materials.append(replace(material, textures={slot: texture for slot, (texture, _) in textures.items()}))
    if largest <= pixels:
        return asset, ()
    note = f"Textures shrunk for display: from up to {largest} to {pixels} pixels. The files are unchanged."
    return replace(asset, mesh=replace(asset.mesh, materials=tuple(materials))), (note,)


def display_glb(asset: Asset) -> bytes:
    """Return the GLB of an asset with legal names."""
    asset = replace(asset, mesh=with_materials(asset.mesh))
    return glb_bytes(asset, split_links(asset), ExportConfig())


def _decimated(asset: Asset, faces: int) -> Asset:
    mesh, part_of = asset.mesh, asset.segmentation.face_part
    pieces = []
    for part in range(len(asset.segmentation.parts)):
        mine = mesh.triangles[part_of == part]
        most = max(MIN_PART_FACES, faces * len(mine) // len(mesh.faces))
        pieces.append(simplify(_clustered(mine, COARSE * most), most))
    triangles = np.concatenate(pieces)
    part = np.repeat(np.arange(len(pieces)), [len(piece) for piece in pieces])
    nearest = distance_to_mesh(triangles.reshape(-1, 3), mesh.vertices, mesh.faces)[1]
    colors = np.full((len(nearest), 4), 255, np.uint8)
    colors[:, :3] = face_colors(mesh)[nearest]
    light = Mesh(
        vertices=triangles.reshape(-1, 3),
        faces=np.arange(3 * len(triangles)).reshape(-1, 3),
        face_node=np.zeros(len(triangles), int),
        nodes=mesh.nodes[:1],
        face_material=np.zeros(len(triangles), int),
        materials=(COATED,),
        corner_color=colors.reshape(-1, 3, 4),
    )
    return replace(asset, mesh=light, segmentation=Segmentation(part, asset.segmentation.parts), source_face=None)


def _clustered(triangles: Float[np.ndarray, "F 3 3"], most: int) -> Float[np.ndarray, "R 3 3"]:
    """Merge the corners in each cell of a grid, for about `most` triangles if the surface has more.

    This is inexact, but ten times as fast as edge collapses, which take half a minute for a million faces.
    """
    if len(triangles) <= most:
        return triangles
    corners = triangles.reshape(-1, 3)
    cell = float(np.sqrt(2 * normals_and_areas(triangles)[1].sum() / most))  # two triangles per cell of the surface
    cell = max(cell, FINEST * float(np.ptp(corners, axis=0).max()))
    if not cell > 0:
        return triangles
    grid = np.floor((corners - corners.min(0)) / cell).astype(np.int64)
    key = np.ravel_multi_index(tuple(grid.T), tuple(grid.max(0) + 1))
    number, count = np.unique(key, return_inverse=True, return_counts=True)[1:]
    middle = np.stack([np.bincount(number, column) for column in corners.T], 1) / count[:, None]
    faces = number.reshape(-1, 3)
    faces = faces[(faces != np.roll(faces, 1, axis=1)).all(1)]
    first = np.unique(np.sort(faces, 1), axis=0, return_index=True)[1]
    return middle[faces[np.sort(first)]] if len(first) else triangles


def _smaller(texture: Texture, pixels: int) -> tuple[Texture, int]:
    """Return the reduced texture, and its original longest side [px]; an unreadable one is unchanged."""
    try:
        with Image.open(io.BytesIO(texture.data)) as image:
            longest = max(image.size)
            if longest <= pixels or texture.mime not in FORMATS:
                return texture, longest
            scale = pixels / longest
            small = image.resize([max(1, round(scale * side)) for side in image.size], Image.Resampling.LANCZOS)
            buffer = io.BytesIO()
            small.save(buffer, FORMATS[texture.mime])
    except (OSError, ValueError, Image.DecompressionBombError):
        return texture, 0
    return replace(texture, data=buffer.getvalue()), longest


def jpeg(picture: bytes, width: int, quality: int) -> bytes:
    """Convert a picture file to JPEG of at most this width; transparent pixels become white."""
    with Image.open(io.BytesIO(picture)) as image:
        flat = Image.new("RGB", image.size, (255, 255, 255))
        flat.paste(image, mask=image.getchannel("A") if image.mode in ("RGBA", "LA") else None)
    flat.thumbnail((width, 4 * width), Image.Resampling.LANCZOS)
    buffer = io.BytesIO()
    flat.save(buffer, "JPEG", quality=quality)
    return buffer.getvalue()


def materials_shown(materials: tuple[Material, ...], colors: np.ndarray | None) -> bool:
    """Return whether the materials have visible colours or textures."""
    return colors is not None or any(_has_look(m.textures, m.base_color) for m in materials)


def _has_look(textures: Mapping[str, Texture], base: tuple[float, ...]) -> bool:
    return bool(textures) or max(base[:3]) - min(base[:3]) > 0.02


@dataclass(frozen=True, eq=False)
class ReportEntry(Brief):
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
    return _entry(title, asset, shown, glb, notes, _preview(folder / PREVIEW), read_grippers(folder, asset))


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


def _entry(
    title: str, asset: Asset, shown: Asset, glb: bytes, notes: tuple[str, ...], preview: bytes,
    grippers: tuple[GripperMark, ...] = (),
) -> ReportEntry:  # fmt: skip
    mesh = asset.mesh
    return ReportEntry(
        title=title,
        asset=asset,
        scene=report_scene(shown, looks=materials_shown(mesh.materials, mesh.corner_color), grippers=grippers),
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


def thumbnail(preview: bytes) -> bytes:
    """Return the last panel of a preview, the object opened with coloured parts, as a small JPEG."""
    with Image.open(io.BytesIO(preview)) as image:
        width, height = image.size
        panel = image.convert("RGB").crop((2 * width // 3, 0, width, height))
    panel.thumbnail(THUMBNAIL)
    panel.save(buffer := io.BytesIO(), "JPEG", quality=QUALITY)
    return buffer.getvalue()


def _preview(path: Path) -> bytes:
    return _jpeg(path.read_bytes(), WIDTH, QUALITY) if path.is_file() else b""


def _jpeg(picture: bytes, width: int, quality: int) -> bytes:
    """Convert a picture to JPEG; empty if it is not a picture."""
    try:
        return jpeg(picture, width, quality)
    except (OSError, ValueError, SyntaxError):
        return b""
