// SPDX-License-Identifier: MIT
// Mesh files of every format that robots' files name: the first byte selects the format, the
// second how they are split.
#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>

#include "renderer/import/mesh/mesh_library.h"
#include "renderer/import/model/mesh_hull.h"
#include "renderer/json/mistakes.h"
#include "tests/fuzz/hull_rounding.h"
#include "tests/fuzz/target.h"
#include "tests/support/temporary_folder.h"

namespace minkray::fuzz {
namespace {

std::string check_message(const std::string& message) {
  if (message.empty()) return "an error that says nothing";
  constexpr std::size_t longest = 1000;
  if (message.size() > longest) return "a message of " + std::to_string(message.size()) + " bytes";
  if (printable(message, longest) != message) return "not printable: " + printable(message, 300);
  return "";
}

/// If all are held, each vertex is in a part.
std::string check_parts(const MeshParts& mesh, MeshSplit split, bool all_are_held) {
  if (mesh.vertices.empty()) return "no vertices, and no message";
  for (const Vec3<double>& vertex : mesh.vertices)
    if (!vertex.allFinite()) return "a vertex that is not finite";
  if (split == MeshSplit::none && !mesh.parts.empty()) return "parts that nobody asked for";
  std::size_t held = 0;
  for (const std::vector<std::uint32_t>& part : mesh.parts) {
    if (part.empty()) return "a part of nothing";
    held += part.size();
    if (!std::ranges::is_sorted(part, std::ranges::less_equal()))
      return "a part that names a vertex twice, or not in order";
    if (part.back() >= mesh.vertices.size()) return "a part of vertices that are not there";
  }
  if (all_are_held && split != MeshSplit::none && held < mesh.vertices.size())
    return "a vertex that is in no part";
  return "";
}

/// Along each axis the hull must reach as far as the outermost of its scaled vertices does.
std::string check_hulls(const MeshParts& mesh, const MeshLibrary::Answer& answer,
                        const Vec3<double>& scale) {
  if (answer.parts.size() != std::max<std::size_t>(mesh.parts.size(), 1)) return "a part is lost";
  for (std::size_t k = 0; k < answer.parts.size(); ++k) {
    if (!answer.parts[k].hull) continue;
    for (int i = 0; i < 6; ++i) {
      const Vec3<double> n = (i % 2 == 0 ? 1.0 : -1.0) * Vec3<double>::Unit(i / 2);
      double outermost = -std::numeric_limits<double>::infinity(), largest = 0;
      const auto look = [&](const Vec3<double>& vertex) {
        const Vec3<double> scaled = vertex.cwiseProduct(scale);
        outermost = std::max(outermost, n.dot(scaled));
        largest = std::max(largest, scaled.cwiseAbs().maxCoeff());
      };
      if (mesh.parts.empty())
        for (const Vec3<double>& vertex : mesh.vertices) look(vertex);
      else
        for (const std::uint32_t vertex : mesh.parts[k]) look(mesh.vertices[vertex]);
      // Halves, so that no difference overflows.
      const double beyond = n.dot(answer.parts[k].hull->support(n)) / 2 - outermost / 2;
      if (!(std::abs(beyond) <= hull_rounding * largest)) return "a hull that ends elsewhere";
    }
  }
  return "";
}

}  // namespace

std::string check_mesh_parts(std::string_view bytes) {
  if (bytes.size() < 2) return "";
  const std::vector<MeshFormatReader>& formats = mesh_formats();
  const MeshFormatReader& format = formats[static_cast<unsigned char>(bytes[0]) % formats.size()];
  ImportOptions options;
  options.split = static_cast<MeshSplit>(static_cast<unsigned char>(bytes[1]) % 3);
  const bool is_exact = static_cast<unsigned char>(bytes[1]) % 2 == 1;
  options.meshes = is_exact ? MeshChoice::exact : MeshChoice::hull;
  static const TemporaryFolder folder;
  const std::string name = "mesh" + std::string(format.ending);
  folder.write(name, bytes.substr(2));

  MeshParts mesh;
  std::string refused;
  try {
    mesh = format.read(folder.path() / name, options.split, MeshDetail::attributes).mesh;
  } catch (const std::runtime_error& error) {
    refused = error.what();
    if (const std::string bad = check_message(refused); !bad.empty()) return bad;
  }
  MeshLibrary library(folder.path(), options);
  const Vec3<double> scale(1, -2, 0.5);
  const MeshLibrary::Answer answer = library.parts_of(name, scale);
  if (!answer.complaint.empty()) return check_message(answer.complaint);
  if (!refused.empty()) return "hulls of a mesh that is refused";
  if (const std::string bad = check_parts(mesh, options.split, format.ending == ".stl");
      !bad.empty())
    return bad;
  Model model;
  library.hand_over(model);
  for (const ModelMesh& shown : model.meshes) {
    const double deepest = facts_of(shown).deepest;
    if (!(deepest >= 0) || !std::isfinite(deepest)) return "vertices outside the hull";
  }
  return check_hulls(mesh, answer, scale);
}

}  // namespace minkray::fuzz
