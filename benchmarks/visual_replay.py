"""One recorded object answered again, and the same answers carried over to other settings."""

from __future__ import annotations

import tempfile
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from anymesh.config import Config
from anymesh.errors import ModelError
from anymesh.evaluation.datasets.dataset import Dataset
from anymesh.evaluation.evaluate_sample import EvalConfig, EvalProtocol, evaluate_sample
from anymesh.evaluation.record import Record
from anymesh.evaluation.score import ObjectScore
from anymesh.pipeline.solving import solve
from anymesh.prompted.answerers.reference import reference_of
from anymesh.prompted.answerers.reference_answerer import ReferenceAnswerer
from anymesh.prompted.answerers.vlm_answerer import VlmAnswerer, request_of
from anymesh.prompted.models.replay import Replay
from anymesh.prompted.questions.asking import Answer, Question, VisualAnswerer
from anymesh.prompted.questions.reply_text import reply_object
from anymesh.types import Exchange, Joint, Mesh, Segmentation
from benchmarks.visual_choices import FILE, WithChoices, read_choices

VARIANTS = ("as recorded", "--verify off", "one view", "geometry alone")
ONE_VIEW = "1@15+30"


@dataclass(frozen=True)
class Row:
    """One object under one variant. calls: questions that were answered; carried: those of them that had no recorded answer."""

    variant: str
    number: str
    set: str
    protocol: EvalProtocol
    record: Record
    calls: int
    carried: int = 0

    def summary(self) -> str:
        """Return one line about the result."""
        score, error = self.record.score, self.record.error
        what = error or f"{score.matched} of {score.true} parts, {self.calls} calls, {self.record.seconds:.0f} s"
        return f"{self.variant} | {self.number} {score.name} {self.protocol}: {what}"


class Carried:
    """Answers as recorded; to a question that was not, as somebody would who holds the recorded result for the truth."""

    warnings: tuple[str, ...] = ()
    exchanges: tuple[Exchange, ...] = ()

    def __init__(self, replay: Replay, known: ReferenceAnswerer) -> None:
        self.name, self._replay, self._known = replay.name, replay, known
        self.calls = self.carried = 0

    def ask(self, question: Question[Answer]) -> Answer:
        request = request_of(question)
        self.calls += 1
        try:
            return question.parse(reply_object(self._replay.ask(request).text, request.schema))
        except ModelError:
            self.carried += 1
            return self._known.ask(question)


class Keeping:
    """The solver, which keeps its last result."""

    def __init__(self, config: Config) -> None:
        self._config = config
        self.result: tuple[Mesh, Segmentation, tuple[Joint, ...]] | None = None

    def __call__(
        self, mesh: Mesh, given: Segmentation | None, *, answerer_factory=None
    ) -> tuple[Segmentation, tuple[Joint, ...]]:
        found = solve(mesh, given, config=self._config, answerer_factory=answerer_factory)
        self.result = (mesh, *found)
        return found


def replayed(
    folder: Path, set_: str, dataset: Dataset, name: str, change: str, protocol: EvalProtocol, variants: Sequence[str]
) -> list[Row]:  # fmt: skip
    """Return a row per variant of one object, answered from the recording in `folder`.

    Where nothing was recorded for a question, the record of the first variant has an error; in the other variants the recorded
    result answers (see `Carried`).
    """
    setting, made = EvalConfig(protocol, (change,)), list[WithChoices]()
    replay = Replay(folder)
    base = Config()
    choices = read_choices(folder / FILE)

    def run(solver: Keeping, answerer_factory) -> Record:
        with tempfile.TemporaryDirectory() as report:
            try:
                (record,) = evaluate_sample(setting, dataset, name, Path(report), solver, lambda _: answerer_factory)
            except ModelError as error:
                return Record(ObjectScore(name, (), 0, 0, 0), error=str(error))
        return record

    def recorded(fallback: VisualAnswerer) -> VisualAnswerer:
        made.append(WithChoices(VlmAnswerer(replay, fallback), choices))
        return made[-1]

    first = Keeping(base)
    record = run(first, recorded)
    as_recorded = Row(VARIANTS[0], folder.parent.name, set_, protocol, record, sum(len(m.exchanges) + m.again for m in made))

    def row(variant: str) -> Row:
        if variant == VARIANTS[0]:
            return as_recorded
        if variant == VARIANTS[3]:
            return replace(as_recorded, variant=variant, record=run(Keeping(base), None), calls=0)
        if record.error or first.result is None:
            return replace(as_recorded, variant=variant)
        mesh, segmentation, joints = first.result
        carried = Carried(replay, ReferenceAnswerer("recording", lambda: reference_of(mesh, segmentation, joints, "object")))
        config = Config(verify="off") if variant == VARIANTS[1] else replace(base, views=replace(base.views, around=ONE_VIEW))
        found = run(Keeping(config), lambda _: carried)
        return Row(variant, as_recorded.number, set_, protocol, found, carried.calls, carried.carried)

    return [row(variant) for variant in variants]
