// SPDX-License-Identifier: MIT
// Exits and all hits of rays, for scene_rays.py.
#include <cmath>

#include "renderer/library/python/bind.h"
#include "renderer/library/python/interruptible.h"
#include "renderer/library/python/ray_rows.h"

namespace minkray_python {
namespace {

using minkray::Scene;

/// Rows of `width` numbers, or numbers.
template <class Number>
py::array_t<Number> rows_for(std::size_t count, py::ssize_t width = 0) {
  const auto n = static_cast<py::ssize_t>(count);
  return width == 0 ? py::array_t<Number>(n) : py::array_t<Number>({n, width});
}

py::dict exit(const Scene& scene, std::uint32_t object, const py::object& rays,
              const py::object& t_max, int threads) {
  const RayRows source(rays, t_max);
  const std::size_t count = source.rows.count;
  const std::vector<minkray_ray> plain = source.plain();
  std::vector<minkray_hit> hits(count);
  Interruptible(threads).run([&](const minkray_options* options) {
    return minkray_scene_exit(scene.handle(), object, plain.data(), count, hits.data(), options);
  });
  auto t = rows_for<double>(count), t_lo = rows_for<double>(count), t_hi = rows_for<double>(count),
       distance = rows_for<double>(count), point = rows_for<double>(count, 3),
       normal = rows_for<double>(count, 3);
  auto objects = rows_for<std::uint32_t>(count);
  auto status = rows_for<std::uint8_t>(count);
  auto supports = rows_for<std::int32_t>(count), part = rows_for<std::int32_t>(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto k = static_cast<py::ssize_t>(i);
    const double* const d = plain[i].direction;
    const minkray_hit& hit = hits[i];
    t.mutable_at(k) = hit.t;
    t_lo.mutable_at(k) = hit.t_lo;
    t_hi.mutable_at(k) = hit.t_hi;
    distance.mutable_at(k) = hit.t > 0 ? hit.t * std::hypot(d[0], d[1], d[2]) : hit.t;
    for (py::ssize_t axis = 0; axis < 3; ++axis) {
      point.mutable_at(k, axis) = hit.point[axis];
      normal.mutable_at(k, axis) = hit.normal[axis];
    }
    objects.mutable_at(k) = hit.object;
    status.mutable_at(k) = static_cast<std::uint8_t>(hit.status);
    supports.mutable_at(k) = hit.supports;
    part.mutable_at(k) = hit.part;
  }
  py::dict result;
  result["t"] = t;
  result["distance"] = distance;
  result["t_lo"] = t_lo;
  result["t_hi"] = t_hi;
  result["point"] = point;
  result["normal"] = normal;
  result["object"] = objects;
  result["status"] = status;
  result["supports"] = supports;
  result["part"] = part;
  return result;
}

/// Arrays of all hits; made with the interpreter's lock, in the callback.
py::dict arrays_of(const minkray_all_hits& found) {
  const std::size_t count = found.offsets[found.rays];
  auto t = rows_for<double>(count), t_lo = rows_for<double>(count), t_hi = rows_for<double>(count),
       point = rows_for<double>(count, 3), normal = rows_for<double>(count, 3);
  auto object = rows_for<std::uint32_t>(count);
  auto part = rows_for<std::int32_t>(count);
  auto leaves = rows_for<bool>(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto k = static_cast<py::ssize_t>(i);
    const minkray_crossing& hit = found.hits[i];
    t.mutable_at(k) = hit.t;
    t_lo.mutable_at(k) = hit.t_lo;
    t_hi.mutable_at(k) = hit.t_hi;
    for (py::ssize_t axis = 0; axis < 3; ++axis) {
      point.mutable_at(k, axis) = hit.point[axis];
      normal.mutable_at(k, axis) = hit.normal[axis];
    }
    object.mutable_at(k) = hit.object;
    part.mutable_at(k) = hit.part;
    leaves.mutable_at(k) = hit.leaves != 0;
  }
  auto offsets = rows_for<std::int64_t>(found.rays + 1);
  for (std::size_t i = 0; i <= found.rays; ++i)
    offsets.mutable_at(static_cast<py::ssize_t>(i)) = static_cast<std::int64_t>(found.offsets[i]);
  py::dict result;
  result["t"] = t;
  result["t_lo"] = t_lo;
  result["t_hi"] = t_hi;
  result["point"] = point;
  result["normal"] = normal;
  result["object"] = object;
  result["part"] = part;
  result["leaves"] = leaves;
  result["offsets"] = offsets;
  result["status"] = py::array_t<std::uint8_t>(static_cast<py::ssize_t>(found.rays), found.status);
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
    return minkray_scene_all_hits(scene.handle(), &source.arrays, source.rows.count, take, &result,
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
