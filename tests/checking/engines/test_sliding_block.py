"""A block on the lid of a chest slides where the friction says, in SAPIEN and in Newton, each in its own environment."""

import tempfile
from pathlib import Path

import numpy as np
import pytest
from chests import TILTS, chest, slides

from anymesh.checking.engines.sapien_ import without_visuals
from anymesh.export.asset_json import asset_record
from anymesh.export.meshes import write_meshes
from anymesh.export.model import ExportConfig, build_model
from anymesh.export.options import ExportOptions
from anymesh.formats.robot.mjcf_ import write_mjcf
from anymesh.formats.robot.urdf import urdf_text
from anymesh.openusd.writer_ import write_usd

STEP, SETTLE, SLIDE = 0.002, 200, 500  # [s]; steps
HALF = (0.04, 0.04, 0.02)  # of the block [m]


@pytest.fixture(params=["oak", "steel"])
def written(request, tmp_path):
    """Return the URDF of a chest, what asset.json says of its parts, and the model."""
    model = build_model(chest(request.param), ExportOptions(), config=ExportConfig(), cache=None)
    write_meshes(model, tmp_path, ExportConfig())
    path = tmp_path / "thing.urdf"
    path.write_text(urdf_text(model))
    return path, {part["name"]: part["substances"][0] for part in asset_record(model)["parts"]}, model


def gravity(tilt: float) -> np.ndarray:
    return 9.81 * np.array([np.sin(tilt), 0, -np.cos(tilt)])


@pytest.mark.slow
def test_sapien_with_the_materials_of_asset_json(written):
    sapien = pytest.importorskip("sapien")
    path, substances, _ = written

    def travel(tilt):
        scene = sapien.Scene([sapien.physx.PhysxCpuSystem()])
        scene.physx_system.timestep = STEP
        loader = scene.create_urdf_loader()
        loader.fix_root_link = True
        for name, substance in substances.items():
            if substance["name"]:
                values = [substance[key] for key in ("static_friction", "dynamic_friction", "restitution")]
                loader.set_link_material(name, *values)
        with tempfile.TemporaryDirectory() as folder:
            bare = Path(folder) / "thing.urdf"
            bare.write_text(without_visuals(path))
            loader.load(str(bare))
        builder = scene.create_actor_builder()
        builder.add_box_collision(half_size=HALF, material=sapien.physx.PhysxMaterial(*values))
        builder.set_initial_pose(sapien.Pose([0, 0, 0.22]))
        block = builder.build("block")
        body = block.find_component_by_type(sapien.physx.PhysxRigidDynamicComponent)
        body.disable_gravity = True
        for angle, steps in ((0.0, SETTLE), (tilt, SLIDE)):
            start = block.pose.p[0]
            for _ in range(steps):
                body.add_force_at_point(body.mass * gravity(angle), block.pose.p)
                scene.step()
        return float(block.pose.p[0] - start)

    friction = np.arctan(substances["lid"]["dynamic_friction"])
    assert [slides(travel(friction + tilt)) for tilt in TILTS] == [False, True]


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["mjcf", "usd", "urdf"])
def test_newton(written, kind, tmp_path):
    newton = pytest.importorskip("newton")
    path, substances, model = written
    builder = newton.ModelBuilder()
    match kind:
        case "mjcf":
            write_mjcf(model, tmp_path, ExportConfig())
            builder.add_mjcf(str(tmp_path / "thing.xml"))
        case "usd":
            write_usd(model, tmp_path, ExportConfig())
            builder.add_usd(str(tmp_path / "thing.usdc"))
        case _:
            builder.add_urdf(str(path), floating=False, hide_visuals=True)
            for k, body in enumerate(builder.shape_body):  # it reads no friction of surfaces from URDF
                friction = substances[builder.body_label[body].rsplit("/", 1)[-1]].get("dynamic_friction")
                builder.shape_material_mu[k] = friction or builder.shape_material_mu[k]
    written_friction = substances["lid"]["dynamic_friction"]
    shape = newton.ModelBuilder.ShapeConfig(mu=written_friction, density=1000)
    block = builder.add_body(xform=((0, 0, 0.22), (0, 0, 0, 1)))
    builder.add_shape_box(block, hx=HALF[0], hy=HALF[1], hz=HALF[2], cfg=shape)
    world = builder.finalize(device="cpu")
    solver = newton.solvers.SolverMuJoCo(world, use_mujoco_cpu=True)

    def travel(tilt):
        now, after, control = world.state(), world.state(), world.control()
        newton.eval_fk(world, world.joint_q, world.joint_qd, now)
        for angle, steps in ((0.0, SETTLE), (tilt, SLIDE)):
            world.set_gravity(tuple(gravity(angle)))
            solver.notify_model_changed(newton.ModelFlags.MODEL_PROPERTIES)
            start = now.body_q.numpy()[block][0]
            for _ in range(steps):
                solver.step(now, after, control, None, STEP)
                now, after = after, now
        return float(now.body_q.numpy()[block][0] - start)

    assert [slides(travel(np.arctan(written_friction) + tilt)) for tilt in TILTS] == [False, True]
