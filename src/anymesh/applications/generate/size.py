"""Size of a generated object, since generators use units of their own."""

from __future__ import annotations

from dataclasses import dataclass

from anymesh.applications.generate.protocol import Unit
from anymesh.loading.load import usual_size

ADVICE = "give --scale METRES:AXIS, such as 0.9:z"


@dataclass(frozen=True)
class Size:
    """Values of --scale and --category for the pipeline, with the reason in words; warning: if the size is unknown."""

    scale: str
    category: str | None
    reason: str
    warning: str = ""


def choose_size(scale: str, category: str | None, prompt: str | None, name: str, unit: Unit) -> Size:
    """Return the given size, else the usual size of the kind of object named by the category, the prompt or the file name.

    Units that are stated or estimated are kept if they suit the kind (within a factor of 3) or no kind is known.
    """
    kind = usual_size(category or prompt or name)
    known = category or prompt or (None if kind is None else kind[0].replace("_", " "))
    if unit is Unit.STATED:
        known = category or prompt  # a unit in the file takes precedence over the file's name
    if scale != "auto":
        return Size(scale, known, f"given as {scale}")
    if kind is not None:
        usual = f"a {kind[0].replace('_', ' ')} is about {kind[1]:g} m long"
        if unit is Unit.ARBITRARY:
            return Size(f"{kind[1]:g}:longest", known, f"{usual}; the generator gives no size")
        if known is None:
            return Size("auto", None, "as the mesh file states it")
        source = "the generator estimates" if unit is Unit.ESTIMATED else "the mesh file states"
        return Size("auto", known, f"as {source} it, where that suits the kind ({usual})")
    if unit is Unit.ESTIMATED:
        return Size("auto", known, "as the generator estimated it")
    return Size("auto", known, "as the mesh file states it", f"the size of the object is not known; {ADVICE}")
