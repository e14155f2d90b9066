"""Results of stages on disk: a JSON file with the key, and an .npz file with the arrays; and the asset that they make."""

from __future__ import annotations

import hashlib
import json
import logging
import zipfile
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass, fields, replace
from pathlib import Path
from typing import Any, Generic, TypeVar

import numpy as np

import anymesh
from anymesh.export.asset_json import source_record
from anymesh.names import legal_name
from anymesh.pipeline.results import (
    CompletionResult,
    CorrectionResult,
    JointResult,
    LoadResult,
    RecognitionResult,
    Record,
    SegmentationResult,
)
from anymesh.runtime import read_json, write_json
from anymesh.types import (
    Asset,
    Exchange,
    Joint,
    JointType,
    Loop,
    Material,
    Mesh,
    Mimic,
    Node,
    Part,
    Picture,
    Segmentation,
    Source,
    Texture,
)
from anymesh.types.mesh import REPEAT
from anymesh.types.motion import Recognition, RecognizedLabel, StatedJoint

Result = TypeVar("Result")
AnyJoint = TypeVar("AnyJoint", Joint, StatedJoint)
Arrays = Mapping[str, np.ndarray]
MESH_ARRAYS = tuple(f.name for f in fields(Mesh) if f.name not in ("nodes", "materials", "joints"))
USUAL = (("wrap", (REPEAT, REPEAT)), ("uv_set", 0), ("strength", 1.0), ("nearest", False), ("unlit", False))  # not stored
UNCOUPLED = (("pitch", 0.0), ("mimic", None), ("follows", None), ("ratio", 1.0))  # of joints, not stored
UNSAID = (("joint", -1), ("path", ()), ("pivot", None))  # of nodes, not stored
log = logging.getLogger("anymesh")
FOLDER = "stages"
UNRECOGNIZED = "object"  # category of an object that no user named
EPOCH = (1980, 1, 1, 0, 0, 0)  # date inside every archive, so that equal results are equal files


@dataclass(frozen=True)
class Stage(Generic[Result]):
    """A stage with a saved result: its name, and the functions that pack and unpack the result."""

    name: str
    pack: Callable[[Result], tuple[Record, dict[str, np.ndarray]]]
    unpack: Callable[[Record, Arrays], Result]


def _pack_load(result: LoadResult) -> tuple[Record, dict[str, np.ndarray]]:
    record, arrays = _pack_mesh(result.mesh)
    record |= {"source": source_record(result.source), "warnings": list(result.warnings)}
    return record | {"metric": result.metric, "category": result.category}, arrays


def _pack_mesh(mesh: Mesh) -> tuple[Record, dict[str, np.ndarray]]:
    """Pack nodes and materials, and the arrays of a mesh with its images."""
    arrays = {name: getattr(mesh, name) for name in MESH_ARRAYS if getattr(mesh, name) is not None}
    images: dict[bytes, str] = {}
    materials = []
    for material in mesh.materials:
        record = {k: v for k, v in vars(material).items() if k != "textures" and (k, v) not in USUAL}
        record["textures"] = {}
        for slot, texture in material.textures.items():
            key = images.setdefault(texture.data, f"image_{len(images)}")
            stored = {k: v for k, v in vars(texture).items() if k != "data" and (k, v) not in USUAL}
            record["textures"][slot] = {"array": key} | stored
        materials.append(record)
    arrays |= {key: np.frombuffer(data, np.uint8) for data, key in images.items()}
    nodes = [{k: v for k, v in asdict(node).items() if (k, v) not in UNSAID} for node in mesh.nodes]
    joints = {"joints": [_pack_joint(joint) for joint in mesh.joints]} if mesh.joints else {}
    return {"nodes": nodes, "materials": materials} | joints, arrays


def _unpack_load(record: Record, arrays: Arrays) -> LoadResult:
    s = record["source"]
    source = Source(s["path"], s["sha256"], np.array(s["T_asset_source"]), s["up"], tuple(s["notes"]), s.get("credits", {}))
    warnings, metric, category = tuple(record["warnings"]), record.get("metric", False), record.get("category", "")
    return LoadResult(_unpack_mesh(record, arrays), source, warnings, metric, category)


