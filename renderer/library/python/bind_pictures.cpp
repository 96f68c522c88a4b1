// SPDX-License-Identifier: MIT
// Pictures, sensors and robots' paths, for __init__.py to build on.
#include <pybind11/stl.h>

#include <algorithm>
#include <vector>

#include "renderer/library/python/bind.h"
#include "renderer/library/python/columns.h"
#include "renderer/library/python/interruptible.h"

namespace minkray_python {
namespace {

using minkray::Scene;

/// The channels by their names, each of the shape (height, width) or (height, width, numbers).
py::dict render(const Scene& scene, const std::string& view, std::uint32_t width,
                std::uint32_t height, std::uint32_t samples, std::uint64_t seed,
                const std::string& integrator, std::int32_t bounces, std::int32_t max_depth,
                bool denoise, const std::vector<std::string>& names, int threads) {
  const minkray_picture_options options = {sizeof options, view.empty() ? nullptr : view.c_str(),
                                           width,          height,
                                           samples,        bounces,
                                           max_depth,      denoise ? 1 : 0,
                                           seed,           integrator.c_str()};
  check(minkray_scene_picture_size(scene.handle(), &options, &width, &height));
  std::vector<py::array_t<double>> arrays;
  std::vector<minkray_channel> channels;
  std::vector<bool> are_integers;
  for (const std::string& name : names) {
    std::uint32_t numbers = 0;
    std::int32_t is_integer = 0;
    check(minkray_picture_channel(name.c_str(), &numbers, &is_integer));
    std::vector<py::ssize_t> shape = {static_cast<py::ssize_t>(height),
                                      static_cast<py::ssize_t>(width)};
    if (numbers > 1) shape.push_back(static_cast<py::ssize_t>(numbers));
    py::array_t<double>& array = arrays.emplace_back(shape);
    channels.push_back(
        {name.c_str(), array.mutable_data(), static_cast<std::size_t>(array.size())});
    are_integers.push_back(is_integer != 0);
  }
  Interruptible(threads).run([&](const minkray_options* how) {
    return minkray_scene_render(scene.handle(), &options, channels.data(), channels.size(), how);
  });
  py::dict result;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (are_integers[i])
      result[names[i].c_str()] = py::array_t<std::uint32_t>(arrays[i]);
    else
      result[names[i].c_str()] = py::array_t<float>(arrays[i]);
  }
  return result;
}

py::dict clearance(const Scene& scene, const Scene::Group& robot, const Doubles& path,
                   double tolerance, bool only_obstacles, bool jac, bool jac_error, int threads) {
  if (path.ndim() != 2) throw py::value_error("path: must have shape (rows, joint values)");
  const auto rows = static_cast<std::size_t>(path.shape(0));
  std::vector<minkray_clearance> steps(std::max<std::size_t>(rows, 2) - 1);
  minkray_clearance_options options = {sizeof options, tolerance, only_obstacles ? 1 : 0, threads,
                                       nullptr};
  const auto count = static_cast<py::ssize_t>(steps.size());
  const auto numbers = static_cast<std::size_t>(path.shape(1));
  const bool has_derivatives = jac || jac_error;
  py::array_t<double> by_joints({has_derivatives ? count : 0, path.shape(1)});
  py::array_t<double> errors({jac_error ? count : 0, path.shape(1)});
  py::array_t<bool> is_ridge(has_derivatives ? count : 0);
  if (jac_error) options.jac_error = errors.mutable_data();
  double* const to_jac = by_joints.mutable_data();
  auto* const to_ridge = reinterpret_cast<std::uint8_t*>(is_ridge.mutable_data());
  int code = MINKRAY_OK;
  {
    const Unlocked unlock;
    code =
        has_derivatives
            ? minkray_scene_clearance_derivatives(scene.handle(), robot.number(), path.data(), rows,
                                                  numbers, &options, steps.data(), to_jac, to_ridge)
            : minkray_scene_clearance(scene.handle(), robot.number(), path.data(), rows, numbers,
                                      &options, steps.data(), nullptr);
  }
  check(code);
  py::dict result;
  const std::span<const minkray_clearance> found(steps);
  add_column(result, "lower", found, &minkray_clearance::lower);
  add_column(result, "upper", found, &minkray_clearance::upper);
  add_column(result, "row", found, &minkray_clearance::row);
  add_column(result, "object_a", found, &minkray_clearance::object_a);
  add_column(result, "object_b", found, &minkray_clearance::object_b);
  add_column(result, "point_a", found, &minkray_clearance::point_a);
  add_column(result, "point_b", found, &minkray_clearance::point_b);
  add_column(result, "normal", found, &minkray_clearance::normal);
  if (jac) {
    result["jac"] = by_joints;
    result["is_ridge"] = is_ridge;
  }
  if (jac_error) result["jac_error"] = errors;
  return result;
}

py::dict verify(const Scene& scene, const Scene::Group& robot, const Doubles& path,
                const Doubles& rates, const Doubles& accelerations, const Doubles& times,
                double margin, double tolerance, std::size_t budget, bool only_obstacles,
                const std::string& proof, int threads) {
  if (path.ndim() != 2) throw py::value_error("path: must have shape (rows, joint values)");
  const bool has_rates = rates.size() > 0;
  if (has_rates && rates.size() != path.size())
    throw py::value_error("rates: must have the shape of the path");
  const bool has_accelerations = accelerations.size() > 0;
  if (has_accelerations && accelerations.size() != path.size())
    throw py::value_error("accelerations: must have the shape of the path");
  if (times.size() > 0 && times.size() != path.shape(0))
    throw py::value_error("times: must be one per row");
  const minkray_verdict_options options = {sizeof options,
                                           tolerance,
                                           margin,
                                           budget,
                                           only_obstacles ? 1 : 0,
                                           threads,
                                           has_accelerations ? accelerations.data() : nullptr,
                                           proof.empty() ? nullptr : proof.c_str(),
                                           times.size() > 0 ? times.data() : nullptr};
  minkray_verdict found = {};
  int code = MINKRAY_OK;
  {
    const Unlocked unlock;
    code = minkray_scene_verify(scene.handle(), robot.number(), path.data(),
                                has_rates ? rates.data() : nullptr,
                                static_cast<std::size_t>(path.shape(0)),
                                static_cast<std::size_t>(path.shape(1)), &options, &found);
  }
  check(code);
  py::dict result;
  result["status"] = found.status;
  result["lower"] = found.lower;
  result["upper"] = found.upper;
  result["row"] = found.row;
  result["begin"] = found.begin;
  result["end"] = found.end;
  result["object_a"] = found.object_a;
  result["object_b"] = found.object_b;
  py::array_t<double> point(3);
  std::copy_n(found.point, 3, point.mutable_data());
  result["point"] = point;
  return result;
}

py::array_t<double> rows_of(const std::vector<minkray::Ray>& rays) {
  py::array_t<double> array({static_cast<py::ssize_t>(rays.size()), py::ssize_t{6}});
  for (std::size_t i = 0; i < rays.size(); ++i) {
    double* row = array.mutable_data(static_cast<py::ssize_t>(i), 0);
    std::copy_n(&rays[i].origin.x, 3, row);
    std::copy_n(&rays[i].direction.x, 3, row + 3);
  }
  return array;
}

py::array_t<double> lidar(const std::string& pattern, const py::object& pose) {
  const minkray::Pose map = pose_of(pose, "pose");
  std::vector<minkray::Ray> rays(minkray::lidar(pattern, map));
  minkray::lidar(pattern, map, rays);
  return rows_of(rays);
}

py::array_t<double> camera(const std::string& text, const py::object& pose) {
  const minkray::Pose map = pose_of(pose, "pose");
  std::vector<minkray::Ray> rays(minkray::camera(text, map));
  minkray::camera(text, map, rays);
  return rows_of(rays);
}

}  // namespace

void bind_pictures(py::module_& module) {
  module.def("render", &render);
  module.def("clearance", &clearance);
  module.def("verify", &verify);
  module.def("lidar", &lidar);
  module.def("camera", &camera);
}

}  // namespace minkray_python
