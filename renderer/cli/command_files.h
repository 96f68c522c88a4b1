// SPDX-License-Identifier: MIT
// Files that one command reads and writes. No output may be an input or another output, whatever
// name, link or hard link leads to it.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace minkray {

/// Accepts inputs and outputs in any order. Devices and pipes are never the same file.
class CommandFiles {
 public:
  /// Adds inputs. Throws WrongUsage if one of them is an output that was added before.
  void read(const std::filesystem::path& file);
  void read(const std::vector<std::filesystem::path>& files);

  /// Adds an output, given by an option such as "--output". Throws WrongUsage if it is an input or
  /// an output that was added before.
  void write(const std::filesystem::path& file, const std::string& option);

 private:
  struct Known {
    std::string name;    ///< name as the user wrote it
    std::string option;  ///< option that names the output; empty: an input
  };
  /// Equal for all names of one file; empty if the name is not a file.
  std::string identity(const std::filesystem::path& file);

  std::map<std::string, Known> known_;          ///< by identity
  std::map<std::string, std::string> folders_;  ///< identity by name
};

}  // namespace minkray
