"""USD: one small stage for each row on the scene, references and joints in docs/formats.md."""

import math
import zipfile

import numpy as np
import pytest
from tables import check_table

pytest.importorskip("pxr")
from usda import BOUND, QUAD, material, mesh, picture, read, texture, xform

from anymesh.errors import InputError
from anymesh.formats.usd.stage_ import read_usd
from anymesh.loading import load_mesh
from anymesh.loading.files import Folder
from anymesh.types import JointType

ORDER = 'uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateZ", "xformOp:scale"]\n'
MOVED = "double3 xformOp:translate = (10, 0, 0)\nfloat xformOp:rotateZ = 90\nfloat3 xformOp:scale = (2, 1, 1)\n" + ORDER
BODY = '(prepend apiSchemas = ["PhysicsRigidBodyAPI"])'


def names(found) -> list[str]:
    return [node.name for node in found.mesh.nodes]


def transforms(folder):
    found, _ = read(folder, xform("top", xform("inner", mesh()), MOVED))
    assert found.mesh.bounds == pytest.approx(np.array([(9, 0, 0), (10, 2, 0)]))
    reset = 'uniform token[] xformOpOrder = ["!resetXformStack!"]'
    found, _ = read(folder, xform("top", xform("inner", mesh(), reset), MOVED))
    assert found.mesh.bounds == pytest.approx(np.array([(0, 0, 0), (1, 1, 0)]))


def time_samples(folder):
    """The value without time counts, else the first."""
    order = 'uniform token[] xformOpOrder = ["xformOp:translate"]\n'
    moves = "double3 xformOp:translate.timeSamples = { 7: (5, 0, 0), 9: (6, 0, 0) }\n" + order
    found, _ = read(folder, xform("top", mesh(), moves))
    assert found.mesh.bounds[0, 0] == 5
    found, _ = read(folder, xform("top", mesh(), "double3 xformOp:translate = (1, 0, 0)\n" + moves))
    assert found.mesh.bounds[0, 0] == 1
    points = "point3f[] points.timeSamples = { 3: [(0, 0, 2), (1, 0, 2), (1, 1, 2), (0, 1, 2)] }\n"
    found, _ = read(folder, mesh(body="\n".join(x for x in QUAD.split("\n") if "points" not in x), more=points))
    assert found.mesh.bounds[0, 2] == 2


def animations(folder):
    order = 'uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateZ"]\n'
    moves = "double3 xformOp:translate = (5, 0, 0)\nfloat xformOp:rotateZ.timeSamples = { 0: 0, 10: 60, 20: 90 }\n" + order
    found, _ = read(folder, mesh("case") + xform("lid", mesh("panel"), moves))
    (hinge,) = found.mesh.joints
    assert (hinge.type, hinge.limits, hinge.name) == ("revolute", pytest.approx((0, math.pi / 2), abs=1e-3), "lid")
    assert (hinge.axis, hinge.origin[0]) == (pytest.approx([0, 0, 1], abs=1e-6), pytest.approx(5, abs=1e-6))


def visibility(folder):
    hidden = xform("off", mesh("a") + mesh("b"), 'token visibility = "invisible"')
    found, warnings = read(folder, mesh() + hidden)
    assert (names(found), warnings) == (["door"], ["left out: 2 invisible shapes"])


def purpose(folder):
    text = mesh() + xform("col", mesh("a"), 'uniform token purpose = "guide"') + mesh("b", more='token purpose = "proxy"\n')
    found, warnings = read(folder, text + mesh("c", more='uniform token purpose = "render"\n'))
    assert names(found) == ["door", "c"]
    assert warnings == ["left out: 1 shapes with the purpose guide", "left out: 1 shapes with the purpose proxy"]
    only, _ = read(folder, mesh("b", more='uniform token purpose = "proxy"\n'))  # better than nothing
    assert names(only) == ["b"]


