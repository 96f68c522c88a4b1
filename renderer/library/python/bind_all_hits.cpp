// SPDX-License-Identifier: MIT
// Exits and all hits of rays, for scene_rays.py.
#include <algorithm>
#include <cmath>

#include "renderer/library/python/bind.h"
#include "renderer/library/python/columns.h"
#include "renderer/library/python/interruptible.h"
#include "renderer/library/python/ray_rows.h"

namespace minkray_python {
namespace {

using minkray::Scene;

py::dict exit(const Scene& scene, std::uint32_t object, const py::object& rays,
              const py::object& t_max, int threads) {
  const RayRows source(rays, t_max);
  const std::size_t count = source.size();
  const std::vector<minkray_ray> plain = source.plain();
  std::vector<minkray_hit> hits(count);
  Interruptible(threads).run([&](const minkray_options* options) {
    return minkray_scene_exit(scene.handle(), object, plain.data(), count, hits.data(), options);
  });
  const std::span<const minkray_hit> rows(hits);
  py::dict result;
  add_column(result, "t", rows, &minkray_hit::t);
  double* const distance = add_column<double>(result, "distance", static_cast<py::ssize_t>(count));
  for (std::size_t i = 0; i < count; ++i) {
    const double* const d = plain[i].direction;
    distance[i] = hits[i].t > 0 ? hits[i].t * std::hypot(d[0], d[1], d[2]) : hits[i].t;
  }
  add_column(result, "t_lo", rows, &minkray_hit::t_lo);
  add_column(result, "t_hi", rows, &minkray_hit::t_hi);
  add_column(result, "point", rows, &minkray_hit::point);
  add_column(result, "normal", rows, &minkray_hit::normal);
  add_column(result, "object", rows, &minkray_hit::object);
  add_column<std::uint8_t>(result, "status", rows, &minkray_hit::status);
  add_column(result, "supports", rows, &minkray_hit::supports);
  add_column(result, "part", rows, &minkray_hit::part);
  return result;
}

/// Arrays of all hits; made with the interpreter's lock, in the callback.
py::dict arrays_of(const minkray_all_hits& found) {
  const std::span rows(found.hits, found.offsets[found.rays]);
  py::dict result;
  add_column(result, "t", rows, &minkray_crossing::t);
  add_column(result, "t_lo", rows, &minkray_crossing::t_lo);
  add_column(result, "t_hi", rows, &minkray_crossing::t_hi);
  add_column(result, "point", rows, &minkray_crossing::point);
  add_column(result, "normal", rows, &minkray_crossing::normal);
  add_column(result, "object", rows, &minkray_crossing::object);
  add_column(result, "part", rows, &minkray_crossing::part);
  add_column<bool>(result, "leaves", rows, &minkray_crossing::leaves);
  const auto rays = static_cast<py::ssize_t>(found.rays);
  std::copy_n(found.offsets, found.rays + 1, add_column<std::int64_t>(result, "offsets", rays + 1));
  std::copy_n(found.status, found.rays, add_column<std::uint8_t>(result, "status", rays));
  return result;
}

py::dict all_hits(const Scene& scene, const py::object& rays, const py::object& t_max,
                  int threads) {
  const RayRows source(rays, t_max);
  py::dict result;
  Interruptible(threads).run([&](const minkray_options* options) {
    const auto take = [](void* user, const minkray_all_hits* found) {
      const Locked lock;
      if (!lock) return 1;
      try {
        *static_cast<py::dict*>(user) = arrays_of(*found);
        return 0;
      } catch (py::error_already_set& error) {
        error.restore();
      } catch (const std::exception& error) {
        PyErr_SetString(PyExc_MemoryError, error.what());
      }
      return 1;
    };
    return minkray_scene_all_hits(scene.handle(), source.arrays(), source.size(), take, &result,
                                  options);
  });
  return result;
}

}  // namespace

void bind_all_hits(py::module_& module) {
  module.def("scene_exit", &exit);
  module.def("scene_all_hits", &all_hits);
}

}  // namespace minkray_python
