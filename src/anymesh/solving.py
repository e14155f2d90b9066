"""Both stages on one placed mesh, with whoever answers: geometry, a model that sees, or ground truth in an evaluation."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from functools import cached_property
from pathlib import Path

import numpy as np

from anymesh.articulation.estimate import (
    PartMotions,
    choose_motion,
    estimate_joints,
    motion_question,
    motion_questions,
    relabelled,
    surroundings,
)
from anymesh.articulation.evidence import hypotheses
from anymesh.articulation.part_labels import label_of
from anymesh.articulation.prompted import Questions, Reground, prompt_joints
from anymesh.articulation.tree import parents
from anymesh.config import Config
from anymesh.deadline import Deadline
from anymesh.geometry.pieces import ObjectShape, object_shape
from anymesh.geometry.surroundings import PartContext
from anymesh.models.sam import PromptedSegmenter
from anymesh.models.sam_load import load_sam
from anymesh.progress import Progress, silent
from anymesh.reasoning.asking import Seer
from anymesh.reasoning.geometry import GeometryAnswerer
from anymesh.reasoning.knowing import Knowing, KnownJoint, Reference
from anymesh.reasoning.questions import Candidate
from anymesh.reasoning.recognition import answered_scale, recognize
from anymesh.rendering.studio import Studio
from anymesh.segmentation.ask_marks import Asked
from anymesh.segmentation.cloud import Cloud
from anymesh.segmentation.given import GIVEN, parts_from_file, parts_from_nodes
from anymesh.segmentation.grounded import EXACT, ground_parts, object_cloud
from anymesh.segmentation.hidden import LEAST_TOLD, inner_faces, seen_points
from anymesh.segmentation.regrounding import ground_again
from anymesh.segmentation.segment import segment_parts
from anymesh.stage_results import Jointed, Recognized, Segmented
from anymesh.types import Joint, JointType, Mesh, MotionKind, Picture, Segmentation
from anymesh.types.recognition import Moves, Recognition

Seeing = Callable[[Seer], Seer]  # an answerer that sees, given who answers in its place where it cannot
MOST_INSIDE = 2  # pictures of the inside in the question of what the object is
UNSURE = 0.4  # joints below this confidence are named in the warnings
LIKELY = 4  # motions of each kind, likeliest first, of which one is to stay free with what the part gains
FREE = 0.8  # a part that gains unseen patches opens this much as far as without them
ENOUGH = float(np.deg2rad(60))  # [rad, or share of the diagonal] an opening beyond is not compared
GEOMETRY = GeometryAnswerer()


class Solver:
    """Stage A and Stage B for one placed mesh [m, Z up]. `see` makes the answerer; without it geometry answers. What is left
    out past the deadline is among the warnings of each stage."""

    def __init__(
        self, mesh: Mesh, config: Config | None = None, see: Seeing | None = None, deadline: Deadline | None = None
    ) -> None:
        self.mesh, self.config, self._see = mesh, config or Config(), see
        self.deadline = deadline or Deadline()
        self._by_itself: Segmentation | None = None
        self._swept: tuple[bytes, list[PartMotions]] | None = None  # faces of parts, and their motions

    @cached_property
    def whole(self) -> ObjectShape:
        """The mesh made ready for both stages."""
        return object_shape(self.mesh, self.config.seed, self.config.pieces)

    @cached_property
    def _segmenter(self) -> PromptedSegmenter | None:
        spec = self.config.proposer.removeprefix(f"{EXACT}+")
        return None if spec == EXACT else load_sam(spec)

    @cached_property
    def _cloud(self) -> Cloud:
        return object_cloud(self.mesh, self.whole, self.config)

    @cached_property
    def _studio(self) -> Studio:
        return Studio(self.mesh, self.config)

    def recognize(self, *, sized: bool = False, metric: bool = False) -> Recognized:
        """What the object is and which parts move, from someone who sees.

        sized: the answered size sets the scale, unless the file states its unit (metric): then a size that contradicts is a
        warning.
        """
        if self._see is None:
            return Recognized(None, GEOMETRY.name)
        _ = self._segmenter  # weights that cannot be used are better missed before anything is asked
        seer = self._see(Knowing(GEOMETRY.name, lambda: self._geometric_reference))
        azimuths = [azimuth for azimuth, _ in self.config.views.directions]
        found = recognize(self._view_pictures, seer, self.config.category, self.config.parts_list, azimuths)
        scale, note, doubt = answered_scale(found, float(self.mesh.extents.max()), metric=metric) if sized else (1.0, "", ())
        return Recognized(found, seer.name, scale, note, (*seer.remarks, *doubt), seer.exchanges)

    def _view_pictures(self) -> tuple[Picture, ...]:
        seen, studio = self._studio.views, self._studio
        names = studio.names(len(seen))
        inside = inner_faces(self.mesh, self.whole, self._cloud, seen_points(self._cloud, seen), LEAST_TOLD)
        if inside.any():
            chosen = studio.most_of_inside(inside, MOST_INSIDE)
            seen = [*seen, *(studio.insides(inside)[k] for k in chosen)]
            names += [studio.inside_names()[k] for k in chosen]
        return studio.pictures([view.color for view in seen], names)

    def parts(self, parts: str = "auto", recognition: Recognition | None = None, progress: Progress = silent) -> Segmented:
        """Stage A. parts: auto, nodes, or a file of face labels."""
        if parts != "auto":
            given = parts_from_nodes(self.mesh) if parts == "nodes" else parts_from_file(self.mesh, Path(parts))
            return _segmented(given, GIVEN)
        if self._see is None or recognition is None:
            return _segmented(self._geometric_parts(progress), GEOMETRY.name, None, self.deadline.warnings())
        seer = self._see(Knowing(GEOMETRY.name, lambda: self._geometric_reference))
        found, warnings = ground_parts(
            self.mesh,
            self.whole,
            seer,
            self.config,
            recognition,
            self._studio,
            self._segmenter,
            self._geometric_parts,
            self.stays_free,
            progress,
            self._cloud,
        )
        return _segmented(found, seer.name, seer, (*warnings, *self.deadline.warnings()))

    def joints(
        self,
        segmentation: Segmentation,
        recognition: Recognition | None = None,
        progress: Progress = silent,
        grounded: bool = False,
    ) -> Jointed:
        """Stage B. grounded: the parts were found by `parts`, so answers may call them too much or too little, once."""
        if self._see is None:
            found = estimate_joints(segmentation, self._motions(segmentation, progress), GEOMETRY)
            return _jointed(found, GEOMETRY.name, None, self.deadline.warnings())
        seer = self._see(Knowing(GEOMETRY.name, lambda: self._reference(segmentation)))
        questions = Questions(self._studio, seer, self.config, recognition, progress)
        reground = self._regrounding(questions, segmentation) if grounded and recognition is not None else None
        made = prompt_joints(questions, self._ready_for, segmentation, reground)
        found = _jointed(made.joints, seer.name, seer, (*made.warnings, *self.deadline.warnings()))
        return replace(found, segmentation=made.segmentation if made.segmentation is not segmentation else None)

    def _regrounding(self, questions: Questions, segmentation: Segmentation) -> Reground:
        """What goes back to the marks of parts that are wrong."""
        recognition = questions.recognition
        asked = Asked(questions.seer, self._studio, questions.labels, questions.category, self.config)
        front = recognition.front if recognition else None
        return lambda wrong: ground_again(self.mesh, self.whole, self._cloud, asked, segmentation, wrong, front)

    def _geometric_parts(self, progress: Progress = silent) -> Segmentation:
        """What geometry finds; once, however many questions it answers."""
        if self._by_itself is None:
            self._by_itself = segment_parts(self.mesh, self.whole, self._labels, self.config, progress, self.deadline)
        return self._by_itself

    def _labels(self, segmentation: Segmentation) -> list[str]:
        """Return a label of each part but the base by how geometry moves it; "" for one that cannot move."""
        found = {}
        for i, _, around, question in self._motions(segmentation):
            answer, best = choose_motion(around, question, GEOMETRY)
            found[i] = "" if answer.type is JointType.FIXED else label_of(around, best)
        return [found[i] for i in sorted(found)]

    def _motions(self, segmentation: Segmentation, progress: Progress = silent) -> list[PartMotions]:
        """Sweep the motions of all parts; those of the parts that were swept last are kept."""
        faces = segmentation.face_part.tobytes()
        if self._swept is None or self._swept[0] != faces:
            found = motion_questions(self._ready_for(segmentation), segmentation, self.config, self.deadline)
            self._swept = faces, list(_told(found, segmentation, progress))
            return self._swept[1]
        return list(_told(relabelled(self._swept[1], segmentation), segmentation, progress))

    def stays_free(self, without: np.ndarray, joined: np.ndarray, part: int, moves: Moves | None = None) -> bool:
        """Tell whether a part opens as far with the unseen patches that it would gain.

        without, joined: the part number of each face of `whole`; moves: the recognized motion of the part, if known.
        """
        alone, gained = self._around(without, part), self._around(joined, part)
        question = motion_question(alone, "candidate", "part")
        best: dict[int, Candidate] = {}  # of the two ways along each axis
        for k in GEOMETRY.which_motion(question).ranking:
            best.setdefault(id(question.candidates[k].motion), question.candidates[k])
        kinds = (
            list(MotionKind) if moves is None else [MotionKind.PRISMATIC if moves is Moves.PRISMATIC else MotionKind.REVOLUTE]
        )
        likely = [c for kind in kinds for c in [c for c in best.values() if c.motion.kind is kind][:LIKELY]]
        after = hypotheses(gained, [(c.role, c.motion) for c in likely])[::2]
        far = [(max(c.opening, c.closing), max(a.opening, a.closing)) for c, a in zip(likely, after, strict=True)]
        return any(now >= FREE * min(before, ENOUGH) for before, now in far)

    def _around(self, label: np.ndarray, part: int) -> PartContext:
        shapes = [self.whole.of(np.flatnonzero(label == k)) for k in np.unique(label)]
        rank = np.searchsorted(np.unique(label), label)
        number = int(np.searchsorted(np.unique(label), part))
        return surroundings(self.whole, rank, shapes, parents(shapes, self.whole.diagonal), number, self.config.articulation)

    def _ready_for(self, segmentation: Segmentation) -> ObjectShape:
        """The mesh made ready, in pieces that each belong to one of these parts."""
        label, whole = segmentation.face_part, self.whole
        if (label == label[whole.source][np.unique(whole.patch, return_index=True)[1]][whole.mesh_patch]).all():
            return whole
        return object_shape(self.mesh, self.config.seed, self.config.pieces, label)

    @cached_property
    def _geometric_reference(self) -> Reference:
        return self._reference(self._geometric_parts())

    def _reference(self, segmentation: Segmentation) -> Reference:
        """What geometry would answer, for questions that a model could not."""
        joints = estimate_joints(segmentation, self._motions(segmentation), GEOMETRY)
        return reference_of(self.mesh, segmentation, joints, self.config.category or "object")


def _told(swept: Iterable[PartMotions], segmentation: Segmentation, progress: Progress) -> Iterator[PartMotions]:
    """Report each part as its motions come."""
    for done, motions in enumerate(swept):
        progress("joints", segmentation.parts[motions[0]].name, done, len(segmentation.parts) - 1)
        yield motions


def reference_of(mesh: Mesh, segmentation: Segmentation, joints: tuple[Joint, ...], category: str) -> Reference:
    """Parts and joints as things that are known."""
    number = {p.name: k for k, p in enumerate(segmentation.parts)}
    by_child = {j.child: j for j in joints}
    made = [by_child.get(p.name) for p in segmentation.parts]
    return Reference(
        category=category,
        size=float(mesh.extents.max()),
        face_part=segmentation.face_part,
        face_area=mesh.face_areas,
        labels=tuple(p.label for p in segmentation.parts),
        parents=tuple(0 if j is None else number[j.parent] for j in made),
        joints=tuple(None if j is None else KnownJoint(j.type, j.axis, j.origin, j.limits) for j in made),
    )


def _segmented(
    segmentation: Segmentation, answerer: str, seer: Seer | None = None, warnings: tuple[str, ...] = ()
) -> Segmented:
    none = ("nothing was found that moves",) if len(segmentation.parts) == 1 else ()
    remarks = seer.remarks if seer else ()
    return Segmented(segmentation, answerer, (*remarks, *warnings, *none), seer.exchanges if seer else ())


def _jointed(joints: tuple[Joint, ...], answerer: str, seer: Seer | None = None, cut: tuple[str, ...] = ()) -> Jointed:
    unsure = tuple(
        f"joint {j.name}: low confidence ({j.confidence:.2f}), please check" for j in joints if j.confidence < UNSURE
    )
    remarks = seer.remarks if seer else ()
    return Jointed(joints, answerer, (*remarks, *cut, *unsure), seer.exchanges if seer else ())


def solve(
    mesh: Mesh, given: Segmentation | None = None, *, config: Config | None = None, see: Seeing | None = None
) -> tuple[Segmentation, tuple[Joint, ...]]:
    """Both stages on a placed mesh, the second alone where the parts are given."""
    solver = Solver(mesh, config, see)
    if given is not None:
        return given, solver.joints(given).joints
    recognition = solver.recognize().recognition
    segmentation = solver.parts("auto", recognition).segmentation
    jointed = solver.joints(segmentation, recognition, grounded=True)
    return jointed.segmentation or segmentation, jointed.joints
