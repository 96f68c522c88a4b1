// SPDX-License-Identifier: MIT
// MuJoCo before 3.1 returns distances only as contacts with a margin. Its function for the pair of
// shapes is called directly.
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "bench/contact/peers.h"

namespace minkray::bench {
namespace {

using Rows = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

struct World {
  mjModel* model = nullptr;
  mjData* data = nullptr;
  /// Meshes are in their own principal frame, which leads to that of their vertices.
  Mat3<double> turn[2];
  Vec3<double> middle[2];

  World() = default;
  World(const World&) = delete;
  ~World() {
    if (data) mj_deleteData(data);
    if (model) mj_deleteModel(model);
  }
  void place(int geom, const Affine<double>& pose) {
    Eigen::Map<Vec3<double>>(data->geom_xpos + 3 * geom) = pose(middle[geom]);
    Eigen::Map<Rows>(data->geom_xmat + 9 * geom) = pose.linear * turn[geom];
  }
};

std::shared_ptr<World> load(const Everybody& a, const Everybody& b) {
  std::string assets, bodies;
  for (const Everybody* body : {&a, &b}) {
    const std::string name = bodies.empty() ? "A" : "B";
    std::string geom = body->mujoco;
    if (!body->mujoco_mesh.empty()) {
      geom.replace(geom.find("MESH"), 4, name);
      assets += "<mesh name=\"" + name + "\" vertex=\"" + body->mujoco_mesh + "\"/>";
    }
    bodies += "<body><freejoint/><inertial pos=\"0 0 0\" mass=\"1\" diaginertia=\"1 1 1\"/><geom " +
              geom + "/></body>";
  }
  const std::string text =
      "<mujoco><asset>" + assets + "</asset><worldbody>" + bodies + "</worldbody></mujoco>";
  auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  mj_makeEmptyFileVFS(files.get(), "m.xml", static_cast<int>(text.size() + 1));
  std::memcpy(files->filedata[mj_findFileVFS(files.get(), "m.xml")], text.c_str(), text.size() + 1);
  char why[500] = "";
  auto world = std::make_shared<World>();
  world->model = mj_loadXML("m.xml", files.get(), why, sizeof why);
  mj_deleteVFS(files.get());
  if (!world->model) throw std::runtime_error(why);
  world->data = mj_makeData(world->model);
  mj_forward(world->model, world->data);
  for (int geom = 0; geom < 2; ++geom) {
    double turn[9];
    mju_quat2Mat(turn, world->model->geom_quat + 4 * geom);
    world->turn[geom] = Eigen::Map<Rows>(turn);
    world->middle[geom] = Eigen::Map<Vec3<double>>(world->model->geom_pos + 3 * geom);
  }
  return world;
}

}  // namespace

std::vector<Contestant> mujoco_contacts(const Asked& asked, double margin) {
  if (asked.a.mujoco.empty() || asked.b.mujoco.empty()) return {};
  const auto world = load(asked.a, asked.b);
  const int* types = world->model->geom_type;
  // There are functions for pairs of types in ascending order.
  const int first = types[0] <= types[1] ? 0 : 1, second = 1 - first;
  const mjfCollision collide = mjCOLLISIONFUNC[types[first]][types[second]];
  if (!collide) return {};
  return {{"MuJoCo", [=, &asked](std::size_t i) {
             world->place(0, asked.where[i].a);
             world->place(1, asked.where[i].b);
             mjContact contacts[mjMAXCONPAIR];
             const int count = collide(world->model, world->data, contacts, first, second, margin);
             double least = count > 0 ? contacts[0].dist : no_answer;
             for (int k = 1; k < count; ++k) least = std::min(least, contacts[k].dist);
             return least;
           }}};
}

}  // namespace minkray::bench
