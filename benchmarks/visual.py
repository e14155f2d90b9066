"""The visual method with an answerer that sees, over many objects: asks, keeps the answers, and replays them for the tables.

python -m benchmarks.visual ask FOLDER --place infinigen=DIR --wait --jobs 4    asks, in FOLDER/NNN/PROTOCOL/, to the end
python -m benchmarks.visual keep FOLDER                                         answers to benchmarks/recordings/, no pictures
python -m benchmarks.visual changed FOLDER --against REVISION                   a table of what was done anew, and calls before
python -m benchmarks.visual table --place infinigen=DIR                         reports/visual.md, from the recordings alone

Objects have numbers in the folders of questions, as their names would show what they are (`recordings/objects.json`), and what
is known of the truth lies beside, in FOLDER.results/. The parts are given only once the object was answered without them.
Without --wait, `ask` goes as far as it can, ends with exit code 9 while questions are open, and goes on when called again.
"""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from multiprocessing import get_context
from pathlib import Path
from statistics import fmean

from anymesh.errors import AnymeshError, OpenQuestionError
from anymesh.evaluation.datasets.named import open_dataset
from anymesh.evaluation.evaluate_sample import EvalConfig, EvalProtocol, evaluate_sample
from anymesh.evaluation.record import Record, record_of, record_text
from anymesh.evaluation.score import ObjectScore
from anymesh.pipeline.answering import choose_answerer
from anymesh.pipeline.solving import solve
from anymesh.prompted.answerers.file_answerer import open_questions
from anymesh.prompted.answerers.question_files import ANSWER, OWNER, QUESTION, find_questions
from anymesh.prompted.models.budget import max_picture_tokens
from anymesh.types.questions import VisualAnswerer
from benchmarks import RECORDINGS, REPORTS, parser_of, table_head, table_row
from benchmarks.visual_choices import FILE as CHOICES
from benchmarks.visual_choices import choices_of, replayed, write_choices

PROTOCOLS = (EvalProtocol.END_TO_END, EvalProtocol.PARTS)
FORMS = {"as it is": "none", "fused": "fused"}
RECORD = "record.json"
AGAIN = "027"  # answered more than once end to end; its 12 parts weigh much in the totals, which are told without it as well
HEAD = """# The visual method, with recorded answers

`python -m benchmarks.visual table --place SET=PLACE ...` replays `benchmarks/recordings/` and writes this page: no model, no
network. [Before and after](visual_changes.md) the questions took their present form, and aircraft.

Each question was answered from its text and pictures alone, through `--answerer files:FOLDER`, by general models that accept
pictures and files; no paid API was called. The questions contain neither names nor the ground truth, and objects are identified
by numbers. Kinds and motions are one question, and joints that geometry is sure of are not asked about (`--ask unsure`).

The answerers knew which data sets are used and recognized a few objects. Those of the first 97 recordings had read an earlier
page, with names, results and numbers of joints, and scores of other objects; those of the others, now all with parts given, its
words, but no table. These words told what had been answered wrongly about 001, 024 and 027 (a lever that swivels, a hinge at
the bottom, a door that slides), so that the answers about them with parts given cannot be called independent.

End to end, 001, 024, 027 and 051 were answered anew from the pictures, by a general model that had seen no truth, and no row
or earlier answer of theirs. It had read the same words, and that nine keys of 027 had been left out, so these answers are not
wholly independent either; two go against the words (the door of 024 at its left, that of 027 swinging), and the keys are
plain in the pictures. 027 was answered for the third time: its 12 parts are found now, but its door, which slides, and two
round buttons, answered as knobs, have a wrong type.

020 and 042 with parts given are not in the tables: nothing is asked about them. Nor are 019 and 056, which have no parts.

Recall: true movable parts found with an IoU of .5 or more. mIoU: over the true parts, 0 for a part that was not found. For
joints that were found: type (turns or slides, as the true joint does), exact type (revolute and continuous distinguished),
angle, position at the part (the diagonal is 2), whether positive opens. Calls: questions answered, mean over objects.
A question that shows other motions than the recorded one, or in other words, since another classifier ranks them and pushes
are shown now, is answered by the recorded choice if that motion is shown, else by "none of these" (`visual_choices.py`).
"""
COLUMNS = ("objects", "joints", "recall", "mIoU", "type", "exact type", "angle [deg]", "at the part", "opens", "calls")


