"""Tools for agents, as plain functions with JSON values, and pictures."""

from __future__ import annotations

import json
import threading
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path
from typing import Any

from anymesh import pipeline
from anymesh.checking import check_asset
from anymesh.correcting import CorrectionError, EditableAsset, History, corrections_of, open_asset, ranked_motions
from anymesh.correcting.editable import now
from anymesh.correcting.history import pack_entry, unpack_log
from anymesh.correcting.listing import motion_rows, named_part, region_rows
from anymesh.errors import InputError, OptionError, OutputError
from anymesh.pipeline.atomic_folder import locks_known
from anymesh.pipeline.options import FILES
from anymesh.prompted.answerers.file_answerer import Recorded, open_in, open_questions, record_answers
from anymesh.prompted.answerers.question_files import (
    POLL,
    QuestionFolder,
    QuestionStore,
    find_questions,
    is_occupied,
    read_question,
)
from anymesh.runtime import DEFAULT_SECONDS, Progress, read_json, silent
from anymesh.types import Brief
from anymesh.viewer.intake.work import ArticulationWork

AUTHOR = "agent"  # in the log of corrections
QUESTIONS = ".questions"  # suffix of the folder with an output's questions, beside the output
ANSWERERS = ("files", "geometry")  # only answerers that cost nothing
MAX_WAITING = 3  # runs that wait at a time; an estimate, of a few hundred megabytes each
MAX_IDLE = 3600.0  # [s] after which a run that waits is ended; an estimate
SHEET_FROM = 5  # number of pictures from which they are shown as one sheet by default


class Places:
    """Allowed folders, with resolved links. Raises InputError for one that does not exist."""

    def __init__(self, folders: Sequence[str | Path]) -> None:
        if not folders:
            raise OptionError("name at least one folder that the tools may work in")
        for folder in folders:
            if not Path(folder).is_dir():
                raise InputError(f"{folder} is not a folder")
        self.folders = tuple(Path(folder).resolve() for folder in folders)

    def inside(self, path: str, *, below: bool = False) -> Path:
        """Resolve a path relative to the first folder, following links. Raise OptionError if it is outside all folders.

        below: the path must not be one of the folders themselves, since files are written beside it.
        """
        try:
            resolved = (self.folders[0] / path).resolve()
        except (OSError, RuntimeError, ValueError):  # a cycle of links, a null byte
            raise OptionError(f"{path!r} is not a path") from None
        if not any(resolved.is_relative_to(folder) for folder in self.folders):
            raise OptionError(f"{path!r} lies outside of the folders of this server: {', '.join(map(str, self.folders))}")

        if below and not any(resolved.parent.is_relative_to(folder) for folder in self.folders):
            raise OptionError(f"{path!r} is the whole folder of this server; name a folder in it")
        return resolved

    def shown(self, path: Path) -> str:
        """Return a path in the form that `inside` accepts: relative to the first folder if it is there."""
        first = self.folders[0]
        return path.relative_to(first).as_posix() if path.is_relative_to(first) else str(path)


@dataclass(frozen=True)
class ToolResult(Brief):
    """Result of a tool: JSON values, and PNG pictures with captions."""

    record: dict[str, Any]
    pictures: tuple[tuple[str, bytes], ...] = ()


@dataclass(eq=False)
class _WaitingRun:
    """A run in a child process. made_with: its options and the digest of its mesh; read: answers it has read, by question."""

    work: ArticulationWork
    made_with: Mapping[str, Any]
    read: dict[Path, str | None]
    timer: threading.Timer | None = None

    def rest(self) -> None:
        """End the run after MAX_IDLE."""
        self.timer = threading.Timer(MAX_IDLE, self.work.cancel)
        self.timer.daemon = True
        self.timer.start()

    def end(self) -> None:
        if self.timer is not None:
            self.timer.cancel()
        self.work.cancel()


