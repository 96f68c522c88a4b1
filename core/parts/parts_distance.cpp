// SPDX-License-Identifier: MIT
#include "core/parts/parts_distance.h"

#include "core/mesh/mesh_ray.h"
#include "core/parts/one_part.h"
#include "core/parts/pair_walk.h"
#include "core/parts/triangle_lanes.h"

namespace minkray {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Some points of the body, in its frame: one per piece of it that a mesh may enclose alone.
std::vector<Vec3<double>> points_of(const PartsBody& body) {
  if (body.mesh()) return {body.mesh()->corner(0, 0)};
  if (body.shape()) return {body.shape()->middle()};
  std::vector<Vec3<double>> points;
  for (std::size_t i = 0; i < body.size(); ++i)
    points.push_back(body.compound()->contact(i).middle());
  return points;
}

std::optional<Vec3<double>> point_held_by(const PartsBody& one, const Affine<double>& pose,
                                          const PartsBody& other,
                                          const Affine<double>& pose_other) {
  if (!one.mesh()) return {};  // convex parts are solid: the search finds parts inside them
  for (const Vec3<double>& own : points_of(other)) {
    const Vec3<double> point = pose_other(own);
    const Vec3<double> seen = pose.linear.transpose() * (point - pose.translation);
    if (is_within(*one.mesh(), seen)) return point;
  }
  return {};
}

/// Least distance over the pairs of parts that a traversal visits.
class LeastDistance {
 public:
  LeastDistance(const PartsBody& a, const Affine<double>& pose_a, const PartsBody& b,
                const Affine<double>& pose_b, const SignedDistanceOptions& options)
      : pose_a_(pose_a),
        pose_b_(pose_b),
        options_(options),
        a_(a),
        b_(b),
        sight_(a_, pose_a, b_, pose_b),
        walk_(a_, b_, sight_),
        near_(options.tolerance * (a_.radius() + b_.radius())) {}

  /// Considers only pairs of parts that are no further apart than `enough`, `first` before others.
  SignedDistance run(double enough, PartPair* parts, const PartPair& first) {
    enough_ = enough;
    const bool is_over = is_part(a_, first.a) && is_part(b_, first.b) && visit_first(first);
    const auto key = [](double gap, const MiddleBox&, const MiddleBox&) { return gap; };
    const auto left = [&] { return limit(); };
    const double left_out =
        is_over ? 0
        : a_.mesh() && b_.mesh()
            ? walk_.run_leaves(key, left, [&](auto a, auto b) { return visit_leaves(a, b); })
            : walk_.run(key, left, [&](auto a, auto b) { return visit_by_search(a, b); });
    if (parts) *parts = parts_;
    best_.supports = supports_;
    best_.is_exhausted = is_exhausted_;
    if (is_crossed_) return best_;
    best_.lower = std::min(std::max(0.0, std::min(lower_, left_out)), best_.upper);
    best_.value =
        best_.upper < infinity ? std::clamp(best_.value, best_.lower, best_.upper) : best_.lower;
    best_.status = best_.lower > 0                          ? SignedStatus::separated
                   : best_.status == SignedStatus::touching ? best_.status
                                                            : SignedStatus::undecided;
    return best_;
  }
  bool is_crossed() const { return is_crossed_; }

 private:
  /// Parts with a common edge or vertex, or that touch along a plane, have equal distances: a lower
  /// bound within `same_` of the best upper bound is enough, without another exact test.
  double limit() const { return std::min(best_.upper - same_, enough_); }

  /// True if a pair with this lower bound needs no closer test.
  bool is_enough(double lower) const { return lower > limit(); }

  static bool is_part(const BodyTree& tree, std::uint32_t part) {
    return tree.is_shape() ? part == no_part : part < tree.body().size();
  }
  bool visit_first(const PartPair& first) {
    if (!a_.mesh() || !b_.mesh()) return visit_by_search(first.a, first.b);
    TriangleCorners of_b = b_.triangle(first.b);
    for (Vec3<double>& corner : of_b) corner = sight_.b_in_a.turn * corner + sight_.b_in_a.shift;
    return visit_triangles(a_.triangle(first.a), first.a, of_b, first.b);
  }

