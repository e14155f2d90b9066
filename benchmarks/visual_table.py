"""The page of results from recorded answers: by protocol and set, by object, by setting."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import groupby
from statistics import fmean, median

from benchmarks.visual_replay import VARIANTS, Row

HEAD = """# The visual method, with recorded answers

{how}

Each question was answered once, from its text and pictures alone, through `--answerer files:FOLDER`, by a general model that
accepts pictures and files; no paid API was called. The questions contain neither names nor the ground truth, and objects are
identified by numbers. The answerer knew which data sets are used and recognized a few of them. It answered questions with
equal keys together, and a few kinds of motion from the text before it saw the picture. The questions about motions, which
show other motions in another order since motions are ranked by the learned score, were later answered again, for all
objects, by the same kind of model, which was given one question after another and nothing else. It was told, beyond the text
of the questions, to look at every picture, to compare all motions, and how common parts work: buttons are pressed in,
drawers are pulled out, knobs turn about their own middle, a handle is opposite the hinge. All questions about 25 objects (001,
007, 008, 010 to 014, 021, 023 to 025, 028, 030, 032, 034, 037, 039, 040, 049, 054, 062, 064, 066, 071) were answered anew in
the same way when their surfaces, and with them regions and pictures, were found otherwise; for nine of them the kinds of some
joints were answered before the picture was seen.

Recall: true movable parts found with an IoU of .5 or more. mIoU: over the true parts, 0 for a part that was not found. For
joints that were found: type (turns or slides, as the true joint does), exact type (revolute and continuous distinguished),
angle, position at the part (the diagonal is 2), whether positive opens. Calls: questions answered, mean over objects.
{seconds}
"""
REPLAYED = {
    "how": "`python -m benchmarks.visual table --ablation --place SET=PLACE ...` replays `benchmarks/recordings/`: no model, "
    "no network.",
    "seconds": "Seconds: of the tool, without the answerer, cold, median over objects.",
}
MEASURED = {
    "how": "Scores at the time of the recording: `python -m benchmarks.visual scores FOLDER`, after `ask`. `python "
    "benchmarks/visual.py table --place SET=PLACE ...` replays the recordings in `benchmarks/recordings/` without a model.",
    "seconds": "Seconds include the wait for answers, with up to twelve objects at a time.",
}
COLUMNS = ("objects", "joints", "recall", "mIoU", "type", "exact type", "angle [deg]", "at the part", "opens", "calls", "s")


def page(rows: Sequence[Row], about: dict[str, str] = REPLAYED) -> str:
    """The whole page, as Markdown. about: how the figures were made, REPLAYED or MEASURED."""
    lines = [HEAD.format(**about)]
    for protocol in dict.fromkeys(r.protocol for r in rows):
        own = [r for r in rows if r.protocol == protocol]
        first = [r for r in own if r.variant == VARIANTS[0]]
        sets = _grouped(first, lambda r: r.set)
        lines += [f"## {protocol}", "", *_table("set", [*sets, ("all", first)])]
        variants = _grouped(own, lambda r: r.variant)
        if len(variants) > 1:
            lines += [f"### {protocol}: the same answers with other settings", "", ABLATION, "", *_table("setting", variants)]
    for protocol in dict.fromkeys(r.protocol for r in rows):
        own = [r for r in rows if r.protocol == protocol and r.variant == VARIANTS[0]]
        lines += [f"## Objects, {protocol}", "", *_table("object", [(f"{r.number} {r.set} {_name(r)}", [r]) for r in own])]
    failed = [r for r in rows if r.record.error]
    if failed:
        lines += ["## Not done", "", *(f"- {r.variant}, {r.number} {r.protocol}: {r.record.error}" for r in failed), ""]
    return "\n".join(lines)


ABLATION = (
    "A question that these settings ask in another form has no recorded answer. It is answered from the result of the "
    "recording, by the marks, points and motions that are shown. So the rows measure the loss due to the settings, not the "
    "results that an answerer would reach with them."
)


def _name(row: Row) -> str:
    change = row.record.change
    return row.record.score.name + ("" if change == "none" else f" ({change})")


def _grouped(rows: Sequence[Row], key: Callable[[Row], str]) -> list[tuple[str, list[Row]]]:
    order = list(dict.fromkeys(map(key, rows)))
    return [(name, list(some)) for name, some in groupby(sorted(rows, key=lambda r: order.index(key(r))), key)]


def _table(first: str, groups: Sequence[tuple[str, Sequence[Row]]]) -> list[str]:
    head = [f"| {' | '.join((first, *COLUMNS))} |", f"|{'---|' * (len(COLUMNS) + 1)}"]
    return [*head, *(f"| {' | '.join((name, *_figures(rows)))} |" for name, rows in groups if rows), ""]


def _figures(rows: Sequence[Row]) -> list[str]:
    scores = [r.record.score for r in rows]
    joints = [j for s in scores for j in s.joints]
    found = [j for j in joints if j.type_found is not None]
    turning = [j.at_part for j in found if j.at_part is not None]
    parts = sum(s.true for s in scores)
    return [
        str(len(rows)),
        str(len(joints)),
        _share(sum(s.matched for s in scores), parts),
        _share(sum(s.part_miou * s.true for s in scores), parts),
        _share(sum(j.type_right for j in found), len(found)),
        _share(sum(j.type_found == j.type_true for j in found), len(found)),
        f"{fmean(j.angle or 0.0 for j in found):.2f}" if found else "",
        f"{fmean(turning):.4f}" if turning else "",
        _share(sum(j.opens_right is True for j in found), sum(j.opens_right is not None for j in found)),
        f"{fmean(r.calls for r in rows):.1f}",
        f"{median(r.record.seconds for r in rows):.0f}",
    ]


def _share(part: float, whole: int) -> str:
    return f"{part / whole:.3f}" if whole else ""
