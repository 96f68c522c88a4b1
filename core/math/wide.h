// SPDX-License-Identifier: MIT
// A packet of numbers: the scalar type of packets of rays. Uses the compiler's vector types, so the
// same source compiles for every instruction set. `Isa` names the instruction set that the
// including file is compiled for. `Isa` is part of the type, so functions for different instruction
// sets have different names, and the linker cannot confuse them (docs/decisions/packets.md).
#pragma once

#if defined(__AVX2__)
#include <immintrin.h>
#elif defined(__SSE2__)
#include <emmintrin.h>
#endif

#include <array>
#include <cstdint>
#include <cstring>
#include <utility>

#include "core/math/vec.h"

namespace minkray {

struct IsaSse2 {
  static constexpr std::size_t register_bytes = 16;
};
/// The instruction set includes FMA.
struct IsaAvx2 {
  static constexpr std::size_t register_bytes = 32;
};
#if defined(__AVX2__)
using IsaHere = IsaAvx2;
#else
using IsaHere = IsaSse2;
#endif

/// A truth value for each lane.
template <class T, int N, class Isa>
struct WideMask {
  using Lanes __attribute__((vector_size(N * sizeof(T)))) = T;
  using Bits = decltype(Lanes() < Lanes());  ///< all bits of a lane, or none
  // std::uint64_t, as a type that depends on T: otherwise the compiler ignores vector_size.
  using Word = std::conditional_t<std::is_arithmetic_v<T>, std::uint64_t, T>;
  using Words __attribute__((vector_size(N * sizeof(T)))) = Word;
  Bits bits;

  WideMask() : bits{} {}
  explicit WideMask(Bits b) : bits(b) {}
  /// Sets all lanes to `all`.
  explicit WideMask(bool all) : bits(all ? Lanes() == Lanes() : Bits()) {}

  bool lane(int i) const { return bits[i] != 0; }
  WideMask& operator&=(const WideMask& o) { return bits &= o.bits, *this; }
  WideMask& operator|=(const WideMask& o) { return bits |= o.bits, *this; }
  friend WideMask operator&(const WideMask& a, const WideMask& b) {
    return WideMask(a.bits & b.bits);
  }
  friend WideMask operator|(const WideMask& a, const WideMask& b) {
    return WideMask(a.bits | b.bits);
  }
  friend WideMask operator^(const WideMask& a, const WideMask& b) {
    return WideMask(a.bits ^ b.bits);
  }
  friend WideMask operator!(const WideMask& a) { return WideMask(~a.bits); }

  friend bool any(const WideMask& mask) {
#if defined(__AVX2__)
    if constexpr (sizeof(Bits) == 32)
      return !_mm256_testz_si256(__m256i(mask.bits), __m256i(mask.bits));
#elif defined(__SSE2__)
    if constexpr (sizeof(Bits) == 16) return _mm_movemask_epi8(__m128i(mask.bits)) != 0;
#endif
    const Words words = Words(mask.bits);
    std::uint64_t joined = 0;
    for (unsigned i = 0; i < sizeof(Words) / sizeof(std::uint64_t); ++i) joined |= words[i];
    return joined != 0;
  }
  friend bool all(const WideMask& mask) {
    return !any(!mask);
  }
  /// A bit for each lane, the lowest for lane 0.
  friend std::uint32_t lane_bits(const WideMask& mask) {
#if defined(__AVX2__)
    if constexpr (sizeof(Bits) == 32 && sizeof(T) == 4)
      return static_cast<std::uint32_t>(_mm256_movemask_ps(__m256(mask.bits)));
    if constexpr (sizeof(Bits) == 32 && sizeof(T) == 8)
      return static_cast<std::uint32_t>(_mm256_movemask_pd(__m256d(mask.bits)));
#elif defined(__SSE2__)
    if constexpr (sizeof(Bits) == 16 && sizeof(T) == 4)
      return static_cast<std::uint32_t>(_mm_movemask_ps(__m128(mask.bits)));
    if constexpr (sizeof(Bits) == 16 && sizeof(T) == 8)
      return static_cast<std::uint32_t>(_mm_movemask_pd(__m128d(mask.bits)));
#endif
    std::uint32_t chosen = 0;
    for (int i = 0; i < N; ++i) chosen |= (mask.bits[i] != 0 ? 1u : 0u) << i;
    return chosen;
  }
};

template <class T, int N, class Isa>
struct Wide {
  using Mask = WideMask<T, N, Isa>;
  using Lanes = typename Mask::Lanes;
  Lanes lanes;

  Wide() : lanes{} {}
  explicit Wide(Lanes l) : lanes(l) {}
  /// Sets all lanes to x.
  explicit Wide(T x) : lanes(x - Lanes()) {}

  static Wide load(const T* from) {
    Wide w;
    std::memcpy(&w.lanes, from, sizeof(Lanes));
    return w;
  }
  void store(T* to) const { std::memcpy(to, &lanes, sizeof(Lanes)); }
  T lane(int i) const { return lanes[i]; }
  void set_lane(int i, T x) { lanes[i] = x; }

