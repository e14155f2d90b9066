"""Rules of SimReady, of NVIDIA's asset validator and of OpenUSD, on files, for `benchmarks.robotics_prop`, in Python 3.12.

python benchmarks/robotics_prop_rules.py FILE...             prints JSON
python benchmarks/robotics_prop_rules.py --memory FILE N SHARED     prints what N references to a file take [MB]
"""

import json
import logging
import sys
from collections import Counter
from importlib.metadata import version
from pathlib import Path

PROFILE = ("Robotics-Prop", "4.0.0")
PACKAGES = ("simready-validate", "simready-foundation-tier-core", "omniverse-asset-validator", "usd-core")


def megabytes() -> float:
    return int(Path("/proc/self/statm").read_text().split()[1]) * 4096 / 1e6


def memory(file: str, count: int, shared: bool) -> float:
    from pxr import Sdf, Usd

    before = megabytes()
    stage = Usd.Stage.CreateInMemory()
    with Sdf.ChangeBlock():
        for k in range(count):
            prim = Sdf.CreatePrimInLayer(stage.GetRootLayer(), f"/scene/asset_{k}")
            prim.specifier, prim.instanceable = Sdf.SpecifierDef, shared
            prim.referenceList.Prepend(Sdf.Reference(str(Path(file).resolve())))
    assert stage.GetPrimAtPath(f"/scene/asset_{count - 1}").GetTypeName() == "Xform"
    return round(megabytes() - before, 1)


def judged(file: str) -> dict:
    import omni.asset_validator
    import simready.validate
    from pxr import Usd, UsdValidation

    validators = UsdValidation.ValidationRegistry().GetOrLoadAllValidators()
    stage = Usd.Stage.Open(file)
    said = [f"{e.GetName()}: {e.GetMessage()}" for e in UsdValidation.ValidationContext(validators).Validate(stage)]
    issues = omni.asset_validator.ValidationEngine().validate(file).issues()
    nvidia = Counter(f"{i.severity.name} {i.rule.__name__ if i.rule else ''}" for i in issues)
    told = {"usdchecker": said, "asset_validator": dict(nvidia)}
    if file.endswith(".usda"):
        result = simready.validate.validate_asset(simready.validate.AssetValidationConfig(file, *PROFILE))
        features = result.features_summary
        told["passed"] = simready.validate.features_summary_passed(features)
        told["features"] = {name: one["passed"] for name, one in features.items()}
        unmet = {i.requirement.code.split("simready.")[-1] for i in (*result.issues, *result.soft_issues) if i.requirement}
        told["unmet"] = sorted(unmet)
    return told


def main() -> None:
    logging.disable(logging.WARNING)
    if sys.argv[1] == "--memory":
        print(memory(sys.argv[2], int(sys.argv[3]), sys.argv[4] == "shared"))
        return
    import simready.validate

    simready.validate.initialize([], [], [])
    files = {file: judged(file) for file in sys.argv[1:]}
    print(json.dumps({"versions": {p: version(p) for p in PACKAGES}, "files": files}))


if __name__ == "__main__":
    main()
