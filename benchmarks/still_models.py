"""Count the parts that are found on real models of which nothing moves, which nothing was trained or tuned on.

python -m benchmarks.still_models WORK    writes still_models.md

Furniture of Sweet Home 3D (Debian package `sweethome3d`) without openings, chosen by its pictures in the catalogue: nothing on
it is meant to move. Left out are models with taps, lids, cords, drawers, swivels or loose things that the file does not mark.
WORK: a folder for objects and results, as for `benchmarks/held_out.py`.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path

from anymesh.evaluation.datasets.sweethome3d import SweetHome3D
from anymesh.evaluation.record import Record
from benchmarks.held_out import measure

STILL = (
    "armchair armchair2 bath bed bed140x190 bed90x190 bedsideTable bookcase bunkBed90x190 chair chair2 coffeeTable "
    "cornerBunkBed90x190 cornerSofa crib curveStaircase doorFrame electricRadiator fireplace fixedTriangleWindow85x85 "
    "fixedWindow85x123 floorUplight flowers frame halfRoundWindow hood hotWaterRadiator lamp loftBed140x190 pendantLamp plant "
    "railing roundDoorFrame roundTable roundWindow serviceHatch sofa sofa2 spiralStaircase squareTable staircase stool table "
    "wallUplight"
).split()
URDF = """<robot name="{0}"><link name="base"><visual><origin rpy="1.5707963267948966 0 0" xyz="0 0 0"/>
<geometry><mesh filename="{0}.glb"/></geometry></visual></link></robot>
"""  # the models are y-up
HERE = Path(__file__).parent


def write_objects(folder: Path) -> list[str]:
    """Write each model as a GLB file and a URDF file of one link, and return their names as objects of a data set."""
    models = SweetHome3D()
    for name in STILL:
        (folder / name).mkdir(parents=True, exist_ok=True)
        models.truth(name, folder / name)
        (folder / name / f"{name}.urdf").write_text(URDF.format(name))
    return [f"{name}-{name}" for name in STILL]


def page(records: Sequence[Record]) -> str:
    """Return the text of still_models.md."""
    found = [(r.score.name.split("-")[0], r.score.predicted) for r in records]
    with_parts = [(name, count) for name, count in found if count]
    return "\n".join([
        "# Parts found where nothing moves", "",
        f"`python -m benchmarks.still_models WORK`: {len(found)} models of Sweet Home 3D's furniture of which nothing moves,",
        "by geometry alone, without names. Nothing is trained on them;",
        "still kinds for the training were chosen with this page in view.", "",
        f"On {len(found) - len(with_parts)} of them no part is found; on the others {sum(c for _, c in with_parts)}:", "",
        ", ".join(name + (f" ({count})" if count > 1 else "") for name, count in with_parts) + ".", "",
    ])  # fmt: skip


def main() -> None:
    parser = argparse.ArgumentParser(description="Parts that are found where nothing moves.")
    parser.add_argument("work", type=Path, metavar="WORK")
    work = parser.parse_args().work
    text = page(measure(work, write_objects(work / "real"), "end-to-end", dataset="static:real"))
    (HERE / "still_models.md").write_text(text)
    print(text)


if __name__ == "__main__":
    main()