  Wide& operator+=(const Wide& o) { return lanes += o.lanes, *this; }
  Wide& operator-=(const Wide& o) { return lanes -= o.lanes, *this; }
  Wide& operator*=(const Wide& o) { return lanes *= o.lanes, *this; }
  Wide& operator/=(const Wide& o) { return lanes /= o.lanes, *this; }
  friend Wide operator-(const Wide& a) { return Wide(-a.lanes); }
  friend Wide operator+(const Wide& a, const Wide& b) { return Wide(a.lanes + b.lanes); }
  friend Wide operator-(const Wide& a, const Wide& b) { return Wide(a.lanes - b.lanes); }
  friend Wide operator*(const Wide& a, const Wide& b) { return Wide(a.lanes * b.lanes); }
  friend Wide operator/(const Wide& a, const Wide& b) { return Wide(a.lanes / b.lanes); }

  friend Mask operator<(const Wide& a, const Wide& b) { return Mask(a.lanes < b.lanes); }
  friend Mask operator>(const Wide& a, const Wide& b) { return Mask(a.lanes > b.lanes); }
  friend Mask operator<=(const Wide& a, const Wide& b) { return Mask(a.lanes <= b.lanes); }
  friend Mask operator>=(const Wide& a, const Wide& b) { return Mask(a.lanes >= b.lanes); }
  friend Mask operator==(const Wide& a, const Wide& b) { return Mask(a.lanes == b.lanes); }
  friend Mask operator!=(const Wide& a, const Wide& b) { return Mask(a.lanes != b.lanes); }

  friend Wide select(const Mask& condition, const Wide& a, const Wide& b) {
    return Wide(condition.bits ? a.lanes : b.lanes);
  }
  /// Same as std::min and std::max: return a if either number is NaN, or for zeros of different
  /// signs. Machine instructions return their second operand in these cases, so b is passed first.
  friend Wide min(const Wide& a, const Wide& b) {
#if defined(__AVX2__)
    if constexpr (sizeof(Lanes) == 32 && sizeof(T) == 4)
      return Wide(Lanes(_mm256_min_ps(__m256(b.lanes), __m256(a.lanes))));
    if constexpr (sizeof(Lanes) == 32 && sizeof(T) == 8)
      return Wide(Lanes(_mm256_min_pd(__m256d(b.lanes), __m256d(a.lanes))));
#elif defined(__SSE2__)
    if constexpr (sizeof(Lanes) == 16 && sizeof(T) == 4)
      return Wide(Lanes(_mm_min_ps(__m128(b.lanes), __m128(a.lanes))));
    if constexpr (sizeof(Lanes) == 16 && sizeof(T) == 8)
      return Wide(Lanes(_mm_min_pd(__m128d(b.lanes), __m128d(a.lanes))));
#endif
    return select(b < a, b, a);
  }
  friend Wide max(const Wide& a, const Wide& b) {
#if defined(__AVX2__)
    if constexpr (sizeof(Lanes) == 32 && sizeof(T) == 4)
      return Wide(Lanes(_mm256_max_ps(__m256(b.lanes), __m256(a.lanes))));
    if constexpr (sizeof(Lanes) == 32 && sizeof(T) == 8)
      return Wide(Lanes(_mm256_max_pd(__m256d(b.lanes), __m256d(a.lanes))));
#elif defined(__SSE2__)
    if constexpr (sizeof(Lanes) == 16 && sizeof(T) == 4)
      return Wide(Lanes(_mm_max_ps(__m128(b.lanes), __m128(a.lanes))));
    if constexpr (sizeof(Lanes) == 16 && sizeof(T) == 8)
      return Wide(Lanes(_mm_max_pd(__m128d(b.lanes), __m128d(a.lanes))));
#endif
    return select(a < b, b, a);
  }
  friend Wide abs(const Wide& a) {
    return Wide(Lanes(Bits(a.lanes) & ~Bits(sign_bit().lanes)));
  }
  friend Wide copysign(const Wide& size, const Wide& sign) {
    return Wide(Lanes(Bits(abs(size).lanes) | (Bits(sign.lanes) & Bits(sign_bit().lanes))));
  }
  friend Wide sqrt(const Wide& a) {
#if defined(__AVX2__)
    if constexpr (sizeof(Lanes) == 32 && sizeof(T) == 4)
      return Wide(Lanes(_mm256_sqrt_ps(__m256(a.lanes))));
    if constexpr (sizeof(Lanes) == 32 && sizeof(T) == 8)
      return Wide(Lanes(_mm256_sqrt_pd(__m256d(a.lanes))));
#elif defined(__SSE2__)
    if constexpr (sizeof(Lanes) == 16 && sizeof(T) == 4)
      return Wide(Lanes(_mm_sqrt_ps(__m128(a.lanes))));
    if constexpr (sizeof(Lanes) == 16 && sizeof(T) == 8)
      return Wide(Lanes(_mm_sqrt_pd(__m128d(a.lanes))));
#endif
    return per_lane(a, [](T x) { return std::sqrt(x); });
  }
  /// a * b + c, rounded once.
  friend Wide fma(const Wide& a, const Wide& b, const Wide& c) {
#if defined(__AVX2__) && defined(__FMA__)
    if constexpr (sizeof(Lanes) == 32 && sizeof(T) == 4)
      return Wide(Lanes(_mm256_fmadd_ps(__m256(a.lanes), __m256(b.lanes), __m256(c.lanes))));
    if constexpr (sizeof(Lanes) == 32 && sizeof(T) == 8)
      return Wide(Lanes(_mm256_fmadd_pd(__m256d(a.lanes), __m256d(b.lanes), __m256d(c.lanes))));
#endif
    Wide result;
    for (int i = 0; i < N; ++i) result.lanes[i] = std::fma(a.lanes[i], b.lanes[i], c.lanes[i]);
    return result;
  }
  friend Wide whole(const Wide& x) {
    using Int = std::conditional_t<sizeof(T) == 4, std::int32_t, std::int64_t>;
    using Ints __attribute__((vector_size(N * sizeof(T)))) = Int;
    return Wide(__builtin_convertvector(__builtin_convertvector(x.lanes, Ints), Lanes));
  }
  friend Wide leading_power_of_two(const Wide& a) {
    return Wide(Lanes(Bits(a.lanes) & Bits(Wide(std::numeric_limits<T>::infinity()).lanes)));
  }
  friend Wide exponent_of(const Wide& power_of_two) {
    const Bits biased = Bits(power_of_two.lanes) >> mantissa_bits;
    return Wide(Lanes(biased | Bits(Wide(ones).lanes))) - Wide(ones + bias);
  }
  friend Wide two_to(const Wide& k) {
    return Wide(Lanes(Bits((k + Wide(ones + bias)).lanes) << mantissa_bits));
  }

