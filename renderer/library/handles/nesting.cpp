// SPDX-License-Identifier: MIT
#include "renderer/library/handles/nesting.h"

#include <string>

#include "core/support/declared.h"
#include "renderer/library/handles/call.h"

namespace minkray {
namespace {

class NestingWalk {
 public:
  void of(const Shape& shape) {
    if (++count_ > most_shapes_in_one)
      wrong_use("shape: must have at most " + std::to_string(most_shapes_in_one) + " shapes in it");
    if (++depth_ > deepest_shape)
      wrong_use("shape: must not be nested more than " + std::to_string(deepest_shape) +
                " shapes deep");
    std::visit(
        [&]<class S>(const S& kind) {
          for_each_field<S>([&](const auto& field) { of_member(kind.*(field.member)); });
        },
        shape.kind);
    --depth_;
  }

 private:
  void of_member(const Nested& operand) { of(*operand); }
  void of_member(const ShapeList& operands) {
    for (const Nested& operand : operands) of(*operand);
  }
  template <class Member>
  void of_member(const Member&) {}

  std::size_t count_ = 0, depth_ = 0;
};

}  // namespace

void check_nesting(const Shape& shape) {
  NestingWalk().of(shape);
}

}  // namespace minkray
