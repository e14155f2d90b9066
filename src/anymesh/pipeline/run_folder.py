"""The output folder. Its file names are defined here alone.

Stages are kept, and an output is either complete or absent. Everything is written into a hidden folder beside the output (on
the same file system), which replaces the output at the end. A process that is killed, or ended by a budget or an internal
defect, leaves at most the hidden folder. The next run takes over its finished stages and removes it.
"""

from __future__ import annotations

import os
import shutil
import time
from collections.abc import Generator, Sequence
from contextlib import contextmanager
from pathlib import Path
from types import TracebackType
from typing import Any, TypeVar

from anymesh.errors import RESUMES, AnymeshError, BudgetError, OpenQuestionError, OutputError, note_stage
from anymesh.export.options import ExportOptions
from anymesh.pipeline.atomic_folder import (
    CORRECTIONS,
    FOLDER_PREFIX,
    MANIFEST,
    LockedFolder,
    atomic_prefix,
    cannot_write,
    check_replaceable,
    check_uncorrected,
    copy_files,
    existing_files,
    is_origin,
    list_files,
    locks_known,
    make_locked_folder,
    move_files,
    recover,
    replace_folder,
    stale_folders,
    write_manifest,
    written_files,
)
from anymesh.pipeline.results import CorrectionResult, RecognitionResult, Record
from anymesh.pipeline.stage_files import (
    COMPLETION,
    CORRECTION,
    JOINTS,
    MESH,
    RECOGNITION,
    REVISION,
    SEGMENTATION,
    STAGES,
    Stage,
    assemble,
    read_stage,
    saved_key,
    stage_files,
    write_stage,
)
from anymesh.runtime import read_json, write_json, writing
from anymesh.types import Asset

Result = TypeVar("Result")
TIMING = "timing.json"
LAST = "asset.json"  # file that marks a finished output


class Saved:
    """The saved stages of an output folder.

    target: its path.
    """

    def __init__(self, target: Path) -> None:
        self.target = target

    @classmethod
    def at(cls, target: Path) -> Saved:
        """Open an existing output. Raise OutputError if there is none."""
        target = Path(target).resolve()
        if written_files(target) is None:
            raise OutputError(f"{target} is not an output of anymesh; `anymesh articulate MESH -o {target}` makes one")
        return Saved(target)

    def _places(self, stage: Stage[Any] | None) -> list[Path]:
        """Return the folders that may hold the result of a stage, or (None) a file that belongs to no stage."""
        return [self.target]

    def need(self, stage: Stage[Result]) -> Result:
        """Return the result of a stage. Raise OutputError if this output has none."""
        saved = self._find(stage)
        if saved is None:
            raise self._missing(stage)
        return saved

    def recognition(self) -> RecognitionResult:
        """Return the recognition result, an empty one if no model was asked."""
        return self._find(RECOGNITION) or RecognitionResult(None, "")

    def _find(self, stage: Stage[Result]) -> Result | None:
        return next((saved for place in self._places(stage) if (saved := read_stage(place, stage, None)) is not None), None)

    def key(self, stage: Stage[Any]) -> str:
        """Return the key of the saved result of a stage. Raise OutputError if this output has none."""
        key = self._key(stage)
        if key is None:
            raise self._missing(stage)
        return key

    def _key(self, stage: Stage[Any]) -> str | None:
        return next((key for place in self._places(stage) if (key := saved_key(place, stage)) is not None), None)

    def _missing(self, stage: Stage[Any]) -> OutputError:
        return OutputError(f"{self.target} has no usable result of the stage {stage.name!r}; run that stage first")

    def timing(self) -> dict[str, float]:
        """Return the seconds per stage."""
        return next((timing for place in self._places(None) if (timing := read_json(place / TIMING)) is not None), {})

    def asset(self, *, edited: bool = True) -> Asset:
        """Assemble the asset from the saved stages.

        edited: with corrections.

        Raise OutputError if a stage is missing.
        """
        last = self.editing()

        def saved(stage: Stage[Result]) -> Result | None:
            return None if stage is last and not edited else self._find(stage)

        return assemble(
            self.need(MESH), self.recognition(), self.need(SEGMENTATION), self.need(JOINTS),
            correction=saved(CORRECTION), completion=saved(COMPLETION), revision=saved(REVISION), timing=self.timing(),
        )  # fmt: skip

    def how(self) -> ExportOptions:
        """Return how the asset was written."""
        return ExportOptions.parse({}, before=read_json(self.target / LAST) or {})

    def written(self) -> Asset:
        """Return the asset as it was written: joints below the precision are proposals."""
        return self.how().written(self.asset())

    def editing(self) -> Stage[CorrectionResult]:
        """Return the stage that holds the corrections of this output."""
        return CORRECTION if self._key(COMPLETION) is None else REVISION

    def corrections(self, stage: Stage[CorrectionResult]) -> tuple[Record, ...]:
        """Return the log of corrections of a stage."""
        correction = self._find(stage)
        return () if correction is None else correction.log

    def last_key(self, *, edited: bool = True) -> str:
        """Return the key of the last stage of the asset.

        edited: with the last corrections.
        """
        skipped = None if edited else self.editing()
        made = (k for s in reversed(STAGES) if s is not skipped and (k := self._key(s)) is not None)
        return next(made, "")


