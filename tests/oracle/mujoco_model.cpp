// SPDX-License-Identifier: MIT
#include "tests/oracle/mujoco_model.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <limits>

namespace minkray::testing {

struct MujocoModel::Parts {
  mjModel* model = nullptr;
  mjData* data = nullptr;
  ~Parts() {
    if (data) mj_deleteData(data);
    if (model) mj_deleteModel(model);
  }
};

MujocoModel::MujocoModel(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
MujocoModel::~MujocoModel() = default;

std::unique_ptr<MujocoModel> MujocoModel::load(const std::string& file, std::string& why) {
  char message[1000] = "";
  auto parts = std::make_unique<Parts>();
  parts->model = mj_loadXML(file.c_str(), nullptr, message, sizeof message);
  why = message;
  if (!parts->model) return nullptr;
  // Disables contacts and constraints, whose memory would be cleared each time.
  parts->model->nconmax = parts->model->njmax = 0;
  parts->model->nstack = std::min(parts->model->nstack, 1 << 16);
  parts->data = mj_makeData(parts->model);
  mj_kinematics(parts->model, parts->data);
  return std::unique_ptr<MujocoModel>(new MujocoModel(std::move(parts)));
}

std::vector<MujocoModel::Geom> MujocoModel::geoms() const {
  static constexpr const char* kinds[] = {"plane",     "hfield",   "sphere", "capsule",
                                          "ellipsoid", "cylinder", "box",    "mesh"};
  const mjModel& m = *parts_->model;
  std::vector<Geom> geoms;
  for (int i = 0; i < m.ngeom; ++i) {
    Geom geom;
    geom.kind = kinds[m.geom_type[i]];
    geom.size = {m.geom_size[3 * i], m.geom_size[3 * i + 1], m.geom_size[3 * i + 2]};
    if (const char* name = mj_id2name(&m, mjOBJ_GEOM, i)) geom.name = name;
    const mjtNum *at = parts_->data->geom_xpos + 3 * i, *turned = parts_->data->geom_xmat + 9 * i;
    geom.pose.translation = {at[0], at[1], at[2]};
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column)
        geom.pose.linear(row, column) = turned[3 * row + column];
    const int mesh = m.geom_type[i] == mjGEOM_MESH ? m.geom_dataid[i] : -1;
    for (int v = 0; mesh >= 0 && v < m.mesh_vertnum[mesh]; ++v) {
      const float* vertex = m.mesh_vert + 3 * (m.mesh_vertadr[mesh] + v);
      geom.vertices.emplace_back(vertex[0], vertex[1], vertex[2]);
    }
    geoms.push_back(std::move(geom));
  }
  return geoms;
}

void MujocoModel::set_positions(const std::vector<double>& qpos) {
  mj_resetData(parts_->model, parts_->data);
  std::copy(qpos.begin(), qpos.end(), parts_->data->qpos);
  mj_kinematics(parts_->model, parts_->data);
}

std::size_t MujocoModel::positions() const {
  return static_cast<std::size_t>(parts_->model->nq);
}

std::size_t MujocoModel::bodies() const {
  return static_cast<std::size_t>(parts_->model->nbody);
}

std::size_t MujocoModel::keyframes() const {
  return static_cast<std::size_t>(parts_->model->nkey);
}

std::vector<double> MujocoModel::keyframe(std::size_t i) const {
  const mjtNum* values = parts_->model->key_qpos + i * positions();
  return {values, values + positions()};
}

double MujocoModel::ray(const Ray<double>& ray, int& geom) const {
  int id = -1;
  const mjtNum t = mj_ray(parts_->model, parts_->data, ray.origin.data(), ray.direction.data(),
                          nullptr, 1, -1, &id);
  geom = id;
  return t < 0 ? std::numeric_limits<double>::infinity() : t;
}

}  // namespace minkray::testing
