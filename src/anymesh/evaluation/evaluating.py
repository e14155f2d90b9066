"""`anymesh eval`: evaluation of all objects of a data set, in parallel and resumable, with a report."""

from __future__ import annotations

import datetime
import math
import platform
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from functools import cache, partial
from pathlib import Path
from threading import Event
from typing import Unpack
from zlib import crc32

import numpy as np

from anymesh import __version__
from anymesh.articulation import rank_motions
from anymesh.errors import OpenQuestionError, OptionError
from anymesh.evaluation.changes import CHANGES, UpSource
from anymesh.evaluation.datasets.dataset import Dataset
from anymesh.evaluation.datasets.named import open_dataset
from anymesh.evaluation.evaluate_sample import EvalConfig, EvalProtocol, SampleAnswerer, evaluate_sample
from anymesh.evaluation.ground_truth import EvalSample
from anymesh.evaluation.oracle import Noisy, oracle
from anymesh.evaluation.record import Record, ResultsFolder
from anymesh.evaluation.report import write_report
from anymesh.evaluation.score import ObjectScore
from anymesh.isolation import ChildError, ChildLimits, ChildPool, Failure
from anymesh.loading.upright import up_classifier
from anymesh.names import legal_name, listed
from anymesh.pipeline.answering import choose_answerer
from anymesh.pipeline.options import FILES, GEOMETRY, Answering
from anymesh.pipeline.solving import solve
from anymesh.runtime import Progress, silent, usable_cores
from anymesh.segmentation import part_classifier
from anymesh.types.questions import AnswererFactory

FOLDERS = ("urdf", "static", "labelled", "mjcf", "partnet-mobility")  # kinds of data sets whose objects may have any source
ORACLE = "oracle"
Examined = list[Record] | OpenQuestionError  # the records of an object, or the question that it waits for
Done = Iterator[tuple[str, Examined]]


@cache
def trained_objects() -> frozenset[str]:
    """Return SOURCE/NAME of every object that a shipped classifier was trained on."""
    classifiers = (part_classifier.shipped_classifier(), rank_motions.shipped_classifier(), up_classifier())
    return frozenset(name for classifier in classifiers for name in classifier.manifest["objects"])


def trained_on(dataset: str, names: Sequence[str]) -> int:
    """Count the objects of a data set that were used for training; in data sets of kind FOLDERS by their names alone."""
    known = trained_objects()
    if dataset in FOLDERS:
        plain = {name.partition("/")[2] for name in known}
        return sum(name in plain for name in names)
    return sum(f"{dataset}/{name}" in known for name in names)


def trained_note(dataset: str, names: Sequence[str]) -> str:
    """Describe for a report whether its figures are held out."""
    count = trained_on(dataset, names)
    if count:
        return f"{count} of {len(names)} objects: figures on them are not held out"
    if any(name.startswith(f"{dataset}/") for name in trained_objects()):
        return "other objects of this set: figures are not held out"
    return "none of these objects"


