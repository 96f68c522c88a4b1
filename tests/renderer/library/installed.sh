#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs what was built into a folder that is gone afterwards, builds the examples there with CMake
# and with pkg-config, and runs them: installed.sh BUILD SOURCES
set -euo pipefail
build="$1" sources="$2"
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
prefix="$folder/prefix"
for component in program library development; do
  cmake --install "$build" --prefix "$prefix" --component "$component" >/dev/null
done
export LD_LIBRARY_PATH="$prefix/lib" PKG_CONFIG_PATH="$prefix/lib/pkgconfig" PATH="$prefix/bin:$PATH"

# Nothing but the public functions is to be seen.
nm -D --defined-only "$prefix/lib/libminkray.so" | awk '$2 == "T" {print $3}' | grep -v '^minkray_' &&
  { echo "more than minkray_* is exported"; exit 1; }
# (Constants that the linker is to have once, "u", cannot be made local; they are of our own classes.)
nm -g --defined-only "$prefix/lib/libminkray.a" | c++filt | grep -E ' [A-Z] ' | grep -v ' T minkray_' &&
  { echo "the static library shows more than minkray_*"; exit 1; }

# The manual has every page that it points at.
pages="$(zcat "$prefix/share/man/man1/minkray.1.gz" | sed 's/\\-/-/g' | grep -o 'minkray-[a-z0-9-]* (1)' | cut -d' ' -f1)"
(($(wc -w <<<"$pages") > 10)) || { echo "minkray.1 names no verbs"; exit 1; }
for page in $pages; do
  zgrep -q '^\.TH' "$prefix/share/man/man1/$page.1.gz" || { echo "no page $page"; exit 1; }
done

# With find_package: all of the examples.
cmake -S "$sources/examples" -B "$folder/examples" -G Ninja -DCMAKE_PREFIX_PATH="$prefix" \
  -DCMAKE_BUILD_TYPE=Release >/dev/null
grep -rq EIGEN_DONT_VECTORIZE "$folder/examples/build.ninja" && { echo "our definitions leak"; exit 1; }
ninja -C "$folder/examples" -j1 >"$folder/log" || { cat "$folder/log"; exit 1; }
for program in first_ray clearance impact cut_cylinder scene_in_c support_in_c; do
  "$folder/examples/$program"
done
"$folder/examples/robot" "$sources/examples/arm.urdf"
"$folder/examples/path" "$sources/examples/arm.urdf"

# Beside vectorised Eigen the answers are those of the command line, bit for bit.
scene="$sources/scenes/shape-zoo.json"
"$folder/examples/beside_eigen" "$scene" >"$folder/answers"
awk -v scene="$scene" '{printf "{\"scene\": \"%s\", \"ray\": {\"origin\": [%s, %s, %s], " \
  "\"direction\": [%s, %s, %s]}}\n", scene, $1, $2, $3, $4, $5, $6}' "$folder/answers" >"$folder/queries.jsonl"
minkray cast "$folder/queries.jsonl" >"$folder/of_program"
paste "$folder/answers" "$folder/of_program" | awk '
  { status = "miss"; if ($7 == 0) status = "hit"; if ($7 == 2) status = "inside"
    if ($0 !~ "\"status\":\"" status "\"") { print "differs: " $0; exit 1 }
    if ($7 == 1) next
    match($0, /"t":[^,]*/); t = substr($0, RSTART + 4, RLENGTH - 4)
    if (t + 0 != $8 + 0) { print "differs: " $0; exit 1 }
    ++hits }
  END { if (hits < 50) { print "too few hits: " hits; exit 1 } print hits " hits are the same bits" }'

# What the pages show: programs, and pieces of one that follow a page's first. What stands behind a
# printf is what it prints.
for page in README.md docs/cpp.md; do
  awk '/^```cpp$/ && !n {shows = 1; n = 1; next} /^```$/ {shows = 0} shows' "$sources/$page" >"$folder/shown.cpp"
  g++ -std=c++20 -Wall -Werror -I"$prefix/include" "$folder/shown.cpp" -L"$prefix/lib" -lminkray -o "$folder/shown"
  "$folder/shown" | grep -q '^bumper at '
done
{
  printf '#include <minkray/minkray.h>\n#include <cstdio>\nnamespace mk = minkray;\nint main() {\n'
  awk '/^```cpp$/ {shows = ++n > 1; next} /^```$/ {shows = 0} shows' "$sources/docs/cpp.md"
  echo '}'
} >"$folder/pieces.cpp"
awk '/^```c$/ {shows = 1; next} /^```$/ {shows = 0} shows' "$sources/docs/c.md" >"$folder/page.c"
g++ -std=c++20 -Wall -Werror -I"$prefix/include" "$folder/pieces.cpp" -L"$prefix/lib" -lminkray -o "$folder/pieces"
gcc -std=c99 -Wall -Werror -pedantic -I"$prefix/include" "$folder/page.c" -L"$prefix/lib" -lminkray -o "$folder/page"
sed -n 's|^.*printf(.*;  // ||p' "$folder/pieces.cpp" >"$folder/said_by_pieces"
sed -n 's|^.*printf(.*;  /\* \(.*\) \*/$|\1|p' "$folder/page.c" >"$folder/said_by_page"
for program in pieces page; do
  (($(wc -l <"$folder/said_by_$program") >= 3)) || { echo "the page says nothing of what is printed"; exit 1; }
  (cd "$sources" && "$folder/$program") | diff - "$folder/said_by_$program"
done

# With pkg-config, and with the static library.
if command -v pkg-config >/dev/null; then
  g++ -std=c++20 -O2 -march=native -I/usr/include/eigen3 "$sources/examples/beside_eigen.cpp" \
    $(pkg-config --cflags --libs minkray) -o "$folder/by_pkg_config"
  "$folder/by_pkg_config" "$scene" | cmp - "$folder/answers"
  g++ -std=c++20 -O2 -march=native -I/usr/include/eigen3 "$sources/examples/beside_eigen.cpp" \
    $(pkg-config --cflags minkray) "$prefix/lib/libminkray.a" \
    $(pkg-config --static --libs minkray | sed 's/-lminkray\b//') -o "$folder/static"
  LD_LIBRARY_PATH= "$folder/static" "$scene" | cmp - "$folder/answers"
fi

# The header is small.
lines="$(echo '#include <minkray/minkray.h>' | g++ -std=c++20 -E -P -I"$prefix/include" -x c++ - | wc -l)"
echo "minkray.h: $lines lines"
((lines < 10000))
