#!/usr/bin/env bash
# Guess: two packages that both ship the module pxr either refuse to be installed together, or share it.
# Truth: pip installs usd-core and usd-exchange side by side, and `pip check` finds nothing wrong. Each overwrites the other's files
#   in pxr: then usdex.core cannot be imported. Uninstalling one of them breaks the other, since it takes the shared files along.
# Version: usd-core 26.11, usd-exchange 3.0.1
# Source: the warning of usdex.core when it is imported
# Who cares: whoever installs our extra `usd` (usd-core) beside a converter of NVIDIA's that is built on usd-exchange.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
"${PYTHON:-python3}" -m venv venv

imports() { # print whether a module can be imported
  if venv/bin/python -W ignore -c "import $1" 2> /dev/null; then echo yes; else echo no; fi
}

venv/bin/pip install -q --disable-pip-version-check usd-exchange==3.0.1
alone="pxr.Usd $(imports pxr.Usd), usdex.core $(imports usdex.core)"
venv/bin/pip install -q --disable-pip-version-check usd-core==26.11
check=$(venv/bin/pip check)
both="pxr.Usd $(imports pxr.Usd), usdex.core $(imports usdex.core)"
venv/bin/pip uninstall -q -y usd-exchange
left="pxr.Usd $(imports pxr.Usd)"
echo "imports with usd-exchange 3.0.1 alone: $alone"
echo "with usd-core 26.11 too: $both (pip check: $check)"
echo "with usd-core after usd-exchange was uninstalled: $left"
if [ "$alone/$both/$left" != "pxr.Usd yes, usdex.core yes/pxr.Usd yes, usdex.core no/pxr.Usd no" ]; then
  echo "changed: see above"
  exit 1
fi
