// SPDX-License-Identifier: MIT
// Reports a comparison as a table, as JSON and as a picture.
#include <algorithm>
#include <cstdio>

#include "renderer/compare/compare_scene.h"
#include "renderer/image/colour_map.h"
#include "renderer/image/text.h"

namespace minkray {
namespace {

std::string cut(const std::string& text, std::size_t size) {
  return text.size() <= size ? text : text.substr(0, size - 2) + "..";
}

std::string line_of(const ObjectComparison& object) {
  const CompareReport& report = object.report;
  char line[300];
  std::snprintf(line, sizeof line, "%-20s %-20s %4d %9d %6.1f %% %10d %10.2g  %9.2g %9.2g\n",
                cut(object.name, 20).c_str(), cut(object.shape, 20).c_str(), report.rank,
                report.rays, 100 * report.hit_rate(), report.total_violations(),
                report.worst_in_bounds,
                report.to_outer.count() > 0 ? report.to_outer.quantile(0.5) : 0,
                report.to_inner.count() > 0 ? report.to_inner.quantile(0.5) : 0);
  return line;
}

std::string describe(const Violator& worst) {
  char text[600];
  std::snprintf(text, sizeof text,
                "%s: status %s, t %.17g in [%.9g, %.9g], %.3g bounds beyond; ray from "
                "[%.17g, %.17g, %.17g] along [%.17g, %.17g, %.17g]",
                std::string(name_of(worst.kind)).c_str(),
                std::string(name_of(worst.status)).c_str(), worst.t, worst.t_outer, worst.t_inner,
                worst.bounds, worst.ray.origin.x(), worst.ray.origin.y(), worst.ray.origin.z(),
                worst.ray.direction.x(), worst.ray.direction.y(), worst.ray.direction.z());
  return text;
}

/// null for an infinite number, which JSON does not have.
Json number(double x) {
  return std::isfinite(x) ? Json(x) : Json();
}

Json json_of(const GapHistogram& gaps) {
  Json json = {{"count", gaps.count()}};
  if (gaps.count() == 0) return json;
  json["least"] = gaps.least();
  json["greatest"] = gaps.greatest();
  for (int bin = 0; bin < GapHistogram::bins; ++bin)
    if (gaps.in_bin(bin) > 0)
      json["bins"].push_back({{"from", number(GapHistogram::lower_edge(bin))},
                              {"to", number(GapHistogram::upper_edge(bin))},
                              {"count", gaps.in_bin(bin)}});
  return json;
}

Json json_of(const Vec3<double>& v) {
  return {v.x(), v.y(), v.z()};
}

Json json_of(const ObjectComparison& object) {
  const CompareReport& report = object.report;
  Json json = {{"object", object.name},
               {"shape", object.shape},
               {"rank", report.rank},
               {"rays", report.rays},
               {"hit_rate", report.hit_rate()},
               {"outer_hit_rate", report.outer_hit_rate()},
               {"inner_triangles", report.inner_triangles},
               {"outer_triangles", report.outer_triangles},
               {"supports_per_ray", double(report.supports) / std::max(report.rays, 1)},
               {"embree_at_fault", report.embree_at_fault},
               {"worst_in_bounds", number(report.worst_in_bounds)}};
  for (int kind = 0; kind < violation_kinds; ++kind)
    json["violations"][std::string(name_of(static_cast<Violation>(kind)))] =
        report.violations[static_cast<std::size_t>(kind)];
  if (report.worst) {
    const Violator& worst = *report.worst;
    json["worst"] = {{"kind", name_of(worst.kind)},
                     {"status", name_of(worst.status)},
                     {"t", number(worst.t)},
                     {"t_outer", number(worst.t_outer)},
                     {"t_inner", number(worst.t_inner)},
                     {"bounds", number(worst.bounds)},
                     {"origin", json_of(worst.ray.origin)},
                     {"direction", json_of(worst.ray.direction)}};
  }
  json["gap_to_outer"] = json_of(report.to_outer);
  json["gap_to_inner"] = json_of(report.to_inner);
  return json;
}

/// The scale of the picture: gaps from 1e-6 to 1 of the object's size.
constexpr double decades_shown = 6;

double on_scale(float gap) {
  return std::clamp(1 + std::log10(std::max(static_cast<double>(gap), 1e-30)) / decades_shown, 0.0,
                    1.0);
}

}  // namespace

std::string comparison_table(const SceneComparison& comparison, std::size_t most_lines) {
  std::vector<const ObjectComparison*> order;
  for (const ObjectComparison& object : comparison.objects) order.push_back(&object);
  const bool all = order.size() <= most_lines;
  if (!all)
    std::stable_sort(order.begin(), order.end(), [](const auto* a, const auto* b) {
      return std::pair(a->report.total_violations(), a->report.worst_in_bounds) >
             std::pair(b->report.total_violations(), b->report.worst_in_bounds);
    });
  std::string table =
      "object               shape                rank      rays     hits violations  of bound  "
      "t-t_outer t_inner-t\n";
  for (std::size_t i = 0; i < std::min(order.size(), most_lines); ++i) table += line_of(*order[i]);
  if (!all)
    table += "... and " + std::to_string(order.size() - most_lines) + " more with no worse\n";
  for (const ObjectComparison* object : order)
    if (object->report.worst)
      table += "VIOLATED by " + object->name + ": " + describe(*object->report.worst) + "\n";

  char sum[400];
  int embree = 0;
  for (const ObjectComparison& object : comparison.objects) embree += object.report.embree_at_fault;
  std::snprintf(sum, sizeof sum,
                "%zu objects, %lld rays: %d violations; %.3g hit/miss disagreements per million "
                "rays (%d more were Embree's rounding at an edge)\n",
                comparison.objects.size(), static_cast<long long>(comparison.rays()),
                comparison.violations(), comparison.disagreements_per_million(), embree);
  table += sum;
  table +=
      "of bound: furthest beyond a mesh, in units of the bound on Embree's rounding (violated "
      "above "
      "1)\nt-t_outer, t_inner-t: medians, as lengths in units of the object's size\n";
  return table;
}

Json comparison_json(const SceneComparison& comparison) {
  Json json = {{"rays", comparison.rays()},
               {"violations", comparison.violations()},
               {"disagreements_per_million_rays", comparison.disagreements_per_million()}};
  json["objects"] = Json::array();
  for (const ObjectComparison& object : comparison.objects)
    json["objects"].push_back(json_of(object));
  return json;
}

Image difference_image(const DifferencePicture& difference) {
  const double s = std::clamp(difference.height / 300.0, 1.5, 4.0);
  const int legend = static_cast<int>(48 * s);
  const Vec3<float> dark(0.01f, 0.01f, 0.012f), ink = Vec3<float>::Constant(0.8f);
  const Vec3<float> edge(0.05f, 0.25f, 0.3f), alarm(0.1f, 1.0f, 0.1f);
  Image image(difference.width, difference.height + legend, dark);
  const auto pixel = [&](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(difference.width) +
           static_cast<std::size_t>(x);
  };
  for (int y = 0; y < difference.height; ++y)
    for (int x = 0; x < difference.width; ++x) {
      const float gap = difference.gap[pixel(x, y)];
      if (std::isfinite(difference.t[pixel(x, y)]))
        image.at(x, y) = std::isfinite(gap) ? inferno(on_scale(gap)) : edge;
    }
  for (int y = 0; y < difference.height; ++y)
    for (int x = 0; x < difference.width; ++x)
      if (difference.violation[pixel(x, y)])
        fill_rectangle(image, x - 3, y - 3, x + 4, std::min(y + 4, difference.height), alarm);

  const double left = 12 * s, right = difference.width - 12 * s, top = difference.height + 8 * s;
  for (int x = static_cast<int>(left); x < static_cast<int>(right); ++x)
    fill_rectangle(image, x, top, x + 1, top + 10 * s, inferno((x + 0.5 - left) / (right - left)));
  for (int decade = 0; decade <= static_cast<int>(decades_shown); decade += 2) {
    const std::string label = "1e" + std::to_string(decade - static_cast<int>(decades_shown));
    const double width = text_size(label, s).width;
    const double x = left + (right - left) * decade / decades_shown;
    draw_text(image, std::clamp(x - width / 2, 2.0, difference.width - width - 2), top + 15 * s,
              label, ink, s);
  }
  const auto marked = std::ranges::count(difference.violation, true);
  const std::string caption = "t_inner - t_outer in object sizes; blue: between the silhouettes; " +
                              std::to_string(marked) + " violations" +
                              (marked > 0 ? " (green)" : "");
  const double fit = std::min(s, s * (right - left) / text_size(caption, s).width);
  draw_text(image, left, top + 28 * s, caption, ink, fit);
  return image;
}

Image difference_numbers(const DifferencePicture& difference) {
  Image image(difference.width, difference.height);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = {difference.gap[i], static_cast<float>(difference.t[i]),
                       difference.violation[i] ? 1.0f : 0.0f};
  return image;
}

}  // namespace minkray
