#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# A wheel is built of a build, without programs, and works where it is unpacked: wheel.sh PYTHON BUILD SOURCES
set -euo pipefail
python="$1" build="$2" sources="$3"
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
if "$python" -c 'import build, sys; sys.exit(not hasattr(build, "ProjectBuilder"))' 2>/dev/null; then
  (cd "$folder" && "$python" -m build --wheel --no-isolation -C "build-dir=$build" -C programs=no -o "$folder" "$sources") >/dev/null
else  # what it would call
  PYTHONPATH="$sources/renderer/library/python" "$python" -c \
    "import wheel_backend; wheel_backend.build_wheel('$folder', {'build-dir': '$build', 'programs': 'no'})"
fi
wheel=("$folder"/minkray-*-cp3*-manylinux_*.whl)
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
    mapped = {line.split()[-1] for line in maps if ".so" in line}
libraries = {file for file in mapped if "libminkray.so" in file or "/mk_" in file}
assert len(libraries) > 4 and all(file.startswith(site) for file in libraries), libraries
assert not any("libtbb.so" in file or "libqhull" in file for file in mapped), mapped
scene = mk.Scene()
scene.add(mk.sphere(1))
assert scene.cast_rays([[-3, 0, 0, 1, 0, 0]]).t[0] == 2
print("the wheel works:", *sorted(libraries))
EOF
