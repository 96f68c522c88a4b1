// SPDX-License-Identifier: MIT
// A convex shape of any kind. ShapeVariant is the only list of all kinds: to add a kind, add a
// header and one line in ShapeVariant.
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

using ShapeVariant = std::variant<  //
    Point,                          //
    Segment,                        //
    Triangle,                       //
    Sphere,                         //
    Ellipsoid,                      //
    Box,                            //
    Disk,                           //
    Cylinder,                       //
    CutCylinder,                    //
    Cone,                           //
    Capsule,                        //
    TaperedCapsule,                 //
    Frustum,                        //
    Superellipsoid,                 //
    Hull,                           //
    Rounded,                        //
    MinkowskiSum,                   //
    MinkowskiDifference,            //
    HullOf,                         //
    Transform,                      //
    Custom>;

namespace detail {
template <class S, class Variant>
inline constexpr bool is_alternative = false;
template <class S, class... Kinds>
inline constexpr bool is_alternative<S, std::variant<Kinds...>> = (std::is_same_v<S, Kinds> || ...);
}  // namespace detail

struct Shape {
  ShapeVariant kind;

  template <class S>
  requires detail::is_alternative<S, ShapeVariant> Shape(S shape) : kind(std::move(shape)) {}

  // Compiled once, in shape.cpp, since each of these functions has code for every kind of shape.
  Shape(const Shape& other);
  Shape(Shape&& other) noexcept;
  Shape& operator=(const Shape& other);
  Shape& operator=(Shape&& other) noexcept;
  ~Shape();

  /// Returns the point of the shape that is furthest along n (the support point). n may have any
  /// length; for n = 0, the result is any point of the shape.
  template <class W>
  Vec3<W> support(const Vec3<W>& n) const {
    return std::visit([&](const auto& shape) -> Vec3<W> { return shape.support(n); }, kind);
  }

  /// Returns an ellipsoid that touches the shape at the support point in direction n and has the
  /// same curvature there (core/support/jet.h).
  template <class W>
  Jet<W> jet(const Vec3<W>& n) const {
    return std::visit([&](const auto& shape) -> Jet<W> { return shape.jet(n); }, kind);
  }
};

inline Nested::Nested(Shape shape) : shape_(std::make_shared<const Shape>(std::move(shape))) {}

template <class W>
Vec3<W> Nested::support(const Vec3<W>& n) const {
  return shape_->support(n);
}

template <class W>
Jet<W> Nested::jet(const Vec3<W>& n) const {
  return shape_->jet(n);
}

extern template Vec3<double> Shape::support(const Vec3<double>&) const;
extern template Vec3<long double> Shape::support(const Vec3<long double>&) const;
extern template Jet<double> Shape::jet(const Vec3<double>&) const;

static_assert(SupportMapped<Shape, double>);

/// Calls visit.template operator()<S>() for every kind of shape S, in the order of ShapeVariant.
template <class Visit>
void for_each_shape_kind(Visit&& visit) {
  [&]<class... S>(std::type_identity<std::variant<S...>>) {
    (visit.template operator()<S>(), ...);
  }(std::type_identity<ShapeVariant>());
}

}  // namespace minkray
