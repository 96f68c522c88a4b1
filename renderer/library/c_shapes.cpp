// SPDX-License-Identifier: MIT
// C interface: making and querying shapes.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/derived/shape_bounds.h"
#include "core/mesh/height_field.h"
#include "renderer/json/parse.h"
#include "renderer/library/handles/call.h"
#include "renderer/library/handles/held_shape.h"
#include "renderer/library/handles/make_shape.h"
#include "renderer/library/handles/nesting.h"
#include "renderer/library/handles/poses.h"
#include "renderer/member_json/shape_json.h"
#include "renderer/scene/scene.h"

namespace minkray {
namespace {

minkray_shape hold(Shape shape) {
  check_nesting(shape);
  return {held_shapes().add(std::make_unique<HeldShape>(std::move(shape)))};
}

/// Divided by a power of two, after which its largest coordinate lies between 0.5 and 1, so that
/// the sum of squares is a number. The furthest point is the same.
Vec3<double> of_ordinary_length(Vec3<double> direction) {
  int exponent = 0;
  std::frexp(direction.cwiseAbs().maxCoeff(), &exponent);
  for (double& x : direction) x = std::ldexp(x, -exponent);
  return direction;
}

const TriangleMesh& mesh_of(minkray_shape shape) {
  const HeldShape& held = shape_of(shape, "shape");
  if (!held.mesh())
    wrong_use(std::string("shape: must be a mesh (got a ") +
              (held.compound() ? "compound)" : "convex shape)"));
  return *held.mesh();
}

const Compound& compound_of(minkray_shape shape) {
  const HeldShape& held = shape_of(shape, "shape");
  if (!held.compound())
    wrong_use(std::string("shape: must be a compound (got a ") +
              (held.mesh() ? "mesh)" : "convex shape)"));
  return *held.compound();
}

}  // namespace
}  // namespace minkray

using namespace minkray;

