// SPDX-License-Identifier: MIT
// The signed volumes distance subalgorithm: M. Montanari, N. Petrinic, E. Barbieri, "Improving the
// GJK Algorithm for Faster and More Reliable Distance Queries Between Convex Objects", 2017,
// section 4. Barycentric coordinates of the origin's projection are ratios of volumes, areas and
// lengths. These are measured on the coordinate plane or axis where the simplex' projection
// ("shadow") is largest. A coordinate of the wrong sign selects a face.
#pragma once

#include "core/gjk/simplex.h"

namespace minkray {
namespace detail {

/// True if both are positive or both negative.
template <class T>
bool same_sign(T a, T b) {
  return (a > T(0) && b > T(0)) || (a < T(0) && b < T(0));
}

template <class T, int Dim>
using Vertices = std::array<Vec<T, Dim>, Dim + 1>;

template <class T, int Dim>
ClosestPoint<T, Dim> signed_volumes_vertex(const Vertices<T, Dim>& y, std::size_t a) {
  ClosestPoint<T, Dim> answer;
  answer.v = y[a];
  answer.weights[a] = T(1);
  answer.kept = 1u << a;
  return answer;
}

/// S1D in the paper: uses the shadow of the segment on the coordinate axis where it is longest.
template <class T, int Dim>
ClosestPoint<T, Dim> signed_volumes_segment(const Vertices<T, Dim>& y, std::size_t a,
                                            std::size_t b) {
  const Vec<T, Dim> t = y[b] - y[a];
  const T squared = t.squaredNorm();
  if (!(squared > T(0))) return signed_volumes_vertex(y, a);
  const Vec<T, Dim> origin = y[a] - (y[a].dot(t) / squared) * t;
  Eigen::Index axis = 0;
  t.cwiseAbs().maxCoeff(&axis);
  const T length = y[a][axis] - y[b][axis];
  const T of_a = origin[axis] - y[b][axis], of_b = y[a][axis] - origin[axis];
  if (!same_sign(length, of_a)) return signed_volumes_vertex(y, b);
  if (!same_sign(length, of_b)) return signed_volumes_vertex(y, a);
  ClosestPoint<T, Dim> answer;
  answer.weights[a] = of_a / length;
  answer.weights[b] = of_b / length;
  answer.v = answer.weights[a] * y[a] + answer.weights[b] * y[b];
  answer.kept = (1u << a) | (1u << b);
  return answer;
}

template <class T, int Dim>
void keep_closer_answer(ClosestPoint<T, Dim>& best, const ClosestPoint<T, Dim>& candidate) {
  if (best.kept == 0 || candidate.v.squaredNorm() < best.v.squaredNorm()) best = candidate;
}

/// S2D in the paper: uses the shadow of the triangle on the coordinate plane where it is largest.
template <class T, int Dim>
ClosestPoint<T, Dim> signed_volumes_triangle(const Vertices<T, Dim>& y, std::size_t a,
                                             std::size_t b, std::size_t c) {
  Vec<T, Dim> origin = Vec<T, Dim>::Zero();
  Eigen::Index u = 0, w = 1;
  if constexpr (Dim == 3) {
    const Vec3<T> n = Vec3<T>(y[b] - y[a]).cross(Vec3<T>(y[c] - y[a]));
    const T squared = n.squaredNorm();
    if (squared > T(0)) origin = (y[a].dot(n) / squared) * n;
    Eigen::Index axis = 0;
    n.cwiseAbs().maxCoeff(&axis);
    u = (axis + 1) % 3;
    w = (axis + 2) % 3;
  }
  // Twice the signed area of a triangle's shadow.
  const auto area = [&](const Vec<T, Dim>& i, const Vec<T, Dim>& j, const Vec<T, Dim>& k) {
    return (j[u] - i[u]) * (k[w] - i[w]) - (j[w] - i[w]) * (k[u] - i[u]);
  };
  const T whole = area(y[a], y[b], y[c]);
  const T of_a = area(origin, y[b], y[c]), of_b = area(y[a], origin, y[c]),
          of_c = area(y[a], y[b], origin);
  const bool in_a = same_sign(whole, of_a), in_b = same_sign(whole, of_b),
             in_c = same_sign(whole, of_c);
  ClosestPoint<T, Dim> answer;
  if (in_a && in_b && in_c) {
    answer.weights[a] = of_a / whole;
    answer.weights[b] = of_b / whole;
    answer.weights[c] = of_c / whole;
    answer.v = answer.weights[a] * y[a] + answer.weights[b] * y[b] + answer.weights[c] * y[c];
    answer.kept = (1u << a) | (1u << b) | (1u << c);
    return answer;
  }
  if (!in_a) keep_closer_answer(answer, signed_volumes_segment<T, Dim>(y, b, c));
  if (!in_b) keep_closer_answer(answer, signed_volumes_segment<T, Dim>(y, a, c));
  if (!in_c) keep_closer_answer(answer, signed_volumes_segment<T, Dim>(y, a, b));
  return answer;
}

/// S3D in the paper: uses the cofactors of the tetrahedron's matrix.
template <class T>
ClosestPoint<T, 3> signed_volumes_tetrahedron(const Vertices<T, 3>& y) {
  const auto volume = [](const Vec3<T>& i, const Vec3<T>& j, const Vec3<T>& k) {
    return i.dot(j.cross(k));
  };
  const std::array<T, 4> of = {volume(y[1], y[2], y[3]), -volume(y[0], y[2], y[3]),
                               volume(y[0], y[1], y[3]), -volume(y[0], y[1], y[2])};
  const T whole = of[0] + of[1] + of[2] + of[3];
  std::array<bool, 4> in;
  for (std::size_t i = 0; i < 4; ++i) in[i] = same_sign(whole, of[i]);
  ClosestPoint<T, 3> answer;
  if (in[0] && in[1] && in[2] && in[3]) {
    for (std::size_t i = 0; i < 4; ++i) {
      answer.weights[i] = of[i] / whole;
      answer.v += answer.weights[i] * y[i];
    }
    answer.kept = 0b1111;
    return answer;
  }
  if (!in[0]) keep_closer_answer(answer, signed_volumes_triangle<T, 3>(y, 1, 2, 3));
  if (!in[1]) keep_closer_answer(answer, signed_volumes_triangle<T, 3>(y, 0, 2, 3));
  if (!in[2]) keep_closer_answer(answer, signed_volumes_triangle<T, 3>(y, 0, 1, 3));
  if (!in[3]) keep_closer_answer(answer, signed_volumes_triangle<T, 3>(y, 0, 1, 2));
  return answer;
}

}  // namespace detail

template <class T, int Dim>
class SignedVolumesSubalgorithm : public Simplex<T, Dim> {
  using Base = Simplex<T, Dim>;

 public:
  ClosestPoint<T, Dim> closest() const {
    std::array<std::size_t, Dim + 1> slot{};
    std::size_t size = 0;
    detail::Vertices<T, Dim> y;
    for (int i = 0; i < Base::slots; ++i) {
      if (!this->uses(i)) continue;
      y[static_cast<std::size_t>(i)] = this->y(i);
      slot[size++] = static_cast<std::size_t>(i);
    }
    if (size == 1) return detail::signed_volumes_vertex<T, Dim>(y, slot[0]);
    if (size == 2) return detail::signed_volumes_segment<T, Dim>(y, slot[0], slot[1]);
    if (size == 3) return detail::signed_volumes_triangle<T, Dim>(y, slot[0], slot[1], slot[2]);
    if constexpr (Dim == 3) return detail::signed_volumes_tetrahedron<T>(y);
    return {};
  }
};

}  // namespace minkray
