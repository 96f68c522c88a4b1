// SPDX-License-Identifier: MIT
#include "renderer/io/png.h"

#include <stdexcept>

#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

namespace minkray {

std::vector<unsigned char> png_of(int width, int height, std::span<const std::uint8_t> rgb) {
  std::vector<unsigned char> bytes;
  const auto append = [](void* context, void* data, int size) {
    const auto* from = static_cast<const unsigned char*>(data);
    static_cast<std::vector<unsigned char>*>(context)->assign(from, from + size);
  };
  if (!stbi_write_png_to_func(append, &bytes, width, height, 3, rgb.data(), 3 * width))
    throw std::runtime_error("the PNG encoder ran out of memory");
  return bytes;
}

}  // namespace minkray
