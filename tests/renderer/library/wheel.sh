#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# A wheel is built of a build, and works where it is unpacked: wheel.sh PYTHON BUILD SOURCES
set -euo pipefail
python="$1" build="$2" sources="$3"
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
if "$python" -c 'import build, sys; sys.exit(not hasattr(build, "ProjectBuilder"))' 2>/dev/null; then
  (cd "$folder" && "$python" -m build --wheel --no-isolation -C "build-dir=$build" -o "$folder" "$sources") >/dev/null
else  # what it would call
  PYTHONPATH="$sources/renderer/library/python" "$python" -c \
    "import wheel_backend; wheel_backend.build_wheel('$folder', {'build-dir': '$build'})"
fi
wheel=("$folder"/minkray-*-cp3*-linux_*.whl)
[[ -f ${wheel[0]} ]] || { echo "there is no wheel"; exit 1; }
# pip, if it is there, looks at what the wheel says of its files.
if "$python" -m pip --version >/dev/null 2>&1; then
  "$python" -m pip install -q --no-index --no-deps --disable-pip-version-check --root-user-action ignore \
    --target "$folder/site" "${wheel[0]}"
else
  "$python" -m zipfile -e "${wheel[0]}" "$folder/site"
fi
cd "$folder"
PYTHONPATH="$folder/site" "$python" -W error - "$folder/site" <<'EOF'
import sys
import minkray as mk
site = sys.argv[1]
assert mk.__file__.startswith(site), mk.__file__
with open("/proc/self/maps") as maps:
    libraries = {line.split()[-1] for line in maps if "libminkray.so" in line}
assert libraries and all(file.startswith(site) for file in libraries), libraries
scene = mk.Scene()
scene.add(mk.sphere(1))
assert scene.cast_rays([[-3, 0, 0, 1, 0, 0]]).t[0] == 2
print("the wheel works:", *sorted(libraries))
EOF
