"""Test that pictures do not depend on the processor: their bytes are part of the keys of saved answers."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

PROGRAM = """
import hashlib
import numpy as np
from test_smooth_pictures import CAMERA, SIZE, samples_of, sphere
from anymesh.rendering.drawing import draw, ground, headlight_on, light_on, material_colors
from anymesh.rendering.render import lit
from anymesh.rendering.drawing import smoothed

mesh = smoothed(sphere(40))
samples = samples_of(mesh)
base = material_colors(mesh, samples)
lights = light_on(samples), headlight_on(samples, CAMERA), lit(base, samples.normal)
pictures = [samples.resolve(base * light[:, None], ground(SIZE, SIZE)) for light in lights[:2]]
pictures.append(draw(samples, base, lights[1], ground(SIZE, SIZE)))
for array in (*lights, *pictures):
    print(hashlib.sha256(array.tobytes()).hexdigest())
"""


@pytest.mark.skipif(sys.platform != "linux", reason="NumPy's BLAS elsewhere may have one kernel")
def test_light_and_pictures_are_the_same_with_each_kernel_of_blas() -> None:
    """`OPENBLAS_CORETYPE` chooses the kernel that older processors use, whose sums differ in their last bits."""
    hashes = []
    for kernel in ("", "Sandybridge", "Nehalem"):
        environment = {
            **os.environ,
            "OPENBLAS_CORETYPE": kernel,
            "PYTHONPATH": os.pathsep.join([str(Path(__file__).parent), *sys.path]),
        }
        run = subprocess.run([sys.executable, "-c", PROGRAM], env=environment, capture_output=True, text=True, check=True)
        hashes.append(run.stdout.split())
    assert len(hashes[0]) == 6
    assert hashes[0] == hashes[1] == hashes[2]
