// SPDX-License-Identifier: MIT
// Bodies of the gaps between triangles, and of their normals. MINKRAY_TRIANGLE_GAPS and
// MINKRAY_TRIANGLE_NORMALS are the functions' names; all other names here contain the instruction
// set (core/math/wide.h).
#include "core/math/wide.h"
#include "core/parts/triangle_lanes.h"

namespace minkray {
namespace {

template <class W>
struct TriangleOfLane {
  Vec3<W> corners[3];
  Vec3<W> normal;
};

template <class W>
W dot_of(const Vec3<W>& a, const Vec3<W>& b) {
  return a[0] * b[0] + (a[1] * b[1] + a[2] * b[2]);
}

template <class W>
W least_of(const W& a, const W& b, const W& c) {
  return min(a, min(b, c));
}
template <class W>
W most_of(const W& a, const W& b, const W& c) {
  return max(a, max(b, c));
}

template <class W>
W gaps_of(const TriangleOfLane<W>& one, const TriangleOfLane<W>& other, const Vec3<double>* known) {
  // Positions are relative to the first corner of `one`, so numbers are as large as the triangles
  // and their distance.
  const Vec3<W>& from = one.corners[0];
  Vec3<W> own[2], of_other[3];
  for (int k = 0; k < 2; ++k) own[k] = one.corners[k + 1] - from;
  for (int k = 0; k < 3; ++k) of_other[k] = other.corners[k] - from;
  struct Span {
    W least, most;
  };
  const auto span_of_own = [&](const Vec3<W>& n) -> Span {
    const W a = dot_of<W>(n, own[0]), b = dot_of<W>(n, own[1]);
    return {least_of<W>(W(0), a, b), most_of<W>(W(0), a, b)};
  };
  const auto span_of_other = [&](const Vec3<W>& n) -> Span {
    const W a = dot_of<W>(n, of_other[0]), b = dot_of<W>(n, of_other[1]),
            c = dot_of<W>(n, of_other[2]);
    return {least_of<W>(a, b, c), most_of<W>(a, b, c)};
  };
  const auto gap_across = [&](const Vec3<W>& n) {
    return span_of_other(n).least - span_of_own(n).most;
  };
  const auto gap_either_way = [&](const Vec3<W>& n) {
    const Span a = span_of_own(n), b = span_of_other(n);
    return max(b.least - a.most, a.least - b.most);
  };
  W gap = max(gap_either_way(one.normal), gap_either_way(other.normal));
  // Three times the vector between the middles.
  Vec3<W> way;
  for (int i = 0; i < 3; ++i)
    way[i] = (of_other[0][i] + of_other[1][i] + of_other[2][i]) - (own[0][i] + own[1][i]);
  const W length = sqrt(max(dot_of<W>(way, way), W(std::numeric_limits<double>::min())));
  const Vec3<W> u(way[0] / length, way[1] / length, way[2] / length);
  gap = max(gap, gap_across(u));
  return known ? max(gap, gap_across(widen<W>(*known))) : gap;
}

template <class W>
Vec3<W> load_lanes(const double (&rows)[3][EightTriangles::most], std::size_t from) {
  return {W::load(rows[0] + from), W::load(rows[1] + from), W::load(rows[2] + from)};
}

}  // namespace

void MINKRAY_TRIANGLE_NORMALS(EightTriangles& eight) {
  constexpr std::size_t count = IsaHere::register_bytes / sizeof(double);
  using W = Wide<double, static_cast<int>(count), IsaHere>;
  // Thinner slivers (by the sine) and smaller numbers give normals with too few digits.
  constexpr double least_sine = 1e-6, least_square = 0x1p-900;
  for (std::size_t from = 0; from < EightTriangles::most; from += count) {
    const Vec3<W> a = load_lanes<W>(eight.corners[0], from),
                  b = load_lanes<W>(eight.corners[1], from),
                  c = load_lanes<W>(eight.corners[2], from);
    const Vec3<W> u = b - a, v = c - a, n = u.cross(v);
    const W squared = dot_of<W>(n, n),
            of_sides = W(least_sine * least_sine) * dot_of<W>(u, u) * dot_of<W>(v, v);
    const W scale = select((squared > W(least_square)) & (squared > of_sides),
                           W(1) / sqrt(max(squared, W(least_square))), W(0));
    for (int axis = 0; axis < 3; ++axis) (scale * n[axis]).store(eight.normals[axis] + from);
  }
}

void MINKRAY_TRIANGLE_GAPS(const TriangleCorners& one, const Vec3<double>& normal,
                           const EightTriangles& eight, const Vec3<double>* known, double* gaps) {
  constexpr std::size_t count = IsaHere::register_bytes / sizeof(double);
  using W = Wide<double, static_cast<int>(count), IsaHere>;
  const TriangleOfLane<W> same{{widen<W>(one[0]), widen<W>(one[1]), widen<W>(one[2])},
                               widen<W>(normal)};
  for (std::size_t from = 0; from < EightTriangles::most; from += count) {
    const TriangleOfLane<W> other{
        {load_lanes<W>(eight.corners[0], from), load_lanes<W>(eight.corners[1], from),
         load_lanes<W>(eight.corners[2], from)},
        load_lanes<W>(eight.normals, from)};
    gaps_of<W>(same, other, known).store(gaps + from);
  }
}

}  // namespace minkray