def _unpack_mesh(record: Record, arrays: Arrays) -> Mesh:
    def material(material_record: Record) -> Material:
        textures = {
            slot: replace(
                Texture(arrays[t["array"]].tobytes(), t["mime"]), **_tuples({k: v for k, v in t.items() if k != "array"})
            )
            for slot, t in material_record["textures"].items()
        }
        return Material(**_tuples({**material_record, "textures": textures}))

    mesh_arrays: dict[str, Any] = {name: arrays.get(name) for name in MESH_ARRAYS}
    return Mesh(
        **mesh_arrays,
        nodes=tuple(Node(**_tuples(node)) for node in record["nodes"]),
        materials=tuple(material(m) for m in record["materials"]),
        joints=tuple(_unpack_joint(StatedJoint, joint) for joint in record.get("joints", ())),
    )


def _tuples(values: Record) -> dict[str, Any]:
    return {k: tuple(v) if isinstance(v, list) else v for k, v in values.items()}


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
    recognition = None if result.recognition is None else asdict(result.recognition)
    scaled = {"answerer": result.answerer, "scale": result.scale, "note": result.note}
    return {"recognition": recognition, **scaled, "warnings": list(result.warnings), "exchanges": exchanges}, arrays


def _unpack_recognition(record: Record, arrays: Arrays) -> RecognitionResult:
    def label(stored: Record) -> RecognizedLabel:
        known: Record = {**stored, "moves": stored["moves"] and JointType(stored["moves"]), "limits": _limits(stored)}
        return RecognizedLabel(**known)

    r, recognition = record["recognition"], None
    if r is not None:
        known: Record = {**r, "labels": tuple(map(label, r["labels"]))}
        recognition = Recognition(**known)
    exchanges = _unpack_exchanges(record["exchanges"], arrays)
    return RecognitionResult(
        recognition, record["answerer"], record["scale"], record["note"], tuple(record["warnings"]), exchanges
    )


def _limits(record: Record) -> tuple[float, float] | None:
    return None if record["limits"] is None else (float(record["limits"][0]), float(record["limits"][1]))


def _pack_segmentation(result: SegmentationResult) -> tuple[Record, dict[str, np.ndarray]]:
    exchanges, arrays = _pack_exchanges(result.exchanges)
    record: Record = {"parts": [asdict(part) for part in result.segmentation.parts], "answerer": result.answerer}
    record |= {"warnings": list(result.warnings), "exchanges": exchanges}
    return record, {**arrays, "face_part": result.segmentation.face_part}


def _unpack_segmentation(record: Record, arrays: Arrays) -> SegmentationResult:
    segmentation = Segmentation(arrays["face_part"], tuple(Part(**part) for part in record["parts"]))
    exchanges = _unpack_exchanges(record["exchanges"], arrays)
    return SegmentationResult(segmentation, record["answerer"], tuple(record["warnings"]), exchanges)


def _pack_loops(loops: tuple[Loop, ...]) -> Record:
    made = [
        asdict(loop) | {"kind": str(loop.kind), "origin": loop.origin.tolist(), "axis": loop.axis.tolist()} for loop in loops
    ]
    return {"loops": made} if loops else {}


def _unpack_loops(record: Record) -> tuple[Loop, ...]:
    def loop(stored: Record) -> Loop:
        kind, origin, axis = JointType(stored["kind"]), *(np.array(stored[key], float) for key in ("origin", "axis"))
        return Loop(stored["name"], stored["first"], stored["second"], origin, axis, kind)

    return tuple(map(loop, record.get("loops", ())))


def _pack_joint(joint: Joint | StatedJoint) -> Record:
    record = {f.name: getattr(joint, f.name) for f in fields(joint) if f.name != "others"}
    record = {k: v for k, v in record.items() if (k, v) not in UNCOUPLED}
    record |= {"mimic": asdict(record["mimic"])} if "mimic" in record else {}
    others = {"others": [_pack_joint(other) for other in joint.others]} if isinstance(joint, Joint) and joint.others else {}
    return record | others | {"type": str(joint.type), "origin": joint.origin.tolist(), "axis": joint.axis.tolist()}


