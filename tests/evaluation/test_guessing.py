"""Random valid answers: every question can be guessed, the same for a seed, and the visual method ends with a result."""

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from assets import box, mesh_of
from guesser import Guesser
from made import smaller

from anymesh.config import Config
from anymesh.evaluation.ground_truth import GroundTruth, example_truths, prepared
from anymesh.pipeline.solving import solve
from anymesh.prompted.questions.grounding import WhichMarks, WhichViews
from anymesh.prompted.questions.recognition import Recognize
from anymesh.types.questions import VisualAnswerer

EXAMPLES = Path(__file__).parents[2] / "examples"
QUICK = Config(viewpoints="3@15,1@50+30")
REGION = (np.arange(24).reshape(4, 6), np.arange(20, 44).reshape(4, 6))


@pytest.fixture(autouse=True, scope="module")
def quick() -> Iterator[None]:
    with smaller(160, 3_000):
        yield


@pytest.mark.parametrize("consistent", [True, False])
def test_guesses_are_valid_and_the_same_for_a_seed(consistent: bool) -> None:
    questions = [
        Recognize((), None, (0.0, 90.0)),
        WhichViews((), ("door", "lid"), REGION),
        WhichMarks((), ("door", "lid"), consistent, REGION, REGION, splittable=consistent),
    ]
    assert isinstance(Guesser(0), VisualAnswerer)
    for seed in range(20):
        first, second = Guesser(seed), Guesser(seed)
        for question in questions:
            assert first.ask(question) == second.ask(question)
    assert len({repr(Guesser(seed).ask(questions[2])) for seed in range(20)}) > 10


def test_whatever_is_answered_there_is_a_result() -> None:
    flat = np.tile([[0.5, 0.2, 0.5]], (4, 1)), np.array([[0, 1, 2], [1, 2, 3]])  # a patch without area
    mesh, _ = mesh_of(
        [flat, box((0, 0, 0), (1, 1, 1)), box((0, -0.1, 0.5), (1, -0.01, 1)), box((0.3, 0.3, 0.3), (0.6, 0.6, 0.6))]
    )  # fmt: skip
    segmentation, joints = solve(mesh, config=QUICK, answerer_factory=lambda _: Guesser(0, pictured=True))
    assert len(joints) == len(segmentation.parts) - 1
    assert len(segmentation.face_part) == len(mesh.faces)


@pytest.mark.slow
@pytest.mark.parametrize("truth", example_truths(EXAMPLES), ids=lambda truth: truth.name)
def test_no_example_crashes_on_random_answers(truth: GroundTruth) -> None:
    for seed in range(2):
        guesser = Guesser(seed)
        segmentation, joints = solve(prepared(truth).mesh, config=QUICK, answerer_factory=lambda _, who=guesser: who)
        assert len(joints) == len(segmentation.parts) - 1
