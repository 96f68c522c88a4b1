// SPDX-License-Identifier: MIT
// The point of a simplex closest to the origin, and the vertices that it lies between. The result
// is that of Johnson's distance subalgorithm, but computed by projections. Unlike determinants,
// projections stay accurate for the small sliver-like simplices near the end of a cast.
#pragma once

#include <array>
#include <utility>

#include "core/math/vec.h"
#include "core/query/tolerances.h"

namespace minkray {

template <class T, int Dim>
struct ClosestPoint {
  Vec<T, Dim> v = Vec<T, Dim>::Zero();  ///< the simplex' point closest to the origin
  std::array<T, Dim + 1> weights = {};  ///< barycentric: v = sum of weights[i] * y[i]
  unsigned kept = 0;                    ///< bit i is set if v needs vertex i
  bool proper = true;                   ///< false: found by a backup procedure, due to rounding
};

/// Up to four vertices.
template <class T>
using SimplexPoints = std::array<Vec3<T>, 4>;

namespace detail {

template <class T>
void keep_closer(ClosestPoint<T, 3>& best, T& best_squared, const ClosestPoint<T, 3>& candidate) {
  const T squared = candidate.v.squaredNorm();
  if (!(squared < best_squared)) return;
  best = candidate;
  best_squared = squared;
}

template <class T>
ClosestPoint<T, 3> closest_on_vertex(const SimplexPoints<T>& y, unsigned i) {
  ClosestPoint<T, 3> result;
  result.v = y[i];
  result.weights[i] = T(1);
  result.kept = 1u << i;
  return result;
}

template <class T>
ClosestPoint<T, 3> closest_on_edge(const SimplexPoints<T>& y, unsigned i, unsigned j) {
  const Vec3<T>&a = y[i], &b = y[j];
  const Vec3<T> edge = b - a;
  const T squared = edge.squaredNorm();
  const T towards_b = -a.dot(edge), towards_a = b.dot(edge);
  if (!(towards_b > T(0)) || !(squared > T(0))) return closest_on_vertex(y, i);
  if (!(towards_a > T(0))) return closest_on_vertex(y, j);
  ClosestPoint<T, 3> result;
  result.weights[j] = towards_b / squared;
  result.weights[i] = towards_a / squared;
  // Starts from the nearer end, so that the rounded product is small.
  result.v = towards_b < towards_a ? Vec3<T>(a + result.weights[j] * edge)
                                   : Vec3<T>(b - result.weights[i] * edge);
  // Makes v orthogonal to the edge again. Otherwise the direction of a short v would consist mostly
  // of rounding, and its support point would be a vertex that the simplex already has.
  result.v -= (result.v.dot(edge) / squared) * edge;
  result.kept = (1u << i) | (1u << j);
  return result;
}

/// A normal of face abc, from its two shorter edges: differences of close vertices are exact, so
/// the cross product loses no digits to cancellation.
template <class T>
Vec3<T> face_normal(const Vec3<T>& a, const Vec3<T>& b, const Vec3<T>& c) {
  const Vec3<T> ab = b - a, bc = c - b, ca = a - c;
  const T ab2 = ab.squaredNorm(), bc2 = bc.squaredNorm(), ca2 = ca.squaredNorm();
  if (ab2 >= bc2 && ab2 >= ca2) return bc.cross(ca);
  return bc2 >= ca2 ? ca.cross(ab) : ab.cross(bc);
}

/// Returns the one of a, b and c that is nearest to a point.
template <class T>
const Vec3<T>& nearest_of(const Vec3<T>& a, const Vec3<T>& b, const Vec3<T>& c,
                          const Vec3<T>& point) {
  const T to_a = (a - point).squaredNorm(), to_b = (b - point).squaredNorm(),
          to_c = (c - point).squaredNorm();
  return to_a <= to_b && to_a <= to_c ? a : (to_b <= to_c ? b : c);
}

/// Computes the weights by Gram-Schmidt, beginning with the longest edge. Triangles at the end of a
/// cast at a cone or a cylinder are slivers: this order keeps digits that determinants lose.
template <class T>
ClosestPoint<T, 3> closest_on_face(const SimplexPoints<T>& y, unsigned i, unsigned j, unsigned k) {
  // P and Q are the ends of the longest edge; P is also an end of the shortest edge. S is the third
  // vertex.
  const auto length = [&](unsigned a, unsigned b) { return (y[b] - y[a]).squaredNorm(); };
  unsigned P = i, Q = j, S = k;
  if (length(j, k) > length(P, Q)) P = j, Q = k, S = i;
  if (length(k, i) > length(P, Q)) P = k, Q = i, S = j;
  if (length(Q, S) < length(P, S)) std::swap(P, Q);

  const Vec3<T> e = y[Q] - y[P], f = y[S] - y[P];
  const T e_squared = e.squaredNorm();
  if (e_squared > T(0)) {
    const T f_along_e = f.dot(e) / e_squared, origin_along_e = -y[P].dot(e) / e_squared;
    const Vec3<T> across = f - f_along_e * e, from_origin = y[P] + origin_along_e * e;
    const T across_squared = across.squaredNorm();
    const T weight_S = -from_origin.dot(across) / across_squared;
    const T weight_Q = origin_along_e - weight_S * f_along_e;
    const T weight_P = T(1) - weight_Q - weight_S;
    // If the vertices are collinear, the direction perpendicular to their line consists mostly of
    // rounding. The edges then suffice.
    const Vec3<T> zero = Vec3<T>::Zero(), normal = face_normal(y[P], y[Q], y[S]);
    const bool is_flat =
        !(normal.squaredNorm() >
          tolerance::collinear<T> * tolerance::collinear<T> * e_squared * f.squaredNorm());
    if (!is_flat && weight_P > T(0) && weight_Q > T(0) && weight_S > T(0)) {
      ClosestPoint<T, 3> result;
      // Computed along the plane's normal, so that even a short v has the right direction.
      const T height = normal.dot(nearest_of(y[P], y[Q], y[S], zero));
      result.v = normal * (height / normal.squaredNorm());
      result.weights[P] = weight_P;
      result.weights[Q] = weight_Q;
      result.weights[S] = weight_S;
      result.kept = (1u << i) | (1u << j) | (1u << k);
      return result;
    }
  }
  ClosestPoint<T, 3> best = closest_on_edge(y, P, Q);
  T best_squared = best.v.squaredNorm();
  keep_closer(best, best_squared, closest_on_edge(y, Q, S));
  keep_closer(best, best_squared, closest_on_edge(y, S, P));
  return best;
}

/// True if the plane of face ijk separates the origin from vertex l, or if the tetrahedron is too
/// flat to decide.
template <class T>
bool beyond_face(const SimplexPoints<T>& y, unsigned i, unsigned j, unsigned k, unsigned l) {
  const Vec3<T> normal = face_normal(y[i], y[j], y[k]);
  const Vec3<T> zero = Vec3<T>::Zero();
  const T height_of_vertex = normal.dot(y[l] - nearest_of(y[i], y[j], y[k], y[l]));
  const T height_of_origin = -normal.dot(nearest_of(y[i], y[j], y[k], zero));
  // The sign of a height within the vertex's rounding is meaningless. The four points are then in
  // one plane and enclose nothing, for example if the support point of an octahedron's face is the
  // middle of the face.
  const T size = std::max({y[i].cwiseAbs().maxCoeff(), y[j].cwiseAbs().maxCoeff(),
                           y[k].cwiseAbs().maxCoeff(), y[l].cwiseAbs().maxCoeff()});
  const T rounding = tolerance::flat_simplex<T> * size * normal.norm();
  return !(std::abs(height_of_vertex) > rounding) || !(height_of_vertex * height_of_origin > T(0));
}

template <class T>
ClosestPoint<T, 3> closest_on_tetrahedron(const SimplexPoints<T>& y) {
  ClosestPoint<T, 3> best;
  T best_squared = std::numeric_limits<T>::infinity();
  if (beyond_face(y, 0, 1, 2, 3)) keep_closer(best, best_squared, closest_on_face(y, 0, 1, 2));
  if (beyond_face(y, 0, 2, 3, 1)) keep_closer(best, best_squared, closest_on_face(y, 0, 2, 3));
  if (beyond_face(y, 0, 3, 1, 2)) keep_closer(best, best_squared, closest_on_face(y, 0, 3, 1));
  if (beyond_face(y, 1, 2, 3, 0)) keep_closer(best, best_squared, closest_on_face(y, 1, 2, 3));
  if (best.kept != 0) return best;

  // Inside all four faces: the tetrahedron contains the origin.
  const auto volume = [&](const Vec3<T>& a, const Vec3<T>& b, const Vec3<T>& c) {
    return std::abs(a.dot(b.cross(c)));
  };
  best.weights = {volume(y[1], y[2], y[3]), volume(y[0], y[2], y[3]), volume(y[0], y[1], y[3]),
                  volume(y[0], y[1], y[2])};
  const T sum = best.weights[0] + best.weights[1] + best.weights[2] + best.weights[3];
  for (T& weight : best.weights) weight = sum > T(0) ? weight / sum : T(0.25);
  best.kept = 0b1111;
  return best;
}

}  // namespace detail

/// The point closest to the origin of the simplex with the vertices y[i] for each bit i of `used`,
/// and the smallest set of these vertices whose convex hull contains the point.
template <class T>
ClosestPoint<T, 3> closest_point(const SimplexPoints<T>& y, unsigned used) {
  std::array<unsigned, 4> slots{};
  std::size_t size = 0;
  for (unsigned i = 0; i < 4; ++i)
    if (used & (1u << i)) slots[size++] = i;
  switch (size) {
    case 1:
      return detail::closest_on_vertex(y, slots[0]);
    case 2:
      return detail::closest_on_edge(y, slots[0], slots[1]);
    case 3:
      return detail::closest_on_face(y, slots[0], slots[1], slots[2]);
    default:
      return detail::closest_on_tetrahedron(y);
  }
}

}  // namespace minkray
