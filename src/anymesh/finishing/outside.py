"""Selection of completers and retexturers by their command line names."""

from __future__ import annotations

from pathlib import Path

from anymesh.errors import OptionError
from anymesh.finishing.bake import Baked
from anymesh.finishing.holopart import HoloPart
from anymesh.finishing.holopart_service import VALID, open_holopart
from anymesh.finishing.meshy import Meshy, check_prompt
from anymesh.finishing.meshy_api import read_key
from anymesh.finishing.protocol import Completer
from anymesh.finishing.retexture import Remote
from anymesh.finishing.texture import Carried, Retexturer

TEXTURES = "builtin, bake, bake:PIXELS, meshy or meshy:PROMPT"


def open_completer(name: str, *, timeout: float = 1800.0) -> Completer | None:
    """Open the completer to use before the built-in one: HoloPart, or None for `builtin` and `off`. timeout: [s].

    Raise OptionError for an invalid name or checkout.
    """
    kind, _, where = name.partition(":")
    if name in ("builtin", "off"):
        return None
    if kind != "holopart":
        raise OptionError(f"--completer: found {name!r}; valid are builtin, off, {VALID}")
    return HoloPart(open_holopart(where, timeout=timeout))


def open_retexturer(
    name: str, *, state: Path, max_calls: int | None = None, max_cost: float | None = None, timeout: float = 60.0
) -> Retexturer:
    """Open the retexturer. state: file that stores the id of a paid task; timeout: [s] of one call.

    Raise OptionError for an invalid name or limit, ModelError without a key.
    """
    kind, colon, rest = name.partition(":")
    match kind:
        case "builtin" if not colon:
            return Carried()
        case "bake" if not colon:
            return Baked()
        case "bake" if rest.isdecimal():
            return Baked(size=int(rest))
        case "meshy" if rest.strip() or not colon:
            if max_cost is not None:
                raise OptionError("--max-cost needs a known price, and Meshy counts in credits: use --max-calls")
            read_key()  # fail now rather than after the shapes
            prompt = check_prompt(rest) if colon else None
            return Remote(Meshy(state, max_calls=max_calls, timeout=timeout), prompt)
        case _:
            raise OptionError(f"--texture: found {name!r}; valid are {TEXTURES}")
