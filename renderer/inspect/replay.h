// SPDX-License-Identifier: MIT
// What the page needs to show a cast step by step, as JSON: numbers that were computed here, since
// the page has no solver of its own. Everything is in the shape's inner frame, from its ball's
// centre, as CastIteration has it.
#pragma once

#include "renderer/json/json.h"
#include "renderer/query/trace.h"

namespace minkray {

/// {"status", "path", "t", "t_lo", "t_hi", "normal", "iterations", "supports", "radius", "s", "r",
/// "lambda": [least, most], "t_of": [base, shift, per length], "steps"}. A step is [lambda, case,
/// lambda_clip, lower, upper, v, p, w, simplex]: lengths with all their digits, vectors in float.
Json replay_json(const CastTrace<double>& trace);

}  // namespace minkray
