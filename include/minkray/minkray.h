// SPDX-License-Identifier: MIT
// Minkray for C++: convex shapes, scenes, ray casts with proofs, distances and times of impact.
// Header-only over minkray_c.h, whose comments specify threads, frames and units; docs/cpp.md has
// examples. Every failure throws a minkray::Error, whose text names the error and its location.
#pragma once

// Example:
//   namespace mk = minkray;
//   mk::Scene scene;
//   scene.add(mk::rounded(mk::box({.5, .2, .1}), .05), mk::translation({1, 0, 0}), "bumper");
//   scene.commit();
//   mk::Hit hit = scene.cast({{-9, 0, 0}, {1, 0, 0}});
//   if (hit.status == mk::hit) use(hit.t, hit.t_lo, hit.t_hi, hit.normal);

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <initializer_list>
#include <limits>
#include <type_traits>
#include <utility>

#include "minkray/minkray_c.h"

namespace minkray {
// The version is part of the names, so parts of a program that use different versions still link.
inline namespace v0 {

/// A point or a direction.
struct Vec3 {
  double x = 0, y = 0, z = 0;
  constexpr double& operator[](std::size_t axis) { return axis == 0 ? x : axis == 1 ? y : z; }
  constexpr const double& operator[](std::size_t axis) const {
    return axis == 0 ? x : axis == 1 ? y : z;
  }
  friend bool operator==(const Vec3&, const Vec3&) = default;
};
static_assert(sizeof(Vec3) == 3 * sizeof(double));

/// A view of contiguous items that the caller owns: a std::vector, std::span, std::array.
template <class T>
class View {
 public:
  constexpr View() = default;
  constexpr View(T* data, std::size_t size) : data_(data), size_(size) {}
  template <class Range>
  requires requires(Range& range) {
    { range.data() } -> std::convertible_to<T*>;
    range.size();
  }
  constexpr View(Range&& range) : data_(range.data()), size_(range.size()) {}
  template <std::size_t N>
  constexpr View(T (&array)[N]) : data_(array), size_(N) {}

  constexpr T* data() const { return data_; }
  constexpr std::size_t size() const { return size_; }
  constexpr T* begin() const { return data_; }
  constexpr T* end() const { return data_ + size_; }
  constexpr T& operator[](std::size_t i) const { return data_[i]; }

 private:
  T* data_ = nullptr;
  std::size_t size_ = 0;
};

/// A null-terminated text: a literal or a std::string.
class Text {
 public:
  constexpr Text() = default;
  constexpr Text(const char* text) : text_(text) {}
  template <class String>
  requires requires(const String& string) {
    { string.c_str() } -> std::convertible_to<const char*>;
  }
  constexpr Text(const String& string) : text_(string.c_str()) {}
  constexpr const char* c_str() const { return text_; }

 private:
  const char* text_ = nullptr;
};

/// An error of a call: what() names the function, the argument and what it must be.
class Error : public std::exception {
 public:
  /// Takes the text of this thread's last failed call.
  explicit Error(int code) : Error(code, minkray_last_error()) {}
  Error(int code, const char* text) : code_(static_cast<minkray_code>(code)) {
    std::size_t i = 0;
    for (; i + 1 < sizeof text_ && text[i]; ++i) text_[i] = text[i];
    text_[i] = '\0';
  }
  const char* what() const noexcept override { return text_; }
  minkray_code code() const { return code_; }

 private:
  minkray_code code_;
  char text_[2048];
};

namespace detail {
[[noreturn]] inline void fail(int code) {
  throw Error(code);
}
inline void check(int code) {
  if (code != MINKRAY_OK) [[unlikely]]
    fail(code);
}
}  // namespace detail

/// Version of the loaded library, such as "0.1.0".
inline const char* version() {
  return minkray_version();
}

// ---- poses ----

/// The affine map x -> linear x + translation, as three rows of four numbers; by default the
/// identity.
struct Pose {
  double rows[3][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
};
static_assert(sizeof(Pose) == sizeof(minkray_pose) && std::is_standard_layout_v<Pose>);

namespace detail {
inline const minkray_pose* plain(const Pose* pose) {
  return reinterpret_cast<const minkray_pose*>(pose);
}
}  // namespace detail

/// A rotation.
struct Quaternion {
  double x = 0, y = 0, z = 0, w = 1;
};

/// The identity.
inline Pose identity() {
  return {};
}
/// A translation.
inline Pose translation(const Vec3& by) {
  return {{{1, 0, 0, by.x}, {0, 1, 0, by.y}, {0, 0, 1, by.z}}};
}
/// A rotation followed by a translation; the quaternion may have any length except zero.
inline Pose pose(const Vec3& by, const Quaternion& q) {
  const double s = 2 / (q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
  const double xx = s * q.x * q.x, yy = s * q.y * q.y, zz = s * q.z * q.z;
  const double xy = s * q.x * q.y, xz = s * q.x * q.z, yz = s * q.y * q.z;
  const double xw = s * q.x * q.w, yw = s * q.y * q.w, zw = s * q.z * q.w;
  return {{{1 - (yy + zz), xy - zw, xz + yw, by.x},
           {xy + zw, 1 - (xx + zz), yz - xw, by.y},
           {xz - yw, yz + xw, 1 - (xx + yy), by.z}}};
}
/// Composition: first `inner`, then `outer`.
inline Pose operator*(const Pose& outer, const Pose& inner) {
  Pose both;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 4; ++j) {
      both.rows[i][j] = j == 3 ? outer.rows[i][3] : 0;
      for (int k = 0; k < 3; ++k) both.rows[i][j] += outer.rows[i][k] * inner.rows[k][j];
    }
  return both;
}

// ---- shapes ----

/// An immutable convex shape, mesh or compound; copies are cheap. Default-constructed and
/// moved-from shapes are empty.
class Shape {
 public:
  Shape() = default;
  /// Takes ownership of a handle of minkray_c.h.
  explicit Shape(minkray_shape handle) : handle_(handle) {}
  Shape(const Shape& other) : handle_(other.handle_) {
    if (handle_.id != 0) detail::check(minkray_shape_retain(handle_));
  }
  Shape(Shape&& other) noexcept : handle_(std::exchange(other.handle_, minkray_shape{0})) {}
  Shape& operator=(Shape other) noexcept {
    std::swap(handle_, other.handle_);
    return *this;
  }
  ~Shape() {
    if (handle_.id != 0) minkray_shape_release(handle_);
  }

  minkray_shape handle() const { return handle_; }

  /// Name of the kind, such as "rounded".
  const char* kind() const {
    const char* name = nullptr;
    detail::check(minkray_shape_kind(handle_, &name));
    return name;
  }
  /// The support point: the shape's furthest point along a direction.
  Vec3 support(const Vec3& direction) const {
    const double n[1][3] = {{direction.x, direction.y, direction.z}};
    double p[1][3];
    detail::check(minkray_shape_support(handle_, 1, n, p));
    return {p[0][0], p[0][1], p[0][2]};
  }
  struct Bounds {
    Vec3 lower, upper;
  };
  Bounds bounds() const {
    Bounds found;
    detail::check(minkray_shape_bounds(handle_, &found.lower.x, &found.upper.x));
    return found;
  }
  /// JSON as in scene files; String is std::string or similar.
  template <class String>
  String json() const {
    std::size_t needed = 0;
    detail::check(minkray_shape_write(handle_, nullptr, 0, &needed));
    String text(needed, '\0');
    detail::check(minkray_shape_write(handle_, text.data(), needed, &needed));
    text.resize(needed - 1);
    return text;
  }

 private:
  minkray_shape handle_ = {0};
};

/// One parameter of a shape, by its name in scene files.
struct Parameter {
  const char* name;
  View<const double> numbers = {};
  View<const Shape> shapes = {};
};

/// A shape of any kind, by its name in scene files (`minkray info --shapes` lists them).
inline Shape make(Text kind, std::initializer_list<Parameter> parameters) {
  constexpr std::size_t most = 8;
  minkray_parameter plain[most] = {};
  if (parameters.size() > most)
    throw Error(MINKRAY_WRONG_USE, "minkray::make: parameters: must be at most 8");
  std::size_t count = 0, shapes = 0;
  for (const Parameter& one : parameters) shapes += one.shapes.size();
  struct Handles {
    explicit Handles(std::size_t n) : at(new minkray_shape[n + 1]) {}
    ~Handles() { delete[] at; }
    Handles(const Handles&) = delete;
    Handles& operator=(const Handles&) = delete;
    minkray_shape* at;
  } handles(shapes);
  minkray_shape* next = handles.at;
  for (const Parameter& one : parameters) {
    plain[count++] = {one.name, one.numbers.data(), one.numbers.size(), next, one.shapes.size()};
    for (const Shape& shape : one.shapes) *next++ = shape.handle();
  }
  minkray_shape made;
  detail::check(minkray_shape_make(kind.c_str(), plain, count, &made));
  return Shape(made);
}

namespace detail {
inline View<const double> as_numbers(View<const Vec3> points) {
  return {points.size() > 0 ? &points.data()->x : nullptr, 3 * points.size()};
}
inline Shape with_shapes(Text kind, View<const Shape> shapes) {
  return make(kind, {{"shapes", {}, shapes}});
}
}  // namespace detail

/// Shapes centred at the origin, or spanned by points.
inline Shape point(const Vec3& position) {
  return make("point", {{"position", {&position.x, 3}}});
}
inline Shape segment(const Vec3& a, const Vec3& b) {
  const Vec3 ends[] = {a, b};
  return make("segment", {{"points", detail::as_numbers(ends)}});
}
inline Shape triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 corners[] = {a, b, c};
  return make("triangle", {{"points", detail::as_numbers(corners)}});
}
inline Shape sphere(double radius) {
  return make("sphere", {{"radius", {&radius, 1}}});
}
inline Shape ellipsoid(const Vec3& radii) {
  return make("ellipsoid", {{"radii", {&radii.x, 3}}});
}
inline Shape box(const Vec3& half_extents) {
  return make("box", {{"half_extents", {&half_extents.x, 3}}});
}
// Around the z axis, from -half_height to half_height.
inline Shape disk(double radius) {
  return make("disk", {{"radius", {&radius, 1}}});
}
inline Shape cylinder(double radius, double half_height) {
  return make("cylinder", {{"radius", {&radius, 1}}, {"half_height", {&half_height, 1}}});
}
inline Shape cone(double radius, double half_height) {
  return make("cone", {{"radius", {&radius, 1}}, {"half_height", {&half_height, 1}}});
}
inline Shape capsule(double radius, double half_height) {
  return make("capsule", {{"radius", {&radius, 1}}, {"half_height", {&half_height, 1}}});
}
inline Shape tapered_capsule(double radius_below, double radius_above, double half_height) {
  const double radii[] = {radius_below, radius_above};
  return make("tapered_capsule", {{"radii", radii}, {"half_height", {&half_height, 1}}});
}
inline Shape frustum(double radius_below, double radius_above, double half_height) {
  const double radii[] = {radius_below, radius_above};
  return make("frustum", {{"radii", radii}, {"half_height", {&half_height, 1}}});
}
/// A cylinder between the planes z = height + slope . (x, y).
struct CutPlanes {
  double lower_height = -1, upper_height = 1;
  double lower_slope[2] = {0, 0}, upper_slope[2] = {0, 0};
};
inline Shape cut_cylinder(double radius, const CutPlanes& planes) {
  const double heights[] = {planes.lower_height, planes.upper_height};
  return make("cut_cylinder", {{"radius", {&radius, 1}},
                               {"heights", heights},
                               {"lower_slope", planes.lower_slope},
                               {"upper_slope", planes.upper_slope}});
}
/// All points where the sum of |x_i / radii_i|^exponent is at most 1.
inline Shape superellipsoid(const Vec3& radii, double exponent) {
  return make("superellipsoid", {{"radii", {&radii.x, 3}}, {"exponent", {&exponent, 1}}});
}
/// The convex hull of points.
inline Shape hull(View<const Vec3> points) {
  return make("hull", {{"points", detail::as_numbers(points)}});
}
inline Shape hull(std::initializer_list<Vec3> points) {
  return hull(View<const Vec3>(points.begin(), points.size()));
}

// Operations: shapes made of shapes.

/// A shape grown by a radius.
inline Shape rounded(const Shape& shape, double radius) {
  return make("rounded", {{"radius", {&radius, 1}}, {"shape", {}, {&shape, 1}}});
}
/// The Minkowski sum.
inline Shape sum(View<const Shape> shapes) {
  return detail::with_shapes("minkowski_sum", shapes);
}
inline Shape sum(std::initializer_list<Shape> shapes) {
  return sum(View<const Shape>(shapes.begin(), shapes.size()));
}
inline Shape sum(const Shape& a, const Shape& b) {
  return sum({a, b});
}
/// The Minkowski difference of a and b, the configuration space obstacle.
inline Shape difference(const Shape& a, const Shape& b) {
  return make("minkowski_difference", {{"a", {}, {&a, 1}}, {"b", {}, {&b, 1}}});
}
/// The convex hull of shapes.
inline Shape hull_of(View<const Shape> shapes) {
  return detail::with_shapes("hull_of", shapes);
}
inline Shape hull_of(std::initializer_list<Shape> shapes) {
  return hull_of(View<const Shape>(shapes.begin(), shapes.size()));
}
/// Applies an invertible affine map to a shape.
inline Shape transformed(const Shape& shape, const Pose& map) {
  return make("transform", {{"map", {&map.rows[0][0], 12}}, {"shape", {}, {&shape, 1}}});
}
/// Moves a shape by a vector.
inline Shape translated(const Shape& shape, const Vec3& by) {
  return transformed(shape, translation(by));
}
/// Scales a shape about the origin: by a factor per axis, or by one factor.
inline Shape scaled(const Shape& shape, const Vec3& by) {
  return transformed(shape, {{{by.x, 0, 0, 0}, {0, by.y, 0, 0}, {0, 0, by.z, 0}}});
}
inline Shape scaled(const Shape& shape, double by) {
  return scaled(shape, Vec3{by, by, by});
}
/// The volume swept by a shape along a straight line.
inline Shape swept(const Shape& shape, const Vec3& way) {
  return sum(shape, segment({0, 0, 0}, way));
}

/// Reads a shape from JSON, as in scene files.
inline Shape read_shape(Text json, Text folder = {}) {
  minkray_shape made;
  detail::check(minkray_shape_read(json.c_str(), folder.c_str(), &made));
  return Shape(made);
}

/// A mesh: triangles with shared vertices, counter-clockwise as seen from outside. Rays hit the
/// mesh itself, not its hull. `triangles` is a contiguous range of vertex indices, or of any type
/// that contains three std::uint32_t, such as std::array<std::uint32_t, 3>. Scenes and rays accept
/// a mesh like a shape; it is not convex, so it cannot be an operand of other shapes.
template <class Triangles>
Shape mesh(View<const Vec3> vertices, const Triangles& triangles) {
  using Item = std::remove_cvref_t<decltype(*triangles.data())>;
  constexpr bool are_numbers = std::is_same_v<Item, std::uint32_t>;
  static_assert(are_numbers || (std::is_trivially_copyable_v<Item> &&
                                sizeof(Item) == 3 * sizeof(std::uint32_t)),
                "minkray::mesh: triangles: must be std::uint32_t, three for each triangle");
  const std::size_t size = triangles.size();
  if (are_numbers && size % 3 != 0)
    throw Error(MINKRAY_WRONG_USE, "minkray::mesh: triangles: must be three numbers each");
  minkray_shape made;
  detail::check(minkray_shape_mesh(reinterpret_cast<const double(*)[3]>(vertices.data()),
                                   vertices.size(),
                                   reinterpret_cast<const std::uint32_t(*)[3]>(triangles.data()),
                                   are_numbers ? size / 3 : size, &made));
  return Shape(made);
}
inline Shape mesh(View<const Vec3> vertices, std::initializer_list<std::uint32_t> triangles) {
  return mesh(vertices, View<const std::uint32_t>(triangles.begin(), triangles.size()));
}

/// A terrain as a mesh: see minkray_shape_height_field. With a `bottom` (which is only read during
/// the call) the mesh is closed to a solid.
inline Shape height_field(View<const double> heights, std::size_t rows, std::size_t columns,
                          double size_x, double size_y, const double* bottom = nullptr) {
  if (rows == 0 || heights.size() % rows != 0 || heights.size() / rows != columns)
    throw Error(MINKRAY_WRONG_USE,
                "minkray::height_field: heights: must be rows times columns numbers");
  minkray_shape made;
  detail::check(
      minkray_shape_height_field(heights.data(), rows, columns, size_x, size_y, bottom, &made));
  return Shape(made);
}

/// Properties of a mesh: see minkray_mesh_info.
struct MeshInfo {
  std::size_t vertices = 0, triangles = 0, open_edges = 0, without_area = 0, repeated = 0;
  bool is_closed() const { return open_edges == 0; }
};
static_assert(sizeof(MeshInfo) == sizeof(minkray_mesh_info));
/// Counts a mesh's vertices, triangles and defects.
inline MeshInfo mesh_info(const Shape& mesh) {
  MeshInfo info;
  detail::check(
      minkray_shape_mesh_info(mesh.handle(), reinterpret_cast<minkray_mesh_info*>(&info)));
  return info;
}

/// A convex shape at a pose in a compound.
struct Part {
  Shape shape;
  Pose pose = identity();
};
/// A solid of convex parts, usable like a mesh; hits name the part.
inline Shape compound(View<const Part> parts) {
  struct Arrays {
    explicit Arrays(std::size_t n) : shapes(new minkray_shape[n + 1]), poses(new Pose[n + 1]) {}
    ~Arrays() {
      delete[] shapes;
      delete[] poses;
    }
    Arrays(const Arrays&) = delete;
    Arrays& operator=(const Arrays&) = delete;
    minkray_shape* shapes;
    Pose* poses;
  } arrays(parts.size());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    arrays.shapes[i] = parts[i].shape.handle();
    arrays.poses[i] = parts[i].pose;
  }
  minkray_shape made;
  detail::check(
      minkray_shape_compound(arrays.shapes, detail::plain(arrays.poses), parts.size(), &made));
  return Shape(made);
}
inline Shape compound(std::initializer_list<Part> parts) {
  return compound(View<const Part>(parts.begin(), parts.size()));
}
/// Number of a compound's parts.
inline std::size_t compound_size(const Shape& compound) {
  std::size_t count = 0;
  detail::check(minkray_shape_compound_size(compound.handle(), &count));
  return count;
}
/// A part of a compound.
inline Part compound_part(const Shape& compound, std::size_t i) {
  minkray_shape shape;
  Part part;
  detail::check(minkray_shape_compound_part(compound.handle(), i, &shape,
                                            reinterpret_cast<minkray_pose*>(&part.pose)));
  part.shape = Shape(shape);
  return part;
}

namespace detail {
/// Runs a support function; the query that called it reports its exceptions.
template <class Work>
int answer(Work&& work) {
  try {
    work();
    return 0;
  } catch (const std::exception& error) {
    minkray_support_failed(error.what());
  } catch (...) {
    minkray_support_failed("an exception that is no std::exception");
  }
  return 1;
}

template <class Support>
Shape custom_within(Support support, const double* lower, const double* upper) {
  minkray_support given = {};
  given.user = new Support(std::move(support));
  given.lower = lower;
  given.upper = upper;
  given.function = [](void* user, std::size_t count, const double(*n)[3], double(*p)[3]) -> int {
    return answer([&] {
      const Support& function = *static_cast<const Support*>(user);
      for (std::size_t i = 0; i < count; ++i) {
        const Vec3 at = function(Vec3{n[i][0], n[i][1], n[i][2]});
        p[i][0] = at.x;
        p[i][1] = at.y;
        p[i][2] = at.z;
      }
    });
  };
  given.release = [](void* user) { delete static_cast<Support*>(user); };
  minkray_shape made;
  check(minkray_shape_custom(&given, &made));
  return Shape(made);
}

template <class Function>
int answer_jets(const Function& function, std::size_t count, const double (*n)[3], double (*p)[3],
                double (*derivatives)[9]) {
  return answer([&] {
    for (std::size_t i = 0; i < count; ++i) {
      const auto jet = function(Vec3{n[i][0], n[i][1], n[i][2]});
      p[i][0] = jet.point.x;
      p[i][1] = jet.point.y;
      p[i][2] = jet.point.z;
      if (!derivatives) continue;
      for (int k = 0; k < 9; ++k) derivatives[i][k] = jet.derivative[k / 3][k % 3];
    }
  });
}
}  // namespace detail

/// A custom shape: `support(const Vec3& n)` returns the furthest point along the unit vector n.
/// Several threads may call `support` at once. If `support` throws, or returns a point that no
/// convex shape can have, the query fails with an Error, which has the exception's text.
template <class Support>
Shape custom(Support support) {
  return detail::custom_within(std::move(support), nullptr, nullptr);
}
/// Makes a shape from a function that computes many points per call: `support(View<const Vec3>
/// directions, View<Vec3> points)`. Casts of many rays collect up to `gathered` directions per
/// call, which pays off if a call is expensive.
template <class Support>
Shape custom_batched(Support support, std::size_t gathered = 0) {
  minkray_support given = {};
  given.user = new Support(std::move(support));
  given.function = [](void* user, std::size_t count, const double(*n)[3], double(*p)[3]) -> int {
    return detail::answer([&] {
      const Support& function = *static_cast<const Support*>(user);
      function(View<const Vec3>(reinterpret_cast<const Vec3*>(n), count),
               View<Vec3>(reinterpret_cast<Vec3*>(p), count));
    });
  };
  given.release = [](void* user) { delete static_cast<Support*>(user); };
  minkray_shape made;
  detail::check(minkray_shape_custom_gathered(&given, gathered, &made));
  return Shape(made);
}
/// A support point and its derivative with respect to the direction, a symmetric matrix.
struct SupportJet {
  Vec3 point;
  double derivative[3][3];  ///< of `point`, for a direction of length 1
};
/// Makes a smooth shape from `jet(const Vec3& n)`, which returns a SupportJet: casts need fewer
/// support points. Wrong derivatives only cost time.
template <class Function>
Shape custom_with_jets(Function jet) {
  minkray_support given = {};
  given.user = new Function(std::move(jet));
  given.function = [](void* user, std::size_t count, const double(*n)[3], double(*p)[3]) -> int {
    return detail::answer_jets(*static_cast<const Function*>(user), count, n, p, nullptr);
  };
  given.release = [](void* user) { delete static_cast<Function*>(user); };
  minkray_shape made;
  detail::check(minkray_shape_custom_with_jets(
      &given,
      [](void* user, std::size_t count, const double(*n)[3], double(*p)[3], double(*d)[9]) -> int {
        return detail::answer_jets(*static_cast<const Function*>(user), count, n, p, d);
      },
      &made));
  return Shape(made);
}
/// Makes a custom shape within the box from `lower` to `upper`; a support point outside of the box
/// is an Error.
template <class Support>
Shape custom(Support support, const Vec3& lower, const Vec3& upper) {
  return detail::custom_within(std::move(support), &lower.x, &upper.x);
}

// ---- rays ----

/// Result of a ray.
enum Status : std::int32_t {
  hit = MINKRAY_HIT,
  miss = MINKRAY_MISS,
  inside = MINKRAY_INSIDE,       ///< the ray begins in the object
  exhausted = MINKRAY_EXHAUSTED  ///< did not converge: neither a hit nor a miss
};

/// The points origin + t direction, 0 <= t <= t_max; a direction of zero is an Error. As in
/// minkray_ray, t_max = 0 means unlimited.
struct Ray {
  Vec3 origin, direction;
  double t_max = std::numeric_limits<double>::infinity();
};
static_assert(sizeof(Ray) == sizeof(minkray_ray));

inline constexpr std::uint32_t no_object = MINKRAY_NO_OBJECT;

/// Hit of a ray; see minkray_hit.
struct Hit {
  double t = std::numeric_limits<double>::infinity();  ///< the point is origin + t direction
  double t_lo = t, t_hi = t;                           ///< proven bounds of t
  double t_base = 0, t_offset = 0;                     ///< t_base + t_offset: a more precise t
  Vec3 point, normal;
  std::uint32_t object = no_object;
  Status status = exhausted;
  std::int32_t supports = 0;
  std::int32_t part = -1;  ///< of a mesh or compound: the triangle or part

