// SPDX-License-Identifier: MIT
#include "renderer/verify/provable.h"

#include <algorithm>
#include <map>
#include <optional>

#include "core/mesh/leaves_below.h"
#include "core/mesh/mesh_ray.h"
#include "core/parts/one_part.h"
#include "core/parts/parts_distance.h"
#include "renderer/base/errors.h"

namespace minkray {
namespace {

/// A proof with more pairs is too long to be read.
constexpr std::size_t most_new_pairs = 20'000;

/// Parts that need more distances in a step are split.
constexpr std::size_t few_distances = 30;

/// Hulls of parts must be this share of the least clearance apart: all of it would take parts as
/// small as triangles.
constexpr double share = 0.5;

[[noreturn]] void no_proof(const ClearanceBody& a, const ClearanceBody& b, const char* why) {
  throw BadInput("proof: " + printable(a.name, 100) + " and " + printable(b.name, 100) + " " + why +
                 "; use --meshes hull, or verify without a proof");
}

/// The body with these triangles of its mesh only.
ClearanceBody part_of(const ClearanceBody& body, const std::vector<std::uint32_t>& triangles,
                      const std::string& name) {
  const TriangleMesh& mesh = *body.mesh;
  std::map<std::uint32_t, std::uint32_t> numbers;
  std::vector<Vec3<double>> vertices;
  std::vector<Corners> corners;
  for (const std::uint32_t triangle : triangles) {
    Corners own = mesh.triangles()[triangle];
    for (std::uint32_t& vertex : own) {
      const auto [at, is_new] =
          numbers.emplace(vertex, static_cast<std::uint32_t>(vertices.size()));
      if (is_new) vertices.push_back(mesh.vertices()[vertex]);
      vertex = at->second;
    }
    corners.push_back(own);
  }
  ClearanceBody part = body;
  part.name = name;
  part.mesh = std::make_shared<const TriangleMesh>(std::move(vertices), std::move(corners));
  const Vec3<double> way = part.own_middle() - body.own_middle();
  constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
  part.middle.at = body.middle.at + TwoFoldVec3<double>(body.linear * way);
  part.middle.loss += rounding * (mesh.reach() + way.norm());
  return part;
}

/// The triangles below each child of the mesh's root; those of a leaf one by one.
std::vector<std::vector<std::uint32_t>> groups_of(const TriangleMesh& mesh) {
  const auto triangles_below = [&](std::uint32_t what) {
    std::vector<std::uint32_t> found;
    each_leaf_below(mesh, what, [&](const MeshLeaf& leaf) {
      found.insert(found.end(), leaf.triangles, leaf.triangles + leaf.size());
    });
    return found;
  };
  std::vector<std::vector<std::uint32_t>> groups;
  for (const std::uint32_t child : mesh.bvh().nodes[0].children)
    if (child != BvhNode::none) groups.push_back(triangles_below(child));
  if (groups.size() > 1) return groups;
  const std::vector<std::uint32_t> single = std::move(groups[0]);
  groups.clear();
  for (const std::uint32_t triangle : single) groups.push_back({triangle});
  return groups;
}

class Splitter {
 public:
  Splitter(const MotionVerdict& verdict, const JointPath& path,
           const std::vector<ClearanceBody>& bodies, const std::vector<RefereePair>& pairs)
      : path_(path), made_{verdict, bodies, pairs} {}

  /// Replaces pairs without planes by pairs of parts.
  void split_hollow(const RefereeOptions& given) {
    RefereeOptions options = given;
    options.every_step = false;
    options.keep_planes = true;
    options.only_planes = true;
    options.budget = few_distances;
    options.enough = share * made_.verdict.least.lower;
    std::vector<RefereePair> open;
    for (const std::size_t pair : made_.verdict.without_planes) open.push_back(made_.pairs[pair]);
    if (open.empty()) return;
    keep_pairs_with_planes(made_.verdict.without_planes);
    made_.verdict.least.lower = std::min(made_.verdict.least.lower, options.enough);
    std::size_t tried = 0;
    while (!open.empty()) {
      std::vector<RefereePair> finer;
      for (const RefereePair& pair : open) split(pair, finer);
      tried += finer.size();
      if (tried > most_new_pairs)
        no_proof(made_.bodies[open[0].a], made_.bodies[open[0].b],
                 "are so near in each other's hollows that a proof needs too many parts");
      open = take_provable(finer, verdict_of(path_, made_.bodies, finer, options));
    }
    made_.verdict.without_planes.clear();
  }

