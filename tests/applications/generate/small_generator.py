"""A program as users have them: writes a mesh file for a prompt or a picture, or fails as asked."""

import argparse
import json
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

BOX = Path(__file__).parents[3] / "examples" / "meshes" / "storage_box.glb"

parser = argparse.ArgumentParser()
parser.add_argument("--prompt")
parser.add_argument("--image")
parser.add_argument("--seed")
parser.add_argument("--out", type=Path, required=True)
parser.add_argument("--token")
parser.add_argument("--notes", type=Path)
parser.add_argument("--fault")
told = parser.parse_args()

if told.notes:
    keys = sorted(name for name in os.environ if name.endswith("_API_KEY"))
    told.notes.write_text(json.dumps({"arguments": sys.argv[1:], "keys": keys}))
match told.fault:
    case "crash":
        print("CUDA out of memory: tried to allocate 20 GiB", file=sys.stderr)
        print("token 0123456789abcdef0123456789abcdef0123", file=sys.stderr)
        sys.exit(3)
    case "hang":
        child = subprocess.Popen([sys.executable, "-c", "import time; time.sleep(600)"])
        told.out.with_suffix(".pids").write_text(f"{os.getpid()} {child.pid}")
        print("step 1 of 50", flush=True)
        time.sleep(600)
    case "nothing":
        print("done, or so it says")
    case "garbage":
        told.out.write_bytes(b"glTF\x02\x00\x00\x00 no model")
    case _:
        shutil.copyfile(BOX, told.out)
