// SPDX-License-Identifier: MIT
#include "renderer/io/read_image.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>
#include <new>
#include <stdexcept>
#include <vector>

#include "core/files/regular_file.h"
#include "core/support/field.h"
#include "renderer/image/colour.h"
#include "renderer/io/exr.h"
#include "renderer/io/jpeg_segments.h"
#include "renderer/io/png_chunks.h"
#include "renderer/io/radiance.h"

#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_NO_STDIO
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_HDR
#define STBI_NO_LINEAR
namespace minkray {
namespace {

/// True if stb_image failed to allocate memory: the reasons that it gives then are others, or
/// none.
thread_local bool is_out_of_memory = false;

void* cleared(std::size_t bytes) {
  void* memory = std::calloc(1, bytes);
  is_out_of_memory |= !memory;
  return memory;
}

/// std::realloc, cleared where it is new.
void* grown(void* memory, std::size_t old_bytes, std::size_t bytes) {
  void* larger = std::realloc(memory, bytes);
  is_out_of_memory |= !larger;
  if (larger && bytes > old_bytes)
    std::memset(static_cast<char*>(larger) + old_bytes, 0, bytes - old_bytes);
  return larger;
}

}  // namespace
}  // namespace minkray

// stb_image up to 2.27 does not clear what it decodes with or into: a scan of a JPEG file may name
// tables that the file does not hold, and pixels of a PNG may be copied from what is not yet there.
#define STBI_MALLOC(bytes) ::minkray::cleared(bytes)
#define STBI_REALLOC_SIZED(memory, old_bytes, bytes) ::minkray::grown(memory, old_bytes, bytes)
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

[[noreturn]] void fail_as_stb() {
  if (is_out_of_memory) throw std::bad_alloc();
  throw std::runtime_error(std::string("cannot be read: ") + stbi_failure_reason());
}

Image image_of_exr(const std::filesystem::path& file, std::int64_t most_pixels) {
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
  check_image_size(exr.window.width(), exr.window.height(), most_pixels);
  Image image(exr.window.width(), exr.window.height());
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = {(*planes[0])[i], (*planes[1])[i], (*planes[2])[i]};
  return image;
}

/// Each code as the light that it means.
template <class Code>
std::vector<float> light_of_codes() {
  constexpr std::size_t most = std::numeric_limits<Code>::max();
  std::vector<float> light(most + 1);
  for (std::size_t code = 0; code <= most; ++code)
    light[code] = static_cast<float>(from_srgb(static_cast<double>(code) / double{most}));
  return light;
}

template <class Code>
struct Codes {
  int width = 0, height = 0;
  std::unique_ptr<Code, Free> codes;
};

/// Decodes a file with stb_image, by its function for codes of this size.
template <class Code, class Load>
Codes<Code> codes_of_stb(std::string_view bytes, int wanted, std::int64_t most_pixels, Load load) {
  Codes<Code> read;
  int channels = 0;
  const auto* begin = reinterpret_cast<const stbi_uc*>(bytes.data());
  const int size = static_cast<int>(bytes.size());
  is_out_of_memory = false;
  if (!stbi_info_from_memory(begin, size, &read.width, &read.height, &channels)) fail_as_stb();
  check_image_size(read.width, read.height, most_pixels);
  read.codes.reset(load(begin, size, &read.width, &read.height, &channels, wanted));
  if (!read.codes) fail_as_stb();
  return read;
}

template <class Code>
Image image_of(const Codes<Code>& read) {
  const std::vector<float> light = light_of_codes<Code>();
  Image image(read.width, read.height);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      image.pixels[i][static_cast<int>(k)] = light[read.codes.get()[3 * i + k]];
  return image;
}

template <class Code>
GreyLevels levels_of(const Codes<Code>& read) {
  GreyLevels grey{read.width, read.height, {}};
  const auto count = static_cast<std::size_t>(read.width) * static_cast<std::size_t>(read.height);
  constexpr float most = std::numeric_limits<Code>::max();
  for (std::size_t i = 0; i < count; ++i)
    grey.levels.push_back(static_cast<float>(read.codes.get()[i]) / most);
  return grey;
}

bool has_codes(std::string_view ending) {
  return ending == ".png" || ending == ".jpg" || ending == ".jpeg";
}

std::string checked_codes(std::string bytes) {
  mend_png(bytes);
  check_jpeg(bytes);
  return bytes;
}

std::string bytes_of_codes(const std::filesystem::path& file) {
  return checked_codes(read_regular_file(file, most_picture_bytes));
}

bool is_wide(std::string_view bytes) {
  return stbi_is_16_bit_from_memory(reinterpret_cast<const stbi_uc*>(bytes.data()),
                                    static_cast<int>(bytes.size()));
}

Image image_of_codes(const std::string& bytes, std::int64_t most_pixels) {
  return is_wide(bytes)
             ? image_of(codes_of_stb<stbi_us>(bytes, 3, most_pixels, stbi_load_16_from_memory))
             : image_of(codes_of_stb<stbi_uc>(bytes, 3, most_pixels, stbi_load_from_memory));
}

}  // namespace

Image read_image_bytes(std::string bytes, std::int64_t most_pixels) {
  if (bytes.size() > most_picture_bytes) throw std::runtime_error("must be at most 1 GiB");
  return image_of_codes(checked_codes(std::move(bytes)), most_pixels);
}

Image read_image(const std::filesystem::path& file, std::int64_t most_pixels) {
  const std::string ending = lower_ending(file);
  Image image;
  if (ending == ".exr") {
    image = image_of_exr(file, most_pixels);
  } else if (ending == ".hdr") {
    image = read_radiance(read_regular_file(file, most_picture_bytes), most_pixels);
  } else if (has_codes(ending)) {
    image = image_of_codes(bytes_of_codes(file), most_pixels);
  } else {
    throw std::runtime_error(std::string("must be one of ") + readable_images);
  }
  for (const Vec3<float>& pixel : image.pixels)
    if (!pixel.allFinite() || pixel.minCoeff() < 0 || pixel.maxCoeff() > most_brightness)
      throw std::runtime_error("must hold finite numbers from 0 to 1e15");
  return image;
}

GreyLevels read_grey(const std::filesystem::path& file, std::int64_t most_pixels) {
  if (has_codes(lower_ending(file))) {
    const std::string bytes = bytes_of_codes(file);
    return is_wide(bytes)
               ? levels_of(codes_of_stb<stbi_us>(bytes, 1, most_pixels, stbi_load_16_from_memory))
               : levels_of(codes_of_stb<stbi_uc>(bytes, 1, most_pixels, stbi_load_from_memory));
  }
  const Image image = read_image(file, most_pixels);
  GreyLevels grey{image.width, image.height, {}};
  for (const Vec3<float>& pixel : image.pixels) grey.levels.push_back(pixel.x());
  return grey;
}

}  // namespace minkray