  bool found() const { return status == hit || status == inside; }
};
static_assert(sizeof(Hit) == sizeof(minkray_hit));

/// Options of long calls: threads, and a callback that reports progress and can stop the call.
struct Options {
  int threads = 0;                                     ///< 0: one per core
  int (*progress)(void* user, double done) = nullptr;  ///< returns nonzero to stop
  void* user = nullptr;
};

namespace detail {
inline minkray_options plain(const Options& options) {
  return {sizeof(minkray_options), options.threads, 0, options.progress, options.user};
}
inline const minkray_ray* plain(View<const Ray> rays) {
  return reinterpret_cast<const minkray_ray*>(rays.data());
}
inline minkray_hit* plain(View<Hit> hits) {
  return reinterpret_cast<minkray_hit*>(hits.data());
}
/// An array that is released at the end.
template <class Item>
struct Room {
  explicit Room(std::size_t size) : items(new Item[size]) {}
  Room(const Room&) = delete;
  Room& operator=(const Room&) = delete;
  ~Room() { delete[] items; }
  Item* items;
};
/// Throws unless both counts are equal.
inline void check_sizes(const char* function, const char* argument, std::size_t size,
                        const char* other, std::size_t must_be) {
  if (size == must_be) return;
  char text[160];
  std::snprintf(text, sizeof text, "%s: %s: must be as many as %s, %zu (got %zu)", function,
                argument, other, must_be, size);
  throw Error(MINKRAY_WRONG_USE, text);
}
}  // namespace detail

using Proof = minkray_proof;

/// Writes at most rays.size() rays of a lidar: "spinning:32x1800", "VLP-16", or a file (see
/// minkray_lidar_rays). Returns the number of rays that the lidar has.
inline std::size_t lidar(Text pattern, const Pose& pose, View<Ray> rays = {}) {
  std::size_t needed = 0;
  detail::check(minkray_lidar_rays(pattern.c_str(), detail::plain(&pose),
                                   reinterpret_cast<minkray_ray*>(rays.data()), rays.size(),
                                   &needed));
  return needed;
}

/// Writes at most rays.size() rays of a calibrated camera, given as JSON text (see
/// minkray_camera_rays). Returns the number of rays that the camera has.
inline std::size_t camera(Text camera, const Pose& pose, View<Ray> rays = {}) {
  std::size_t needed = 0;
  detail::check(minkray_camera_rays(camera.c_str(), detail::plain(&pose),
                                    reinterpret_cast<minkray_ray*>(rays.data()), rays.size(),
                                    &needed));
  return needed;
}

/// Casts a ray at one shape alone.
inline Hit cast(const Shape& shape, const Ray& ray, const Pose& pose = identity()) {
  Hit found;
  detail::check(minkray_shape_cast(shape.handle(), detail::plain(&pose), detail::plain({&ray, 1}),
                                   1, detail::plain({&found, 1}), nullptr));
  return found;
}

// ---- scenes ----

/// Options for reading a file.
struct FileOptions {
  const Pose* pose = nullptr;  ///< applied to all objects of the file
  Text geometry = {};          ///< of robots: "visual" (default), "collision" or "all"
  Text keyframe = {};          ///< of MJCF, by name or number
  View<const char* const> package_dirs = {};
  bool skip_missing_meshes = false;
  Text meshes = {};  ///< of robots: "exact" or "hull"; empty: exact, but hull for contact in MJCF
};

/// Options of a picture; see minkray_picture_options.
struct PictureOptions {
  Text view = {};  ///< camera, lights and background, as in scene files
  std::uint32_t width = 0, height = 0;
  std::uint32_t samples = 16;
  std::uint64_t seed = 0;
  Text integrator = {};
  std::int32_t bounces = 0, max_depth = 0;  ///< 0: default, negative: none
  bool denoise = false;
};
using Channel = minkray_channel;
/// The least signed distance of a robot along a path; see minkray_clearance.
struct Clearance {
  double lower = 0, upper = 0;
  double row = 0;
  Vec3 point_a, point_b, normal;
  std::uint32_t object_a = no_object, object_b = no_object;
  std::int32_t is_settled = 0, reserved = 0;
};
static_assert(sizeof(Clearance) == sizeof(minkray_clearance) &&
              offsetof(Clearance, is_settled) == offsetof(minkray_clearance, is_settled));

/// Values of Verdict::status.
enum MotionStatus : std::int32_t {
  motion_free = MINKRAY_MOTION_FREE,
  motion_collides = MINKRAY_MOTION_COLLIDES,
  motion_undecided = MINKRAY_MOTION_UNDECIDED
};
/// Proven result for a robot's motion; see minkray_verdict.
struct Verdict {
  double lower = 0, upper = 0;
  double row = 0, begin = 0, end = 0;
  Vec3 point;
  std::uint32_t object_a = no_object, object_b = no_object;
  MotionStatus status = motion_undecided;
  std::int32_t reserved = 0;
};
static_assert(sizeof(Verdict) == sizeof(minkray_verdict) &&
              offsetof(Verdict, status) == offsetof(minkray_verdict, status));

class AllHits;  // see minkray/all_hits.h

// Types for queries on the pairs of a scene, which minkray/pairs.h defines.
struct Bodies;
struct Manifold;
struct NearOptions;
struct SceneImpact;
struct ScenePair;
class ScenePairs;
struct Twist;

/// The numbers of two objects.
struct ObjectPair {
  std::uint32_t a = 0, b = 0;
};

/// Shapes with poses. Any number of threads may query a scene. Changing a scene during a query, or
/// querying it during a change, is an Error.
class Scene {
 public:
  /// Contents of a file: objects with consecutive numbers.
  class Group {
   public:
    std::uint32_t number() const { return group_; }
    std::uint32_t first() const { return first_; }
    std::uint32_t size() const { return size_; }
    std::uint32_t joints() const { return joints_; }
    const char* joint(std::uint32_t i) const {
      const char* name = nullptr;
      detail::check(minkray_scene_joint(scene_, group_, i, &name, nullptr));
      return name;
    }
    /// Writes at most values.size() numbers of a joint's value. Returns how many numbers the value
    /// has.
    std::size_t value(std::uint32_t i, View<double> values) const {
      std::size_t count = 0;
      detail::check(minkray_scene_joint(scene_, group_, i, nullptr, &count));
      detail::check(minkray_scene_joint_value(scene_, group_, i, values.data(), values.size()));
      return count;
    }
    /// Sets a joint that has one number: radians or a length. The next commit moves the robot.
    void set(Text joint, double value) {
      detail::check(minkray_scene_set_joint(scene_, group_, joint.c_str(), &value, 1));
    }
    void set(Text joint, View<const double> values) {
      detail::check(
          minkray_scene_set_joint(scene_, group_, joint.c_str(), values.data(), values.size()));
    }
    /// Moves all objects of the file. Not for files with particles.
    void set_pose(const Pose& pose) {
      detail::check(minkray_scene_set_group_pose(scene_, group_, detail::plain(&pose)));
    }

