// SPDX-License-Identifier: MIT
#include "core/derived/shape_key.h"

#include <bit>

namespace minkray {
namespace {

class KeyWriter {
 public:
  void write(double number) { key.push_back(std::bit_cast<std::uint64_t>(number)); }
  void write(const Vec3<double>& vector) {
    for (int axis = 0; axis < 3; ++axis) write(vector[axis]);
  }
  template <class V, std::size_t N>
  void write(const std::array<V, N>& values) {
    for (const V& value : values) write(value);
  }
  void write(const Nested& nested) { write(*nested); }
  void write(const ShapeList& shapes) {
    key.push_back(shapes.size());
    for (const Nested& shape : shapes) write(*shape);
  }
  void write(const PointCloud& cloud) {
    key.push_back(cloud.points().size());
    for (const Vec3<double>& point : cloud.points()) write(point);
  }
  void write(const AffineMap& map) {
    for (int k = 0; k < 9; ++k) write(map.affine().linear.data()[k]);
    write(map.affine().translation);
  }
  void write(const Shape& shape) {
    key.push_back(shape.kind.index());
    std::visit(
        [&]<class S>(const S& kind) {
          if constexpr (std::is_same_v<S, Custom>)
            key.push_back(reinterpret_cast<std::uintptr_t>(kind.source.get()));
          else
            for_each_field<S>([&](const auto& field) { write(kind.*(field.member)); });
        },
        shape.kind);
  }

  std::vector<std::uint64_t> key;
};

}  // namespace

std::vector<std::uint64_t> key_of(const Shape& shape) {
  KeyWriter writer;
  writer.write(shape);
  return std::move(writer.key);
}

std::size_t hash_of(const std::vector<std::uint64_t>& key) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const std::uint64_t word : key) {
    hash = (hash ^ word) * 0x100000001b3u;
    hash ^= hash >> 32;
  }
  return static_cast<std::size_t>(hash);
}

}  // namespace minkray
