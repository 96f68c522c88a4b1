// SPDX-License-Identifier: MIT
// Rays at scenes, compared with Embree's: all in one call, and one by one.
#include <algorithm>
#include <optional>

#include "embree.h"
#include "rays.h"
#include "sections.h"

namespace bench {
namespace {

constexpr double mesh_error = 1e-4;  ///< of a shape's radius
constexpr double single_goal = 1.2;

struct SceneRow {
  std::string kind;
  std::size_t objects;
  double scattered, camera;  ///< the goals; 0: none
  bool own_spheres = false;  ///< compared with Embree's spheres, not triangles
  double scattered_shadows = 0, light_shadows = 0;
  bool flat = false;  ///< also compared with one geometry of all triangles; no goal
};

const std::vector<SceneRow> scene_rows = {
    {"rounded boxes", 100'000, 2.0, 1.8, false, 1.8, 1.2},
    {"spheres", 100'000, 1.1, 1.9, true},
    {"ellipsoids", 100'000, 4.5, 4.5},
    {"hulls of 16", 100'000, 2.5, 1.7, false, 0, 0, true},
    {"hulls of 64", 100'000, 1.4, 1.3},
    {"eight kinds", 100'000, 2.0, 1.5},
    {"rounded boxes", 1'000'000, 2.4, 0},
    {"rounded boxes", 10'000, 1.4, 0},
};

std::string name_of(const SceneRow& row) {
  return with_commas(row.objects) + " " + row.kind;
}

/// A subject and everyone's scene of it.
class Arena {
 public:
  Arena(Table& table, const Options& options, const SceneRow& row)
      : table_(table),
        options_(options),
        row_(row),
        subject_(make_subject(row.kind, row.objects)),
        ours_(scene_of(subject_)),
        meshes_(meshes()),
        triangles_(EmbreeScene::instances(subject_, meshes_)) {
    if (row.own_spheres) spheres_.emplace(EmbreeScene::spheres(subject_));
    if (row.flat) flat_.emplace(EmbreeScene::flat(subject_, meshes_[0]));
  }

  void run() {
    const std::vector<mk::Ray> camera = camera_rays(subject_, options_.side);
    std::vector<mk::Hit> hits(camera.size());
    ours_.cast(camera, hits, {.threads = 1});
    std::size_t arrived = 0;
    for (const mk::Hit& hit : hits) arrived += hit.status == mk::hit;
    const std::vector<mk::Ray> scattered = scattered_rays(subject_, camera, hits, arrived);
    first_hits("scattered", scattered, row_.scattered, false);
    first_hits("camera", camera, row_.camera, true);
    if (row_.scattered_shadows > 0)
      shadows("occlusion, scattered", scattered, row_.scattered_shadows, false);
    if (row_.light_shadows > 0)
      shadows("occlusion, towards a light", light_rays(subject_, camera, hits), row_.light_shadows,
              true);
  }

 private:
  std::vector<Mesh> meshes() const {
    std::vector<Mesh> all;
    for (const Body& body : subject_.bodies) all.push_back(body.mesh(mesh_error));
    return all;
  }
  /// A length: that of the largest body.
  double error() const {
    double largest = 0;
    for (const Body& body : subject_.bodies) largest = std::max(largest, body.radius);
    return mesh_error * largest;
  }
  /// "Embree's 3,748 triangles, ": of all meshes.
  std::string triangles_name() const {
    std::size_t count = 0;
    for (const Mesh& mesh : meshes_) count += mesh.triangles.size();
    return "Embree's " + with_commas(count) + " triangles, ";
  }
  const EmbreeScene& peer() const { return spheres_ ? *spheres_ : triangles_; }

  void first_hits(const std::string& rays_name, const std::vector<mk::Ray>& rays, double goal,
                  bool coherent) {
    Casters span, single, peers, peer_single, flat;
    span.push_back(minkray_span(ours_, rays, Question::first_hit));
    single.push_back(minkray_single(ours_, rays));
    peer().add_casters(peers, rays, Question::first_hit, coherent);
    peer_single.push_back(triangles_.single(rays));
    if (flat_) flat_->add_casters(flat, rays, Question::first_hit, coherent);
    race({&span, &peers, &single, &peer_single, &flat}, options_.rounds);
    const std::string all = rays_name + ", " + with_commas(rays.size());
    add(all, rays, *span[0], fastest(peers), spheres_ ? "Embree's spheres, " : triangles_name(),
        goal);
    add(rays_name + ", one by one", rays, *single[0], *peer_single[0], triangles_name(),
        single_goal);
    if (flat_)
      add(all, rays, *span[0], fastest(flat), "all Embree's triangles in one geometry, ", 0);
    if (hash_of(span[0]->answers()) == hash_of(single[0]->answers())) return;
    Figure different;
    different.what = name_of(row_);
    different.rays = rays_name;
    different.agreement = {false, "one by one and in one call differ"};
    table_.add(different);
  }

  void shadows(const std::string& rays_name, const std::vector<mk::Ray>& rays, double goal,
               bool coherent) {
    Casters ours, peers;
    ours.push_back(minkray_span(ours_, rays, Question::occlusion));
    peer().add_casters(peers, rays, Question::occlusion, coherent);
    race({&ours, &peers}, options_.rounds);
    add(rays_name + ", " + with_commas(rays.size()), rays, *ours[0], fastest(peers),
        triangles_name(), goal);
  }

  void add(const std::string& rays_name, const std::vector<mk::Ray>& rays, const Caster& ours,
           const Caster& peer, const std::string& peer_name, double goal) {
    table_.add(
        Duel{name_of(row_), rays_name, ours, peer, peer_name, rays.size(), goal, Trust{error()}});
  }

  Table& table_;
  const Options& options_;
  const SceneRow& row_;
  Subject subject_;
  mk::Scene ours_;
  std::vector<Mesh> meshes_;
  EmbreeScene triangles_;
  std::optional<EmbreeScene> spheres_, flat_;
};

}  // namespace

std::vector<Section> scene_sections() {
  std::vector<Section> sections;
  for (const SceneRow& row : scene_rows)
    sections.push_back({name_of(row), [&row](Table& table, const Options& options) {
                          Arena(table, options, row).run();
                        }});
  return sections;
}

}  // namespace bench
