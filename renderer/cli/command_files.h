// SPDX-License-Identifier: MIT
// The files that one command reads and writes: no output is an input or another output, by whatever
// name, link or hard link it is reached.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace minkray {

/// Inputs and outputs may be added in any order. Devices and pipes are never the same file.
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
    std::string name;    ///< as the user wrote it
    std::string option;  ///< that it is an output of; empty: an input
  };
  /// Equal for all names of one file; empty for what is no file.
  std::string identity(const std::filesystem::path& file);

  std::map<std::string, Known> known_;          ///< by identity
  std::map<std::string, std::string> folders_;  ///< identity by name
};

}  // namespace minkray
