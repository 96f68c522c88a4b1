// SPDX-License-Identifier: MIT
#include "renderer/clearance/swept_scene.h"

#include <algorithm>
#include <cmath>

#include "core/pair/contact_shape.h"
#include "core/pair_motion/swept.h"
#include "renderer/import/model/mesh_hull.h"
#include "renderer/scene/framing.h"

namespace minkray {

Scene swept_scene(Model model, const ImportOptions& import, const JointPath& path,
                  const SweptSceneOptions& options, Mistakes& mistakes) {
  Scene scene = scene_of(model, import, {});
  scene.description += ", swept along a path";
  std::vector<Object> objects;
  const std::vector<bool> wanted = chosen_geoms(model, import.geometry);
  std::size_t next = 0;
  for (std::size_t i = 0; i < model.geoms.size(); ++i) {
    if (!wanted[i]) continue;
    const ModelGeom& geom = model.geoms[i];
    const Object& posed = scene.objects[next++];
    if (geom.link < 0 || geom.touches_as_half_space()) {
      objects.push_back(posed);
      continue;
    }
    // The region swept by a mesh is within that swept by its hull.
    const Shape shape = geom.mesh ? hull_of(*geom.mesh) : *geom.shape;
    const ContactShape ball(shape, geom.pose);
    const double reach = ball.middle().norm() + ball.ball_radius();
    bool stands_there = false;
    for (std::size_t step = 0; step < path.steps(); ++step) {
      StepMotion motion(path, step);
      const MotionBound bound = motion.bound(geom.link, -1, reach);
      if (!bound.is_within_numbers()) {
        mistakes.add("step " + std::to_string(step + 1) + " of the path moves \"" + posed.name +
                     "\" further than numbers reach");
        return scene;
      }
      const auto pose = [&](double s) {
        return motion.links_at(s)[static_cast<std::size_t>(geom.link)] * geom.pose;
      };
      Object object = posed;
      object.mesh = nullptr;
      object.shape = shape;
      if (bound.speed == 0) {
        object.pose = pose(0);
        if (!stands_there) objects.push_back(object);
        stands_there = true;
        continue;
      }
      stands_there = false;
      // A part of 1 / n of the step accelerates by 1 / n^2 as much in its own time.
      const double slack = options.slack * ball.ball_radius();
      const double wish = slack > 0 ? std::ceil(std::sqrt(bound.acceleration / (8 * slack))) : 1;
      const auto parts =
          static_cast<std::size_t>(std::clamp(wish, 1.0, static_cast<double>(options.most_parts)));
      if (objects.size() + parts > options.most_bodies) {
        mistakes.add("the path sweeps more than " + std::to_string(options.most_bodies) +
                     " shapes");
        return scene;
      }
      const auto n = static_cast<double>(parts);
      for (std::size_t part = 0; part < parts; ++part) {
        const double from = static_cast<double>(part) / n, to = static_cast<double>(part + 1) / n;
        object.name = posed.name + " step " + std::to_string(step + 1) +
                      (parts > 1 ? "." + std::to_string(part + 1) : "");
        object.shape = swept(shape, pose(from), pose(to), bound.acceleration / (n * n));
        object.pose = {};
        objects.push_back(object);
      }
    }
  }
  scene.objects = std::move(objects);
  frame_everything(scene, import.picture);
  return scene;
}

}  // namespace minkray
