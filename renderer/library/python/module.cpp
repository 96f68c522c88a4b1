// SPDX-License-Identifier: MIT
// Extension module minkray._minkray, over the public C++ header alone. Users see __init__.py.
#include "renderer/library/python/bind.h"
#include "renderer/library/python/interpreter_lock.h"
#include "renderer/library/python/support.h"

PYBIND11_MODULE(_minkray, module) {
  namespace py = pybind11;
  using namespace minkray_python;
  module.attr("version") = minkray::version();
  static py::exception<minkray::Error> error(module, "Error", PyExc_ValueError);
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const minkray::Error& what) {
      if (!restore_kept()) error(what.what());
    }
  });
  watch_end_of_interpreter();
  module.def("is_in_support", &is_in_support);
  bind_shapes(module);
  bind_pairs(module);
  bind_scenes(module);
  bind_scene_pairs(module);
  bind_all_hits(module);
  bind_pictures(module);
}
