// SPDX-License-Identifier: MIT
// Fault injection by LD_PRELOAD: counts a program's calls that write regular files, and kills the
// program before the n-th (from 1), or makes that call fail.
//   MINKRAY_FAULT_AT=n, MINKRAY_FAULT=errno (without it: SIGKILL)
//   MINKRAY_FAULT_LOG=file   gets one line per call: its name and its file
#include <dlfcn.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <string>

// Not counted: stdout, stderr, calls within the C library (fopen, fwrite, mkstemp), pwritev,
// truncate, fallocate, sendfile, copy_file_range, mappings, system calls by number, making folders
// and links. Calls that only remove files never fail, since the program could do nothing about it.

namespace {

std::atomic<long> calls = 0;

long number_from(const char* variable) {
  const char* text = std::getenv(variable);
  return text == nullptr ? 0 : std::atol(text);
}

/// Makes the system call directly: it is not to be counted.
void log(const std::string& line) {
  const char* file = std::getenv("MINKRAY_FAULT_LOG");
  if (file == nullptr) return;
  const long descriptor =
      ::syscall(SYS_openat, AT_FDCWD, file, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
  if (descriptor < 0) return;
  ::syscall(SYS_write, descriptor, line.data(), line.size());
  ::syscall(SYS_close, descriptor);
}

/// Counts a call; whether it is to fail, with errno set.
bool fails(const char* call, const std::string& file, bool may_fail = true) {
  const int before = errno;
  const long at = number_from("MINKRAY_FAULT_AT"), error = number_from("MINKRAY_FAULT");
  if (!may_fail && error != 0) return false;
  const bool is_now = ++calls == at;
  if (is_now && error == 0) ::kill(::getpid(), SIGKILL);
  log(std::string(call) + " " + file + (is_now ? " fails\n" : "\n"));
  errno = is_now ? static_cast<int>(error) : before;
  return is_now;
}

/// True if it is open for writing a file on a disk, or a folder.
bool counts(int descriptor) {
  const int before = errno;
  struct stat status = {};
  const int flags = ::fcntl(descriptor, F_GETFL);
  const bool is_known = descriptor > 2 && flags >= 0 && ::fstat(descriptor, &status) == 0;
  errno = before;
  return is_known &&
         (S_ISDIR(status.st_mode) || (S_ISREG(status.st_mode) && (flags & O_ACCMODE) != O_RDONLY));
}

std::string name_of(int descriptor) {
  std::array<char, 4096> name = {};
  const std::string link = "/proc/self/fd/" + std::to_string(descriptor);
  const ssize_t length = ::readlink(link.c_str(), name.data(), name.size());
  return {name.data(), static_cast<std::size_t>(length < 0 ? 0 : length)};
}

/// The function of that name that would have been called.
template <class Function>
Function* next(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

using Open = int(const char*, int, ...);
using OpenAt = int(int, const char*, int, ...);

/// True if a mode follows. O_TMPFILE has O_DIRECTORY in it, which alone makes nothing.
bool has_mode(int flags) {
  return (flags & O_CREAT) != 0 || (flags & O_TMPFILE) == O_TMPFILE;
}

bool makes_files(int flags) {
  return has_mode(flags) || (flags & O_TRUNC) != 0;
}

mode_t mode_of(int flags, va_list rest) {
  return has_mode(flags) ? va_arg(rest, mode_t) : 0;
}

int open_as(const char* name, const char* path, int flags, mode_t mode) {
  if (makes_files(flags) && fails("open", path)) return -1;
  return next<Open>(name)(path, flags, mode);
}

int open_at_as(const char* name, int folder, const char* path, int flags, mode_t mode) {
  if (makes_files(flags) && fails("open", path)) return -1;
  return next<OpenAt>(name)(folder, path, flags, mode);
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = mode_of(flags, rest);
  va_end(rest);
  return open_as("open", path, flags, mode);
}

int open64(const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = mode_of(flags, rest);
  va_end(rest);
  return open_as("open64", path, flags, mode);
}

int openat(int folder, const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = mode_of(flags, rest);
  va_end(rest);
  return open_at_as("openat", folder, path, flags, mode);
}

int openat64(int folder, const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = mode_of(flags, rest);
  va_end(rest);
  return open_at_as("openat64", folder, path, flags, mode);
}

int creat(const char* path, mode_t mode) {
  if (fails("open", path)) return -1;
  return next<int(const char*, mode_t)>("creat")(path, mode);
}

int creat64(const char* path, mode_t mode) {
  if (fails("open", path)) return -1;
  return next<int(const char*, mode_t)>("creat64")(path, mode);
}

ssize_t write(int descriptor, const void* bytes, size_t size) {
  if (counts(descriptor) && fails("write", name_of(descriptor))) return -1;
  return next<ssize_t(int, const void*, size_t)>("write")(descriptor, bytes, size);
}

ssize_t writev(int descriptor, const struct iovec* pieces, int count) {
  if (counts(descriptor) && fails("write", name_of(descriptor))) return -1;
  return next<ssize_t(int, const struct iovec*, int)>("writev")(descriptor, pieces, count);
}

ssize_t pwrite(int descriptor, const void* bytes, size_t size, off_t at) {
  if (counts(descriptor) && fails("write", name_of(descriptor))) return -1;
  return next<ssize_t(int, const void*, size_t, off_t)>("pwrite")(descriptor, bytes, size, at);
}

ssize_t pwrite64(int descriptor, const void* bytes, size_t size, off64_t at) {
  if (counts(descriptor) && fails("write", name_of(descriptor))) return -1;
  return next<ssize_t(int, const void*, size_t, off64_t)>("pwrite64")(descriptor, bytes, size, at);
}

int ftruncate(int descriptor, off_t size) noexcept {
  if (counts(descriptor) && fails("ftruncate", name_of(descriptor))) return -1;
  return next<int(int, off_t)>("ftruncate")(descriptor, size);
}

int fchmod(int descriptor, mode_t mode) noexcept {
  if (counts(descriptor) && fails("fchmod", name_of(descriptor))) return -1;
  return next<int(int, mode_t)>("fchmod")(descriptor, mode);
}

int fsync(int descriptor) {
  if (counts(descriptor) && fails("fsync", name_of(descriptor))) return -1;
  return next<int(int)>("fsync")(descriptor);
}

int fdatasync(int descriptor) {
  if (counts(descriptor) && fails("fsync", name_of(descriptor))) return -1;
  return next<int(int)>("fdatasync")(descriptor);
}

/// Closes the file all the same, as Linux does.
int close(int descriptor) {
  const bool is_failing = counts(descriptor) && fails("close", name_of(descriptor));
  const int error = errno;
  const int result = next<int(int)>("close")(descriptor);
  if (!is_failing) return result;
  errno = error;
  return -1;
}

int rename(const char* from, const char* to) noexcept {
  if (fails("rename", to)) return -1;
  return next<int(const char*, const char*)>("rename")(from, to);
}

int renameat(int from_folder, const char* from, int to_folder, const char* to) noexcept {
  if (fails("rename", to)) return -1;
  return next<int(int, const char*, int, const char*)>("renameat")(from_folder, from, to_folder,
                                                                   to);
}

int renameat2(int from_folder, const char* from, int to_folder, const char* to,
              unsigned flags) noexcept {
  if (fails("rename", to)) return -1;
  return next<int(int, const char*, int, const char*, unsigned)>("renameat2")(from_folder, from,
                                                                              to_folder, to, flags);
}

int unlink(const char* path) noexcept {
  if (fails("unlink", path, false)) return -1;
  return next<int(const char*)>("unlink")(path);
}

int unlinkat(int folder, const char* path, int flags) noexcept {
  if (fails("unlink", path, false)) return -1;
  return next<int(int, const char*, int)>("unlinkat")(folder, path, flags);
}

int remove(const char* path) noexcept {
  if (fails("unlink", path, false)) return -1;
  return next<int(const char*)>("remove")(path);
}

}  // extern "C"
