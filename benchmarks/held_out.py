"""Measure parts and joints on the reserved kinds, which nothing is trained on (`kinds.RESERVED`), and on sealed ones.

python -m benchmarks.held_out WORK            all objects: writes held_out.md and the baseline held_out.json
python -m benchmarks.held_out WORK --check    a sample: exit code 1 if a figure is worse than the baseline
python -m benchmarks.held_out WORK --still    real models of which nothing moves: writes still_models.md
python -m benchmarks.held_out WORK --sealed ARTICRAFT [--check]    the sealed kinds of Articraft only, into the same files

The real models are furniture of Sweet Home 3D (Debian package `sweethome3d`) without openings, chosen by its pictures in the
catalogue: nothing on it is meant to move. Left out are models with taps, lids, cords, drawers, swivels or loose things that the
file does not mark. The sealed kinds are chosen by a hash of their names (`splits.use_of`): of them, only sums are printed, and
only `.ci/run` is to open them. WORK: a folder for objects and results; objects that are there are used again, results are
computed anew. ARTICRAFT: a folder of labelled objects.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from anymesh.evaluation.datasets.labelled import LabelledFolder
from anymesh.evaluation.datasets.sweethome3d import SweetHome3D
from anymesh.evaluation.evaluating import evaluate
from anymesh.evaluation.record import Record
from anymesh.evaluation.report import markdown
from anymesh.evaluation.summary import Summary, group_table, summarize
from benchmarks import REPORTS, parser_of, table_head, table_row
from training.error_sources import causes_table, proposed_parts
from training.kinds import registry as kinds
from training.splits import Use, first_of_kinds

SEED, COUNT = 23, 2  # of the objects; COUNT of each kind
SEALED = ("end-to-end", "parts")
STATIC = ("wine_rack", "picnic_table", "barrel")  # reserved kinds of which nothing moves
SAMPLE = sorted(set(kinds.RESERVED) - set(STATIC))[::2]  # kinds whose first object is in the sample
TOLERANCE = 0.05
CHANGES = ("fused", "unseen-gone", "detailed", "furnished", "floored", "misplaced", "tight")
MEASURED = {  # protocol and change of the mesh; changed ones are the first object of each kind
    "end-to-end": ("end-to-end", "none"),
    "parts": ("parts", "none"),
    **{f"end-to-end, {c}": ("end-to-end", c) for c in CHANGES},
}
CHECKED = ("end-to-end", "parts", "end-to-end, detailed")
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
Figures = dict[str, float]
FIGURES: dict[str, Callable[[Summary], float | None]] = {  # larger is better
    "part F1": lambda s: s.part_f1,
    "part mIoU": lambda s: s.part_miou,
    "type": lambda s: s.type_right,
    "opens": lambda s: s.opens_right,
    "right": lambda s: s.success["right"],
}


def objects(work: Path, kind: str, numbers: Sequence[int]) -> list[str]:
    """Write objects of a kind below `work`, unless they are there, and return their names."""
    folder = work / ("static" if kind in STATIC else "moving")
    for number in numbers:
        if not (folder / f"{kind}-{number:02d}").is_dir():
            kinds.write(kind, SEED, number, folder)
    return [f"{kind}-{number:02d}-{kind}-{number:02d}" for number in numbers]  # folder and file, as the data set names them


def measure(
    work: Path, names: Sequence[str], protocol: str, change: str = "none", dataset: str = "urdf:moving"
) -> list[Record]:
    """Evaluate objects by geometry alone. change: of their meshes."""
    form, _, folder = dataset.partition(":")
    out = work / f"{folder}-{protocol}-{change}-{len(names)}"
    return evaluate(
        f"{form}:{work / folder}", out, protocol=protocol, changes=(change,), only=names, answerer="geometry", force=True
    )


def figures(records: Mapping[str, Sequence[Record]]) -> dict[str, Figures]:
    """Return the figures of each protocol, rounded."""
    summaries = {protocol: summarize(some) for protocol, some in records.items()}
    return {
        protocol: {name: round(value, 3) for name, of in FIGURES.items() if (value := of(summary)) is not None}
        for protocol, summary in summaries.items()
    }


def means_over_kinds(groups: Mapping[str, Sequence[tuple[str, Sequence[Record]]]]) -> list[str]:
    """Return lines of a table: the mean over kinds of each figure, by protocol. groups: the records of each kind."""
    lines = table_head(("mean over kinds", *FIGURES))
    for protocol, kinds_of in groups.items():
        summaries = [summarize(some) for _, some in kinds_of]
        known = [[value for s in summaries if (value := of(s)) is not None] for of in FIGURES.values()]
        lines.append(table_row((protocol, *(f"{sum(some) / len(some):.2f}" for some in known))))
    return lines


def worse(found: Mapping[str, Figures], baseline: Mapping[str, Figures]) -> list[str]:
    """Return in words what is worse than the baseline by more than the tolerance, or missing."""
    return [
        f"{protocol}, {name}: {found.get(protocol, {}).get(name)} (baseline {known})"
        for protocol, row in baseline.items()
        for name, known in row.items()
        if found.get(protocol, {}).get(name, 0.0) < known - TOLERANCE
    ]


def check(work: Path) -> int:
    """Compare the sample with the baseline."""
    names = [name for kind in SAMPLE for name in objects(work, kind, [0])]
    found = figures({what: measure(work, names, *MEASURED[what]) for what in CHECKED})
    print(json.dumps(found, indent=1))
    left = worse(found, json.loads((REPORTS / "held_out.json").read_text())["sample"])
    print("\n".join(left) or f"no figure on {len(names)} held-out objects is worse than the baseline by more than {TOLERANCE}")
    return int(bool(left))


def write(work: Path) -> int:
    """Measure all objects, and write the tables and the baseline."""
    moving = [name for kind in kinds.RESERVED if kind not in STATIC for name in objects(work, kind, range(COUNT))]
    still = [name for kind in STATIC for name in objects(work, kind, range(COUNT))]
    records = {
        what: measure(work, moving if change == "none" else moving[::COUNT], protocol, change)
        for what, (protocol, change) in MEASURED.items()
    }
    false = sum(r.score.predicted for r in measure(work, still, "end-to-end", dataset="static:static"))
    sample = {f"{kind}-00-{kind}-00" for kind in SAMPLE}
    baseline = {
        "all": figures(records),
        "sample": figures({what: [r for r in records[what] if r.score.name in sample] for what in CHECKED}),
        "sealed": json.loads((REPORTS / "held_out.json").read_text()).get("sealed", {}),
    }
    (REPORTS / "held_out.json").write_text(json.dumps(baseline, indent=1) + "\n")
    by_kind = {
        protocol: [
            (kind, [r for r in some if r.score.name.startswith(f"{kind}-")]) for kind in kinds.RESERVED if kind not in STATIC
        ]
        for protocol, some in records.items()
    }
    text = [
        "# Kinds that nothing was trained on", "",
        f"`python -m benchmarks.held_out WORK`: {len(moving)} objects of {len(moving) // COUNT} kinds on which",
        "nothing is trained (`kinds.RESERVED`), nameless and without materials, by geometry alone. They were measured",
        "after many changes, so that work was chosen by them: they are a development set now.",
        "`.ci/run` measures a sample and compares it with `held_out.json`.", "",
        "The first object of each kind is also measured with changes to its mesh: `fused`, one closed surface, as from a",
        "scan or a generator; `unseen-gone`, without the faces that cannot be seen from outside; `detailed`, 5 to 60",
        "labels, screws and the like on it; `furnished`, 2 to 16 loose things on it and in it; `floored`, a slab under it;",
        "`misplaced`, every component up to .3 % of the diagonal off; `tight`, parts enlarged until they touch the rest.", "",
        "right: joints of the right type, with the axis within 10 degrees and, level with the part, within .1 of half the",
        "diagonal, that open to the true side.", "",
        f"On {len(still)} objects of {len(STATIC)} kinds of which nothing moves, {false} parts are found.", "",
        *means_over_kinds(by_kind), "",
        SEALED_HEAD, "", *sealed_table(baseline["sealed"]), "",
    ]  # fmt: skip
    for protocol, groups in by_kind.items():
        text += [f"## {protocol}", "", markdown(group_table(protocol, [*groups, ("all", records[protocol])])), ""]
    text += ["## Where the errors come from", "", *_causes(work, by_kind), ""]
    (REPORTS / "held_out.md").write_text("\n".join(text))
    print(json.dumps(baseline, indent=1))
    return 0


SEALED_HEAD = "## Sealed kinds of Articraft"


def sealed_table(found: Mapping[str, Figures]) -> list[str]:
    """Return text and table of the sealed kinds."""
    return [
        "`python -m benchmarks.held_out WORK --sealed ARTICRAFT`: the first two objects of each kind of Articraft-10K that",
        "`splits.use_of` seals by the hash of its name (one in ten). Nothing is trained on them, and they are not looked at:",
        "only sums are printed, and `.ci/run` compares them where ANYMESH_ARTICRAFT names the folder.", "",
        *table_head(("all joints", *FIGURES)),
        *(table_row((what, *(f"{row[name]:.2f}" if name in row else "-" for name in FIGURES))) for what, row in found.items()),
    ]  # fmt: skip


def sealed(work: Path, articraft: Path, compare: bool) -> int:
    """Measure the sealed kinds, and write the sums or compare them with the baseline."""
    names = first_of_kinds(Use.SEALED, LabelledFolder(articraft).objects(), COUNT)
    records = {
        what: evaluate(
            f"labelled:{articraft}", work / f"sealed-{what}", protocol=what, only=names, answerer="geometry", force=True
        )
        for what in SEALED
    }
    found = figures(records)
    print(json.dumps(found, indent=1))
    path, page = REPORTS / "held_out.json", REPORTS / "held_out.md"
    baseline = json.loads(path.read_text())
    if compare:
        left = worse(found, baseline["sealed"])
        print("\n".join(left) or f"no figure on {len(names)} sealed objects is worse by more than {TOLERANCE}")
        return int(bool(left))
    path.write_text(json.dumps({**baseline, "sealed": found}, indent=1) + "\n")
    before, _, rest = page.read_text().partition(f"{SEALED_HEAD}\n")
    after = rest[rest.find("\n## ") + 1 :]
    page.write_text("\n".join([f"{before}{SEALED_HEAD}", "", *sealed_table(found), "", after]))
    return 0


def _causes(work: Path, by_kind: Mapping[str, Sequence[tuple[str, Sequence[Record]]]]) -> list[str]:
    """Return text and table of the causes of errors, end to end, over kinds."""
    spec = f"urdf:{work / 'moving'}"
    groups = [
        (kind, [(found, one, proposed_parts(spec, found.score.name, "")) for found, one in zip(some, given, strict=True)])
        for (kind, some), (_, given) in zip(by_kind["end-to-end"], by_kind["parts"], strict=True)
    ]
    every = [one for _, some in groups for one in some]
    return [
        "Share of joints by the first cause that they are not right, end to end, without fused surfaces. A part is proposed",
        "if a candidate has an IoU over .5 with it, a motion if it is among the candidates with parts given. Wrong context:",
        "right with parts given, not with the parts that were found. Limits are wrong below an IoU of .5.", "",
        *causes_table([*groups, ("all", every)]),
    ]  # fmt: skip


def write_still(folder: Path) -> list[str]:
    """Write each model as a GLB file and a URDF file of one link, and return their names as objects of a data set."""
    models = SweetHome3D()
    for name in STILL:
        (folder / name).mkdir(parents=True, exist_ok=True)
        models.truth(name, folder / name)
        (folder / name / f"{name}.urdf").write_text(URDF.format(name))
    return [f"{name}-{name}" for name in STILL]


def still_page(records: Sequence[Record]) -> str:
    """Return the text of still_models.md."""
    found = [(r.score.name.split("-")[0], r.score.predicted) for r in records]
    with_parts = [(name, count) for name, count in found if count]
    return "\n".join([
        "# Parts found where nothing moves", "",
        f"`python -m benchmarks.held_out WORK --still`: {len(found)} models of Sweet Home 3D's furniture of which nothing",
        "moves, by geometry alone, without names. Nothing is trained on them;",
        "still kinds for the training were chosen with this page in view.", "",
        f"On {len(found) - len(with_parts)} of them no part is found; on the others {sum(c for _, c in with_parts)}:", "",
        ", ".join(name + (f" ({count})" if count > 1 else "") for name, count in with_parts) + ".", "",
    ])  # fmt: skip


def count_still(work: Path) -> int:
    """Measure the models of which nothing moves, and write still_models.md."""
    text = still_page(measure(work, write_still(work / "real"), "end-to-end", dataset="static:real"))
    (REPORTS / "still_models.md").write_text(text)
    print(text)
    return 0


def main() -> int:
    parser = parser_of(__doc__)
    parser.add_argument("work", type=Path, metavar="WORK")
    parser.add_argument("--check", action="store_true", help="a sample, compared with the baseline")
    parser.add_argument("--still", action="store_true", help="real models of which nothing moves")
    parser.add_argument("--sealed", type=Path, metavar="ARTICRAFT", help="the sealed kinds of Articraft")
    options = parser.parse_args()
    if options.sealed:
        return sealed(options.work, options.sealed, options.check)
    return (check if options.check else count_still if options.still else write)(options.work)


if __name__ == "__main__":
    raise SystemExit(main())
