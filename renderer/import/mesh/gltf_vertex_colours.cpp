// SPDX-License-Identifier: MIT
#include "renderer/import/mesh/gltf_vertex_colours.h"

#include <bit>

namespace minkray {
namespace {

/// Number of squares along x and y: powers of two, at least as many squares as triangles.
struct ColourSquares {
  int columns = 1, rows = 1;

  explicit ColourSquares(std::size_t triangles) {
    const int bits = triangles > 1 ? static_cast<int>(std::bit_width(triangles - 1)) : 0;
    columns <<= (bits + 1) / 2;
    rows <<= bits / 2;
  }
};

/// The left upper pixel of a triangle's square: even bits of its number are x, odd ones y.
struct SquareCorner {
  int x = 0, y = 0;

  explicit SquareCorner(std::size_t triangle) {
    for (int bit = 0; triangle != 0; ++bit, triangle >>= 2) {
      x |= static_cast<int>(triangle & 1) << (bit + 1);
      y |= static_cast<int>(triangle >> 1 & 1) << (bit + 1);
    }
  }
};

}  // namespace

std::shared_ptr<const Image> picture_of_colours(
    std::span<const Vec3<float>> colours, std::span<const MeshAttributes::Numbers> triangles) {
  const ColourSquares squares(triangles.size());
  Vec3<float> mean = Vec3<float>::Zero();
  for (const Vec3<float>& colour : colours) mean += colour / static_cast<float>(colours.size());
  auto image = std::make_shared<Image>(2 * squares.columns, 2 * squares.rows, mean);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const SquareCorner at(i);
    const Vec3<float>&a = colours[triangles[i][0]], &b = colours[triangles[i][1]],
          &c = colours[triangles[i][2]];
    image->at(at.x, at.y) = a;
    image->at(at.x + 1, at.y) = b;
    image->at(at.x, at.y + 1) = c;
    // Makes the bilinear interpolation linear; may be below 0 or above 1.
    image->at(at.x + 1, at.y + 1) = b + c - a;
  }
  return image;
}

void add_colour_coordinates(std::size_t triangles, MeshAttributes& attributes) {
  const ColourSquares squares(triangles);
  const float width = 2 * static_cast<float>(squares.columns),
              height = 2 * static_cast<float>(squares.rows);
  for (std::size_t i = 0; i < triangles; ++i) {
    const SquareCorner at(i);
    const auto first = static_cast<std::uint32_t>(attributes.uvs.size());
    for (const auto& [x, y] : {std::pair(0, 0), std::pair(1, 0), std::pair(0, 1)})
      attributes.uvs.push_back({(static_cast<float>(at.x + x) + 0.5f) / width,
                                (static_cast<float>(at.y + y) + 0.5f) / height});
    attributes.uv_of.push_back({first, first + 1, first + 2});
  }
}

}  // namespace minkray
