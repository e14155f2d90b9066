"""Test masses of whole objects: shells of furniture and appliances, kinds, and a mass that was given."""

from dataclasses import replace

import numpy as np
import pytest
from assets import box, joint, mesh_of, source
from models import CONFIG

from anymesh.errors import OptionError
from anymesh.export.asset_json import asset_record
from anymesh.export.model import build_model
from anymesh.export.options import ExportOptions
from anymesh.kinds.bodies import CLOSED_TO
from anymesh.physics.substances import SUBSTANCES
from anymesh.types import Asset, Material, Part, Segmentation

SIZE = np.array([0.6, 0.6, 1.8])


def case(name="thing", label="door", material="", **more):
    """Return a solid box with a flat front at its hinge."""
    pieces = [box((-0.3, -0.3, 0), (0.3, 0.3, 1.8)), box((-0.3, -0.33, 0), (0.3, -0.3, 1.8))]
    mesh, number = mesh_of(pieces, np.zeros(24, int), materials=(Material(material),))
    parts = (Part("base", "base"), Part(label, label))
    hinge = joint("hinge", "revolute", "base", label, (-0.3, -0.3, 0.9), (0, 0, -1), (0.0, 1.5))
    return Asset(name, source(f"{name}.glb"), mesh, Segmentation(number, parts), (hinge,), "geometry", **more)


def built(asset, **options):
    return build_model(asset, ExportOptions.parse(options), config=CONFIG, cache=None)


def shell(wall):
    """Return mass [kg] per density, and inertia about the vertical per mass, of the walls of the box."""
    x, y, z = SIZE
    area = 2 * (x * y + y * z + z * x)
    plates = 2 * x * y * (x * x + y * y) / 12 + 2 * y * z * (y * y / 12 + x * x / 4) + 2 * z * x * (x * x / 12 + y * y / 4)
    return area * wall, plates / area


@pytest.mark.parametrize(
    ("asset", "substance"),
    [
        (case("fridge"), "sheet_steel"),
        (case("scene", category="fridge"), "sheet_steel"),
        (case("wardrobe"), "wood"),
        (case("fridge", material="granite"), "granite"),
        (case("thing", "door"), "chipboard"),
    ],
)
def test_the_body_of_closed_furniture_is_a_shell_with_its_inertia(asset, substance):
    body = built(asset).bodies[0].inertia
    made = SUBSTANCES[substance]
    volume, gyration = shell(made.sheet)
    assert body.mass == pytest.approx(made.density * volume)
    assert body.tensor[2, 2] == pytest.approx(gyration * body.mass)
    assert body.wall == pytest.approx(made.sheet)
    assert asset_record(built(asset))["parts"][0]["wall"] == pytest.approx(made.sheet)


def test_walls_of_a_kind_replace_those_of_its_substance_alone():
    volume, _ = shell(0.006)
    assert built(case("safe", material="dark metal")).bodies[0].inertia.mass == pytest.approx(7850 * volume)
    assert built(case("car", material="dark metal")).bodies[0].inertia.wall == pytest.approx(0.005 * 1.8 / 4.4)
    wooden = built(case("safe", material="oak")).bodies[0].inertia
    assert wooden.wall == pytest.approx(SUBSTANCES["oak"].sheet)


def test_thin_bodies_and_other_objects_stay_solid():
    front = built(case("wardrobe")).bodies[1].inertia
    assert front.mass == pytest.approx(650 * 0.6 * 0.03 * 1.8)
    assert CLOSED_TO > 0.03
    assert front.wall == 0
    assert built(case("thing", "lever")).bodies[0].inertia.mass == pytest.approx(500 * np.prod(SIZE))


def test_a_given_mass_is_that_of_all_links_in_proportion():
    before, after = built(case("fridge")), built(case("fridge"), mass=61.0)
    masses = np.array([[b.inertia.mass for b in model.bodies] for model in (before, after)])
    assert masses[1].sum() == pytest.approx(61)
    np.testing.assert_allclose(masses[1] / masses[0], 61 / masses[0].sum())
    for a, b in zip(before.bodies, after.bodies, strict=True):
        np.testing.assert_allclose(b.inertia.tensor, a.inertia.tensor * 61 / masses[0].sum(), rtol=1e-6)
    record = asset_record(after)
    assert (record["mass"], record["given_mass"], record["mass_range"]) == (pytest.approx(61), 61, pytest.approx([61, 61]))
    assert ExportOptions.parse({}, before=record).mass == 61
    assert ExportOptions.parse({"mass": 0}, before=record).mass is None
    assert ExportOptions.parse({}, before=asset_record(before)).mass is None


@pytest.mark.parametrize("mass", [-1, 1e-9, float("nan"), float("inf"), "heavy", True])
def test_a_mass_that_is_none_is_refused(mass):
    with pytest.raises(OptionError, match="--mass: found"):
        ExportOptions.parse({"mass": mass})


def test_an_implausible_mass_is_a_warning_and_a_given_one_is_not():
    heavy = replace(case("mug"), category="box")
    assert any("a box usually has" in w for w in built(heavy).asset.warnings)
    assert not any("usually has" in w for w in built(heavy, mass=5000).asset.warnings)
    assert built(case("fridge")).asset.warnings == built(case("fridge"), mass=80).asset.warnings
