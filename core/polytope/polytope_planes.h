// SPDX-License-Identifier: MIT
// Tests lines against a polytope's planes: finds the last plane that a line enters, and the first
// that it leaves. One line and packets with one line per lane share this code.
#pragma once

#include "core/math/gather_rows.h"
#include "core/math/instruction_set.h"
#include "core/polytope/polytope_tables.h"
#include "core/query/line.h"

namespace minkray::exact {

template <class W>
W plane_of(const PolytopeTables& of, const W& edge) {
  return lookup(edge, [&](std::size_t e) { return static_cast<double>(of.plane_of[e]); });
}

/// A row of the table of planes: normal . x = offset, and the depth of the triangles' corners below
/// the plane.
template <class W>
struct PlaneRow {
  Vec3<W> normal;
  W offset, depth;

  PlaneRow(const PolytopeTables& of, const W& plane) {
    const std::array<W, 8> row = gather_row<8>(plane, of.planes.data(), of.plane_row);
    normal = {row[0], row[1], row[2]};
    offset = row[3];
    depth = row[4];
  }
};

/// Sets the hit at the plane that the line enters last, unless the plane is nearly parallel to the
/// line: the cosine of the angle between line and normal must be above `steepest`.
template <class W>
void settle_hit(const PolytopeTables& of, const W& plane, const Line<W>& line, const Mask<W>& open,
                Lane<W> steepest, Entry<W>& entry) {
  const PlaneRow<W> at(of, plane);
  const W slope = at.normal.dot(line.d);
  const Mask<W> hit =
      open & (slope < W(-least_component<W>)) & (slope * slope >= W(steepest * steepest) * line.dd);
  const W inv = W(-1) / slope;
  if (all(hit)) {
    entry = {hit, Mask<W>(false), -(at.offset - at.normal.dot(line.s)) * inv,
             (line.E + at.depth) * inv, at.normal};
    return;
  }
  entry.hit |= hit;
  entry.t = select(hit, -(at.offset - at.normal.dot(line.s)) * inv, entry.t);
  entry.e = select(hit, (line.E + at.depth) * inv, entry.e);
  entry.normal = select<W>(hit, at.normal, entry.normal);
}

/// Sets a miss if the line enters one plane after it leaves another.
template <class W>
void settle_miss(const PolytopeTables& of, const W& entered, const W& left, const Line<W>& line,
                 const Mask<W>& open, Entry<W>& entry) {
  using std::max;
  const PlaneRow<W> in(of, entered), out(of, left);
  const W slope_in = in.normal.dot(line.d), slope_out = out.normal.dot(line.d);
  const W inv_in = W(1) / max(W(-slope_in), W(least_component<W>));
  const W inv_out = W(1) / max(slope_out, W(least_component<W>));
  const W first = -(in.offset - in.normal.dot(line.s)) * inv_in - line.E * inv_in;
  const W last = (out.offset - out.normal.dot(line.s)) * inv_out + line.E * inv_out;
  const Mask<W> miss = open & (slope_in < W(0)) & (slope_out >= W(0)) & (first > last);
  entry.miss |= miss;
  entry.normal = select<W>(miss, between(in.normal, out.normal, line.d), entry.normal);
}

/// Same as PlaneScan, in lanes.
template <class W>
struct PlanesPassed {
  W in = W(-std::numeric_limits<double>::infinity()), in_hi = in;
  W out = -in, out_lo = out;
  W entered = W(0), left = W(0);
};

/// Tests all planes, with the same operations as plane_scan.inl. Lanes are lines here, not planes.
template <class W>
PlanesPassed<W> pass_planes(const PolytopeTables& of, const Line<W>& line) {
  using std::abs;
  using std::max;
  using std::min;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if constexpr (std::is_same_v<W, double>) {
    PlaneScan scan;
    (has_avx2() ? scan_planes_avx2 : scan_planes_sse2)(of.scanned, line, scan);
    return {scan.in,
            scan.in_hi,
            scan.out,
            scan.out_lo,
            static_cast<double>(scan.entered),
            static_cast<double>(scan.left)};
  } else {
    PlanesPassed<W> found;
    for (std::size_t i = 0; i < of.plane_count(); ++i) {
      const double* const row = of.planes.data() + i * of.plane_row;
      const W x(row[0]), y(row[1]), z(row[2]), index(static_cast<double>(i));
      const W slope = x * line.d.x() + (y * line.d.y() + z * line.d.z());
      const W room = W(row[3]) - (x * line.s.x() + (y * line.s.y() + z * line.s.z()));
      const W inv = W(1) / max(abs(slope), W(least_component<W>));
      const W t = room * inv, e = (line.E + W(row[4])) * inv;
      const Mask<W> enters = slope < W(0);
      const W t_in = select(enters, -t, W(-infinity)), t_out = select(enters, W(infinity), t);
      found.entered = select(t_in > found.in, index, found.entered);
      found.left = select(t_out < found.out, index, found.left);
      found.in = max(found.in, t_in);
      found.out = min(found.out, t_out);
      found.in_hi = max(found.in_hi, t_in + e);
      found.out_lo = min(found.out_lo, t_out - e);
    }
    return found;
  }
}

}  // namespace minkray::exact