def not_the_object(folder):
    text = 'def DistantLight "sun"\n{\n}\ndef Camera "eye"\n{\n}\n' + xform("off", mesh("a"), head="(active = false)")
    found, warnings = read(folder, mesh() + text + 'class Xform "kind"\n{\n' + mesh("b") + "}\n")
    assert (names(found), warnings) == (["door"], [])


def scene_instances(folder):
    proto = 'class Xform "proto"\n{\n' + mesh("leaf") + "}\n"
    copies = [
        f'def Xform "{n}" (instanceable = true\nreferences = </proto>)\n{{\n{MOVED if n == "b" else ""}}}\n' for n in "ab"
    ]
    found, _ = read(folder, proto + "".join(copies))
    assert names(found) == ["leaf", "leaf_1"]
    assert {n.geometry for n in found.mesh.nodes} == {"leaf"}
    assert found.mesh.bounds[1] == pytest.approx((10, 2, 0))


def point_instancer(folder):
    text = (
        'def PointInstancer "many"\n{\nrel prototypes = [</many/proto>]\nint[] protoIndices = [0, 0, 0]\n'
        "point3f[] positions = [(0, 0, 0), (4, 0, 0), (9, 9, 9)]\nint64[] invisibleIds = [2]\n"
        f"{mesh('proto')}}}\n"
    )
    found, _ = read(folder, text)
    assert len(found.mesh.nodes) == 2
    assert found.mesh.bounds[1] == pytest.approx((5, 1, 0))


def variants(folder):
    choice = f'variantSet "size" = {{\n"one" {{\n{mesh("one")}}}\n"two" {{\n{mesh("two")}}}\n}}\n'
    head = '(prepend variantSets = "size"\nvariants = { string size = "two" })'
    found, _ = read(folder, xform("top", choice, head=head))
    assert names(found) == ["two"]


def references(folder):
    """Only what lies in the permitted folder is read."""
    inside = folder / "in"
    inside.mkdir()
    read(folder, mesh("secret"), name="secret.usda")
    read(inside, mesh("part"), 'defaultPrim = "part"', name="part.usda")
    kept = 'def "a" (references = @Part.usda@)\n{\n}\ndef "b" (payload = @.\\part.usda@)\n{\n}\n'
    bad = [folder / "secret.usda", "../secret.usda", "http://a.b/c.usda", "part.usda:SDF_FORMAT_ARGS:x=y", "gone.usd", "x.abc"]
    refused = "".join(f'def "c{k}" (references = @{asset}@</secret>)\n{{\n}}\n' for k, asset in enumerate(bad))
    found, warnings = read(inside, kept + refused, "subLayers = [@../secret.usda@]")
    assert names(found) == ["a", "b"]
    assert len(warnings) == len(bad) + 1  # and the unit
    assert all("left out" in w for w in warnings[:-1])
    assert "metersPerUnit" in warnings[-1]


def value_clips(folder):
    clips = '(clips = {\ndictionary default = {\nasset[] assetPaths = [@../x.usda@]\nstring primPath = "/a"\n}\n})'
    _, warnings = read(folder, xform("top", mesh(), head=clips))
    assert warnings == ["value clips (animation in other files) are left out"]