@dataclass(frozen=True)
class Item:
    """One object of the list. number: its folder; spec: of its data set, as for `anymesh eval`; change: of its mesh."""

    number: str
    set: str
    spec: str
    object: str
    change: str


@dataclass(frozen=True)
class Row:
    """The result of one object. calls: questions that were answered."""

    number: str
    set: str
    protocol: EvalProtocol
    record: Record
    calls: int

    @property
    def title(self) -> str:
        change = self.record.change
        return f"{self.number} {self.set} {self.record.score.name}" + ("" if change == "none" else f" ({change})")

    def summary(self) -> str:
        """Return one line about the result."""
        score, error = self.record.score, self.record.error
        what = error or f"{score.matched} of {score.true} parts, {self.calls} calls, {self.record.seconds:.0f} s"
        return f"{self.title}, {self.protocol}: {what}"


def items(places: dict[str, str], only: Sequence[str]) -> list[Item]:
    """The objects of the list whose data sets have a place, where they need one; the others are named on standard error."""
    listed = json.loads((RECORDINGS / "objects.json").read_text(encoding="utf-8"))
    found, lacking = [], set()
    for entry in listed["objects"]:
        name, needs = entry["set"], listed["sets"][entry["set"]]
        if needs["place"] and name not in places:
            lacking.add(name)
            continue
        spec = f"{needs['dataset']}:{places[name]}" if name in places else needs["dataset"]
        if not only or entry["number"] in only:
            found.append(Item(entry["number"], name, spec, entry["object"], FORMS[entry["form"]]))
    if lacking:
        print(f"left out, as no --place SET=DIR names them: {', '.join(sorted(lacking))}", file=sys.stderr)
    return found


def results_of(folder: Path) -> Path:
    """Where the scores of a folder of questions lie."""
    return folder.with_name(f"{folder.name}.results")


def ask(item: Item, protocol: EvalProtocol, folder: Path, wait: bool, after: EvalProtocol | None = None) -> str:
    """Ask until an answer is missing, or wait for answers; return a line about the state. after: the protocol before it."""
    place, results = folder / item.number / protocol, results_of(folder) / item.number / protocol
    title = f"{item.number} {protocol}"
    if (results / RECORD).exists():
        return f"{title}: done before"
    if after is not None and not (results.parent / after / RECORD).exists():
        return f"{title}: comes after {after}"
    waiting = [] if wait else open_questions(find_questions(place))
    if waiting:
        return f"{title}: open {', '.join(str(q.path) for q in waiting)}"
    results.mkdir(parents=True, exist_ok=True)
    setting = EvalConfig(protocol, (item.change,))

    def answerer_factory(_: object) -> Callable[[VisualAnswerer], VisualAnswerer]:
        return choose_answerer({"answerer": f"files:{place}", "wait": wait}, about=item.number).factory

    try:
        (record,) = evaluate_sample(setting, open_dataset(item.spec), item.object, results, solve, answerer_factory)
    except OpenQuestionError as error:
        return f"{title}: open {', '.join(str(f) for f in error.folders)}"
    if record.error:
        return f"{title}: failed, {record.error}"
    (results / RECORD).write_text(record_text(record), encoding="utf-8")
    return f"{title}: done"


