// SPDX-License-Identifier: MIT
#include "renderer/lights/emitters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/exact/ball.h"
#include "renderer/rays/frame.h"

namespace minkray {
namespace {

constexpr std::uint32_t no_emitter = std::numeric_limits<std::uint32_t>::max();

/// Up to this number, emitters are weighted one by one at each point, by brightness, size and
/// distance; more are chosen by a tree.
constexpr std::size_t most_weighed = 16;

/// Least thickness of a flat body's ellipsoid, over its largest radius: directions that meet a
/// body edge-on must still be distinguishable from those that pass it.
constexpr double least_thickness = 1e-6;

/// 1 - cos of the half angle under which the unit ball is seen from squared distance d2 > 1, in the
/// form that does not cancel.
double cone_height(double d2) {
  return (1 / d2) / (1 + std::sqrt(1 - 1 / d2));
}

/// Factor by which an ellipsoid with these half axes, around the middle of the shape's bounding
/// ball, must grow to hold the support points of many directions, and a little more.
double growth_to_hold(const ShapeDefinition& shape, const Vec3<double>& axes) {
  constexpr int directions = 512;
  constexpr double golden_turn = 2.399963229728653, margin = 1.01;
  double farthest = 0;
  for (int i = 0; i < directions; ++i) {
    const double z = 1 - (2 * i + 1.0) / directions, radius = std::sqrt(1 - z * z);
    const Vec3<double> m(radius * std::cos(golden_turn * i), radius * std::sin(golden_turn * i), z);
    const Vec3<double> point = shape.inner_shape().support(Vec3<double>(m.cwiseQuotient(axes))) -
                               shape.inner_ball().centre;
    farthest = std::max(farthest, point.cwiseQuotient(axes).norm());
  }
  return margin * farthest;
}

/// The half axes of an ellipsoid about the shape, in its inner frame: what little may look out of
/// it is found by other rays.
Vec3<double> half_axes(const ShapeDefinition& shape) {
  const exact::Form& form = shape.form();
  if (form.kind == exact::BallForm::kind && !form.is_off_centre)
    return form.R * form.scale.cwiseInverse();
  // As long as its box, flat where that is flat.
  const Vec3<double>& box = shape.inner_half_extents();
  const double least = least_thickness * box.maxCoeff();
  Vec3<double> axes = box.cwiseMax(least);
  const double growth = growth_to_hold(shape, axes);
  for (int i = 0; i < 3; ++i)
    if (axes[i] > least) axes[i] *= growth;
  // Or as wide as a ball.
  Vec3<double> ball = Vec3<double>::Ones();
  ball *= growth_to_hold(shape, ball);
  for (int i = 0; i < 3; ++i)
    if (!(axes[i] > least)) ball[i] = least;
  return ball.prod() < axes.prod() ? ball : axes;
}

/// The mean area of an ellipsoid's shadow over pi (Thomsen's approximation, within 1.1 %).
double shadow_of_ellipsoid(const Vec3<double>& axes) {
  constexpr double p = 1.6075;
  const auto power = [](double x) { return std::pow(x, p); };
  const double a = power(axes.x()), b = power(axes.y()), c = power(axes.z());
  return std::pow((a * b + b * c + c * a) / 3, 1 / p);
}

/// A box casts a shadow of a quarter of its surface, on average; over pi again.
double shadow_of_box(const Vec3<double>& half) {
  return 2 * (half.x() * half.y() + half.y() * half.z() + half.z() * half.x()) / std::numbers::pi;
}

/// The faces of a box that are seen from a point, by the axis they lie across: which they are, and
/// with which chance each is drawn.
struct FacesSeen {
  Vec3<double> chance = Vec3<double>::Zero();

  FacesSeen(const Vec3<double>& half, const Vec3<double>& point) {
    for (int axis = 0; axis < 3; ++axis) {
      const double above = std::abs(point[axis]) - half[axis];
      if (!(above > 0)) continue;
      // About its solid angle: of the point of the face that is nearest, softened by its size.
      const double area = face_area(half, axis);
      Vec3<double> to_face = point.cwiseAbs() - half;
      to_face = to_face.cwiseMax(0.0);
      const double d2 = to_face.squaredNorm() + 0.25 * area;
      chance[axis] = area * (above + 0.1 * std::sqrt(area)) / (d2 * std::sqrt(d2));
    }
    const double sum = chance.sum();
    if (sum > 0) chance /= sum;
  }