def package(folder):
    """References in an archive stay in it; an archive in a file is read too."""
    picture(folder, "red.png", (255, 0, 0))
    surface = "color3f inputs:diffuseColor.connect = </paint/a.outputs:rgb>"
    text = BOUND + material(surface, texture("a", "textures/red.png")) + 'def "p" (references = @sub/part.usda@)\n{\n}\n'
    read(folder, text.replace("sub/", ""), name="a.usda")
    read(folder, mesh("part"), 'defaultPrim = "part"', name="part.usda")
    (folder / "a.usda").write_text((folder / "a.usda").read_text().replace("@part", "@sub/part"))
    with zipfile.ZipFile(folder / "a.usdz", "w") as archive:
        for name in ("a.usda", "sub/part.usda", "textures/red.png"):
            archive.write(folder / name.rpartition("/")[2], name)
    found = read_usd(Folder(folder / "a.usdz"), folder / "new")
    assert names(found) == ["door", "p"]
    assert "base_color" in found.mesh.materials[0].textures
    around, _ = read(
        folder, 'def "x" (references = @a.usdz@</door>)\n{\n}\ndef "y" (references = @a.usdz[sub/part.usda]@)\n{\n}\n'
    )
    assert names(around) == ["x", "y"]
    with zipfile.ZipFile(folder / "bad.usdz", "w") as archive:
        archive.writestr("../a.usda", "#usda 1.0\n")
    with pytest.raises(InputError, match="leads out of the archive"):
        read_usd(Folder(folder / "bad.usdz"), folder / "other")


def frame(folder):
    found, _ = read(folder, mesh(), 'upAxis = "Z"\nmetersPerUnit = 0.001')
    assert (found.up, found.unit) == ("z", 0.001)
    found, warnings = read(folder, xform("t", mesh(), MOVED.replace("(2, 1, 1)", "(200, 1, 1)")), "")
    assert (found.up, found.unit) == ("y", 0.01)
    assert "centimetres are taken" in warnings[0]
    found, warnings = read(folder, mesh(), "")
    assert found.unit is None


def skeletons(folder):
    """A mesh that was bound in another pose is read at rest; its own transform does not count."""
    skin = """uniform token[] skel:joints = ["bone"]
int[] primvars:skel:jointIndices = [0] (elementSize = 1
interpolation = "constant")
float[] primvars:skel:jointWeights = [1] (elementSize = 1
interpolation = "constant")
rel skel:skeleton = </top/bones>
"""
    bones = """def Skeleton "bones"
{
uniform token[] joints = ["bone"]
uniform matrix4d[] bindTransforms = [((1,0,0,0),(0,1,0,0),(0,0,1,0),(0,0,0,1))]
uniform matrix4d[] restTransforms = [((1,0,0,0),(0,1,0,0),(0,0,1,0),(3,0,0,1))]
}
"""
    skinned = mesh(more=skin + MOVED, head='(prepend apiSchemas = ["SkelBindingAPI"])')
    found, _ = read(folder, f'def SkelRoot "top"\n{{\n{bones}{skinned}}}\n')
    assert found.mesh.bounds == pytest.approx(np.array([(3, 0, 0), (4, 1, 0)]))


def joint(kind: str, more: str, a: str = "base", b: str = "door", name: str = "hinge") -> str:
    first = f"rel physics:body0 = </{a}>\n" if a else ""
    return f'def Physics{kind} "{name}"\n{{\n{first}rel physics:body1 = </{b}>\n{more}\n}}\n'


def bodies(*names: str) -> str:
    return "".join(xform(name, mesh("m"), head=BODY) for name in names)


