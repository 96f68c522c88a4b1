// SPDX-License-Identifier: MIT
#include "renderer/member_json/write_member.h"

#include "renderer/member_json/read_paint.h"
#include "renderer/member_json/shape_json.h"

namespace minkray {
namespace {

template <class Points>
Json list_of_points(const Points& points) {
  Json list = Json::array();
  for (const Vec3<double>& point : points) list.push_back(to_json(point));
  return list;
}

Json& value_of(Json& object, std::string_view name) {
  return object[std::string(name)];
}

}  // namespace

Json to_json(const Vec3<double>& vector) {
  return Json::array({vector.x(), vector.y(), vector.z()});
}

void write_member(Json& object, std::string_view name, double member) {
  value_of(object, name) = member;
}

void write_member(Json& object, std::string_view name, const std::array<double, 2>& member) {
  value_of(object, name) = {member[0], member[1]};
}

void write_member(Json& object, std::string_view name, const Vec3<double>& member) {
  value_of(object, name) = to_json(member);
}

void write_member(Json& object, std::string_view name, const std::array<Vec3<double>, 2>& member) {
  value_of(object, name) = list_of_points(member);
}

void write_member(Json& object, std::string_view name, const std::array<Vec3<double>, 3>& member) {
  value_of(object, name) = list_of_points(member);
}

void write_member(Json& object, std::string_view name, const PointCloud& member) {
  if (member.source().empty()) {
    value_of(object, name) = list_of_points(member.points());
  } else {
    object["file"] = member.source();
  }
}

void write_member(Json& object, std::string_view name, const Nested& member) {
  value_of(object, name) = write_shape(*member);
}

void write_member(Json& object, std::string_view name, const ShapeList& member) {
  Json list = Json::array();
  for (const Nested& shape : member) list.push_back(write_shape(*shape));
  value_of(object, name) = std::move(list);
}

void write_member(Json& object, std::string_view, const AffineMap& member) {
  const Affine<double>& map = member.affine();
  Json rows = Json::array();
  for (int i = 0; i < 3; ++i) {
    rows.push_back({map.linear(i, 0), map.linear(i, 1), map.linear(i, 2), map.translation[i]});
  }
  object["matrix"] = std::move(rows);
}

void write_member(Json& object, std::string_view name, const Resolution& member) {
  value_of(object, name) = {member.width, member.height};
}

void write_member(Json& object, std::string_view name, const std::optional<double>& member) {
  if (member) write_member(object, name, *member);
}

void write_member(Json& object, std::string_view name, const PaintIfAny& member) {
  if (member) write_member(object, name, *member);
}

void write_member(Json& object, std::string_view name, const std::string& member) {
  if (!member.empty()) value_of(object, name) = member;
}

void write_member(Json& object, std::string_view name, const Paint& member) {
  value_of(object, name) = write_paint(member);
}

void write_member(Json& object, std::string_view name, const PictureFile& member) {
  value_of(object, name) = member.file;
}

void write_member(Json& object, std::string_view name, const TwoMaterials& member) {
  value_of(object, name) = Json::array({(*member.names)[0], (*member.names)[1]});
}

}  // namespace minkray
