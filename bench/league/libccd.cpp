// SPDX-License-Identifier: MIT
// libccd: overlap and depth, by its GJK and EPA or by its MPR. Has no shapes: the support
// functions are the user's.
#include <ccd/ccd.h>
#include <ccd/vec3.h>

#include "bench/league/adapter.h"

namespace {

using namespace league;

void support(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* point) {
  const Vec p = static_cast<const Solid*>(object)->support(
      {direction->v[0], direction->v[1], direction->v[2]});
  ccdVec3Set(point, p[0], p[1], p[2]);
}

void centre(const void* object, ccd_vec3_t* point) {
  const auto* solid = static_cast<const Solid*>(object);
  Vec middle = solid->at;
  if (solid->kind == Kind::hull) {
    Vec sum = {};
    for (const Vec& p : solid->points)
      for (std::size_t k = 0; k < 3; ++k)
        sum[k] += p[k] / static_cast<double>(solid->points.size());
    middle = solid->placed(sum);
  }
  ccdVec3Set(point, middle[0], middle[1], middle[2]);
}

Ask prepare(const Query& query, bool by_mpr) {
  if (query.asked != Asked::signed_distance)
    return [] { return unsupported("libccd has overlaps and depths alone"); };
  return [a = query.a, b = query.b, by_mpr] {
    ccd_t ccd;
    CCD_INIT(&ccd);
    ccd.support1 = ccd.support2 = support;
    ccd.center1 = ccd.center2 = centre;
    ccd.max_iterations = 1000;
    ccd.epa_tolerance = ccd.mpr_tolerance = 1e-9;
    ccd_real_t depth = 0;
    ccd_vec3_t direction, position;
    const int result = by_mpr ? ccdMPRPenetration(&a, &b, &ccd, &depth, &direction, &position)
                              : ccdGJKPenetration(&a, &b, &ccd, &depth, &direction, &position);
    if (result == 0) return at_distance(-depth);
    if (result == -1) return Answer{Answer::Status::separated};
    return failed("returned " + std::to_string(result));
  };
}

}  // namespace

int main(int argc, char** argv) {
  const std::string all = "double; max_iterations 1000; support functions of ours; ";
  return serve(argc, argv,
               {{"libccd-gjk", CCD_LEAGUE_VERSION, all + "ccdGJKPenetration, epa_tolerance 1e-9",
                 [](const Query& q) { return prepare(q, false); }},
                {"libccd-mpr", CCD_LEAGUE_VERSION, all + "ccdMPRPenetration, mpr_tolerance 1e-9",
                 [](const Query& q) { return prepare(q, true); }}});
}
