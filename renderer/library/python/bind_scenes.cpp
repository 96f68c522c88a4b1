// SPDX-License-Identifier: MIT
// Scenes and rays, for __init__.py to build on.
#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <vector>

#include "renderer/library/python/bind.h"
#include "renderer/library/python/columns.h"
#include "renderer/library/python/interruptible.h"
#include "renderer/library/python/ray_rows.h"

namespace minkray_python {
namespace {

using minkray::Scene;

py::dict cast(const Scene& scene, const py::object& rays, const py::object& t_max, int threads,
              bool jac, bool jac_error) {
  const RayRows source(rays, t_max);
  const auto n = static_cast<py::ssize_t>(source.size());
  py::dict result;
  const minkray_hit_arrays hits = {sizeof hits,
                                   add_column<double>(result, "t", n),
                                   add_column<double>(result, "t_lo", n),
                                   add_column<double>(result, "t_hi", n),
                                   add_column<double>(result, "distance", n),
                                   add_column<double>(result, "point", n, 3),
                                   add_column<double>(result, "normal", n, 3),
                                   add_column<std::uint32_t>(result, "object", n),
                                   add_column<std::uint8_t>(result, "status", n),
                                   add_column<std::int32_t>(result, "supports", n),
                                   add_column<std::int32_t>(result, "part", n)};
  minkray_ray_derivatives derivatives = {};
  derivatives.size = sizeof derivatives;
  if (jac) {
    derivatives.jac_ray = add_column<double>(result, "jac_ray", n, 6);
    derivatives.jac_body = add_column<double>(result, "jac_body", n, 6);
    derivatives.is_ridge = reinterpret_cast<std::uint8_t*>(add_column<bool>(result, "is_ridge", n));
  }
  if (jac_error) {
    derivatives.jac_error_ray = add_column<double>(result, "jac_error_ray", n, 2);
    derivatives.jac_error_body = add_column<double>(result, "jac_error_body", n, 2);
  }
  Interruptible(threads).run([&](const minkray_options* options) {
    const int code =
        minkray_scene_cast_arrays(scene.handle(), source.arrays(), source.size(), &hits, options);
    if (code != MINKRAY_OK || (!jac && !jac_error)) return code;
    return minkray_scene_ray_derivatives(scene.handle(), source.arrays(), source.size(), &hits,
                                         &derivatives, options);
  });
  return result;
}

py::array_t<std::uint8_t> occluded(const Scene& scene, const py::object& rays,
                                   const py::object& t_max, int threads) {
  const RayRows source(rays, t_max);
  py::array_t<std::uint8_t> blocked(static_cast<py::ssize_t>(source.size()));
  std::uint8_t* first = blocked.mutable_data();
  Interruptible(threads).run([&](const minkray_options* options) {
    return minkray_scene_occluded(scene.handle(), source.arrays(), source.size(), first, options);
  });
  return blocked;
}

/// Casts and proves: answers are proven with all of their digits.
py::dict certify(const Scene& scene, const py::object& rays, const py::object& t_max, int threads) {
  const RayRows source(rays, t_max);
  const std::size_t count = source.size();
  const std::vector<minkray_ray> plain = source.plain();
  std::vector<minkray_hit> hits(count);
  std::vector<minkray_proof> proofs(count);
  Interruptible(threads).run([&](const minkray_options* options) {
    const int code = minkray_scene_cast(scene.handle(), plain.data(), count, hits.data(), options);
    if (code != MINKRAY_OK) return code;
    return minkray_scene_prove(scene.handle(), plain.data(), hits.data(), count, proofs.data(),
                               options);
  });
  const std::span<const minkray_proof> rows(proofs);
  py::list complaints;
  for (const minkray_proof& proof : rows) complaints.append(py::str(proof.complaint));
  py::dict result;
  add_column<bool>(result, "holds", rows, &minkray_proof::holds);
  add_column(result, "t_lo", rows, &minkray_proof::t_lo);
  add_column(result, "t_hi", rows, &minkray_proof::t_hi);
  add_column(result, "allowed", rows, &minkray_proof::allowed);
  add_column(result, "plane", rows, &minkray_proof::plane);
  add_column(result, "checked", rows, &minkray_proof::checked);
  result["complaint"] = complaints;
  return result;
}

Scene::Group add_file(Scene& scene, const std::string& file, const py::object& pose,
                      const std::string& geometry, const std::string& keyframe,
                      const std::vector<std::string>& package_dirs, bool skip_missing_meshes,
                      const std::string& meshes) {
  minkray::FileOptions options;
  const minkray::Pose map = pose_of(pose, "pose");
  if (!pose.is_none()) options.pose = &map;
  options.geometry = geometry;
  options.keyframe = keyframe;
  options.skip_missing_meshes = skip_missing_meshes;
  options.meshes = meshes;
  std::vector<const char*> folders;
  for (const std::string& folder : package_dirs) folders.push_back(folder.c_str());
  options.package_dirs = {folders.data(), folders.size()};
  const Unlocked unlock;
  return scene.add_file(file, options);
}

minkray::Text text_of(const std::optional<std::string>& name) {
  return name ? minkray::Text(*name) : minkray::Text();
}

}  // namespace

void bind_scenes(py::module_& module) {
  py::class_<Scene::Group>(module, "Group")
      .def_property_readonly("number", &Scene::Group::number)
      .def_property_readonly("first", &Scene::Group::first)
      .def_property_readonly("size", &Scene::Group::size)
      .def_property_readonly("joints",
                             [](const Scene::Group& group) {
                               std::vector<std::string> names;
                               for (std::uint32_t i = 0; i < group.joints(); ++i)
                                 names.emplace_back(group.joint(i));
                               return names;
                             })
      .def("value",
           [](const Scene::Group& group, std::uint32_t joint) {
             const std::size_t width = group.value(joint, {});
             py::array_t<double> values(static_cast<py::ssize_t>(width));
             group.value(joint, {values.mutable_data(), width});
             return values;
           })
      .def("set",
           [](Scene::Group& group, const std::string& joint, const Doubles& values) {
             group.set(joint, {values.data(), static_cast<std::size_t>(values.size())});
           })
      .def("set_pose", [](Scene::Group& group, const py::object& pose) {
        group.set_pose(pose_of(pose, "pose"));
      });
  py::class_<Scene>(module, "Scene")
      .def(py::init())
      .def("add",
           [](Scene& scene, const minkray::Shape& shape, const py::object& pose,
              const std::optional<std::string>& name) {
             return scene.add(shape, pose_of(pose, "pose"), text_of(name));
           })
      .def("add_half_space",
           [](Scene& scene, const std::array<double, 3>& normal, double offset,
              const std::optional<std::string>& name) {
             return scene.add_half_space({normal[0], normal[1], normal[2]}, offset, text_of(name));
           })
      .def("add_file", &add_file, py::keep_alive<0, 1>())
      .def("set_pose",
           [](Scene& scene, std::uint32_t object, const py::object& pose) {
             scene.set_pose(object, pose_of(pose, "pose"));
           })
      .def("pose",
           [](const Scene& scene, std::uint32_t object) {
             const minkray::Pose pose = scene.pose(object);
             py::array_t<double> matrix({py::ssize_t{4}, py::ssize_t{4}});
             for (py::ssize_t i = 0; i < 4; ++i)
               for (py::ssize_t j = 0; j < 4; ++j)
                 matrix.mutable_at(i, j) = i < 3 ? pose.rows[i][j] : j == 3;
             return matrix;
           })
      .def("name", &Scene::name)
      .def("__len__", &Scene::size)
      .def("remove", &Scene::remove)
      .def("commit", &Scene::commit, py::call_guard<Unlocked>())
      .def("cast", &cast)
      .def("occluded", &occluded)
      .def("certify", &certify);
}

}  // namespace minkray_python
