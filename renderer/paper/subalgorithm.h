// SPDX-License-Identifier: MIT
// The list of distance subalgorithms, and their interface for solvers.
#pragma once

#include <array>
#include <concepts>

#include "core/gjk/simplex.h"
#include "core/support/named_kind.h"
#include "renderer/paper/johnson.h"
#include "renderer/paper/signed_volumes.h"

namespace minkray {

/// Usage: begin(x), then repeatedly add(p) or move(x), closest() and keep(). There are never more
/// than `slots` vertices.
template <class G>
concept DistanceSubalgorithm = requires(G g, const G& c,
                                        const Vec<typename G::Scalar, G::dimension>& p) {
  g.begin(p);
  g.move(p);
  { g.add(p) } -> std::same_as<int>;
  { c.closest() } -> std::same_as<ClosestPoint<typename G::Scalar, G::dimension>>;
  { c.holds(p) } -> std::same_as<bool>;
  g.keep(0u);
};

enum class SubalgorithmKind : unsigned char { projection, johnson, signed_volumes };

inline constexpr std::array named_subalgorithms = {
    NamedKind<SubalgorithmKind>{SubalgorithmKind::projection, "projection",
                                "projections on vertices, edges and faces, the most robust"},
    NamedKind<SubalgorithmKind>{SubalgorithmKind::johnson, "johnson",
                                "Johnson's determinants, cached, with the backup procedure"},
    NamedKind<SubalgorithmKind>{SubalgorithmKind::signed_volumes, "signed-volumes",
                                "signed volumes, Montanari et al. (2017)"},
};

/// Returns visit(subalgorithm) for a new subalgorithm of the kind.
template <class T, int Dim, class Visit>
decltype(auto) with_subalgorithm(SubalgorithmKind kind, Visit&& visit) {
  switch (kind) {
    case SubalgorithmKind::johnson:
      return visit(JohnsonSubalgorithm<T, Dim>());
    case SubalgorithmKind::signed_volumes:
      return visit(SignedVolumesSubalgorithm<T, Dim>());
    case SubalgorithmKind::projection:
      break;
  }
  return visit(Simplex<T, Dim>());
}

static_assert(DistanceSubalgorithm<JohnsonSubalgorithm<double, 2>>);
static_assert(DistanceSubalgorithm<SignedVolumesSubalgorithm<float, 3>>);
static_assert(DistanceSubalgorithm<Simplex<double, 3>>);

}  // namespace minkray
