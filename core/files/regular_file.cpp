// SPDX-License-Identifier: MIT
#include "core/files/regular_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <system_error>

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

struct Descriptor {
  int number;
  ~Descriptor() { ::close(number); }
};

}  // namespace

std::string read_regular_file(const std::filesystem::path& path, std::size_t most_bytes) {
  // A pipe without a writer would otherwise already wait here.
  const int number = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
  if (number < 0) fail(errno);
  const Descriptor file{number};
  struct stat status = {};
  if (::fstat(number, &status) != 0) fail(errno);
  if (!S_ISREG(status.st_mode))
    throw std::runtime_error(std::string("must be a file (got ") + kind_of(status.st_mode) + ")");

  const auto too_large = [&](std::size_t bytes) {
    return std::runtime_error("must not hold more than " + std::to_string(most_bytes) +
                              " bytes (got " + std::to_string(bytes) + ")");
  };
  const auto size = static_cast<std::size_t>(status.st_size);
  if (size > most_bytes) throw too_large(size);
  // The size is a hint only: files of /proc say 0, and a file may grow while it is read.
  std::string text(size + 1, '\0');
  std::size_t filled = 0;
  for (;;) {
    const ssize_t count = ::read(number, text.data() + filled, text.size() - filled);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail(errno);
    if (count == 0) break;
    filled += static_cast<std::size_t>(count);
    if (filled > most_bytes) throw too_large(filled);
    if (filled == text.size()) text.resize(2 * text.size());
  }
  text.resize(filled);
  return text;
}

}  // namespace minkray
