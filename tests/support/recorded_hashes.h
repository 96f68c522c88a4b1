// SPDX-License-Identifier: MIT
// Hashes that a file records, to be compared with: of pictures, of casts. `./run golden` records
// them anew.
#pragma once

#include <map>
#include <string>

namespace minkray::testing {

/// What rounds: the compiler that built the tests, and the C library whose sin and exp are called.
/// Another machine may make other last bits; there hashes are not compared.
std::string build_name();

/// Whether the C library's sines and powers have the last bits that they had when hashes were
/// recorded: it takes fused multiplications for them where the processor has any.
bool has_recorded_sines();

/// Whether this process is to record what it finds in place of comparing it.
bool is_recording();

/// A file below tests/golden. Its lines: `build NAME`, then `NAME HASH`; # begins a comment.
class RecordedHashes {
 public:
  /// `what` says what the hashes are of, for the file's first line.
  RecordedHashes(const std::string& file, std::string what);

  /// Whether they were recorded by a build like this one.
  bool is_comparable() const;
  const std::string& build() const { return build_; }

  /// Empty if there is none.
  std::string find(const std::string& name) const;

  /// Writes the file with these in place of all whose names begin with `beginning`.
  void replace(const std::string& beginning, const std::map<std::string, std::string>& hashes);

 private:
  std::string file_, what_, build_;
  std::map<std::string, std::string> hashes_;
};

}  // namespace minkray::testing
