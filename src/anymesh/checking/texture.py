"""Check "texture": material files and textures that are referred to exist."""

from __future__ import annotations

import html
import re
from collections.abc import Iterator
from pathlib import Path

from PIL import Image

from anymesh.checking.content import Content
from anymesh.checking.engines.files import find_file
from anymesh.checking.report import Finding, failure, warning

CHECK = "texture"
MESHES = "meshes"  # mesh folder of an asset of this project
PICTURES = (".png", ".jpg", ".jpeg")


def check_texture(content: Content, *, ours: bool) -> Iterator[Finding]:
    """Check that material files and textures exist and can be read. ours: made by anymesh; then unused textures are reported.

    Missing materials in mesh files of other sources are a warning, since such meshes are shown in one colour.
    """
    for link in content.robot.links:
        warnings = [text for solid in content.visuals[link.name] for text in solid.warnings]
        for text in dict.fromkeys(warnings):
            yield failure(CHECK, link.name, text) if ours else warning(CHECK, link.name, text)
    folder = content.robot.path.parent
    for reference in content.robot.pictures:
        picture = find_file(reference, folder)
        if picture is None:
            yield failure(CHECK, "", f"the picture {reference} is not there")
        elif (broken := _broken(picture)) is not None:
            yield failure(CHECK, "", f"the picture {reference} cannot be read: {broken}")
    if ours:
        yield from _unused(folder / MESHES)


def _broken(path: Path) -> str | None:
    try:
        with Image.open(path) as picture:
            picture.load()
    except (OSError, ValueError, SyntaxError, Image.DecompressionBombError) as error:
        return " ".join(str(error).split())
    return None


def _unused(folder: Path) -> Iterator[Finding]:
    """Report pictures that neither a material library nor a description (MJCF needs PNG) names."""
    naming = sorted([*folder.glob("*.mtl"), *(p for kind in ("xml", "urdf", "sdf") for p in folder.parent.glob(f"*.{kind}"))])
    text = html.unescape("\n".join(p.read_text(encoding="utf-8", errors="replace") for p in naming))
    for path in sorted(folder.iterdir()) if folder.is_dir() else ():
        if path.suffix.lower() in PICTURES and not re.search(rf"(?<![\w.-]){re.escape(path.name)}(?![\w.-])", text):
            yield warning(CHECK, path.name, "no material uses this picture")