 private:
  using Bits = typename Mask::Bits;
  static constexpr int mantissa_bits = std::numeric_limits<T>::digits - 1;
  /// `ones`: all numbers from this one on are integers. `bias`: amount added to stored exponents.
  static constexpr T ones = T(1) / std::numeric_limits<T>::epsilon();
  static constexpr T bias = T(std::numeric_limits<T>::max_exponent - 1);
  static Wide sign_bit() {
    return Wide(T(-0.0));
  }
  template <class F>
  static Wide per_lane(const Wide& a, F&& f) {
    Wide result;
    for (int i = 0; i < N; ++i) result.lanes[i] = f(a.lanes[i]);
    return result;
  }
};

template <class T, int N, class Isa>
struct LaneOf<Wide<T, N, Isa>> {
  using type = T;
  using Mask = WideMask<T, N, Isa>;
  static constexpr int count = N;
};

/// Converts the numbers to another type, rounded to nearest.
template <class To, class T, int N, class Isa>
Wide<To, N, Isa> convert_lanes(const Wide<T, N, Isa>& from) {
  return Wide<To, N, Isa>(__builtin_convertvector(from.lanes, typename Wide<To, N, Isa>::Lanes));
}
template <class To, class T, int N, class Isa>
WideMask<To, N, Isa> convert_lanes(const WideMask<T, N, Isa>& from) {
  return WideMask<To, N, Isa>(
      __builtin_convertvector(from.bits, typename WideMask<To, N, Isa>::Bits));
}

/// Returns vector_of(lane) for each lane.
template <class W, class VectorOf>
Vec3<W> per_lane(VectorOf&& vector_of) {
  using T = Lane<W>;
  using Lanes = typename W::Lanes;
  return [&]<int... i>(std::integer_sequence<int, i...>)->Vec3<W> {
    const std::array<Vec3<T>, sizeof...(i)> v = {Vec3<T>(vector_of(i))...};
    // Sets all lanes at once. A register is slow to read from memory if its lanes were written one
    // by one.
    return {W(Lanes{v[i].x()...}), W(Lanes{v[i].y()...}), W(Lanes{v[i].z()...})};
  }
  (std::make_integer_sequence<int, LaneOf<W>::count>());
}

/// Returns number_of(index) for each lane; indices must be small integers.
template <class W, class NumberOf>
requires(LaneOf<W>::count > 1) W lookup(const W& index, NumberOf&& number_of) {
  return [&]<int... i>(std::integer_sequence<int, i...>) {
    return W(typename W::Lanes{number_of(static_cast<std::size_t>(index.lane(i)))...});
  }
  (std::make_integer_sequence<int, LaneOf<W>::count>());
}

}  // namespace minkray

/// Properties of the scalar for Eigen.
template <class T, int N, class Isa>
struct Eigen::NumTraits<minkray::Wide<T, N, Isa>> {
  using Real = minkray::Wide<T, N, Isa>;
  using NonInteger = Real;
  using Nested = Real;
  using Literal = Real;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 0,
    ReadCost = 1,
    AddCost = 1,
    MulCost = 1
  };
  static Real epsilon() { return Real(std::numeric_limits<T>::epsilon()); }
  static Real dummy_precision() { return epsilon(); }
  static Real highest() { return Real(std::numeric_limits<T>::max()); }
  static Real lowest() { return Real(std::numeric_limits<T>::lowest()); }
};
