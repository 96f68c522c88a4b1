// SPDX-License-Identifier: MIT
// Penetration depth of overlapping cores by a polytope inside C that grows around the origin (G.
// van den Bergen, "Proximity Queries and Penetration Depth Computation on 3D Game Objects", 2001).
// Each step adds the support point beyond the face nearest to the origin, until no point is beyond.
// Exact for polytopes.
#pragma once

#include <algorithm>
#include <limits>

#include "core/pair/core_query.h"
#include "core/pair/simplex_point.h"

namespace minkray {

/// Both bounds hold for any rounding of the faces. The plane through a support point bounds the
/// depth from above. The least distance d of a face bounds the depth from below: the faces are a
/// closed surface that winds around the origin once, and so around all points nearer to the origin
/// than d. These points are in the hull of the vertices, which are points of C. Growing preserves
/// this: a point w may replace a face if some plane that does not contain the origin has neither w
/// nor the face's points on the origin's side. So for each face, any unit vector n gives a valid d:
/// the least n.y of the face's three vertices y.
template <CoreKind A, CoreKind B>
class ExpandingPolytope {
 public:
  /// Starts from the result `found`. Searches until the bounds differ by at most `gap`, relative to
  /// the size.
  ExpandingPolytope(const CorePair& pair, double gap, const CoreDistance& found)
      : pair_(pair), size_(pair.size() + pair.x.norm()), gap_(gap * size_), found_(found) {
    found_.upper = 0;
  }

  /// Grows from four points c of C that enclose the origin; `a` has the corresponding points of A.
  /// Returns true if the bounds have met; the result's a and c are then the points at the depth: c
  /// = upper * axis. The bounds hold even if the result is false.
  bool run(const Vec3<double>* c, const Vec3<double>* a) {
    if (!start(c, a)) return false;
    while (found_.supports < most_supports) {
      const int nearest = pop();
      // The heap contains no faces further away than the upper bound of the depth, since none of
      // these can be the nearest.
      const bool is_none = nearest < 0 || faces_[nearest].d >= -found_.lower;
      found_.upper = is_none ? found_.lower : -faces_[nearest].d;
      if (is_none) return finish(found_.lower, found_.axis);
      const Face& face = faces_[nearest];
      const Vec3<double> axis = -face.n;
      const DifferencePoint w = nearest_along<A, B>(pair_, axis);
      ++found_.supports;
      const double height = axis.dot(w.c);
      found_.raise_lower(height, axis);
      if (found_.upper - height <= gap_) return finish(height, axis);
      if (count_ == most_points) return false;
      y_[count_] = w.c;
      a_[count_] = w.a;
      if (!grow(nearest)) return false;
      ++count_;
    }
    return false;
  }

  /// True if four points of C enclose the origin with certainty, so that a polytope can start from
  /// them.
  bool begins(const Vec3<double>* c, const Vec3<double>* a) { return start(c, a); }

  const CoreDistance& found() const { return found_; }

 private:
  static constexpr int most_points = 400, most_faces = 2 * most_points,
                       most_heaped = 4 * most_faces, most_supports = 1000;
  /// Points this close to a plane, relative to the size, count as in the plane.
  static constexpr double in_plane = 1e-14;
  /// Rounding error of the volume of four points of C, relative to the lengths of two sides times
  /// the size. The volume is computed by differences, a cross product and a dot product.
  static constexpr double rounded_volume = 32 * std::numeric_limits<double>::epsilon();

  struct Face {
    Vec3<double> n;
    double d;
    int corner[3];
    int beside[3];  ///< beyond the edge after corner k: 4 * other face + that face's edge
    bool is_there;
  };
  struct Heaped {
    double d;
    int face;
    bool operator<(const Heaped& other) const { return d > other.d; }
  };
  struct Edge {
    int from, to, beside;
  };

