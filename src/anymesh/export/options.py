"""Export settings, parsed from command line options."""

from __future__ import annotations

from dataclasses import dataclass

from anymesh.errors import OptionError
from anymesh.export import Base, Driven, Format, parse_formats


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
