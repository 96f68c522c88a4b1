// SPDX-License-Identifier: MIT
#include "renderer/io/output_file.h"

#include <fcntl.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <utility>
#include <vector>

#include "renderer/base/errors.h"
#include "renderer/base/interrupt.h"

namespace minkray {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& path, int error) {
  throw CannotWrite("cannot write " + path + ": " + std::strerror(error));
}

/// ".NAME.PROCESS.RANDOM.tmp": processes in two containers, or on two machines that share the
/// folder, may have one number.
std::string temporary_name(const std::string& path, const fs::path& target) {
  std::uint32_t random = 0;
  if (::getrandom(&random, sizeof random, 0) != sizeof random) fail(path, errno);
  std::array<char, 64> end;
  std::snprintf(end.data(), end.size(), ".%ld.%08x.tmp", static_cast<long>(::getpid()), random);
  return "." + target.filename().string() + end.data();
}

/// A file descriptor that is closed, and a file that is removed unless it was renamed.
class TemporaryFile {
 public:
  TemporaryFile(const std::string& path, const fs::path& target) : path_(path) {
    // Existing files belong to others, and are kept.
    fs::path temporary;
    do {
      temporary = target.parent_path() / temporary_name(path, target);
      descriptor_ = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    } while (descriptor_ < 0 && errno == EEXIST);
    if (descriptor_ < 0) fail(path_, errno);
    temporary_ = temporary;
  }
  ~TemporaryFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!temporary_.empty()) ::unlink(temporary_.c_str());
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  int descriptor() const { return descriptor_; }

  void rename_to(const fs::path& target) {
    if (::fsync(descriptor_) != 0) fail(path_, errno);
    if (::close(std::exchange(descriptor_, -1)) != 0) fail(path_, errno);
    if (::rename(temporary_.c_str(), target.c_str()) != 0) fail(path_, errno);
    temporary_.clear();
    // The folder's entry as well; not all file systems can, and the data is safe by now.
    const fs::path folder = target.parent_path().empty() ? "." : target.parent_path();
    if (const int handle = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
        handle >= 0) {
      ::fsync(handle);
      ::close(handle);
    }
  }

 private:
  InterruptGuard until_cleaned_up_;
  std::string path_;
  fs::path temporary_;
  int descriptor_ = -1;
};

void write_all(int descriptor, std::span<const unsigned char> bytes, const std::string& path) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    // A pipe's reader may never read on.
    if (written < 0 && (errno != EINTR || InterruptGuard::interrupted())) fail(path, errno);
    if (written > 0) bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

/// Target of a path.
struct Target {
  fs::path path;  ///< behind all symbolic links
  bool exists = false;
  bool is_regular = true;
  mode_t mode = 0;
};

Target find_target(const std::string& path) {
  if (path.empty() || path.back() == '/')
    throw CannotWrite("cannot write " + path + ": no file name");
  std::error_code error;
  Target target;
  target.path = fs::weakly_canonical(path, error);
  if (error) fail(path, error.value());
  struct stat status = {};
  if (::stat(target.path.c_str(), &status) != 0) return target;
  if (S_ISDIR(status.st_mode)) fail(path, EISDIR);
  if (::access(target.path.c_str(), W_OK) != 0) fail(path, errno);
  target.exists = true;
  target.is_regular = S_ISREG(status.st_mode);
  target.mode = status.st_mode & 07777;
  return target;
}

}  // namespace

void check_writable(const std::string& path) {
  const Target target = find_target(path);
  if (target.is_regular) TemporaryFile(path, target.path);
}

void write_file(const std::string& path, std::span<const unsigned char> bytes) {
  const Target target = find_target(path);
  if (!target.is_regular) {
    // If a pipe has no reader, this waits for one, or for a signal.
    const int descriptor = ::open(target.path.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor < 0) fail(path, errno);
    try {
      write_all(descriptor, bytes, path);
    } catch (...) {
      ::close(descriptor);
      throw;
    }
    if (::close(descriptor) != 0) fail(path, errno);
    return;
  }
  TemporaryFile file(path, target.path);
  if (target.exists && ::fchmod(file.descriptor(), target.mode) != 0) fail(path, errno);
  write_all(file.descriptor(), bytes, path);
  file.rename_to(target.path);
}

struct OutputFile::Parts {
  explicit Parts(const std::string& named)
      : path(named), target(find_target(named)), file(named, target.path) {}

  /// Few large blocks are written sooner than many small ones.
  static constexpr std::size_t buffer_bytes = std::size_t{1} << 20;

  void flush() {
    write_all(file.descriptor(), buffer, path);
    buffer.clear();
  }

  std::string path;
  Target target;
  TemporaryFile file;
  std::vector<unsigned char> buffer;
};

OutputFile::OutputFile(const std::string& path) : parts_(std::make_unique<Parts>(path)) {
  if (!parts_->target.is_regular) throw CannotWrite("cannot write " + path + ": no regular file");
}

OutputFile::~OutputFile() = default;

void OutputFile::write(std::span<const unsigned char> bytes) {
  parts_->buffer.insert(parts_->buffer.end(), bytes.begin(), bytes.end());
  if (parts_->buffer.size() >= Parts::buffer_bytes) parts_->flush();
}

void OutputFile::finish() {
  parts_->flush();
  if (parts_->target.exists && ::fchmod(parts_->file.descriptor(), parts_->target.mode) != 0)
    fail(parts_->path, errno);
  parts_->file.rename_to(parts_->target.path);
}

}  // namespace minkray