  bool start(const Vec3<double>* c, const Vec3<double>* a) {
    const double volume = (c[1] - c[0]).cross(c[2] - c[0]).dot(c[3] - c[0]);
    if (!(std::abs(volume) > 0)) return false;
    for (int i = 0; i < 4; ++i) {
      y_[i] = c[i];
      a_[i] = a[i];
    }
    if (volume > 0) {
      std::swap(y_[0], y_[1]);
      std::swap(a_[0], a_[1]);
    }
    count_ = 4;
    constexpr int corners[4][3] = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {0, 2, 3}};
    for (const auto& corner : corners) {
      // The origin must be on the inner side with certainty: all bounds rely on this. The normal n
      // of a sliver is mostly rounding error.
      const Vec3<double>& from = y_[corner[0]];
      const Vec3<double> e1 = y_[corner[1]] - from, e2 = y_[corner[2]] - from, n = e1.cross(e2);
      const double n_rounding = rounded_volume * e1.norm() * e2.norm();
      if (!(n.dot(from) > (in_plane * n.norm() + n_rounding) * size_)) return false;
      if (add_face(corner[0], corner[1], corner[2]) < 0) return false;
    }
    for (int f = 0; f < 4; ++f)
      for (int k = 0; k < 3; ++k)
        for (int g = 0; g < 4; ++g)
          for (int l = 0; l < 3; ++l)
            if (faces_[f].corner[k] == faces_[g].corner[(l + 1) % 3] &&
                faces_[f].corner[(k + 1) % 3] == faces_[g].corner[l])
              faces_[f].beside[k] = 4 * g + l;
    return true;
  }

  /// Returns the face's index; negative if the origin is not on the inner side of the face.
  int add_face(int i, int j, int k) {
    if (free_count_ == 0 && face_count_ == most_faces) return -1;
    const int index = free_count_ > 0 ? free_[--free_count_] : face_count_++;
    Face& face = faces_[index];
    face.corner[0] = i;
    face.corner[1] = j;
    face.corner[2] = k;
    face.is_there = true;
    const Vec3<double> n = (y_[j] - y_[i]).cross(y_[k] - y_[i]);
    const double squared = n.squaredNorm();
    bool is_flat = false;
    if (squared > 0) {
      face.n = n / std::sqrt(squared);
      const double a = face.n.dot(y_[i]), b = face.n.dot(y_[j]), c = face.n.dot(y_[k]);
      face.d = std::min(std::min(a, b), c);
      is_flat = std::max(std::max(a, b), c) - face.d <= in_plane * size_;
    }
    if (!is_flat || !(face.d > 0)) {
      // For a sliver, the direction of the face's point nearest to the origin is more accurate than
      // the face's normal.
      const Vec3<double> corners[3] = {y_[i], y_[j], y_[k]};
      const SimplexPoint closest = closest_of_simplex(corners, 3, false);
      const double length = std::sqrt(closest.squared);
      if (closest.kept == 0 || !(length > 0)) return -1;
      face.n = closest.v / length;
      face.d = std::min({face.n.dot(y_[i]), face.n.dot(y_[j]), face.n.dot(y_[k])});
      if (!(face.d > 0)) return -1;
    }
    // Leaves out faces further away than the upper bound of the depth.
    if (face.d >= -found_.lower) return index;
    if (heaped_ == most_heaped) return -1;
    heap_[heaped_++] = {face.d, index};
    std::push_heap(heap_, heap_ + heaped_);
    return index;
  }

  /// Returns the face nearest to the origin; negative if no face is nearer than the upper bound of
  /// the depth.
  int pop() {
    while (heaped_ > 0) {
      const Heaped top = heap_[0];
      if (faces_[top.face].is_there && faces_[top.face].d == top.d) return top.face;
      std::pop_heap(heap_, heap_ + heaped_--);
    }
    return -1;
  }

