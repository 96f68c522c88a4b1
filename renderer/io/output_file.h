// SPDX-License-Identifier: MIT
// Writes files completely or not at all: to a temporary name next to the target, then to the disk,
// then renamed.
#pragma once

#include <memory>
#include <span>
#include <string>

namespace minkray {

/// Throws CannotWrite where `write_file` would fail for want of a folder, a right or a file name,
/// so that nobody waits for an image that cannot be kept. Leaves nothing behind.
void check_writable(const std::string& path);

/// Writes the bytes; an existing file is replaced in one step and keeps its rights. Devices and
/// pipes are written to as they are. Throws CannotWrite; the existing file, if any, is then as it
/// was and nothing is left beside it, nor if a signal that may be noted (renderer/base/interrupt.h)
/// comes; SIGKILL or a crash of the machine may leave ".NAME.PROCESS.RANDOM.tmp" beside
/// it. Whoever writes the same file at the same time has a temporary file of his own.
void write_file(const std::string& path, std::span<const unsigned char> bytes);

/// Writes a regular file block by block: more than fits in memory. The file is there when `finish`
/// has returned; without it, nothing is left.
class OutputFile {
 public:
  explicit OutputFile(const std::string& path);
  ~OutputFile();

  void write(std::span<const unsigned char> bytes);
  void finish();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace minkray
