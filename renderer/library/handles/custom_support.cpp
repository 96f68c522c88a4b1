// SPDX-License-Identifier: MIT
#include "renderer/library/handles/custom_support.h"

#include <cxxabi.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <numbers>

#include "renderer/library/handles/call.h"

namespace minkray {
namespace {

/// Along a spiral, evenly over the sphere.
std::vector<Coordinates> spiral(std::size_t count) {
  std::vector<Coordinates> directions;
  for (std::size_t i = 0; i < count; ++i) {
    const double z = 1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(count);
    const double angle = static_cast<double>(i) * std::numbers::pi * (3 - std::sqrt(5.0));
    const double radius = std::sqrt(1 - z * z);
    directions.push_back({radius * std::cos(angle), radius * std::sin(angle), z});
  }
  return directions;
}

/// A cube's faces, edges and corners, where shapes are special.
std::vector<Coordinates> of_a_cube() {
  std::vector<Coordinates> directions;
  for (int i = 0; i < 27; ++i) {
    if (i == 13) continue;
    const Vec3<double> n = unit(Vec3<double>(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1));
    directions.push_back({n.x(), n.y(), n.z()});
  }
  return directions;
}

constexpr std::size_t spiral_directions = 200;  ///< that are held against each other once
constexpr std::size_t kept_probes = 64;         ///< that each answer is held against later on

double dot(const Coordinates& a, const Coordinates& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

bool is_finite(const Coordinates& p) {
  return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
}

std::string text_of(const Coordinates& p) {
  char text[96];
  std::snprintf(text, sizeof text, "(%.17g, %.17g, %.17g)", p[0], p[1], p[2]);
  return text;
}

/// A user's function that this thread is running. Linked from the innermost to the outermost,
/// since a support function may query other shapes.
struct Running {
  const CustomSupport& custom;
  Running* outer;
  std::string reason = {};  ///< reason for its failure, if it gives one

  explicit Running(const CustomSupport& one) : custom(one), outer(innermost()) {
    innermost() = this;
  }
  ~Running() { innermost() = outer; }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

  static Running*& innermost() {
    thread_local Running* running = nullptr;
    return running;
  }
};

std::string contradiction(const Coordinates& n, const Coordinates& point, const Coordinates& other,
                          double beyond) {
  char length[32];
  std::snprintf(length, sizeof length, "%.3g", beyond);
  return "the support function is not maximal: along " + text_of(n) + " it answered " +
         text_of(point) + ", but " + text_of(other) + ", which it answered as well, lies " +
         length + " further";
}

}  // namespace

CustomSupport::CustomSupport(const minkray_support& function, std::size_t gathered,
                             minkray_jet_function with_derivatives)
    : function_(function),
      jets_(with_derivatives),
      gathered_(gathered),
      has_bounds_(function.lower && function.upper) {
  try {
    if (!function.function) wrong_use("support.function: must not be NULL");
    if ((function.lower == nullptr) != (function.upper == nullptr))
      wrong_use("support.lower, support.upper: must be both given, or both NULL");
    if (has_bounds_) {
      for (int k = 0; k < 3; ++k) {
        bounds_.lower[k] = function.lower[k];
        bounds_.upper[k] = function.upper[k];
        if (!std::isfinite(function.lower[k]) || !std::isfinite(function.upper[k]) ||
            function.lower[k] > function.upper[k])
          wrong_use(
              "support.lower, support.upper: must be finite corners of a box, the lower first");
      }
    }
    function_.lower = function_.upper = nullptr;  // theirs to keep
    probe();
    if (has_lied()) throw CallError(MINKRAY_BAD_SUPPORT, complaint());
  } catch (...) {
    if (function.release) function.release(function.user);
    throw;
  }
}

CustomSupport::~CustomSupport() {
  try {
    if (function_.release) function_.release(function_.user);
  } catch (...) {  // no caller is left to report it to
  }
}

void CustomSupport::probe() {
  std::vector<Coordinates> directions = of_a_cube(), more = spiral(spiral_directions);
  directions.insert(directions.end(), more.begin(), more.end());
  std::vector<Coordinates> points(directions.size());
  // Bounds and planes are not known yet: what is not finite is all that is found here.
  for (std::size_t i = 0; i < directions.size(); i += most) {
    const std::size_t count = std::min(most, directions.size() - i);
    support(count, &directions[i], &points[i]);
    if (has_lied()) return;
  }
  Vec3<double> lower = Vec3<double>::Constant(std::numeric_limits<double>::infinity());
  Vec3<double> upper = -lower;
  double away = 0;
  for (const Coordinates& p : points) {
    const Vec3<double> point(p[0], p[1], p[2]);
    lower = lower.cwiseMin(point);
    upper = upper.cwiseMax(point);
    away = std::max(away, point.cwiseAbs().maxCoeff());
  }
  // Far from its own origin a shape is rounded to how far away it is.
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  allowed_ = support_contradiction * (upper - lower).maxCoeff() + 64 * epsilon * away +
             std::numeric_limits<double>::min();
  const Vec3<double> middle = lower + (upper - lower) / 2;
  fallback_ = {middle.x(), middle.y(), middle.z()};

  for (std::size_t i = 0; i < directions.size(); ++i)
    for (std::size_t j = 0; j < directions.size(); ++j) {
      const double beyond = dot(directions[i], points[j]) - dot(directions[i], points[i]);
      if (beyond > allowed_)
        return complain(contradiction(directions[i], points[i], points[j], beyond));
    }
  for (std::size_t i = 0; i < directions.size(); ++i) {
    Coordinates again;
    support(1, &directions[i], &again);
    if (again != points[i])
      return complain("the support function answers the same direction " + text_of(directions[i]) +
                      " once " + text_of(points[i]) + " and once " + text_of(again));
  }
  for (std::size_t i = 0; i < std::min(kept_probes, directions.size()); ++i) {
    probes_.nx.push_back(directions[i][0]);
    probes_.ny.push_back(directions[i][1]);
    probes_.nz.push_back(directions[i][2]);
    probes_.x.push_back(points[i][0]);
    probes_.y.push_back(points[i][1]);
    probes_.z.push_back(points[i][2]);
    probes_.h.push_back(dot(directions[i], points[i]) + allowed_);
  }
  for (std::size_t i = 0; i < directions.size(); ++i) check(directions[i], points[i]);
  if (jets_ && !has_lied()) probe_jets(directions.data(), points.data(), directions.size());
}

/// The points with derivatives must be those without. The mean of points lies in the shape.
void CustomSupport::probe_jets(const Coordinates* directions, const Coordinates* points,
                               std::size_t count) {
  Vec3<double> mean = Vec3<double>::Zero();
  for (std::size_t i = 0; i < count; ++i) {
    Coordinates point;
    Derivative derivative;
    jets(1, &directions[i], &point, &derivative);
    if (has_lied()) return;
    if (point != points[i])
      return complain("the function with derivatives answers the direction " +
                      text_of(directions[i]) + " " + text_of(point) + ", the one without " +
                      text_of(points[i]));
    mean += Vec3<double>(point[0], point[1], point[2]) / static_cast<double>(count);
  }
  know_jets({mean.x(), mean.y(), mean.z()});
}

void CustomSupport::jets(std::size_t count, const Coordinates* directions, Coordinates* points,
                         Derivative* derivatives) const {
  static_assert(sizeof(Derivative) == sizeof(double[9]));
  const Coordinates nan = {NAN, NAN, NAN};
  std::fill_n(points, count, nan);
  std::fill_n(derivatives, count, Derivative{});
  if (!has_lied()) {
    run("the function with derivatives", [&] {
      return jets_(function_.user, count, reinterpret_cast<const double(*)[3]>(directions),
                   reinterpret_cast<double(*)[3]>(points),
                   reinterpret_cast<double(*)[9]>(derivatives));
    });
    for (std::size_t i = 0; i < count && !has_lied(); ++i) {
      check(directions[i], points[i]);
      if (!std::ranges::all_of(derivatives[i], [](double x) { return std::isfinite(x); }))
        complain("the function with derivatives returned a derivative that is not finite along " +
                 text_of(directions[i]));
    }
  }
  if (has_lied()) {
    std::fill_n(points, count, fallback_);
    std::fill_n(derivatives, count, Derivative{});
  }
}

void CustomSupport::support(std::size_t count, const Coordinates* directions,
                            Coordinates* points) const {
  static_assert(sizeof(Coordinates) == sizeof(double[3]));
  if (!has_lied()) {
    if (gathered_ == 0 || !Gathering::wait(*this, count, directions, points))
      answer(count, directions, points);
    for (std::size_t i = 0; i < count && !has_lied(); ++i) check(directions[i], points[i]);
  }
  if (has_lied()) std::fill_n(points, count, fallback_);
}

void CustomSupport::answer(std::size_t count, const Coordinates* directions,
                           Coordinates* points) const {
  const Coordinates nan = {NAN, NAN, NAN};
  std::fill_n(points, count, nan);
  if (has_lied()) return;
  run("the support function", [&] {
    return function_.function(function_.user, count,
                              reinterpret_cast<const double(*)[3]>(directions),
                              reinterpret_cast<double(*)[3]>(points));
  });
}

template <class Call>
void CustomSupport::run(const char* function, Call&& call) const {
  Running running(*this);
  int failed = 1;
  try {
    failed = call();
  } catch (const abi::__forced_unwind&) {  // the thread is being ended
    throw;
  } catch (const std::bad_alloc&) {  // implies nothing about the shape
    throw;
  } catch (const std::exception& error) {
    running.reason = error.what();
  } catch (...) {
    running.reason = "an exception without a text";
  }
  if (failed == 0) return;
  complain(std::string(function) + " failed" + (running.reason.empty() ? "" : ": ") +
           running.reason);
}

void CustomSupport::check(const Coordinates& n, const Coordinates& point) const {
  if (!is_finite(point))
    return complain("the support function returned a point that is not finite, " + text_of(point) +
                    ", along " + text_of(n));
  const double reach = dot(n, point) + allowed_;
  // Numbers that are as wide as what is compared make one loop of packets.
  std::int64_t wrong = 0;
  for (std::size_t i = 0; i < probes_.h.size(); ++i) {
    const double of_probe = n[0] * probes_.x[i] + n[1] * probes_.y[i] + n[2] * probes_.z[i];
    const double beyond =
        probes_.nx[i] * point[0] + probes_.ny[i] * point[1] + probes_.nz[i] * point[2];
    wrong += of_probe > reach ? 1 : 0;
    wrong += beyond > probes_.h[i] ? 1 : 0;
  }
  if (has_bounds_ && !probes_.h.empty()) {
    for (int k = 0; k < 3; ++k) {
      const double x = point[static_cast<std::size_t>(k)];
      if (x < bounds_.lower[k] - allowed_ || x > bounds_.upper[k] + allowed_)
        return complain("the support function answered " + text_of(point) + ", outside its bounds");
    }
  }
  if (wrong == 0) return;
  for (std::size_t i = 0; i < probes_.h.size(); ++i)
    compare({n[0], n[1], n[2]}, {point[0], point[1], point[2]},
            {probes_.nx[i], probes_.ny[i], probes_.nz[i]},
            {probes_.x[i], probes_.y[i], probes_.z[i]});
}

void CustomSupport::compare(const Vec3<double>& n, const Vec3<double>& along_n,
                            const Vec3<double>& m, const Vec3<double>& along_m) const {
  const auto plain = [](const Vec3<double>& v) { return Coordinates{v.x(), v.y(), v.z()}; };
  const double beyond_n = n.dot(along_m - along_n), beyond_m = m.dot(along_n - along_m);
  if (beyond_n > allowed_)
    complain(contradiction(plain(n), plain(along_n), plain(along_m), beyond_n));
  if (beyond_m > allowed_)
    complain(contradiction(plain(m), plain(along_m), plain(along_n), beyond_m));
}

void CustomSupport::complain(const std::string& what) const {
  const std::lock_guard lock(mutex_);
  if (complaint_.empty()) complaint_ = what;
  lied_.store(true, std::memory_order_release);
}

void refuse_running(const std::vector<std::shared_ptr<const CustomSupport>>& customs,
                    const char* argument) {
  for (const Running* one = Running::innermost(); one; one = one->outer)
    for (const auto& custom : customs)
      if (custom.get() == &one->custom)
        wrong_use(std::string(argument) +
                  ": must not be queried from within its own support function");
}

void keep_support_failure(const char* reason) {
  if (Running* const running = Running::innermost()) running->reason = reason ? reason : "";
}

std::string CustomSupport::complaint() const {
  const std::lock_guard lock(mutex_);
  return complaint_;
}

}  // namespace minkray
