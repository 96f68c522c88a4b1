// SPDX-License-Identifier: MIT
// Reads files that the user named. Rejects files that are not regular, since a pipe or a terminal
// may never end, and the program would seem to hang.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

namespace minkray {

/// A file that is read in pieces. All functions throw std::runtime_error that describes the error,
/// without the file's name. Never waits for another process.
class RegularFile {
 public:
  explicit RegularFile(const std::filesystem::path& path);
  ~RegularFile();
  RegularFile(const RegularFile&) = delete;
  RegularFile& operator=(const RegularFile&) = delete;

  /// Size at the time of opening. Only a hint: files of /proc have size 0, and a file may grow
  /// while it is read.
  std::size_t size() const { return size_; }

  /// Fills the buffer, only partly at the end of the file. Returns the number of bytes read.
  std::size_t read(std::span<char> buffer);

 private:
  int descriptor_;
  std::size_t size_ = 0;
};

/// Returns the contents. Throws std::runtime_error with the cause, without the file's name, if the
/// file cannot be read, is not a regular file, or is larger than `most_bytes` (then nothing is
/// read). Never waits for another process.
std::string read_regular_file(const std::filesystem::path& path, std::size_t most_bytes);

/// Returns the ending in lower case, with its dot: ".obj".
std::string lower_ending(const std::filesystem::path& path);

}  // namespace minkray