   private:
    friend class Scene;
    Group(minkray_scene scene, std::uint32_t group) : scene_(scene), group_(group) {
      detail::check(minkray_scene_group(scene, group, &first_, &size_, &joints_));
    }
    minkray_scene scene_;
    std::uint32_t group_, first_ = 0, size_ = 0, joints_ = 0;
  };

  Scene() { detail::check(minkray_scene_make(&handle_)); }
  Scene(Scene&& other) noexcept : handle_(std::exchange(other.handle_, minkray_scene{0})) {}
  Scene& operator=(Scene&& other) noexcept {
    std::swap(handle_, other.handle_);
    return *this;
  }
  ~Scene() {
    if (handle_.id != 0) minkray_scene_release(handle_);
  }

  minkray_scene handle() const { return handle_; }

  /// Adds a shape. Returns its number.
  std::uint32_t add(const Shape& shape, const Pose& pose = identity(), Text name = {}) {
    std::uint32_t object = 0;
    detail::check(
        minkray_scene_add(handle_, shape.handle(), detail::plain(&pose), name.c_str(), &object));
    return object;
  }
  /// Adds a half-space: all points x with normal . x <= offset |normal|.
  std::uint32_t add_half_space(const Vec3& normal, double offset, Text name = {}) {
    std::uint32_t object = 0;
    detail::check(minkray_scene_add_half_space(handle_, &normal.x, offset, name.c_str(), &object));
    return object;
  }
  /// Adds a scene file (.json) or a robot's (URDF, MJCF, SDF, glTF).
  Group add_file(Text file, const FileOptions& options = {}) {
    const minkray_file_options plain = {sizeof plain,
                                        detail::plain(options.pose),
                                        options.geometry.c_str(),
                                        options.keyframe.c_str(),
                                        options.package_dirs.data(),
                                        options.package_dirs.size(),
                                        options.skip_missing_meshes,
                                        options.meshes.c_str()};
    std::uint32_t group = 0;
    detail::check(minkray_scene_add_file(handle_, file.c_str(), &plain, &group));
    return Group(handle_, group);
  }
  /// Moves an object.
  void set_pose(std::uint32_t object, const Pose& pose) {
    detail::check(minkray_scene_set_pose(handle_, object, detail::plain(&pose)));
  }
  /// Removes an object: its number is never reused, all others stay the same.
  void remove(std::uint32_t object) { detail::check(minkray_scene_remove(handle_, object)); }
  /// Applies all changes: builds the BVH, or refits it if objects only moved.
  void commit() { detail::check(minkray_scene_commit(handle_)); }

