// SPDX-License-Identifier: MIT
// Shapes and queries on pairs of them, for __init__.py to build on.
#include <pybind11/stl.h>

#include <algorithm>
#include <map>
#include <optional>
#include <vector>

#include "renderer/library/python/bind.h"
#include "renderer/library/python/interruptible.h"
#include "renderer/library/python/support.h"

namespace minkray_python {
namespace {

using minkray::Shape;

Shape make(const std::string& kind, const std::map<std::string, Doubles>& numbers,
           const std::map<std::string, std::vector<Shape>>& shapes) {
  std::vector<minkray_parameter> parameters;
  std::vector<std::vector<minkray_shape>> handles;
  handles.reserve(shapes.size());
  for (const auto& [name, array] : numbers)
    parameters.push_back(
        {name.c_str(), array.data(), static_cast<std::size_t>(array.size()), nullptr, 0});
  for (const auto& [name, operands] : shapes) {
    std::vector<minkray_shape>& list = handles.emplace_back();
    for (const Shape& operand : operands) list.push_back(operand.handle());
    parameters.push_back({name.c_str(), nullptr, 0, list.data(), list.size()});
  }
  minkray_shape made;
  const Unlocked unlock;
  check(minkray_shape_make(kind.c_str(), parameters.data(), parameters.size(), &made));
  return Shape(made);
}

py::array_t<double> support(const Shape& shape, const py::object& directions) {
  const Doubles rows(rows_of<double>(directions, 3, "directions").array);
  py::array_t<double> points({rows.shape(0), py::ssize_t{3}});
  const auto* n = reinterpret_cast<const double(*)[3]>(rows.data());
  auto* p = reinterpret_cast<double(*)[3]>(points.mutable_data());
  const auto count = static_cast<std::size_t>(rows.shape(0));
  {
    const Unlocked unlock;
    check(minkray_shape_support(shape.handle(), count, n, p));
  }
  return points;
}

/// The element for a pair: one for each pair, or one for all of them.
template <class Thing>
const Thing& of_pair(const std::vector<Thing>& things, std::size_t i) {
  return things[things.size() == 1 ? 0 : i];
}

/// Rows of `width` numbers, one for each pair or one for all of them.
class NumbersOfPairs {
 public:
  NumbersOfPairs(const Doubles& array, std::size_t width)
      : first_(array.data()), step_(static_cast<std::size_t>(array.size()) > width ? width : 0) {}
  template <class Plain>
  const Plain& of_pair(std::size_t i) const {
    return *reinterpret_cast<const Plain*>(first_ + i * step_);
  }