extern "C" {

const char* minkray_version(void) {
  return MINKRAY_VERSION;
}

const char* minkray_last_error(void) {
  return last_error();
}

int minkray_shape_make(const char* kind, const minkray_parameter* parameters, size_t count,
                       minkray_shape* shape) {
  return call("minkray_shape_make", [&] {
    require(kind, "kind");
    require(shape, "shape");
    if (count > 0) require(parameters, "parameters");
    require_room(count, sizeof(minkray_parameter), "count");
    *shape = hold(make_shape(kind, {parameters, count}));
  });
}

int minkray_shape_read(const char* json, const char* folder, minkray_shape* shape) {
  return call("minkray_shape_read", [&] {
    require(json, "json");
    require(shape, "shape");
    Mistakes mistakes("shape");
    MeshFiles meshes(folder ? folder : "");
    const auto value = parse_json(json, mistakes);
    const auto read = value ? read_shape(*value, JsonPath(), mistakes, meshes) : std::nullopt;
    throw_if_any(mistakes);
    *shape = hold(*read);
  });
}

void minkray_support_failed(const char* reason) {
  call("minkray_support_failed", [&] { keep_support_failure(reason); });
}

int minkray_shape_custom(const minkray_support* support, minkray_shape* shape) {
  return call("minkray_shape_custom", [&] {
    require(support, "support");
    require(shape, "shape");
    *shape = hold(Custom{std::make_shared<const CustomSupport>(*support)});
  });
}

int minkray_shape_custom_gathered(const minkray_support* support, size_t gathered,
                                  minkray_shape* shape) {
  return call("minkray_shape_custom_gathered", [&] {
    require(support, "support");
    require(shape, "shape");
    *shape = hold(Custom{std::make_shared<const CustomSupport>(*support, gathered)});
  });
}

int minkray_shape_custom_with_jets(const minkray_support* support, minkray_jet_function jets,
                                   minkray_shape* shape) {
  return call("minkray_shape_custom_with_jets", [&] {
    require(support, "support");
    if (!jets) wrong_use("jets: must not be NULL");
    require(shape, "shape");
    *shape = hold(Custom{std::make_shared<const CustomSupport>(*support, 0, jets)});
  });
}

int minkray_shape_mesh(const double (*vertices)[3], size_t vertex_count,
                       const uint32_t (*triangles)[3], size_t triangle_count,
                       minkray_shape* shape) {
  return call("minkray_shape_mesh", [&] {
    require(vertices, "vertices");
    require(triangles, "triangles");
    require(shape, "shape");
    require_room(vertex_count, sizeof *vertices, "vertex_count");
    require_room(triangle_count, sizeof *triangles, "triangle_count");
    std::vector<Vec3<double>> points(vertex_count);
    for (size_t i = 0; i < vertex_count; ++i)
      points[i] = {vertices[i][0], vertices[i][1], vertices[i][2]};
    std::vector<Corners> corners(triangle_count);
    for (size_t i = 0; i < triangle_count; ++i)
      corners[i] = {triangles[i][0], triangles[i][1], triangles[i][2]};
    try {
      auto mesh = std::make_shared<const TriangleMesh>(std::move(points), std::move(corners));
      *shape = {held_shapes().add(std::make_unique<HeldShape>(std::move(mesh)))};
    } catch (const std::invalid_argument& error) {
      wrong_use(error.what());
    }
  });
}

int minkray_shape_height_field(const double* heights, size_t rows, size_t columns, double size_x,
                               double size_y, const double* bottom, minkray_shape* shape) {
  return call("minkray_shape_height_field", [&] {
    require(heights, "heights");
    require(shape, "shape");
    require_room(rows, sizeof *heights, "rows");
    if (columns > 0 && rows > SIZE_MAX / sizeof *heights / columns)
      wrong_use("rows, columns: too many");
    HeightField field{{heights, rows * columns}, rows, columns, size_x, size_y, {}};
    if (bottom) field.bottom = *bottom;
    try {
      *shape = {held_shapes().add(std::make_unique<HeldShape>(mesh_of(field)))};
    } catch (const std::invalid_argument& error) {
      wrong_use(error.what());
    }
  });
}

int minkray_shape_mesh_info(minkray_shape shape, minkray_mesh_info* info) {
  return call("minkray_shape_mesh_info", [&] {
    const TriangleMesh& mesh = mesh_of(shape);
    require(info, "info");
    const MeshFaults faults = mesh.faults();
    *info = {mesh.vertices().size(), mesh.size(), faults.open_edges, faults.without_area,
             faults.repeated};
  });
}

int minkray_shape_mesh_arrays(minkray_shape shape, double (*vertices)[3],
                              uint32_t (*triangles)[3]) {
  return call("minkray_shape_mesh_arrays", [&] {
    const TriangleMesh& mesh = mesh_of(shape);
    require(vertices, "vertices");
    require(triangles, "triangles");
    for (const Vec3<double>& vertex : mesh.vertices()) std::copy_n(vertex.data(), 3, *vertices++);
    for (const Corners& corners : mesh.triangles()) std::copy_n(corners.data(), 3, *triangles++);
  });
}

int minkray_shape_compound(const minkray_shape* shapes, const minkray_pose* poses, size_t count,
                           minkray_shape* shape) {
  return call("minkray_shape_compound", [&] {
    require(shapes, "shapes");
    require(shape, "shape");
    if (count == 0) wrong_use("count: must be at least 1");
    require_room(count, sizeof(minkray_pose), "count");
    std::vector<Compound::Part> parts;
    for (size_t i = 0; i < count; ++i) {
      const std::string of_part = "[" + std::to_string(i) + "]";
      const HeldShape& held = shape_of(shapes[i], ("shapes" + of_part).c_str());
      if (!held.is_convex())
        wrong_use("shapes" + of_part + ": must be convex (got a " +
                  (held.mesh() ? "mesh)" : "compound)"));
      refuse_if_running(held.customs(), "shapes");
      Affine<double> pose;
      if (poses) read_pose(&poses[i], ("poses" + of_part).c_str(), pose);
      parts.push_back({*held.shape(), pose});
    }
    auto made = std::make_unique<HeldShape>(std::make_shared<const Compound>(std::move(parts)));
    throw_if_lied(made->customs());
    *shape = {held_shapes().add(std::move(made))};
  });
}

int minkray_shape_compound_size(minkray_shape shape, size_t* count) {
  return call("minkray_shape_compound_size", [&] {
    require(count, "count");
    *count = compound_of(shape).size();
  });
}

int minkray_shape_compound_part(minkray_shape shape, size_t part, minkray_shape* made,
                                minkray_pose* pose) {
  return call("minkray_shape_compound_part", [&] {
    const Compound& compound = compound_of(shape);
    if (part >= compound.size())
      wrong_use("part: must be less than " + std::to_string(compound.size()) + " (got " +
                std::to_string(part) + ")");
    if (pose) *pose = plain_pose(compound.part(part).pose);
    if (made) *made = hold(compound.part(part).shape);
  });
}

int minkray_shape_retain(minkray_shape shape) {
  return call("minkray_shape_retain", [&] {
    if (!held_shapes().retain(shape.id)) shape_of(shape, "shape");
  });
}

int minkray_shape_release(minkray_shape shape) {
  return call("minkray_shape_release", [&] {
    if (!held_shapes().release(shape.id)) shape_of(shape, "shape");
  });
}

int minkray_shape_write(minkray_shape shape, char* text, size_t size, size_t* needed) {
  return call("minkray_shape_write", [&] {
    const HeldShape& held = shape_of(shape, "shape");
    if (!held.is_convex())
      wrong_use(std::string("shape: ") + (held.mesh() ? "meshes" : "compounds") +
                " cannot be written");
    if (!held.customs().empty()) wrong_use("shape: custom support functions cannot be written");
    const std::string json = write_shape(*held.shape()).dump();
    if (size > 0) require(text, "text");
    if (needed) *needed = json.size() + 1;
    if (size == 0) return;
    const std::size_t count = std::min(size - 1, json.size());
    std::memcpy(text, json.data(), count);
    text[count] = '\0';
  });
}

int minkray_shape_kind(minkray_shape shape, const char** kind) {
  return call("minkray_shape_kind", [&] {
    require(kind, "kind");
    const HeldShape& held = shape_of(shape, "shape");
    *kind = held.mesh() ? mesh_name.data()
            : held.compound()
                ? "compound"
                : std::visit([]<class S>(const S&) { return S::name.data(); }, held.shape()->kind);
  });
}

int minkray_shape_support(minkray_shape shape, size_t count, const double (*directions)[3],
                          double (*points)[3]) {
  return call("minkray_shape_support", [&] {
    const HeldShape& held = shape_of(shape, "shape");
    refuse_if_running(held.customs(), "shape");
    if (count > 0) {
      require(directions, "directions");
      require(points, "points");
      require_room(count, sizeof *points, "count");
    }
    const auto direction = [&](size_t i) {
      return Vec3<double>(directions[i][0], directions[i][1], directions[i][2]);
    };
    for (size_t i = 0; i < count; ++i)
      if (!direction(i).allFinite())
        wrong_use("directions[" + std::to_string(i) + "]: must be three finite numbers");
    for (size_t i = 0; i < count; ++i) {
      const Vec3<double> point = held.shape()->support(of_ordinary_length(direction(i)));
      for (int k = 0; k < 3; ++k) points[i][k] = point[k];
    }
    throw_if_lied(held.customs());
  });
}

int minkray_shape_bounds(minkray_shape shape, double lower[3], double upper[3]) {
  return call("minkray_shape_bounds", [&] {
    const HeldShape& held = shape_of(shape, "shape");
    refuse_if_running(held.customs(), "shape");
    require(lower, "lower");
    require(upper, "upper");
    const Bounds<double> bounds = held.mesh()       ? held.mesh()->bounds()
                                  : held.compound() ? held.compound()->bounds()
                                                    : bounds_of(*held.shape());
    throw_if_lied(held.customs());
    for (int k = 0; k < 3; ++k) {
      lower[k] = bounds.lower[k];
      upper[k] = bounds.upper[k];
    }
  });
}

}  // extern "C"
