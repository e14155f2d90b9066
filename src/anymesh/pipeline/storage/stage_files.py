"""Stage results on disk: a JSON file with the key, and an .npz file with the arrays."""

from __future__ import annotations

import hashlib
import json
import logging
import zipfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

import anymesh
from anymesh.pipeline.storage.packing import Stage
from anymesh.runtime import read_json, write_json

log = logging.getLogger("anymesh")
Result = TypeVar("Result")
FOLDER = "stages"
EPOCH = (1980, 1, 1, 0, 0, 0)  # date inside every archive, so that equal results are equal files


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
