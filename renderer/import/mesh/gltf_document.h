// SPDX-License-Identifier: MIT
// glTF 2.0 as a container: the JSON of a .gltf or .glb file, its buffers (in the file, in data:
// URIs, or in files next to it) and its accessors. Khronos Group, "glTF 2.0 Specification", 2021.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/math/vec.h"
#include "renderer/json/json.h"
#include "renderer/json/mistakes.h"

namespace minkray {

class GltfDocument {
 public:
  /// `bytes` are a file's; other files are searched next to `file`. Reports errors as mistakes.
  GltfDocument(std::string bytes, std::filesystem::path file, Mistakes& mistakes);

  /// The root object, or null if the file is no glTF that is read.
  const Json* root() const { return root_ ? &*root_ : nullptr; }

  /// Number of items in a list of the root: "nodes", "meshes".
  std::size_t count(std::string_view list) const;
  /// The item of a list of the root that a key of an object names by its number; nothing if the key
  /// is not there, or is wrong, which is a mistake.
  std::optional<std::size_t> index(const Json& object, const JsonPath& path, std::string_view key,
                                   std::string_view list);
  /// Reads a number that occurs in a list in the same way.
  std::optional<std::size_t> index_of(const Json& number, const JsonPath& path,
                                      std::string_view list);
  const Json& item(std::string_view list, std::size_t index) const;

  /// Finite points of an accessor (VEC3), in its order; nothing, and a mistake, if it is wrong.
  std::optional<std::vector<Vec3<double>>> points(std::size_t accessor);
  /// Quaternions x, y, z, w of an accessor (VEC4), none of them zero.
  std::optional<std::vector<std::array<double, 4>>> quaternions(std::size_t accessor);
  /// Whole numbers of an accessor (SCALAR), each less than `limit`.
  std::optional<std::vector<std::uint32_t>> indices(std::size_t accessor, std::size_t limit);

  /// Colours of an accessor (VEC3 or VEC4, whose opacity is left out), from 0 to 1.
  std::optional<std::vector<Vec3<float>>> colours(std::size_t accessor);
  /// Pairs of numbers of an accessor (VEC2), which may be none.
  std::optional<std::vector<std::array<double, 2>>> pairs(std::size_t accessor);

  /// The file of an image next to this one; nothing if its bytes are in the file itself, or if its
  /// name is wrong, which is a mistake.
  std::optional<std::filesystem::path> image_file(std::size_t image);
  /// The bytes of an image in the file itself.
  std::optional<std::string> image_bytes(std::size_t image);

  /// Extensions that the file uses and that are not read.
  std::vector<std::string> unread_extensions() const;

  /// Size of the buffers loaded so far.
  std::size_t bytes_of_buffers() const { return buffer_bytes_; }

  /// Hashes of all that was read.
  const std::string& hash_text() const { return hash_text_; }
  /// The files that were read for buffers.
  const std::vector<std::filesystem::path>& files() const { return files_; }
  Mistakes& mistakes() { return mistakes_; }

 private:
  struct Source;
  bool open_binary();
  void check_extensions();
  std::size_t natural(const Json& object, const JsonPath& path, std::string_view key,
                      std::size_t otherwise);
  const std::string* buffer(std::size_t index);
  std::optional<std::string> read_uri(const std::string& uri, const JsonPath& path);
  std::optional<std::filesystem::path> file_of_uri(const std::string& uri, const JsonPath& path);
  bool find(const Json& object, const JsonPath& path, std::size_t components, std::size_t count,
            int type, Source& source);
  std::optional<std::vector<double>> numbers(std::size_t accessor, std::size_t components);
  bool replace_sparse(const Json& accessor, const JsonPath& path, std::size_t components,
                      std::size_t count, int type, bool normalized, std::vector<double>& values);

  Mistakes& mistakes_;
  std::filesystem::path file_;
  std::string bytes_;
  std::string_view json_text_, binary_;  ///< into bytes_
  bool has_binary_ = false;
  std::optional<Json> root_;
  std::map<std::size_t, std::string> buffers_;
  std::size_t buffer_bytes_ = 0;
  std::size_t numbers_read_ = 0;  ///< accessors may share data and be read repeatedly
  std::string hash_text_;
  std::vector<std::filesystem::path> files_;
};

}  // namespace minkray
