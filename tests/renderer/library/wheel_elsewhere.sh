#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# A wheel works in a fresh environment with NumPy alone: wheel_elsewhere.sh PYTHON WHEEL SOURCES NUMPYS_PYTHON
# NumPy comes from where pip finds it, else from a Python of the same version that has it.
set -euo pipefail
python="$1" wheel="$2" sources="$3" numpys="$4"
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
"$python" -m venv "$folder/env"
new="$folder/env/bin/python"
pip() { "$new" -m pip --disable-pip-version-check "$@"; }
site="$("$new" -c 'import sysconfig; print(sysconfig.get_path("platlib"))')"
if ! pip install -q --retries 0 --timeout 10 numpy 2>/dev/null; then
  cp -r "$("$numpys" -c 'import numpy, os; print(os.path.dirname(numpy.__file__))')" "$site/"
fi
pip install -q --no-index --no-deps "$wheel"
cd "$folder"
clean() { env -i HOME="$folder" LANG=C.UTF-8 "$@"; }
clean "$new" -W error - "$site/minkray" "$sources" <<'EOF'
import sys
import numpy as np
import minkray as mk
site, sources = sys.argv[1:]
scene = mk.Scene()
scene.add(mk.hull(np.random.default_rng(1).normal(size=(100, 3))))  # Qhull
arm = scene.add_file(sources + "/examples/arm.urdf")  # tinyxml2
rays = np.random.default_rng(2).normal(size=(100000, 6))
assert np.isfinite(scene.cast_rays(rays).t).any()  # oneTBB
apart = mk.signed_distances(mk.sphere(1), None, mk.sphere(1), [[3, 0, 0, 1, 0, 0, 0]])
assert abs(apart.value[0] - 1) < 1e-12
with open("/proc/self/maps") as maps:
    mapped = {line.split()[-1] for line in maps if ".so" in line}
own = {file for file in mapped if file.startswith(site)}
for name in "_minkray.", "libminkray.so", "mk_tbb.so", "mk_qhull_r.so", "mk_tinyxml2.so", "mk_OpenEXR":
    assert any(name in file for file in own), f"{name} must be in the wheel (got {sorted(own)})"
for name in "libtbb.so", "libqhull", "libtinyxml2", "libOpenEXR", "libImath":
    assert not any(name in file for file in mapped), f"{name} must not be loaded (got {sorted(mapped)})"
print("the module works with", len(own), "files of the wheel, NumPy", np.__version__, "and Python", sys.version.split()[0])
EOF
# The command line, by the module and as a program.
clean "$new" -m minkray --version
clean "$new" -m minkray render showcase -r 32x24 -s 1 -q -o picture.png
[[ -s picture.png ]] || { echo "picture.png: must be a picture (got nothing)"; exit 1; }
clean "$folder/env/bin/minkray" distance "$sources/examples/arm.urdf" --geometry visual | grep -q base/cylinder
clean "$folder/env/bin/minkray" inspect showcase -r 32x24 -s 1 -q -o page.html
for program in minkray minkray-tools minkray-inspect; do
  strangers="$(ldd "$site/minkray/bin/$program" | grep -vE "$site/minkray/|linux-vdso|ld-linux|lib(c|m|gcc_s|stdc\+\+|z)\.so" || true)"
  [[ -z $strangers ]] || { echo "$program: must need no library beside the wheel's (got $strangers)"; exit 1; }
done
echo "the command line works"
