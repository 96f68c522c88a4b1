// SPDX-License-Identifier: MIT
// Distances, overlap tests and shape casts compared with Bullet 3.24 (float), FCL 0.7 and libccd
// 2.1 on the same random queries: time and error side by side. Errors refer to our double result,
// whose certificate is printed for distances. Times are the best of several interleaved rounds on
// one core and include what each library does for a query, but not making the shapes.
#include <array>
#include <cstdio>
#include <utility>

#include "bench/papers/comparisons.h"
#include "renderer/paper/distance.h"

int main() {
  using namespace minkray;
  using namespace minkray::bench;
  const std::vector<Everywhere> shapes = make_shapes();
  const std::vector<Query> list = make_queries();
  double widest = 0;
  for (const Everywhere& a : shapes)
    for (const Query& query : list) {
      const auto result = distance_between(centred(a.ours, query.a), centred(a.ours, query.b));
      widest = std::max(widest, result.distance - result.lower);
    }
  std::printf(
      "%d queries each, best of %d interleaved rounds, one core.\n"
      "Errors are against the first row, whose distances are proven to %.0e by their planes;\n"
      "\"wrong\": off by more than %.0e; \"verdict\": answers where the first has none or the "
      "other way round.\n",
      queries, rounds, widest, wrong);
  const std::array<std::pair<int, int>, 5> pairs = {{{0, 1}, {1, 1}, {2, 3}, {4, 4}, {1, 2}}};
  for (const auto& [i, j] : pairs) {
    const Everywhere &a = shapes[static_cast<std::size_t>(i)],
                     &b = shapes[static_cast<std::size_t>(j)];
    compare_distances(a, b, list);
    compare_overlaps(a, b, list);
    compare_casts(a, b, list);
  }
}
