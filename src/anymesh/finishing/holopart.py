"""Completion of parts by HoloPart (Yang et al. 2025): they are scaled, thickened, sent, and matched in the result (paper, 3.4).

HoloPart is the authors' released code. It needs a GPU and its own environment, so it runs as a separate process in its own
checkout, or behind HTTP. Both take a GLB with one geometry per part and return one with the completed parts.
"""

from __future__ import annotations

import logging
import os
import shutil
import signal
import subprocess
import tempfile
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from jaxtyping import Float, Int

from anymesh.errors import MAX_QUOTE, SECRET, InputError, ModelError, OptionError
from anymesh.finishing.protocol import PartMesh
from anymesh.finishing.scene_glb import Y_UP, read_scene, scene_glb
from anymesh.finishing.web import Call, LostError, exchange, is_web
from anymesh.geometry.distance_ import distance_to_triangles
from anymesh.geometry.topology import components, weld
from anymesh.geometry.triangle_set import sample_surface
from anymesh.prompted.models.retry import persist
from anymesh.types import Asset, Mesh, Node
from anymesh.types.triangles import face_cross

VALID = "holopart:FOLDER, holopart:FOLDER#PYTHON or holopart:URL"
MODULE = "scripts.inference_holopart"
RESULT = "output.glb"
LARGEST = 1 << 29  # [bytes] maximum size of a result
CORE = (0.05, 0.95)  # quantiles of the surface used to measure thickness, so that a handle does not make a door thick
THICKNESS_SAMPLES = 4000
log = logging.getLogger("anymesh")
BOX = 0.95  # half the longest side of the whole object as it is sent; the model was trained in -1..1
MIN_THICKNESS_RATIO = (
    0.04  # minimum thickness of a part as it is sent, over its longest side; the decoder's first grid has cells of .025
)
SAMPLES = 400  # sample points per part for matching


class CrashError(ModelError):
    """HoloPart ran and failed."""


def open_holopart(where: str, *, timeout: float = 1800.0, seed: int = 0) -> PartServer | Checkout:
    """Open a HoloPart checkout or server.

    where: URL of a server, or a folder with the checkout, which is run by the Python after `#` (else that of its .venv, else
    `python`);
    timeout: [s] for all parts together. Raise OptionError if there is no such checkout, program or valid URL.
    """
    if not timeout > 0:
        raise OptionError(f"a time-out must be more than 0 s, found {timeout:g}")
    if where.startswith(("http://", "https://")):
        if not is_web(where, plain=True) or "@" in where:
            raise OptionError(f"--completer: the URL is not valid; valid are {VALID}, without user or password")
        return PartServer(where, timeout)
    folder, _, python = where.partition("#")
    root = Path(folder).expanduser()
    script = root.joinpath(*MODULE.split(".")).with_suffix(".py")
    if not folder or not script.is_file():
        held = "no folder" if not (folder and root.is_dir()) else f"a folder without {script.relative_to(root)}"
        raise OptionError(f"--completer: found {held} at {folder or '(nothing)'!r}; valid are {VALID}")
    own = [str(p) for p in (root / ".venv/bin/python", root / ".venv/Scripts/python.exe") if p.is_file()]
    asked = python or next(iter(own), "python")
    program = shutil.which(str(Path(asked).expanduser()) if os.sep in asked else asked)
    if program is None:
        raise OptionError(f"--completer: found no program {asked!r} to run {root} with; valid are {VALID}")
    return Checkout(root.resolve(), str(Path(program).absolute()), timeout, seed)


@dataclass(frozen=True)
class PartServer:
    """HoloPart server: receives the GLB as the body of a POST and returns the GLB of the completed parts."""

    url: str
    timeout: float

    def complete(self, glb: bytes) -> bytes:
        headers = {"Content-Type": "model/gltf-binary", "Accept": "model/gltf-binary"}
        call = Call("the HoloPart server", "POST", self.url, headers, glb, self.timeout, LARGEST, plain=True)

        def ask() -> bytes:
            try:
                answer = exchange(call)
            except LostError as error:  # it may still be working: another request would repeat all of the work
                raise ModelError(str(error)) from None
            if answer.status == 200:
                return answer.body
            words = SECRET.sub("[removed]", " ".join(answer.body[:2000].decode("utf-8", "replace").split()))[:MAX_QUOTE]
            error = CrashError if answer.status == 500 else ModelError
            raise error(f"the HoloPart server: HTTP {answer.status}, it says: {words}")

        return persist(ask, attempts=3)


