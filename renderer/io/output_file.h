// SPDX-License-Identifier: MIT
// Writes files completely or not at all: to a temporary name next to the target, then to the disk,
// then renamed.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace minkray {

/// Throws CannotWrite where `write_file` would fail for lack of a folder, a permission or a file
/// name, so that no time is spent on an image that cannot be written. Leaves nothing behind.
void check_writable(const std::string& path);

/// Writes the bytes; an existing file is replaced in one step and keeps its permissions. Devices
/// and pipes are written directly. Throws CannotWrite; the existing file, if any, is then
/// unchanged and no temporary file is left, nor after a signal that may be noted
/// (renderer/base/interrupt.h); SIGKILL or a crash of the machine may leave
/// ".NAME.PROCESS.RANDOM.tmp" in its folder. Concurrent writers of the same file have a temporary
/// file each.
void write_file(const std::string& path, std::span<const unsigned char> bytes);

inline void write_file(const std::string& path, std::string_view text) {
  write_file(path, std::span(reinterpret_cast<const unsigned char*>(text.data()), text.size()));
}

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