def keep(folder: Path) -> None:
    """Copies what was asked and answered, without pictures, where an object is done."""
    for done in sorted(results_of(folder).glob(f"*/*/{RECORD}")):
        asked = folder / done.parent.relative_to(results_of(folder))
        place = RECORDINGS / asked.relative_to(folder)
        shutil.rmtree(place, ignore_errors=True)
        answered = [q for q in find_questions(asked) if not q.outdated and q.answer() is not None]
        if not answered:
            continue  # nothing moves, so nothing was asked
        for question in answered:
            (place / question.path.name).mkdir(parents=True)
            for name in (QUESTION, ANSWER):
                shutil.copyfile(question.path / name, place / question.path.name / name)
        write_choices(place / CHOICES, choices_of(answered))
        shutil.copyfile(asked / OWNER, place / OWNER)
        print(f"kept {place.relative_to(RECORDINGS)}: {record_of(done.read_text(encoding='utf-8')).score.name}")


def changed(folder: Path, revision: str) -> str:
    """Return a table of the objects that are done in a folder, with calls and pictures as recorded at a revision.

    Tokens: of the input, as `openai:gpt-4o` counts its pictures, with four bytes of text per token.
    """
    names = "joints|calls before|after|pictures before|after|tokens in|recall|type|angle [deg]|mIoU".split("|")
    lines, counts, scores = table_head(["object", *names]), [], []
    for done in sorted(results_of(folder).glob(f"*/{EvalProtocol.END_TO_END}/{RECORD}")):
        number, record = done.parent.parent.name, record_of(done.read_text(encoding="utf-8"))
        asked = [q for q in find_questions(folder / number / EvalProtocol.END_TO_END) if q.answer() and not q.outdated]
        before = _pictures_at(revision, number)
        tokens = sum(max_picture_tokens("openai", "gpt-4o", *picture.size) for q in asked for picture in q.pictures()) + sum(
            len(str(q.record[name])) // 4 for q in asked for name in ("system", "text", "schema")
        )
        counts.append((len(before), len(asked), sum(before), sum(len(q.pictures()) for q in asked), tokens))
        scores.append(record.score)
        lines.append(table_row([f"{number} {record.score.name}", *_changed([counts[-1]], [record.score])]))
    return "\n".join([*lines, table_row(["all", *_changed(counts, scores)]), ""])


def _changed(counts: Sequence[tuple[int, ...]], scores: Sequence[ObjectScore]) -> list[str]:
    joints = [j for s in scores for j in s.joints]
    found = [j for j in joints if j.type_found is not None]
    true = sum(s.true for s in scores)
    means = [fmean(column) for column in zip(*counts, strict=True)]
    return [
        str(len(joints)),
        *(f"{mean:.0f}" if len(counts) == 1 or mean > 1000 else f"{mean:.1f}" for mean in means),
        _share(sum(s.matched for s in scores), true),
        _share(sum(j.type_right for j in found), len(found)),
        f"{fmean(j.angle or 0.0 for j in found):.2f}" if found else "",
        _share(sum(s.part_miou * s.true for s in scores), true),
    ]


def _pictures_at(revision: str, number: str) -> list[int]:
    """Return the number of pictures of each question of an object's recording at a revision."""
    place = (RECORDINGS / number / EvalProtocol.END_TO_END).relative_to(RECORDINGS.parents[1]).as_posix()

    def git(*words: str) -> str:
        return subprocess.run(["git", *words], cwd=RECORDINGS.parents[1], capture_output=True, text=True, check=True).stdout

    names = [n for n in git("ls-tree", "-r", "--name-only", revision, place).split() if n.endswith(QUESTION)]
    return [len(json.loads(git("show", f"{revision}:{name}"))["pictures"]) for name in names]


def row_of(item: Item, protocol: EvalProtocol) -> Row:
    """Answer one object from its recording."""
    folder, setting = RECORDINGS / item.number / protocol, EvalConfig(protocol, (item.change,))
    return Row(item.number, item.set, protocol, *replayed(folder, setting, open_dataset(item.spec), item.object))


