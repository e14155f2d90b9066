"""The layers of a USD file, opened so that composition reads nothing outside the permitted folder.

Each layer is opened by itself, and its references to other layers are resolved by our own rules. Those that are not permitted
are taken out of the layer in memory, the others become the path of a layer that is open already. USDZ archives are unpacked
into a temporary folder, in which their own references stay.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path, PurePosixPath
from types import ModuleType
from typing import Any

from anymesh.errors import InputError, MissingExtraError
from anymesh.formats.advice import needs_extra
from anymesh.formats.packages import unpack
from anymesh.loading.files import Folder
from anymesh.loading.references import SHOWN

LAYERS = (".usd", ".usda", ".usdc")
PACKAGED = re.compile(r"(.+\.usdz)(?:\[(.+)\])?", re.I)
MAX_LAYERS = 10_000
LISTS = ("prepended", "appended", "added", "deleted", "ordered")


def load_pxr() -> ModuleType:
    """Import OpenUSD. Raise MissingExtraError without it."""
    try:
        import pxr
        import pxr.Gf
        import pxr.Sdf
        import pxr.Tf
        import pxr.Usd
        import pxr.UsdGeom
        import pxr.UsdPhysics
        import pxr.UsdShade
        import pxr.UsdSkel
    except ImportError as error:
        raise MissingExtraError(needs_extra("pxr")) from error
    return pxr


class Layers:
    """The open layers of one file, and the folder that relative paths in each start from.

    work: an empty folder for unpacked archives.
    """

    def __init__(self, folder: Folder, work: Path) -> None:
        self._pxr, self._work, self._packages = load_pxr(), work, 0
        self._folders: dict[str, Folder] = {}  # by the path of a layer
        self._kept: dict[str, Any] = {}  # composition finds open layers, as long as they are kept
        self._archives: dict[tuple[Path, str], str | None] = {}
        self._folder = folder
        path = folder.path.resolve()
        first = self._unpacked(path, "", folder) if path.suffix.lower() == ".usdz" else str(path)
        if first is None:
            raise InputError(f"{folder.path.name}: found no .usd, .usda or .usdc in the archive; one is needed")
        self._folders.setdefault(first, folder)
        self.root = self._open(first)

    def folder_of(self, layer: Any) -> Folder:
        """Return the folder in which paths of a layer are found."""
        path = layer.realPath
        return self._folders[path].beside(Path(path)) if path in self._folders else self._folder

    def _unpacked(self, archive: Path, inner: str, outer: Folder) -> str | None:
        """Return the layer in an archive, the first one if none is named."""
        if (archive, inner) not in self._archives:
            self._packages += 1
            target = self._work / f"package_{self._packages}"
            target.mkdir(parents=True)
            names = unpack(archive.name, archive, target)
            wanted = [n for n in names if PurePosixPath(n).suffix.lower() in LAYERS and inner in ("", n)]
            layer = (target / wanted[0]).resolve() if wanted else None
            if layer is not None:
                inside = Folder(layer, target)
                inside.warnings = outer.warnings
                for name in names:
                    self._folders[str((target / name).resolve())] = inside
            self._archives[archive, inner] = None if layer is None else str(layer)
        return self._archives[archive, inner]

    def _open(self, first: str) -> Any:
        """Open a layer and all that it refers to."""
        waiting = [first]
        while waiting:
            path = waiting.pop()
            if path in self._kept:
                continue
            if len(self._kept) >= MAX_LAYERS:
                raise InputError(f"{self._folder.path.name} refers to more than {MAX_LAYERS} layers; at most that are read")
            try:
                layer = self._pxr.Sdf.Layer.FindOrOpen(path)
            except self._pxr.Tf.ErrorException as error:
                layer, cause = None, re.sub(r"\s+", " ", re.sub(r"^.*?: '", "", str(error), count=1, flags=re.S))[:150]
            else:
                cause = "no layer"
            if layer is None and path == first:
                raise InputError(f"{self._folder.path.name} is not a valid USD file, it is broken or truncated ({cause})")
            if layer is None:
                self._folder.warn(f"the layer {Path(path).name!r} left out: it cannot be read ({cause})")
                layer = self._pxr.Sdf.Layer.CreateAnonymous()
            self._kept[path] = layer
            waiting += self._restrict(layer)
        return self._kept[first]

    def _restrict(self, layer: Any) -> list[str]:
        """Replace or remove a layer's references to other layers, and return the paths of those that it may read."""
        folder, paths = self.folder_of(layer), []

        def permitted(asset: str) -> str | None:
            path = self._permitted(asset, folder)
            if path is not None:
                paths.append(path)
            return path

        sublayers = [(p, layer.subLayerOffsets[k]) for k, p in enumerate(layer.subLayerPaths)]
        new = [(path, offset) for asset, offset in sublayers if (path := permitted(asset)) is not None]
        if [p for p, _ in sublayers] != [p for p, _ in new]:
            layer.subLayerPaths = [path for path, _ in new]
            for k, (_, offset) in enumerate(new):
                layer.subLayerOffsets[k] = offset
        prims: list[Any] = []
        layer.Traverse("/", lambda p: prims.append(p) if p.IsPrimPath() or p.IsPrimVariantSelectionPath() else None)
        for path in prims:
            spec = layer.GetPrimAtPath(path)
            if spec is None:
                continue
            for key in ("references", "payload"):
                if spec.HasInfo(key):
                    spec.SetInfo(key, _mapped(spec.GetInfo(key), permitted))
            if spec.HasInfo("clips"):
                spec.ClearInfo("clips")
                folder.warn("value clips (animation in other files) are left out")
        return paths

    def _permitted(self, asset: str, folder: Folder) -> str | None:
        """Return the path of the layer that a reference means; None, with a warning, if it may not or cannot be read."""
        if asset.startswith("`") or ":SDF_FORMAT_ARGS:" in asset:
            folder.warn(f"the layer {asset[:SHOWN]!r} left out: its path is computed, which is not followed")
            return None
        packaged = PACKAGED.fullmatch(asset)
        outer, inner = (packaged[1], packaged[2] or "") if packaged else (asset, "")
        if not packaged and PurePosixPath(asset.replace("\\", "/")).suffix.lower() not in LAYERS:
            folder.warn(f"the layer {asset[:SHOWN]!r} left out: it is no USD file")
            return None
        if folder.read_or_warn(outer, "the layer") is None:
            return None
        file = folder.find(outer)
        assert file is not None
        if not packaged:
            self._folders.setdefault(str(file), folder)
            return str(file)
        try:
            path = self._unpacked(file, inner, folder)
        except InputError as error:
            folder.warn(f"the layer {asset[:SHOWN]!r} left out: {error}")
            return None
        if path is None:
            folder.warn(f"the layer {asset[:SHOWN]!r} left out: there is none in the archive")
        return path


def _mapped(listed: Any, permitted: Callable[[str], str | None]) -> Any:
    """Return a list operation of references or payloads with other paths; those to prims of the same layer stay."""
    new = type(listed)()
    for kind in ("explicit",) if listed.isExplicit else LISTS:
        kept = []
        for item in getattr(listed, f"{kind}Items"):
            path = permitted(item.assetPath) if item.assetPath else ""
            if path is not None:
                kept.append(_with_path(item, path))
        setattr(new, f"{kind}Items", kept)
    return new


def _with_path(item: Any, path: str) -> Any:
    if type(item).__name__ == "Payload":
        return type(item)(path, item.primPath, item.layerOffset)
    return type(item)(path, item.primPath, item.layerOffset, item.customData)
