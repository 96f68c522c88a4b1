// SPDX-License-Identifier: MIT
// The offline proof: certifies many casts at every sample shape and reports what does not hold with
// a line that `minkray cast` reads.
//   prove [RAYS [NAME [SOLVER]]]
// RAYS (default 100,000) is the number for each shape and kind of ray; NAME selects the
// shapes whose names contain it; SOLVER is auto by default.
#include <algorithm>
#include <atomic>
#include <charconv>
#include <iomanip>
#include <iostream>
#include <mutex>
#include <sstream>
#include <string>
#include <string_view>

#include "core/parallel/parallel.h"
#include "renderer/json/json.h"
#include "renderer/json/number_json.h"
#include "renderer/member_json/shape_json.h"
#include "renderer/paper/solvers.h"
#include "tests/proof/certified_casts.h"
#include "tests/support/sample_shapes.h"

namespace {

using namespace minkray;
using namespace minkray::testing;

std::string query_of(const std::string& name, const Shape& shape, const Ray<double>& ray) {
  Json json;
  json["name"] = name;
  json["query"] = "ray";
  json["shape"] = write_shape(shape);
  json["ray"] = {{"origin", point_json(ray.origin)}, {"direction", point_json(ray.direction)}};
  return json.dump();
}

CertifiedCasts prove(const SampleShape& sample, const RayFamilyDescription& family, int rays,
                     const Solver* solver, std::ostream& out) {
  const CertifiedCasts casts = certified_casts(sample.shape, family.family, rays, 4, solver);
  out << std::left << std::setw(44) << sample.name.substr(0, 43) << std::setw(11) << family.name
      << std::right << std::setw(9) << casts.hits << std::setw(9) << casts.misses << std::setw(8)
      << casts.insides << std::setw(6) << casts.exhausted << std::setw(6) << casts.failed
      << std::fixed << std::setprecision(1) << std::setw(8) << casts.gap << std::setw(8)
      << casts.lateral << std::setw(8) << casts.claim_error << std::setw(8) << casts.t_error
      << std::setw(8) << casts.margin << std::setw(8) << casts.supports / std::max(casts.rays(), 1)
      << "\n";
  for (const FailedCertificate& failure : casts.first_failures) {
    const CertificateVerdict& v = failure.verdict;
    const double one = failure.claim.epsilon > 0 ? v.allowed / certificate_rounding : 1;
    out << "  # " << name_of(failure.claim.status) << ": " << v.complaint << " (gap " << v.gap / one
        << ", lateral " << v.lateral / one << ", claim " << v.claim_error / one << ", margin "
        << v.margin / one << ")\n  " << query_of(sample.name, sample.shape, failure.ray) << "\n";
  }
  return casts;
}

/// A proof of nothing would pass.
int wrong_usage(const char* what, std::string_view got) {
  std::cerr << "prove [RAYS [NAME [SOLVER]]]: " << what << " (got " << got << ")\n";
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  int rays = 100000;
  if (argc > 1) {
    const std::string_view number = argv[1];
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), rays);
    if (error != std::errc() || end != number.data() + number.size() || rays < 1)
      return wrong_usage("RAYS: must be a whole number > 0", number);
  }
  const std::string wanted = argc > 2 ? argv[2] : "";
  const std::string_view name = argc > 3 ? argv[3] : "auto";
  const auto solver_row = std::ranges::find(named_solvers, name, &NamedSolver::name);
  if (solver_row == named_solvers.end())
    return wrong_usage("SOLVER: must be one of minkray cast --help", name);
  const Solver* const solver = solver_row->kind;
  std::vector<SampleShape> samples;
  for (SampleShape& sample : sample_shapes())
    if (sample.name.find(wanted) != std::string::npos) samples.push_back(std::move(sample));
  if (samples.empty()) return wrong_usage("NAME: must be in the name of a sample shape", wanted);
  std::cout << "Extremes in machine epsilons times the size, of which " << certificate_rounding
            << " are allowed; supports a certificate.\n"
            << std::left << std::setw(44) << "shape" << std::setw(11) << "rays" << std::right
            << std::setw(9) << "hits" << std::setw(9) << "misses" << std::setw(8) << "inside"
            << std::setw(6) << "exh." << std::setw(6) << "fail" << std::setw(8) << "gap"
            << std::setw(8) << "lateral" << std::setw(8) << "claim" << std::setw(8) << "late"
            << std::setw(8) << "margin" << std::setw(8) << "supports"
            << "\n";
  std::mutex mutex;
  CertifiedCasts all;
  parallel_for(samples.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      std::ostringstream out;
      CertifiedCasts here;
      for (const RayFamilyDescription& family : ray_families) {
        here += prove(samples[i], family, rays, solver, out);
      }
      const std::lock_guard lock(mutex);
      std::cout << out.str() << std::flush;
      all += here;
    }
  });
  std::cout << "casts " << all.rays() << ", certified " << all.rays() - all.failed - all.exhausted
            << ", failed " << all.failed << ", exhausted " << all.exhausted << "\n";
  return all.failed + all.exhausted > 0 ? 1 : 0;
}
