// SPDX-License-Identifier: MIT
// Meshes of triangles: rays compared with Embree's robust intersection of the same triangles, and
// distances compared with FCL's.
#include <fcl/fcl.h>

#include <algorithm>
#include <functional>
#include <numbers>

#include "clock.h"
#include "embree.h"
#include "random.h"
#include "sections.h"

namespace bench {
namespace {

constexpr double goal_many = 1.0, goal_few = 0.9, goal_single = 0.8, goal_build = 0.75;
constexpr double goal_distance = 4;

/// Rings of a torus with a radius of 1 and a tube of 0.4, some of them close together: slivers.
Mesh torus_with_slivers(std::size_t triangles) {
  const auto across = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(triangles) / 4));
  const std::uint32_t around = 2 * across;
  Mesh mesh;
  for (std::uint32_t i = 0; i < around; ++i)
    for (std::uint32_t j = 0; j < across; ++j) {
      const double squeezed = i % 8 == 7 ? i - 0.98 : i;
      const double u = 2 * std::numbers::pi * squeezed / around,
                   v = 2 * std::numbers::pi * j / across;
      const double r = 1 + 0.4 * std::cos(v);
      // Floats, so that both libraries get the same.
      const auto rounded = [](double x) { return static_cast<double>(static_cast<float>(x)); };
      mesh.vertices.emplace_back(rounded(r * std::cos(u)), rounded(r * std::sin(u)),
                                 rounded(0.4 * std::sin(v)));
    }
  for (std::uint32_t i = 0; i < around; ++i)
    for (std::uint32_t j = 0; j < across; ++j) {
      const std::uint32_t next = (i + 1) % around, beside = (j + 1) % across;
      mesh.triangles.push_back({i * across + j, next * across + j, next * across + beside});
      mesh.triangles.push_back({i * across + j, next * across + beside, i * across + beside});
    }
  return mesh;
}

mk::Shape ours_of(const Mesh& mesh) {
  std::vector<mk::Vec3> vertices(mesh.vertices.begin(), mesh.vertices.end());
  return mk::mesh(vertices, mesh.triangles);
}

Vec as_floats(const Vec& v) {
  return {double(float(v.x)), double(float(v.y)), double(float(v.z))};
}

/// The rays make a square picture, in blocks of 8 x 8.
std::vector<mk::Ray> camera_at(const Vec& eye, int side) {
  const Vec forward = normalized(-1.0 * eye), right = normalized(cross(forward, {0, 0, 1})),
            up = cross(right, forward);
  std::vector<mk::Ray> rays;
  const auto pixel = [&](int x, int y) {
    const double u = 0.7 * ((x + 0.5) / side - 0.5), v = 0.7 * ((y + 0.5) / side - 0.5);
    rays.push_back({as_floats(eye), as_floats(normalized(forward + u * right + v * up))});
  };
  for (int by = 0; by < side; by += 8)
    for (int bx = 0; bx < side; bx += 8)
      for (int i = 0; i < 64; ++i) pixel(bx + i % 8, by + i / 8);
  return rays;
}

/// From where the rays arrived, to all sides, in random order.
std::vector<mk::Ray> scattered_from(const std::vector<mk::Ray>& rays,
                                    const std::vector<mk::Hit>& hits) {
  Random random(7);
  std::vector<mk::Ray> scattered;
  constexpr double above = 1e-4;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (!hits[i].found()) continue;
    const Vec normal(hits[i].normal);
    const Vec at = Vec(rays[i].origin) + hits[i].t * Vec(rays[i].direction) + above * normal;
    scattered.push_back(
        {as_floats(at), as_floats(normalized(normal + 0.999 * random.direction()))});
  }
  for (std::size_t i = scattered.size(); i > 1; --i)
    std::swap(scattered[i - 1], scattered[random.bits() % i]);
  return scattered;
}

/// Meshes twice: as objects of a scene for Minkray, as one mesh of all triangles for Embree.
struct MeshScene {
  std::string name;
  mk::Scene ours;
  Mesh theirs;
  std::size_t objects = 1;
};

