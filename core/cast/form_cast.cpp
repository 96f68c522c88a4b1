// SPDX-License-Identifier: MIT
#include "core/cast/form_cast.h"

#include "core/cast/filter.h"
#include "core/math/instruction_set.h"

namespace minkray {
namespace {

/// Tag for machines with an fma instruction: the filter then inlines ray_near instead of calling
/// it.
struct PlaceWithFma : FormPlace {
  static constexpr bool has_fma = true;
};

template <class Place>
[[gnu::always_inline]] inline bool cast_here(const Place& place, const Ray<double>& ray,
                                             CastResult<double>& result) {
  const Filtered<double> answer = filter<false>(place, ray, true);
  write_result(answer, result);
  return answer.is_certain();
}

#if defined(__x86_64__)
[[gnu::target("avx2,fma"), gnu::flatten]] bool cast_with_fma(const FormPlace& place,
                                                             const Ray<double>& ray,
                                                             CastResult<double>& result) {
  return cast_here(PlaceWithFma{place}, ray, result);
}
#endif

}  // namespace

bool cast_by_form(const FormPlace& place, const Ray<double>& ray, CastResult<double>& result) {
  if (place.definition().form().kind == FormKind::none) return false;
#if defined(__x86_64__)
  if (has_avx2()) return cast_with_fma(place, ray, result);
#endif
  return cast_here(place, ray, result);
}

}  // namespace minkray
