// SPDX-License-Identifier: MIT
#include "core/mesh/weld.h"

#include <bit>

namespace minkray {
namespace {

std::uint64_t hash_of_place(const Vec3<double>& vertex) {
  std::uint64_t hash = 0;
  for (const double x : vertex)
    hash = (hash ^ std::bit_cast<std::uint64_t>(x == 0 ? 0.0 : x)) * 0x9e3779b97f4a7c15u;
  return hash ^ hash >> 32;
}

}  // namespace

std::vector<std::uint32_t> first_at_place(std::span<const Vec3<double>> vertices) {
  constexpr std::uint32_t empty = ~std::uint32_t{0};
  const std::size_t slots = std::bit_ceil(2 * vertices.size() + 1);
  std::vector<std::uint32_t> table(slots, empty), first(vertices.size());
  for (std::uint32_t i = 0; i < vertices.size(); ++i) {
    std::size_t slot = hash_of_place(vertices[i]) & (slots - 1);
    while (table[slot] != empty && vertices[table[slot]] != vertices[i])
      slot = (slot + 1) & (slots - 1);
    if (table[slot] == empty) table[slot] = i;
    first[i] = table[slot];
  }
  return first;
}

void weld(std::vector<Vec3<double>>& vertices, std::vector<Corners>& triangles) {
  std::vector<std::uint32_t> number = first_at_place(vertices);
  std::uint32_t kept = 0;
  for (std::uint32_t i = 0; i < number.size(); ++i) {
    if (number[i] == i) {
      vertices[kept] = vertices[i];
      number[i] = kept++;
    } else {
      number[i] = number[number[i]];  // an earlier vertex, which has its new number
    }
  }
  vertices.resize(kept);
  for (Corners& triangle : triangles)
    for (std::uint32_t& corner : triangle) corner = number[corner];
}

}  // namespace minkray