/// As many tori of 14,000 triangles as a robot has parts, along six chains from the middle.
MeshScene robot_of_meshes(int parts) {
  MeshScene scene;
  Random random(3);
  Vec at{0, 0, 0}, towards{0, 0, 0};
  for (int part = 0; part < parts; ++part) {
    constexpr int chains = 6;
    constexpr double size = 0.18, step = 0.24;
    if (part % ((parts + chains - 1) / chains) == 0) {
      at = {0, 0, 0};
      towards = random.direction();
    }
    towards = normalized(towards + 0.5 * random.direction());
    at = at + step * towards;
    mk::Pose pose = mk::pose(at, random.rotation());
    for (auto& row : pose.rows)
      for (int k = 0; k < 3; ++k) row[k] *= size;
    const Mesh mesh = torus_with_slivers(14'000);
    scene.ours.add(ours_of(mesh), pose);
    const auto first = static_cast<std::uint32_t>(scene.theirs.vertices.size());
    for (const Vec& v : mesh.vertices) {
      double placed[3];
      for (int i = 0; i < 3; ++i)
        placed[i] =
            pose.rows[i][0] * v.x + pose.rows[i][1] * v.y + pose.rows[i][2] * v.z + pose.rows[i][3];
      scene.theirs.vertices.emplace_back(placed[0], placed[1], placed[2]);
    }
    for (const auto& t : mesh.triangles)
      scene.theirs.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
  scene.ours.commit();
  scene.objects = static_cast<std::size_t>(parts);
  scene.name = "robot of " + std::to_string(parts) + " meshes, " +
               with_commas(scene.theirs.triangles.size());
  return scene;
}

/// Hills over a square of 4 by 4.
MeshScene terrain(std::uint32_t points) {
  constexpr double size = 4;
  MeshScene scene;
  std::vector<double> heights;
  for (std::uint32_t r = 0; r < points; ++r)
    for (std::uint32_t c = 0; c < points; ++c) {
      const double x = size * (c / (points - 1.0) - 0.5), y = size * (r / (points - 1.0) - 0.5);
      const double height = 0.2 * std::sin(3 * x) * std::cos(2.3 * y) +
                            0.05 * std::sin(11 * x + 3 * y) + 0.01 * std::sin(47 * x - 31 * y);
      heights.push_back(static_cast<double>(static_cast<float>(height)));
      scene.theirs.vertices.emplace_back(x, y, heights.back());
      if (r + 1 == points || c + 1 == points) continue;
      const std::uint32_t corner = r * points + c;
      scene.theirs.triangles.push_back({corner, corner + 1, corner + points + 1});
      scene.theirs.triangles.push_back({corner, corner + points + 1, corner + points});
    }
  scene.ours.add(mk::height_field(heights, points, points, size, size));
  scene.ours.commit();
  scene.name = "terrain of " + std::to_string(points) + " x " + std::to_string(points);
  return scene;
}

std::string name_of_mesh(const Mesh& mesh) {
  return "mesh of " + with_commas(mesh.triangles.size());
}

class MeshArena {
 public:
  MeshArena(Table& table, const Options& options, MeshScene scene)
      : table_(table),
        options_(options),
        scene_(std::move(scene)),
        peer_(EmbreeScene::triangles(scene_.theirs, EmbreeScene::Edges::robust, scene_.objects)) {}

  void run() {
    const std::vector<mk::Ray> camera = camera_at({2.4, 1.7, 1.9}, options_.side);
    std::vector<mk::Hit> hits(camera.size());
    scene_.ours.cast(camera, hits, {.threads = 1});
    rays("camera", camera, true);
    rays("scattered", scattered_from(camera, hits), false);
  }

 private:
  void rays(const std::string& name, const std::vector<mk::Ray>& rays, bool coherent) {
    Casters span, single, peers, peer_single;
    span.push_back(minkray_span(scene_.ours, rays, Question::first_hit));
    single.push_back(minkray_single(scene_.ours, rays));
    peer_.add_casters(peers, rays, Question::first_hit, coherent);
    peer_single.push_back(peer_.single(rays));
    race({&span, &peers, &single, &peer_single}, options_.rounds);
    // A ray next to an edge may meet either triangle, or the surface behind the silhouette.
    const Trust trust{1e-4, 2e-3};
    const double goal = scene_.theirs.triangles.size() > 20'000 ? goal_many : goal_few;
    table_.add(Duel{scene_.name, name + ", " + with_commas(rays.size()), *span[0], fastest(peers),
                    "Embree robust, ", rays.size(), goal, trust});
    table_.add(Duel{scene_.name, name + ", one by one", *single[0], *peer_single[0],
                    "Embree robust, ", rays.size(), goal_single, trust});
  }

  Table& table_;
  const Options& options_;
  MeshScene scene_;
  EmbreeScene peer_;
};

void run_torus(Table& table, const Options& options, std::size_t triangles) {
  MeshScene scene;
  scene.theirs = torus_with_slivers(triangles);
  scene.name = name_of_mesh(scene.theirs);
  double best = INFINITY, best_peer = INFINITY;
  for (int round = 0; round < options.rounds; ++round) {
    const Clock clock;
    mk::Scene ours;
    ours.add(ours_of(scene.theirs));
    ours.commit();
    best = std::min(best, clock.processor());
    best_peer = std::min(best_peer, EmbreeScene::seconds_to_build(scene.theirs));
    scene.ours = std::move(ours);
  }
  char text[2][40];
  std::snprintf(text[0], sizeof text[0], "%.1f ms", 1e3 * best);
  std::snprintf(text[1], sizeof text[1], "Embree's default, %.1f ms", 1e3 * best_peer);
  table.add(Figure{scene.name, "build", text[0], text[1], best_peer / best, goal_build});
  MeshArena(table, options, std::move(scene)).run();
}

// ---- distances ----

using FclMesh = fcl::BVHModel<fcl::OBBRSSd>;

std::shared_ptr<FclMesh> fcl_of(const Mesh& mesh) {
  auto made = std::make_shared<FclMesh>();
  std::vector<fcl::Vector3d> vertices;
  for (const Vec& v : mesh.vertices) vertices.emplace_back(v.x, v.y, v.z);
  std::vector<fcl::Triangle> triangles;
  for (const auto& t : mesh.triangles) triangles.emplace_back(t[0], t[1], t[2]);
  made->beginModel();
  made->addSubModel(vertices, triangles);
  made->endModel();
  return made;
}

fcl::Transform3d fcl_pose(const mk::Pose& pose) {
  fcl::Transform3d result = fcl::Transform3d::Identity();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) result.linear()(i, j) = pose.rows[i][j];
    result.translation()[i] = pose.rows[i][3];
  }
  return result;
}

