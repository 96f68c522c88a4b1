// SPDX-License-Identifier: MIT
#include "renderer/member_json/read_member_keys.h"

namespace minkray {
namespace {

/// Directions are taken for opposite if the sine of their angle is below this.
constexpr double opposite_sine = 1e-9;

}  // namespace

void check_turn(const Vec3<double>& from, const Vec3<double>& to, const JsonPath& path,
                Mistakes& mistakes) {
  const Vec3<double> a = unit(from), b = unit(to);
  if (a.dot(b) < 0 && a.cross(b).norm() < opposite_sine)
    mistakes.add(path, "must not be opposite to the key before: put a key between them");
}

}  // namespace minkray
