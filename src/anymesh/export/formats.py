"""The export formats, with a writer each, and the options of an export."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from pathlib import Path
from typing import Any

from anymesh.entry_points import LOAD_USD, WRITE_USD, resolve
from anymesh.errors import OptionError
from anymesh.export.glb import glb_bytes
from anymesh.export.mjcf_ import write_mjcf
from anymesh.export.model import Base, Driven, ExportConfig, Model
from anymesh.export.sdf import write_sdf
from anymesh.export.urdf import urdf_text


class Format(StrEnum):
    """Names of the formats, as used in options."""

    URDF = "urdf"
    MJCF = "mjcf"
    USD = "usd"  # requires the extra
    SDF = "sdf"
    GLB = "glb"


Writer = Callable[[Model, Path, ExportConfig], None]  # writes into an asset folder with its meshes/
DEFAULT = (Format.URDF, Format.MJCF, Format.SDF, Format.GLB)


def parse_formats(text: str) -> tuple[Format, ...]:
    """Return the formats of a comma-separated list, each once, in the order of Format. Raise OptionError for unknown names."""
    asked = {word.strip().lower() for word in text.split(",") if word.strip()}
    unknown = sorted(asked - set(Format))
    if unknown or not asked:
        problem = f"unknown {', '.join(map(repr, unknown))}" if unknown else "none"
        raise OptionError(f"formats {text!r}: {problem}; valid are {', '.join(Format)}, with commas between")
    return tuple(f for f in Format if f in asked)


def main_file(kind: Format, name: str) -> str:
    """Return the main file of an asset called `name`, relative to its folder."""
    return {
        Format.URDF: f"{name}.urdf",
        Format.MJCF: f"{name}.xml",
        Format.USD: f"{name}.usdc",
        Format.SDF: "model.sdf",
        Format.GLB: f"{name}.glb",
    }[kind]


def load_libraries(formats: Sequence[Format]) -> None:
    """Import what the writers of the formats need, while no other thread works: OpenUSD can hang if one does.

    Raise MissingExtraError for one whose extra is not installed.
    """
    if Format.USD in formats:
        resolve(LOAD_USD)()


def write_formats(model: Model, folder: Path, formats: Sequence[Format], config: ExportConfig) -> None:
    """Write each format into an asset folder with its meshes/. Raise MissingExtraError for one whose extra is not installed."""
    for kind in formats:
        WRITERS[kind](model, folder, config)


def _write_urdf(model: Model, folder: Path, config: ExportConfig) -> None:
    (folder / main_file(Format.URDF, model.asset.name)).write_text(urdf_text(model), encoding="utf-8", newline="\n")


def _write_glb(model: Model, folder: Path, config: ExportConfig) -> None:
    glb = glb_bytes(model.asset, model.links, config)
    (folder / main_file(Format.GLB, model.asset.name)).write_bytes(glb)


def _write_usd(model: Model, folder: Path, config: ExportConfig) -> None:
    resolve(WRITE_USD)(model, folder, config)


WRITERS: Mapping[Format, Writer] = {
    Format.URDF: _write_urdf,
    Format.MJCF: write_mjcf,
    Format.USD: _write_usd,
    Format.SDF: write_sdf,
    Format.GLB: _write_glb,
}


@dataclass(frozen=True)
class ExportOptions:
    """Base, formats and drives of an exported asset. hulls: maximum number of collision shapes per link, None for no limit."""

    base: Base
    formats: tuple[Format, ...]
    driven: Driven
    hulls: int | None = None

    @classmethod
    def parse(cls, base: str, formats: str, drives: str, hulls: int | None = None) -> ExportOptions:
        """Parse the option values. Raise OptionError, which lists the valid ones."""
        if base not in set(Base):
            raise OptionError(f"--base: found {base!r}; valid are {', '.join(Base)}")
        if drives not in set(Driven):
            raise OptionError(f"--drives: found {drives!r}; valid are {', '.join(Driven)}")
        if hulls is not None and hulls < 1:
            raise OptionError(f"--hulls: found {hulls}; valid is 1 or more")
        return cls(Base(base), parse_formats(formats), Driven(drives), hulls)

    @classmethod
    def of(cls, record: Mapping[str, Any]) -> ExportOptions:
        """Return how an asset was written. record: its asset.json, which may be empty.

        Raise OptionError for a value that no asset has.
        """
        formats = tuple(f for f in Format if f in record.get("files", {})) or DEFAULT
        base, drives = (str(record.get(name, usual)) for name, usual in (("base", Base.FIXED), ("drives", Driven.PASSIVE)))
        hulls = record.get("hulls")
        return cls.parse(base, ",".join(formats), drives, hulls if isinstance(hulls, int) else None)

    def with_formats(self, others: tuple[Format, ...]) -> ExportOptions:
        """Return the options with further formats."""
        return replace(self, formats=tuple(f for f in Format if f in self.formats or f in others))
