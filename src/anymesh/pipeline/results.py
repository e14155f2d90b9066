"""Results of the stages."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np

from anymesh.names import confidence_word
from anymesh.types import Brief, Exchange, Joint, Loop, Mesh, Segmentation, Source
from anymesh.types.motion import Recognition

Record = dict[str, Any]  # a JSON object
LOW_CONFIDENCE = 0.4  # warnings name parts and joints below this confidence
PLEASE_CHECK = ", please check"  # how warnings about one part or joint end


@dataclass(frozen=True, eq=False)
class LoadResult:
    """The mesh in the asset frame, its source file, and warnings.

    metric: whether the scale is the unit stated by the file; category: given kind of object, "" without one.
    """

    mesh: Mesh
    source: Source
    warnings: tuple[str, ...] = ()
    metric: bool = False
    category: str = ""


@dataclass(frozen=True, eq=False)
class RecognitionResult:
    """The recognized object, if a model was asked; scale: factor on the loaded mesh; note: its reason."""

    recognition: Recognition | None
    answerer: str
    scale: float = 1.0
    note: str = ""
    warnings: tuple[str, ...] = ()
    exchanges: tuple[Exchange, ...] = ()

    def sized(self, loaded: LoadResult) -> LoadResult:
        """Return the loaded mesh in the answered size."""
        if self.scale == 1 and not self.note:
            return loaded
        S = np.diag([self.scale] * 3 + [1.0])
        source = replace(
            loaded.source, T_asset_source=S @ loaded.source.T_asset_source, notes=(*loaded.source.notes, self.note)
        )
        return replace(loaded, mesh=loaded.mesh if self.scale == 1 else loaded.mesh.transformed(S), source=source)


@dataclass(frozen=True, eq=False)
class SegmentationResult:
    """Stage A: the parts, the name of the answerer, and warnings."""

    segmentation: Segmentation
    answerer: str
    warnings: tuple[str, ...] = ()
    exchanges: tuple[Exchange, ...] = ()


@dataclass(frozen=True, eq=False)
class JointResult:
    """Stage B: the joints, the name of the answerer, and warnings.

    segmentation: the parts with the answered labels, where these changed; it is saved as the result of Stage A.
    """

    joints: tuple[Joint, ...]
    answerer: str
    warnings: tuple[str, ...] = ()
    exchanges: tuple[Exchange, ...] = ()
    segmentation: Segmentation | None = None
    loops: tuple[Loop, ...] = ()


@dataclass(frozen=True, eq=False)
class CompletionResult(Brief):
    """Stage C: the completed mesh.

    mesh: with new faces and materials; face_part: the part of each face; source_face: its previous index (-1: new); notes: on
    the changes.
    """

    mesh: Mesh
    face_part: np.ndarray
    source_face: np.ndarray
    notes: tuple[str, ...] = ()

    def parted(self, before: Segmentation) -> Segmentation:
        """Return the same parts with these faces."""
        return Segmentation(self.face_part, before.parts)


@dataclass(frozen=True, eq=False)
class CorrectionResult:
    """Manually corrected parts and joints; log: the corrections in order, as JSON values."""

    segmentation: Segmentation
    joints: tuple[Joint, ...]
    warnings: tuple[str, ...]
    log: tuple[Record, ...]
    loops: tuple[Loop, ...] = ()


def segmentation_result(
    segmentation: Segmentation, answerer: str, warnings: tuple[str, ...] = (), exchanges: tuple[Exchange, ...] = ()
) -> SegmentationResult:
    """Return the result of Stage A, with a warning for each part of low confidence, and if there is none but the base."""
    none = (no_part_found(segmentation.nearly),) if len(segmentation.parts) == 1 else ()
    unsure = tuple(
        f"part {p.name}: low confidence ({p.confidence:.2f}) that it moves by itself{PLEASE_CHECK}"
        for p in segmentation.parts[1:]
        if p.confidence < LOW_CONFIDENCE
    )
    return SegmentationResult(segmentation, answerer, (*warnings, *none, *unsure), exchanges)


def no_part_found(nearly: str) -> str:
    """Return the warning that nothing moves, with what would be parts next, and how to go on."""
    if not nearly:
        return "no moving part was found, and nothing stands out that could be one; mark it in `anymesh view`"
    go_on = "--at-least 1 takes the first; to say what moves, `anymesh view --ask` or --answerer files:FOLDER"
    return f"no moving part was found; nearest to one is {nearly}; {go_on}"


def joint_result(
    joints: tuple[Joint, ...],
    answerer: str,
    warnings: tuple[str, ...] = (),
    exchanges: tuple[Exchange, ...] = (),
    doubts: Mapping[str, str] = MappingProxyType({}),
) -> JointResult:
    """Return the result of Stage B, with a warning for each joint that failed a test or has a low confidence.

    doubts: what the tests found, by the child of the joint.
    """
    why = {j.child: f"low confidence ({j.confidence:.2f})" for j in joints if j.confidence < LOW_CONFIDENCE} | dict(doubts)
    unsure = tuple(f"joint {j.name}: {why[j.child]}{PLEASE_CHECK}" for j in joints if j.child in why)
    return JointResult(joints, answerer, (*warnings, *unsure), exchanges)


class JointVerdict(NamedTuple):
    """How far a joint is to be trusted. word: sure, check or guess; why: in a short phrase, empty where sure."""

    word: str
    why: str


def verdict(segmentation: Segmentation, joint: Joint, warnings: Sequence[str]) -> JointVerdict:
    """Return the verdict on a joint, by the lower one of its confidence and its part's; with a warning it is never sure.

    The joint of a stated or corrected motion has confidence 1, which also says that its part moves.
    """
    part = next(p for p in segmentation.parts if p.name == joint.child)
    confidence, doubt = joint.confidence, "unsure how it moves"
    if part.confidence < joint.confidence < 1:
        confidence, doubt = part.confidence, "unsure whether it is a part"
    begin = f"joint {joint.name}: "
    fault = next((w.removeprefix(begin).removesuffix(PLEASE_CHECK) for w in warnings if w.startswith(begin)), "")
    word = confidence_word(confidence)
    word = "check" if fault and word == "sure" else word
    return JointVerdict(word, "" if word == "sure" else fault or doubt)


def summary(segmentation: Segmentation, joints: Sequence[Joint], warnings: Sequence[str], proposed: int = 0) -> str:
    """Return one line on all joints, such as "3 joints, 2 sure, 1 to check: door_2 (why)". proposed: number of proposals."""
    verdicts = [(joint.child, verdict(segmentation, joint, warnings)) for joint in joints]
    counts = [f"{len(joints)} joint{'' if len(joints) == 1 else 's'}"]
    for word, said in (("sure", "sure"), ("check", "to check"), ("guess", "guessed")):
        mine = [(name, v.why) for name, v in verdicts if v.word == word]
        names = {why: ", ".join(name for name, other in mine if other == why) for _, why in mine if why}
        listed = "; ".join(f"{name} ({why})" for why, name in names.items())
        counts += [f"{len(mine)} {said}" + (f": {listed}" if listed else "")] if mine else []
    return ", ".join([*counts, f"{proposed} proposed"] if proposed else counts)
