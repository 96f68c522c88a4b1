// SPDX-License-Identifier: MIT
#include "renderer/import/model/file_kind.h"

#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <string_view>

#include "core/files/regular_file.h"

namespace minkray {
namespace {

/// Length of a glTF's beginning that identifies its kind.
constexpr std::size_t looked_at = std::size_t{1} << 16;

struct Signature {
  std::string_view begin, what;
};
constexpr Signature signatures[] = {
    {"\x89PNG", "a picture (PNG)"},
    {"\xff\xd8\xff", "a picture (JPEG)"},
    {"GIF8", "a picture (GIF)"},
    {"\x76\x2f\x31\x01", "a picture (OpenEXR)"},
    {"#?RADIANCE", "a picture (Radiance)"},
    {"BLENDER", "a Blender file: export it as glTF"},
    {"\x28\xb5\x2f\xfd", "a compressed file (Zstandard, as saved by Blender): export it as glTF"},
    {"\x1f\x8b", "a compressed file (gzip)"},
    {"PK\x03\x04", "an archive (ZIP)"},
    {"PXR-USDC", "a USD file: export it as glTF"},
    {"#usda", "a USD file: export it as glTF"},
    {"Kaydara FBX", "an FBX file: export it as glTF"},
    {"ply\n", "a mesh (PLY)"},
    {"solid ", "a mesh (STL): use it as the \"file\" of a \"mesh\" in a scene"},
    {"%PDF", "a PDF document"},
};

/// Formats without a signature.
constexpr Signature endings[] = {
    {".obj", "a mesh (OBJ): use it as the \"file\" of a \"mesh\" in a scene"},
    {".stl", "a mesh (STL): use it as the \"file\" of a \"mesh\" in a scene"},
    {".yaml", "a YAML file"},
    {".yml", "a YAML file"},
    {".py", "a Python program"},
};

FileContent by_ending(const std::filesystem::path& file) {
  const std::string ending = lower_ending(file);
  for (const std::string_view one : {".gltf", ".glb"})
    if (ending == one) return {FileKind::gltf};
  for (const std::string_view one :
       {".xml", ".mjcf", ".urdf", ".sdf", ".world", ".model", ".xacro"})
    if (ending == one) return {FileKind::xml};
  for (const Signature& one : endings)
    if (ending == one.begin) return {FileKind::other, std::string(one.what)};
  return {};
}

/// A glTF has an object "asset", which a scene of our own has not.
bool is_gltf_text(std::string_view text) {
  constexpr std::string_view key = "\"asset\"";
  const std::size_t at = text.find(key);
  if (at == text.npos) return false;
  text.remove_prefix(at + key.size());
  std::string next;
  for (const char c : text) {
    if (next.size() == 2) break;
    if (std::isspace(static_cast<unsigned char>(c)) == 0) next += c;
  }
  return next == ":{";
}

}  // namespace

FileContent content_of(std::string_view begin, const std::filesystem::path& file) {
  constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
  if (begin.starts_with(byte_order_mark)) begin.remove_prefix(byte_order_mark.size());
  for (const Signature& one : signatures)
    if (begin.starts_with(one.begin)) return {FileKind::other, std::string(one.what)};
  if (begin.starts_with("glTF")) return {FileKind::gltf};
  const std::size_t first = begin.find_first_not_of(" \t\r\n");
  if (first == begin.npos) return by_ending(file);
  if (begin[first] == '<') return {FileKind::xml};
  if (begin[first] != '{' && begin[first] != '[' && begin[first] != '/') return by_ending(file);
  const bool is_gltf = by_ending(file).kind == FileKind::gltf || is_gltf_text(begin);
  return {is_gltf ? FileKind::gltf : FileKind::scene};
}

FileContent content_of(const std::filesystem::path& file) {
  std::string begin(looked_at, '\0');
  try {
    begin.resize(RegularFile(file).read(begin));
  } catch (const std::runtime_error&) {
    begin.clear();
  }
  return content_of(begin, file);
}

}  // namespace minkray
