#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Programs that were linked with a library of the same SOVERSION run with the one that was built:
# abi.sh BUILD SOURCES. The header of each first version is kept in abi/; of headers, libraries of
# empty functions are made with all types, which abidiff compares. Exits with 77 without abidiff.
set -euo pipefail
build="$1" sources="$2"
here="$sources/tests/renderer/library"
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT

# stub HEADER NAME: a library with the functions of a header, in a folder of its own.
stub() {
  mkdir -p "$folder/$2/minkray"
  cp "$1" "$folder/$2/minkray/minkray_c.h"
  sed -i '/^#include "minkray\//d' "$folder/$2/minkray/minkray_c.h"
  {
    echo '#include <minkray/minkray_c.h>'
    sed '/^#/d' "$1" | tr '\n' ' ' | sed 's:/\*:\x01:g; s:\*/:\x02:g; s:\x01[^\x02]*\x02::g' | grep -o 'MINKRAY_API [^;]*;' |
      sed 's/^MINKRAY_API //; s/;$/ { __builtin_trap(); }/'
  } >"$folder/$2/stub.c"
  gcc -std=c99 -g -O0 -w -fPIC -shared -Wl,-soname,libminkray.so.0 \
    -Wl,--version-script="$sources/renderer/library/symbols.map" -I"$folder/$2" "$folder/$2/stub.c" \
    -o "$folder/$2/libminkray.so"
  ln -s libminkray.so "$folder/$2/libminkray.so.0"
}
# Constants are no part of a library: its functions have numbers for them.
constants_of() { grep -o 'MINKRAY_[A-Z_]* = [0-9]*' "$1" | sort; }
keeps_constants() { [[ -z "$(comm -23 <(constants_of "$1") <(constants_of "$2"))" ]]; }
functions_of() { nm -D --defined-only "$1" | awk '$2 == "T" {print $3}' | sort; }

# All headers of now as one, as minkray_c.h includes them.
now="$folder/now.h"
for header in minkray_c minkray_c_pairs; do
  sed '/^#include "minkray\//d' "$sources/include/minkray/$header.h"
done >"$now"
stub "$now" now
diff <(functions_of "$folder/now/libminkray.so") <(functions_of "$build/libminkray.so") ||
  { echo "the library does not export what the header declares"; exit 1; }

# Programs of then, with the library of now.
for header in "$here"/abi/minkray_c-*.header; do
  then="$(basename "$header" .header)"
  stub "$header" "$then"
  for program in scene_in_c support_in_c; do
    gcc -std=c99 -I"$folder/$then" "$sources/examples/$program.c" -L"$folder/$then" -lminkray -lm \
      -o "$folder/$program"
    LD_LIBRARY_PATH="$build" "$folder/$program" >/dev/null ||
      { echo "$program of $then does not run"; exit 1; }
  done
  keeps_constants "$header" "$now" || { echo "constants of $then have other values"; exit 1; }
  echo "programs of $then run: $(functions_of "$folder/$then/libminkray.so" | wc -l) functions then," \
    "$(functions_of "$build/libminkray.so" | wc -l) now"
done

command -v abidiff >/dev/null || { echo "abidiff (abigail-tools) is missing"; exit 77; }
for header in "$here"/abi/minkray_c-*.header; do
  then="$(basename "$header" .header)"
  abidiff --no-added-syms --suppressions "$here/abi/compatible.abignore" "$folder/$then/libminkray.so" \
    "$folder/now/libminkray.so" ||
    { echo "programs of $then would break: a new SOVERSION is due"; exit 1; }
done

# What would break programs is found: a function less, a member more, members in another order, a
# constant of another value, a parameter of another type.
changed() {
  local name="changed$((++changes))"
  sed "$1" "$now" >"$folder/changed.h"
  cmp -s "$folder/changed.h" "$now" && { echo "nothing is changed by $1"; exit 1; }
  stub "$folder/changed.h" "$name"
  keeps_constants "$now" "$folder/changed.h" || return 0
  ! abidiff --no-added-syms "$folder/now/libminkray.so" "$folder/$name/libminkray.so" >/dev/null ||
    { echo "abidiff does not find $1"; exit 1; }
}
changes=0
changed 's/^MINKRAY_API const char\* minkray_version(void);//'
changed 's/^  double t_max;$/  double t_max; double more;/'
changed 's/^  double t; .*$//; s/^  double t_lo; .*$/  double t_lo; double t;/'
changed 's/MINKRAY_MISS = 1/MINKRAY_MISS = 4/'
changed 's/uint32_t object,$/uint64_t object,/'
echo "abidiff: nothing but additions; $changes changes that would break programs are found"
