#!/bin/sh
# SPDX-License-Identifier: MIT
# isa_symbols.sh OBJECT ISA: code that was compiled for one instruction set must not stand in for
# the same code elsewhere. The linker merges functions of the same name that several objects define
# (weak ones), so each such name in the object must contain the instruction set's.
set -eu
strays="$(nm -C --defined-only "$1" | grep -E '^[0-9a-f]+ [WVu] ' | grep -v "$2" |
  grep -vE 'bad_variant_access' || true)"
if [ -n "$strays" ]; then
  echo "$1 defines code that others may be linked to:"
  echo "$strays"
  exit 1
fi
