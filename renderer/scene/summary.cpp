// SPDX-License-Identifier: MIT
#include "renderer/scene/summary.h"

#include <algorithm>
#include <set>
#include <type_traits>

#include "core/derived/shape_bounds.h"
#include "core/parallel/parallel_reduce.h"
#include "core/parts/compound.h"
#include "core/world/posed_compound.h"

namespace minkray {
namespace {

/// Walks shapes and counts.
class Counter {
 public:
  Counter() {
    for_each_shape_kind([&]<class S>() { kinds_.push_back({S::name}); });
  }

  /// `times`: how often it is posed; its operands are there once.
  void add(const Shape& shape, bool is_operand, std::size_t times = 1) {
    KindCount& count = kinds_[shape.kind.index()];
    (is_operand ? count.operands : count.objects) += times;
    if (is_operand) bytes += sizeof(shape);
    std::visit(
        [&]<class S>(const S& kind) {
          for_each_field<S>([&](const auto& field) { add_member(kind.*(field.member)); });
        },
        shape.kind);
  }

  std::vector<KindCount> occurring() const {
    std::vector<KindCount> counts;
    for (const KindCount& count : kinds_) {
      if (count.objects + count.operands > 0) counts.push_back(count);
    }
    return counts;
  }

  std::size_t hull_points = 0;
  std::size_t bytes = 0;

 private:
  void add_member(const Nested& operand) { add(*operand, true); }
  void add_member(const ShapeList& operands) {
    bytes += operands.size() * sizeof(Nested);
    for (const Nested& operand : operands) add(*operand, true);
  }
  void add_member(const PointCloud& cloud) {
    hull_points += cloud.points().size();
    bytes += cloud.points().size() * sizeof(Vec3<double>);
  }
  /// All other members are part of their shape's own size.
  template <class M>
  void add_member(const M&) {}

  std::vector<KindCount> kinds_;
};

}  // namespace

Bounds<double> bounds_of(const Object& object) {
  if (object.mesh) return PosedMesh(0, object.mesh, object.pose).bounds();
  if (object.compound) return bounds_under(*object.compound, object.pose);
  return bounds_of(Transform{Nested(object.shape), object.pose});
}

Bounds<double> bounds_of(const ParticleSet& set) {
  return parallel_reduce<Bounds<double>>(
      0, set.size(),
      [&](Bounds<double>& bounds, std::size_t i) {
        bounds.extend(bounds_of(Transform{Nested(set.shape), set.pose(i)}));
      },
      [](Bounds<double>& bounds, const Bounds<double>& of_range) { bounds.extend(of_range); });
}

SceneSummary summarise(const Scene& scene) {
  Counter counter;
  SceneSummary summary;
  std::size_t half_spaces = 0, meshes = 0;
  std::set<const TriangleMesh*> counted;  // instances share meshes
  for (const Object& object : scene.objects) {
    if (object.half_space)
      ++half_spaces;
    else if (object.mesh) {
      ++meshes;
      if (counted.insert(object.mesh.get()).second) counter.bytes += object.mesh->bytes();
    } else if (object.compound) {
      for (std::size_t i = 0; i < object.compound->size(); ++i)
        counter.add(object.compound->part(i).shape, false);
    } else
      counter.add(object.shape, false);
    counter.bytes += sizeof(Object) + object.name.capacity();
    if (!object.half_space) summary.bounds.extend(bounds_of(object));
  }
  for (const ParticleSet& set : scene.particles) {
    counter.add(set.shape, false, set.size());
    counter.bytes += sizeof(ParticleSet) + set.name.capacity() + set.bytes();
    summary.particles += set.size();
    summary.bounds.extend(bounds_of(set));
  }
  summary.instances = scene.objects.size() + summary.particles;
  summary.kinds = counter.occurring();
  if (half_spaces > 0) summary.kinds.push_back({half_space_name, half_spaces});
  if (meshes > 0) summary.kinds.push_back({mesh_name, meshes});
  summary.hull_points = counter.hull_points;
  summary.bytes = counter.bytes;
  return summary;
}

}  // namespace minkray
