"""Export settings, parsed from command line options."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from anymesh.errors import OptionError
from anymesh.export import Base, Driven, Format, parse_formats
from anymesh.export.formats import DEFAULT


@dataclass(frozen=True)
class ExportOptions:
    """Base, formats and drives of an exported asset."""

    base: Base
    formats: tuple[Format, ...]
    driven: Driven

    @classmethod
    def parse(cls, base: str, formats: str, drives: str) -> ExportOptions:
        """Parse the option values. Raise OptionError, which lists the valid ones."""
        if base not in set(Base):
            raise OptionError(f"--base: found {base!r}; valid are {', '.join(Base)}")
        if drives not in set(Driven):
            raise OptionError(f"--drives: found {drives!r}; valid are {', '.join(Driven)}")
        return cls(Base(base), parse_formats(formats), Driven(drives))

    @classmethod
    def of(cls, record: Mapping[str, Any]) -> ExportOptions:
        """Return how an asset was written. record: its asset.json, which may be empty.

        Raise OptionError for a value that no asset has.
        """
        formats = tuple(f for f in Format if f in record.get("files", {})) or DEFAULT
        base, drives = (str(record.get(name, usual)) for name, usual in (("base", Base.FIXED), ("drives", Driven.PASSIVE)))
        return cls.parse(base, ",".join(formats), drives)

    def with_formats(self, others: tuple[Format, ...]) -> ExportOptions:
        """Return the options with further formats."""
        return replace(self, formats=tuple(f for f in Format if f in self.formats or f in others))
