// SPDX-License-Identifier: MIT
#include "core/files/regular_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <system_error>

#include "core/files/text.h"

namespace minkray {
namespace {

[[noreturn]] void fail(int error) {
  throw std::runtime_error("cannot be read: " + std::generic_category().message(error));
}

const char* kind_of(mode_t mode) {
  if (S_ISDIR(mode)) return "a directory";
  if (S_ISFIFO(mode)) return "a pipe";
  if (S_ISSOCK(mode)) return "a socket";
  return "a device";
}

}  // namespace

RegularFile::RegularFile(const std::filesystem::path& path)
    // Without O_NONBLOCK, opening a pipe that has no writer would wait.
    : descriptor_(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC)) {
  if (descriptor_ < 0) fail(errno);
  struct stat status = {};
  const bool known = ::fstat(descriptor_, &status) == 0;
  const int error = errno;
  if (known && S_ISREG(status.st_mode)) {
    size_ = static_cast<std::size_t>(status.st_size);
    return;
  }
  ::close(descriptor_);
  if (!known) fail(error);
  throw std::runtime_error(std::string("must be a file (got ") + kind_of(status.st_mode) + ")");
}

RegularFile::~RegularFile() {
  ::close(descriptor_);
}

std::size_t RegularFile::read(std::span<char> buffer) {
  std::size_t filled = 0;
  while (filled < buffer.size()) {
    const ssize_t count = ::read(descriptor_, buffer.data() + filled, buffer.size() - filled);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail(errno);
    if (count == 0) break;
    filled += static_cast<std::size_t>(count);
  }
  return filled;
}

std::string read_regular_file(const std::filesystem::path& path, std::size_t most_bytes) {
  RegularFile file(path);
  const auto too_large = [&](std::size_t bytes) {
    return std::runtime_error("must not hold more than " + std::to_string(most_bytes) +
                              " bytes (got " + std::to_string(bytes) + ")");
  };
  if (file.size() > most_bytes) throw too_large(file.size());
  std::string text(file.size() + 1, '\0');
  std::size_t filled = 0;
  for (;;) {
    filled += file.read(std::span(text).subspan(filled));
    if (filled > most_bytes) throw too_large(filled);
    if (filled < text.size()) break;
    text.resize(2 * text.size());
  }
  text.resize(filled);
  return text;
}

std::string lower_ending(const std::filesystem::path& path) {
  return lower_case(path.extension().string());
}

}  // namespace minkray
