"""Selection of a generator by its name, as in --generator."""

from __future__ import annotations

from anymesh.applications.generate.command import VALID as COMMAND
from anymesh.applications.generate.command import CommandGenerator
from anymesh.applications.generate.meshy import SHAPE, TEXTURED, MeshyGenerator
from anymesh.applications.generate.protocol import Generator3D
from anymesh.errors import OptionError

PROGRAM = "command:"


def open_generator(name: str, *, time_limit: float = 1800.0, max_calls: int | None = None) -> Generator3D:
    """Return the generator of a name. time_limit: of a program [s]; max_calls: maximum number of paid tasks.

    Makes no request and needs no key. Raise OptionError for a name that is not valid.
    """
    if name in (TEXTURED, SHAPE):
        return MeshyGenerator(textured=name == TEXTURED, max_calls=max_calls)
    if name.startswith(PROGRAM):
        return CommandGenerator.parse(name.removeprefix(PROGRAM), time_limit)
    raise OptionError(f"--generator: found {name!r}; valid are {TEXTURED}, {SHAPE}, {COMMAND}")
