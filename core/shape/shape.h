// SPDX-License-Identifier: MIT
// A convex shape of any kind. This is the only list of all kinds: a new shape is a header and one
// line in ShapeVariant.
#pragma once

#include <type_traits>
#include <utility>
#include <variant>

#include "core/shape/box.h"
#include "core/shape/capsule.h"
#include "core/shape/cone.h"
#include "core/shape/custom.h"
#include "core/shape/cut_cylinder.h"
#include "core/shape/cylinder.h"
#include "core/shape/disk.h"
#include "core/shape/ellipsoid.h"
#include "core/shape/frustum.h"
#include "core/shape/hull.h"
#include "core/shape/hull_of.h"
#include "core/shape/minkowski_difference.h"
#include "core/shape/minkowski_sum.h"
#include "core/shape/point.h"
#include "core/shape/rounded.h"
#include "core/shape/segment.h"
#include "core/shape/sphere.h"
#include "core/shape/superellipsoid.h"
#include "core/shape/tapered_capsule.h"
#include "core/shape/transform.h"
#include "core/shape/triangle.h"
#include "core/support/support_mapped.h"

namespace minkray {

template <class T>
using ShapeVariant = std::variant<  //
    Point<T>,                       //
    Segment<T>,                     //
    Triangle<T>,                    //
    Sphere<T>,                      //
    Ellipsoid<T>,                   //
    Box<T>,                         //
    Disk<T>,                        //
    Cylinder<T>,                    //
    CutCylinder<T>,                 //
    Cone<T>,                        //
    Capsule<T>,                     //
    TaperedCapsule<T>,              //
    Frustum<T>,                     //
    Superellipsoid<T>,              //
    Hull<T>,                        //
    Rounded<T>,                     //
    MinkowskiSum<T>,                //
    MinkowskiDifference<T>,         //
    HullOf<T>,                      //
    Transform<T>,                   //
    Custom<T>>;

namespace detail {
template <class S, class Variant>
inline constexpr bool is_alternative = false;
template <class S, class... Kinds>
inline constexpr bool is_alternative<S, std::variant<Kinds...>> = (std::is_same_v<S, Kinds> || ...);
}  // namespace detail

template <class T>
struct Shape {
  ShapeVariant<T> kind;

  template <class S>
  requires detail::is_alternative<S, ShapeVariant<T>> Shape(S shape) : kind(std::move(shape)) {}

  // Compiled once, in shape.cpp, since each of these dispatches on every kind of shape.
  Shape(const Shape& other);
  Shape(Shape&& other) noexcept;
  Shape& operator=(const Shape& other);
  Shape& operator=(Shape&& other) noexcept;
  ~Shape();

  /// Returns the point of the shape that is furthest along n. n may have any length; for n = 0, the
  /// result is any point of the shape.
  template <class W>
  Vec3<W> support(const Vec3<W>& n) const {
    return std::visit([&](const auto& shape) -> Vec3<W> { return shape.support(n); }, kind);
  }

  /// The ellipsoid that agrees with the shape to second order in direction n.
  template <class W>
  Jet<W> jet(const Vec3<W>& n) const {
    return std::visit([&](const auto& shape) -> Jet<W> { return shape.jet(n); }, kind);
  }
};

extern template struct Shape<float>;
extern template struct Shape<double>;
extern template struct Shape<long double>;
extern template Vec3<float> Shape<float>::support(const Vec3<float>&) const;
extern template Vec3<double> Shape<double>::support(const Vec3<double>&) const;
extern template Vec3<long double> Shape<long double>::support(const Vec3<long double>&) const;
extern template Jet<float> Shape<float>::jet(const Vec3<float>&) const;
extern template Jet<double> Shape<double>::jet(const Vec3<double>&) const;

static_assert(SupportMapped<Shape<float>, float> && SupportMapped<Shape<double>, double>);

/// Calls visit.template operator()<S>() for every kind of shape S with scalar T, in order.
template <class T, class Visit>
void for_each_shape_kind(Visit&& visit) {
  [&]<class... S>(std::type_identity<std::variant<S...>>) {
    (visit.template operator()<S>(), ...);
  }(std::type_identity<ShapeVariant<T>>());
}

}  // namespace minkray
