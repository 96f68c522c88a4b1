// SPDX-License-Identifier: MIT
#include "renderer/import/mjcf/mjcf_geom.h"

#include <algorithm>
#include <map>

#include "renderer/import/mesh/geometry_common.h"
#include "renderer/import/model/orientation.h"

namespace minkray {

void add_mjcf_geom(const XmlElement& written, const XmlElement& e, ModelGeom geom,
                   const std::function<Affine<double>(const Affine<double>&)>& local,
                   const GeomSource& in) {
  geom.kind = e.attribute_or("type", "sphere");
  geom.rgba = in.assets.colour_of(e);
  geom.alpha_for_rays = in.assets.alpha_for_rays(e);
  const double contype = in.files.number(e, "contype").value_or(1);
  const double conaffinity = in.files.number(e, "conaffinity").value_or(1);
  geom.collides = contype != 0 || conaffinity != 0;
  geom.is_seen = in.files.number(e, "group").value_or(0) < 3 && geom.rgba[3] > 0;
  if (in.compiler.discards_visual() && !geom.collides)
    return in.model.pass_over("<geom>", "discarded by the compiler, since it does not collide");
  geom.pose = local(in.compiler.pose_in(e));

  std::vector<double> size = {0, 0, 0};
  if (const auto given = in.files.numbers(e, "size", 1, 3))
    std::copy(given->begin(), given->end(), size.begin());
  if (const auto ends = in.files.numbers(e, "fromto", 6, 6)) {
    const bool is_long = geom.kind == "capsule" || geom.kind == "cylinder";
    if (!is_long && geom.kind != "ellipsoid" && geom.kind != "box")
      return in.files.wrong(written, "fromto: is for capsules, cylinders, ellipsoids and boxes");
    const Vec3<double> from((*ends)[0], (*ends)[1], (*ends)[2]);
    const Vec3<double> to((*ends)[3], (*ends)[4], (*ends)[5]);
    const double length = (to - from).norm();
    if (!(length > 1e-15)) return in.files.wrong(written, "fromto: must be two points");
    geom.pose = local({rotation_of_z_to(from - to), (from + to) / 2});
    size[is_long ? 1 : 2] = length / 2;
    if (!is_long) size[1] = size[0];
  }
  if (geom.kind == "sdf" && e.attribute("mesh")) geom.kind = "mesh";
  if (geom.kind == "mesh") return in.assets.add_mesh_geom(written, e, std::move(geom));
  if (geom.kind == "plane") {
    make_plane(geom, size[0], size[1]);
    in.model.geoms.push_back(std::move(geom));
    return;
  }
  if (geom.kind == "hfield") return in.assets.add_height_field(written, e, std::move(geom));
  static const std::map<std::string, std::size_t> sizes = {
      {"sphere", 1}, {"capsule", 2}, {"cylinder", 2}, {"ellipsoid", 3}, {"box", 3}};
  const auto needed = sizes.find(geom.kind);
  if (needed == sizes.end())
    return in.files.wrong(written,
                          "type: must be one of plane, sphere, capsule, ellipsoid, cylinder, box "
                          "and mesh (got \"" +
                              printable(geom.kind, 40) + "\")");
  if (e.attribute("mesh")) {
    const auto fitted = in.assets.fit(written, e, in.compiler.fits_box(), geom);
    if (!fitted) return;
    size = *fitted;
    // A capsule may be fitted to what is hardly longer than wide.
    if (geom.kind == "capsule" && size[1] == 0) geom.kind = "sphere";
  }
  for (std::size_t i = 0; i < sizes.at(geom.kind); ++i)
    if (!(size[i] > 0))
      return in.files.wrong(written, "size: of a " + geom.kind + " must be " +
                                         counted_numbers(needed->second) + " > 0 (got \"" +
                                         printable(e.attribute_or("size"), 60) + "\")");
  geom.shape = geom.kind == "sphere"     ? sphere_of(size[0])
               : geom.kind == "capsule"  ? capsule_of(size[0], size[1])
               : geom.kind == "cylinder" ? cylinder_of(size[0], size[1])
               : geom.kind == "box"      ? box_of({size[0], size[1], size[2]})
                                         : ellipsoid_of({size[0], size[1], size[2]});
  in.model.geoms.push_back(std::move(geom));
}

}  // namespace minkray
