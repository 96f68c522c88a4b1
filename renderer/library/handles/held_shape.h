// SPDX-License-Identifier: MIT
// Shape behind a handle.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>

#include "core/cast/prepared_shape.h"
#include "core/mesh/triangle_mesh.h"
#include "core/model/shape_definition.h"
#include "core/pair/contact_shape.h"
#include "core/parts/compound.h"
#include "renderer/library/handles/custom_support.h"
#include "renderer/library/handles/handles.h"

namespace minkray {

/// Immutable; prepared data is made on first use.
class HeldShape {
 public:
  explicit HeldShape(Shape shape) : shape_(std::move(shape)), customs_(customs_of(*shape_)) {}
  explicit HeldShape(std::shared_ptr<const TriangleMesh> mesh)
      : mesh_(std::move(mesh)), shape_(Point()) {}
  explicit HeldShape(std::shared_ptr<const Compound> compound);

  /// Null unless it is a mesh.
  const std::shared_ptr<const TriangleMesh>& mesh() const { return mesh_; }
  /// Null unless it is a compound.
  const std::shared_ptr<const Compound>& compound() const { return compound_; }
  /// If not, the members below throw CallError.
  bool is_convex() const { return !mesh_ && !compound_; }

  const Nested& shape() const { return convex().shape_; }
  const std::vector<std::shared_ptr<const CustomSupport>>& customs() const { return customs_; }

  /// For queries on pairs.
  const ContactShape& contact() const {
    convex();
    return *contact_.get([&] { return std::make_shared<const ContactShape>(*shape_); });
  }
  /// For rays at the shape where it is.
  const PreparedShape& prepared() const {
    convex();
    return *prepared_.get(
        [&] { return std::make_shared<const PreparedShape>(definition(), Affine<double>()); });
  }
  /// For rays.
  const std::shared_ptr<const ShapeDefinition>& definition() const {
    convex();
    return definition_.get([&] { return std::make_shared<const ShapeDefinition>(*shape_); });
  }

 private:
  [[noreturn]] void refuse() const;
  const HeldShape& convex() const {
    if (!is_convex()) [[unlikely]]
      refuse();
    return *this;
  }

  /// Made by the first call that needs it; later ones cost one load.
  template <class Thing>
  class Once {
   public:
    template <class Make>
    const std::shared_ptr<const Thing>& get(Make&& make) const {
      if (!is_made_.load(std::memory_order_acquire)) [[unlikely]] {
        const std::lock_guard lock(mutex_);
        if (!thing_) thing_ = make();
        is_made_.store(true, std::memory_order_release);
      }
      return thing_;
    }

   private:
    mutable std::atomic<bool> is_made_ = false;
    mutable std::mutex mutex_;
    mutable std::shared_ptr<const Thing> thing_;
  };

  std::shared_ptr<const TriangleMesh> mesh_;
  std::shared_ptr<const Compound> compound_;
  Nested shape_;
  std::vector<std::shared_ptr<const CustomSupport>> customs_;
  Once<ContactShape> contact_;
  Once<ShapeDefinition> definition_;
  Once<PreparedShape> prepared_;
};

/// All that there are.
inline constinit HandlesForEver<HeldShape> shapes_for_ever(1);
inline Handles<HeldShape>& held_shapes() {
  return shapes_for_ever.handles;
}

/// Throws CallError, which begins with the argument's name, if there is none of that number.
[[noreturn]] void wrong_shape(minkray_shape shape, const char* argument);
inline const HeldShape& shape_of(minkray_shape shape, const char* argument) {
  const HeldShape* const held = held_shapes().find(shape.id);
  if (!held) [[unlikely]]
    wrong_shape(shape, argument);
  return *held;
}

}  // namespace minkray
