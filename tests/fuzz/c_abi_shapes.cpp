// SPDX-License-Identifier: MIT
// Calls that make shapes and query them.
#include <cmath>
#include <limits>

#include "renderer/member_json/shape_json.h"
#include "renderer/member_json/tagged_json.h"
#include "tests/fuzz/c_abi_program.h"
#include "tests/fuzz/shape_from_bytes.h"

namespace minkray::fuzz {
namespace {

/// The kinds of shapes and how many numbers or shapes each of their parameters takes, from the same
/// descriptions as the readers'.
struct ParameterSize {
  std::string name;
  std::size_t numbers = 0, shapes = 0;
};
struct Kind {
  std::string name;
  std::vector<ParameterSize> parameters;
};

template <class Member>
ParameterSize size_of(std::string_view name) {
  ParameterSize size{std::string(name)};
  if constexpr (std::is_same_v<Member, Nested>)
    size.shapes = 1;
  else if constexpr (std::is_same_v<Member, ShapeList>)
    size.shapes = 2;
  else if constexpr (std::is_same_v<Member, AffineMap>)
    size.numbers = 12;
  else if constexpr (std::is_same_v<Member, PointCloud>)
    size.numbers = 15;
  else
    size.numbers = sizeof(Member) / sizeof(double);
  return size;
}

std::vector<Kind> all_kinds() {
  std::vector<Kind> kinds;
  for_each_alternative(std::type_identity<ShapeVariant>(), [&]<class S>() {
    Kind& kind = kinds.emplace_back();
    kind.name = S::name;
    for_each_field<S>([&](const auto& field) {
      using Member = typename std::remove_cvref_t<decltype(field)>::Member;
      kind.parameters.push_back(size_of<Member>(field.name));
    });
  });
  return kinds;
}

/// A ball's, or what is none's.
int answer(void* user, std::size_t count, const double (*directions)[3], double (*points)[3]) {
  auto& support = *static_cast<Support*>(user);
  ++support.calls;
  if (support.kind == Support::fails) return 1;
  double radius = support.radius;
  if (support.kind == Support::inside_out) radius = -radius;
  if (support.kind == Support::changes && support.calls > 300) radius *= 2;
  for (std::size_t i = 0; i < count; ++i)
    for (int k = 0; k < 3; ++k) points[i][k] = radius * directions[i][k];
  if (support.kind == Support::not_a_number && support.calls > 20)
    points[0][0] = std::numeric_limits<double>::quiet_NaN();
  return 0;
}

int answer_with_jets(void* user, std::size_t count, const double (*directions)[3],
                     double (*points)[3], double (*derivatives)[9]) {
  const double radius = static_cast<const Support*>(user)->radius;
  for (std::size_t i = 0; i < count; ++i)
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column)
        derivatives[i][3 * row + column] =
            radius * ((row == column ? 1 : 0) - directions[i][row] * directions[i][column]);
  return answer(user, count, directions, points);
}

void release(void* user) {
  ++static_cast<Support*>(user)->released->times;
}

}  // namespace

void CallProgram::make_shape() {
  static const std::vector<Kind> kinds = all_kinds();
  const Kind& kind = kinds[bytes_.byte() % kinds.size()];
  Sure sure = Sure::either;  // numbers must fit each other in ways that depend on the shape
  bool has_custom = false;
  std::vector<std::vector<double>> numbers;
  std::vector<std::vector<minkray_shape>> operands;
  std::vector<minkray_parameter> parameters;
  for (const ParameterSize& size : kind.parameters) {
    if (hostile()) continue;
    std::vector<double>& of = numbers.emplace_back();
    const std::size_t count = hostile() ? bytes_.byte() % 20 : size.numbers;
    for (std::size_t i = 0; i < count; ++i) {
      const bool is_length = size.numbers < 3 && bytes_.byte() < 240;
      of.push_back(is_length ? bytes_.positive<double>(wild_) : number());
    }
    std::vector<minkray_shape>& shapes = operands.emplace_back();
    for (std::size_t i = 0; i < size.shapes; ++i) {
      const Given<minkray_shape> operand = shape();
      sure = both(sure, operand.sure);
      shapes.push_back(operand.value);
      for (const HeldShape& held : shapes_)
        has_custom |= held.shape.id == operand.value.id && held.is_custom;
    }
    parameters.push_back({size.name.c_str(), nullptr, 0, nullptr, 0});
  }
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    parameters[i].numbers = numbers[i].empty() ? nullptr : numbers[i].data();
    parameters[i].number_count = numbers[i].size();
    parameters[i].shapes = operands[i].empty() ? nullptr : operands[i].data();
    parameters[i].shape_count = operands[i].size();
  }
  const char* name = kind.name.c_str();
  if (hostile()) {
    static constexpr const char* odd[] = {nullptr, "", "spere", "custom", "\xff\n"};
    name = odd[bytes_.below(5)];
    sure = Sure::wrong;
  }
  if (hostile() && !parameters.empty()) {
    parameters[0].name = bytes_.below(2) == 0 ? nullptr : "radiis";
    sure = Sure::wrong;
  }
  Answers<minkray_shape> made;
  const bool has_place = !hostile();
  const int code = minkray_shape_make(name, parameters.data(), parameters.size(),
                                      has_place ? made.data() : nullptr);
  if (promises_.call("minkray_shape_make", code, has_place ? sure : Sure::wrong,
                     made.is_untouched()))
    hold(made[0], has_custom);
}