  /// Number of added objects.
  std::uint32_t size() const {
    std::uint32_t objects = 0;
    detail::check(minkray_scene_size(handle_, &objects, nullptr));
    return objects;
  }
  /// Name of an object, valid as long as the scene exists.
  const char* name(std::uint32_t object) const {
    const char* found = nullptr;
    detail::check(minkray_scene_name(handle_, object, &found));
    return found;
  }
  /// Pose of an object.
  Pose pose(std::uint32_t object) const {
    Pose found;
    detail::check(minkray_scene_pose(handle_, object, reinterpret_cast<minkray_pose*>(&found)));
    return found;
  }

  /// First hit of a ray.
  Hit cast(const Ray& ray) const {
    Hit found;
    detail::check(minkray_scene_cast(handle_, detail::plain({&ray, 1}), 1,
                                     detail::plain({&found, 1}), nullptr));
    return found;
  }
  /// Results are bit-identical for any split of the rays and any number of threads.
  void cast(View<const Ray> rays, View<Hit> hits, const Options& options = {}) const {
    detail::check_sizes("minkray::Scene::cast", "hits", hits.size(), "rays", rays.size());
    const minkray_options how = detail::plain(options);
    detail::check(
        minkray_scene_cast(handle_, detail::plain(rays), rays.size(), detail::plain(hits), &how));
  }
  /// Tests if a ray hits anything: hit, miss, or exhausted.
  Status occluded(const Ray& ray) const {
    std::uint8_t answer = 0;
    detail::check(
        minkray_scene_occluded_rays(handle_, detail::plain({&ray, 1}), 1, &answer, nullptr));
    return static_cast<Status>(answer);
  }
  void occluded(View<const Ray> rays, View<std::uint8_t> answers,
                const Options& options = {}) const {
    detail::check_sizes("minkray::Scene::occluded", "answers", answers.size(), "rays", rays.size());
    const minkray_options how = detail::plain(options);
    detail::check(minkray_scene_occluded_rays(handle_, detail::plain(rays), rays.size(),
                                              answers.data(), &how));
  }
  /// Finds where a ray last leaves an object; see minkray_scene_exit.
  Hit exit(std::uint32_t object, const Ray& ray) const {
    Hit found;
    detail::check(minkray_scene_exit(handle_, object, detail::plain({&ray, 1}), 1,
                                     detail::plain({&found, 1}), nullptr));
    return found;
  }
  /// Finds all entries and exits of rays, sorted by t; see minkray/all_hits.h.
  AllHits all_hits(View<const Ray> rays, const Options& options = {}) const;
  AllHits all_hits(const Ray& ray) const;
  /// Proves results of `cast`.
  void prove(View<const Ray> rays, View<const Hit> hits, View<Proof> proofs,
             const Options& options = {}) const {
    detail::check_sizes("minkray::Scene::prove", "hits", hits.size(), "rays", rays.size());
    detail::check_sizes("minkray::Scene::prove", "proofs", proofs.size(), "rays", rays.size());
    const minkray_options how = detail::plain(options);
    detail::check(minkray_scene_prove(handle_, detail::plain(rays),
                                      reinterpret_cast<const minkray_hit*>(hits.data()),
                                      rays.size(), proofs.data(), &how));
  }
  /// Renders a picture: the channel "rgb" has width * height * 3 numbers.
  void render(const PictureOptions& options, View<const Channel> channels,
              const Options& how = {}) const {
    const minkray_picture_options plain = {
        sizeof plain,    options.view.c_str(),      options.width,     options.height,
        options.samples, options.bounces,           options.max_depth, options.denoise,
        options.seed,    options.integrator.c_str()};
    const minkray_options plain_how = detail::plain(how);
    detail::check(
        minkray_scene_render(handle_, &plain, channels.data(), channels.size(), &plain_how));
  }
  /// Clearance of a robot along a path of joint values, to itself and all other objects. Fills
  /// `steps` with one result per pair of consecutive rows; returns the least of all.
  Clearance clearance(const Group& robot, View<const double> path, std::size_t rows,
                      View<Clearance> steps = {}) const {
    constexpr const char* function = "minkray::Scene::clearance";
    if (steps.size() > 0)
      detail::check_sizes(function, "steps", steps.size(), "steps of the path",
                          rows > 1 ? rows - 1 : 1);
    const std::size_t numbers = rows > 0 ? path.size() / rows : 0;
    detail::check_sizes(function, "path", path.size(), "numbers in its rows", rows * numbers);
    Clearance least;
    detail::check(minkray_scene_clearance(handle_, robot.number(), path.data(), rows, numbers,
                                          nullptr,
                                          reinterpret_cast<minkray_clearance*>(steps.data()),
                                          reinterpret_cast<minkray_clearance*>(&least)));
    return least;
  }

