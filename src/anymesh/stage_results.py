"""What each stage hands to the next, and how it is taken apart into JSON values and arrays and put together again."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass, fields
from typing import Any, Generic, TypeVar

import numpy as np

from anymesh.types import Joint, JointType, Material, Mesh, Node, Part, Segmentation, Source, Texture

Result = TypeVar("Result")
Arrays = Mapping[str, np.ndarray]
Record = dict[str, Any]


@dataclass(frozen=True, eq=False)
class Placed:
    """The mesh in the asset frame, the file that it came from, and what a user should know."""

    mesh: Mesh
    source: Source
    warnings: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False)
class Segmented:
    """Stage A: the parts, who answered, and what a user should know."""

    segmentation: Segmentation
    answerer: str
    warnings: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False)
class Jointed:
    """Stage B: the joints, who answered, and what a user should know."""

    joints: tuple[Joint, ...]
    answerer: str
    warnings: tuple[str, ...] = ()


@dataclass(frozen=True)
class Stage(Generic[Result]):
    """A stage whose result can be saved: its name, and the two ways."""

    name: str
    pack: Callable[[Result], tuple[Record, dict[str, np.ndarray]]]
    unpack: Callable[[Record, Arrays], Result]


MESH_ARRAYS = ("vertices", "faces", "face_node", "face_material", "corner_uv", "corner_color", "corner_normal")


def _pack_mesh(result: Placed) -> tuple[Record, dict[str, np.ndarray]]:
    mesh, source = result.mesh, result.source
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
    record = {
        "nodes": [asdict(node) for node in mesh.nodes],
        "materials": materials,
        "source": {
            "path": source.path,
            "sha256": source.sha256,
            "T_asset_source": source.T_asset_source.tolist(),
            "up": source.up,
            "notes": list(source.notes),
        },
        "warnings": list(result.warnings),
    }
    return record, arrays


def _unpack_mesh(record: Record, arrays: Arrays) -> Placed:
    def material(found: Record) -> Material:
        textures = {slot: Texture(arrays[t["array"]].tobytes(), t["mime"], t["name"]) for slot, t in found["textures"].items()}
        values: dict[str, Any] = {**found, "textures": textures}
        values["base_color"], values["emissive"] = tuple(found["base_color"]), tuple(found["emissive"])
        return Material(**values)

    found: dict[str, Any] = {name: arrays.get(name) for name in MESH_ARRAYS}
    mesh = Mesh(
        **found,
        nodes=tuple(Node(**node) for node in record["nodes"]),
        materials=tuple(material(m) for m in record["materials"]),
    )
    s = record["source"]
    source = Source(s["path"], s["sha256"], np.array(s["T_asset_source"]), s["up"], tuple(s["notes"]))
    return Placed(mesh, source, tuple(record["warnings"]))


def _pack_segmentation(result: Segmented) -> tuple[Record, dict[str, np.ndarray]]:
    record = {
        "parts": [asdict(part) for part in result.segmentation.parts],
        "answerer": result.answerer,
        "warnings": list(result.warnings),
    }
    return record, {"face_part": result.segmentation.face_part}


def _unpack_segmentation(record: Record, arrays: Arrays) -> Segmented:
    segmentation = Segmentation(arrays["face_part"], tuple(Part(**part) for part in record["parts"]))
    return Segmented(segmentation, record["answerer"], tuple(record["warnings"]))


def _pack_joints(result: Jointed) -> tuple[Record, dict[str, np.ndarray]]:
    joints = []
    for joint in result.joints:
        record = {f.name: getattr(joint, f.name) for f in fields(joint)}
        record |= {"type": str(joint.type), "origin": joint.origin.tolist(), "axis": joint.axis.tolist()}
        joints.append(record)
    return {"joints": joints, "answerer": result.answerer, "warnings": list(result.warnings)}, {}


def _unpack_joints(record: Record, arrays: Arrays) -> Jointed:
    def joint(found: Record) -> Joint:
        limits = None if found["limits"] is None else (float(found["limits"][0]), float(found["limits"][1]))
        values: dict[str, Any] = {**found, "type": JointType(found["type"]), "limits": limits}
        values["origin"], values["axis"] = np.array(found["origin"], float), np.array(found["axis"], float)
        return Joint(**values)

    return Jointed(tuple(joint(j) for j in record["joints"]), record["answerer"], tuple(record["warnings"]))


MESH = Stage("mesh", _pack_mesh, _unpack_mesh)
SEGMENTATION = Stage("segmentation", _pack_segmentation, _unpack_segmentation)
JOINTS = Stage("joints", _pack_joints, _unpack_joints)
STAGES = (MESH, SEGMENTATION, JOINTS)
