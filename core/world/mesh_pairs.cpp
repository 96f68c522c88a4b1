// SPDX-License-Identifier: MIT
#include "core/world/mesh_pairs.h"

#include <algorithm>
#include <queue>

#include "core/contact/core_support.h"
#include "core/derived/triangle_of.h"
#include "core/mesh/mesh_ray.h"
#include "core/world/world_impact.h"

namespace minkray {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double epsilon = std::numeric_limits<double>::epsilon();

Bounds<double> in_double(const Bounds<float>& box) {
  return {box.lower.cast<double>(), box.upper.cast<double>()};
}

/// From the middle, half a side each way.
Bounds<double> image(const Mat3<double>& turn, const Vec3<double>& shift,
                     const Bounds<double>& box) {
  const Vec3<double> middle = turn * box.centre() + shift;
  const Vec3<double> around = turn.cwiseAbs() * box.reach_of_centre();
  return {middle - around, middle + around};
}

double box_distance(const Bounds<double>& a, const Bounds<double>& b) {
  double squared = 0;
  for (int k = 0; k < 3; ++k) {
    const double apart = std::max({a.lower[k] - b.upper[k], b.lower[k] - a.upper[k], 0.0});
    squared += apart * apart;
  }
  return (1 - 8 * epsilon) * std::sqrt(squared);
}

double largest_side(const Bounds<double>& box) {
  return (box.upper - box.lower).maxCoeff();
}

/// How far the box reaches from the origin of its frame.
double box_reach(const Bounds<double>& box) {
  return box.lower.cwiseAbs().cwiseMax(box.upper.cwiseAbs()).norm();
}

/// Where B is as A sees it.
struct Sight {
  Mat3<double> turn;
  Vec3<double> shift;
  double rounding;  ///< of any point of either body, and of boxes

  Sight(const Affine<double>& a, const Affine<double>& b, double reach_a, double reach_b) {
    turn = a.linear.transpose() * b.linear;
    shift = a.linear.transpose() * exact_difference(b.translation, a.translation).rounded();
    rounding = 32 * epsilon * (shift.norm() + reach_a + reach_b);
  }
};

/// One of the two bodies: its boxes are in its own frame.
class Side {
 public:
  explicit Side(const PartsBody& body) : body_(body) {}

  struct Box {
    std::uint32_t what = 0;  ///< a node's number, that of a leaf with its bit, or that of a part
    Bounds<double> bounds;
    bool is_part() const { return what >= part_bits; }
    std::uint32_t part() const { return what & ~part_bits; }
  };
  /// Numbers of leaves and parts are less than 2^30.
  static constexpr std::uint32_t part_bits = BvhNode::leaf | BvhNode::leaf >> 1;

  Box whole() const {
    if (body_.mesh()) return {0, body_.mesh()->bounds()};
    return {part_bits, bounds_of(body_, {})};
  }
  double reach() const { return reach_of(body_); }
  template <class Each>
  void each_child(const Box& box, Each&& each) const {
    const TriangleMesh& mesh = *body_.mesh();
    const auto each_of = [&](const BvhNode& node, std::uint32_t bits) {
      for (int i = 0; i < bvh_width && node.children[i] != BvhNode::none; ++i)
        each(Box{node.children[i] | bits, in_double(node.box(i))});
    };
    if (box.what & BvhNode::leaf)
      each_of(mesh.boxes_of_leaf(box.what & ~BvhNode::leaf), part_bits);
    else
      each_of(mesh.bvh().nodes[box.what], 0);
  }
  /// The convex part; `room` holds it if it is a triangle.
  const ContactShape& part(std::uint32_t number, std::optional<ContactShape>& room) const {
    if (!body_.mesh()) return *body_.shape();
    const TriangleMesh& mesh = *body_.mesh();
    return room.emplace(
        triangle_of(mesh.corner(number, 0), mesh.corner(number, 1), mesh.corner(number, 2)));
  }
  std::uint32_t number_of(std::uint32_t part) const { return body_.mesh() ? part : no_part; }
  /// Any point of it, in its frame.
  Vec3<double> point() const {
    return body_.mesh() ? body_.mesh()->corner(0, 0) : body_.shape()->middle();
  }
  const PartsBody& body() const { return body_; }