def evaluate(
    dataset: str,
    out: str | Path,
    *,
    protocol: str = EvalProtocol.PARTS,
    split: str | None = None,
    changes: Sequence[str] = ("none",),
    views: int = 1,
    up: str = UpSource.MESH,
    only: Sequence[str] = (),
    jobs: int | None = None,
    force: bool = False,
    progress: Progress = silent,
    **answering: Unpack[Answering],
) -> list[Record]:
    """Evaluate each object of a data set and write the report to the folder `out`; resume a stopped evaluation.

    dataset: see `open_dataset`; protocol: parts, views, end-to-end or executability; changes: see `evaluation.changes`;
    views: observations per object, for the views protocol; up: what points up in the changed meshes: mesh (their z), given
    (the truth) or infer; only: names of objects; jobs: objects in parallel (None: one per core).
    answerer: as for `articulate`, or oracle, or oracle:P (each answer wrong with probability P).
    Raise OptionError, OutputError, MissingExtraError or ModelError; earlier results are kept.
    """
    eval_config = _eval_config(protocol, changes, views, up, answering.get("seed", 0))
    stop = Event()
    answerer_for, data = _answerer_for(answering, eval_config.seed, stop), open_dataset(dataset)
    names = _chosen(data, split, only)
    results = ResultsFolder.open(Path(out), _settings(dataset, split, only, eval_config, answering), force=force)
    left = [name for name in names if not results.has(name)]
    before, total = len(names) - len(left), len(names)
    progress("eval", f"{before} done before" if before else "begins", before, total)
    work = partial(_examined, dataset=dataset, eval_config=eval_config, answering=answering, folder=results.folder)
    alone = (GEOMETRY, ORACLE, *(() if answering.get("wait") else (FILES,)))
    shared = not results.settings["answerer"].startswith(alone)
    waiting: list[OpenQuestionError] = []
    for done, (name, records) in enumerate(_all(left, work, answerer_for, shared, jobs or usable_cores(), stop), start=before):
        progress("eval", name, done, total)
        if isinstance(records, OpenQuestionError):
            waiting.append(records)
        else:
            results.save(name, records)
    if waiting:
        raise _waiting(waiting, total)
    every = [record for name in names for record in results.load(name)]
    title = f"{data.name}{f' {split}' if split else ''}, {eval_config.protocol}, {results.settings['answerer']}"
    settings = {**results.settings, "trained on": trained_note(data.name, names)}
    write_report(every, results.folder, title=title, settings=settings)
    return every


def _waiting(errors: Sequence[OpenQuestionError], total: int) -> OpenQuestionError:
    folders = [folder for error in errors for folder in error.folders]
    return OpenQuestionError(
        f"{len(errors)} of {total} objects wait for an answer: {', '.join(str(f) for f in folders[:5])}"
        f"{', ...' if len(folders) > 5 else ''}; `anymesh answer` shows and answers them; then run the same command again",
        folders,
    )


def _eval_config(protocol: str, changes: Sequence[str], views: int, up: str, seed: int) -> EvalConfig:
    if protocol not in list(EvalProtocol):
        raise OptionError(f"--protocol: found {protocol!r}; valid are {', '.join(EvalProtocol)}")
    unknown = [c for c in changes if c not in CHANGES]
    if unknown or not changes:
        raise OptionError(f"--change: found {', '.join(unknown) or 'none'}; valid are {', '.join(CHANGES)}")
    if views < 1:
        raise OptionError(f"--views must be 1 or more, found {views}")
    if up not in list(UpSource):
        raise OptionError(f"--up: found {up!r}; valid are {', '.join(UpSource)}")
    return EvalConfig(EvalProtocol(protocol), tuple(dict.fromkeys(changes)), views, seed, UpSource(up))


def _chosen(data: Dataset, split: str | None, only: Sequence[str]) -> list[str]:
    names = list(data.objects(split))
    unknown = sorted(set(only) - set(names))
    if unknown:
        raise OptionError(f"--only: found {listed(unknown)}; valid are {listed(names)}")
    if not names:
        raise OptionError(f"the data set {data.name} has no objects{f' in its split {split}' if split else ''}")
    return [n for n in names if not only or n in only]


def _settings(
    dataset: str, split: str | None, only: Sequence[str], eval_config: EvalConfig, answering: Answering
) -> dict[str, str]:
    """Return the settings that determine an evaluation, and the environment in which it runs, in words."""
    settings = {
        "dataset": dataset,
        "split": split or "all",
        "protocol": str(eval_config.protocol),
        "answerer": answering.get("answerer", GEOMETRY),
        "changes": ", ".join(eval_config.changes),
        "seed": str(eval_config.seed),
        "anymesh": __version__,
    }
    if eval_config.protocol is EvalProtocol.VIEWS:
        settings["views"] = str(eval_config.views)
    if eval_config.up is not UpSource.MESH:
        settings["up"] = str(eval_config.up)
    if only:
        settings["only"] = ", ".join(sorted(only))
    settings |= {k: str(answering[k]) for k in ("verify", "ask", "pictures", "proposer", "viewpoints") if k in answering}
    if eval_config.protocol in (EvalProtocol.END_TO_END, EvalProtocol.EXECUTABILITY):
        settings["at least"] = str(answering.get("at_least", 0))
    made = {"date": datetime.datetime.now(datetime.UTC).date().isoformat(), "python": platform.python_version()}
    return settings | made | {"numpy": np.__version__, "machine": f"{platform.machine()}, {usable_cores()} cores"}


