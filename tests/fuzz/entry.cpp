// SPDX-License-Identifier: MIT
// Entry point of libFuzzer: MINKRAY_FUZZ_CHECK is one of the targets.
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string complaint =
      minkray::fuzz::MINKRAY_FUZZ_CHECK({reinterpret_cast<const char*>(data), size});
  if (complaint.empty()) return 0;
  std::fprintf(stderr, "%s\n", complaint.c_str());
  std::abort();
}
