// SPDX-License-Identifier: MIT
#include "core/geometry/convex_hull.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <stdexcept>
#include <string>

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

namespace minkray {
namespace {

/// Sets thinner than this, relative to their largest coordinate, count as flat: points of a plane
/// that were rotated or computed are off it by a few roundings of their coordinates.
constexpr double flat_rounding = 16 * std::numeric_limits<double>::epsilon();

/// Coordinates larger than this, or smaller than its inverse, are scaled, since Qhull squares
/// lengths.
constexpr double most_in_range = 0x1p200;

/// Returns the index of the point with the largest measure, and the measure.
template <class Measure>
std::pair<std::size_t, double> furthest(std::span<const Vec3<double>> points, Measure&& measure) {
  std::pair<std::size_t, double> best = {0, -1.0};
  for (std::size_t i = 0; i < points.size(); ++i)
    if (const double value = measure(points[i]); value > best.second) best = {i, value};
  return best;
}

double twice_area(const Vec3<double>& a, const Vec3<double>& b, const Vec3<double>& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// Returns the hull by Andrew's monotone chain, counter-clockwise in the plane of x and y.
std::vector<std::uint32_t> polygon_around(std::span<const Vec3<double>> points) {
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
    return std::pair(points[i].x(), points[i].y()) < std::pair(points[j].x(), points[j].y());
  });
  std::vector<std::uint32_t> chain;
  const auto walk = [&](auto first, auto last) {
    const std::size_t start = chain.size();
    for (auto i = first; i != last; ++i) {
      while (chain.size() >= start + 2 &&
             !(twice_area(points[chain.end()[-2]], points[chain.end()[-1]], points[*i]) > 0))
        chain.pop_back();
      chain.push_back(*i);
    }
    chain.pop_back();  // the next chain begins with this point
  };
  walk(order.begin(), order.end());
  walk(order.rbegin(), order.rend());
  return chain;
}

/// One run of Qhull; frees what Qhull allocated.
class QhullRun {
 public:
  /// `coordinates` must outlive the run.
  QhullRun(std::vector<double>& coordinates, const char* options) {
    message_file_ = open_memstream(&message_, &message_size_);
    qh_zero(&qhull_, message_file_);
    std::string command = std::string("qhull ") + options;
    failed_ = qh_new_qhull(&qhull_, 3, static_cast<int>(coordinates.size() / 3), coordinates.data(),
                           False, command.data(), nullptr, message_file_) != 0;
  }
  ~QhullRun() {
    qh_freeqhull(&qhull_, !qh_ALL);
    int remaining = 0, allocated = 0;
    qh_memfreeshort(&qhull_, &remaining, &allocated);
    std::fclose(message_file_);
    std::free(message_);
  }
  QhullRun(const QhullRun&) = delete;
  QhullRun& operator=(const QhullRun&) = delete;

  bool failed() const { return failed_; }
  std::string message() {
    std::fflush(message_file_);
    return {message_, message_size_};
  }

  /// Returns the facets' corners as indices of points, in order around each facet, in either sense.
  Polygons facets() {
    Polygons polygons;
    std::vector<std::uint32_t> corners;
    qhT* qh = &qhull_;
    facetT* facet;
    FORALLfacets {
      corners.clear();
      setT* ordered = qh_facet3vertex(qh, facet);
      vertexT *vertex, **vertexp;
      FOREACHvertex_(ordered) {
        corners.push_back(static_cast<std::uint32_t>(qh_pointid(qh, vertex->point)));
      }
      qh_settempfree(qh, &ordered);
      polygons.add(corners);
    }
    return polygons;
  }

