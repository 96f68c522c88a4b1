// SPDX-License-Identifier: MIT
// Reading whole files that somebody named. Only regular files: a pipe or a terminal may never end,
// and waiting for one looks like hanging.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

namespace minkray {

/// A file that is read piece by piece. All throw std::runtime_error with the mistake in the file,
/// without its name. Never waits for another process.
class RegularFile {
 public:
  explicit RegularFile(const std::filesystem::path& path);
  ~RegularFile();
  RegularFile(const RegularFile&) = delete;
  RegularFile& operator=(const RegularFile&) = delete;

  /// Size at the time of opening; a hint only: files of /proc have 0, and a file may grow while it
  /// is read.
  std::size_t size() const { return size_; }

  /// Fills the buffer, less of it only at the end of the file; answers how much.
  std::size_t read(std::span<char> buffer);

 private:
  int descriptor_;
  std::size_t size_ = 0;
};

/// The contents. Throws std::runtime_error with the cause, without the file's name, if the file
/// cannot be read, is no regular file, or holds more than `most_bytes` (nothing of a larger file
/// is read). Never waits for another process.
std::string read_regular_file(const std::filesystem::path& path, std::size_t most_bytes);

}  // namespace minkray