class WaitingRuns:
    """Runs that wait for an answer with all their state, each in a child process, by output folder.

    A run ends when its mesh, its options or an answer that it has read changes, after MAX_IDLE, or if MAX_WAITING others were
    used since; its finished stages stay for the next one.
    """

    def __init__(self) -> None:
        self._waiting: dict[Path, _WaitingRun] = {}

    def go_on(
        self, mesh: Path, out: Path, questions: Path, options: Mapping[str, Any], progress: Progress
    ) -> QuestionFolder | None:
        """Start a run, or go on with the one that waits, until a question is open; return None when the asset is written.

        Raise InputError for everything that ends the run early.
        """
        content = mesh.read_bytes() if mesh.is_file() else b""
        made_with, run = {**options, "mesh": mesh, "sha256": sha256(content).hexdigest()}, self._waiting.pop(out, None)
        if run is not None and run.timer is not None:
            run.timer.cancel()
        changed = run is not None and (run.made_with != made_with or any(_answer_in(q) != a for q, a in run.read.items()))
        if run is not None and (changed or run.work.over):
            run.end()
            run = None
        run = run or _WaitingRun(ArticulationWork(mesh, out, **options, wait=True), made_with, {})
        try:
            asked = _followed(run, questions, progress)
        except BaseException:
            run.end()
            raise
        if asked is not None:
            self._waiting[out] = run
            run.rest()
            for path in list(self._waiting)[:-MAX_WAITING]:
                self._waiting.pop(path).end()
        return asked

    def close(self) -> None:
        """End all runs."""
        while self._waiting:
            self._waiting.popitem()[1].end()


def _followed(run: _WaitingRun, questions: Path, progress: Progress) -> QuestionFolder | None:
    told = ("", "")
    while True:
        over, waits = run.work.over, is_occupied(questions) or not locks_known()
        asked = list(QuestionStore(questions).questions()) if waits else []
        waiting = open_questions(asked)
        if waiting and not over:
            run.read = {q.path: q.answer() for q in asked if not q.outdated and q.path != waiting[0].path}
            return waiting[0]
        if over and not run.work.done:
            raise InputError(run.work.error or "the run was ended; call `articulate` again to resume")
        if over:
            return None
        if told != (run.work.stage, run.work.item):
            told = (run.work.stage, run.work.item)
            progress(*told, 0, 1)
        run.work.wait(POLL)


def _answer_in(question: Path) -> str | None:
    asked = read_question(question)
    return None if asked is None else asked.answer()