  /// Verifies a robot's motion along a path of joint values: free at all times, or a pair that
  /// collides. Between rows joints move linearly; with `rates` (as many numbers as `path`) as
  /// cubics; with `rates` and `accelerations` as quintics. `proof` names a file for minkray-check.
  /// `times` has one time per row (default: 0, 1, 2, ...). See minkray_scene_verify.
  Verdict verify(const Group& robot, View<const double> path, std::size_t rows,
                 View<const double> rates = {}, double margin = 0,
                 View<const double> accelerations = {}, Text proof = {},
                 View<const double> times = {}) const {
    constexpr const char* function = "minkray::Scene::verify";
    const std::size_t numbers = rows > 0 ? path.size() / rows : 0;
    detail::check_sizes(function, "path", path.size(), "numbers in its rows", rows * numbers);
    if (rates.size() > 0)
      detail::check_sizes(function, "rates", rates.size(), "numbers in the path", path.size());
    if (accelerations.size() > 0)
      detail::check_sizes(function, "accelerations", accelerations.size(), "numbers in the path",
                          path.size());
    if (times.size() > 0) detail::check_sizes(function, "times", times.size(), "rows", rows);
    const minkray_verdict_options options = {
        sizeof options,
        0,
        margin,
        0,
        0,
        0,
        accelerations.size() > 0 ? accelerations.data() : nullptr,
        proof.c_str(),
        times.size() > 0 ? times.data() : nullptr};
    Verdict verdict;
    detail::check(minkray_scene_verify(handle_, robot.number(), path.data(),
                                       rates.size() > 0 ? rates.data() : nullptr, rows, numbers,
                                       &options, reinterpret_cast<minkray_verdict*>(&verdict)));
    return verdict;
  }