def _unpack_joint(kind: type[AnyJoint], record: Record) -> AnyJoint:
    known = {f.name for f in fields(kind)}  # joints had an effort and the like until 0.2
    values: dict[str, Any] = {name: value for name, value in record.items() if name in known}
    values |= {"type": JointType(record["type"]), "limits": _limits(record)}
    values["origin"], values["axis"] = np.array(record["origin"], float), np.array(record["axis"], float)
    values |= {"mimic": Mimic(**record["mimic"])} if "mimic" in record else {}
    if "others" in values:
        values["others"] = tuple(_unpack_joint(kind, other) for other in values["others"])
    return kind(**values)


def _pack_joints(result: JointResult) -> tuple[Record, dict[str, np.ndarray]]:
    joints, (exchanges, arrays) = [*map(_pack_joint, result.joints)], _pack_exchanges(result.exchanges)
    record = {"joints": joints, "answerer": result.answerer, "warnings": [*result.warnings], "exchanges": exchanges}
    return record | _pack_loops(result.loops), arrays


def _unpack_joints(record: Record, arrays: Arrays) -> JointResult:
    joints = tuple(_unpack_joint(Joint, j) for j in record["joints"])
    exchanges = _unpack_exchanges(record["exchanges"], arrays)
    return JointResult(joints, record["answerer"], tuple(record["warnings"]), exchanges, loops=_unpack_loops(record))


def _pack_completed(result: CompletionResult) -> tuple[Record, dict[str, np.ndarray]]:
    record, arrays = _pack_mesh(result.mesh)
    return {**record, "notes": list(result.notes)}, {**arrays, "face_part": result.face_part, "source_face": result.source_face}


def _unpack_completed(record: Record, arrays: Arrays) -> CompletionResult:
    return CompletionResult(_unpack_mesh(record, arrays), arrays["face_part"], arrays["source_face"], tuple(record["notes"]))


def _pack_corrected(result: CorrectionResult) -> tuple[Record, dict[str, np.ndarray]]:
    parts, joints = map(asdict, result.segmentation.parts), map(_pack_joint, result.joints)
    record = {"parts": [*parts], "joints": [*joints], "warnings": list(result.warnings), "log": list(result.log)}
    return record | _pack_loops(result.loops), {"face_part": result.segmentation.face_part}


def _unpack_corrected(record: Record, arrays: Arrays) -> CorrectionResult:
    segmentation = Segmentation(arrays["face_part"], tuple(Part(**part) for part in record["parts"]))
    joints = tuple(_unpack_joint(Joint, j) for j in record["joints"])
    return CorrectionResult(segmentation, joints, tuple(record["warnings"]), tuple(record["log"]), _unpack_loops(record))


MESH = Stage("mesh", _pack_load, _unpack_load)
RECOGNITION = Stage("recognition", _pack_recognition, _unpack_recognition)
SEGMENTATION = Stage("segmentation", _pack_segmentation, _unpack_segmentation)
JOINTS = Stage("joints", _pack_joints, _unpack_joints)
CORRECTION = Stage("correction", _pack_corrected, _unpack_corrected)  # manual correction of Stage B's result
COMPLETION = Stage("completion", _pack_completed, _unpack_completed)
REVISION = Stage("revision", _pack_corrected, _unpack_corrected)  # manual correction of Stage C's result
STAGES = (MESH, RECOGNITION, SEGMENTATION, JOINTS, CORRECTION, COMPLETION, REVISION)


def stage_key(stage: Stage[Any], *, previous: str, config: Mapping[str, object]) -> str:
    """Hash what a stage depends on: its settings, the version, and the previous key (of the source: its sha256)."""
    dependencies = {"stage": stage.name, "previous": previous, "config": config, "version": anymesh.__version__}
    return hashlib.sha256(json.dumps(dependencies, sort_keys=True, allow_nan=False).encode()).hexdigest()


def stage_files(stage: Stage[Any]) -> tuple[str, str]:
    """Return the file names of a stage, relative to the output folder."""
    return f"{FOLDER}/{stage.name}.json", f"{FOLDER}/{stage.name}.npz"


