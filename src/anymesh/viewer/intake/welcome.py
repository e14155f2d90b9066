"""What the live page shows over its scene: a welcome with examples before there is a mesh, and the title of an object.

Pieces of HTML in the page's panel are placed over the scene beside it. They let the mouse through, buttons aside.
"""

from __future__ import annotations

import base64
import io
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from html import escape
from pathlib import Path

import numpy as np
from PIL import Image

from anymesh.formats.zipped import MAX_UNPACKED_BYTES
from anymesh.geometry.raycast_ import RayScene
from anymesh.loading import load_mesh, place_mesh
from anymesh.loading.files import FORMATS
from anymesh.pipeline.results import verdict
from anymesh.rendering.drawing import Window, draw, light_on, material_colors, render_target, sample, smoothed
from anymesh.rendering.viewpoints import orbit_camera
from anymesh.types import Asset, JointType, Mesh
from anymesh.viewer.intake.uploads import MAX_UPLOAD_BYTES

NAME = "Articulate AnyMesh"
STATIC = Path(__file__).parents[1] / "static"
PANEL = 390  # [px] width of the panel beside the scene
SIZE = 150  # [px] of an example's picture
AZIMUTH, ELEVATION = 35.0, 24.0  # [deg] from which the pictures are drawn
EMPTY_PICTURE = "data:image/gif;base64,R0lGODlhAQABAAAAACwAAAAAAQABAAA="
MUTED = "#5c6370"
OVER = (
    f"position:fixed;left:0;top:0;width:calc(100vw - {PANEL}px);height:100vh;pointer-events:none;display:flex;"
    "flex-direction:column;align-items:center;text-align:center;box-sizing:border-box;color:#212529"
)
ZONE = (
    "border:2px dashed #868e96;border-radius:14px;padding:1.4em 2.2em;line-height:1.5;background:rgba(255,255,255,0.7);"
    "max-width:34em"
)
PICTURE_BUTTON = (
    "pointer-events:auto;cursor:pointer;border:1px solid #dee2e6;border-radius:10px;background:#fff;padding:6px 6px 8px;"
    "font:inherit;font-size:0.9em;color:inherit"
)
SMALL_STYLE = "padding:0.2em 1em 0.4em;font-size:0.8em;opacity:0.8"
NOTE = '<div class="anymesh-drop-note" role="alert" style="color:#c92a2a;font-size:0.95em"></div>'


@dataclass(frozen=True)
class Example:
    """A mesh that ships with the package."""

    name: str
    path: Path

    @property
    def picture(self) -> str:
        """The mesh as a picture, in a data URL."""
        return _picture(self.path)


def examples() -> tuple[Example, ...]:
    """Return the meshes to try."""
    return tuple(Example(path.stem.replace("_", " "), path) for path in sorted((STATIC / "examples").glob("*.glb")))


@cache
def _picture(path: Path) -> str:
    mesh = smoothed(place_mesh(load_mesh(path)).mesh)
    camera = orbit_camera(mesh.bounds, np.deg2rad(AZIMUTH), np.deg2rad(ELEVATION), SIZE)
    target = render_target(mesh, RayScene(mesh.vertices, mesh.faces), np.zeros(len(mesh.faces), int))
    samples = sample(target, camera, Window(0, 0, SIZE, SIZE))
    white = np.full((SIZE, SIZE, 3), 255, np.float32)
    buffer = io.BytesIO()
    Image.fromarray(draw(samples, material_colors(mesh, samples), light_on(samples), white)).save(buffer, "PNG")
    return "data:image/png;base64," + base64.b64encode(buffer.getvalue()).decode()


def script() -> str:
    """Return HTML that makes the page take dropped files."""
    code = (STATIC / "drop.js").read_text(encoding="utf-8").replace("MOST", str(MAX_UPLOAD_BYTES), 1)
    return _run(code)


def _run(code: str) -> str:
    """Return HTML that runs a script when it is put on the page."""
    return f'<img src="{EMPTY_PICTURE}" alt="" style="display:none" onload="{escape(code, quote=True)}">'


def welcome(shown: Sequence[Example]) -> str:
    """Return the page without a mesh: where to drop one, and examples; a click on a picture presses the button of its name."""
    press = "for (const b of document.querySelectorAll('button')) if (b.textContent === this.title) { b.click(); break; }"
    pictures = "".join(
        f'<button class="anymesh-example" title="{escape(e.name, quote=True)}" style="{PICTURE_BUTTON}" '
        f'onclick="{escape(press, quote=True)}"><img src="{e.picture}" alt="" width="{SIZE}" height="{SIZE}" '
        f'style="display:block;width:min({SIZE}px,9vw);height:auto"><span>{escape(e.name.capitalize())}</span></button>'
        for e in shown
    )
    formats = ", ".join(suffix[1:].upper() for suffix in FORMATS)
    limits = f"At most {MAX_UPLOAD_BYTES >> 20} MB, {MAX_UNPACKED_BYTES >> 30} GB unpacked. It stays on this machine."
    return (
        f'<div class="anymesh-welcome" style="{OVER};justify-content:center;gap:1.6em;padding:1em">'
        f'<div><div style="font-size:1.9em;font-weight:650;letter-spacing:-0.02em">{NAME}</div>'
        f'<div style="color:{MUTED}">From a rigid mesh to a model whose doors, drawers and wheels move.</div></div>'
        f'<div class="anymesh-drop" style="{ZONE}"><b style="font-size:1.15em">Drop a mesh here</b>'
        f'<div style="font-size:0.85em;color:{MUTED}">{formats};<br>with its other files, as a folder, or '
        f"as a zip.<br>{limits}</div>{NOTE}</div>"
        f'<div><div style="color:{MUTED};margin-bottom:0.5em">Or try an example:</div>'
        f'<div style="display:flex;gap:12px;justify-content:center">{pictures}</div></div>{titled("")}</div>'
    )


def small_zone() -> str:
    """Return one line about dropping, for a page with an object."""
    return f'<div class="anymesh-drop" style="{SMALL_STYLE}">Or drop another mesh anywhere on the page.{NOTE}</div>'


def titled(name: str) -> str:
    """Return HTML that sets the title of the browser's tab."""
    title = f"{name} · {NAME}" if name else NAME
    return _run(f"document.title = {_quoted(title)}")


def _quoted(text: str) -> str:
    return "'" + "".join(c if c.isalnum() or c in " .,-_·" else " " for c in text) + "'"


def title(name: str, mesh: Mesh, details: str = "") -> str:
    """Return the title over the scene: the object's name, its size, and details in words."""
    size = " × ".join(f"{v:.3g}" for v in mesh.extents)
    line = " · ".join(filter(None, (f"{size} m", details)))
    return (
        f'<div class="anymesh-title" style="{OVER};height:auto;padding:14px 20px 0">'
        f'<div style="font-size:1.35em;font-weight:650;max-width:100%;overflow-wrap:anywhere">{escape(name)}</div>'
        f'<div style="color:{MUTED};font-size:0.9em">{escape(line)}</div>{titled(name)}</div>'
    )


def contents(asset: Asset) -> str:
    """Return in words how many parts and moving joints an asset has, and how many of these are to be checked."""
    moving = [j for j in asset.joints if j.type is not JointType.FIXED]
    parts = len(asset.segmentation.parts)
    doubtful = sum(verdict(asset.segmentation, j, asset.warnings).word != "sure" for j in moving)
    words = f"{parts} part{'s' * (parts != 1)}, {len(moving)} moving joint{'s' * (len(moving) != 1)}"
    return words + (f", {doubtful} to check" if doubtful else "")
