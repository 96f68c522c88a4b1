// SPDX-License-Identifier: MIT
#include "renderer/query/pair_body.h"

#include <stdexcept>
#include <string>

#include "core/derived/triangle_of.h"
#include "core/mesh/mapped.h"

namespace minkray {

PairBody::PairBody(const QueryBody& body, const ImpactMotion& motion)
    : body_(body), motion_{{Mat3<double>::Identity(), motion.pivot}, motion.velocity, motion.turn} {
  if (!body.mesh) {
    shape_.emplace(body.shape, Affine<double>{Mat3<double>::Identity(), -motion.pivot});
    return;
  }
  // The frame's origin is the pivot; a mesh that does not turn may keep its own.
  const bool turns = !motion.turn.isZero(0) && motion.pivot != body.pose.translation;
  if (keeps_lengths(body.pose.linear) && !turns) {
    mesh_ = body.mesh;
    motion_.pose = body.pose;
  } else {
    try {
      mesh_ = mapped(*body.mesh, {body.pose.linear, body.pose.translation - motion.pivot});
    } catch (const std::invalid_argument& error) {
      throw std::runtime_error(std::string("a transformed mesh's ") + error.what());
    }
  }
}

Shape PairBody::part(std::uint32_t number) const {
  return body_.mesh ? posed_triangle(*body_.mesh, number, body_.pose) : body_.shape;
}

Shape posed_triangle(const TriangleMesh& mesh, std::uint32_t number, const Affine<double>& pose) {
  return triangle_of(pose(mesh.corner(number, 0)), pose(mesh.corner(number, 1)),
                     pose(mesh.corner(number, 2)));
}

}  // namespace minkray
