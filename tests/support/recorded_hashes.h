// SPDX-License-Identifier: MIT
// Recorded hashes in a file, for comparison: of pictures, of casts. `./run golden` records them.
#pragma once

#include <map>
#include <string>

namespace minkray::testing {

/// Name of the build that determines rounding: the compiler that built the tests, and the C
/// library whose sin and exp are called. Another machine may make other last bits; there hashes
/// are not compared.
std::string build_name();

/// True if the C library's sines and powers have the last bits of the recording: the library uses
/// fused multiplications for them where the processor has any.
bool has_recorded_sines();

/// True if this process is to record its results instead of comparing them.
bool is_recording();

/// A file below tests/golden. Its lines: `build NAME`, then `NAME HASH`; # begins a comment.
class RecordedHashes {
 public:
  /// `what` describes the hashes, for the file's first line.
  RecordedHashes(const std::string& file, std::string what);

  /// True if they were recorded by a build like this one.
  bool is_comparable() const;
  const std::string& build() const { return build_; }

  /// Empty if there is none.
  std::string find(const std::string& name) const;

  /// Writes the file with these instead of all whose names begin with `beginning`.
  void replace(const std::string& beginning, const std::map<std::string, std::string>& hashes);

 private:
  std::string file_, what_, build_;
  std::map<std::string, std::string> hashes_;
};

}  // namespace minkray::testing