 private:
  qhT qhull_;
  bool failed_ = false;
  char* message_ = nullptr;
  std::size_t message_size_ = 0;
  FILE* message_file_ = nullptr;
};

/// Options for Qhull, tried in this order until one succeeds on a degenerate set. The first merges
/// all facets that are not clearly convex at each step. The second merges only concave facets until
/// the end, so that no facet becomes too wide. The third moves copies of the points at random by
/// some roundings, or further if necessary.
constexpr std::array ways_to_ask = {"Pp", "Pp Qx", "Pp QJ1e-14"};

/// Facets of a solid set.
Polygons solid_facets(std::span<const Vec3<double>> points) {
  std::vector<double> coordinates;
  coordinates.reserve(points.size() * 3);
  for (const Vec3<double>& p : points) coordinates.insert(coordinates.end(), p.begin(), p.end());
  std::string message;
  for (const char* options : ways_to_ask) {
    std::vector<double> copy = coordinates;  // some options change the coordinates
    QhullRun run(copy, options);
    if (!run.failed()) return run.facets();
    message = run.message();
  }
  throw std::runtime_error("Qhull failed: " + message.substr(0, message.find('\n')));
}

/// Twice the area times the normal of a polygon, by Newell's method about its first corner.
template <class Corner>
Vec3<double> newell_normal(std::size_t size, Corner&& corner) {
  Vec3<double> sum = Vec3<double>::Zero();
  for (std::size_t i = 1; i + 1 < size; ++i)
    sum += (corner(i) - corner(0)).cross(corner(i + 1) - corner(0));
  return sum;
}

}  // namespace

RoundFrame round_frame(std::span<const Vec3<double>> points, double flatness) {
  RoundFrame frame;
  const std::size_t lowest = furthest(points, [&](const Vec3<double>& p) {
                               return (p - points[0]).cwiseAbs().maxCoeff();
                             }).first;
  frame.origin = points[lowest];
  // Divides lengths by `size`, so that squares neither underflow nor overflow.
  const double size = furthest(points, [&](const Vec3<double>& p) {
                        return (p - frame.origin).cwiseAbs().maxCoeff();
                      }).second;
  const double largest =
      furthest(points, [](const Vec3<double>& p) { return p.cwiseAbs().maxCoeff(); }).second;
  if (!(size > flat_rounding * largest)) return frame;
  const double thinnest = std::max(flatness, flat_rounding * (largest / size));

  // Gram-Schmidt: each axis leads to the point furthest from the first point, line or plane.
  for (int axis = 0; axis < 3; ++axis) {
    // Component of a point's position perpendicular to the axes so far. Computed twice, since the
    // first pass loses digits.
    const auto across = [&](const Vec3<double>& p) {
      Vec3<double> rest = (p - frame.origin) / size;
      for (int pass = 0; pass < 2; ++pass)
        for (int i = 0; i < axis; ++i) rest -= frame.axes.col(i).dot(rest) * frame.axes.col(i);
      return rest;
    };
    const auto [index, width] =
        furthest(points, [&](const Vec3<double>& p) { return across(p).squaredNorm(); });
    const double extent = std::sqrt(width);
    if (axis > 0 && !(extent > thinnest)) break;
    frame.axes.col(axis) = across(points[index]) / extent;
    frame.extents[axis] = extent * size;
    frame.rank = axis + 1;
  }
  // The axes beyond the rank complete the frame.
  if (frame.rank == 1) frame.axes.col(1) = frame.axes.col(0).unitOrthogonal();
  if (frame.rank < 3 && frame.rank > 0)
    frame.axes.col(2) = frame.axes.col(0).cross(frame.axes.col(1));
  for (int axis = frame.rank; axis < 3; ++axis) frame.extents[axis] = size;
  return frame;
}

