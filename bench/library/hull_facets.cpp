// SPDX-License-Identifier: MIT
#include "hull_facets.h"

#include <set>
#include <stdexcept>
#include <utility>

namespace bench {
namespace {

using Index = std::uint32_t;
using Facet = std::array<Index, 3>;

/// Six times the volume of the facet's tetrahedron with `p`: greater than 0 if `p` sees the facet.
double seen_from(const Vec& p, const Facet& f, const std::vector<Vec>& points) {
  return dot(cross(points[f[1]] - points[f[0]], points[f[2]] - points[f[0]]), p - points[f[0]]);
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>> hull_facets(const std::vector<Vec>& points) {
  if (points.size() < 4) throw std::runtime_error("hull: must have at least 4 points");
  std::vector<Facet> facets = {{0, 1, 2}, {0, 2, 1}};
  Index fourth = 3;
  while (fourth < points.size() && seen_from(points[fourth], facets[0], points) == 0) ++fourth;
  if (fourth == points.size()) throw std::runtime_error("hull: all points are in a plane");
  for (Index p = 3; p < points.size(); ++p) {
    // The fourth point comes first; the two facets of the beginning are a flat hull.
    const Index now = p == 3 ? fourth : p == fourth ? 3 : p;
    std::vector<Facet> kept;
    std::set<std::pair<Index, Index>> edges;  // of the facets that are seen
    for (const Facet& f : facets) {
      if (!(seen_from(points[now], f, points) > 0)) {
        kept.push_back(f);
        continue;
      }
      for (std::size_t i = 0; i < 3; ++i) edges.insert({f[i], f[(i + 1) % 3]});
    }
    for (const auto& [from, to] : edges)
      if (!edges.contains({to, from})) kept.push_back({from, to, now});
    facets = std::move(kept);
  }
  return facets;
}

}  // namespace bench
