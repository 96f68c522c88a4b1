// SPDX-License-Identifier: MIT
#include "renderer/library/handles/make_shape.h"

#include <cmath>
#include <optional>

#include "renderer/json/object_reader.h"
#include "renderer/library/handles/call.h"
#include "renderer/library/handles/held_shape.h"
#include "renderer/library/handles/poses.h"
#include "renderer/member_json/member_codec.h"
#include "renderer/member_json/tagged_json.h"

namespace minkray {
namespace {

/// The parameters of one call while the fields of a shape are filled.
class Arguments {
 public:
  Arguments(std::string_view kind, std::span<const minkray_parameter> parameters)
      : parameters_(parameters), mistakes_(std::string(kind)), no_files_(std::filesystem::path()) {}

  Mistakes& mistakes() { return mistakes_; }

  template <class Member>
  void fill(const Parameter& field, Member& member) {
    const minkray_parameter* given = find(field.name);
    if (!given && field.optional) return;
    if (!given) {
      mistakes_.add(path(field), "missing: must be " + std::string(field.doc));
    } else if (fill_from(*given, field, member)) {
      return;
    }
  }

  /// Reports parameters that the shape does not have.
  void tell_unknown(const std::vector<std::string>& known) {
    for (const minkray_parameter& given : parameters_)
      if (std::ranges::find(known, given.name) == known.end())
        mistakes_.add(JsonPath() / given.name,
                      "is not known (" + suggestion(given.name, known) + ")");
  }

 private:
  static JsonPath path(const Parameter& field) { return JsonPath() / field.name; }

  const minkray_parameter* find(std::string_view name) const {
    for (const minkray_parameter& given : parameters_)
      if (given.name == name) return &given;
    return nullptr;
  }

  static std::span<const double> numbers(const minkray_parameter& given) {
    return {given.numbers, given.numbers ? given.number_count : 0};
  }

  /// Numbers as a file would have them, so that mistakes are the same.
  template <class Member>
  static Json as_json(std::span<const double> numbers) {
    if constexpr (std::is_same_v<Member, double>) {
      if (numbers.size() == 1) return numbers[0];
    }
    Json list = Json::array();
    if constexpr (std::is_same_v<Member, std::array<Vec3<double>, 2>> ||
                  std::is_same_v<Member, std::array<Vec3<double>, 3>>) {
      for (std::size_t i = 0; i < numbers.size(); i += 3) {
        Json point = Json::array();
        for (std::size_t k = i; k < std::min(i + 3, numbers.size()); ++k)
          point.push_back(numbers[k]);
        list.push_back(std::move(point));
      }
    } else {
      for (const double number : numbers) list.push_back(number);
    }
    return list;
  }

  /// Reports numbers that JSON cannot represent.
  bool are_finite(std::span<const double> numbers, const Parameter& field) {
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      if (std::isfinite(numbers[i])) continue;
      const JsonPath place = numbers.size() == 1 ? path(field) : path(field) / i;
      mistakes_.add(place, "must be a finite number (got " + std::to_string(numbers[i]) + ")");
      return false;
    }
    return true;
  }

  template <class Member>
  bool fill_from(const minkray_parameter& given, const Parameter& field, Member& member) {
    if (!are_finite(numbers(given), field)) return false;
    Json json = Json::object();
    json[field.name] = as_json<Member>(numbers(given));
    ObjectReader object(json, JsonPath(), mistakes_);
    return MemberCodec<Member>::read(object, field, member, no_files_);
  }

  bool fill_from(const minkray_parameter& given, const Parameter& field, PointCloud& cloud) {
    const std::span<const double> given_numbers = numbers(given);
    if (given_numbers.empty() || given_numbers.size() % 3 != 0) {
      mistakes_.add(path(field), "must be points of three numbers each, at least one (got " +
                                     std::to_string(given_numbers.size()) + " numbers)");
      return false;
    }
    std::vector<Vec3<double>> points;
    for (std::size_t i = 0; i < given_numbers.size(); i += 3) {
      points.emplace_back(given_numbers[i], given_numbers[i + 1], given_numbers[i + 2]);
      if (!points.back().allFinite()) {
        mistakes_.add(path(field) / (i / 3), "must be finite numbers");
        return false;
      }
    }
    try {
      cloud = PointCloud(std::move(points));
    } catch (const std::runtime_error& error) {
      mistakes_.add(path(field), error.what());
      return false;
    }
    return true;
  }

  std::optional<ShapeList> operands(const minkray_parameter& given, const Parameter& field,
                                    std::size_t least, std::size_t most) {
    const std::size_t count = given.shapes ? given.shape_count : 0;
    if (count < least || count > most) {
      mistakes_.add(
          path(field),
          (most == 1 ? "must be a shape (got " : "must be shapes (got ") +
              (given.numbers ? std::string("numbers") : std::to_string(count) + " of them") + ")");
      return std::nullopt;
    }
    ShapeList list;
    for (std::size_t i = 0; i < count; ++i)
      list.push_back(shape_of(given.shapes[i], std::string(field.name).c_str()).shape());
    return list;
  }
  bool fill_from(const minkray_parameter& given, const Parameter& field, Nested& operand) {
    const auto list = operands(given, field, 1, 1);
    if (list) operand = list->front();
    return list.has_value();
  }
  bool fill_from(const minkray_parameter& given, const Parameter& field, ShapeList& operand_list) {
    auto list = operands(given, field, 1, std::numeric_limits<std::size_t>::max());
    if (!list) return false;
    operand_list = *std::move(list);
    return true;
  }

  bool fill_from(const minkray_parameter& given, const Parameter& field, AffineMap& map) {
    const std::span<const double> rows = numbers(given);
    if (rows.size() != 12) {
      mistakes_.add(path(field), "must be 12 numbers: three rows of a matrix and a translation");
      return false;
    }
    minkray_pose pose;
    std::copy(rows.begin(), rows.end(), &pose.rows[0][0]);
    map = AffineMap(pose_of(&pose, std::string(field.name).c_str()));
    return true;
  }

  std::span<const minkray_parameter> parameters_;
  Mistakes mistakes_;
  MeshFiles no_files_;
};

}  // namespace

Shape make_shape(std::string_view kind, std::span<const minkray_parameter> parameters) {
  for (const minkray_parameter& parameter : parameters) {
    require(parameter.name, "parameters[].name");
    require_room(parameter.number_count, sizeof(double), "parameters[].number_count");
    require_room(parameter.shape_count, sizeof(minkray_shape), "parameters[].shape_count");
  }
  std::optional<Shape> made;
  for_each_alternative(std::type_identity<ShapeVariant>(), [&]<class S>() {
    if (S::name != kind) return;
    S shape;
    Arguments arguments(kind, parameters);
    std::vector<std::string> known;
    for_each_field<S>([&](const auto& field) {
      known.emplace_back(field.name);
      arguments.fill(parameter_of(field), shape.*(field.member));
    });
    arguments.tell_unknown(known);
    if constexpr (requires { shape.misfit(); }) {
      if (const auto misfit = arguments.mistakes().none() ? shape.misfit() : std::nullopt)
        arguments.mistakes().add(JsonPath() / misfit->parameter,
                                 std::string(misfit->must_be) + " " + Json(misfit->number).dump());
    }
    if (!arguments.mistakes().none()) wrong_use(arguments.mistakes().text());
    made.emplace(std::move(shape));
  });
  if (!made)
    wrong_use("kind: must be the name of a shape (got \"" + printable(kind, 60) + "\"; " +
              suggestion(kind, type_names<ShapeVariant>()) + ")");
  return *std::move(made);
}

}  // namespace minkray
