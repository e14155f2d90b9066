"""Read the stages saved in an output."""

from __future__ import annotations

from pathlib import Path
from typing import Any, TypeVar

from anymesh.errors import OutputError
from anymesh.pipeline.results import CorrectionResult, RecognitionResult, Record
from anymesh.pipeline.storage.assemble import assemble
from anymesh.pipeline.storage.outputs import CORRECTIONS, MANIFEST, is_origin, written_files
from anymesh.pipeline.storage.packing import (
    COMPLETION,
    CORRECTION,
    JOINTS,
    MESH,
    RECOGNITION,
    REVISION,
    SEGMENTATION,
    STAGES,
    Stage,
)
from anymesh.pipeline.storage.stage_files import read_stage, saved_key, stage_files
from anymesh.runtime import read_json
from anymesh.types import Asset

Result = TypeVar("Result")
TIMING = "timing.json"


class Saved:
    """The saved stages of an output folder.

    target: its path.
    """

    def __init__(self, target: Path) -> None:
        self.target = target

    @classmethod
    def at(cls, target: Path) -> Saved:
        """Open an existing output.

        Raise OutputError if there is none.
        """
        target = Path(target).resolve()
        if written_files(target) is None:
            raise OutputError(f"{target} is not an output of anymesh; `anymesh articulate MESH -o {target}` makes one")
        return Saved(target)

    def _places(self, stage: Stage[Any] | None) -> list[Path]:
        """Return the folders that may hold the result of a stage, or (None) a file that belongs to no stage."""
        return [self.target]

    def need(self, stage: Stage[Result]) -> Result:
        """Return the result of a stage.

        Raise OutputError if this output has none.
        """
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
        """Return the key of the saved result of a stage.

        Raise OutputError if this output has none.
        """
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