namespace {

/// Requires that squares of differences of coordinates are in range.
ConvexHull hull_in_range(std::span<const Vec3<double>> points) {
  ConvexHull hull;
  hull.frame = round_frame(points);
  std::vector<Vec3<double>> q;
  q.reserve(points.size());
  for (const Vec3<double>& p : points) q.push_back(hull.frame.to_frame(p));

  // Finds facets whose corners are indices into the input.
  Polygons facets;
  if (hull.rank() == 0) {
    hull.vertices = {0};
  } else if (hull.rank() == 1) {
    const auto [low, high] = std::minmax_element(
        q.begin(), q.end(), [](const auto& a, const auto& b) { return a.x() < b.x(); });
    hull.vertices = {static_cast<std::uint32_t>(low - q.begin()),
                     static_cast<std::uint32_t>(high - q.begin())};
  } else {
    if (hull.rank() == 2)
      facets.add(polygon_around(q));
    else
      facets = solid_facets(q);
    hull.vertices = facets.corners;
  }
  std::sort(hull.vertices.begin(), hull.vertices.end());
  hull.vertices.erase(std::unique(hull.vertices.begin(), hull.vertices.end()), hull.vertices.end());

  // Makes corners indices into `vertices`, in the same sense of rotation for all facets.
  std::vector<std::uint32_t> position(points.size());
  for (std::size_t i = 0; i < hull.vertices.size(); ++i)
    position[hull.vertices[i]] = static_cast<std::uint32_t>(i);
  Vec3<double> centre = Vec3<double>::Zero();
  for (const std::uint32_t v : hull.vertices) centre += q[v];
  centre /= static_cast<double>(hull.vertices.size());
  const bool mirrored = hull.frame.axes.determinant() < 0;
  std::vector<std::uint32_t> corners;
  for (std::size_t f = 0; f < facets.size(); ++f) {
    const auto indices = facets[f];
    corners.clear();
    for (const std::uint32_t i : indices) corners.push_back(position[i]);
    const auto corner = [&](std::size_t i) { return q[indices[i]]; };
    const Vec3<double> normal = newell_normal(indices.size(), corner);
    const bool inward = hull.rank() == 3 && normal.dot(corner(0) - centre) < 0;
    if (inward != mirrored) std::reverse(corners.begin(), corners.end());
    hull.facets.add(corners);
  }
  return hull;
}

}  // namespace

ConvexHull convex_hull(std::span<const Vec3<double>> points) {
  double largest = 0;
  Vec3<double> lower = points[0], upper = points[0];
  for (const Vec3<double>& p : points) {
    largest = std::max(largest, p.cwiseAbs().maxCoeff());
    lower = lower.cwiseMin(p);
    upper = upper.cwiseMax(p);
  }
  if (!std::isfinite((upper - lower).stableNorm()))
    throw std::runtime_error("must not be wider than the largest number");
  if (largest == 0 || (largest < most_in_range && largest > 1 / most_in_range))
    return hull_in_range(points);
  // Scales by a power of two, which keeps the points exact except for coordinates that are
  // negligible.
  const int exponent = std::ilogb(largest);
  std::vector<Vec3<double>> scaled;
  scaled.reserve(points.size());
  const auto scale = [](Vec3<double> v, int by) {
    for (double& x : v) x = std::ldexp(x, by);
    return v;
  };
  for (const Vec3<double>& p : points) scaled.push_back(scale(p, -exponent));
  ConvexHull hull = hull_in_range(scaled);
  hull.frame.origin = scale(hull.frame.origin, exponent);
  hull.frame.extents = scale(hull.frame.extents, exponent);
  return hull;
}

std::vector<Vec3<double>> intersection_vertices(std::span<const HalfSpace> half_spaces,
                                                const Vec3<double>& interior) {
  // A plane n.x = d (d > 0, about the interior point) is dual to the point n / d, and the plane of
  // a facet of the dual points to a vertex.
  std::vector<Vec3<double>> dual;
  dual.reserve(half_spaces.size());
  for (const HalfSpace& half_space : half_spaces) {
    const double distance = half_space.offset - half_space.normal.dot(interior);
    if (!(distance > 0)) throw std::runtime_error("half-spaces: the interior point lies outside");
    dual.push_back(half_space.normal / distance);
  }
  const ConvexHull hull = convex_hull(dual);
  if (hull.rank() < 3) throw std::runtime_error("half-spaces: their intersection is not bounded");
  std::vector<Vec3<double>> vertices;
  vertices.reserve(hull.facets.size());
  for (std::size_t f = 0; f < hull.facets.size(); ++f) {
    const auto corners = hull.facets[f];
    const auto corner = [&](std::size_t i) { return dual[hull.vertices[corners[i]]]; };
    const Vec3<double> normal = newell_normal(corners.size(), corner);
    double offset = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) offset += normal.dot(corner(i));
    offset /= static_cast<double>(corners.size());
    if (!(offset > 0)) throw std::runtime_error("half-spaces: their intersection is not bounded");
    vertices.push_back(interior + normal / offset);
  }
  return vertices;
}

}  // namespace minkray
