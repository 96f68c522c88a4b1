// SPDX-License-Identifier: MIT
// Shapes and queries on pairs of them, for __init__.py to build on.
#include <pybind11/stl.h>

#include <map>
#include <vector>

#include "renderer/library/python/bind.h"
#include "renderer/library/python/support.h"

namespace minkray_python {
namespace {

using minkray::Shape;

/// Runs the work without the interpreter's lock.
template <class Work>
void unlocked(Work&& work) {
  const py::gil_scoped_release unlock;
  work();
}

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
  int code = MINKRAY_OK;
  unlocked([&] {
    code = minkray_shape_make(kind.c_str(), parameters.data(), parameters.size(), &made);
    if (code != MINKRAY_OK) throw minkray::Error(code);
  });
  return Shape(made);
}

py::array_t<double> support(const Shape& shape, const py::object& directions) {
  const Doubles rows(rows_of(directions, 3, "directions").array);
  py::array_t<double> points({rows.shape(0), py::ssize_t{3}});
  const auto* n = reinterpret_cast<const double(*)[3]>(rows.data());
  auto* p = reinterpret_cast<double(*)[3]>(points.mutable_data());
  unlocked([&] {
    const int code =
        minkray_shape_support(shape.handle(), static_cast<std::size_t>(rows.shape(0)), n, p);
    if (code != MINKRAY_OK) throw minkray::Error(code);
  });
  return points;
}

py::array_t<double> array_of(std::vector<py::ssize_t> shape) {
  return py::array_t<double>(std::move(shape));
}

/// One pose for each pair: (4, 4), or (N, 4, 4).
std::vector<minkray::Pose> poses_of(const py::object& object, const char* argument) {
  if (object.is_none()) return {minkray::identity()};
  const Doubles array = Doubles::ensure(object);
  if (!array) PyErr_Clear();
  if (!array || array.ndim() != 3) return {pose_of(object, argument)};
  std::vector<minkray::Pose> poses;
  for (py::ssize_t i = 0; i < array.shape(0); ++i)
    poses.push_back(pose_of(array[py::int_(i)], argument));
  return poses;
}

py::dict signed_distance(const Shape& a, const py::object& pose_a, const Shape& b,
                         const py::object& pose_b, double tolerance) {
  const auto poses_a = poses_of(pose_a, "pose_a"), poses_b = poses_of(pose_b, "pose_b");
  if (poses_a.size() != poses_b.size() && poses_a.size() != 1 && poses_b.size() != 1)
    throw py::value_error("pose_a, pose_b: must be as many, or one");
  const bool is_none = poses_a.empty() || poses_b.empty();
  const std::size_t count = is_none ? 0 : std::max(poses_a.size(), poses_b.size());
  std::vector<minkray::Distance> found(count);
  unlocked([&] {
    for (std::size_t i = 0; i < count; ++i)
      found[i] = minkray::signed_distance(a, poses_a[poses_a.size() == 1 ? 0 : i], b,
                                          poses_b[poses_b.size() == 1 ? 0 : i], tolerance);
  });
  const auto n = static_cast<py::ssize_t>(count);
  auto value = array_of({n}), lower = array_of({n}), upper = array_of({n});
  auto point_a = array_of({n, 3}), point_b = array_of({n, 3}), normal = array_of({n, 3});
  py::array_t<std::uint8_t> status(n);
  for (py::ssize_t i = 0; i < n; ++i) {
    const minkray::Distance& one = found[static_cast<std::size_t>(i)];
    value.mutable_at(i) = one.value;
    lower.mutable_at(i) = one.lower;
    upper.mutable_at(i) = one.upper;
    status.mutable_at(i) = static_cast<std::uint8_t>(one.status);
    for (py::ssize_t k = 0; k < 3; ++k) {
      point_a.mutable_at(i, k) = one.point_a[k];
      point_b.mutable_at(i, k) = one.point_b[k];
      normal.mutable_at(i, k) = one.normal[k];
    }
  }
  py::dict result;
  result["value"] = value;
  result["lower"] = lower;
  result["upper"] = upper;
  result["point_a"] = point_a;
  result["point_b"] = point_b;
  result["normal"] = normal;
  result["status"] = status;
  return result;
}

minkray::Twist twist_of(const py::object& object, const char* argument) {
  minkray::Twist twist = {};
  if (object.is_none()) return twist;
  const Doubles six = Doubles::ensure(object);
  if (!six) PyErr_Clear();
  if (!six || six.size() != 6)
    throw py::value_error(std::string(argument) +
                          ": must be six numbers, a velocity and a rotation vector a second");
  for (int k = 0; k < 3; ++k) {
    twist.velocity[k] = six.data()[k];
    twist.turn[k] = six.data()[3 + k];
  }
  return twist;
}

py::dict time_of_impact(const Shape& a, const py::object& pose_a, const py::object& twist_a,
                        const Shape& b, const py::object& pose_b, const py::object& twist_b,
                        double t_max) {
  const minkray::Pose at_a = pose_of(pose_a, "pose_a"), at_b = pose_of(pose_b, "pose_b");
  const minkray::Twist of_a = twist_of(twist_a, "twist_a"), of_b = twist_of(twist_b, "twist_b");
  minkray::Impact found;
  unlocked([&] { found = minkray::time_of_impact(a, at_a, of_a, b, at_b, of_b, t_max); });
  py::dict result;
  result["t_lo"] = found.t_lo;
  result["t_hi"] = found.t_hi;
  result["distance"] = found.distance;
  result["point_a"] = py::array_t<double>(3, found.point_a);
  result["point_b"] = py::array_t<double>(3, found.point_b);
  result["normal"] = py::array_t<double>(3, found.normal);
  result["status"] = found.status;
  return result;
}

}  // namespace