@dataclass(frozen=True)
class Checkout:
    """Checkout of the released code. folder, python: absolute paths; timeout: [s]."""

    folder: Path
    python: str
    timeout: float
    seed: int

    def complete(self, glb: bytes) -> bytes:
        with tempfile.TemporaryDirectory(prefix="anymesh-holopart-") as name:
            work = Path(name)
            (work / "in.glb").write_bytes(glb)
            self._run(work)
            result = work / "out" / RESULT
            if not result.is_file():
                held = sorted(p.name for p in (work / "out").iterdir()) if (work / "out").is_dir() else []
                raise CrashError(f"HoloPart ended and left no {RESULT}; found {held or 'nothing'} in its output folder")
            if result.stat().st_size > LARGEST:
                raise ModelError(f"HoloPart's {RESULT} has {result.stat().st_size} bytes, at most {LARGEST} are read")
            return result.read_bytes()

    def _run(self, work: Path) -> None:
        files = ["--mesh-input", str(work / "in.glb"), "--output-dir", str(work / "out")]
        keyless = {name: value for name, value in os.environ.items() if not name.endswith("_API_KEY")}
        with (work / "log").open("wb") as output:
            process = subprocess.Popen(
                [self.python, "-m", MODULE, *files, "--seed", str(self.seed)],
                cwd=self.folder,
                env=keyless,
                stdin=subprocess.DEVNULL,
                stdout=output,
                stderr=subprocess.STDOUT,
                start_new_session=True,
            )
            try:
                code = process.wait(self.timeout)
            except subprocess.TimeoutExpired:
                raise ModelError(f"HoloPart was stopped: it took longer than {self.timeout:g} s") from None
            finally:
                _stop(process)
        if code:
            raise CrashError(f"HoloPart ended with status {code}{_last_words(work / 'log')}")


def _stop(process: subprocess.Popen[bytes]) -> None:
    """Kill the process and its children if it is still running."""
    if process.poll() is not None:
        return
    if hasattr(os, "killpg"):
        os.killpg(process.pid, signal.SIGKILL)
    else:
        process.kill()
    process.wait()


def _last_words(path: Path) -> str:
    """Return the last line of its log, with anything that looks like a key removed."""
    with path.open("rb") as file:
        file.seek(max(0, path.stat().st_size - 4000))
        lines = [line.strip() for line in file.read().decode("utf-8", "replace").splitlines() if line.strip()]
    return f"; the end of its output: {SECRET.sub('[removed]', lines[-1])[:MAX_QUOTE]}" if lines else ""


@dataclass(frozen=True, eq=False)
class Thickened:
    """mesh: welded; closed: whether it was a solid before; added: [m] by which it was thickened, 0 if not needed."""

    mesh: PartMesh
    closed: bool
    added: float


def thicken(triangles: Float[np.ndarray, "F 3 3"], min_thickness: float) -> Thickened:
    """Thicken a part whose core is thinner than `min_thickness` of its longest side.

    An open surface gets a back and side walls behind it, so that its visible surface does not move. A closed one is stretched
    along its thin direction about its centre.
    """
    vertices, faces = _welded(triangles)
    parts = components(vertices, faces)
    closed = bool((parts.solid & parts.agree).all())
    points = sample_surface(triangles, THICKNESS_SAMPLES, 0).points
    middle = points.mean(0)
    axes = np.linalg.svd(points - middle, full_matrices=False)[2]
    along = (points - middle) @ axes.T
    low, high = np.quantile(along, CORE, axis=0)
    sides = high - low
    missing = float(min_thickness * np.ptp(along, axis=0).max() - sides.min())
    if missing <= 0:
        return Thickened(PartMesh(vertices, faces), closed, 0.0)
    if not closed:
        return Thickened(_solid(vertices, faces, missing), closed, missing)
    thin = axes[sides.argmin()]
    height = (vertices - middle) @ thin
    stretch = missing / max(float(sides.min()), 1e-3 * missing)
    return Thickened(PartMesh(vertices + np.outer(stretch * height, thin), faces), closed, missing)


def _welded(triangles: np.ndarray) -> tuple[Float[np.ndarray, "V 3"], Int[np.ndarray, "F 3"]]:
    corners = triangles.reshape(-1, 3)
    _, first, number = np.unique(weld(corners), return_index=True, return_inverse=True)
    faces = number.reshape(-1, 3)
    real = (faces[:, 0] != faces[:, 1]) & (faces[:, 1] != faces[:, 2]) & (faces[:, 2] != faces[:, 0])
    return corners[first], faces[real]


def _solid(vertices: np.ndarray, faces: np.ndarray, depth: float) -> PartMesh:
    """Return an open surface with a copy `depth` [m] behind it, and walls along its border."""
    cross = face_cross(vertices[faces])
    normal = np.zeros_like(vertices)
    for corner in range(3):
        np.add.at(normal, faces[:, corner], cross)
    length = np.linalg.norm(normal, axis=1, keepdims=True)
    back = vertices - depth * np.divide(normal, length, out=np.zeros_like(normal), where=length > 0)
    edges = np.concatenate([faces[:, [k, (k + 1) % 3]] for k in range(3)])
    key = np.sort(edges, axis=1)
    _, first, count = np.unique(key, axis=0, return_index=True, return_counts=True)
    a, b = edges[first[count == 1]].T
    n = len(vertices)
    walls = np.concatenate([np.stack([b, a, a + n], 1), np.stack([b, a + n, b + n], 1)])
    return PartMesh(np.concatenate([vertices, back]), np.concatenate([faces, faces[:, ::-1] + n, walls]))


