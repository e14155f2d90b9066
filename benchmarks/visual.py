"""The visual method with an answerer that sees, over many objects: asks, keeps the answers, and replays them for the tables.

python -m benchmarks.visual ask FOLDER --place infinigen=DIR --wait --jobs 4    asks, in FOLDER/NNN/PROTOCOL/, to the end
python -m benchmarks.visual keep FOLDER                                         answers to benchmarks/recordings/, no pictures
python -m benchmarks.visual table --place infinigen=DIR [--ablation]            benchmarks/visual.md, from the recordings alone
python -m benchmarks.visual scores FOLDER                                       benchmarks/visual.md, as measured while asking
python -m benchmarks.visual pictures FOLDER --only 001                          recorded questions with their pictures

Objects have numbers in the folders of questions, as their names would show what they are (`recordings/objects.json`), and what
is known of the truth lies beside, in FOLDER.results/. The parts are given only once the object was answered without them.
Without --wait, `ask` goes as far as it can, ends with exit code 9 while questions are open, and goes on when called again.
"""

from __future__ import annotations

import argparse
import json
import shutil
import sys
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from multiprocessing import get_context
from pathlib import Path

from anymesh.errors import AnymeshError, OpenQuestionError
from anymesh.evaluation.datasets.named import open_dataset
from anymesh.evaluation.evaluate_sample import EvalConfig, EvalProtocol, evaluate_sample
from anymesh.evaluation.record import record_of, record_text
from anymesh.pipeline.solving import solve
from anymesh.prompted.answerers.answering import choose_answerer
from anymesh.prompted.answerers.file_answerer import open_questions
from anymesh.prompted.answerers.question_files import ANSWER, OWNER, QUESTION, find_questions
from anymesh.prompted.questions.asking import Answer, Question, VisualAnswerer
from benchmarks.visual_choices import FILE as CHOICES
from benchmarks.visual_choices import Wrapper, choices_of, write_choices
from benchmarks.visual_replay import VARIANTS, Row, replayed
from benchmarks.visual_table import MEASURED, page

HERE = Path(__file__).parent
RECORDINGS = HERE / "recordings"
PROTOCOLS = (EvalProtocol.END_TO_END, EvalProtocol.PARTS)
FORMS = {"as it is": "none", "fused": "fused"}
RECORD = "record.json"


@dataclass(frozen=True)
class Item:
    """One object of the list. number: its folder; spec: of its data set, as for `anymesh eval`; change: of its mesh."""

    number: str
    set: str
    spec: str
    object: str
    change: str


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


def ask(
    item: Item, protocol: EvalProtocol, folder: Path, wait: bool, after: EvalProtocol | None = None,
    answers: Mapping[str, str] | None = None,
) -> str:  # fmt: skip
    """Ask until an answer is missing; return a line about the state.

    wait: for answers; after: the protocol that comes first; answers: recorded ones by the key of their question.
    """
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

    def answerer_factory(_):
        files = choose_answerer({"answerer": f"files:{place}", "wait": wait}, about=item.number).factory
        return files if answers is None else lambda fallback: Recorded(files(fallback), place, answers)

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


def recorded(found: Sequence[Item], protocols: Sequence[EvalProtocol]) -> list[tuple[Item, EvalProtocol]]:
    """What there is a recording of."""
    return [(i, p) for i in found for p in protocols if (RECORDINGS / i.number / p).is_dir()]


def rows_of(item: Item, protocol: EvalProtocol, variants: Sequence[str]) -> list[Row]:
    """Answer one object from its recording, with each of the variants."""
    folder, data = RECORDINGS / item.number / protocol, open_dataset(item.spec)
    return replayed(folder, item.set, data, item.object, item.change, protocol, variants)


def table(found: Sequence[tuple[Item, EvalProtocol]], ablation: bool, jobs: int, out: Path) -> None:
    """Answer all objects from their recordings; the page is written after each, so that a stopped run leaves one."""
    variants = VARIANTS if ablation else VARIANTS[:1]
    rows: list[Row] = []
    for done in _each(rows_of, [(i, p, variants) for i, p in found], jobs):
        rows += done
        print(*(row.summary() for row in done), sep="\n", flush=True)
        out.write_text(page(rows), encoding="utf-8")
    print(f"wrote {out}")