void bind_shapes(py::module_& module) {
  py::class_<Shape>(module, "Shape",
                    "A convex shape, which never changes.\n\n"
                    "Made by functions such as `minkray.box`; see `minkray.custom` for your own.")
      .def_property_readonly("kind", &Shape::kind, "str : such as 'rounded'")
      .def("support", &support, py::arg("directions"),
           "Points of the shape furthest along directions.\n\n"
           "Parameters\n----------\ndirections : (N, 3) array\n    Of any length.\n\n"
           "Returns\n-------\n(N, 3) array")
      .def(
          "bounds",
          [](const Shape& shape) {
            Shape::Bounds bounds;
            unlocked([&] { bounds = shape.bounds(); });
            py::array_t<double> corners({py::ssize_t{2}, py::ssize_t{3}});
            const double* from = &bounds.lower.x;
            for (int i = 0; i < 6; ++i) corners.mutable_data()[i] = from[i];
            return corners;
          },
          "The lower and the upper corner of the tightest box along the axes, of shape (2, 3).")
      .def("json", &Shape::json<std::string>, "The shape as scene files have it.")
      .def("__repr__",
           [](const Shape& shape) {
             if (std::string(shape.kind()) == "custom")
               return std::string("<minkray.Shape custom>");
             try {
               std::string text = shape.json<std::string>();
               if (text.size() > 200) text = text.substr(0, 197) + "...";
               return "<minkray.Shape " + text + ">";
             } catch (const minkray::Error&) {  // of what is custom within
               return "<minkray.Shape " + std::string(shape.kind()) + ", custom within>";
             }
           })
      .def(py::pickle([](const Shape& shape) { return shape.json<std::string>(); },
                      [](const std::string& text) { return minkray::read_shape(text); }));
  module.def("make", &make);
  module.def("custom", &custom);
  module.def("read_shape", [](const std::string& json, const std::string& folder) {
    return minkray::read_shape(json, folder);
  });
  module.def("signed_distance", &signed_distance);
  module.def("time_of_impact", &time_of_impact);
}

}  // namespace minkray_python