 private:
  const double* first_;
  std::size_t step_;
};

/// A column for each number, vector and status of the answers.
template <class Answer>
py::dict columns_of(const std::vector<Answer>& found,
                    std::initializer_list<std::pair<const char*, double Answer::*>> numbers) {
  const auto n = static_cast<py::ssize_t>(found.size());
  py::dict result;
  for (const auto& [name, number] : numbers) {
    py::array_t<double> column(n);
    for (std::size_t i = 0; i < found.size(); ++i) column.mutable_data()[i] = found[i].*number;
    result[name] = column;
  }
  for (const auto& [name, vector] : {std::pair{"point_a", &Answer::point_a},
                                     {"point_b", &Answer::point_b},
                                     {"normal", &Answer::normal}}) {
    py::array_t<double> column({n, py::ssize_t{3}});
    for (std::size_t i = 0; i < found.size(); ++i)
      std::copy_n(&(found[i].*vector).x, 3, column.mutable_data() + 3 * i);
    result[name] = column;
  }
  py::array_t<std::uint8_t> status(n);
  for (std::size_t i = 0; i < found.size(); ++i)
    status.mutable_data()[i] = static_cast<std::uint8_t>(found[i].status);
  result["status"] = status;
  return result;
}

py::dict signed_distance(const std::vector<Shape>& a, const Doubles& pose_a,
                         const std::vector<Shape>& b, const Doubles& pose_b, double tolerance,
                         std::size_t count) {
  const NumbersOfPairs poses_a(pose_a, 12), poses_b(pose_b, 12);
  std::vector<minkray::Distance> found(count);
  {
    const Unlocked unlock;
    for (std::size_t i = 0; i < count; ++i)
      found[i] =
          minkray::signed_distance(of_pair(a, i), poses_a.of_pair<minkray::Pose>(i), of_pair(b, i),
                                   poses_b.of_pair<minkray::Pose>(i), tolerance);
  }
  using minkray::Distance;
  return columns_of<Distance>(
      found,
      {{"value", &Distance::value}, {"lower", &Distance::lower}, {"upper", &Distance::upper}});
}

py::dict time_of_impact(const std::vector<Shape>& a, const Doubles& pose_a, const Doubles& twist_a,
                        const std::vector<Shape>& b, const Doubles& pose_b, const Doubles& twist_b,
                        const Doubles& t_max, std::size_t count) {
  const NumbersOfPairs poses_a(pose_a, 12), poses_b(pose_b, 12), twists_a(twist_a, 6),
      twists_b(twist_b, 6), ends(t_max, 1);
  std::vector<minkray::Impact> found(count);
  {
    const Unlocked unlock;
    for (std::size_t i = 0; i < count; ++i)
      found[i] = minkray::time_of_impact(
          of_pair(a, i), poses_a.of_pair<minkray::Pose>(i), twists_a.of_pair<minkray::Twist>(i),
          of_pair(b, i), poses_b.of_pair<minkray::Pose>(i), twists_b.of_pair<minkray::Twist>(i),
          ends.of_pair<double>(i));
  }
  using minkray::Impact;
  return columns_of<Impact>(
      found, {{"t_lo", &Impact::t_lo}, {"t_hi", &Impact::t_hi}, {"distance", &Impact::distance}});
}

Shape mesh(const py::array_t<double, py::array::c_style>& vertices,
           const py::array_t<std::uint32_t, py::array::c_style>& triangles) {
  const minkray::View<const minkray::Vec3> points(
      reinterpret_cast<const minkray::Vec3*>(vertices.data()),
      static_cast<std::size_t>(vertices.shape(0)));
  const minkray::View<const std::uint32_t> corners(triangles.data(),
                                                   static_cast<std::size_t>(triangles.size()));
  const Unlocked unlock;
  return minkray::mesh(points, corners);
}

Shape height_field(const py::array_t<double, py::array::c_style>& heights, double size_x,
                   double size_y, std::optional<double> bottom) {
  const Unlocked unlock;
  return minkray::height_field({heights.data(), static_cast<std::size_t>(heights.size())},
                               static_cast<std::size_t>(heights.shape(0)),
                               static_cast<std::size_t>(heights.shape(1)), size_x, size_y,
                               bottom ? &*bottom : nullptr);
}

py::tuple mesh_arrays(const Shape& shape) {
  const minkray::MeshInfo info = minkray::mesh_info(shape);
  py::array_t<double> vertices({static_cast<py::ssize_t>(info.vertices), py::ssize_t{3}});
  py::array_t<std::uint32_t> triangles({static_cast<py::ssize_t>(info.triangles), py::ssize_t{3}});
  check(minkray_shape_mesh_arrays(shape.handle(),
                                  reinterpret_cast<double(*)[3]>(vertices.mutable_data()),
                                  reinterpret_cast<std::uint32_t(*)[3]>(triangles.mutable_data())));
  return py::make_tuple(vertices, triangles);
}

py::dict mesh_info(const Shape& shape) {
  minkray::MeshInfo info;
  {
    const Unlocked unlock;
    info = minkray::mesh_info(shape);
  }
  py::dict result;
  result["vertices"] = info.vertices;
  result["triangles"] = info.triangles;
  result["open_edges"] = info.open_edges;
  result["without_area"] = info.without_area;
  result["repeated"] = info.repeated;
  return result;
}

Shape compound(const std::vector<Shape>& shapes, const Doubles& poses) {
  std::vector<minkray_shape> handles;
  for (const Shape& shape : shapes) handles.push_back(shape.handle());
  minkray_shape made;
  const Unlocked unlock;
  check(minkray_shape_compound(handles.data(), reinterpret_cast<const minkray_pose*>(poses.data()),
                               handles.size(), &made));
  return Shape(made);
}

py::tuple compound_parts(const Shape& shape) {
  const std::size_t count = minkray::compound_size(shape);
  py::list shapes;
  py::array_t<double> poses({static_cast<py::ssize_t>(count), py::ssize_t{3}, py::ssize_t{4}});
  for (std::size_t i = 0; i < count; ++i) {
    const minkray::Part part = minkray::compound_part(shape, i);
    shapes.append(part.shape);
    std::copy_n(&part.pose.rows[0][0], 12, poses.mutable_data() + 12 * i);
  }
  return py::make_tuple(shapes, poses);
}

}  // namespace

void bind_shapes(py::module_& module) {
  py::class_<Shape>(module, "Shape",
                    "An immutable convex shape, mesh or compound.\n\n"
                    "Made by functions such as `minkray.box`; see `minkray.custom` for your own.")
      .def("_kind", &Shape::kind)
      .def("_support", &support)
      .def("_bounds",
           [](const Shape& shape) {
             Shape::Bounds bounds;
             {
               const Unlocked unlock;
               bounds = shape.bounds();
             }
             py::array_t<double> corners({py::ssize_t{2}, py::ssize_t{3}});
             std::copy_n(&bounds.lower.x, 6, corners.mutable_data());
             return corners;
           })
      .def("_json", &Shape::json<std::string>)
      .def("__repr__", [](const Shape& shape) {
        const std::string kind = shape.kind();
        if (kind == "custom" || kind == "mesh" || kind == "compound")
          return "<minkray.Shape " + kind + ">";
        try {
          std::string text = shape.json<std::string>();
          if (text.size() > 200) text = text.substr(0, 197) + "...";
          return "<minkray.Shape " + text + ">";
        } catch (const minkray::Error&) {  // of what is custom within
          return "<minkray.Shape " + kind + ", custom within>";
        }
      });
  module.def("make", &make);
  module.def("custom", &custom);
  module.def("mesh", &mesh);
  module.def("height_field", &height_field);
  module.def("mesh_info", &mesh_info);
  module.def("mesh_arrays", &mesh_arrays);
  module.def("compound", &compound);
  module.def("compound_parts", &compound_parts);
  module.def("read_shape", [](const std::string& json, const std::string& folder) {
    return minkray::read_shape(json, folder);
  });
  module.def("signed_distance", &signed_distance);
  module.def("time_of_impact", &time_of_impact);
}

}  // namespace minkray_python
