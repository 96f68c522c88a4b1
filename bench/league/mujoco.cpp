// SPDX-License-Identifier: MIT
// MuJoCo: rays of its shapes; distances as contacts with a margin, which is how it gives them
// before 3.1.
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <sstream>
#include <stdexcept>

#include "bench/league/adapter.h"

namespace {

using namespace league;

struct World {
  mjModel* model = nullptr;
  mjData* data = nullptr;
  ~World() {
    if (data) mj_deleteData(data);
    if (model) mj_deleteModel(model);
  }
};

std::string numbers(const Vec& v) {
  std::ostringstream text;
  text.precision(17);
  text << v[0] << ' ' << v[1] << ' ' << v[2];
  return text.str();
}

/// The geom's attributes; nothing for what MuJoCo does not have.
std::string geom_of(const Solid& solid, const std::string& mesh, std::string& assets) {
  switch (solid.kind) {
    case Kind::sphere:
      return "type=\"sphere\" size=\"" + numbers({solid.sizes[0], 0, 0}) + "\"";
    case Kind::capsule:
      return "type=\"capsule\" size=\"" + numbers({solid.sizes[0], solid.sizes[1], 0}) + "\"";
    case Kind::cylinder:
      return "type=\"cylinder\" size=\"" + numbers({solid.sizes[0], solid.sizes[1], 0}) + "\"";
    case Kind::box:
      return "type=\"box\" size=\"" + numbers(solid.sizes) + "\"";
    case Kind::ellipsoid:
      return "type=\"ellipsoid\" size=\"" + numbers(solid.sizes) + "\"";
    case Kind::hull:
      if (hull_triangles(solid.points).empty()) return {};
      assets += "<mesh name=\"" + mesh + "\" vertex=\"";
      for (const Vec& p : solid.points) assets += numbers(p) + " ";
      assets += "\"/>";
      return "type=\"mesh\" mesh=\"" + mesh + "\"";
    default:
      return {};
  }
}

std::shared_ptr<World> load(const Query& query, double margin) {
  std::string assets, bodies;
  const bool has_two = query.asked != Asked::ray;
  for (const Solid* solid : {&query.a, &query.b}) {
    if (solid == &query.b && !has_two) break;
    const std::string name = solid == &query.a ? "a" : "b", geom = geom_of(*solid, name, assets);
    if (geom.empty()) return nullptr;
    double w = 1;
    const Vec q = quaternion_xyz(solid->turn, w);
    std::ostringstream turn;
    turn.precision(17);
    turn << w << ' ' << numbers(q);
    bodies +=
        "<body pos=\"" + numbers(solid->at) + "\" quat=\"" + turn.str() +
        "\"><freejoint/><inertial pos=\"0 0 0\" mass=\"1\" diaginertia=\"1 1 1\"/><geom margin=\"" +
        std::to_string(margin) + "\" " + geom + "/></body>";
  }
  const std::string text =
      "<mujoco><compiler convexhull=\"true\" boundmass=\"1e-6\" boundinertia=\"1e-9\"/><option "
      "mpr_tolerance=\"1e-9\" mpr_iterations=\"1000\"/><asset>" +
      assets + "</asset><worldbody>" + bodies + "</worldbody></mujoco>";
  auto vfs = std::make_unique<mjVFS>();
  mj_defaultVFS(vfs.get());
  mj_makeEmptyFileVFS(vfs.get(), "m.xml", static_cast<int>(text.size() + 1));
  std::memcpy(vfs->filedata[mj_findFileVFS(vfs.get(), "m.xml")], text.c_str(), text.size() + 1);
  char why[500] = "";
  auto world = std::make_shared<World>();
  world->model = mj_loadXML("m.xml", vfs.get(), why, sizeof why);
  mj_deleteVFS(vfs.get());
  if (!world->model) throw std::runtime_error(why);
  world->data = mj_makeData(world->model);
  mj_forward(world->model, world->data);
  return world;
}

Ask prepare(const Query& query) {
  if (query.asked == Asked::shape) return [] { return unsupported("MuJoCo casts no shapes"); };
  const double most = 4 * query.size;
  const auto world = load(query, query.asked == Asked::ray ? 0 : most);
  if (!world) return [] { return unsupported("MuJoCo has no such shape"); };
  if (query.asked == Asked::ray)
    return [=, o = query.origin, d = query.direction, t_max = query.t_max] {
      int geom = -1;
      const double t = mj_ray(world->model, world->data, o.data(), d.data(), nullptr, 1, -1, &geom);
      return t < 0 || t > t_max ? miss() : hit(t);
    };
  return [=, is_signed = query.asked == Asked::signed_distance] {
    // Overlaps without a margin; then the smallest that shows a contact: the larger it is, the less
    // exact are distances of convex shapes.
    for (double margin = 0; margin <= most; margin = std::max(1e-4 * most, 2 * margin)) {
      std::fill_n(world->model->geom_margin, world->model->ngeom, margin);
      mj_collision(world->model, world->data);
      if (world->data->ncon == 0) continue;
      double least = most;
      for (int i = 0; i < world->data->ncon; ++i)
        least = std::min(least, world->data->contact[i].dist);
      return at_distance(is_signed ? least : std::max(0.0, least));
    }
    return Answer{Answer::Status::separated};
  };
}

void say_nothing(const char*) {}

void fail(const char* why) {
  throw std::runtime_error(why);
}

}  // namespace

int main(int argc, char** argv) {
  mju_user_warning = say_nothing;
  mju_user_error = fail;
  return serve(
      argc, argv,
      {{"mujoco", mj_versionString(),
        "double; mj_ray; distances: the nearest contact, with the smallest margin that shows one; "
        "mpr_tolerance 1e-9, 1000 iterations",
        prepare}});
}
