"""Points are shown in two views that together show most of them; those under a surface through the part."""

import io

import numpy as np
from assets import box, mesh_of
from PIL import Image

from anymesh.config import Config
from anymesh.prompted.pictures.views import best_view
from anymesh.prompted.pictures.visual_prompts import VisualPrompts

QUICK = Config(viewpoints="4@15,1@60")
CHEST, NUMBER = mesh_of([box((-0.5, -0.3, 0), (0.5, 0.3, 0.5)), box((-0.5, -0.32, 0.5), (0.5, 0.3, 0.6))])
BACK = np.array([[x, 0.302, 0.5] for x in (-0.4, 0.0, 0.4)])  # where the hinges of the lid are
FRONT = np.array([[x, -0.322, 0.55] for x in (-0.3, 0.3)])


def image_of(picture) -> np.ndarray:
    return np.asarray(Image.open(io.BytesIO(picture.png)).convert("RGB"))


def test_a_hinge_at_the_back_is_shown_beside_the_view_that_shows_most_of_the_part() -> None:
    prompts = VisualPrompts(CHEST, QUICK)
    (one,) = prompts.shot(NUMBER, 1).views
    assert one.camera is prompts.views[best_view(prompts.views, NUMBER, 1)].camera
    shot = prompts.shot(NUMBER, 1, candidates=np.concatenate([BACK, FRONT]))
    eyes = [view.camera.T_world_camera[1, 3] for view in shot.views]
    assert min(eyes) < 0 < max(eyes)
    assert not shot.hidden(np.concatenate([BACK, FRONT])).any()
    assert shot.hidden(np.array([[0.0, 0.0, 0.5]])).all()
    assert shot.project(BACK).shape == (3, 4)


def test_a_point_has_its_number_where_it_is_seen_and_hidden_ones_are_seen_through_the_part() -> None:
    prompts = VisualPrompts(CHEST, QUICK)
    shot = prompts.shot(NUMBER, 1, candidates=BACK)
    side = [view.camera.T_world_camera[1, 3] > 0 for view in shot.views]
    none, back, under = (image_of(shot.with_points(p, "part 1: lid")) for p in (BACK[:0], BACK, np.array([[0.0, 0.0, 0.5]])))
    half = none.shape[1] // 2
    changed = (none != back).any(-1)
    assert [bool(changed[:, k * half : (k + 1) * half].any()) for k in (0, 1)] == side or all(side)
    assert (none != under).any(-1).mean() > 3 * changed.mean()  # the whole lid is drawn as glass
