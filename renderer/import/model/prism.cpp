// SPDX-License-Identifier: MIT
#include "renderer/import/model/prism.h"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>

#include "core/geometry/point_cloud.h"

namespace minkray {
namespace {

using Corner = std::array<double, 2>;

constexpr std::size_t most_prisms = 100'000;
/// Each is compared with each other, and looked for at each stop of the sweep.
constexpr std::size_t most_edges = 5'000, most_stops = 20'000;

/// From left to right.
struct Edge {
  Corner left, right;
  double slope() const { return (right[1] - left[1]) / (right[0] - left[0]); }
  /// At its ends exactly the corners.
  double at(double x) const {
    if (x == left[0]) return left[1];
    if (x == right[0]) return right[1];
    return left[1] + (x - left[0]) * slope();
  }
};

/// The area between two edges, from one x to another.
struct Trapezoid {
  std::size_t below = 0, above = 0;  ///< edges
  double from = 0, to = 0;
};

/// Without corners that follow themselves; the last may be the first again.
Outline without_repeats(const Outline& outline) {
  Outline corners;
  for (const Corner& corner : outline)
    if (corners.empty() || corner != corners.back()) corners.push_back(corner);
  while (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
  return corners;
}

double turn(const Corner& a, const Corner& b, const Corner& c) {
  return (b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0]);
}

/// True if the corners turn one way, once around.
bool is_convex(const Outline& corners) {
  const std::size_t count = corners.size();
  int left = 0, right = 0, turns_back = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Corner &a = corners[i], &b = corners[(i + 1) % count], &c = corners[(i + 2) % count];
    const double t = turn(a, b, c);
    left += t > 0;
    right += t < 0;
    turns_back += (b[0] > a[0]) != (c[0] > b[0]);
  }
  return count >= 3 && left + right > 0 && (left == 0 || right == 0) && turns_back <= 2;
}

Shape prism(const std::vector<Corner>& corners, double height) {
  std::vector<Vec3<double>> points;
  for (const Corner& corner : corners)
    for (const double z : {0.0, height}) points.emplace_back(corner[0], corner[1], z);
  return Hull{PointCloud(points)};
}

class Decomposition {
 public:
  explicit Decomposition(const std::vector<Outline>& outlines) {
    for (const Outline& corners : outlines)
      for (std::size_t i = 0; i < corners.size(); ++i) {
        Corner a = corners[i], b = corners[(i + 1) % corners.size()];
        stops_.push_back(a[0]);
        if (a[0] == b[0]) continue;
        if (a[0] > b[0]) std::swap(a, b);
        edges_.push_back({a, b});
      }
    if (edges_.size() > most_edges)
      throw std::runtime_error("must have at most " + std::to_string(most_edges) + " points (got " +
                               std::to_string(edges_.size()) + ")");
    add_crossings();
    std::ranges::sort(stops_);
    stops_.erase(std::unique(stops_.begin(), stops_.end()), stops_.end());
  }

  std::vector<Trapezoid> trapezoids() {
    std::vector<Trapezoid> done;
    std::map<std::pair<std::size_t, std::size_t>, double> open;  // from where, by edges
    for (std::size_t i = 0; i + 1 < stops_.size(); ++i) {
      const double from = stops_[i], to = stops_[i + 1];
      const std::vector<std::size_t> order = edges_between(from, to);
      std::map<std::pair<std::size_t, std::size_t>, double> next;
      for (std::size_t k = 0; k + 1 < order.size(); k += 2) {
        const std::pair pair(order[k], order[k + 1]);
        const auto known = open.find(pair);
        next[pair] = known == open.end() ? from : known->second;
        if (known != open.end()) open.erase(known);
      }
      for (const auto& [pair, begin] : open) done.push_back({pair.first, pair.second, begin, from});
      open = std::move(next);
      if (done.size() + open.size() > most_prisms)
        throw std::runtime_error("must need at most " + std::to_string(most_prisms) +
                                 " convex prisms");
    }
    for (const auto& [pair, begin] : open)
      done.push_back({pair.first, pair.second, begin, stops_.back()});
    return done;
  }

  /// Corners of the trapezoid, three if two of its edges meet.
  std::vector<Corner> corners_of(const Trapezoid& trapezoid) const {
    const Edge &below = edges_[trapezoid.below], &above = edges_[trapezoid.above];
    std::vector<Corner> corners;
    for (const double x : {trapezoid.from, trapezoid.to}) {
      corners.push_back({x, below.at(x)});
      if (above.at(x) != below.at(x)) corners.push_back({x, above.at(x)});
    }
    return corners;
  }

 private:
  /// Cuts edges that cross each other at the crossing.
  void add_crossings() {
    for (std::size_t i = 0; i < edges_.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const Edge &a = edges_[i], &b = edges_[j];
        const double from = std::max(a.left[0], b.left[0]), to = std::min(a.right[0], b.right[0]);
        if (!(from < to)) continue;
        const double first = a.at(from) - b.at(from), last = a.at(to) - b.at(to);
        if ((first > 0) == (last > 0) || first == 0 || last == 0) continue;
        const double x = from + (to - from) * (first / (first - last));
        if (from < x && x < to) stops_.push_back(x);
        if (stops_.size() > most_stops) throw std::runtime_error("must cross itself less often");
      }
  }

  /// Those that go all the way, from the lowest to the highest.
  std::vector<std::size_t> edges_between(double from, double to) const {
    const double middle = from + (to - from) / 2;
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t i = 0; i < edges_.size(); ++i)
      if (edges_[i].left[0] <= from && edges_[i].right[0] >= to)
        order.emplace_back(edges_[i].at(middle), i);
    std::ranges::sort(order);
    std::vector<std::size_t> edges;
    for (const auto& [y, edge] : order) edges.push_back(edge);
    return edges;
  }

  std::vector<Edge> edges_;
  std::vector<double> stops_;  ///< x at which trapezoids may begin and end
};

}  // namespace

std::vector<Shape> prisms_of(const std::vector<Outline>& outlines, double height) {
  std::vector<Outline> corners;
  for (const Outline& outline : outlines) corners.push_back(without_repeats(outline));
  if (corners.size() == 1 && is_convex(corners[0])) return {prism(corners[0], height)};
  std::vector<Shape> prisms;
  Decomposition decomposition(corners);
  for (const Trapezoid& trapezoid : decomposition.trapezoids()) {
    const std::vector<Corner> base = decomposition.corners_of(trapezoid);
    if (base.size() >= 3) prisms.push_back(prism(base, height));
  }
  if (prisms.empty()) throw std::runtime_error("must enclose an area");
  return prisms;
}

}  // namespace minkray