  bool visit_leaves(BodyTree::Box leaf_a, BodyTree::Box leaf_b) {
    EightTriangles of_a, of_b;
    a_.open_leaf(leaf_a, of_a);
    b_.open_leaf(leaf_b, of_b, &sight_.b_in_a);
    const double down = walk_.has_direction() ? of_b.reach_along(-walk_.direction()) : infinity;
    const Vec3<double> n = walk_.direction();
    for (int i = 0; i < of_a.count; ++i) {
      const TriangleCorners triangle = of_a.triangle(i);
      if (const double lower = -down - reach_along(triangle, n) - sight_.rounding;
          is_enough(lower)) {
        lower_ = std::min(lower_, lower);
        continue;
      }
      double gaps[EightTriangles::most];
      triangle_gaps(triangle, of_a.normal(i), of_b,
                    walk_.has_direction() ? &walk_.direction() : nullptr, gaps);
      OrderOfEight order;
      for (int j = 0; j < of_b.count; ++j)
        if (const double lower = gaps[j] - sight_.rounding; is_enough(lower))
          lower_ = std::min(lower_, lower);
        else
          order.add(lower, j);
      for (int j = 0; j < order.size(); ++j) {
        const int other = order.index(j);
        if (is_enough(order.key(j)))
          lower_ = std::min(lower_, order.key(j));
        else if (visit_triangles(triangle, of_a.parts[i], of_b.triangle(other), of_b.parts[other]))
          return true;
      }
    }
    return false;
  }

  bool visit_triangles(const TriangleCorners& triangle_a, std::uint32_t of_a,
                       const TriangleCorners& triangle_b, std::uint32_t of_b) {
    const TriangleGap gap = triangle_gap(triangle_a, triangle_b);
    const double lower = gap.lower - sight_.rounding, upper = gap.upper + sight_.rounding;
    if (lower > limit()) {
      lower_ = std::min(lower_, lower);
      return false;
    }
    if (lower > 0 && upper - lower <= std::max(near_, 3 * sight_.rounding)) {
      lower_ = std::min(lower_, lower);
      if (upper < best_.upper) {
        best_ = {};
        best_.status = SignedStatus::separated;
        best_.value = gap.upper;
        best_.upper = upper;
        best_.normal = sight_.turn_a * gap.normal;
        best_.point_a = in_world(gap.point_a);
        best_.point_b = in_world(gap.point_b);
        parts_ = {of_a, of_b};
        walk_.set_direction(gap.normal);
      }
      return false;
    }
    Vec3<double> common;
    if (!(lower > 0) && surely_cross(triangle_a, triangle_b, sight_.rounding, common)) {
      best_ = {};
      best_.status = SignedStatus::overlapping;
      best_.point_a = best_.point_b = in_world(common);
      const Vec3<double> across =
          (triangle_b[1] - triangle_b[0]).cross(triangle_b[2] - triangle_b[0]);
      best_.normal = sight_.turn_a * across.stableNormalized();
      parts_ = {of_a, of_b};
      return is_crossed_ = true;
    }
    return visit_by_search(of_a, of_b);
  }

  /// Runs GJK: unless both bodies are meshes, and for triangles that nearly touch or cross.
  bool visit_by_search(std::uint32_t of_a, std::uint32_t of_b) {
    if (walk_.has_direction()) {
      const double lower = gap_along_direction(of_a, of_b) - sight_.rounding;
      if (is_enough(lower)) {
        lower_ = std::min(lower_, lower);
        return false;
      }
    }
    const OnePart part_a(a_.body(), of_a), part_b(b_.body(), of_b);
    SignedDistanceOptions how = options_;
    how.at_most = limit();
    const SignedDistance found =
        signed_distance(part_a.shape(), pose_a_, part_b.shape(), pose_b_, how);
    supports_ += found.supports;
    is_exhausted_ |= found.is_exhausted;
    lower_ = std::min(lower_, found.lower);
    if (found.upper < best_.upper) {
      best_ = found;
      parts_ = {part_a.number(), part_b.number()};
      if (!found.normal.isZero(0))
        walk_.set_direction((sight_.turn_a.transpose() * found.normal).normalized());
    }
    is_crossed_ = found.status == SignedStatus::overlapping;
    return is_crossed_;
  }