def write_stage(folder: Path, stage: Stage[Result], key: str, result: Result) -> None:
    """Write the result of a stage; the JSON file is written last and holds the digest of the arrays."""
    record, arrays = stage.pack(result)
    json_name, npz_name = stage_files(stage)
    (folder / FOLDER).mkdir(exist_ok=True)
    digest = _write_arrays(folder / npz_name, arrays) if arrays else None
    write_json(folder / json_name, {"stage": stage.name, "key": key, "arrays_sha256": digest, "result": record})


def read_stage(folder: Path, stage: Stage[Result], key: str | None) -> Result | None:
    """Read the result of a stage, None unless it is complete and saved under the key (None: any key)."""
    json_name, npz_name = stage_files(stage)
    header = read_json(folder / json_name)
    if header is None or (key is not None and header.get("key") != key):
        return None
    try:
        arrays = {} if header["arrays_sha256"] is None else _read_arrays(folder / npz_name, header["arrays_sha256"])
        return stage.unpack(header["result"], arrays)
    except (OSError, ValueError, KeyError, TypeError, EOFError, zipfile.BadZipFile) as error:
        log.warning("the saved stage %s in %s cannot be used: %s", stage.name, folder, error)
        return None


def saved_key(folder: Path, stage: Stage[Any]) -> str | None:
    """Return the key of a saved stage, None if there is none."""
    header = read_json(folder / stage_files(stage)[0])
    return None if header is None else header.get("key")


def _write_arrays(path: Path, arrays: Mapping[str, np.ndarray]) -> str:
    """Write an .npz with fixed dates; return its sha256."""
    with zipfile.ZipFile(path, "w") as archive:
        for name, array in arrays.items():
            with archive.open(zipfile.ZipInfo(f"{name}.npy", EPOCH), "w", force_zip64=True) as file:
                np.lib.format.write_array(file, np.ascontiguousarray(array), version=(1, 0), allow_pickle=False)
    return _digest(path)


def _read_arrays(path: Path, digest: str) -> dict[str, np.ndarray]:
    if _digest(path) != digest:
        raise ValueError(f"{path.name} is not the file that was written")
    with np.load(path, allow_pickle=False) as archive:
        return {name: archive[name] for name in archive.files}


def _digest(path: Path) -> str:
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def assemble(
    loaded: LoadResult,
    recognition: RecognitionResult,
    segmentation: SegmentationResult,
    joints: JointResult,
    *,
    correction: CorrectionResult | None,
    completion: CompletionResult | None,
    revision: CorrectionResult | None,
    timing: Mapping[str, float],
) -> Asset:
    """Assemble the asset from stage results.

    correction: manual correction before Stage C; revision: manual correction after it.
    """
    loaded, recognized = recognition.sized(loaded), recognition.recognition
    answered = recognized.category if recognized is not None and recognized.category != UNRECOGNIZED else ""
    asset = Asset(
        name=legal_name(Path(loaded.source.path).stem, fallback="asset"),
        source=loaded.source,
        mesh=loaded.mesh,
        segmentation=segmentation.segmentation,
        joints=joints.joints,
        loops=joints.loops,
        answerer=joints.answerer,
        warnings=_once((*loaded.warnings, *recognition.warnings, *segmentation.warnings, *joints.warnings)),
        timing=timing,
        exchanges=(*recognition.exchanges, *segmentation.exchanges, *joints.exchanges),
        category=loaded.category or answered,
        front=None if recognized is None else recognized.front,
    )
    asset = asset if correction is None else _corrected(asset, correction)
    if completion is not None:
        asset = replace(
            asset,
            mesh=completion.mesh,
            segmentation=completion.parted(asset.segmentation),
            source_face=completion.source_face,
            notes=completion.notes,
        )
    return asset if revision is None else _corrected(asset, revision)


def _corrected(asset: Asset, by: CorrectionResult) -> Asset:
    return replace(asset, segmentation=by.segmentation, joints=by.joints, loops=by.loops, warnings=_once(by.warnings))


def _once(warnings: tuple[str, ...]) -> tuple[str, ...]:
    return tuple(dict.fromkeys(warnings))
