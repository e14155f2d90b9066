"""Conversion of the results of stages to JSON values and arrays, and back."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass, fields
from typing import Any, Generic, TypeVar

import numpy as np

from anymesh.pipeline.results import (
    CompletionResult,
    CorrectionResult,
    JointResult,
    LoadResult,
    RecognitionResult,
    Record,
    SegmentationResult,
)
from anymesh.types import Exchange, Joint, JointType, Material, Mesh, Node, Part, Picture, Segmentation, Source, Texture
from anymesh.types.motion import Recognition, RecognizedLabel

Result = TypeVar("Result")
Arrays = Mapping[str, np.ndarray]


@dataclass(frozen=True)
class Stage(Generic[Result]):
    """A stage with a saved result: its name, and the functions that pack and unpack the result."""

    name: str
    pack: Callable[[Result], tuple[Record, dict[str, np.ndarray]]]
    unpack: Callable[[Record, Arrays], Result]


MESH_ARRAYS = ("vertices", "faces", "face_node", "face_material", "corner_uv", "corner_color", "corner_normal")


def _pack_load(result: LoadResult) -> tuple[Record, dict[str, np.ndarray]]:
    source = result.source
    record, arrays = _pack_mesh(result.mesh)
    record |= {
        "source": {
            "path": source.path,
            "sha256": source.sha256,
            "T_asset_source": source.T_asset_source.tolist(),
            "up": source.up,
            "notes": list(source.notes),
        },
        "warnings": list(result.warnings),
        "metric": result.metric,
    }
    return record, arrays


def _pack_mesh(mesh: Mesh) -> tuple[Record, dict[str, np.ndarray]]:
    """Pack nodes and materials, and the arrays of a mesh with its images."""
    arrays = {name: getattr(mesh, name) for name in MESH_ARRAYS if getattr(mesh, name) is not None}
    images: dict[bytes, str] = {}
    materials = []
    for material in mesh.materials:
        record = {f.name: getattr(material, f.name) for f in fields(material) if f.name != "textures"}
        record["textures"] = {}
        for slot, texture in material.textures.items():
            key = images.setdefault(texture.data, f"image_{len(images)}")
            record["textures"][slot] = {"array": key, "mime": texture.mime, "name": texture.name}
        materials.append(record)
    arrays |= {key: np.frombuffer(data, np.uint8) for data, key in images.items()}
    return {"nodes": [asdict(node) for node in mesh.nodes], "materials": materials}, arrays


def _unpack_load(record: Record, arrays: Arrays) -> LoadResult:
    s = record["source"]
    source = Source(s["path"], s["sha256"], np.array(s["T_asset_source"]), s["up"], tuple(s["notes"]))
    return LoadResult(_unpack_mesh(record, arrays), source, tuple(record["warnings"]), record.get("metric", False))


def _unpack_mesh(record: Record, arrays: Arrays) -> Mesh:
    def material(material_record: Record) -> Material:
        textures = {
            slot: Texture(arrays[t["array"]].tobytes(), t["mime"], t["name"]) for slot, t in material_record["textures"].items()
        }
        values: dict[str, Any] = {**material_record, "textures": textures}
        values["base_color"], values["emissive"] = tuple(material_record["base_color"]), tuple(material_record["emissive"])
        return Material(**values)

    mesh_arrays: dict[str, Any] = {name: arrays.get(name) for name in MESH_ARRAYS}
    return Mesh(
        **mesh_arrays,
        nodes=tuple(Node(**node) for node in record["nodes"]),
        materials=tuple(material(m) for m in record["materials"]),
    )


def _pack_exchanges(exchanges: tuple[Exchange, ...]) -> tuple[list[Record], dict[str, np.ndarray]]:
    """Pack exchanges; a picture that was shown twice is stored once."""
    names: dict[bytes, str] = {}
    records = []
    for exchange in exchanges:
        record: Record = {f.name: getattr(exchange, f.name) for f in fields(exchange)}
        record["pictures"] = [[names.setdefault(p.png, f"picture_{len(names)}"), p.caption] for p in exchange.pictures]
        records.append(record)
    return records, {name: np.frombuffer(png, np.uint8) for png, name in names.items()}


def _unpack_exchanges(records: list[Record], arrays: Arrays) -> tuple[Exchange, ...]:
    def exchange(record: Record) -> Exchange:
        pictures = tuple(Picture(arrays[name].tobytes(), caption) for name, caption in record["pictures"])
        values: dict[str, Any] = {**record, "pictures": pictures}
        return Exchange(**values)

    return tuple(exchange(record) for record in records)


def _pack_recognition(result: RecognitionResult) -> tuple[Record, dict[str, np.ndarray]]:
    exchanges, arrays = _pack_exchanges(result.exchanges)
    record = {
        "recognition": None if result.recognition is None else asdict(result.recognition),
        "answerer": result.answerer,
        "scale": result.scale,
        "note": result.note,
        "warnings": list(result.warnings),
        "exchanges": exchanges,
    }
    return record, arrays


def _unpack_recognition(record: Record, arrays: Arrays) -> RecognitionResult:
    def label(label_record: Record) -> RecognizedLabel:
        limits = (
            None if label_record["limits"] is None else (float(label_record["limits"][0]), float(label_record["limits"][1]))
        )
        moves = None if label_record["moves"] is None else JointType(label_record["moves"])
        return RecognizedLabel(label_record["label"], moves, label_record["parent"], limits)

    r = record["recognition"]
    recognition = None
    if r is not None:
        labels = tuple(label(label_record) for label_record in r["labels"])
        recognition = Recognition(r["category"], r["size"], labels, r.get("front"))
    exchanges = _unpack_exchanges(record["exchanges"], arrays)
    return RecognitionResult(
        recognition, record["answerer"], record["scale"], record["note"], tuple(record["warnings"]), exchanges
    )


def _pack_segmentation(result: SegmentationResult) -> tuple[Record, dict[str, np.ndarray]]:
    exchanges, arrays = _pack_exchanges(result.exchanges)
    record = {
        "parts": [asdict(part) for part in result.segmentation.parts],
        "answerer": result.answerer,
        "warnings": list(result.warnings),
        "exchanges": exchanges,
    }
    return record, {**arrays, "face_part": result.segmentation.face_part}


def _unpack_segmentation(record: Record, arrays: Arrays) -> SegmentationResult:
    segmentation = Segmentation(arrays["face_part"], tuple(Part(**part) for part in record["parts"]))
    exchanges = _unpack_exchanges(record["exchanges"], arrays)
    return SegmentationResult(segmentation, record["answerer"], tuple(record["warnings"]), exchanges)


def _pack_joint(joint: Joint) -> Record:
    record = {f.name: getattr(joint, f.name) for f in fields(joint)}
    return record | {"type": str(joint.type), "origin": joint.origin.tolist(), "axis": joint.axis.tolist()}


def _unpack_joint(record: Record) -> Joint:
    limits = None if record["limits"] is None else (float(record["limits"][0]), float(record["limits"][1]))
    values: dict[str, Any] = {**record, "type": JointType(record["type"]), "limits": limits}
    values["origin"], values["axis"] = np.array(record["origin"], float), np.array(record["axis"], float)
    return Joint(**values)


def _pack_joints(result: JointResult) -> tuple[Record, dict[str, np.ndarray]]:
    joints = [_pack_joint(joint) for joint in result.joints]
    exchanges, arrays = _pack_exchanges(result.exchanges)
    record = {"joints": joints, "answerer": result.answerer, "warnings": list(result.warnings), "exchanges": exchanges}
    return record, arrays


def _unpack_joints(record: Record, arrays: Arrays) -> JointResult:
    joints = tuple(_unpack_joint(j) for j in record["joints"])
    return JointResult(joints, record["answerer"], tuple(record["warnings"]), _unpack_exchanges(record["exchanges"], arrays))


def _pack_completed(result: CompletionResult) -> tuple[Record, dict[str, np.ndarray]]:
    record, arrays = _pack_mesh(result.mesh)
    return {**record, "notes": list(result.notes)}, {
        **arrays,
        "face_part": result.face_part,
        "source_face": result.source_face,
    }


def _unpack_completed(record: Record, arrays: Arrays) -> CompletionResult:
    return CompletionResult(_unpack_mesh(record, arrays), arrays["face_part"], arrays["source_face"], tuple(record["notes"]))


def _pack_corrected(result: CorrectionResult) -> tuple[Record, dict[str, np.ndarray]]:
    record = {
        "parts": [asdict(part) for part in result.segmentation.parts],
        "joints": [_pack_joint(joint) for joint in result.joints],
        "warnings": list(result.warnings),
        "log": list(result.log),
    }
    return record, {"face_part": result.segmentation.face_part}


def _unpack_corrected(record: Record, arrays: Arrays) -> CorrectionResult:
    segmentation = Segmentation(arrays["face_part"], tuple(Part(**part) for part in record["parts"]))
    joints = tuple(_unpack_joint(j) for j in record["joints"])
    return CorrectionResult(segmentation, joints, tuple(record["warnings"]), tuple(record["log"]))


MESH = Stage("mesh", _pack_load, _unpack_load)
RECOGNITION = Stage("recognition", _pack_recognition, _unpack_recognition)
SEGMENTATION = Stage("segmentation", _pack_segmentation, _unpack_segmentation)
JOINTS = Stage("joints", _pack_joints, _unpack_joints)
CORRECTION = Stage("correction", _pack_corrected, _unpack_corrected)  # manual correction of Stage B's result
COMPLETION = Stage("completion", _pack_completed, _unpack_completed)
REVISION = Stage("revision", _pack_corrected, _unpack_corrected)  # manual correction of Stage C's result
STAGES = (MESH, RECOGNITION, SEGMENTATION, JOINTS, CORRECTION, COMPLETION, REVISION)