def joints(folder):
    limits = 'float physics:lowerLimit = -90\nfloat physics:upperLimit = 10\nuniform token physics:axis = "Z"\n'
    place = "point3f physics:localPos0 = (1, 0, 0)\npoint3f physics:localPos1 = (1, 0, 0)\n"
    found, warnings = read(folder, bodies("base", "door") + joint("RevoluteJoint", limits + place))
    (hinge,) = found.mesh.joints
    assert [n.joint for n in found.mesh.nodes] == [-1, 0]
    assert (hinge.type, hinge.name, hinge.parent, hinge.reason) == (
        "revolute",
        "door",
        None,
        "from the joint hinge of the file",
    )
    assert hinge.limits == pytest.approx((-math.pi / 2, math.radians(10)))
    assert (hinge.axis, hinge.origin, warnings) == (pytest.approx([0, 0, 1]), pytest.approx([1, 0, 0]), [])
    ignoring = Folder(folder / "a.usda", joints=False)
    assert not read_usd(ignoring, folder).mesh.joints
    # bodies the other way round: the same motion, seen from the base, which is fixed to the world
    fixed = joint("FixedJoint", "", "", "base", "anchor")
    found, _ = read(folder, bodies("base", "door") + fixed + joint("RevoluteJoint", limits + place, "door", "base"))
    assert found.mesh.joints[0].axis == pytest.approx([0, 0, -1])
    assert [n.joint for n in found.mesh.nodes] == [-1, 0]
    # a slide that is shown half open, in a frame that is turned; no limits of a hinge: it is continuous
    turned = "quatf physics:localRot0 = (0.7071068, 0, 0, 0.7071068)\nquatf physics:localRot1 = (0.7071068, 0, 0, 0.7071068)\n"
    slide = "float physics:lowerLimit = 0\nfloat physics:upperLimit = 1\npoint3f physics:localPos1 = (0, 0.25, 0)\n"
    text = bodies("base", "door", "knob") + joint("PrismaticJoint", turned + slide)
    found, _ = read(folder, text + joint("RevoluteJoint", "", "door", "knob", "turn"))
    drawer, knob = found.mesh.joints
    assert (drawer.axis, drawer.limits) == (pytest.approx([0, 1, 0], abs=1e-6), pytest.approx((-0.25, 0.75)))
    assert (knob.type, knob.parent, knob.range_known) == (JointType.CONTINUOUS, 0, True)


def general_joints(folder):
    locks = "".join(
        f"float limit:{n}:physics:low = 1\nfloat limit:{n}:physics:high = -1\n"
        for n in ("transX", "transY", "transZ", "rotX", "rotY")
    )
    names = ", ".join(f'"PhysicsLimitAPI:{n}"' for n in ("transX", "transY", "transZ", "rotX", "rotY", "rotZ"))
    head = f'"hinge" (prepend apiSchemas = [{names}])'
    free = "float limit:rotZ:physics:low = 0\nfloat limit:rotZ:physics:high = 90\n"
    found, _ = read(folder, bodies("base", "door") + joint("Joint", locks + free).replace('"hinge"', head))
    assert found.mesh.joints[0].limits == pytest.approx((0, math.pi / 2))
    assert found.mesh.joints[0].axis == pytest.approx([0, 0, 1])


def balls(folder):
    cone = 'float physics:coneAngle0Limit = 40\nfloat physics:coneAngle1Limit = 30\nuniform token physics:axis = "Z"\n'
    found, _ = read(folder, bodies("base", "door") + joint("SphericalJoint", cone))
    (ball,) = found.mesh.joints
    assert (ball.type, ball.limits) == ("ball", pytest.approx((0, math.radians(30))))
    found, _ = read(folder, bodies("base", "door") + joint("SphericalJoint", ""))
    assert (found.mesh.joints[0].limits, found.mesh.joints[0].range_known) == (None, True)


def followers(folder):
    limits = "float physics:lowerLimit = 0\nfloat physics:upperLimit = 90\n"
    theirs = "rel physxMimicJoint:rotX:referenceJoint = </top/hinge>\nfloat physxMimicJoint:rotX:gearing = 2\n"
    ours = "rel newton:mimicJoint = </top/hinge>\nfloat newton:mimicCoef1 = -2\n"
    for words in (theirs, ours):
        text = bodies("base", "door", "lid") + joint("RevoluteJoint", limits)
        found, warnings = read(folder, text + joint("RevoluteJoint", limits + words, "base", "lid", "twin"))
        leader = next(k for k, j in enumerate(found.mesh.joints) if j.name == "door")
        (follower,) = (j for j in found.mesh.joints if j.name == "lid")
        assert (follower.follows, follower.ratio, warnings) == (leader, -2.0, [])
    base, twin = bodies("base", "door", "lid"), ("base", "lid", "twin")
    circle = joint("RevoluteJoint", limits + "rel newton:mimicJoint = </top/twin>\n")
    found, _ = read(folder, base + circle + joint("RevoluteJoint", limits + ours, *twin))
    assert [j.follows for j in found.mesh.joints] == [None, None]
    found, warnings = read(folder, base + joint("RevoluteJoint", limits) + joint("PrismaticJoint", limits + ours, *twin))
    assert warnings == ["joint 'twin' is read without what it follows: a revolute joint cannot lead a prismatic one"]


