#!/bin/sh
# SPDX-License-Identifier: MIT
# same_bits_on_all_processors.sh PROGRAM: the C library's functions of long double that ask x87 for
# logarithms, powers and angles have other last bits on processors of other makers. No program of
# ours calls one.
set -eu
asked="$(nm -D --undefined-only "$1" |
  grep -E ' (pow|exp|exp2|exp10|expm1|log|log2|log10|log1p|sin|cos|tan|sincos|asin|acos|atan|atan2|sinh|cosh|tanh|asinh|acosh|atanh|cbrt|tgamma|lgamma|erf|erfc)l(@|$)' || true)"
if [ -n "$asked" ]; then
  echo "$1 calls functions whose bits depend on the processor's maker:"
  echo "$asked"
  exit 1
fi
