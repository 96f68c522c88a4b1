// SPDX-License-Identifier: MIT
// Minkray itself, in double: shapes are prepared once, as its users would.
#include "bench/league/adapter.h"
#include "core/cast/cast.h"
#include "core/pair_distance/signed_distance.h"
#include "renderer/paper/distance.h"
#include "renderer/paper/shape_cast.h"
#include "renderer/query/query_json.h"

namespace {

using minkray::DistanceQuery;
using minkray::PreparedPair;
using minkray::PreparedShape;
using minkray::Ray;
using minkray::RayQuery;
using minkray::ShapeQuery;
using minkray::SignedDistanceQuery;
using minkray::Status;
using minkray::Vec3;

league::Answer as_answer(const minkray::CastResult<double>& result) {
  if (result.status == Status::exhausted) return league::failed("exhausted");
  if (!result.found()) return league::miss();
  return league::hit(double(result.t_base) + double(result.t_offset));
}

league::Ask prepare(const RayQuery& query) {
  const auto shape = std::make_shared<PreparedShape>(query.shape);
  const Ray<double> ray = query.ray;
  return [=] { return as_answer(minkray::cast_ray(*shape, ray)); };
}

league::Ask prepare(const ShapeQuery& query) {
  const auto pair = std::make_shared<PreparedPair>(minkray::centred(query.obstacle),
                                                   minkray::centred(query.moving));
  const Vec3<double> of_moving = query.direction, of_obstacle = query.obstacle_direction;
  return [=, t_max = query.t_max] {
    return as_answer(minkray::cast_shapes(*pair, of_obstacle, of_moving, t_max, {}).cast);
  };
}

league::Ask prepare(const DistanceQuery& query) {
  const auto a = minkray::centred(query.a), b = minkray::centred(query.b);
  return [=] {
    const auto result = minkray::distance_between(a, b);
    if (std::string(minkray::name_of(result.status)) == "exhausted")
      return league::failed("exhausted");
    return league::at_distance(double(result.distance));
  };
}

league::Ask prepare(const SignedDistanceQuery& query) {
  const auto a = std::make_shared<minkray::ContactShape>(query.a),
             b = std::make_shared<minkray::ContactShape>(query.b);
  return [=] {
    const auto result = minkray::signed_distance(*a, *b, {});
    if (result.status == minkray::SignedStatus::undecided) return league::failed("undecided");
    return league::at_distance(result.value);
  };
}

league::Ask prepare(const minkray::ManifoldQuery&) {
  return [] { return league::unsupported("the league has no points of contact"); };
}

league::Ask prepare(const minkray::ImpactQuery&) {
  return [] { return league::unsupported("the league has no impacts"); };
}

league::Ask prepare_line(const std::string& line) {
  minkray::MeshFiles meshes{std::filesystem::path()};
  minkray::Mistakes mistakes("league");
  const auto query = minkray::parse_query(line, meshes, mistakes);
  if (!query) return [why = mistakes.text()] { return league::failed(why); };
  return std::visit([](const auto& kind) { return prepare(kind); }, query->kind);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string settings =
      "; solver auto; signed distances in double, to 1e-10 of the shapes' sizes";
  return league::serve(argc, argv,
                       {{"minkray", MINKRAY_VERSION, "double" + settings, {}, prepare_line}});
}
