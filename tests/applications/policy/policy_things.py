"""Small objects with exact joints, as MJCF, for the tests of policies: a laptop, a bucket and a drawer."""

from mjcf_objects import mjcf

LAPTOP = mjcf(
    "laptop",
    """
<body name="base">
  <geom type="box" size="0.16 0.11 0.008" pos="0 0 0.008" mass="1"/>
  <body name="lid" pos="0 0.11 0.018">
    <joint name="lid_joint" type="hinge" axis="-1 0 0" range="0 2.2" damping="0.05" frictionloss="0.05"/>
    <geom type="box" size="0.16 0.11 0.003" pos="0 -0.11 0.003" mass="0.3"/>
  </body>
</body>
""",
)
BUCKET = mjcf(
    "bucket",
    """
<body name="base">
  <geom type="box" size="0.1 0.1 0.004" pos="0 0 0.004" mass="0.2"/>
  <geom type="box" size="0.004 0.1 0.1" pos="0.1 0 0.1" mass="0.1"/>
  <geom type="box" size="0.004 0.1 0.1" pos="-0.1 0 0.1" mass="0.1"/>
  <geom type="box" size="0.1 0.004 0.1" pos="0 0.1 0.1" mass="0.1"/>
  <geom type="box" size="0.1 0.004 0.1" pos="0 -0.1 0.1" mass="0.1"/>
  <body name="handle" pos="0 0 0.19">
    <joint name="handle_joint" type="hinge" axis="1 0 0" range="-1.57 1.57" damping="0.05" frictionloss="0.02"/>
    <geom type="capsule" size="0.006" fromto="0.115 0 0 0.115 0 0.12" mass="0.02"/>
    <geom type="capsule" size="0.006" fromto="-0.115 0 0 -0.115 0 0.12" mass="0.02"/>
    <geom type="capsule" size="0.006" fromto="0.115 0 0.12 -0.115 0 0.12" mass="0.03"/>
  </body>
</body>
""",
)
DRAWER = mjcf(
    "drawer",
    """
<body name="base">
  <geom type="box" size="0.2 0.01 0.15" pos="0 0.3 0.15" mass="2"/>
  <geom type="box" size="0.2 0.15 0.01" pos="0 0.15 0.01" mass="2"/>
  <body name="tray" pos="0 0 0.15">
    <joint name="tray_joint" type="slide" axis="0 -1 0" range="0 0.2" damping="2" frictionloss="1"/>
    <geom type="box" size="0.19 0.008 0.1" mass="1"/>
    <geom type="box" size="0.06 0.008 0.008" pos="0 -0.05 0" mass="0.05"/>
    <geom type="box" size="0.008 0.02 0.008" pos="0.05 -0.026 0" mass="0.02"/>
    <geom type="box" size="0.008 0.02 0.008" pos="-0.05 -0.026 0" mass="0.02"/>
  </body>
</body>
""",
)
