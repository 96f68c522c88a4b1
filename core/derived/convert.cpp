// SPDX-License-Identifier: MIT
// Converts shapes via their described fields.
#include "core/derived/convert.h"

#include <utility>

namespace minkray {
namespace {

template <class U, class T>
U convert_value(const T& value) requires std::floating_point<T> {
  return static_cast<U>(value);
}
template <class U, class T>
Vec3<U> convert_value(const Vec3<T>& value) {
  return value.template cast<U>();
}
template <class U, class V, std::size_t N>
auto convert_value(const std::array<V, N>& values) {
  return [&]<std::size_t... I>(std::index_sequence<I...>) {
    return std::array{convert_value<U>(values[I])...};
  }
  (std::make_index_sequence<N>());
}
template <class U, class T>
Nested<U> convert_value(const Nested<T>& nested) {
  return convert<U>(*nested);
}
template <class U, class T>
ShapeList<U> convert_value(const ShapeList<T>& shapes) {
  ShapeList<U> converted;
  for (const Nested<T>& shape : shapes) converted.push_back(convert<U>(*shape));
  return converted;
}
template <class U, class T>
PointCloud<U> convert_value(const PointCloud<T>& points) {
  return points.template cast<U>();
}
template <class U, class T>
AffineMap<U> convert_value(const AffineMap<T>& map) {
  return map.template cast<U>();
}

template <class U, template <class> class S, class T>
S<U> convert_fields(const S<T>& shape) {
  S<U> converted;
  const auto from = S<T>::fields();
  const auto to = S<U>::fields();
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    ((converted.*(std::get<I>(to).member) = convert_value<U>(shape.*(std::get<I>(from).member))),
     ...);
  }
  (std::make_index_sequence<std::tuple_size_v<decltype(from)>>());
  return converted;
}

}  // namespace

template <class U, class T>
Shape<U> convert(const Shape<T>& shape) {
  return std::visit(
      []<class S>(const S& kind) -> Shape<U> {
        if constexpr (declared_by<S>.by_program)
          return kind.template cast<U>();
        else
          return convert_fields<U>(kind);
      },
      shape.kind);
}

template Shape<float> convert(const Shape<float>&);
template Shape<float> convert(const Shape<double>&);
template Shape<float> convert(const Shape<long double>&);
template Shape<double> convert(const Shape<float>&);
template Shape<double> convert(const Shape<double>&);
template Shape<double> convert(const Shape<long double>&);
template Shape<long double> convert(const Shape<float>&);
template Shape<long double> convert(const Shape<double>&);
template Shape<long double> convert(const Shape<long double>&);

}  // namespace minkray
