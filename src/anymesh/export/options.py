"""The formats, and the options of an export: what is not given stays as asset.json says."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from enum import StrEnum
from typing import Any

from anymesh.entry_points import PARSE_MECHANISMS, WITH_PROPOSALS, resolve
from anymesh.errors import OptionError
from anymesh.physics.resistance import ResistanceLevel
from anymesh.types import Asset


class Base(StrEnum):
    """Whether the root link is fixed to the world or moves freely in it."""

    FIXED = "fixed"
    FREE = "free"


class Driven(StrEnum):
    """Whether drives leave joints passive, or move them to a commanded position."""

    PASSIVE = "passive"
    POSITION = "position"


class Visuals(StrEnum):
    """Format of the visual meshes that URDF and SDFormat refer to."""

    OBJ = "obj"
    DAE = "dae"


class Shapes(StrEnum):
    """Whether collision shapes may be boxes and cylinders, or are convex meshes alone."""

    PRIMITIVES = "primitives"
    HULLS = "hulls"


class Format(StrEnum):
    """Names of the formats, as used in options."""

    URDF = "urdf"
    MJCF = "mjcf"
    USD = "usd"  # requires the extra
    SDF = "sdf"
    GLB = "glb"
    USDZ = "usdz"  # requires the same extra


class Profile(StrEnum):
    """What is written beside the formats: nothing, or the asset in the form of NVIDIA's SimReady."""

    NONE = "none"
    SIMREADY = "simready"


class TargetProject(StrEnum):
    """Project whose loader gets a folder of its own, beside the formats."""

    NONE = "none"
    ROBOCASA = "robocasa"
    ROBOSUITE = "robosuite"
    MANISKILL = "maniskill"
    ISAACLAB = "isaaclab"
    GENESIS = "genesis"


USUAL_PRECISION = 0.0  # probability from which joints are written where none is asked for; 0: all are
DEFAULT = (Format.URDF, Format.MJCF, Format.SDF, Format.GLB)
GIVEN_MASS = "given_mass"  # name in asset.json of the mass of the whole, where mass is that of the parts
NEEDED = {  # formats that the folder of a target is made of
    TargetProject.ROBOCASA: (Format.MJCF,), TargetProject.ROBOSUITE: (Format.MJCF,), TargetProject.GENESIS: (Format.MJCF,),
    TargetProject.MANISKILL: (Format.URDF,), TargetProject.ISAACLAB: (Format.USD,),
}  # fmt: skip
# least and greatest value of numbers, and how their message ends
NUMBERS = {"mass": (1e-3, 1e6, " kg, or 0 for none given"), "precision": (0.0, 1.0, ": how likely a written joint is right")}
CHOICES: Mapping[str, type[StrEnum]] = {  # options whose values are words
    "base": Base, "drives": Driven, "visuals": Visuals, "shapes": Shapes, "resistance": ResistanceLevel,
    "profile": Profile, "target": TargetProject,
}  # fmt: skip


def parse_formats(text: str) -> tuple[Format, ...]:
    """Return the formats of a comma-separated list, each once, in the order of Format. Raise OptionError for unknown names."""
    asked = {word.strip().lower() for word in text.split(",") if word.strip()}
    unknown = sorted(asked - set(Format))
    if unknown or not asked:
        problem = f"unknown {', '.join(map(repr, unknown))}" if unknown else "none"
        raise OptionError(f"formats {text!r}: {problem}; valid are {', '.join(Format)}, with commas between")
    return tuple(f for f in Format if f in asked)


@dataclass(frozen=True)
class ExportOptions:
    """How an asset is written.

    hulls: maximum number of collision shapes per link, None for no limit; mechanisms: auto, off, all, or LABEL=KIND,...;
    precision: probability of being right from which a joint is written; 0 for all.
    """

    base: Base = Base.FIXED
    formats: tuple[Format, ...] = DEFAULT
    drives: Driven = Driven.PASSIVE
    hulls: int | None = None
    resistance: ResistanceLevel = ResistanceLevel.TYPICAL
    mechanisms: str = "auto"
    visuals: Visuals = Visuals.OBJ
    shapes: Shapes = Shapes.PRIMITIVES
    profile: Profile = Profile.NONE
    target: TargetProject = TargetProject.NONE
    mass: float | None = None  # [kg] of the whole object, None if what it is made of decides
    precision: float = USUAL_PRECISION

    @classmethod
    def parse(cls, given: Mapping[str, Any], *, before: Mapping[str, Any] | None = None) -> ExportOptions:
        """Return the options of which some values are given as text; None stands for one that is not.

        before: the asset.json of the asset as it was written, which may be empty: its values are kept where none is given.
        Raise OptionError, which lists the valid values.
        """
        how = cls() if before is None else cls._of(before)
        values = {k: _value(k, given[k]) for k in (f.name for f in fields(cls)) if given.get(k) is not None}
        how = replace(how, **values)
        how = how.with_formats((Format.USD,)) if how.profile is Profile.SIMREADY else how
        return how.with_formats(NEEDED.get(how.target, ()))

    @classmethod
    def _of(cls, record: Mapping[str, Any]) -> ExportOptions:
        kept: dict[str, Any] = {"precision": 0.0} if record else {}
        kept |= {k: record[k] for k in (f.name for f in fields(cls)) if k in record}
        kept["mass"] = record.get(GIVEN_MASS)
        formats = tuple(f for f in Format if f in record.get("files", {})) or DEFAULT
        return cls.parse({**kept, "formats": ",".join(formats)})

    def record(self) -> dict[str, Any]:
        """Return the values for asset.json but the formats, which its files show; most only if they are not the default."""
        values = {f.name: (getattr(self, f.name), f.default) for f in fields(self) if f.name != "formats"}
        values["precision"] = (self.precision, 0.0)  # as it is without the key
        stated = {k: v for k, (v, usual) in values.items() if k in ("base", "drives", "resistance") or v != usual}
        return {GIVEN_MASS if k == "mass" else k: str(v) if k in CHOICES else v for k, v in stated.items()}

    def written(self, asset: Asset) -> Asset:
        """Return the asset as it is written: joints below the precision are proposals, and their parts are fixed."""
        return resolve(WITH_PROPOSALS)(asset, self.precision) if self.precision else asset

    def with_formats(self, others: tuple[Format, ...]) -> ExportOptions:
        """Return the options with further formats."""
        return replace(self, formats=tuple(f for f in Format if f in self.formats or f in others))


def _number(name: str, given: Any) -> float | None:
    """Return a mass [kg], None for 0, or a precision."""
    least, most, valid = NUMBERS[name]
    if isinstance(given, bool | str) or (given != 0 and not least <= given <= most):
        raise OptionError(f"--{name}: found {given!r}; valid are {least:g} to {most:g}{valid}")
    return float(given) or (None if name == "mass" else 0.0)


def _value(name: str, given: Any) -> Any:
    """Return the value of an option."""
    if name == "formats":
        return parse_formats(given)
    if name == "mechanisms":
        resolve(PARSE_MECHANISMS)(str(given))
        return str(given)
    if name in NUMBERS:
        return _number(name, given)
    if name in CHOICES:
        if given not in list(CHOICES[name]):
            raise OptionError(f"--{name}: found {given!r}; valid are {', '.join(CHOICES[name])}")
        return CHOICES[name](given)
    if isinstance(given, bool) or not isinstance(given, int) or given < 0:
        raise OptionError(f"--{name}: found {given!r}; valid is an integer from 1 up, or 0 for no limit")
    return given or None