def loose_bodies(folder):
    found, _ = read(folder, bodies("base", "door", "lid") + joint("RevoluteJoint", ""))
    assert [(str(j.type), j.name) for j in found.mesh.joints] == [("continuous", "door"), ("free", "lid")]
    assert [n.joint for n in found.mesh.nodes] == [-1, 0, 1]
    found, _ = read(folder, bodies("base", "door"))
    assert not found.mesh.joints  # of a file without joints, nothing is known


def left_out_joints(folder):
    text = bodies("base", "door", "lid") + joint("DistanceJoint", "", name="ball")
    text += joint("RevoluteJoint", "bool physics:jointEnabled = 0", name="off") + joint("FixedJoint", "", name="weld")
    text += joint("RevoluteJoint", "", "door", "lid", "one")
    text += joint("RevoluteJoint", "uniform bool physics:excludeFromArticulation = 1", "base", "lid", "loop")
    found, warnings = read(folder, text)
    assert [j.reason for j in found.mesh.joints] == ["from the joint one of the file"]
    assert [n.joint for n in found.mesh.nodes] == [-1, -1, 0]
    assert warnings == [
        "joint 'ball' left out: a DistanceJoint is no hinge, slide or ball",
        "joint 'off' left out: it is switched off in the file",
        "joint 'loop' left out: it closes a loop of joints",
    ]


ROWS = {
    "`xformOp`s, `!resetXformStack!`": transforms,
    "`timeSamples`": time_samples,
    "`timeSamples` of transforms that turn about one axis or slide": animations,
    "`visibility`": visibility,
    "`purpose`": purpose,
    "inactive prims, classes, lights, cameras": not_the_object,
    "instances": scene_instances,
    "`PointInstancer`": point_instancer,
    "variants": variants,
    "sublayers, references, payloads": references,
    "value clips": value_clips,
    "USDZ": package,
    "`upAxis`, `metersPerUnit`": frame,
    "UsdSkel": skeletons,
    "RevoluteJoint, PrismaticJoint, FixedJoint": joints,
    "a general Joint with one free degree": general_joints,
    "SphericalJoint": balls,
    "`NewtonMimicAPI`, `PhysxMimicJointAPI`": followers,
    "a rigid body that no joint holds, if the file has joints": loose_bodies,
    "other joints, joints that close loops or are switched off": left_out_joints,
}


@pytest.mark.parametrize("row", ROWS)
def test_what_is_said_of_a_usd_scene(row, tmp_path):
    ROWS[row](tmp_path)


def test_every_row_on_scenes_is_tested():
    check_table("USD", ROWS, 1)


def test_a_broken_file_ends_in_one_error(tmp_path):
    (tmp_path / "a.usda").write_text("#usda 1.0\ndef Mesh (((")
    with pytest.raises(InputError, match=r"a\.usda is not a valid USD file, it is broken"):
        load_mesh(tmp_path / "a.usda")
    (tmp_path / "b.usdc").write_bytes(b"PXR-USDC" + b"\xff" * 200)
    with pytest.raises(InputError, match=r"b\.usdc"):
        load_mesh(tmp_path / "b.usdc")
    (tmp_path / "c.usdz").write_bytes(b"PK\x03\x04 broken")
    with pytest.raises(InputError, match=r"c\.usdz is no readable archive"):
        load_mesh(tmp_path / "c.usdz")
    with pytest.raises(InputError, match="found no triangles"):
        read(tmp_path, xform("empty", ""))