@dataclass(frozen=True)
class HoloPart:
    """Completer by HoloPart. Closed parts are sent as context for the others, but stay unchanged.

    After a crash it is called once more with twice the thickness, since thin parts are a known cause of crashes.
    service: returns the GLB of the completed parts of a GLB. It raises CrashError if it fails on these parts, ModelError if it
    cannot be used.
    """

    service: Callable[[bytes], bytes]
    name: str = "holopart"

    def complete(self, asset: Asset) -> Mapping[str, PartMesh]:
        """Return the surface of each open part. Raise ModelError if the result cannot be matched to the parts."""
        try:
            return self._complete(asset, MIN_THICKNESS_RATIO)
        except CrashError as error:
            log.warning("%s; once more with parts twice as thick", error)
        return self._complete(asset, 2 * MIN_THICKNESS_RATIO)

    def _complete(self, asset: Asset, least: float) -> Mapping[str, PartMesh]:
        parts = {
            part.name: thicken(asset.mesh.triangles[asset.segmentation.faces(number)], least)
            for number, part in enumerate(asset.segmentation.parts)
        }
        for name, part in parts.items():
            if part.added:
                log.info("%s: %s is sent %.3g m thicker than it is", self.name, name, part.added)
        if all(part.closed for part in parts.values()):
            return {}
        T = box_transform(asset.mesh)
        glb = self.service(scene_glb({name: _mesh(name, part) for name, part in parts.items()}, T))
        pieces = {name: _moved(mesh, np.linalg.inv(T)) for name, mesh in read_pieces(glb).items()}
        matched = match_pieces(pieces, {name: part.mesh for name, part in parts.items()})
        return {name: matched[name] for name, part in parts.items() if not part.closed and name in matched}


def box_transform(mesh: Mesh) -> Float[np.ndarray, "4 4"]:
    """Return T_box_asset: centred, Y up, with a longest side of 2 * BOX."""
    T = np.eye(4)
    T[:3, :3] = Y_UP * (2 * BOX / mesh.extents.max())
    T[:3, 3] = -T[:3, :3] @ mesh.bounds.mean(0)
    return T


def read_pieces(glb: bytes) -> dict[str, Mesh]:
    """Return the nodes of a GLB by the names of their geometries. Raise ModelError if it cannot be read."""
    try:
        mesh = read_scene(glb, "output.glb")
    except InputError as error:
        raise ModelError(f"HoloPart's result cannot be used: {error}") from None
    names = [node.geometry for node in mesh.nodes]
    names = names if len(set(names)) == len(names) else [node.name for node in mesh.nodes]
    return {name: mesh.subset(mesh.face_node == number) for number, name in enumerate(names)}


def match_pieces(pieces: Mapping[str, PartMesh], parts: Mapping[str, PartMesh]) -> dict[str, PartMesh]:
    """Match pieces to parts: by name if all names are known, else by distance to the parts that were sent.

    Raise ModelError if names are unknown and the counts differ.
    """
    if set(pieces) <= set(parts):
        return {name: piece for name, piece in pieces.items() if len(piece.faces)}
    if len(pieces) != len(parts):
        raise ModelError(
            f"HoloPart returned {len(pieces)} parts for {len(parts)}, under names that were not sent: {sorted(pieces)[:5]}"
        )
    off = np.empty((len(parts), len(pieces)))
    for row, part in enumerate(parts.values()):
        points = sample_surface(part.triangles, SAMPLES, 0).points
        off[row] = [np.median(distance_to_triangles(points, piece.triangles)) for piece in pieces.values()]
    from scipy.optimize import linear_sum_assignment  # 0.1 s to import, and only this completer needs it

    rows, columns = linear_sum_assignment(off)
    names, meshes = list(parts), list(pieces.values())
    return {names[row]: meshes[column] for row, column in zip(rows, columns, strict=True)}


def _mesh(name: str, part: Thickened) -> Mesh:
    faces = part.mesh.faces
    return Mesh(part.mesh.vertices, faces, np.zeros(len(faces), int), (Node(name, name),), np.full(len(faces), -1))


def _moved(mesh: Mesh, T: Float[np.ndarray, "4 4"]) -> PartMesh:
    """Transform the mesh to the asset frame, wound outwards."""
    moved = mesh.transformed(T)
    t = moved.triangles - moved.triangles.mean((0, 1))
    inward = np.einsum("ij,ij->i", t[:, 0], np.cross(t[:, 1], t[:, 2])).sum() < 0
    return PartMesh(moved.vertices, moved.faces[:, ::-1] if inward else moved.faces)
