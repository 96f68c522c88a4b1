// SPDX-License-Identifier: MIT
// Queries on many pairs of shapes, for many_pairs.py, which checks arrays and allocates results.
#include "renderer/library/python/bind.h"
#include "renderer/library/python/interruptible.h"
#include "renderer/library/python/side.h"

namespace minkray_python {
namespace {

/// The numbers of an array to be filled; null if it is not there.
template <class Number>
Number* room(const py::dict& fields, const char* name) {
  if (!fields.contains(name)) return nullptr;
  auto array = fields[name].cast<py::array_t<Number, py::array::c_style>>();
  if (array.ptr() != py::object(fields[name]).ptr())
    throw py::value_error(std::string("out.") + name + ": must be a contiguous array of its type");
  return array.mutable_data();
}

minkray_pair_memory* memories_of(const py::object& memory) {
  if (memory.is_none()) return nullptr;
  auto array = memory.cast<Doubles>();
  return reinterpret_cast<minkray_pair_memory*>(array.mutable_data());
}

template <class Arrays>
Arrays empty_arrays() {
  Arrays arrays = {};
  arrays.size = sizeof arrays;
  return arrays;
}

template <class Arrays>
void add_bounds(const py::dict& out, Arrays& to) {
  to.value = room<double>(out, "value");
  to.lower = room<double>(out, "lower");
  to.upper = room<double>(out, "upper");
}

/// Adds what distances and impacts both have.
template <class Arrays>
void add_points_and_derivatives(const py::dict& out, Arrays& to) {
  to.points_a = room<double>(out, "point_a");
  to.points_b = room<double>(out, "point_b");
  to.normals = room<double>(out, "normal");
  to.jac_a = room<double>(out, "jac_a");
  to.jac_b = room<double>(out, "jac_b");
  to.is_ridge = reinterpret_cast<std::uint8_t*>(room<bool>(out, "is_ridge"));
  to.jac_error_a = room<double>(out, "jac_error_a");
  to.jac_error_b = room<double>(out, "jac_error_b");
  to.status = room<std::uint8_t>(out, "status");
}

void signed_distances(const Side& a, const Side& b, std::size_t count, double tolerance,
                      const py::object& memory, const py::dict& out, int threads,
                      const py::object& progress) {
  auto to = empty_arrays<minkray_distance_arrays>();
  add_bounds(out, to);
  add_points_and_derivatives(out, to);
  to.supports = room<std::int32_t>(out, "supports");
  const minkray_distance_options options = {sizeof options, tolerance, 0, 0, 0};
  minkray_pair_memory* const memories = memories_of(memory);
  Interruptible(threads, progress).run([&](const minkray_options* how) {
    return minkray_signed_distances(a.plain(), b.plain(), count, &options, memories, &to, how);
  });
}

void times_of_impact(const Side& a, const Side& b, std::size_t count, const Doubles& t_max,
                     const py::object& memory, const py::dict& out, int threads,
                     const py::object& progress) {
  auto to = empty_arrays<minkray_impact_arrays>();
  to.t_lo = room<double>(out, "t_lo");
  to.t_hi = room<double>(out, "t_hi");
  to.distance = room<double>(out, "distance");
  add_points_and_derivatives(out, to);
  minkray_pair_memory* const memories = memories_of(memory);
  const double* const ends = t_max.data();
  const auto end_count = static_cast<std::size_t>(t_max.size());
  Interruptible(threads, progress).run([&](const minkray_options* how) {
    return minkray_times_of_impact(a.plain(), b.plain(), count, ends, end_count, memories, &to,
                                   how);
  });
}

void manifolds(const Side& a, const Side& b, std::size_t count, double tolerance,
               const py::object& memory, const py::dict& out, int threads,
               const py::object& progress) {
  auto to = empty_arrays<minkray_manifold_arrays>();
  to.normals = room<double>(out, "normal");
  to.points = room<double>(out, "points");
  to.points_a = room<double>(out, "points_a");
  to.points_b = room<double>(out, "points_b");
  to.gaps = room<double>(out, "gaps");
  add_bounds(out, to);
  to.counts = room<std::int32_t>(out, "count");
  to.status = room<std::uint8_t>(out, "status");
  const minkray_distance_options options = {sizeof options, tolerance, 0, 0, 0};
  minkray_pair_memory* const memories = memories_of(memory);
  Interruptible(threads, progress).run([&](const minkray_options* how) {
    return minkray_manifolds(a.plain(), b.plain(), count, &options, memories, &to, how);
  });
}

}  // namespace

void bind_pairs(py::module_& module) {
  py::class_<Side>(module, "Side")
      .def(py::init<const py::list&, const py::object&, int, const py::object&>());
  module.def("signed_distances", &signed_distances);
  module.def("times_of_impact", &times_of_impact);
  module.def("manifolds", &manifolds);
}

}  // namespace minkray_python