 private:
  PartsBody body_;
};

/// Visits pairs of parts, those with the least key first. key(a, b, b_in_a) is a lower bound of
/// what visit(part_a, part_b) finds; pairs above limit() are left out,
/// and their least key is answered.
template <class Key, class Limit, class Visit>
double visit_pairs(const Side& a, const Side& b, const Sight& sight, const Key& key,
                   const Limit& limit, const Visit& visit) {
  struct Open {
    double key;
    Side::Box a, b;
    bool operator<(const Open& other) const {
      if (key != other.key) return key > other.key;
      return std::pair(a.what, b.what) > std::pair(other.a.what, other.b.what);
    }
  };
  std::priority_queue<Open> open;
  double left_out = infinity;
  const auto add = [&](const Side::Box& of_a, const Side::Box& of_b) {
    const double least = key(of_a.bounds, of_b.bounds, image(sight.turn, sight.shift, of_b.bounds));
    if (least <= limit())
      open.push({least, of_a, of_b});
    else
      left_out = std::min(left_out, least);
  };
  add(a.whole(), b.whole());
  while (!open.empty()) {
    const Open top = open.top();
    open.pop();
    if (top.key > limit()) return std::min(left_out, top.key);
    if (top.a.is_part() && top.b.is_part()) {
      if (visit(top.a.part(), top.b.part())) return 0;
      continue;
    }
    const bool is_a = top.b.is_part() || (!top.a.is_part() &&
                                          largest_side(top.a.bounds) >= largest_side(top.b.bounds));
    if (is_a)
      a.each_child(top.a, [&](const Side::Box& child) { add(child, top.b); });
    else
      b.each_child(top.b, [&](const Side::Box& child) { add(top.a, child); });
  }
  return left_out;
}

/// A point of one body that is within the other one.
std::optional<Vec3<double>> point_within(const Side& a, const Affine<double>& pose_a, const Side& b,
                                         const Affine<double>& pose_b) {
  const auto held_by = [](const Side& one, const Affine<double>& pose, const Side& other,
                          const Affine<double>& pose_other) -> std::optional<Vec3<double>> {
    if (!one.body().mesh()) return {};  // triangles within a shape overlap it
    const Vec3<double> point = pose_other(other.point());
    const Vec3<double> seen = pose.linear.transpose() * (point - pose.translation);
    return is_within(*one.body().mesh(), seen) ? std::optional(point) : std::nullopt;
  };
  const auto of_b = held_by(a, pose_a, b, pose_b);
  return of_b ? of_b : held_by(b, pose_b, a, pose_a);
}

/// False where no pair of parts has the answer: bodies within each other, or that miss.
bool has_parts(const PartPair& parts, const PartsBody& a, const PartsBody& b) {
  return (!a.mesh() || parts.a != no_part) && (!b.mesh() || parts.b != no_part);
}

void set_overlapping(SignedDistance& found) {
  found.status = SignedStatus::overlapping;
  found.value = found.lower = found.upper = 0;
}

}  // namespace

Bounds<double> bounds_of(const PartsBody& body, const Affine<double>& pose) {
  constexpr double rounding = 16 * epsilon;
  if (body.mesh()) {
    const Bounds<double>& own = body.mesh()->bounds();
    const Vec3<double> middle = pose(own.centre());
    const Vec3<double> reach = pose.linear.cwiseAbs() * own.reach_of_centre();
    const Vec3<double> around =
        reach + rounding * (middle.cwiseAbs() + Vec3<double>::Constant(body.mesh()->reach()));
    return {middle - around, middle + around};
  }
  const PlacedCore frame = placed(*body.shape(), pose);
  const ShapeCore& core = body.shape()->core();
  Bounds<double> bounds;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3<double> d = frame.turn.row(axis).transpose();
    const double allowed =
        rounding * (core.ball + core.radius + std::abs(frame.middle[axis])) + core.rounding;
    const auto reach = [&](const Vec3<double>& along) {
      return along.dot(support_of_core<CoreKind::other>(core, along).point) + core.radius + allowed;
    };
    bounds.lower[axis] = frame.middle[axis] - reach(-d);
    bounds.upper[axis] = frame.middle[axis] + reach(d);
  }
  return bounds;
}

double reach_of(const PartsBody& body) {
  if (body.mesh()) return body.mesh()->reach();
  return body.shape()->ball_radius() + body.shape()->offset() + body.shape()->core().rounding;
}