  /// Replaces meshes of pairs that collide by the triangles that do.
  void name_triangles() {
    for (Stretch& stretch : made_.verdict.stretches) {
      if (!stretch.collides) continue;
      RefereePair pair = made_.pairs[stretch.pair];
      // A mesh is as deep in a half-space as its hull.
      if (made_.bodies[pair.a].plane || made_.bodies[pair.b].plane) continue;
      const ClearanceBody a = made_.bodies[pair.a], b = made_.bodies[pair.b];
      if (!a.mesh && !b.mesh) continue;
      if (const auto crossing = crossing_in(stretch, pair)) {
        stretch.time = crossing->time;
        if (a.mesh) pair.a = add_triangle(a, crossing->parts.a);
        if (b.mesh) pair.b = add_triangle(b, crossing->parts.b);
      } else {
        pair = enclosing(pair, stretch.time);
        made_.enclosures.push_back(made_.pairs.size());
      }
      stretch.pair = made_.pairs.size();
      made_.pairs.push_back(pair);
    }
  }

  Provable take() { return std::move(made_); }

 private:
  /// Renumbers pairs, and planes with them, leaving out some.
  void keep_pairs_with_planes(const std::vector<std::size_t>& left_out) {
    std::vector<RefereePair> kept;
    std::vector<std::size_t> numbers(made_.pairs.size());
    for (std::size_t i = 0; i < made_.pairs.size(); ++i) {
      numbers[i] = kept.size();
      if (!std::ranges::binary_search(left_out, i)) kept.push_back(made_.pairs[i]);
    }
    std::erase_if(made_.verdict.planes, [&](const SeparatingPlane& plane) {
      return std::ranges::binary_search(left_out, plane.pair);
    });
    for (SeparatingPlane& plane : made_.verdict.planes) plane.pair = numbers[plane.pair];
    made_.pairs = std::move(kept);
  }

  /// The parts of a body by their numbers, made once.
  const std::vector<std::size_t>& parts_of(std::size_t number) {
    const auto [at, is_new] = parts_.try_emplace(number);
    if (!is_new) return at->second;
    for (const auto& triangles : groups_of(*made_.bodies[number].mesh)) {
      const std::string name = made_.bodies[number].name + "." + std::to_string(at->second.size());
      at->second.push_back(made_.bodies.size());
      made_.bodies.push_back(part_of(made_.bodies[number], triangles, name));
    }
    return at->second;
  }

  /// Splits the larger of the two meshes.
  void split(const RefereePair& pair, std::vector<RefereePair>& finer) {
    const auto can_be = [&](std::size_t number) {
      const auto& mesh = made_.bodies[number].mesh;
      return mesh && mesh->size() > 1;
    };
    const auto size = [&](std::size_t number) {
      return can_be(number) ? made_.bodies[number].ball_radius() : -1;
    };
    if (!can_be(pair.a) && !can_be(pair.b))
      no_proof(made_.bodies[pair.a], made_.bodies[pair.b], "have no separating plane");
    if (size(pair.a) >= size(pair.b)) {
      for (const std::size_t part : parts_of(pair.a)) finer.push_back({part, pair.b, pair.margin});
    } else {
      for (const std::size_t part : parts_of(pair.b)) finer.push_back({pair.a, part, pair.margin});
    }
  }

  /// Adds the pairs that planes keep apart, with their planes. Returns the others.
  std::vector<RefereePair> take_provable(const std::vector<RefereePair>& finer,
                                         MotionVerdict&& verdict) {
    std::vector<bool> is_open(finer.size(), false);
    for (const std::size_t pair : verdict.without_planes) is_open[pair] = true;
    for (const Stretch& stretch : verdict.stretches) is_open[stretch.pair] = true;
    std::vector<std::size_t> numbers(finer.size());
    std::vector<RefereePair> open;
    for (std::size_t i = 0; i < finer.size(); ++i) {
      numbers[i] = made_.pairs.size();
      (is_open[i] ? open : made_.pairs).push_back(finer[i]);
    }
    for (SeparatingPlane& plane : verdict.planes) {
      if (is_open[plane.pair]) continue;
      plane.pair = numbers[plane.pair];
      made_.verdict.planes.push_back(plane);
    }
    return open;
  }

