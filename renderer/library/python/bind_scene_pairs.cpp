// SPDX-License-Identifier: MIT
// Pairs of a scene, for scene_pairs.py: rows of structs, which it takes apart.
#include <cstring>
#include <limits>

#include "renderer/library/python/bind.h"
#include "renderer/library/python/interruptible.h"
#include "renderer/library/python/side.h"

namespace minkray_python {
namespace {

using minkray::Scene;
using Bytes = py::array_t<std::uint8_t, py::array::c_style>;

minkray_near_options options_of(double within, double tolerance, bool jac, std::uint32_t mask) {
  // In C a zero is the default. Nothing lies between it and the next number.
  if (within == 0) within = std::numeric_limits<double>::denorm_min();
  return {sizeof(minkray_near_options), within, tolerance, jac ? 1 : 0, mask, nullptr, nullptr};
}

/// None, or an array for bounds of the derivatives' errors.
double* room_for_errors(const py::object& errors) {
  return errors.is_none() ? nullptr : errors.cast<Doubles>().mutable_data();
}

template <class Row>
Bytes rows(std::size_t count) {
  return Bytes(static_cast<py::ssize_t>(count * sizeof(Row)));
}
template <class Row>
Row* first_of(Bytes& bytes) {
  return reinterpret_cast<Row*>(bytes.mutable_data());
}

/// The pairs, and the bounds of the derivatives' errors, four for each, if `jac_error`.
py::tuple distances(const Scene& scene, const py::object& pairs, double within, double tolerance,
                    bool jac, bool jac_error, int threads, const py::object& progress) {
  using Numbers = py::array_t<std::uint32_t, py::array::c_style>;
  Numbers given;
  if (!pairs.is_none()) given = pairs.cast<Numbers>();
  const std::uint32_t none[2] = {0, 0};
  const std::uint32_t* const first = pairs.is_none()    ? nullptr
                                     : given.size() > 0 ? given.data()
                                                        : none;
  const auto count = static_cast<std::size_t>(given.size() / 2);
  struct {
    std::vector<minkray_scene_pair> found;
    std::vector<double> errors;
    const double* their_errors = nullptr;
  } taken;
  minkray_near_options options = options_of(within, tolerance, jac, 0);
  if (jac_error) options.jac_errors = &taken.their_errors;
  Interruptible(threads, progress).run([&](const minkray_options* how) {
    const auto take = [](void* user, const minkray_scene_pair* all, std::size_t size) {
      auto& to = *static_cast<decltype(taken)*>(user);
      to.found.assign(all, all + size);
      if (to.their_errors) to.errors.assign(to.their_errors, to.their_errors + 4 * size);
      return 0;
    };
    return minkray_scene_distances(scene.handle(), first, count, &options, take, &taken, how);
  });
  Bytes bytes = rows<minkray_scene_pair>(taken.found.size());
  if (!taken.found.empty())
    std::memcpy(bytes.mutable_data(), taken.found.data(),
                taken.found.size() * sizeof taken.found[0]);
  return py::make_tuple(
      bytes, Doubles(static_cast<py::ssize_t>(taken.errors.size()), taken.errors.data()));
}

Bytes nearest(const Scene& scene, const Doubles& points, std::size_t k, double within, bool jac,
              const py::object& errors, std::uint32_t mask, int threads,
              const py::object& progress) {
  const auto count = static_cast<std::size_t>(points.shape(0));
  minkray_near_options options = options_of(within, 0, jac, mask);
  options.jac_error = room_for_errors(errors);
  Bytes bytes = rows<minkray_scene_pair>(count * k);
  auto* const to = first_of<minkray_scene_pair>(bytes);
  const auto* const from = reinterpret_cast<const double(*)[3]>(points.data());
  Interruptible(threads, progress).run([&](const minkray_options* how) {
    return minkray_scene_nearest(scene.handle(), from, count, k, &options, to, how);
  });
  return bytes;
}

Bytes distance_to(const Scene& scene, const Side& shapes, std::size_t count, double within,
                  bool jac, const py::object& errors, std::uint32_t mask, int threads,
                  const py::object& progress) {
  minkray_near_options options = options_of(within, 0, jac, mask);
  options.jac_error = room_for_errors(errors);
  Bytes bytes = rows<minkray_scene_pair>(count);
  auto* const to = first_of<minkray_scene_pair>(bytes);
  Interruptible(threads, progress).run([&](const minkray_options* how) {
    return minkray_scene_distance_to(scene.handle(), shapes.plain(), count, &options, to, how);
  });
  return bytes;
}

Bytes time_of_impact(const Scene& scene, const Side& shapes, std::size_t count,
                     const Doubles& t_max, bool jac, const py::object& errors, std::uint32_t mask,
                     int threads, const py::object& progress) {
  minkray_near_options options = options_of(0, 0, jac, mask);
  options.jac_error = room_for_errors(errors);
  Bytes bytes = rows<minkray_scene_impact>(count);
  auto* const to = first_of<minkray_scene_impact>(bytes);
  const double* const ends = t_max.data();
  const auto end_count = static_cast<std::size_t>(t_max.size());
  Interruptible(threads, progress).run([&](const minkray_options* how) {
    return minkray_scene_time_of_impact(scene.handle(), shapes.plain(), count, ends, end_count,
                                        &options, to, how);
  });
  return bytes;
}

Bytes manifold(const Scene& scene, std::uint32_t a, std::uint32_t b) {
  Bytes bytes = rows<minkray_manifold>(1);
  auto* const to = first_of<minkray_manifold>(bytes);
  {
    const Unlocked unlock;
    check(minkray_scene_manifold(scene.handle(), a, b, to));
  }
  return bytes;
}

}  // namespace

void bind_scene_pairs(py::module_& module) {
  module.def("scene_set_masks", [](const Scene& scene, std::uint32_t object, std::uint32_t category,
                                   std::uint32_t mask) {
    check(minkray_scene_set_masks(scene.handle(), object, category, mask));
  });
  module.def("scene_allow", [](const Scene& scene, std::uint32_t a, std::uint32_t b, bool allowed) {
    check(minkray_scene_allow(scene.handle(), a, b, allowed ? 1 : 0));
  });
  module.def("scene_allow_from_srdf",
             [](const Scene& scene, const Scene::Group& robot, const std::string& file) {
               check(minkray_scene_allow_from_srdf(scene.handle(), robot.number(), file.c_str()));
             });
  module.def("scene_distances", &distances);
  module.def("scene_nearest", &nearest);
  module.def("scene_distance_to", &distance_to);
  module.def("scene_time_of_impact", &time_of_impact);
  module.def("scene_manifold", &manifold);
}

}  // namespace minkray_python