def table(found: Sequence[tuple[Item, EvalProtocol]], jobs: int, out: Path) -> None:
    """Answer all objects from their recordings; the page is written after each, so that a stopped run leaves one."""
    rows: list[Row] = []
    for row in _each(row_of, found, jobs):
        rows.append(row)
        print(row.summary(), flush=True)
        out.write_text(page(rows), encoding="utf-8")
    print(f"wrote {out}")


def page(rows: Sequence[Row]) -> str:
    """Return the whole page: by protocol and set, then by object."""
    lines = [HEAD]
    protocols = {p: [r for r in rows if r.protocol == p] for p in dict.fromkeys(r.protocol for r in rows)}
    for protocol, own in protocols.items():
        sets = [(name, [r for r in own if r.set == name]) for name in dict.fromkeys(r.set for r in own)]
        without = [r for r in own if r.number != AGAIN]
        lines += [f"## {protocol}", "", *_table("set", [*sets, ("all", own), (f"all but {AGAIN}", without)])]
    for protocol, own in protocols.items():
        lines += [f"## Objects, {protocol}", "", *_table("object", [(r.title, [r]) for r in own])]
    failed = [r for r in rows if r.record.error]
    if failed:
        lines += ["## Not done", "", *(f"- {r.number} {r.protocol}: {r.record.error}" for r in failed), ""]
    return "\n".join(lines)


def _table(first: str, groups: Sequence[tuple[str, Sequence[Row]]]) -> list[str]:
    return [*table_head([first, *COLUMNS]), *(table_row([name, *_figures(rows)]) for name, rows in groups if rows), ""]


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
    ]


def _share(part: float, whole: int) -> str:
    return f"{part / whole:.3f}" if whole else ""


def _each(work, tasks: Sequence[tuple], jobs: int) -> Iterator:
    """Yield the results in the order of the tasks."""
    if jobs == 1:
        yield from (work(*task) for task in tasks)
        return
    with ProcessPoolExecutor(jobs, get_context("spawn")) as pool:
        yield from pool.map(work, *zip(*tasks, strict=True)) if tasks else ()


def main() -> None:
    parser = parser_of(__doc__)
    parser.add_argument("what", choices=("ask", "keep", "changed", "table"))
    parser.add_argument("--against", default="HEAD", help="for changed: a revision with the recordings before")
    parser.add_argument("folder", nargs="?", type=Path, help="of questions; not for table")
    parser.add_argument("--place", action="append", default=[], metavar="SET=PLACE", help="where a data set lies; may repeat")
    parser.add_argument("--only", default="", metavar="NUMBERS", help="of objects, with commas between")
    parser.add_argument("--protocol", choices=[str(p) for p in PROTOCOLS], help="one alone")
    parser.add_argument("--wait", action="store_true", help="wait for answers")
    parser.add_argument("--jobs", type=int, default=1, help="objects at a time")
    parser.add_argument("--markdown", type=Path, default=REPORTS / "visual.md")
    options = parser.parse_args()
    if options.folder is None and options.what != "table":
        parser.error("name the folder of questions")
    found = items(dict(p.partition("=")[::2] for p in options.place), [n for n in options.only.split(",") if n])
    protocols = [p for p in PROTOCOLS if options.protocol in (None, p)]
    if options.what == "keep":
        keep(options.folder)
    elif options.what == "changed":
        print(changed(options.folder, options.against))
    elif options.what == "table":
        recorded = [(i, p) for i in found for p in protocols if (RECORDINGS / i.number / p).is_dir()]
        table(recorded, options.jobs, options.markdown)
    else:
        after = {EvalProtocol.PARTS: EvalProtocol.END_TO_END} if len(protocols) > 1 else {}
        tasks = [(i, p, options.folder, options.wait, after.get(p)) for p in protocols for i in found]
        lines = []
        for line in _each(ask, tasks, options.jobs):
            lines.append(line)
            print(line, flush=True)
        raise SystemExit(9 if any(": open " in line or ": comes after " in line for line in lines) else 0)


if __name__ == "__main__":
    try:
        main()
    except AnymeshError as error:
        raise SystemExit(f"{error}") from None
