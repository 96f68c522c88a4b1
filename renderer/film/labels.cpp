// SPDX-License-Identifier: MIT
#include "renderer/film/labels.h"

#include <algorithm>

#include "renderer/image/text.h"
#include "renderer/rays/camera.h"
#include "renderer/scene/summary.h"

namespace minkray {
namespace {

/// The picture's rectangle around a box of the world, in pixels.
std::optional<Bounds<double>> projected(const Camera& camera, const Bounds<double>& box) {
  Bounds<double> seen;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3<double> point((corner & 1 ? box.upper : box.lower).x(),
                             (corner & 2 ? box.upper : box.lower).y(),
                             (corner & 4 ? box.upper : box.lower).z());
    const auto at = camera.project(point);
    if (!at) return std::nullopt;
    seen.extend(Vec3<double>(at->x(), at->y(), 0));
  }
  return seen;
}

double label_scale(const Resolution& resolution) {
  return std::clamp(resolution.height / 540.0, 1.0, 6.0);
}

}  // namespace

std::vector<Label> labels_of(const Scene& scene, const Resolution& resolution) {
  std::vector<Label> labels;
  if (!scene.labels) return labels;
  const Camera camera(scene.camera, resolution);
  const double scale = label_scale(resolution);
  for (const auto& object : scene.objects) {
    if (object.half_space) continue;  // a half-space has no middle
    const std::string& name = object.name;
    const auto seen = projected(camera, bounds_of(object));
    if (name.empty() || !seen) continue;
    const double width = text_size(name, scale).width;
    labels.push_back(
        {(seen->lower.x() + seen->upper.x() - width) / 2, seen->upper.y() + 2 * scale, name});
  }
  return labels;
}

void draw_labels(Image& image, const std::vector<Label>& labels, const PixelRect& region,
                 const Resolution& resolution) {
  const double scale = label_scale(resolution);
  for (const Label& label : labels) {
    const TextSize size = text_size(label.text, scale);
    const double x = label.x - region.x0, y = label.y - region.y0;
    fill_rectangle(image, x - 2 * scale, y - 2 * scale, x + size.width + 2 * scale, y + size.height,
                   Vec3<float>::Zero(), 0.85f);
    draw_text(image, x, y, label.text, Vec3<float>::Ones(), scale);
  }
}

}  // namespace minkray
