// SPDX-License-Identifier: MIT
// Body of the scan of planes. MINKRAY_PLANE_SCAN is the function's name; all other names here
// contain the instruction set (core/math/wide.h).
#include "core/math/wide.h"
#include "core/polytope/plane_rows.h"

namespace minkray::exact {
namespace {

/// A plane in each lane.
template <class W>
void scan(const PlaneRows& planes, const Line<double>& line, PlaneScan& found) {
  constexpr std::size_t lanes = LaneOf<W>::count, a_row = PlaneRows::planes_a_row;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Vec3<W> s = widen<W>(line.s), d = widen<W>(line.d);
  const W E(line.E), least(least_component<W>);
  W index(0);
  for (std::size_t i = 0; i < lanes; ++i) index.set_lane(static_cast<int>(i), double(i));
  W in(-infinity), in_hi(-infinity), out(infinity), out_lo(infinity), entered(0), left(0);
  for (std::size_t r = 0; r < planes.rows(); ++r) {
    for (std::size_t from = 0; from < a_row; from += lanes) {
      const double* const row = planes.row(r) + from;
      const W x = W::load(row), y = W::load(row + a_row), z = W::load(row + 2 * a_row);
      // Sums in the same order as in settle_hit(). For planes nearly parallel to the line, another
      // order would give a different result.
      const W slope = x * d.x() + (y * d.y() + z * d.z());
      const W room = W::load(row + 3 * a_row) - (x * s.x() + (y * s.y() + z * s.z()));
      const W inv = W(1) / max(abs(slope), least);
      const W t = room * inv, e = (E + W::load(row + 4 * a_row)) * inv;
      const auto enters = slope < W(0);
      const W t_in = select(enters, -t, W(-infinity)), t_out = select(enters, W(infinity), t);
      entered = select(t_in > in, index, entered);
      left = select(t_out < out, index, left);
      in = max(in, t_in);
      out = min(out, t_out);
      in_hi = max(in_hi, t_in + e);
      out_lo = min(out_lo, t_out - e);
      index += W(double(lanes));
    }
  }
  found = {-infinity, infinity, -infinity, infinity, 0, 0};
  double first_entered = infinity, first_left = infinity;
  for (int i = 0; i < static_cast<int>(lanes); ++i) {
    const double t_in = in.lane(i), t_out = out.lane(i);
    if (t_in > found.in || (t_in == found.in && entered.lane(i) < first_entered)) {
      found.in = t_in;
      first_entered = entered.lane(i);
    }
    if (t_out < found.out || (t_out == found.out && left.lane(i) < first_left)) {
      found.out = t_out;
      first_left = left.lane(i);
    }
    found.in_hi = std::max(found.in_hi, in_hi.lane(i));
    found.out_lo = std::min(found.out_lo, out_lo.lane(i));
  }
  // The last row repeats a plane.
  found.entered = std::min(static_cast<std::size_t>(first_entered), planes.size() - 1);
  found.left = std::min(static_cast<std::size_t>(first_left), planes.size() - 1);
}

}  // namespace

void MINKRAY_PLANE_SCAN(const PlaneRows& planes, const Line<double>& line, PlaneScan& found) {
  scan<Wide<double, static_cast<int>(IsaHere::register_bytes / sizeof(double)), IsaHere>>(
      planes, line, found);
}

}  // namespace minkray::exact
