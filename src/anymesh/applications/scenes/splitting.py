"""Articulate each object of a scene: equal ones once, each asset with its placements, and the whole in one MJCF and one USD."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import Float

import anymesh
from anymesh.applications.scenes.objects import SceneObject, find_objects
from anymesh.applications.scenes.whole import SCENE, Placement, SceneAssets, write_scene
from anymesh.errors import AnymeshError, BudgetError, MissingExtraError, OptionError, OutputError
from anymesh.export.formats import load_libraries
from anymesh.export.options import ExportOptions
from anymesh.isolation import AHEAD, shared_pool
from anymesh.loading import load_mesh, place_mesh
from anymesh.loading.load import UNITS, PlacedMesh
from anymesh.names import legal_names
from anymesh.pipeline.api import articulate_loaded, new_run
from anymesh.pipeline.options import FILES, GEOMETRY, FormatOptions, PlacementOptions, Spent, defaults
from anymesh.pipeline.results import LoadResult
from anymesh.pipeline.stage_files import MESH, stage_key
from anymesh.pipeline.stages import Keyed
from anymesh.runtime import DEFAULT_SECONDS, Progress, read_json, silent, writing
from anymesh.types import Brief, Mesh, Source

EQUAL = 1e-4  # of the diagonal: corners of equal objects lie this close after the best rigid motion
UPRIGHT = 1e-3  # sine of the largest angle between the verticals of equal objects
LONGEST = (0.5, 4.0)  # [m] plausible longest sides of the largest object, if the file has no unit
ENDING = (BudgetError, MissingExtraError, OptionError)  # errors that would recur for every other object


def articulate_scene(
    mesh_path: str | Path,
    out: str | Path,
    *,
    parts: str = "auto",
    force: bool = False,
    progress: Progress = silent,
    **options: Any,
) -> SceneAssets:
    """Articulate every object of a scene into `out`/assets/NAME, and write the whole as scene.json, scene.xml and scene.usda.

    Equal objects are articulated once; rooms and grounds get no joints. An object that fails is named in the result and does
    not stop the others. Assets that an earlier run with the same options finished are kept. parts: auto or nodes; other options
    as for `articulate`.

    Raise InputError, OptionError or OutputError as `articulate` does.
    """
    if parts not in ("auto", "nodes"):
        raise OptionError(f"--scene split finds the parts of each object; valid are --parts auto and nodes, found {parts!r}")
    written = {k: options.pop(k, d) for k, d in defaults(FormatOptions).items()}
    how = _how(written)
    load_libraries(how.formats)
    placing = PlacementOptions(**{k: options.pop(k, d) for k, d in defaults(PlacementOptions).items()})
    time_limit = options.pop("time_limit", DEFAULT_SECONDS)
    path, out = Path(mesh_path), Path(out).resolve()
    if path.resolve().is_relative_to(out):
        raise OutputError(f"the source mesh {path} lies in the output folder {out}; choose another folder")
    progress("load", path.name, 0, 1)
    loaded = load_mesh(path, root=placing.root, animation=placing.animation)
    placed = place_mesh(loaded, up=placing.up, scale=placing.scale, category=options.get("category"))
    objects = find_objects(placed.mesh)
    if placing.scale == "auto" and loaded.unit_in_metres is None and len(objects) > 1:
        placed = _plausible(placed, objects)
    key = _key(loaded.sha256, placed, parts, {**options, **written, "time_limit": time_limit})
    _check_target(out, key, force)
    names = legal_names([o.name or ("room" if o.fixed else "object") for o in objects], fallback="object")
    scene = SceneAssets(str(path), loaded.sha256, key, how, (*loaded.warnings, *placed.warnings), loaded.credits)
    with writing(out):
        out.mkdir(parents=True, exist_ok=True)
    write_scene(scene, out, finished=False)
    options["spent"] = options.get("spent") or Spent()
    kinds = list(_kinds(placed.mesh, objects, names))
    for number, kind in enumerate(kinds):
        progress("scene", kind.name, number, len(kinds))
        error = _articulated(
            kind, placed, scene, out / "assets" / kind.name, "none" if kind.fixed else parts, time_limit, options
        )
        scene = scene.with_placements(kind.name, kind.placements, error)
    write_scene(scene, out, finished=True)
    return scene


def _how(written: dict[str, Any]) -> ExportOptions:
    """Return how the objects are written. Raise OptionError for a mass, which is that of one object."""
    how = ExportOptions.parse(written)
    if how.mass is not None:
        raise OptionError("--mass is that of one object, not of each of a scene; give it to `anymesh export DIR/assets/NAME`")
    return how


@dataclass(frozen=True, eq=False)
class _Kind(Brief):
    """Equal objects. mesh: of the first in its own frame [m, Z up]; origin: of that frame in the scene [m]."""

    name: str
    mesh: Mesh
    origin: Float[np.ndarray, " 3"]
    placements: tuple[Placement, ...]
    fixed: bool


def _kinds(mesh: Mesh, objects: tuple[SceneObject, ...], names: list[str]) -> Iterator[_Kind]:
    """Yield the distinct objects, each with the placements of all that equal it."""
    left = list(range(len(objects)))
    while left:
        first, *others = left
        own = mesh.subset(objects[first].faces)
        low, high = own.bounds
        origin = np.array([*(low + high)[:2] / 2, low[2]])
        T = np.eye(4)
        T[:3, 3] = origin
        placements, left = [Placement(names[first], T)], []
        for k in others:
            moved = None if objects[k].fixed else _motion(mesh, objects[first], objects[k])
            if moved is None:
                left.append(k)
            else:
                placements.append(Placement(names[k], moved @ T))
        back = np.eye(4)
        back[:3, 3] = -origin
        yield _Kind(names[first], own.transformed(back), origin, tuple(placements), objects[first].fixed)


def _motion(mesh: Mesh, a: SceneObject, b: SceneObject) -> Float[np.ndarray, "4 4"] | None:
    """Return the rigid motion about the vertical that brings one object onto an equal one; None if they differ."""
    if len(a.faces) != len(b.faces) or (mesh.face_material[a.faces] != mesh.face_material[b.faces]).any():
        return None
    for value in (mesh.corner_uv, mesh.corner_color):
        if value is not None and not np.array_equal(value[a.faces], value[b.faces]):
            return None
    p, q = (mesh.triangles[o.faces].reshape(-1, 3) for o in (a, b))
    p0, q0 = p.mean(0), q.mean(0)
    u, _, vt = np.linalg.svd((p - p0).T @ (q - q0))
    turn = vt.T @ np.diag([1, 1, np.sign(np.linalg.det(vt.T @ u.T))]) @ u.T
    size = float(np.linalg.norm(np.ptp(p, axis=0)))
    if np.abs((p - p0) @ turn.T + q0 - q).max() > EQUAL * size or np.linalg.norm(turn[:2, 2]) > UPRIGHT:
        return None
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = turn, q0 - turn @ p0
    return T


def _plausible(placed: PlacedMesh, objects: tuple[SceneObject, ...]) -> PlacedMesh:
    """Return the scene in the unit that makes its largest object plausible, if the file has none."""
    longest = max(float(np.ptp(placed.mesh.triangles[o.faces], axis=(0, 1)).max()) for o in objects if not o.fixed)
    given = float(np.linalg.norm(placed.T_asset_source[:3, 0]))
    for name, unit in (("metres", 1.0), *UNITS):
        if LONGEST[0] <= longest / given * unit <= LONGEST[1]:
            T = np.diag([unit / given] * 3 + [1.0])
            note = f"scale {unit:g} ({name}; plausible for the objects of the scene)"
            return replace(
                placed,
                mesh=placed.mesh.transformed(T),
                T_asset_source=T @ placed.T_asset_source,
                notes=(placed.notes[0], note),
                warnings=(),
            )
    return placed


def _key(sha256: str, placed: PlacedMesh, parts: str, options: dict[str, Any]) -> str:
    """Return a digest of all that the assets depend on."""
    ignored = ("force", "cache", "timeout", "wait", "max_calls", "max_cost", "spent", "limiter", "suggest")
    chosen = sorted((k, str(v)) for k, v in options.items() if k not in ignored)
    content = (anymesh.__version__, sha256, placed.T_asset_source.tolist(), placed.notes, parts, chosen)
    return hashlib.sha256(repr(content).encode()).hexdigest()


def _check_target(out: Path, key: str, force: bool) -> None:
    """Raise OutputError unless the folder is new, or holds a scene that may be continued or replaced."""
    if not out.is_dir() or not any(out.iterdir()):
        return
    record = read_json(out / SCENE)
    if record is None:
        raise OutputError(
            f"{out} is not empty and not an output of --scene split, so it is not replaced; choose another folder"
        )
    if not force and record.get("finished"):
        raise OutputError(f"the output folder {out} is not empty; choose another (--force replaces an older output)")
    if not force and record.get("key") != key:
        raise OutputError(f"{out} holds an unfinished run with other options or another mesh; --force replaces it")


def _articulated(
    kind: _Kind, placed: PlacedMesh, scene: SceneAssets, target: Path, parts: str, time_limit: float, options: dict[str, Any]
) -> AnymeshError | None:
    """Write the asset of a kind, unless an earlier run did; return what stopped it."""
    T = placed.T_asset_source.copy()
    T[:3, 3] -= kind.origin
    digest = hashlib.sha256(f"{scene.key}/{kind.name}".encode()).hexdigest()
    source = Source(f"{scene.source}/{kind.name}", digest, T, placed.up, placed.notes, scene.credits)
    made = read_json(target / "asset.json")
    if made is not None and made.get("source", {}).get("sha256") == digest:
        return None
    who = str(options.get("answerer", GEOMETRY))
    who = f"{who}/{kind.name}" if who.startswith(FILES) else who
    try:
        with new_run(source.path, target, {**options, "answerer": who}, True, time_limit, silent) as run:
            shared_pool().warm(*AHEAD)
            loaded = Keyed(LoadResult(kind.mesh, source, (), placed.metric), stage_key(MESH, previous=digest, config={}))
            run.folder.save(MESH, loaded.key, loaded.result)
            articulate_loaded(run, loaded, parts, scene.how, sized=False)
    except ENDING:
        raise
    except AnymeshError as error:
        return error
    return None
