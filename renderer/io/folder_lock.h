// SPDX-License-Identifier: MIT
// Lets one process at a time read, change and rewrite a file of a folder.
#pragma once

#include <filesystem>

namespace minkray {

/// Waits for others that hold the lock of the folder, and holds it as long as it lives. Advisory,
/// and the system's: released when the process dies. On file systems without locks it does not
/// wait.
class FolderLock {
 public:
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int folder_;  ///< a file descriptor; negative: there is none
};

}  // namespace minkray