def outdated_files(before: set[str], *, stale: set[str], final: bool) -> set[str]:
    """Return the files from before that no longer follow from the stages, or that final files written now replace."""
    stages = {name for stage in STAGES for name in stage_files(stage)}
    old = {name for stage in STAGES if stage.name in stale for name in stage_files(stage)}
    kept = {MANIFEST, TIMING, CORRECTIONS} | set(filter(is_origin, before))
    return old | (before - stages - kept if stale or final else set())


class RunFolder(Saved):
    """An output folder while it is written.

    Files are written to `folder`. Leaving the `with` block moves them into place. An exception inside the block leaves the
    output unchanged. If a budget, an interrupt or an internal defect ends the run, the finished stages stay in the hidden
    folder for the next run.
    """

    def __init__(
        self, target: Path, hidden: LockedFolder, *, base: Path | None, earlier: Sequence[Path], dead: Sequence[LockedFolder]
    ) -> None:
        super().__init__(target)
        self.folder = hidden.path
        self._hidden = hidden
        self._base = base  # files are added to this folder; None: the whole folder is new
        self._earlier = tuple(earlier)  # folders from which results of earlier runs may be taken
        self._dead = tuple(dead)
        self._replaces = base is None and target in self._earlier
        self._resumable = False  # whether the next run looks for what this one leaves
        self._foreign: set[str] = set()  # files of others that are copied to the new output
        self._stale: set[str] = set()  # stages whose results no longer follow from earlier stages
        self._made: dict[Stage[Any], Any] = {}  # results that this run saved, so that none is read again
        self._redone: set[str] = set()  # stages after a recomputed one, for which results of earlier runs are not valid

    @classmethod
    def create(cls, target: Path, *, source: Path, force: bool = False) -> RunFolder:
        """Create a new output, in place of an older one if `force`; stages of the older one with equal keys are taken over.

        Raise OutputError if the folder is not empty and `force` is off, if it holds the source mesh or files that this program
        did not write, or if it cannot be written.
        """
        target = Path(target).resolve()
        if source.resolve().is_relative_to(target):
            raise OutputError(f"the source mesh {source} lies in the output folder {target}; choose another folder")
        with writing(target):
            recover(target, atomic_prefix(target, "old"))
            if target.exists() and not target.is_dir():
                raise OutputError(f"{target} is a file; an output is a folder")
            inside = target.is_dir() and os.path.ismount(target)  # a mount point cannot be renamed
            old = target.is_dir() and any(p for p in target.iterdir() if not p.name.startswith(FOLDER_PREFIX))
            if old:
                check_replaceable(target, force)
            target.parent.mkdir(parents=True, exist_ok=True)
            place = (target, f"{FOLDER_PREFIX}tmp-") if inside else (target.parent, atomic_prefix(target, "tmp"))
            dead = stale_folders(*place)
            earlier = [d.path for d in dead] + ([target] if old else [])
            base = target if inside else None
            run = cls(target, make_locked_folder(*place), base=base, earlier=earlier, dead=dead)
        run._resumable = locks_known()
        run._stale = {stage.name for stage in STAGES} if inside else set()
        return run

    @classmethod
    def open(cls, target: Path) -> RunFolder:
        """Open an existing output to add a stage or the final files. Raise OutputError if there is none."""
        target = Path(target).resolve()
        with writing(target):
            existing_files(target)
            dead = stale_folders(target, f"{FOLDER_PREFIX}tmp-")
            hidden = make_locked_folder(target, f"{FOLDER_PREFIX}tmp-")
        return cls(target, hidden, base=target, earlier=[], dead=dead)

    @classmethod
    def revise(cls, target: Path) -> RunFolder:
        """Open an existing output, to be replaced atomically by one with its stages and all files of others.

        Raise OutputError if there is none. A mount point cannot be replaced atomically, so files are added to it as by `open`.
        """
        target = Path(target).resolve()
        if os.path.ismount(target):
            return cls.open(target)
        with writing(target):
            ours = set(existing_files(target))
            run = cls(
                target, make_locked_folder(target.parent, atomic_prefix(target, "tmp")), base=None, earlier=[target], dead=[]
            )
            run._foreign = set(list_files(target)) - ours
            stages = {name for stage in STAGES for name in stage_files(stage)}
            copy_files(target, run.folder, (ours & (stages | {TIMING})) | set(filter(is_origin, ours)) | run._foreign)
        return run

    def load(self, stage: Stage[Result], key: str) -> Result | None:
        """Return the saved result of a stage if it was made under this key, else None. It becomes part of this output."""
        earlier = () if stage.name in self._redone else self._earlier
        for place in (*self._places(stage), *earlier):
            saved = read_stage(place, stage, key)
            if saved is None:
                continue
            if place in earlier:
                (self.folder / "stages").mkdir(exist_ok=True)
                for name in stage_files(stage):
                    if (place / name).exists():
                        shutil.copyfile(place / name, self.folder / name)
            return saved
        return None

    def save(self, stage: Stage[Result], key: str, result: Result) -> None:
        """Save the result of a stage; results of later stages and final files are no longer valid and are removed."""
        if self._base is not None and stage not in (CORRECTION, REVISION):
            check_uncorrected(self._base)
        write_stage(self.folder, stage, key, result)
        later = STAGES[STAGES.index(stage) + 1 :]
        self._stale |= {s.name for s in (stage, *later)}
        self._redone |= {s.name for s in later}
        self._made = {s: made for s, made in self._made.items() if s not in later} | {stage: result}
        for name in (name for s in later for name in stage_files(s)):
            (self.folder / name).unlink(missing_ok=True)

    def _find(self, stage: Stage[Result]) -> Result | None:
        return self._made.get(stage) or super()._find(stage)

    def _places(self, stage: Stage[Any] | None) -> list[Path]:
        stale = stage is not None and stage.name in self._stale
        return [self.folder] if self._base is None or stale else [self.folder, self._base]

    @contextmanager
    def timed(self, stage: str) -> Generator[None]:
        """Add the time spent inside to that of a stage, and attach the stage's name to errors."""
        begin = time.perf_counter()
        try:
            yield
        except Exception as error:
            note_stage(error, stage)
            raise
        self.add_time(stage, time.perf_counter() - begin)

    def add_time(self, stage: str, seconds: float) -> None:
        """Add to the seconds that each stage took."""
        write_json(self.folder / TIMING, {**self.timing(), stage: round(seconds, 4)})

    def take_over(self, folder: Path) -> None:
        """Take over the stages of another output, up to its joints and their corrections. Raise OutputError if it has none."""
        written = written_files(folder)
        if written is None:
            raise OutputError(f"{folder} is not an output of anymesh; `anymesh articulate MESH -o {folder}` makes one")
        self._earlier = (Path(folder).resolve(), *self._earlier)
        for stage in STAGES[: STAGES.index(COMPLETION)]:
            key = saved_key(folder, stage)
            if key is not None:
                self.load(stage, key)
        for stage in (MESH, SEGMENTATION, JOINTS):
            self.need(stage)
        copy_files(Path(folder), self.folder, set(filter(is_origin, written)))

    def _commit(self) -> None:
        """Move everything written into place."""
        new = {*list_files(self.folder), MANIFEST} - self._foreign
        with writing(self.target):
            if self._base is None:
                write_manifest(self.folder, new)
                aside = self.target.parent / f"{atomic_prefix(self.target, 'old')}{os.getpid()}"
                replace_folder(self.folder, self.target, aside if self._replaces else None)
            else:
                before = set(written_files(self.target) or ())
                kept = before - outdated_files(before, stale=self._stale, final=LAST in new)
                write_manifest(self.folder, new | kept)
                move_files(self.folder, self.target, remove=sorted(before - kept - new), last=LAST)

    def __enter__(self) -> RunFolder:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, _: TracebackType | None) -> None:
        try:
            if error is None:
                self._commit()
            elif isinstance(error, OSError) and cannot_write(error, self.folder):
                raise OutputError(f"cannot write {self.target}: {error.strerror or error}") from error
        finally:
            interrupted = isinstance(error, KeyboardInterrupt)
            kept = self._resumed_later(error)
            for hidden in (*([] if kept else [self._hidden]), *([] if interrupted else self._dead)):
                hidden.discard()
            for hidden in (*([self._hidden] if kept else []), *(self._dead if interrupted else [])):
                hidden.release()
            if interrupted and error is not None and (kept or self._dead):
                error.add_note(RESUMES)

    def _resumed_later(self, error: BaseException | None) -> bool:
        """Return whether the finished stages are kept for a later run.

        They are kept if a budget, an open question or an interrupt ended the run, or a defect that a rerun may get past.
        """
        expected = isinstance(error, AnymeshError) or (isinstance(error, OSError) and cannot_write(error, self.folder))
        defect = isinstance(error, Exception | KeyboardInterrupt) and not expected
        saved = any((self.folder / stage_files(stage)[0]).exists() for stage in STAGES)
        return isinstance(error, BudgetError | OpenQuestionError) or (defect and saved and self._resumable)