SignedDistance signed_distance(const PartsBody& body_a, const Affine<double>& pose_a,
                               const PartsBody& body_b, const Affine<double>& pose_b,
                               const SignedDistanceOptions& options, PartPair* parts) {
  if (parts) *parts = {};
  if (!body_a.mesh() && !body_b.mesh())
    return signed_distance(*body_a.shape(), pose_a, *body_b.shape(), pose_b, options);
  const Side a(body_a), b(body_b);
  const Sight sight(pose_a, pose_b, a.reach(), b.reach());
  SignedDistance best;
  double lower = infinity;  // of all pairs
  int supports = 0;
  bool is_crossed = false, is_exhausted = false;
  // What is within the other overlaps it, and only crossing parts are looked for.
  const std::optional<Vec3<double>> within = point_within(a, pose_a, b, pose_b);
  const double enough = options.only_sign || within ? 0 : options.at_most;
  const auto limit = [&] { return std::min(best.upper, enough); };
  const auto key = [&](const Bounds<double>& of_a, const Bounds<double>& of_b,
                       const Bounds<double>& b_in_a) {
    double least = box_distance(of_a, b_in_a);
    if (body_a.mesh() && body_b.mesh()) {
      const Bounds<double> a_in_b =
          image(sight.turn.transpose(), -(sight.turn.transpose() * sight.shift), of_a);
      least = std::max(least, box_distance(a_in_b, of_b));
    }
    return std::max(0.0, least - sight.rounding);
  };
  const auto visit = [&](std::uint32_t part_a, std::uint32_t part_b) {
    std::optional<ContactShape> room_a, room_b;
    SignedDistanceOptions how = options;
    how.at_most = limit();
    const SignedDistance found =
        signed_distance(a.part(part_a, room_a), pose_a, b.part(part_b, room_b), pose_b, how);
    supports += found.supports;
    is_exhausted |= found.is_exhausted;
    lower = std::min(lower, found.lower);
    if (found.upper < best.upper) {
      best = found;
      if (parts) *parts = {a.number_of(part_a), b.number_of(part_b)};
    }
    is_crossed = found.status == SignedStatus::overlapping;
    return is_crossed;
  };
  lower = std::min(lower, visit_pairs(a, b, sight, key, limit, visit));
  best.supports = supports;
  best.is_exhausted = is_exhausted;
  if (is_crossed) {
    set_overlapping(best);
    return best;
  }
  best.lower = std::min(lower, best.upper);
  if (!(best.upper < infinity)) best.value = best.lower;
  best.status = best.lower > 0                          ? SignedStatus::separated
                : best.status == SignedStatus::touching ? best.status
                                                        : SignedStatus::undecided;
  if (within) {
    set_overlapping(best);
    best.point_a = best.point_b = *within;
  }
  return best;
}

Impact first_impact(const PartsBody& body_a, const RigidMotion& motion_a, const PartsBody& body_b,
                    const RigidMotion& motion_b, double t_max, const ImpactOptions& options,
                    PartPair* parts) {
  if (parts) *parts = {};
  if (!body_a.mesh() && !body_b.mesh())
    return first_impact(*body_a.shape(), motion_a, *body_b.shape(), motion_b, t_max, options);
  const Side a(body_a), b(body_b);
  WorldImpact first = nothing_met(t_max);
  if (point_within(a, motion_a.pose, b, motion_b.pose)) {
    first.impact.status = ImpactStatus::inside;
    first.impact.t_lo = first.impact.t_hi = first.impact.distance = 0;
    return first.impact;
  }
  const Sight sight(motion_a.pose, motion_b.pose, a.reach(), b.reach());
  const double speed = (motion_b.velocity - motion_a.velocity).norm();
  const double turn_a = motion_a.angular_velocity.norm(), turn_b = motion_b.angular_velocity.norm();
  const auto limit = [&] { return std::min(t_max, first.impact.t_hi); };
  // No point is faster than this, and so none is there before.
  const auto key = [&](const Bounds<double>& of_a, const Bounds<double>& of_b,
                       const Bounds<double>& b_in_a) {
    const double apart = std::max(0.0, box_distance(of_a, b_in_a) - sight.rounding);
    if (apart == 0) return 0.0;
    const double fastest = speed + turn_a * box_reach(of_a) + turn_b * box_reach(of_b);
    return fastest > 0 ? (1 - 16 * epsilon) * apart / fastest : infinity;
  };
  std::size_t pair = 0;
  visit_pairs(a, b, sight, key, limit, [&](std::uint32_t part_a, std::uint32_t part_b) {
    std::optional<ContactShape> room_a, room_b;
    ImpactOptions how = options;
    how.points_of_misses = false;
    const std::size_t before = first.body;
    take(first, pair,
         first_impact(a.part(part_a, room_a), motion_a, b.part(part_b, room_b), motion_b, limit(),
                      how));
    if (first.body != before && parts) *parts = {a.number_of(part_a), b.number_of(part_b)};
    ++pair;
    return first.impact.status == ImpactStatus::inside && first.impact.t_hi == 0;
  });
  return first.impact;
}

ContactManifold contact_manifold(const PartsBody& a, const Affine<double>& pose_a,
                                 const PartsBody& b, const Affine<double>& pose_b) {
  PartPair parts;
  signed_distance(a, pose_a, b, pose_b, {}, &parts);
  if (!has_parts(parts, a, b)) return {};
  std::optional<ContactShape> room_a, room_b;
  const ContactShape &of_a = Side(a).part(parts.a, room_a), &of_b = Side(b).part(parts.b, room_b);
  return contact_manifold(of_a, pose_a, of_b, pose_b, signed_distance(of_a, pose_a, of_b, pose_b));
}

