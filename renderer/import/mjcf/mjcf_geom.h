// SPDX-License-Identifier: MIT
// Geoms of MJCF: meshes, and primitives given by sizes, by two ends, or by a mesh to fit.
#pragma once

#include <functional>

#include "renderer/import/mjcf/mjcf_assets.h"
#include "renderer/import/mjcf/mjcf_compiler.h"

namespace minkray {

struct GeomSource {
  Model& model;
  XmlFiles& files;
  const MjcfCompiler& compiler;
  MjcfAssets& assets;
};

/// Adds the geometry of a <geom> to the model; `e` is the element with its defaults, `geom` has
/// its name and link. `local` converts a pose of the file to the link's frame.
void add_mjcf_geom(const XmlElement& written, const XmlElement& e, ModelGeom geom,
                   const std::function<Affine<double>(const Affine<double>&)>& local,
                   const GeomSource& in);

}  // namespace minkray
