// SPDX-License-Identifier: MIT
// The extension module minkray._minkray, over the public C++ header alone. What users see is
// __init__.py.
#include "renderer/library/python/bind.h"
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
      std::string text = what.what();
      if (what.code() == MINKRAY_BAD_SUPPORT)
        if (const std::string raised = raised_by_support(); !raised.empty()) text += ": " + raised;
      error(text.c_str());
    }
  });
  bind_shapes(module);
  bind_scenes(module);
  bind_pictures(module);
}