PairDerivative derivative_of(const PartsBody& a, const Affine<double>& pose_a, const PartsBody& b,
                             const Affine<double>& pose_b) {
  PartPair parts;
  const SignedDistance found = signed_distance(a, pose_a, b, pose_b, {}, &parts);
  if (found.status != SignedStatus::separated || !has_parts(parts, a, b)) {
    PairDerivative none = {};
    none.is_ridge = true;
    return none;
  }
  std::optional<ContactShape> room_a, room_b;
  return finest_derivative_of(Side(a).part(parts.a, room_a), pose_a, Side(b).part(parts.b, room_b),
                              pose_b);
}

PairDerivative derivative_of(const PartsBody& a, const RigidMotion& motion_a, const PartsBody& b,
                             const RigidMotion& motion_b, double t_max) {
  PartPair parts;
  const Impact found = first_impact(a, motion_a, b, motion_b, t_max, {}, &parts);
  if (!has_parts(parts, a, b)) {
    PairDerivative none = {};
    none.is_ridge = found.status != ImpactStatus::miss;
    return none;
  }
  std::optional<ContactShape> room_a, room_b;
  return derivative_of(Side(a).part(parts.a, room_a), motion_a, Side(b).part(parts.b, room_b),
                       motion_b, found);
}

SignedDistance distance_to_half_space(const PlacedPlane& plane, const PartsBody& body,
                                      const Affine<double>& pose) {
  if (body.shape())
    return distance_to_half_space(plane, *body.shape(), pose.linear,
                                  placed_middle(*body.shape(), pose));
  const TriangleMesh& mesh = *body.mesh();
  const Vec3<double> along = pose.linear.transpose() * plane.normal;
  const Vec3<double> from_plane = (TwoFoldVec3<double>(pose.translation) - plane.point).rounded();
  const double height = plane.normal.dot(from_plane);
  SignedDistance found;
  Vec3<double> lowest = Vec3<double>::Zero();
  double least = infinity;
  for (std::uint32_t i = 0; i < mesh.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      if (const double along_normal = along.dot(mesh.corner(i, k)); along_normal < least) {
        least = along_normal;
        lowest = mesh.corner(i, k);
      }
  const double rounding = 16 * epsilon * (from_plane.norm() + mesh.reach());
  found.value = height + least;
  found.lower = found.value - rounding;
  found.upper = found.value + rounding;
  found.status = found.lower > 0   ? SignedStatus::separated
                 : found.upper < 0 ? SignedStatus::overlapping
                                   : SignedStatus::touching;
  found.normal = plane.normal;
  found.point_b = pose(lowest);
  found.point_a = found.point_b - found.value * plane.normal;
  return found;
}

bool bends_at(const TriangleMesh& mesh, const Vec3<double>& point, double near) {
  constexpr double same_direction = 1e-9;
  const ContactShape at{Shape<double>(Point<double>{point})};
  SignedDistanceOptions how;
  how.at_most = near;
  std::optional<Vec3<double>> normal;
  const Side side(mesh);
  std::vector<Side::Box> open{side.whole()};
  while (!open.empty()) {
    const Side::Box box = open.back();
    open.pop_back();
    if (!box.is_part()) {
      side.each_child(box, [&](const Side::Box& child) {
        if (box_distance({point, point}, child.bounds) <= near) open.push_back(child);
      });
      continue;
    }
    const std::uint32_t part = box.part();
    std::optional<ContactShape> room;
    const ContactShape& triangle = side.part(part, room);
    if (signed_distance(at, {}, triangle, {}, how).lower > near) continue;
    const Vec3<double> its = mesh.normal(part);
    if (its.isZero(0)) continue;
    if (normal && (its - *normal).norm() > same_direction) return true;
    normal = its;
  }
  return false;
}

std::shared_ptr<const TriangleMesh> mapped(const TriangleMesh& mesh, const Mat3<double>& linear) {
  std::vector<Vec3<double>> vertices(mesh.vertices().begin(), mesh.vertices().end());
  for (Vec3<double>& vertex : vertices) vertex = linear * vertex;
  std::vector<Corners> triangles(mesh.triangles().begin(), mesh.triangles().end());
  if (linear.determinant() < 0)  // seen from outside they would be clockwise
    for (Corners& corners : triangles) std::swap(corners[1], corners[2]);
  return std::make_shared<const TriangleMesh>(std::move(vertices), std::move(triangles),
                                              mesh.sides());
}

}  // namespace minkray