def measured(found: Sequence[Item], folder: Path) -> list[Row]:
    """The objects as they were scored when their last question was answered."""
    rows = []
    for item in found:
        for protocol in PROTOCOLS:
            done = results_of(folder) / item.number / protocol / RECORD
            if done.exists():
                calls = sum(q.answer() is not None for q in find_questions(folder / item.number / protocol) if not q.outdated)
                record = record_of(done.read_text(encoding="utf-8"))
                rows.append(Row(VARIANTS[0], item.number, item.set, protocol, record, calls))
    return rows


def pictures(item: Item, protocol: EvalProtocol, folder: Path) -> str:
    """Asks what was recorded again, so that the pictures are drawn; stops at a question without a recorded answer."""
    place = folder / item.number / protocol
    answers = {q.key: str(q.answer()) for q in find_questions(RECORDINGS / item.number / protocol)}
    line = ask(item, protocol, folder, False, answers=answers)
    asked = find_questions(place)
    return f"{line}; {sum(q.key in answers for q in asked)} of {len(asked)} questions as recorded"


class Recorded(Wrapper):
    """A file answerer whose questions get their recorded answers. answers: texts by key."""

    def __init__(self, files: VisualAnswerer, place: Path, answers: Mapping[str, str]) -> None:
        super().__init__(files)
        self._place, self._answers = place, answers

    def ask(self, question: Question[Answer]) -> Answer:
        """Return the answer in the question's folder or the recorded one. Raise OpenQuestionError if there is neither."""
        try:
            return self.inner.ask(question)
        except OpenQuestionError as error:
            (folder,) = (q for q in find_questions(self._place) if q.path in error.folders)
            if folder.answer() is not None or folder.key not in self._answers:
                raise
            folder.write_answer(self._answers[folder.key])
            return self.inner.ask(question)


def _each(work, tasks: Sequence[tuple], jobs: int) -> Iterator:
    """Yield the results in the order of the tasks."""
    if jobs == 1:
        yield from (work(*task) for task in tasks)
        return
    with ProcessPoolExecutor(jobs, get_context("spawn")) as pool:
        yield from pool.map(work, *zip(*tasks, strict=True)) if tasks else ()


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=("ask", "keep", "scores", "table", "pictures"))
    parser.add_argument("folder", nargs="?", type=Path, help="of questions; not for table")
    parser.add_argument("--place", action="append", default=[], metavar="SET=PLACE", help="where a data set lies; may repeat")
    parser.add_argument("--only", default="", metavar="NUMBERS", help="of objects, with commas between")
    parser.add_argument("--protocol", choices=[str(p) for p in PROTOCOLS], help="one alone")
    parser.add_argument("--wait", action="store_true", help="wait for answers")
    parser.add_argument("--jobs", type=int, default=1, help="objects at a time")
    parser.add_argument("--ablation", action="store_true", help="also --verify off, one view, geometry alone")
    parser.add_argument("--markdown", type=Path, default=HERE / "visual.md")
    options = parser.parse_args()
    if options.folder is None and options.what != "table":
        parser.error("name the folder of questions")
    found = items(dict(p.partition("=")[::2] for p in options.place), [n for n in options.only.split(",") if n])
    protocols = [p for p in PROTOCOLS if options.protocol in (None, p)]
    if options.what == "keep":
        keep(options.folder)
    elif options.what == "scores":
        options.markdown.write_text(page(measured(found, options.folder), MEASURED), encoding="utf-8")
    elif options.what == "table":
        table(recorded(found, protocols), options.ablation, options.jobs, options.markdown)
    elif options.what == "pictures":
        for line in _each(pictures, [(i, p, options.folder) for i, p in recorded(found, protocols)], options.jobs):
            print(line, flush=True)
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