def _answerer_for(answering: Answering, seed: int, stop: Event | None = None) -> SampleAnswerer:
    """Return the function that chooses the answerer of a sample.

    It is geometry, the sample's ground truth (optionally with errors), files, or a model.
    """
    name, _, share = answering.get("answerer", GEOMETRY).partition(":")
    if name == FILES.removesuffix(":"):

        def asked(sample: EvalSample) -> AnswererFactory | None:
            place: Answering = {**answering, "answerer": f"{FILES}{Path(share) / legal_name(sample.truth.name)}"}
            return choose_answerer(place, about=sample.truth.name, stop=stop).factory

        one = f"{FILES}{Path(share) / 'object'}" if share else FILES
        _ = choose_answerer({**answering, "answerer": one})  # report invalid options before any work is done
        return asked
    if name != ORACLE:
        who = choose_answerer(answering)
        return lambda sample: who.factory if who.new_factory is None else who.new_factory()
    try:
        wrong = float(share or 0)
    except ValueError:
        wrong = -1.0
    if not 0 <= wrong <= 1:
        raise OptionError(f"--answerer oracle:P needs a probability P from 0 to 1, found {share!r}")

    def known(sample: EvalSample) -> AnswererFactory:
        rng = np.random.default_rng((seed, crc32(sample.truth.name.encode())))
        return lambda fallback: Noisy(oracle(sample), wrong, rng) if wrong else oracle(sample)

    return known


def _examined(
    name: str,
    answerer_for: SampleAnswerer | None = None,
    *,
    dataset: str,
    eval_config: EvalConfig,
    answering: Answering,
    folder: Path,
) -> Examined:
    """Evaluate one object in its own process, which opens the data set again."""
    options: Answering = {**answering, "answerer": GEOMETRY, "parts_list": ()}
    solver = partial(solve, config=choose_answerer(options).config)
    try:
        return evaluate_sample(
            eval_config, open_dataset(dataset), name, folder, solver, answerer_for or _answerer_for(answering, eval_config.seed)
        )
    except OpenQuestionError as error:
        return error


def _all(
    names: Sequence[str], work: partial[Examined], answerer_for: SampleAnswerer, shared: bool, jobs: int, stop: Event
) -> Done:
    """Yield the records of each object as they complete.

    shared: in threads, which share a model and its budget; else in child processes. stop: set at the end, for threads that wait
    for answers.
    """
    if jobs == 1 or len(names) < 2:
        yield from ((name, work(name, answerer_for)) for name in names)
        return
    children, threads = ChildPool(jobs, ChildLimits(seconds=math.inf, memory=0)), ThreadPoolExecutor(jobs)
    try:
        futures = {
            (threads.submit(work, name, answerer_for) if shared else threads.submit(_in_child, children, work, name)): name
            for name in names
        }
        for future in as_completed(futures):
            yield futures[future], future.result()
    finally:
        stop.set()
        children.close()
        threads.shutdown(cancel_futures=True)


def _in_child(children: ChildPool, work: partial[Examined], name: str) -> Examined:
    """Evaluate one object in a child process, whose end does not affect the other objects."""
    try:
        return children.run(__name__, _examined.__name__, {"name": name, **work.keywords})
    except ChildError as error:
        if error.failure is Failure.INVALID:
            raise OptionError(error.detail) from None
        if error.failure is Failure.ERROR:
            raise
        return [Record(ObjectScore(name, (), 0, 0, 0), error=f"its process ended unexpectedly ({error})")]
