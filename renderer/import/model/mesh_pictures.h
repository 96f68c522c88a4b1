// SPDX-License-Identifier: MIT
// Pictures of mesh files' materials, each read once.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "renderer/image/image.h"
#include "renderer/import/model/mesh_looks.h"

namespace minkray {

class MeshPictures {
 public:
  /// Fills in the material's picture, or adds a note of what is wrong with it.
  void read(MeshMaterial& material, std::vector<std::string>& notes);

  /// Files that were read.
  const std::vector<std::filesystem::path>& files() const { return files_; }

 private:
  struct Read {
    PictureFile picture;
    std::string complaint;
  };
  Read read(const MeshMaterial& material);

  std::map<std::filesystem::path, Read> of_files_;
  std::map<std::shared_ptr<const std::string>, Read> of_bytes_;
  std::vector<std::filesystem::path> files_;
  std::int64_t pixels_ = 0;  ///< of all pictures
};

}  // namespace minkray