class AgentTools:
    """The tools for some folders. Input paths are checked, and output paths are valid as input."""

    def __init__(self, places: Places) -> None:
        self._places, self._runs = places, WaitingRuns()

    def close(self) -> None:
        """End the runs that wait for answers."""
        self._runs.close()

    def articulate(
        self,
        mesh: str,
        out: str,
        *,
        answerer: str = ANSWERERS[0],
        parts: str = "auto",
        category: str | None = None,
        up: str = "auto",
        scale: str = "auto",
        mass: float | None = None,
        precision: float | None = None,
        at_least: int = 0,
        formats: str | None = None,
        force: bool = False,
        time_limit: float = DEFAULT_SECONDS,
        answers: Sequence[Mapping[str, Any]] = (),
        progress: Progress = silent,
    ) -> ToolResult:
        """Record answers, then articulate a mesh until its asset is written or a question is open.

        answers: objects with `answer`, and with `question` unless it is the only open one about this mesh.
        """
        source, target = self._places.inside(mesh), self._places.inside(out, below=True)
        if answerer not in ANSWERERS:
            raise OptionError(f"answerer must be one of {', '.join(ANSWERERS)}, found {answerer!r}")
        if parts not in ("auto", "nodes"):
            parts = str(self._places.inside(parts))
        questions = target.parent / f"{target.name}{QUESTIONS}"
        who = f"{FILES}{questions}" if answerer == ANSWERERS[0] else answerer
        options: dict[str, Any] = {
            "answerer": who, "parts": parts, "category": category, "up": up, "scale": scale, "mass": mass,
            "precision": precision, "at_least": at_least, "formats": formats, "force": force, "time_limit": time_limit,
        }  # fmt: skip
        if answers:
            self._record(answers, questions)
        if who == answerer:
            pipeline.articulate(source, target, progress=progress, **options)
        elif (asked := self._runs.go_on(source, target, questions, options, progress)) is not None:
            shown = self._question(asked)
            next_step = "call `articulate` again with the same arguments and answers=[{question, answer}]"
            return ToolResult({"state": "open", "next": next_step, **shown.record}, shown.pictures)
        shown = self.inspect(out)
        made = (read_json(target / "asset.json") or {}).get("answerer")
        return ToolResult({"state": "done", "answerer": made, **shown.record}, shown.pictures)

    def open_questions(self, folder: str | None = None, *, pictures: str = "auto") -> ToolResult:
        """List open questions, the first one with its pictures. pictures: auto, all (each at full size) or none."""
        if pictures not in ("auto", "all", "none"):
            raise OptionError(f"pictures must be auto, all or none, found {pictures!r}")
        roots = self._places.folders if folder is None else (self._places.inside(folder),)
        questions = [q for root in roots for q in (open_in(root) if find_questions(root) else [])]
        if not questions:
            return ToolResult({"open": 0})
        first = self._question(questions[0], pictures)
        others = [self._places.shown(q.path) for q in questions[1:]]
        return ToolResult({"open": len(questions), **first.record, "also_open": others}, first.pictures)

    def answer(self, question: str, answer: Mapping[str, Any] | str) -> ToolResult:
        """Check and write an answer to an open question; a run that waits for it goes on at once."""
        (recorded,) = self._record([{"question": question, "answer": answer}], None)
        answered = self._places.shown(recorded.question.path)
        return ToolResult({"answered": answered, "checked_whole": recorded.whole, "next": "call `articulate` again"})

    def _record(self, answers: Sequence[Mapping[str, Any]], folder: Path | None) -> list[Recorded]:
        """Record all answers or none. folder: of the questions about the mesh, for an answer that names no question."""
        pairs = []
        for given in answers:
            if not isinstance(given, Mapping) or "answer" not in given or not given.keys() <= {"question", "answer"}:
                raise OptionError(f"an answer is an object with `question` and `answer`, found {str(given)[:60]!r}")
            name, answer = given.get("question"), given["answer"]
            place = folder if name is None else self._places.inside(str(name))
            if place is None or (name is not None and not (place / "question.json").is_file()):
                raise OptionError(f"{name!r} is not a question; `open_questions` lists them")
            pairs.append((place, answer if isinstance(answer, str) else json.dumps(answer)))
        return record_answers(pairs)

    def inspect(self, asset: str, *, motions_of: str | None = None, regions_of: str | None = None) -> ToolResult:
        """Return parts, joints, confidence and warnings of an asset, its preview, and a part's motions or regions if asked."""
        folder = self._places.inside(asset)
        record = read_json(folder / "asset.json")
        if record is None:
            raise OutputError(f"{asset!r} holds no asset; `articulate` makes one")
        joints = ("name", "type", "parent", "child", "origin", "axis", "limits", "confidence", "reason")
        parts = ("name", "label", "parent", "confidence", "reason")
        summary: dict[str, Any] = {
            "asset": self._places.shown(folder),
            "parts": [{name: part.get(name) for name in parts} for part in record["parts"]],
            "joints": [{name: joint.get(name) for name in joints} for joint in record["joints"]],
            "proposals": record.get("proposals", []),
            "warnings": record["warnings"],
            "files": record["files"],
            "corrections": len(open_asset(folder).history.done),
        }
        edited = open_asset(folder).history.asset
        if motions_of is not None:
            part = named_part(edited, motions_of)
            motions = ranked_motions(edited, part)
            rows = motion_rows(edited, part, motions)
            summary["motions"] = [row | _packed(m) for row, m in zip(rows, motions, strict=True)]
        if regions_of is not None:
            summary["regions"] = region_rows(edited, regions_of)
        preview = folder / "preview.png"
        pictures = (
            ((f"preview of {asset}: at rest, parts coloured, opened", preview.read_bytes()),) if preview.is_file() else ()
        )
        return ToolResult(summary, pictures)

    def correct(self, asset: str, corrections: Sequence[Mapping[str, Any]]) -> ToolResult:
        """Apply operations or corrections, all or none, and write the asset again; also return what changed.

        Each is an object with `part` and the operations of `anymesh correct`, or a correction as `inspect` lists motions.
        """
        opened = open_asset(self._places.inside(asset, below=True))
        if not corrections:
            raise CorrectionError("found no correction; each is an object such as {'part': 'door', 'flip': true}")
        history = opened.history
        for c in corrections:
            if not isinstance(c, Mapping):
                raise CorrectionError(f"a correction is an object, found {str(c)[:60]!r}")
            history = _corrected(history, c)
        edited = EditableAsset(opened, AUTHOR)
        edited.take(history)
        changed = edited.changes()
        edited.save()
        shown = self.inspect(asset)
        return ToolResult({"changed": changed, **shown.record}, shown.pictures)

    def check(self, asset: str, engines: Sequence[str] = ("mujoco",)) -> ToolResult:
        """Check an asset for use in simulators, and drive every joint."""
        report = check_asset(self._places.inside(asset), engines=engines)
        return ToolResult(report.as_json() | {"path": self._places.shown(self._places.inside(asset))})

    def export(
        self,
        asset: str,
        *,
        formats: str | None = None,
        base: str | None = None,
        drives: str | None = None,
        package: str | None = None,
        archive: str | None = None,
        precision: float | None = None,
        sample: tuple[int, int] = (0, 0),
        progress: Progress = silent,
    ) -> ToolResult:
        """Write the files of an asset anew; what is not given stays as it was.

        package: folder for a ROS 2 package; archive: a zip file; sample: number of variants, and their seed.
        """
        folder = self._places.inside(asset, below=True)
        places = [None if path is None else self._places.inside(path) for path in (package, archive)]
        pipeline.export_asset(
            folder, formats=formats, base=base, drives=drives, package=places[0], archive=places[1], precision=precision,
            sample=sample[0], seed=sample[1], progress=progress,
        )  # fmt: skip
        made = [self._places.shown(path) for path in places if path is not None]
        made += [self._places.shown(folder / "samples")] if sample[0] else []
        return ToolResult(
            {"asset": self._places.shown(folder), "files": (read_json(folder / "asset.json") or {})["files"], "made": made}
        )

    def _question(self, question: QuestionFolder, pictures: str = "auto") -> ToolResult:
        record = {
            "question": self._places.shown(question.path),
            "kind": question.kind,
            "text": question.record["text"],
            "schema": question.schema,
            "refused": question.refusal(),
        }
        single = question.pictures()
        if pictures == "none" or not single:
            return ToolResult(record)
        if pictures == "auto" and len(single) >= SHEET_FROM:
            caption = f"all {len(single)} pictures; `open_questions` with pictures='all' gives each at full size"
            return ToolResult(record, ((caption, (question.path / "sheet.png").read_bytes()),))
        return ToolResult(record, tuple((f"{k}. {p.caption}".strip(), p.png) for k, p in enumerate(single, 1)))


def _corrected(history: History, correction: Mapping[str, Any]) -> History:
    """Apply one object of an agent."""
    if "correction" in correction:
        try:
            return history.do(*unpack_log([{"how": "by numbers", **correction, "time": now(), "author": AUTHOR}]))
        except (TypeError, ValueError) as error:
            raise CorrectionError(f"{str(correction)[:200]} has a value of the wrong kind: {error}") from None
    operations, part = {name: value for name, value in correction.items() if name != "part"}, correction.get("part")
    if not (part is None or isinstance(part, str)):
        raise CorrectionError(f"part is the name of a part or joint, found {str(part)[:60]!r}")
    if operations.pop("undo", False):
        history = history.undo()
    return history.do_all(corrections_of(history.asset, part, operations), now(), AUTHOR)


def _packed(motion: Any) -> dict[str, Any]:
    from anymesh.correcting import HistoryEntry

    record = pack_entry(HistoryEntry(motion, "", ""))
    return {name: value for name, value in record.items() if name not in ("time", "author")}


def skill_text() -> str:
    """Read the shipped skill file."""
    return (Path(__file__).parent / "SKILL.md").read_text(encoding="utf-8")
