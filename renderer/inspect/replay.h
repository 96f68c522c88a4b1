// SPDX-License-Identifier: MIT
// JSON of a cast, step by step, for the page, which has no solver of its own. All numbers are in
// the shape's inner frame, relative to its ball's centre, as in CastIteration.
#pragma once

#include "renderer/json/json.h"
#include "renderer/paper/trace.h"

namespace minkray {

/// {"status", "path", "t", "t_lo", "t_hi", "normal", "iterations", "supports", "radius", "s", "r",
/// "lambda": [least, most], "t_of": [base, shift, per length], "steps"}. A step is [lambda, case,
/// lambda_clip, lower, upper, v, p, w, simplex]: lengths with all their digits, vectors in float.
Json replay_json(const CastTrace& trace);

}  // namespace minkray