  // ---- pairs: see minkray/pairs.h ----

  /// All pairs of objects not proven to be further apart than `within`, sorted by object numbers.
  /// Skips pairs excluded by masks or `allow`, and links that a joint connects.
  ScenePairs distances(double within = 0) const;
  ScenePairs distances(const NearOptions& options) const;
  /// Computes exactly the given pairs, in their order, even if masks or `allow` exclude them.
  ScenePairs distances(View<const ObjectPair> pairs) const;
  ScenePairs distances(View<const ObjectPair> pairs, const NearOptions& options) const;
  /// The k objects nearest to each point: k results per point, the nearest first.
  ScenePairs nearest(View<const Vec3> points, std::size_t k = 1) const;
  ScenePairs nearest(View<const Vec3> points, std::size_t k, const NearOptions& options) const;
  /// The object nearest to each of many given shapes.
  void distance_to(const Bodies& shapes, View<ScenePair> nearest, const NearOptions& options) const;
  ScenePair distance_to(const Shape& shape, const Pose& pose) const;
  /// First contacts of moving shapes with the scene, at times from 0 to t_max.
  void times_of_impact(const Bodies& shapes, View<const double> t_max, View<SceneImpact> impacts,
                       const NearOptions& options) const;
  SceneImpact time_of_impact(const Shape& shape, const Pose& pose, const Twist& twist,
                             double t_max) const;
  /// Contact points of two objects.
  Manifold manifold(std::uint32_t object_a, std::uint32_t object_b) const;
  /// Sets which pairs are tested: those where each object's mask shares a bit with the other
  /// object's category.
  void set_masks(std::uint32_t object, std::uint32_t category, std::uint32_t mask);
  /// Sets if two objects may touch: allowed pairs are skipped.
  void allow(std::uint32_t object_a, std::uint32_t object_b, bool is_allowed = true);
  /// Allows the pairs of the robot's links that an SRDF file lists.
  void allow_from_srdf(const Group& robot, Text file);
  /// The least distance of each step of a robot's path, with its derivative with respect to the
  /// joint values there: as many numbers per step as a row has. See
  /// minkray_scene_clearance_derivatives.
  void clearance_derivatives(const Group& robot, View<const double> path, std::size_t rows,
                             View<Clearance> steps, View<double> jac,
                             View<std::uint8_t> is_ridge = {}, View<double> jac_error = {}) const;

