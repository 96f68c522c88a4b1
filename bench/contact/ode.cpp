// SPDX-License-Identifier: MIT
#include <algorithm>

#include "bench/contact/peers.h"

namespace minkray::bench {
namespace {

using Geom = std::shared_ptr<dxGeom>;

Geom placed(const Everybody& body, const Affine<double>& pose) {
  const Geom geom(body.ode(), dGeomDestroy);
  const Mat3<double>& m = pose.linear;
  const dMatrix3 turn = {m(0, 0), m(0, 1), m(0, 2), 0,       m(1, 0), m(1, 1),
                         m(1, 2), 0,       m(2, 0), m(2, 1), m(2, 2), 0};
  dGeomSetPosition(geom.get(), pose.translation.x(), pose.translation.y(), pose.translation.z());
  dGeomSetRotation(geom.get(), turn);
  return geom;
}

}  // namespace

std::vector<Contestant> ode_contacts(const Asked& asked) {
  if (!asked.a.ode || !asked.b.ode) return {};
  std::vector<std::pair<Geom, Geom>> pairs;
  for (const Placement& at : asked.where)
    pairs.emplace_back(placed(asked.a, at.a), placed(asked.b, at.b));
  return {{"ODE", [pairs = std::move(pairs)](std::size_t i) {
             constexpr int most = 8;
             dContactGeom contacts[most];
             const int count = dCollide(pairs[i].first.get(), pairs[i].second.get(), most, contacts,
                                        sizeof contacts[0]);
             double depth = count > 0 ? 0 : no_answer;
             for (int k = 0; k < count; ++k) depth = std::max(depth, double(contacts[k].depth));
             return -depth;
           }}};
}

}  // namespace minkray::bench
