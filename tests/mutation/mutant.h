// SPDX-License-Identifier: MIT
// Changes of the solvers that are chosen when a program starts: tests/mutation/mutate puts these in
// the place of operators, conditions and constants, all in one build. A process is one mutant, or
// with number 0 the program as it was written, to the last bit.
#pragma once

#include <algorithm>
#include <type_traits>

namespace minkray::mutant {

/// The number of this process' mutant, from the environment (MINKRAY_MUTANT). Known before anything
/// else is initialized.
extern int active;

/// Mutants that the process reached, on or off.
inline constexpr int most_mutants = 8192;
extern bool reached[most_mutants];

template <int k>
bool on() {
  static_assert(k < most_mutants);
  reached[k] = true;
  return active == k;
}

/// For constants: two mutants, or none where the number is 0.
template <int k, int k_smaller, class X>
X constant(const X& as_it_was, const X& larger, const X& smaller) {
  if constexpr (k > 0)
    if (on<k>()) return larger;
  if constexpr (k_smaller > 0)
    if (on<k_smaller>()) return smaller;
  return as_it_was;
}

// --- a + b -> a + plus<k> * b: minus b where the mutant is on; likewise a - b.

template <int k>
struct Plus {};
template <int k>
struct Minus {};

template <class X>
auto negated_if(bool condition, const X& x) {
  if constexpr (requires { typename X::PlainObject; }) {
    using Plain = typename X::PlainObject;
    return condition ? Plain(-x) : Plain(x);
  } else {
    return condition ? static_cast<X>(-x) : x;
  }
}
template <int k, class X>
auto operator*(Plus<k>, const X& x) {
  return negated_if(on<k>(), x);
}
/// -x as minus<k> * x.
template <int k, class X>
auto operator*(Minus<k>, const X& x) {
  return negated_if(!on<k>(), x);
}
template <int k>
inline constexpr Plus<k> plus;
template <int k>
inline constexpr Minus<k> minus;

// --- a < b -> a < less<k> > b, and so on: the opposite where the mutant is on.

enum class Comparison { less, greater, less_equal, greater_equal, equal, unequal };

template <int k, Comparison comparison>
struct Compare {};
template <class X, int k, Comparison comparison>
struct Compared {
  const X& a;
};

template <Comparison comparison, class X, class Y>
auto compare(const X& a, const Y& b, bool turned) {
  using enum Comparison;
  if constexpr (comparison == less) return turned ? a >= b : a < b;
  if constexpr (comparison == greater) return turned ? a <= b : a > b;
  if constexpr (comparison == less_equal) return turned ? a > b : a <= b;
  if constexpr (comparison == greater_equal) return turned ? a < b : a >= b;
  if constexpr (comparison == equal) return turned ? a != b : a == b;
  if constexpr (comparison == unequal) return turned ? a == b : a != b;
}
template <class X, int k, Comparison comparison>
Compared<X, k, comparison> operator<(const X& a, Compare<k, comparison>) {
  return {a};
}
template <class X, int k, Comparison comparison, class Y>
auto operator>(const Compared<X, k, comparison>& a, const Y& b) {
  return compare<comparison>(a.a, b, on<k>());
}
template <class X, int k, Comparison comparison>
Compared<X, k, comparison> operator==(const X& a, Compare<k, comparison>) {
  return {a};
}
template <class X, int k, Comparison comparison, class Y>
auto operator==(const Compared<X, k, comparison>& a, const Y& b) {
  return compare<comparison>(a.a, b, on<k>());
}
template <int k>
inline constexpr Compare<k, Comparison::less> less;
template <int k>
inline constexpr Compare<k, Comparison::greater> greater;
template <int k>
inline constexpr Compare<k, Comparison::less_equal> less_equal;
template <int k>
inline constexpr Compare<k, Comparison::greater_equal> greater_equal;
template <int k>
inline constexpr Compare<k, Comparison::equal> equal;
template <int k>
inline constexpr Compare<k, Comparison::unequal> unequal;

// --- Masks: a & b -> a & both<k> & b: either where the mutant is on; likewise a | b.

template <int k, bool both>
struct Join {};
template <class X, int k, bool both>
struct Joined {
  const X& a;
};
template <class X, class Y>
auto joined(const X& a, const Y& b, bool both) {
  if constexpr (std::is_same_v<X, bool>)
    return both ? a && bool(b) : a || bool(b);
  else
    return both ? a & b : a | b;
}
template <class X, int k>
Joined<X, k, true> operator&(const X& a, Join<k, true>) {
  return {a};
}
template <class X, int k, class Y>
auto operator&(const Joined<X, k, true>& a, const Y& b) {
  return joined(a.a, b, !on<k>());
}
template <class X, int k>
Joined<X, k, false> operator|(const X& a, Join<k, false>) {
  return {a};
}
template <class X, int k, class Y>
auto operator|(const Joined<X, k, false>& a, const Y& b) {
  return joined(a.a, b, on<k>());
}
template <int k>
inline constexpr Join<k, true> both;
template <int k>
inline constexpr Join<k, false> either;

// --- select(mask, a, b) -> select(always<k>(mask), a, b), or never<k>.

template <int k, class M>
M always(const M& mask) {
  return on<k>() ? M(true) : mask;
}
template <int k, class M>
M never(const M& mask) {
  return on<k>() ? M(false) : mask;
}

// --- max(a, b) -> unclamped_max<k>(a, b): a where the mutant is on; likewise min.

template <int k, class X, class Y>
auto unclamped_max(const X& a, const Y& b) {
  using std::max;
  return on<k>() ? X(a) : X(max(a, b));
}
template <int k, class X, class Y>
auto unclamped_min(const X& a, const Y& b) {
  using std::min;
  return on<k>() ? X(a) : X(min(a, b));
}

}  // namespace minkray::mutant