  /// Gap between planes perpendicular to the walk's direction.
  double gap_along_direction(std::uint32_t of_a, std::uint32_t of_b) const {
    const Vec3<double>& n = walk_.direction();
    const double up_a = a_.is_shape() ? walk_.up_a() : a_.reach_of_part(of_a, n);
    const double down_b =
        b_.is_shape() ? walk_.down_b() : b_.reach_of_part(of_b, -(sight_.a_in_b.turn * n));
    return n.dot(sight_.b_in_a.shift) - down_b - up_a;
  }

  Vec3<double> in_world(const Vec3<double>& point) const {
    return sight_.middle_a + sight_.turn_a * point;
  }

  const Affine<double>&pose_a_, &pose_b_;
  const SignedDistanceOptions options_;
  const BodyTree a_, b_;
  const Sight sight_;
  PairWalk walk_;
  const double near_;  ///< bounds this close to each other have converged
  const double same_ = 4 * sight_.rounding;
  double enough_ = infinity;
  SignedDistance best_;
  PartPair parts_;
  double lower_ = infinity;  ///< of all visited pairs
  int supports_ = 0;
  bool is_crossed_ = false, is_exhausted_ = false;
};

/// True if the point is inside a closed mesh and not at its surface.
bool is_surely_within(const PartsBody& body, const Affine<double>& pose,
                      const Vec3<double>& point) {
  const TriangleMesh& mesh = *body.mesh();
  if (!is_within(mesh, pose.linear.transpose() * (point - pose.translation))) return false;
  static const ContactShape alone{Shape(Point())};
  Affine<double> at_point;
  at_point.translation = point;
  constexpr double rounding = 1e-13;
  const double least = rounding * (mesh.reach() + pose.translation.norm() + point.norm());
  LeastDistance distance(body, pose, alone, at_point, {});
  return distance.run(infinity, nullptr, {}).lower > least;
}

/// Returns one of some points of a convex part that is inside the mesh.
std::optional<Vec3<double>> point_of_shape_within(const ContactShape& shape,
                                                  const Affine<double>& pose, const PartsBody& mesh,
                                                  const Affine<double>& pose_mesh) {
  constexpr double nearly = 1 - 0x1p-10;
  if (!(shape.core().ball > 0)) return {};  // a point: it was tested already
  const Vec3<double> middle = middle_in_world(shape, pose);
  const Mat3<double> turn = turn_in_world(shape, pose);
  for (int i = 0; i < 6; ++i) {
    const Vec3<double> d = (i < 3 ? 1.0 : -1.0) * Vec3<double>::Unit(i % 3);
    const Vec3<double> end = support_of_core<CoreKind::other>(shape.core(), d).point;
    const Vec3<double> point = middle + nearly * (turn * end);
    if (is_surely_within(mesh, pose_mesh, point)) return point;
  }
  return {};
}

std::optional<Vec3<double>> point_of_parts_within(const PartsBody& body, const Affine<double>& pose,
                                                  const PartsBody& mesh,
                                                  const Affine<double>& pose_mesh) {
  if (body.shape()) return point_of_shape_within(*body.shape(), pose, mesh, pose_mesh);
  for (std::size_t i = 0; i < body.size(); ++i)
    if (const auto point =
            point_of_shape_within(body.compound()->contact(i), pose, mesh, pose_mesh))
      return point;
  return {};
}

Vec3<double> middle_of_part(const TriangleMesh& mesh, std::uint32_t part) {
  return (mesh.corner(part, 0) + mesh.corner(part, 1) + mesh.corner(part, 2)) / 3;
}

/// Appends up to `most` triangles below a node whose middles are in the box, from as many branches
/// of the BVH as possible. Returns their number.
std::size_t add_parts_in(const TriangleMesh& mesh, std::uint32_t what, const Bounds<double>& box,
                         std::size_t most, std::vector<std::uint32_t>& parts) {
  const auto holds = [&](const Vec3<double>& point) {
    return (point.array() >= box.lower.array()).all() && (point.array() <= box.upper.array()).all();
  };
  std::size_t found = 0;
  if ((what & BvhNode::leaf) != 0) {
    const MeshLeaf& leaf = mesh.leaves()[what & ~BvhNode::leaf];
    for (int i = 0; i < leaf.size() && found < most; ++i) {
      if (!holds(middle_of_part(mesh, leaf.triangles[i]))) continue;
      parts.push_back(leaf.triangles[i]);
      ++found;
    }
    return found;
  }
  const BvhNode& node = mesh.bvh().nodes[what];
  std::uint32_t children[bvh_width];
  std::size_t count = 0;
  for (int i = 0; i < bvh_width && node.children[i] != BvhNode::none; ++i) {
    const Bounds<float> child = node.box(i);
    if ((child.lower.cast<double>().array() <= box.upper.array()).all() &&
        (child.upper.cast<double>().array() >= box.lower.array()).all())
      children[count++] = node.children[i];
  }
  for (std::size_t i = 0; i < count && found < most; ++i) {
    const std::size_t share = (most - found + count - i - 1) / (count - i);
    found += add_parts_in(mesh, children[i], box, share, parts);
  }
  return found;
}

/// Returns a point on the surface of `one`, or a little below it, that is inside both meshes. Tries
/// the middles of some triangles.
std::optional<Vec3<double>> point_of_mesh_within(const PartsBody& one, const Affine<double>& pose,
                                                 const PartsBody& other,
                                                 const Affine<double>& pose_other) {
  constexpr std::size_t most_tries = 24;
  constexpr double below = 0x1p-10;
  const TriangleMesh& mesh = *one.mesh();
  const Mat3<double> turn = pose.linear.transpose();
  const Affine<double> other_in_one{turn * pose_other.linear,
                                    turn * (pose_other.translation - pose.translation)};
  std::vector<std::uint32_t> near;
  add_parts_in(mesh, 0, bounds_of(other, other_in_one), most_tries, near);
  for (const std::uint32_t part : near) {
    const Vec3<double> middle = middle_of_part(mesh, part);
    const Vec3<double> on = pose(middle);
    if (is_surely_within(other, pose_other, on)) return on;
    const Vec3<double> in = pose(middle - below * mesh.reach() * mesh.normal(part));
    if (is_surely_within(other, pose_other, in) && is_surely_within(one, pose, in)) return in;
  }
  return {};
}

/// Returns a point inside both bodies though no two parts surely cross: edges may lie on edges.
std::optional<Vec3<double>> common_point(const PartsBody& a, const Affine<double>& pose_a,
                                         const PartsBody& b, const Affine<double>& pose_b) {
  if (!a.mesh() && !b.mesh()) return {};
  if (!a.mesh()) return point_of_parts_within(a, pose_a, b, pose_b);
  if (!b.mesh()) return point_of_parts_within(b, pose_b, a, pose_a);
  if (!a.mesh()->is_closed() || !b.mesh()->is_closed()) return {};
  const auto of_a = point_of_mesh_within(a, pose_a, b, pose_b);
  return of_a ? of_a : point_of_mesh_within(b, pose_b, a, pose_a);
}

void set_overlapping(SignedDistance& found) {
  found.status = SignedStatus::overlapping;
  found.value = found.lower = found.upper = 0;
}

}  // namespace