  struct Meeting {
    double time = 0;
    PartPair parts = {};
    bool crosses = false;   ///< two parts are closer than the margin
    bool encloses = false;  ///< one body is within the other, and they do not cross
  };

  Meeting meeting_at(const RefereePair& pair, double time) const {
    const ClearanceBody &a = made_.bodies[pair.a], &b = made_.bodies[pair.b];
    const Affine<double> pose_a = pose_at(a, time), pose_b = pose_at(b, time);
    Meeting meeting{time};
    const SignedDistance found =
        signed_distance(a.parts(), pose_a, b.parts(), pose_b, {}, &meeting.parts);
    const auto& [part_a, part_b] = meeting.parts;
    constexpr double touching = 1e-10;
    const double most = pair.margin + touching * (a.reach() + b.reach());
    meeting.crosses = (!a.mesh || part_a != no_part) && (!b.mesh || part_b != no_part) &&
                      signed_distance(OnePart(a.parts(), part_a).shape(), pose_a,
                                      OnePart(b.parts(), part_b).shape(), pose_b)
                              .upper <= most;
    meeting.encloses = !meeting.crosses && found.status == SignedStatus::overlapping;
    return meeting;
  }

  /// Searches the stretch for a moment at which the bodies cross. One that is apart at an end of
  /// the stretch and within the other later has crossed it in between.
  std::optional<Meeting> crossing_in(const Stretch& stretch, const RefereePair& pair) const {
    if (const Meeting found = meeting_at(pair, stretch.time); found.crosses) return found;
    constexpr int most_halvings = 50;
    for (const double end : {stretch.begin, stretch.end}) {
      const Meeting outer = meeting_at(pair, end);
      if (outer.crosses) return outer;
      if (outer.encloses) continue;
      double apart = end, within = stretch.time;
      for (int i = 0; i < most_halvings; ++i) {
        const Meeting middle = meeting_at(pair, apart + (within - apart) / 2);
        if (middle.crosses) return middle;
        (middle.encloses ? within : apart) = middle.time;
      }
    }
    return std::nullopt;
  }

  /// The pair with the body first that encloses a part of the other.
  RefereePair enclosing(const RefereePair& pair, double time) {
    for (const auto& [outer, inner] : {std::pair(pair.a, pair.b), {pair.b, pair.a}}) {
      const ClearanceBody one = made_.bodies[outer], other = made_.bodies[inner];
      if (!one.mesh) continue;
      const Affine<double> pose = pose_at(one, time);
      const Vec3<double> point = pose_at(
          other, time)(other.mesh ? other.mesh->corner(0, 0) : Vec3<double>(other.own_middle()));
      if (!is_within(*one.mesh, pose.linear.transpose() * (point - pose.translation))) continue;
      return {outer, other.mesh ? add_triangle(other, 0) : inner, pair.margin};
    }
    no_proof(made_.bodies[pair.a], made_.bodies[pair.b],
             "collide without crossing or enclosing each other where the collision was found");
  }

  /// Pose of the body's frame in the world.
  Affine<double> pose_at(const ClearanceBody& body, double time) const {
    Affine<double> link;
    if (body.link_index >= 0)
      link = link_poses(path_.posed_at(time))[static_cast<std::size_t>(body.link_index)];
    const Affine<double> own = body.pose();
    return {link.linear * own.linear, link(own.translation)};
  }

  std::size_t add_triangle(const ClearanceBody& body, std::uint32_t triangle) {
    made_.bodies.push_back(part_of(body, {triangle}, body.name + "." + std::to_string(triangle)));
    return made_.bodies.size() - 1;
  }

  const JointPath& path_;
  Provable made_;
  std::map<std::size_t, std::vector<std::size_t>> parts_;
};

}  // namespace

Provable provable(const MotionVerdict& verdict, const JointPath& path,
                  const std::vector<ClearanceBody>& bodies, const std::vector<RefereePair>& pairs,
                  const RefereeOptions& options) {
  Splitter splitter(verdict, path, bodies, pairs);
  if (verdict.status == MotionStatus::free) splitter.split_hollow(options);
  if (verdict.status == MotionStatus::collides) splitter.name_triangles();
  return splitter.take();
}

}  // namespace minkray
