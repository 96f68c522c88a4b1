// SPDX-License-Identifier: MIT
#include "renderer/import/mesh/gltf_document.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <exception>

#include "core/files/regular_file.h"
#include "renderer/base/hash.h"
#include "renderer/base/of_file.h"
#include "renderer/import/mesh/gltf_text.h"
#include "renderer/json/object_reader.h"
#include "renderer/json/parse.h"
#include "renderer/json/values.h"

namespace minkray {
namespace {

constexpr std::size_t most_buffer_bytes = std::size_t{1} << 30;
/// Values of a document that describes a scene; each takes some 50 bytes.
constexpr std::size_t most_values = 8'000'000;
/// No offset or count in a file that can be read is larger.
constexpr std::size_t most_natural = std::size_t{1} << 40;

static_assert(std::endian::native == std::endian::little);

std::uint32_t word_at(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

/// Extensions that change nothing about where surfaces are.
bool is_about_looks(std::string_view extension) {
  for (const std::string_view begin :
       {"KHR_materials", "KHR_texture", "EXT_texture", "MSFT_texture", "KHR_lights", "KHR_audio",
        "KHR_xmp", "KHR_animation", "KHR_node_visibility", "KHR_node_selectability",
        "KHR_node_hoverability", "AGI_", "ADOBE_materials", "EXT_lights", "MSFT_packing",
        "MSFT_lod", "FB_geometry_metadata"})
    if (extension.starts_with(begin)) return true;
  return false;
}

constexpr std::string_view extensions_read[] = {"KHR_implicit_shapes", "KHR_physics_rigid_bodies",
                                                "KHR_mesh_quantization", "EXT_mesh_gpu_instancing",
                                                "KHR_texture_transform"};

bool is_read(std::string_view extension) {
  return std::ranges::find(extensions_read, extension) != std::end(extensions_read);
}

}  // namespace

GltfDocument::GltfDocument(std::string bytes, std::filesystem::path file, Mistakes& mistakes)
    : mistakes_(mistakes), file_(std::move(file)), bytes_(std::move(bytes)) {
  Hash hash;
  hash.add(bytes_);
  hash_text_ = hash.text();
  json_text_ = bytes_;
  if (json_text_.starts_with("glTF") && !open_binary()) return;
  const auto values = std::ranges::count_if(
      json_text_, [](char c) { return c == ',' || c == ':' || c == '[' || c == '{'; });
  if (static_cast<std::size_t>(values) > most_values) {
    mistakes_.add("must have at most " + std::to_string(most_values) + " values");
    return;
  }
  root_ = parse_json(json_text_, mistakes_);
  if (!root_) return;
  const Json* asset = root_->is_object() ? root_->find("asset") : nullptr;
  const Json* version = asset && asset->is_object() ? asset->find("version") : nullptr;
  if (!version || !version->is_string() || !version->text().starts_with("2")) {
    mistakes_.add(JsonPath() / "asset" / "version", "must be \"2.0\": glTF 1 is not supported");
    root_.reset();
    return;
  }
  check_extensions();
}

/// A header of 12 bytes, and chunks: JSON, and the first buffer if there is one.
bool GltfDocument::open_binary() {
  const std::string_view bytes = bytes_;
  json_text_ = {};
  if (bytes.size() < 20 || word_at(bytes, 4) != 2) {
    mistakes_.add("must be a .glb file of version 2");
    return false;
  }
  if (word_at(bytes, 8) != bytes.size()) {
    mistakes_.add("must have the " + std::to_string(word_at(bytes, 8)) +
                  " bytes given by its header (got " + std::to_string(bytes.size()) + ")");
    return false;
  }
  constexpr std::uint32_t json_chunk = 0x4e4f534a, binary_chunk = 0x004e4942;
  for (std::size_t at = 12; at + 8 <= bytes.size();) {
    const std::size_t length = word_at(bytes, at);
    const std::uint32_t type = word_at(bytes, at + 4);
    if (length > bytes.size() - at - 8) {
      mistakes_.add("has a truncated chunk");
      return false;
    }
    const std::string_view chunk = bytes.substr(at + 8, length);
    if (type == json_chunk && json_text_.empty()) json_text_ = chunk;
    if (type == binary_chunk && !has_binary_) {
      binary_ = chunk;
      has_binary_ = true;
    }
    at += 8 + (length + 3) / 4 * 4;
  }
  if (json_text_.empty()) mistakes_.add("contains no JSON");
  return !json_text_.empty();
}

void GltfDocument::check_extensions() {
  const Json* required = root_->find("extensionsRequired");
  if (!required) return;
  for (std::size_t i = 0; i < required->size() && required->is_array(); ++i) {
    const Json& one = (*required)[i];
    if (!one.is_string()) continue;
    const std::string name = one.get<std::string>();
    if (!is_read(name) && !is_about_looks(name))
      mistakes_.add(JsonPath() / "extensionsRequired" / i,
                    "the extension " + printable(name, 60) + " is not supported");
  }
}

std::vector<std::string> GltfDocument::unread_extensions() const {
  std::vector<std::string> names;
  const Json* used = root_ ? root_->find("extensionsUsed") : nullptr;
  for (std::size_t i = 0; used && used->is_array() && i < used->size(); ++i) {
    const Json& one = (*used)[i];
    if (one.is_string() && !is_read(one.text())) names.push_back(one.get<std::string>());
  }
  return names;
}

std::size_t GltfDocument::count(std::string_view list) const {
  const Json* found = root_ ? root_->find(list) : nullptr;
  return found && found->is_array() ? found->size() : 0;
}

const Json& GltfDocument::item(std::string_view list, std::size_t index) const {
  return root_->at(list)[index];
}

std::optional<std::size_t> GltfDocument::index(const Json& object, const JsonPath& path,
                                               std::string_view key, std::string_view list) {
  const Json* written = object.is_object() ? object.find(key) : nullptr;
  return written ? index_of(*written, path / key, list) : std::nullopt;
}

std::optional<std::size_t> GltfDocument::index_of(const Json& number, const JsonPath& path,
                                                  std::string_view list) {
  const std::size_t size = count(list);
  if (number.is_number_unsigned() && number.get<std::uint64_t>() < size) {
    const auto at = static_cast<std::size_t>(number.get<std::uint64_t>());
    if (item(list, at).is_object()) return at;
    mistakes_.add(JsonPath() / list / at, "must be an object (" + found(item(list, at)) + ")");
    return std::nullopt;
  }
  mistakes_.add(path, "must be the number of one of the " + std::to_string(size) + " " +
                          std::string(list) + " (" + found(number) + ")");
  return std::nullopt;
}

std::size_t GltfDocument::natural(const Json& object, const JsonPath& path, std::string_view key,
                                  std::size_t otherwise) {
  const Json* written = object.find(key);
  if (!written) return otherwise;
  if (written->is_number_unsigned() && written->get<std::uint64_t>() <= most_natural)
    return static_cast<std::size_t>(written->get<std::uint64_t>());
  mistakes_.add(path / key, "must be a whole number >= 0 (" + found(*written) + ")");
  return otherwise;
}

std::optional<std::string> GltfDocument::read_uri(const std::string& uri, const JsonPath& path) {
  if (uri.starts_with("data:")) {
    const std::size_t comma = uri.find(',');
    const bool is_base64 =
        comma != uri.npos && std::string_view(uri).substr(0, comma).ends_with(";base64");
    auto bytes = is_base64 ? from_base64(std::string_view(uri).substr(comma + 1)) : std::nullopt;
    if (!bytes) mistakes_.add(path, "must be data in base64");
    return bytes;
  }
  const auto file = file_of_uri(uri, path);
  if (!file) return std::nullopt;
  try {
    std::string bytes = read_regular_file(*file, most_buffer_bytes);
    Hash hash;
    hash.add(bytes);
    hash_text_ += hash.text();
    files_.push_back(*file);
    return bytes;
  } catch (const std::exception& error) {
    mistakes_.add(path, printable(file->string(), 200) + ": " + what_of(error));
    return std::nullopt;
  }
}

std::optional<std::filesystem::path> GltfDocument::file_of_uri(const std::string& uri,
                                                               const JsonPath& path) {
  if (uri.find("://") != uri.npos) {
    mistakes_.add(path, "must be a file in the same folder or data (" + printable(uri, 100) + ")");
    return std::nullopt;
  }
  const std::filesystem::path name = percent_decoded(uri);
  // A buffer may be any bytes: what somebody's file names is not supported out of other folders.
  if (name.is_absolute() || std::ranges::find(name, std::filesystem::path("..")) != name.end()) {
    mistakes_.add(path, "must be a file in the same folder or below (" + printable(uri, 100) + ")");
    return std::nullopt;
  }
  return file_.parent_path() / name;
}

std::optional<std::filesystem::path> GltfDocument::image_file(std::size_t image) {
  const Json* uri = item("images", image).find("uri");
  if (!uri || !uri->is_string() || uri->text().starts_with("data:")) return std::nullopt;
  return file_of_uri(uri->text(), JsonPath() / "images" / image / "uri");
}

std::optional<std::string> GltfDocument::image_bytes(std::size_t image) {
  const Json& json = item("images", image);
  const JsonPath path = JsonPath() / "images" / image;
  if (const Json* uri = json.find("uri"))
    return uri->is_string() && uri->text().starts_with("data:")
               ? read_uri(uri->text(), path / "uri")
               : std::nullopt;
  const auto view = index(json, path, "bufferView", "bufferViews");
  if (!view) return std::nullopt;
  const Json& given = item("bufferViews", *view);
  const JsonPath at = JsonPath() / "bufferViews" / *view;
  const auto whole = index(given, at, "buffer", "buffers");
  const std::string* bytes = whole ? buffer(*whole) : nullptr;
  if (!bytes) return std::nullopt;
  const std::size_t begin = natural(given, at, "byteOffset", 0),
                    length = natural(given, at, "byteLength", 0);
  if (begin > bytes->size() || length > bytes->size() - begin) {
    mistakes_.add(at, "must lie in its buffer of " + std::to_string(bytes->size()) + " bytes");
    return std::nullopt;
  }
  return bytes->substr(begin, length);
}

const std::string* GltfDocument::buffer(std::size_t index) {
  const auto known = buffers_.find(index);
  if (known != buffers_.end()) return &known->second;
  const Json& json = item("buffers", index);
  const JsonPath path = JsonPath() / "buffers" / index;
  const std::size_t length = natural(json, path, "byteLength", 0);
  std::optional<std::string> bytes;
  if (const Json* uri = json.find("uri")) {
    if (const auto text = read_string(*uri, path / "uri", mistakes_))
      bytes = read_uri(*text, path / "uri");
  } else if (index == 0 && has_binary_) {
    bytes = std::string(binary_);
  } else {
    mistakes_.add(path, "must have a \"uri\"");
  }
  if (!bytes) return nullptr;
  if (bytes->size() < length) {
    mistakes_.add(path, "must have " + std::to_string(length) + " bytes (got " +
                            std::to_string(bytes->size()) + ")");
    return nullptr;
  }
  buffer_bytes_ += bytes->size();
  return &(buffers_[index] = std::move(*bytes));
}

}  // namespace minkray