class OurMeshDistances : public Caster {
 public:
  OurMeshDistances(const mk::Shape& a, const mk::Shape& b, const std::vector<mk::Pose>& poses)
      : Caster("signed_distances"), a_(a), b_(b), poses_(poses), found_(poses.size()) {
    options_.how.threads = 1;
  }
  void cast() override {
    mk::signed_distances({{&a_, 1}, {}, {}}, {{&b_, 1}, poses_, {}}, found_, options_);
  }
  std::vector<Answer> answers() const override {
    std::vector<Answer> all;
    for (const mk::Distance& found : found_) all.push_back({std::max(0.0, found.value), 0});
    return all;
  }

 private:
  const mk::Shape &a_, &b_;
  const std::vector<mk::Pose>& poses_;
  std::vector<mk::Distance> found_;
  mk::PairOptions options_;
};

class FclDistances : public Caster {
 public:
  FclDistances(std::shared_ptr<fcl::CollisionGeometryd> a,
               std::shared_ptr<fcl::CollisionGeometryd> b, const std::vector<mk::Pose>& poses)
      : Caster("distance"), a_(std::move(a)), b_(std::move(b)), answers_(poses.size()) {
    for (const mk::Pose& pose : poses) poses_.push_back(fcl_pose(pose));
  }
  void cast() override {
    const fcl::Transform3d still = fcl::Transform3d::Identity();
    for (std::size_t i = 0; i < poses_.size(); ++i) {
      fcl::DistanceRequestd request;
      request.gjk_solver_type = fcl::GST_INDEP;  // the other is off by a tenth here and there
      fcl::DistanceResultd result;
      fcl::distance(a_.get(), still, b_.get(), poses_[i], request, result);
      answers_[i] = {std::max(0.0, result.min_distance), 0};
    }
  }
  std::vector<Answer> answers() const override { return answers_; }

 private:
  std::shared_ptr<fcl::CollisionGeometryd> a_, b_;
  std::vector<fcl::Transform3d> poses_;
  std::vector<Answer> answers_;
};

/// With random turns, from nearly touching to a radius apart; some overlap.
std::vector<mk::Pose> poses_beside(double size, std::size_t count) {
  Random random(3);
  std::vector<mk::Pose> poses;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec at = (1.4 + size * random.within(0.3, 1.4)) * random.direction();
    poses.push_back(mk::pose(at, random.rotation()));
  }
  return poses;
}

void run_distances(Table& table, const Options& options, std::size_t triangles) {
  const Mesh mesh = torus_with_slivers(triangles);
  const mk::Shape ours = ours_of(mesh), box = mk::box({0.5, 0.3, 0.2});
  const auto theirs = fcl_of(mesh);
  const auto their_box = std::make_shared<fcl::Boxd>(1.0, 0.6, 0.4);
  const std::size_t count = std::min<std::size_t>(options.queries, 50);
  const auto duel = [&](const std::string& what, const mk::Shape& other,
                        const std::shared_ptr<fcl::CollisionGeometryd>& their_other,
                        const std::vector<mk::Pose>& poses) {
    Casters mine, peers;
    mine.push_back(std::make_unique<OurMeshDistances>(ours, other, poses));
    peers.push_back(std::make_unique<FclDistances>(theirs, their_other, poses));
    race({&mine, &peers}, std::min(options.rounds, 3));
    table.add(Duel{name_of_mesh(mesh), what + ", " + with_commas(poses.size()), *mine[0], *peers[0],
                   "FCL, ", poses.size(), goal_distance, Trust{1e-6, 0.02}});
  };
  duel("distances to a box", box, their_box, poses_beside(0.6, count));
  duel("distances to itself", ours, theirs, poses_beside(1.4, count));
}

}  // namespace

std::vector<Section> mesh_sections() {
  std::vector<Section> sections;
  for (const std::size_t count : {10'000, 100'000, 1'000'000})
    sections.push_back(
        {"mesh of " + with_commas(count),
         [count](Table& table, const Options& options) { run_torus(table, options, count); }});
  sections.push_back({"robot of 50 meshes", [](Table& table, const Options& options) {
                        MeshArena(table, options, robot_of_meshes(50)).run();
                      }});
  sections.push_back({"terrain", [](Table& table, const Options& options) {
                        MeshArena(table, options, terrain(1024)).run();
                      }});
  for (const std::size_t count : {1'000, 10'000, 100'000})
    sections.push_back(
        {"mesh of " + with_commas(count) + ", distances",
         [count](Table& table, const Options& options) { run_distances(table, options, count); }});
  return sections;
}

}  // namespace bench
