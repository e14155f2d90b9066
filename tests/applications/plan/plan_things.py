"""Small objects with exact joints, as MJCF, for the tests of planning: a cupboard with a door on a bar handle, and a button."""

import numpy as np
from mjcf_objects import mjcf

HINGE, BAR = (-0.15, -0.1, 0.25), (0.11, -0.16)  # [m] the door's axis; x and y of the handle's bar
BAR_HALF = (0.006, 0.006, 0.06)  # [m]
CUPBOARD = mjcf(
    "cupboard",
    """
<body name="base">
  <geom type="box" size="0.15 0.09 0.01" pos="0 0 0.39"/>
  <geom type="box" size="0.15 0.09 0.01" pos="0 0 0.01"/>
  <geom type="box" size="0.01 0.09 0.2" pos="-0.14 0 0.2"/>
  <geom type="box" size="0.01 0.09 0.2" pos="0.14 0 0.2"/>
  <geom type="box" size="0.15 0.01 0.2" pos="0 0.1 0.2"/>
  <body name="door" pos="-0.15 -0.1 0.25">
    <joint name="door_joint" type="hinge" axis="0 0 -1" range="0 1.8" damping="0.2" frictionloss="0.2"/>
    <geom name="leaf" type="box" size="0.145 0.008 0.145" pos="0.145 0 0" mass="1"/>
    <geom name="bar" type="box" size="0.006 0.006 0.06" pos="0.26 -0.06 0" mass="0.1"/>
    <geom type="box" size="0.006 0.024 0.006" pos="0.26 -0.03 0.05" mass="0.01"/>
    <geom type="box" size="0.006 0.024 0.006" pos="0.26 -0.03 -0.05" mass="0.01"/>
  </body>
</body>
""",
)
PANEL = mjcf(
    "panel",
    """
<body name="base">
  <geom type="box" size="0.1 0.05 0.2" pos="0 0.05 0.2"/>
  <body name="button" pos="0 -0.012 0.3">
    <joint name="button_joint" type="slide" axis="0 -1 0" range="-0.01 0" damping="10" frictionloss="1"/>
    <geom type="box" size="0.02 0.012 0.02" mass="0.05"/>
  </body>
</body>
""",
)
ARM = mjcf(
    "arm5",
    """
<body name="foot">
  <geom type="cylinder" size="0.06 0.05" pos="0 0 0.05"/>
  <body name="turret" pos="0 0 0.15"><joint name="pan" axis="0 0 1" range="-3 3"/>
    <geom type="capsule" size="0.04 0.03"/>
    <body name="upper" pos="0 0 0.05"><joint name="lift" axis="0 1 0" range="-2 2"/>
      <geom type="capsule" size="0.03" fromto="0 0 0.05 0 0 0.25"/>
      <body name="lower" pos="0 0 0.3"><joint name="elbow" axis="0 1 0" range="-2.6 2.6"/>
        <geom type="capsule" size="0.025" fromto="0 0 0.04 0 0 0.2"/>
        <body name="roll" pos="0 0 0.25"><joint name="roll" axis="0 0 1" range="-3 3"/>
          <geom type="sphere" size="0.02"/>
          <body name="pitch"><joint name="pitch" axis="0 1 0" range="-2 2"/>
            <geom type="capsule" size="0.02" fromto="0 0 0.03 0 0 0.06"/>
            <body name="hand" pos="0 0 0.09"><joint name="twist" axis="0 0 1" range="-3 3"/>
              <geom type="box" size="0.02 0.06 0.012"/>
              <body name="left" pos="0 0.01 0.045">
                <joint name="left_finger" type="slide" axis="0 1 0" range="-0.005 0.025"/>
                <geom type="box" size="0.008 0.005 0.03" mass="0.05"/>
              </body>
              <body name="right" pos="0 -0.01 0.045">
                <joint name="right_finger" type="slide" axis="0 -1 0" range="-0.005 0.025"/>
                <geom type="box" size="0.008 0.005 0.03" mass="0.05"/>
              </body>
            </body>
          </body>
        </body>
      </body>
    </body>
  </body>
</body>
""",
    before='<default><geom mass="0.5"/></default>',
)


def turned_about_hinge(points: np.ndarray, angle: float) -> np.ndarray:
    """Where points of the door are when it is open by an angle, by plane geometry: the axis points down."""
    x, y = (points[..., :2] - HINGE[:2]).T
    c, s = np.cos(-angle), np.sin(-angle)
    return np.stack([c * x - s * y + HINGE[0], s * x + c * y + HINGE[1], points[..., 2].T], -1)
