// SPDX-License-Identifier: MIT
// An ellipsoid as a user of the library would give it: its support function and that one's
// derivative.
#pragma once

#include <minkray/minkray.h>

#include <cmath>

/// The radii of what has ellipsoid_jet.
inline constexpr double jet_radii[3] = {1, 0.5, 0.25};

/// s = A n / h and ds/dn = A / h - s s^T / h, with A of the squared radii and h = n.s.
inline minkray::SupportJet ellipsoid_jet(const minkray::Vec3& n) {
  const double along[3] = {n.x, n.y, n.z};
  double h = 0, s[3];
  for (int i = 0; i < 3; ++i) h = std::hypot(h, jet_radii[i] * along[i]);
  for (int i = 0; i < 3; ++i) s[i] = jet_radii[i] * jet_radii[i] * along[i] / h;
  minkray::SupportJet jet = {{s[0], s[1], s[2]}, {}};
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      jet.derivative[i][k] = ((i == k ? jet_radii[i] * jet_radii[i] : 0) - s[i] * s[k]) / h;
  return jet;
}
