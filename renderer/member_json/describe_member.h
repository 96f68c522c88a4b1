// SPDX-License-Identifier: MIT
// Describes how a parameter is written in a file, by the member's type: for people, and for the
// JSON Schema. Counterpart of read_member.h.
#pragma once

#include <string>
#include <type_traits>
#include <vector>

#include "renderer/json/json.h"
#include "renderer/member_json/read_member.h"

namespace minkray {

struct MemberDescription {
  std::string keys;           ///< "radius"; several where one may choose
  std::string value;          ///< "3 numbers"
  Json properties;            ///< JSON Schema: what each key holds
  std::vector<Json> allowed;  ///< JSON Schema: which keys must or must not be there
};

/// Carries the type of a member to the overload for it.
template <class M>
using Member = std::type_identity<M>;

MemberDescription describe(const Parameter&, Member<double>);
MemberDescription describe(const Parameter&, Member<std::array<double, 2>>);
MemberDescription describe(const Parameter&, Member<Vec3<double>>);
MemberDescription describe(const Parameter&, Member<std::array<Vec3<double>, 2>>);
MemberDescription describe(const Parameter&, Member<std::array<Vec3<double>, 3>>);
MemberDescription describe(const Parameter&, Member<PointCloud>);
MemberDescription describe(const Parameter&, Member<Nested>);
MemberDescription describe(const Parameter&, Member<ShapeList>);
MemberDescription describe(const Parameter&, Member<AffineMap>);
MemberDescription describe(const Parameter&, Member<Resolution>);
MemberDescription describe(const Parameter&, Member<std::optional<double>>);
MemberDescription describe(const Parameter&, Member<std::string>);
MemberDescription describe(const Parameter&, Member<Paint>);
MemberDescription describe(const Parameter&, Member<PaintIfAny>);
MemberDescription describe(const Parameter&, Member<PictureFile>);
MemberDescription describe(const Parameter&, Member<TwoMaterials>);
MemberDescription describe_name(const Parameter&, std::span<const std::string_view> names,
                                std::string_view what);
template <class List>
MemberDescription describe(const Parameter& parameter, Member<NameOf<List>>) {
  return describe_name(parameter, List::names, List::what);
}

/// Calls visit(parameter, description) for each parameter of a described struct.
template <class S, class Visit>
void for_each_description(Visit&& visit) {
  for_each_field<S>([&](const auto& field) {
    using M = typename std::remove_cvref_t<decltype(field)>::Member;
    visit(parameter_of(field), describe(parameter_of(field), Member<M>()));
  });
}

/// A list of `count` such things.
Json schema_of_list(const Json& item, std::size_t count);

/// A number in a range.
Json schema_of_number(Range range);

/// "length", "degrees" or nothing.
std::string_view name_of(Unit unit);

}  // namespace minkray