  Proof prove(const Ray& ray, const Hit& hit) const {
    Proof proof;
    prove({&ray, 1}, {&hit, 1}, {&proof, 1});
    return proof;
  }

 private:
  minkray_scene handle_ = {0};
};

// ---- pairs of shapes ----

/// Values of Distance::status.
enum DistanceStatus : std::int32_t {
  separated = MINKRAY_SEPARATED,
  touching = MINKRAY_TOUCHING,  ///< 0 is between the bounds
  overlapping = MINKRAY_OVERLAPPING,
  undecided = MINKRAY_UNDECIDED  ///< the bounds hold, but are not within the tolerance
};
/// Values of Impact::status.
enum ImpactStatus : std::int32_t {
  impact = MINKRAY_IMPACT,
  no_impact = MINKRAY_NO_IMPACT,  ///< proven
  begins_inside = MINKRAY_BEGINS_INSIDE,
  impact_undecided = MINKRAY_IMPACT_UNDECIDED  ///< no impact before t_lo; unknown after t_lo
};

/// Distance of two shapes; see minkray_distance.
struct Distance {
  double value = 0, lower = 0, upper = 0;
  Vec3 point_a, point_b, normal;
  std::int32_t status = undecided, supports = 0;
};
static_assert(sizeof(Distance) == sizeof(minkray_distance) &&
              offsetof(Distance, status) == offsetof(minkray_distance, status));

/// Motion of a shape: `velocity` moves the origin of its frame; `turn` is a rotation vector about
/// that origin (world axes, radians per unit of time).
struct Twist {
  Vec3 velocity, turn;
};
static_assert(sizeof(Twist) == sizeof(minkray_twist));

/// Time of impact of two shapes; see minkray_impact.
struct Impact {
  double t_lo = 0, t_hi = std::numeric_limits<double>::infinity();
  double distance = 0;
  Vec3 point_a, point_b, normal;
  std::int32_t status = impact_undecided, steps = 0;
};
static_assert(sizeof(Impact) == sizeof(minkray_impact) &&
              offsetof(Impact, status) == offsetof(minkray_impact, status));

/// Signed distance of two shapes (negative: penetration depth). The bounds are proven: lower <=
/// value <= upper.
inline Distance signed_distance(const Shape& a, const Pose& pose_a, const Shape& b,
                                const Pose& pose_b, double tolerance = 0) {
  const minkray_distance_options options = {sizeof options, tolerance, 0, 0, 0};
  Distance found;
  detail::check(minkray_signed_distance(a.handle(), detail::plain(&pose_a), b.handle(),
                                        detail::plain(&pose_b), &options,
                                        reinterpret_cast<minkray_distance*>(&found)));
  return found;
}

/// First contact of two moving and turning shapes, at times from 0 to t_max.
inline Impact time_of_impact(const Shape& a, const Pose& pose_a, const Twist& twist_a,
                             const Shape& b, const Pose& pose_b, const Twist& twist_b,
                             double t_max) {
  Impact found;
  const auto plain = [](const Twist& twist) {
    return reinterpret_cast<const minkray_twist*>(&twist);
  };
  detail::check(minkray_time_of_impact(a.handle(), detail::plain(&pose_a), plain(twist_a),
                                       b.handle(), detail::plain(&pose_b), plain(twist_b), t_max,
                                       reinterpret_cast<minkray_impact*>(&found)));
  return found;
}

}  // namespace v0
}  // namespace minkray

#include "minkray/all_hits.h"
#include "minkray/pairs.h"
