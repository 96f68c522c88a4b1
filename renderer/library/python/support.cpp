// SPDX-License-Identifier: MIT
#include "renderer/library/python/support.h"

#include <cstring>
#include <memory>
#include <string>
#include <utility>

#include "renderer/library/python/interpreter_lock.h"

namespace minkray_python {
namespace {

/// Largest number of directions per call: at this number a call of the interpreter costs nothing.
constexpr std::size_t gathered = 4096;

/// Number of support functions that this thread is running, one called by the other.
int& depth() {
  thread_local int running = 0;
  return running;
}

/// Exception that ends more than a query, such as SystemExit; null otherwise. The call that it ends
/// throws it again. Only threads that hold the interpreter's lock may use this.
py::error_already_set*& kept() {
  static py::error_already_set* error = nullptr;
  return error;
}

/// Such as "KeyError: 'x'".
std::string text_of(const py::error_already_set& error) {
  std::string text = error.type().attr("__name__").cast<std::string>();
  try {
    const auto detail = py::str(error.value()).cast<std::string>();
    if (!detail.empty()) text += ": " + detail;
  } catch (const py::error_already_set&) {  // of an exception that has no text
  }
  return text;
}

/// Calls the function; answers 1, with a reason, if its answer has another shape.
int answer_once(const py::function& support, std::size_t count, const double (*directions)[3],
                double (*points)[3]) {
  const auto rows = static_cast<py::ssize_t>(count);
  py::array_t<double> asked({rows, py::ssize_t{3}});
  std::memcpy(asked.mutable_data(), directions, count * sizeof *directions);
  const py::object answer = support(asked);
  const Doubles array = Doubles::ensure(answer);
  if (!array || array.ndim() != 2 || array.shape(0) != rows || array.shape(1) != 3) {
    PyErr_Clear();
    const std::string text =
        "must return an array of numbers of shape (" + std::to_string(count) + ", 3)";
    minkray_support_failed(text.c_str());
    return 1;
  }
  std::memcpy(points, array.data(), count * sizeof *points);
  return 0;
}

int ask(void* user, std::size_t count, const double (*directions)[3], double (*points)[3]) {
  const Locked lock;
  if (!lock) {
    minkray_support_failed("the interpreter is ending");
    return 1;
  }
  struct Depth {
    Depth() { ++depth(); }
    ~Depth() { --depth(); }
  } const running;
  const auto& support = *static_cast<const py::function*>(user);
  try {
    try {
      return answer_once(support, count, directions, points);
    } catch (py::error_already_set& error) {
      if (!error.matches(PyExc_KeyboardInterrupt)) throw;
    }
    // Ctrl-C is no fault of the function's: it answers again, and what called for it is stopped.
    const int failed = answer_once(support, count, directions, points);
    PyErr_SetInterrupt();
    return failed;
  } catch (py::error_already_set& error) {
    minkray_support_failed(text_of(error).c_str());
    if (!error.matches(PyExc_Exception)) {
      delete std::exchange(kept(), nullptr);
      kept() = new py::error_already_set(error);
    }
  } catch (const std::exception& error) {
    minkray_support_failed(error.what());
  }
  return 1;
}

}  // namespace

bool restore_kept() {
  const std::unique_ptr<py::error_already_set> error(std::exchange(kept(), nullptr));
  if (error) error->restore();
  return error != nullptr;
}

minkray::Shape custom(const py::function& support, const py::object& bounds) {
  minkray_support given = {};
  Doubles box;
  if (!bounds.is_none()) {
    box = Doubles::ensure(bounds);
    if (!box) PyErr_Clear();
    if (!box || box.ndim() != 2 || box.shape(0) != 2 || box.shape(1) != 3)
      throw py::value_error("bounds: must be two corners of a box, shape (2, 3)");
    given.lower = box.data();
    given.upper = box.data() + 3;
  }
  given.user = new py::function(support);
  given.function = ask;
  given.release = [](void* user) {
    const Locked lock;
    if (lock) delete static_cast<py::function*>(user);
  };
  minkray_shape shape;
  int code = MINKRAY_OK;
  {
    const Unlocked unlock;
    code = minkray_shape_custom_gathered(&given, gathered, &shape);
  }
  if (code != MINKRAY_OK) throw minkray::Error(code);
  return minkray::Shape(shape);
}

bool is_in_support() {
  return depth() > 0;
}

}  // namespace minkray_python
