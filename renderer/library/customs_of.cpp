// SPDX-License-Identifier: MIT
#include <algorithm>

#include "renderer/library/call.h"
#include "renderer/library/custom_support.h"

namespace minkray {
namespace {

using Customs = std::vector<std::shared_ptr<const CustomSupport>>;

void collect(const Shape<double>& shape, Customs& customs);

void collect_of(const Nested<double>& operand, Customs& customs) {
  collect(*operand, customs);
}
void collect_of(const ShapeList<double>& operands, Customs& customs) {
  for (const Nested<double>& operand : operands) collect(*operand, customs);
}
template <class Member>
void collect_of(const Member&, Customs&) {}

void collect(const Shape<double>& shape, Customs& customs) {
  std::visit(
      [&]<class S>(const S& kind) {
        if constexpr (declared_by<S>.by_program)
          customs.push_back(std::dynamic_pointer_cast<const CustomSupport>(kind.source));
        else
          for_each_field<S>([&](const auto& field) { collect_of(kind.*(field.member), customs); });
      },
      shape.kind);
}

}  // namespace

Customs customs_of(const Shape<double>& shape) {
  Customs customs;
  collect(shape, customs);
  return customs;
}

bool are_gathered(const Customs& customs) {
  return std::ranges::any_of(customs, [](const auto& one) { return one->most_at_once() > 0; });
}

void throw_if_lied(const Customs& customs) {
  for (const auto& custom : customs)
    if (custom->has_lied()) throw CallError(MINKRAY_BAD_SUPPORT, custom->complaint());
}

}  // namespace minkray
