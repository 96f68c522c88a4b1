// SPDX-License-Identifier: MIT
// Detects a file's format from its first bytes. File extensions are not reliable (".urdf.xacro").
#pragma once

#include <filesystem>
#include <string>

namespace minkray {

enum class FileKind : unsigned char {
  scene,  ///< JSON, or a file to be reported as invalid JSON
  xml,
  gltf,
  other,  ///< a picture, an archive, a mesh
};

struct FileContent {
  FileKind kind = FileKind::scene;
  std::string what = {};  ///< of other files: "a picture (PNG)"
};

/// The kind of a file that cannot be read, or is empty, follows from its extension.
FileContent content_of(const std::filesystem::path& file);

/// Does this for the first bytes of a file.
FileContent content_of(std::string_view begin, const std::filesystem::path& file);

}  // namespace minkray
