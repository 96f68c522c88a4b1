// SPDX-License-Identifier: MIT
// Reading one of several described structs, chosen by the key "type": a shape, a light, a material.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/support/declared.h"
#include "renderer/json/values.h"
#include "renderer/member_json/member_codec.h"
#include "renderer/member_json/words_elsewhere.h"

namespace minkray {

/// Calls visit.template operator()<S>() for each alternative of a variant that a file can hold, in
/// order.
template <class... S, class Visit>
void for_each_alternative(std::type_identity<std::variant<S...>>, Visit&& visit) {
  const auto visit_one = [&]<class One>() {
    if constexpr (!declared_by<One>.by_program) visit.template operator()<One>();
  };
  (visit_one.template operator()<S>(), ...);
}

/// Names of a variant's alternatives: the values of "type".
template <class Variant>
std::vector<std::string> type_names() {
  std::vector<std::string> names;
  for_each_alternative(std::type_identity<Variant>(), [&]<class S>() {
    if (std::find(names.begin(), names.end(), S::name) == names.end()) names.emplace_back(S::name);
  });
  return names;
}

/// Number of operands of a shape that have their own key, such as a and b.
template <class S>
constexpr std::size_t operand_count() {
  std::size_t count = 0;
  for_each_field<S>([&](const auto& field) {
    count += std::is_same_v<typename std::remove_cvref_t<decltype(field)>::Member, Nested>;
  });
  return count;
}

/// True if a shape consists of several operands with their own keys only, so that a list "shapes"
/// may give them in order.
template <class S>
constexpr bool takes_list_of_operands() {
  return operand_count<S>() > 1 && operand_count<S>() == std::tuple_size_v<decltype(S::fields())>;
}

/// Makes an S and lets `read(S&)` fill it; returns nothing if `read` returns false. `read` handles
/// all parameters of S. `what` is the noun for messages: "a shape". An unknown type is the object's
/// only mistake, since its keys cannot be checked.
template <class Variant, class Read>
std::optional<Variant> read_tagged(ObjectReader& object, std::string_view what, Read&& read) {
  std::vector<std::string> names = type_names<Variant>();
  if constexpr (std::is_same_v<Variant, ShapeVariant>) names.emplace_back(half_space_name);
  const Json* type = object.require("type", "the name of " + std::string(what));
  if (!type) return std::nullopt;
  const auto name = read_string(*type, object.path("type"), object.mistakes());
  if (!name) return std::nullopt;

  std::optional<Variant> result;
  bool known = false;
  for_each_alternative(std::type_identity<Variant>(), [&]<class S>() {
    if (known || S::name != *name) return;
    // Two may share a name if one needs a key that the other does not have.
    if constexpr (requires { S::told_by; })
      if (!object.find(S::told_by)) return;
    known = true;
    S made;
    const bool all_read = read(made);
    if (object.finish() && all_read) result = std::move(made);
  });
  if (!known) {
    object.mistakes().add(object.path("type"), "must be the name of " + std::string(what) + " (" +
                                                   found(*type) + "; " + name_meant(*name, names) +
                                                   ")");
  }
  return result;
}

}  // namespace minkray
