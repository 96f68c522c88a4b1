// SPDX-License-Identifier: MIT
#include "renderer/claims/panels.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

#include "renderer/claims/samples.h"

namespace minkray {
namespace {

using Point2 = Vec<double, 2>;

constexpr double panel_side = 300, panel_margin = 16, caption = 46;
constexpr int columns = 3, outline_directions = 720;

struct Step {
  Point2 v, w, v_next;
  double lower, upper;
  std::vector<Point2> before, after;
};

/// Maps configuration space to the page.
struct Page {
  Point2 low;
  double scale;
  double x(const Point2& p) const { return panel_margin + (p.x() - low.x()) * scale; }
  double y(const Point2& p) const { return panel_side - panel_margin - (p.y() - low.y()) * scale; }
  std::string at(const Point2& p) const { return formatted("%.2f,%.2f", x(p), y(p)); }
};

class Panels {
 public:
  Panels(std::vector<Point2> outline, std::vector<Step> steps)
      : outline_(std::move(outline)), steps_(std::move(steps)) {
    Point2 low = Point2::Zero(), high = Point2::Zero();
    for (const Point2& p : outline_) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    const double size = std::max((high - low).maxCoeff(), 1e-300);
    page_ = {Point2((low + high) / 2 - Point2::Constant(size / 2)),
             (panel_side - 2 * panel_margin) / size};
  }

  std::string svg() {
    const int rows = (static_cast<int>(steps_.size()) + columns - 1) / columns;
    svg_ << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " << columns * panel_side
         << ' ' << rows * (panel_side + caption)
         << "\" font-family=\"sans-serif\" font-size=\"12\">\n"
         << "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
    for (std::size_t k = 0; k < steps_.size(); ++k) {
      const int column = static_cast<int>(k) % columns, row = static_cast<int>(k) / columns;
      svg_ << "<g transform=\"translate(" << column * panel_side << ','
           << row * (panel_side + caption) << ")\">\n";
      panel(k);
      svg_ << "</g>\n";
    }
    svg_ << "</svg>\n";
    return svg_.str();
  }

 private:
  void polygon(const std::vector<Point2>& points, const char* style) {
    svg_ << "<polygon points=\"";
    for (const Point2& p : points) svg_ << page_.at(p) << ' ';
    svg_ << "\" " << style << "/>\n";
  }
  void line(const Point2& a, const Point2& b, const char* style) {
    svg_ << formatted("<line x1=\"%.2f\" y1=\"%.2f\" x2=\"%.2f\" y2=\"%.2f\" %s/>\n", page_.x(a),
                      page_.y(a), page_.x(b), page_.y(b), style);
  }
  void dot(const Point2& p, double radius, const char* style, const std::string& label,
           double label_below = -6) {
    svg_ << formatted("<circle cx=\"%.2f\" cy=\"%.2f\" r=\"%.1f\" %s/>\n", page_.x(p), page_.y(p),
                      radius, style);
    if (!label.empty())
      svg_ << formatted("<text x=\"%.2f\" y=\"%.2f\">%s</text>\n", page_.x(p) + 6,
                        page_.y(p) + label_below, label.c_str());
  }
  /// W with the number of the iteration that found it.
  std::string name(const Point2& vertex, std::size_t k) const {
    for (std::size_t i = 0; i <= k; ++i)
      if (steps_[i].w == vertex) return formatted("W%d", static_cast<int>(i));
    return "";
  }

  void panel(std::size_t k) {
    const Step& step = steps_[k];
    polygon(outline_, "fill=\"#eeeeee\" stroke=\"#888888\"");
    if (!step.before.empty())
      polygon(step.before, "fill=\"#9ec9e8\" stroke=\"#0072b2\" stroke-width=\"2\"");
    // The line through W_k square to V_k: all of C lies on its far side from the origin.
    const double length = step.v.norm();
    if (length > 0) {
      const Point2 along = Point2(-step.v.y(), step.v.x()) / length * (panel_side / page_.scale);
      svg_ << formatted("<clipPath id=\"c%d\"><rect width=\"%.0f\" height=\"%.0f\"/></clipPath>",
                        static_cast<int>(k), panel_side, panel_side)
           << formatted("<g clip-path=\"url(#c%d)\">", static_cast<int>(k));
      line(step.w - along, step.w + along, "stroke=\"#d55e00\" stroke-dasharray=\"5 4\"");
      line(Point2::Zero(), step.v, "stroke=\"#0072b2\"");
      svg_ << "</g>\n";
    }
    int discarded = 0;
    for (const Point2& vertex : step.before) {
      const bool stays =
          std::find(step.after.begin(), step.after.end(), vertex) != step.after.end();
      dot(vertex, 4, stays ? "fill=\"#0072b2\"" : "fill=\"white\" stroke=\"#0072b2\"",
          name(vertex, k));
      discarded += !stays;
    }
    if (std::find(step.before.begin(), step.before.end(), step.w) == step.before.end())
      dot(step.w, 4, "fill=\"#d55e00\"", name(step.w, k));
    if (!step.before.empty())
      dot(step.v, 3, "fill=\"black\"", formatted("V%d", static_cast<int>(k)), 16);
    dot(Point2::Zero(), 3, "fill=\"none\" stroke=\"black\"", "0");
    svg_ << formatted("<text x=\"%.0f\" y=\"%.0f\">k = %d: new vertex %s%s</text>\n", panel_margin,
                      panel_side + 8, static_cast<int>(k), name(step.w, k).c_str(),
                      discarded ? formatted(", %d discarded (hollow)", discarded).c_str() : "")
         << formatted("<text x=\"%.0f\" y=\"%.0f\">%.6g &#8804; distance &#8804; %.6g</text>\n",
                      panel_margin, panel_side + 26, std::max(step.lower, 0.0), step.upper);
  }

  std::vector<Point2> outline_;
  std::vector<Step> steps_;
  Page page_;
  std::ostringstream svg_;
};

}  // namespace

std::string distance_panels_svg(const Shape& a, const Shape& b, SubalgorithmKind subalgorithm,
                                DistanceResult<double, 2>& result) {
  const CentredShape A = centred(a), B = centred(b);
  std::vector<Step> steps;
  result = distance_in_plane(A, B, {}, subalgorithm, [&](const DistanceIteration<double, 2>& step) {
    steps.push_back({step.v,
                     step.w,
                     step.v_next,
                     step.lower,
                     step.upper,
                     {step.before.begin(), step.before.end()},
                     {step.after.begin(), step.after.end()}});
  });
  std::vector<Point2> outline;
  const Point2 x = (B.centre - A.centre).head<2>();
  for (int i = 0; i < outline_directions; ++i) {
    const double angle = 2 * std::acos(-1.0) * i / outline_directions;
    const Vec3<double> n(std::cos(angle), std::sin(angle), 0);
    const Vec3<double> p = A.about_centre.support(n) - B.about_centre.support(Vec3<double>(-n));
    outline.push_back(x - p.head<2>());
  }
  return Panels(std::move(outline), std::move(steps)).svg();
}

}  // namespace minkray