void CallProgram::read_shape() {
  std::string text = minkray::write_shape(shape_from(bytes_, wild_)).dump();
  // Infinite numbers are null in a text, and of wild ones some do not make a shape.
  Sure sure = wild_ ? Sure::either : Sure::right;
  if (hostile()) {
    text.resize(bytes_.byte() % text.size());
    sure = Sure::wrong;
  }
  Answers<minkray_shape> made;
  const int code = minkray_shape_read(
      text.c_str(), bytes_.below(2) == 0 ? nullptr : "no-such-folder", made.data());
  if (promises_.call("minkray_shape_read", code, sure, made.is_untouched(), MINKRAY_BAD_INPUT))
    hold(made[0], false);
}

void CallProgram::make_custom() {
  Support& own = supports_.emplace_back();
  own.released = &released_;
  own.radius = bytes_.positive<double>(false);
  const unsigned kind = bytes_.byte();
  if (kind >= 192) own.kind = static_cast<Support::Kind>(1 + kind % 4);
  if (own.kind != Support::honest) promises_.allow_bad_support();
  minkray_support support = {answer, &own, release, nullptr, nullptr};
  const double lower[3] = {-own.radius, -own.radius, -own.radius},
               upper[3] = {own.radius, own.radius, own.radius};
  Sure sure = own.kind == Support::honest ? Sure::right : Sure::either;
  const int corners = bytes_.below(8);
  if (corners < 3) support.lower = lower, support.upper = upper;
  if (corners == 3) support.lower = lower, sure = Sure::wrong;
  if (corners == 4) support.lower = upper, support.upper = lower, sure = Sure::wrong;
  if (hostile()) support.function = nullptr, sure = Sure::wrong;
  Answers<minkray_shape> made;
  int code = MINKRAY_OK;
  const char* function = "minkray_shape_custom";
  switch (bytes_.below(3)) {
    case 0:
      code = minkray_shape_custom(&support, made.data());
      break;
    case 1:
      function = "minkray_shape_custom_gathered";
      code = minkray_shape_custom_gathered(&support, bytes_.byte() % 70, made.data());
      break;
    default:
      function = "minkray_shape_custom_with_jets";
      code = minkray_shape_custom_with_jets(&support, answer_with_jets, made.data());
      break;
  }
  if (promises_.call(function, code, sure, made.is_untouched())) hold(made[0], true);
}

void CallProgram::own_shape() {
  const Given<minkray_shape> given = shape();
  const bool retains = bytes_.below(3) == 0;
  const int code = retains ? minkray_shape_retain(given.value) : minkray_shape_release(given.value);
  promises_.call(retains ? "minkray_shape_retain" : "minkray_shape_release", code, given.sure,
                 true);
  if (code == MINKRAY_OK)
    for (HeldShape& held : shapes_)
      if (held.shape.id == given.value.id) held.owners += retains ? 1 : -1;
}

void CallProgram::write_shape() {
  const Given<minkray_shape> given = shape();
  bool is_custom = false;
  for (const HeldShape& held : shapes_)
    if (held.shape.id == given.value.id) is_custom = held.is_custom;
  const Sure sure = both(given.sure, right_if(!is_custom));
  Answers<size_t> needed;
  const bool lacks_text = hostile();
  int code = minkray_shape_write(given.value, nullptr, lacks_text ? 1 : 0, needed.data());
  if (!promises_.call("minkray_shape_write", code, lacks_text ? Sure::wrong : sure,
                      needed.is_untouched()))
    return;
  Answers<char> text(needed[0]);
  code = minkray_shape_write(given.value, text.data(), text.size(), nullptr);
  promises_.call("minkray_shape_write", code, Sure::right, text.is_untouched());
  promises_.expect(text[text.size() - 1] == 0 && std::strlen(text.data()) + 1 == text.size(),
                   "a text that does not end where it says");
  promises_.expect(text.is_kept_behind(), "something is written behind the text");
  Answers<minkray_shape> again;
  code = minkray_shape_read(text.data(), nullptr, again.data());
  if (!promises_.call("minkray_shape_read", code, wild_ ? Sure::either : Sure::right,
                      again.is_untouched(), MINKRAY_BAD_INPUT))
    return;
  hold(again[0], false);
  Answers<char> twice(text.size());
  minkray_shape_write(again[0], twice.data(), twice.size(), nullptr);
  promises_.expect(twice == text,
                   "a shape changes when it is written: " + std::string(text.data()));
}

void CallProgram::ask_shape() {
  const Given<minkray_shape> given = shape();
  Answers<const char*> kind;
  if (promises_.call("minkray_shape_kind", minkray_shape_kind(given.value, kind.data()), given.sure,
                     kind.is_untouched()))
    promises_.expect(kind[0][0] != '\0', "a shape of no kind");
  Answers<double> lower(3), upper(3);
  const int bounded = minkray_shape_bounds(given.value, lower.data(), upper.data());
  if (promises_.call("minkray_shape_bounds", bounded, given.sure,
                     lower.is_untouched() && upper.is_untouched()) &&
      !wild_)
    for (std::size_t k = 0; k < 3; ++k)
      promises_.expect(lower[k] <= upper[k] && std::isfinite(lower[k]) && std::isfinite(upper[k]),
                       "bounds that are none");
  double directions[3][3];
  Sure sure = given.sure;
  for (auto& direction : directions)
    for (double& x : direction) {
      x = number();
      sure = both(sure, right_if(std::isfinite(x)));
    }
  Answers<double[3]> points(3), again(3);
  const int code = minkray_shape_support(given.value, 3, directions, points.data());
  if (!promises_.call("minkray_shape_support", code, sure, points.is_untouched())) return;
  if (minkray_shape_support(given.value, 3, directions, again.data()) == MINKRAY_OK)
    promises_.expect(points == again, "another support point when it is asked again");
  if (wild_) return;
  for (std::size_t i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      promises_.expect(std::isfinite(points[i][k]), "a support point that is not finite");
}

}  // namespace minkray::fuzz
