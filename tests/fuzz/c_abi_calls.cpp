// SPDX-License-Identifier: MIT
#include "tests/fuzz/c_abi_calls.h"

#include <sstream>

#include "renderer/json/mistakes.h"

namespace minkray::fuzz {
namespace {

std::string wrong_text(const std::string& function, const std::string& text) {
  if (!text.starts_with(function + ": ") || text.size() <= function.size() + 2)
    return "an error that does not say of what: ";
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (printable(line, line.size() + 1) != line) return "an error that is not printable: ";
  return "";
}

}  // namespace

bool Promises::call(const char* function, int code, Sure sure, bool untouched, int may_fail_with) {
  const std::string name(function);
  if (code == MINKRAY_OK) {
    expect(sure != Sure::wrong, name + " takes what cannot be");
    return true;
  }
  const std::string text = minkray_last_error();
  if (const std::string bad = wrong_text(name, text); !bad.empty()) expect(false, bad + text);
  if (code == MINKRAY_BAD_SUPPORT && has_liar_) return false;
  expect(code == MINKRAY_WRONG_USE || code == may_fail_with,
         name + " answers " + std::to_string(code) + ": " + text);
  expect(sure != Sure::right, name + " refuses what can be: " + text);
  expect(untouched, name + " failed, and wrote a result: " + text);
  return false;
}

}  // namespace minkray::fuzz
