// SPDX-License-Identifier: MIT
// Verdicts of `minkray verify` as lines, tables and JSON.
#pragma once

#include <string>

#include "renderer/jobs/verify_inputs.h"
#include "renderer/json/json.h"

namespace minkray {

/// "plan.yaml: free: every pair stays at least 12.4 mm apart (...)", and a line for each stretch in
/// which a pair collides, or may collide.
std::string verdict_text(const std::string& name, const MotionVerdict& verdict, const Plan& plan,
                         const Workcell& cell);

/// Least clearance of each step.
std::string steps_table(const MotionVerdict& verdict, const Plan& plan, const Workcell& cell);

Json verdict_json(const std::string& name, const MotionVerdict& verdict, const Plan& plan,
                  const Workcell& cell);

}  // namespace minkray
