// SPDX-License-Identifier: MIT
#include "tests/support/recorded_hashes.h"

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "tests/support/program.h"
#include "tests/support/source_files.h"

namespace minkray::testing {

std::string build_name() {
#if defined(__clang__)
  const std::string compiler = "clang-" + std::to_string(__clang_major__);
#else
  const std::string compiler = "gcc-" + std::to_string(__GNUC__);
#endif
  return compiler + " glibc-" + std::to_string(__GLIBC__) + "." + std::to_string(__GLIBC_MINOR__);
}

bool has_recorded_sines() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("fma") && __builtin_cpu_supports("avx2");
#else
  return false;
#endif
}

bool is_recording() {
  return std::getenv("MINKRAY_RECORD_GOLDEN") != nullptr;
}

RecordedHashes::RecordedHashes(const std::string& file, std::string what)
    : file_((source_folder() / "tests/golden" / file).string()), what_(std::move(what)) {
  std::ifstream in(file_);
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line.front() == '#') continue;
    const std::size_t space = line.rfind(' ');
    if (line.starts_with("build "))
      build_ = line.substr(6);
    else
      hashes_[line.substr(0, space)] = line.substr(space + 1);
  }
}

bool RecordedHashes::is_comparable() const {
  return build_ == build_name();
}

std::string RecordedHashes::find(const std::string& name) const {
  const auto found = hashes_.find(name);
  return found == hashes_.end() ? std::string() : found->second;
}

void RecordedHashes::replace(const std::string& beginning,
                             const std::map<std::string, std::string>& hashes) {
  std::erase_if(hashes_, [&](const auto& entry) { return entry.first.starts_with(beginning); });
  hashes_.insert(hashes.begin(), hashes.end());
  build_ = build_name();
  std::ofstream out(file_);
  out << "# What " << what_
      << "; made anew by `./run golden`. Change this file\n"
         "# only with a change that is meant to change it, and say so there.\nbuild "
      << build_ << '\n';
  for (const auto& [name, hash] : hashes_) out << name << ' ' << hash << '\n';
}

}  // namespace minkray::testing