  static double face_area(const Vec3<double>& half, int axis) {
    return 4 * half[(axis + 1) % 3] * half[(axis + 2) % 3];
  }
  bool any() const { return chance.maxCoeff() > 0; }
};

/// The face through which a line from outside enters a box, and how far away that is; -1: none.
std::pair<int, double> entered_face(const Vec3<double>& half, const Vec3<double>& origin,
                                    const Vec3<double>& direction) {
  for (int axis = 0; axis < 3; ++axis) {
    const double side = origin[axis] > 0 ? 1 : -1;
    const double above = side * origin[axis] - half[axis], fall = -side * direction[axis];
    if (!(above > 0) || !(fall > 0)) continue;
    const double t = above / fall;
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    if (std::abs(origin[u] + t * direction[u]) <= half[u] &&
        std::abs(origin[v] + t * direction[v]) <= half[v])
      return {axis, t};
  }
  return {-1, 0};
}

}  // namespace

std::optional<Vec3<double>> AroundBody::sample(const Vec3<double>& point,
                                               const std::array<double, 2>& u) const {
  const Vec3<double> towards = map * (centre - point);
  if (is_box()) {
    const FacesSeen faces(half_extents, -towards);
    if (!faces.any()) return std::nullopt;
    // The first number chooses the face, and what is left of it a place on it.
    int axis = 0;
    double left = u[0];
    while (axis < 2 && left >= faces.chance[axis]) left -= faces.chance[axis++];
    if (!(faces.chance[axis] > 0)) return std::nullopt;
    const std::array<double, 2> on_face = {2 * std::min(left / faces.chance[axis], 1.0) - 1,
                                           2 * u[1] - 1};
    const int x = (axis + 1) % 3, y = (axis + 2) % 3;
    Vec3<double> place;
    place[axis] = towards[axis] < 0 ? half_extents[axis] : -half_extents[axis];
    place[x] = on_face[0] * half_extents[x];
    place[y] = on_face[1] * half_extents[y];
    return Vec3<double>((inverse * (place + towards)).normalized());
  }
  const double d2 = towards.squaredNorm();
  if (!(d2 > 1)) return std::nullopt;
  const double below = u[0] * cone_height(d2);  // 1 - cosine
  const double sine = std::sqrt(below * (2 - below)), angle = 2 * std::numbers::pi * u[1];
  const Frame frame(towards / std::sqrt(d2));
  const Vec3<double> drawn =
      frame.to_world({sine * std::cos(angle), sine * std::sin(angle), 1 - below});
  return Vec3<double>((inverse * drawn).normalized());
}

double AroundBody::pdf(const Vec3<double>& point, const Vec3<double>& direction) const {
  const Vec3<double> towards = map * (centre - point), along = map * direction;
  const double stretched = along.norm();
  if (is_box()) {
    const auto [axis, t] = entered_face(half_extents, -towards, along);
    if (axis < 0) return 0;
    const FacesSeen faces(half_extents, -towards);
    const double area = FacesSeen::face_area(half_extents, axis);
    // Solid angle is area * cosine / distance^2, where `along` has the length `stretched`.
    const double per_solid_angle =
        t * t * stretched * stretched * stretched / std::abs(along[axis]);
    return faces.chance[axis] / area * per_solid_angle * determinant /
           (stretched * stretched * stretched);
  }
  const double d2 = towards.squaredNorm();
  if (!(d2 > 1)) return 0;
  if (!(towards.cross(along).norm() <= stretched) || !(towards.dot(along) > 0)) return 0;
  return determinant / (2 * std::numbers::pi * cone_height(d2) * stretched * stretched * stretched);
}

AroundBody around(const PreparedShape& body) {
  const Vec3<double> axes = half_axes(body.definition());
  AroundBody result;
  result.centre = body.centre();
  const Vec3<double> box = body.definition().inner_half_extents();
  const bool is_thick = box.minCoeff() > least_thickness * box.maxCoeff();
  if (is_thick && shadow_of_box(box) < shadow_of_ellipsoid(axes)) result.half_extents = box;
  result.map = Mat3<double>::Identity();
  if (!result.is_box()) result.map = axes.cwiseInverse().asDiagonal();
  const Mat3<double>* linear = body.linear_to_inner();
  if (linear) result.map = result.map * *linear;
  result.inverse = result.map.inverse();
  result.determinant = std::abs(result.map.determinant());
  // The two larger half axes in the world, as if it were not sheared.
  const double scale = linear ? std::cbrt(1 / std::abs(linear->determinant())) : 1;
  result.size2 = scale * scale * axes.prod() / axes.minCoeff();
  return result;
}

Emitters::Emitters(const World& world, const std::vector<Colour>& radiance_of_instance,
                   const RadianceOfPart& radiance_of_part)
    : world_(world) {
  std::vector<LightTree::Light> lights;
  for (std::size_t i = 0; i < radiance_of_instance.size(); ++i) {
    const Colour& radiance = radiance_of_instance[i];
    if (radiance_of_part && world.instances().is_mesh(i))
      add_mesh(static_cast<std::uint32_t>(i), radiance_of_part, lights);
    // Bodies that are unbounded or without size are found by chance alone.
    if (!(radiance.maxCoeff() > 0) || !world.instances().has_shape(i)) continue;
    const PreparedShape body = world.instances().at(i);
    if (!(body.inner_ball().radius > 0)) continue;
    Emitter& emitter = emitters_.emplace_back(
        Emitter{static_cast<std::uint32_t>(i), radiance, around(body), 0, nullptr});
    emitter.power = radiance.mean() * emitter.body.size2;
    const double radius = world.instances().half_extent(i);
    lights.push_back({emitter.body.centre, radius, emitter.power});
    number_last(radiance_of_instance.size());
  }
  if (emitters_.size() > most_weighed) tree_ = LightTree(lights);
}

void Emitters::add_mesh(std::uint32_t instance, const RadianceOfPart& radiance_of_part,
                        std::vector<LightTree::Light>& lights) {
  const PosedMesh& mesh = world_.instances().mesh_of(instance);
  const auto brightness = [&](std::uint32_t part) {
    return radiance_of_part(instance, part).mean();
  };
  bool shines = false;
  for (std::uint32_t part = 0; part < mesh.mesh->size() && !shines; ++part)
    shines = brightness(part) > 0;
  if (!shines) return;
  auto lamp = std::make_unique<const MeshLamp>(mesh, brightness);
  if (lamp->none()) return;
  AroundBody body;
  body.centre = lamp->centre();
  body.map = body.inverse = Mat3<double>::Identity();
  body.determinant = 1;
  body.size2 = lamp->size2();
  lights.push_back({lamp->centre(), lamp->radius(), lamp->power()});
  const double power = lamp->power();
  emitters_.emplace_back(Emitter{instance, Colour::Zero(), body, power, std::move(lamp)});
  number_last(world_.instances().size());
}

void Emitters::number_last(std::size_t instances) {
  of_instance_.resize(instances, no_emitter);
  of_instance_[emitters_.back().instance] = static_cast<std::uint32_t>(emitters_.size() - 1);
}

/// The point relative to the emitter, in coordinates of time 0.
Vec3<double> Emitters::seen_from(const Emitter& emitter, const Vec3<double>& point,
                                 double time) const {
  return world_.instances().seen_by(emitter.instance, point, time);
}

double Emitters::weight(const Emitter& emitter, const Vec3<double>& point, double time) const {
  const double d2 = (emitter.body.centre - seen_from(emitter, point, time)).squaredNorm();
  return emitter.power / std::max(d2, emitter.body.size2);
}

std::optional<EmitterSample> Emitters::sample(const Vec3<double>& point, double time,
                                              Sampler& sampler) const {
  const double which = sampler.next()[0];
  const std::array<double, 2> u = sampler.next();
  std::size_t chosen = 0;
  if (!tree_.empty()) {
    chosen = tree_.choose(point, which);
  } else if (emitters_.size() > 1) {
    std::array<double, most_weighed> up_to;
    double sum = 0;
    for (std::size_t i = 0; i < emitters_.size(); ++i)
      up_to[i] = sum += weight(emitters_[i], point, time);
    while (chosen + 1 < emitters_.size() && up_to[chosen] <= which * sum) ++chosen;
  }
  const Emitter& emitter = emitters_[chosen];
  const Vec3<double> from = seen_from(emitter, point, time);
  EmitterHit at{emitter.instance};
  std::optional<Vec3<double>> seen;
  if (!emitter.mesh) {
    seen = emitter.body.sample(from, u);
  } else if (const auto found = emitter.mesh->sample(from, sampler.next()[0], u)) {
    seen = found->direction;
    at.part = found->part;
    at.t = found->distance;
  }
  if (!seen) return std::nullopt;
  const Vec3<double> direction = world_.instances().turned(emitter.instance, *seen, time);
  const double density = pdf(point, time, direction, at);
  if (!(density > 0)) return std::nullopt;
  return EmitterSample{chosen, direction, density, at.part};
}

double Emitters::pdf(const Vec3<double>& point, double time, const Vec3<double>& direction,
                     const EmitterHit& hit) const {
  if (of_instance_.empty() || of_instance_[hit.instance] == no_emitter) return 0;
  const Emitter& emitter = emitters_[of_instance_[hit.instance]];
  double chance = 1;
  if (!tree_.empty()) {
    chance = tree_.chance(point, of_instance_[hit.instance]);
  } else if (emitters_.size() > 1) {
    double sum = 0;
    for (const Emitter& other : emitters_) sum += weight(other, point, time);
    chance = weight(emitter, point, time) / sum;
  }
  const Vec3<double> from = seen_from(emitter, point, time);
  const Vec3<double> seen = world_.instances().unturned(hit.instance, direction, time);
  return chance * (emitter.mesh ? emitter.mesh->pdf(from, seen, hit.part, hit.t)
                                : emitter.body.pdf(from, seen));
}

}  // namespace minkray
