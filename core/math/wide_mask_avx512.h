// SPDX-License-Identifier: MIT
// Yes or no for each lane of a vector of 32 bytes, as AVX-512 has it: a bit in a register for
// masks. Only for files that are compiled for AVX-512 (VL and DQ); see core/math/wide.h.
#pragma once

#include <immintrin.h>

#include <cstdint>

namespace minkray {

template <class T, int N, class Isa>
struct WideMask;
struct IsaAvx512;

template <class T, int N>
struct WideMask<T, N, IsaAvx512> {
  static_assert(N * sizeof(T) == 32);
  using Lanes __attribute__((vector_size(N * sizeof(T)))) = T;
  static constexpr unsigned every = (1u << N) - 1;
  __mmask8 bits;  ///< the lowest for lane 0

  WideMask() : bits(0) {}
  explicit WideMask(unsigned b) : bits(static_cast<__mmask8>(b)) {}
  /// The same for all lanes.
  explicit WideMask(bool all) : bits(static_cast<__mmask8>(all ? every : 0)) {}

  static WideMask less(const Lanes& a, const Lanes& b) { return compare<_CMP_LT_OS>(a, b); }
  static WideMask at_most(const Lanes& a, const Lanes& b) { return compare<_CMP_LE_OS>(a, b); }
  static WideMask equal(const Lanes& a, const Lanes& b) { return compare<_CMP_EQ_OQ>(a, b); }
  static WideMask different(const Lanes& a, const Lanes& b) { return compare<_CMP_NEQ_UQ>(a, b); }
  Lanes choose(const Lanes& a, const Lanes& b) const {
    if constexpr (sizeof(T) == 4)
      return Lanes(_mm256_mask_blend_ps(bits, __m256(b), __m256(a)));
    else
      return Lanes(_mm256_mask_blend_pd(bits, __m256d(b), __m256d(a)));
  }

  bool lane(int i) const { return (bits >> i) & 1u; }
  WideMask& operator&=(const WideMask& o) { return *this = *this & o; }
  WideMask& operator|=(const WideMask& o) { return *this = *this | o; }
  friend WideMask operator&(const WideMask& a, const WideMask& b) {
    return WideMask(unsigned(a.bits) & b.bits);
  }
  friend WideMask operator|(const WideMask& a, const WideMask& b) {
    return WideMask(unsigned(a.bits) | b.bits);
  }
  friend WideMask operator^(const WideMask& a, const WideMask& b) {
    return WideMask(unsigned(a.bits) ^ b.bits);
  }
  friend WideMask operator!(const WideMask& a) { return WideMask(unsigned(a.bits) ^ every); }

  friend bool any(const WideMask& mask) { return mask.bits != 0; }
  friend bool all(const WideMask& mask) { return mask.bits == every; }
  friend std::uint32_t lane_bits(const WideMask& mask) { return mask.bits; }

 private:
  template <int relation>
  static WideMask compare(const Lanes& a, const Lanes& b) {
    if constexpr (sizeof(T) == 4)
      return WideMask(unsigned(_mm256_cmp_ps_mask(__m256(a), __m256(b), relation)));
    else
      return WideMask(unsigned(_mm256_cmp_pd_mask(__m256d(a), __m256d(b), relation)));
  }
};

}  // namespace minkray
