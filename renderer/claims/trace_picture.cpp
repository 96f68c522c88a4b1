// SPDX-License-Identifier: MIT
#include "renderer/claims/trace_picture.h"

#include <cmath>
#include <sstream>

#include "renderer/claims/plot.h"
#include "renderer/claims/samples.h"

namespace minkray {
namespace {

constexpr double picture_side = 560, table_width = 520, picture_margin = 20, line_height = 17;
constexpr int outline_points = 720;

}  // namespace

std::string trace_table(const CastTrace& trace) {
  std::string text = formatted("%4s %4s %-24s %-24s %-24s %-12s %s\n", "k", "case", "t_clip",
                               "t_lo", "t_hi", "|v|", "simplex");
  int k = 0;
  for (const TracedIteration& step : trace.iterations)
    text += formatted("%4d %4d %-24.17g %-24.17g %-24.17g %-12.5g %d\n", k++,
                      static_cast<int>(step.clip.which), trace.t(step.clip.lambda),
                      trace.t(step.lower), trace.t(step.upper), double(step.v.norm()),
                      static_cast<int>(step.simplex.size()));
  return text +
         (trace.iterations.empty() ? "no iterations: this shape is met in closed form; --solver "
                                     "paper shows those of the paper\n"
                                   : "") +
         "k: iteration; case: the plane bounds t from below (1) or above (2), or is parallel to\n"
         "  the ray (3); t_clip: where it clips the ray; t_lo, t_hi: bounds of t so far; |v|: "
         "length\n"
         "  of the search direction; simplex: support points that are kept\n";
}

std::string trace_svg(const CastTrace& trace, const PreparedShape& shape) {
  // The picture's plane: x along the ray, y from the ball's centre to the ray.
  const Vec3<double> r = trace.ray.r.isZero(0) ? Vec3<double>(Vec3<double>::UnitX()) : trace.ray.r;
  Vec3<double> up = trace.ray.s;
  if (!(up.norm() > double(1e-3) * trace.ball.radius)) up = r.unitOrthogonal();
  up = (up - up.dot(r) * r).normalized();
  const double radius = double(trace.ball.radius),
               scale = (picture_side - 2 * picture_margin) / (4 * radius);
  const auto px = [&](double along) { return picture_side / 2 + along * scale; };
  const auto py = [&](double height) { return picture_side / 2 - height * scale; };
  const auto at = [&](const Vec3<double>& p) {
    return formatted("%.2f,%.2f", px(double(p.dot(r))), py(double(p.dot(up))));
  };
  const double ray_height = double(trace.ray.s.dot(up));

  std::ostringstream svg;
  const double height = std::max(picture_side, line_height * double(trace.iterations.size() + 6));
  svg << formatted(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %.0f %.0f\" "
             "font-family=\"sans-serif\" font-size=\"12\">\n",
             picture_side + table_width, height)
      << "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
      << formatted("<clipPath id=\"p\"><rect width=\"%.0f\" height=\"%.0f\"/></clipPath>\n",
                   picture_side, picture_side)
      << "<g clip-path=\"url(#p)\">\n<polygon fill=\"#eeeeee\" stroke=\"#888888\" points=\"";
  for (int i = 0; i < outline_points; ++i) {
    const double angle = double(2 * std::acos(-1.0) * i / outline_points);
    const Vec3<double> n = std::cos(angle) * r + std::sin(angle) * up;
    svg << at(shape.inner_shape().support(n) - trace.ball.centre) << ' ';
  }
  svg << "\"/>\n"
      << formatted("<line x1=\"%.2f\" y1=\"%.2f\" x2=\"%.2f\" y2=\"%.2f\" stroke=\"black\"/>\n",
                   std::max(px(double(trace.ray.lambda_min)), -picture_side), py(ray_height),
                   std::min(px(double(trace.ray.lambda_max)), 2 * picture_side), py(ray_height));
  int k = 0;
  for (const TracedIteration& step : trace.iterations) {
    const double clip = double(step.clip.lambda);
    // The whole plane v . x = v . p, where it crosses the picture's plane: a line through where it
    // clips the ray, square to what is seen of v.
    const double v_along = double(step.v.dot(r)), v_up = double(step.v.dot(up)),
                 seen = std::hypot(v_along, v_up);
    if (std::isfinite(clip) && std::abs(clip) < 4 * radius && seen > 0) {
      const double reach = 6 * radius / seen;
      svg << formatted(
          "<line x1=\"%.2f\" y1=\"%.2f\" x2=\"%.2f\" y2=\"%.2f\" stroke=\"%s\" "
          "stroke-dasharray=\"4 3\"/>\n",
          px(clip - reach * v_up), py(ray_height + reach * v_along), px(clip + reach * v_up),
          py(ray_height - reach * v_along),
          step.clip.which == ClipCase::lower_bound ? "#0072b2" : "#d55e00");
    }
    svg << formatted(
               "<circle cx=\"%.2f\" cy=\"%.2f\" r=\"3\" fill=\"#009e73\"/>"
               "<text x=\"%.2f\" y=\"%.2f\">p%d</text>\n",
               px(double(step.p.dot(r))), py(double(step.p.dot(up))), px(double(step.p.dot(r))) + 5,
               py(double(step.p.dot(up))) - 5, k)
        << formatted("<circle cx=\"%.2f\" cy=\"%.2f\" r=\"3\" fill=\"black\"/>\n",
                     px(double(step.lambda)), py(ray_height));
    ++k;
  }
  svg << "</g>\n<g font-family=\"monospace\" font-size=\"11\" xml:space=\"preserve\" "
         "style=\"white-space:pre\">\n";
  double y = picture_margin;
  const auto write = [&](const std::string& text) {
    svg << formatted("<text x=\"%.0f\" y=\"%.0f\">", picture_side + 10, y) << svg_text(text)
        << "</text>\n";
    y += line_height;
  };
  const std::string status(name_of(trace.result.status));
  const double t = double(trace.result.t_base) + double(trace.result.t_offset);
  write(trace.result.found() ? formatted("%s, t = %.9g", status.c_str(), t) : status);
  write("green: support points; blue: planes that clip the");
  write("ray from below (case 1), orange: from above (case 2)");
  y += line_height;
  write(formatted("%3s %4s %14s %14s %14s", "k", "case", "t_clip", "t_lo", "t_hi"));
  k = 0;
  for (const TracedIteration& step : trace.iterations)
    write(formatted("%3d %4d %14.9g %14.9g %14.9g", k++, static_cast<int>(step.clip.which),
                    trace.t(step.clip.lambda), trace.t(step.lower), trace.t(step.upper)));
  svg << "</g>\n</svg>\n";
  return svg.str();
}

}  // namespace minkray
