// SPDX-License-Identifier: MIT
#include <cstring>
#include <sstream>

#include "core/solver/cast.h"
#include "core/solver/packet_cast.h"
#include "renderer/scene/shape_json.h"
#include "tests/fuzz/cast_promises.h"
#include "tests/fuzz/shape_from_bytes.h"
#include "tests/fuzz/target.h"
#include "tests/support/solvers.h"

namespace minkray::fuzz {
namespace {

template <class A>
bool same_bits(const A& a, const A& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

/// What the packet says of a lane, beside what cast_ray says: nothing if it is the same, bit for
/// bit.
template <class T>
std::string compare(const CastResult<T>& one, const CastResult<T>& lane) {
  if (one.status != lane.status)
    return "status " + std::string(name_of(lane.status)) + " instead of " +
           std::string(name_of(one.status));
  if (one.status == Status::exhausted) return "";
  const bool same_t =
      one.status == Status::miss ||
      (same_bits(one.t_base, lane.t_base) && same_bits(one.t_offset, lane.t_offset) &&
       same_bits(one.offset_lo, lane.offset_lo) && same_bits(one.offset_hi, lane.offset_hi));
  bool same_normal = true;
  for (int i = 0; i < 3; ++i) same_normal &= same_bits(one.normal[i], lane.normal[i]);
  if (!same_t) return "another t";
  std::ostringstream normals;
  normals.precision(std::numeric_limits<T>::max_digits10);
  normals << "another normal (" << name_of(one.status) << "): " << lane.normal.transpose()
          << " instead of " << one.normal.transpose();
  if (!same_normal) return normals.str();
  return one.supports == lane.supports ? "" : "other counts";
}

/// The line to give to `minkray cast`.
template <class T>
std::string as_query(const Shape<T>& shape, const Ray<T>& ray) {
  const auto list = [](const Vec3<T>& v) {
    return Json::array({double(v.x()), double(v.y()), double(v.z())});
  };
  Json json = {{"query", "ray"},
               {"shape", write_shape(convert<double>(shape))},
               {"ray", {{"origin", list(ray.origin)}, {"direction", list(ray.direction)}}}};
  if (std::isfinite(ray.t_max)) json["ray"]["t_max"] = double(ray.t_max);
  return json.dump();
}

template <class T>
std::string check_packets(const PreparedShape<T>& prepared, const RayPacket<T>& rays,
                          LaneBits lanes) {
  for (const InstructionSet set : {InstructionSet::sse2, InstructionSet::avx2}) {
    if (set > best_instruction_set()) continue;
    CastPacket<T> answers{};
    cast_packet(prepared, rays, lanes, answers, set);
    for (int lane = 0; lane < packet_lanes<T>; ++lane) {
      if (!(lanes & (LaneBits(1) << lane))) continue;
      const std::string bad = compare(cast_ray(prepared, rays.ray(lane)), answers.result(lane));
      if (!bad.empty())
        return "lane " + std::to_string(lane) +
               (set == InstructionSet::sse2 ? ", SSE2" : ", AVX2") + ": " + bad;
    }
  }
  return "";
}

template <class T>
std::string check_ray(const Shape<T>& shape, const PreparedShape<T>& prepared, const Ray<T>& ray) {
  CastReferee<T> referee(shape, ray);
  const auto complaint = [&](std::string_view who, const std::string& bad) {
    return std::string(sizeof(T) == 4 ? "float" : "double") + ", solver " + std::string(who) +
           ": " + bad + "\n" + as_query(shape, ray);
  };
  for (const SolverDescription& solver : testing::accurate_solvers()) {
    CastOptions<T> options;
    options.solver = solver.kind;
    const CastResult<T> result = cast_ray(prepared, ray, options);
    if (const std::string bad = referee.check(solver.name, result); !bad.empty())
      return complaint(solver.name, bad);
    if (const std::string bad =
            referee.check_exit(solver.name, result, cast_exit(prepared, ray, options));
        !bad.empty())
      return complaint(solver.name, "exit: " + bad);
  }
  if (const std::string bad = referee.check_claimed(); !bad.empty()) return complaint("any", bad);
  return "";
}

/// A map and a shape, as one shape and as a pose around it: the same answers are promised.
template <class T>
std::string check(Bytes bytes, bool wild) {
  const Affine<T> pose = map_from<T>(bytes, wild);
  const bool posed = bytes.below(2) == 1;
  const Shape<T> inner = shape_from<T>(bytes, wild);
  const Shape<T> shape = posed ? Shape<T>(Transform<T>{inner, AffineMap<T>(pose)}) : inner;
  // Sums of the largest may leave the range of numbers: shapes there are none.
  const Bounds<T> bounds = bounds_of<T>(shape);
  if (!bounds.lower.allFinite() || !bounds.upper.allFinite()) return "";
  const PreparedShape<T> prepared = posed ? PreparedShape<T>(inner, pose) : PreparedShape<T>(shape);
  RayPacket<T> rays{};
  const int count = 1 + bytes.below(packet_lanes<T>);
  LaneBits lanes = 0;
  for (int lane = 0; lane < count; ++lane) {
    const Ray<T> ray = ray_from(bytes, shape, wild);
    if (!ray.origin.allFinite() || !ray.direction.allFinite()) continue;
    rays.set(lane, ray);
    lanes |= LaneBits(1) << lane;
    if (const std::string bad = check_ray(shape, prepared, ray); !bad.empty()) return bad;
  }
  const std::string bad = check_packets(prepared, rays, lanes);
  if (bad.empty()) return "";
  std::string text = bad + (sizeof(T) == 4 ? " (float)" : " (double)");
  for (int lane = 0; lane < count; ++lane) text += "\n" + as_query(shape, rays.ray(lane));
  return text;
}

}  // namespace

std::string check_cast(std::string_view input) {
  Bytes bytes(input);
  const unsigned kind = bytes.byte();
  const bool wild = (kind & 2) != 0;
  return kind & 1 ? check<float>(bytes, wild) : check<double>(bytes, wild);
}

}  // namespace minkray::fuzz
