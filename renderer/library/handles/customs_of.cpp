// SPDX-License-Identifier: MIT
#include <algorithm>
#include <unordered_set>
#include <utility>

#include "renderer/library/handles/call.h"
#include "renderer/library/handles/custom_support.h"

namespace minkray {
namespace {

using Customs = std::vector<std::shared_ptr<const CustomSupport>>;

/// Visits each once, however often it occurs in the shape: a sum of a shape with itself, made
/// twenty times over, has it a million times.
class CustomsWalk {
 public:
  void of(const Shape& shape) {
    std::visit(
        [&]<class S>(const S& kind) {
          if constexpr (declared_by<S>.by_program)
            add(std::dynamic_pointer_cast<const CustomSupport>(kind.source));
          else
            for_each_field<S>([&](const auto& field) { of_member(kind.*(field.member)); });
        },
        shape.kind);
  }

  Customs customs;

 private:
  void add(std::shared_ptr<const CustomSupport> custom) {
    if (known_.insert(custom.get()).second) customs.push_back(std::move(custom));
  }
  void of_member(const Nested& operand) { of(*operand); }
  void of_member(const ShapeList& operands) {
    for (const Nested& operand : operands) of(*operand);
  }
  template <class Member>
  void of_member(const Member&) {}

  std::unordered_set<const CustomSupport*> known_;
};

}  // namespace

Customs customs_of(const Shape& shape) {
  CustomsWalk walk;
  walk.of(shape);
  return std::move(walk.customs);
}

bool are_gathered(const Customs& customs) {
  return std::ranges::any_of(customs, [](const auto& one) { return one->most_at_once() > 0; });
}

void throw_lie(const Customs& customs) {
  for (const auto& custom : customs)
    if (custom->has_lied()) throw CallError(MINKRAY_BAD_SUPPORT, custom->complaint());
}

}  // namespace minkray
