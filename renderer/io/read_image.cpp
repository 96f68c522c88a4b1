// SPDX-License-Identifier: MIT
#include "renderer/io/read_image.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <stdexcept>

#include "core/files/regular_file.h"
#include "core/shape/field.h"
#include "renderer/image/colour.h"
#include "renderer/io/exr.h"
#include "renderer/io/image_size.h"
#include "renderer/io/jpeg_tables.h"
#include "renderer/io/radiance.h"

#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_NO_STDIO
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_HDR
#define STBI_NO_LINEAR
// stb_image up to 2.27 does not clear what it decodes with, and a scan of a JPEG file may name
// tables that the file does not hold.
#define STBI_MALLOC(bytes) std::calloc(1, bytes)
#define STBI_REALLOC(memory, bytes) std::realloc(memory, bytes)
#define STBI_FREE(memory) std::free(memory)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-but-set-variable"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace minkray {
namespace {

constexpr std::size_t most_picture_bytes = std::size_t{1} << 30;

struct Free {
  void operator()(void* pixels) const { stbi_image_free(pixels); }
};

Image image_of_exr(const std::filesystem::path& file) {
  const ExrImage exr = read_exr(file.string());
  const auto floats = [&](std::string_view name) -> const std::vector<float>* {
    const ExrPlane* plane = exr.find(name);
    return plane ? std::get_if<std::vector<float>>(&plane->values) : nullptr;
  };
  const auto* grey = floats("Y");
  const std::vector<float>* planes[3] = {floats("R"), floats("G"), floats("B")};
  for (const auto*& plane : planes) plane = plane ? plane : grey;
  if (!planes[0] || !planes[1] || !planes[2])
    throw std::runtime_error("must have the channels R, G and B, or Y");
  check_image_size(exr.window.width(), exr.window.height());
  Image image(exr.window.width(), exr.window.height());
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = {(*planes[0])[i], (*planes[1])[i], (*planes[2])[i]};
  return image;
}

constexpr std::string_view png_signature = "\x89PNG\r\n\x1a\n";

/// Four bytes of a PNG, the highest first.
std::int64_t png_number(std::string_view bytes, std::size_t at) {
  std::int64_t number = 0;
  for (const char byte : bytes.substr(at, 4))
    number = number * 256 + static_cast<unsigned char>(byte);
  return number;
}

/// stb_image takes a PNG that is too large for it for no picture. Its header tells how large it is.
void check_size_of_png(std::string_view bytes) {
  constexpr std::size_t width_at = 16, height_at = 20, header = 24;
  if (!bytes.starts_with(png_signature) || bytes.size() < header) return;
  check_image_size(png_number(bytes, width_at), png_number(bytes, height_at));
}

/// Takes the chunks of no pixels out of a PNG: they are allowed, but stb_image copies the first of
/// them to a null pointer.
void drop_empty_data(std::string& bytes) {
  constexpr std::size_t frame = 12, name_at = 4, name_length = 4;  // length, name and CRC
  if (!bytes.starts_with(png_signature)) return;
  std::size_t to = png_signature.size(), from = to;
  while (bytes.size() - from >= frame) {
    const auto length = static_cast<std::size_t>(png_number(bytes, from));
    const bool is_empty =
        length == 0 && std::string_view(bytes).substr(from + name_at, name_length) == "IDAT";
    const std::size_t end = from + std::min(frame + length, bytes.size() - from);
    const std::size_t kept = is_empty ? 0 : end - from;
    if (to != from)
      std::copy_n(bytes.begin() + std::ptrdiff_t(from), kept, bytes.begin() + std::ptrdiff_t(to));
    to += kept;
    from = end;
  }
  bytes.erase(to, from - to);
}

/// What stb_image reads, each number made linear by from(code).
template <class T, class Load, class From>
Image image_of_stb(std::string_view bytes, Load load, From from) {
  int width = 0, height = 0, channels = 0;
  const auto* begin = reinterpret_cast<const stbi_uc*>(bytes.data());
  const int size = static_cast<int>(bytes.size());
  if (!stbi_info_from_memory(begin, size, &width, &height, &channels))
    throw std::runtime_error(std::string("cannot be read: ") + stbi_failure_reason());
  check_image_size(width, height);
  const std::unique_ptr<T, Free> codes(load(begin, size, &width, &height, &channels, 3));
  if (!codes) throw std::runtime_error(std::string("cannot be read: ") + stbi_failure_reason());
  Image image(width, height);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      image.pixels[i][static_cast<int>(k)] = from(codes.get()[3 * i + k]);
  return image;
}

}  // namespace

Image read_image(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  Image image;
  if (ending == ".exr") {
    image = image_of_exr(file);
  } else if (ending == ".hdr") {
    image = read_radiance(read_regular_file(file, most_picture_bytes));
  } else if (ending == ".png" || ending == ".jpg" || ending == ".jpeg") {
    std::string bytes = read_regular_file(file, most_picture_bytes);
    check_size_of_png(bytes);
    drop_empty_data(bytes);
    if (!has_usable_jpeg_tables(bytes))
      throw std::runtime_error("cannot be read: a table of more than 256 Huffman codes");
    const auto* begin = reinterpret_cast<const stbi_uc*>(bytes.data());
    if (stbi_is_16_bit_from_memory(begin, static_cast<int>(bytes.size())))
      image = image_of_stb<stbi_us>(bytes, stbi_load_16_from_memory, [](stbi_us x) {
        return static_cast<float>(from_srgb(x / 65535.0));
      });
    else
      image = image_of_stb<stbi_uc>(bytes, stbi_load_from_memory, [](stbi_uc x) {
        return static_cast<float>(from_srgb(x / 255.0));
      });
  } else {
    throw std::runtime_error(std::string("must be one of ") + readable_images);
  }
  for (const Vec3<float>& pixel : image.pixels)
    if (!pixel.allFinite() || pixel.minCoeff() < 0 || pixel.maxCoeff() > most_brightness)
      throw std::runtime_error("must hold finite numbers from 0 to 1e15");
  return image;
}

}  // namespace minkray