  /// Removes the connected faces around `first` that have the newest point on their outer side.
  /// Fills the hole with a fan of faces to this point.
  bool grow(int first) {
    const Vec3<double>& w = y_[count_];
    int open = 0, edges = 0;
    const auto remove = [&](int f) {
      faces_[f].is_there = false;
      stack_[open++] = f;
    };
    int removed = 0;
    remove(first);
    while (open > 0) {
      const int f = stack_[--open];
      removed_[removed++] = f;
      for (int k = 0; k < 3; ++k) {
        const int beside = faces_[f].beside[k], g = beside / 4;
        if (!faces_[g].is_there) continue;
        const double height = faces_[g].n.dot(w);
        if (height > faces_[g].d - in_plane * size_ && height > 0) {
          remove(g);
        } else {
          edges_[edges++] = {faces_[f].corner[k], faces_[f].corner[(k + 1) % 3], beside};
        }
      }
    }
    // Skips edges whose outer face was removed later.
    int kept = 0;
    for (int e = 0; e < edges; ++e)
      if (faces_[edges_[e].beside / 4].is_there) edges_[kept++] = edges_[e];
    for (int i = 0; i < removed; ++i) free_[free_count_++] = removed_[i];
    return kept >= 3 && close(kept);
  }

  /// Fills the hole with a fan over its edges. The edges must be one loop, or loops that share no
  /// vertex.
  bool close(int edges) {
    for (int e = 0; e < edges; ++e) from_[edges_[e].from] = -1;
    for (int e = 0; e < edges; ++e) {
      const Edge& edge = edges_[e];
      if (from_[edge.from] >= 0) return false;
      const int f = add_face(edge.from, edge.to, count_);
      if (f < 0) return false;
      from_[edge.from] = f;
      faces_[f].beside[0] = edge.beside;
      faces_[edge.beside / 4].beside[edge.beside % 4] = 4 * f;
    }
    for (int e = 0; e < edges; ++e) {
      const int f = from_[edges_[e].from], next = from_[edges_[e].to];
      if (next < 0 || !faces_[next].is_there || faces_[next].corner[0] != edges_[e].to)
        return false;
      faces_[f].beside[1] = 4 * next + 2;
      faces_[next].beside[2] = 4 * f + 1;
    }
    return true;
  }

  /// Sets the best plane, and the surface point nearest to the origin. If several faces lie in that
  /// plane, this point may be in any of the faces.
  bool finish(double height, const Vec3<double>& axis) {
    found_.status = CoreStatus::overlapping;
    found_.lower = height;
    found_.axis = axis;
    const Vec3<double> foot = found_.upper * axis;
    const double way = deeper_by(pair_), all_but_leaning = way * (1 - leaning) - height;
    found_.has_one_direction = true;
    double best = std::numeric_limits<double>::infinity();
    for (int f = 0; f < face_count_; ++f) {
      const Face& face = faces_[f];
      if (!face.is_there) continue;
      // Distance of the face if B were deeper along the axis by `way` (deeper_by).
      if (!(face.d - way * face.n.dot(axis) >= all_but_leaning)) found_.has_one_direction = false;
      if (!(face.d <= -height + gap_ + in_plane * size_)) continue;
      const Vec3<double> corners[3] = {y_[face.corner[0]] - foot, y_[face.corner[1]] - foot,
                                       y_[face.corner[2]] - foot};
      const SimplexPoint closest = closest_of_simplex(corners, 3, false);
      if (!(closest.squared < best)) continue;
      best = closest.squared;
      found_.c = closest.v + foot;
      found_.a.setZero();
      for (int k = 0; k < 3; ++k) found_.a += closest.weight[k] * a_[face.corner[k]];
    }
    return true;
  }

  const CorePair& pair_;
  double size_, gap_;
  CoreDistance found_;
  int count_ = 0, face_count_ = 0, free_count_ = 0, heaped_ = 0;
  Vec3<double> y_[most_points + 1], a_[most_points + 1];
  Face faces_[most_faces];
  int free_[most_faces], stack_[most_faces], removed_[most_faces], from_[most_points + 1];
  Edge edges_[3 * most_faces];
  Heaped heap_[most_heaped];
};

}  // namespace minkray
