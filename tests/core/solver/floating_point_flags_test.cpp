// SPDX-License-Identifier: MIT
// Which operations without a result (0/0, inf - inf) and divisions by zero a cast makes. Read from
// the processor's flags after each cast, which tell what traps would, and how often.
#include <gtest/gtest.h>

#include <cfenv>
#include <map>

#include "core/shape/convert.h"
#include "core/solver/cast.h"
#include "tests/support/aimed_rays.h"
#include "tests/support/sample_shapes.h"

namespace minkray::testing {
namespace {

struct Flags {
  int casts = 0, invalid = 0, divided = 0;
  std::string example;
};

template <class T>
std::map<SolverKind, Flags> flags_of_casts() {
  std::map<SolverKind, Flags> flags;
  for (const SampleShape& sample : sample_shapes()) {
    const PreparedShape<T> prepared(convert<T>(sample.shape));
    for (const SolverDescription& solver : solver_descriptions) {
      AimedRays rays(bounds_of<double>(sample.shape), 17);
      CastOptions<T> options;
      options.solver = solver.kind;
      Flags& of_solver = flags[solver.kind];
      for (int i = 0; i < 60; ++i) {
        const Ray<double> ray = rays.next(1.2);
        const Ray<T> in_T{ray.origin.cast<T>(), ray.direction.cast<T>()};
        std::feclearexcept(FE_ALL_EXCEPT);
        const CastResult<T> result = cast_ray(prepared, in_T, options);
        const int raised = std::fetestexcept(FE_INVALID | FE_DIVBYZERO);
        ++of_solver.casts;
        of_solver.invalid += raised & FE_INVALID ? 1 : 0;
        of_solver.divided += raised & FE_DIVBYZERO ? 1 : 0;
        if (raised & FE_INVALID && of_solver.example.find(sample.name) == std::string::npos)
          of_solver.example += sample.name + "; ";
        EXPECT_FALSE(result.normal.hasNaN()) << sample.name;
      }
    }
  }
  return flags;
}

template <class T>
class FloatingPointFlags : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(FloatingPointFlags, Scalars);

TYPED_TEST(FloatingPointFlags, no_cast_of_the_papers_solver_calculates_without_a_result) {
  for (const auto& [kind, flags] : flags_of_casts<TypeParam>()) {
    std::cout << solver_descriptions[static_cast<std::size_t>(kind)].name << ": " << flags.casts
              << " casts, invalid " << flags.invalid << ", divided by zero " << flags.divided << " "
              << flags.example << "\n";
    EXPECT_GT(flags.casts, 1000);
  }
}

}  // namespace
}  // namespace minkray::testing
