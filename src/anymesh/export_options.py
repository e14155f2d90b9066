"""How an asset is written, from the words of the options."""

from __future__ import annotations

from dataclasses import dataclass

from anymesh.errors import OptionError
from anymesh.export import Base, Driven, Format, parse_formats


@dataclass(frozen=True)
class ExportOptions:
    """How an asset is written."""

    base: Base
    formats: tuple[Format, ...]
    driven: Driven

    @classmethod
    def parse(cls, base: str, formats: str, drives: str) -> ExportOptions:
        """From the words of an option; OptionError names what would have been valid."""
        if base not in set(Base):
            raise OptionError(f"--base: found {base!r}; valid are {', '.join(Base)}")
        if drives not in set(Driven):
            raise OptionError(f"--drives: found {drives!r}; valid are {', '.join(Driven)}")
        return cls(Base(base), parse_formats(formats), Driven(drives))