std::optional<Vec3<double>> point_within(const PartsBody& a, const Affine<double>& pose_a,
                                         const PartsBody& b, const Affine<double>& pose_b) {
  const auto of_b = point_held_by(a, pose_a, b, pose_b);
  return of_b ? of_b : point_held_by(b, pose_b, a, pose_a);
}

SignedDistance signed_distance(const PartsBody& a, const Affine<double>& pose_a, const PartsBody& b,
                               const Affine<double>& pose_b, const SignedDistanceOptions& options,
                               PartPair* parts, PartPair first) {
  if (parts) *parts = {};
  if (a.shape() && b.shape())
    return signed_distance(*a.shape(), pose_a, *b.shape(), pose_b, options);
  // If one body is inside the other, the status is known: search only for parts that cross (limit
  // 0).
  std::optional<Vec3<double>> within = point_within(a, pose_a, b, pose_b);
  LeastDistance least(a, pose_a, b, pose_b, options);
  SignedDistance found = least.run(options.only_sign || within ? 0 : options.at_most, parts, first);
  const bool is_open = !least.is_crossed() && found.status != SignedStatus::separated;
  if (is_open && !within) within = common_point(a, pose_a, b, pose_b);
  if (least.is_crossed()) {
    set_overlapping(found);
  } else if (within) {
    set_overlapping(found);
    found.point_a = found.point_b = *within;
  }
  return found;
}

}  // namespace minkray
