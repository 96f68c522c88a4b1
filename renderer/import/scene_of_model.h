// SPDX-License-Identifier: MIT
// Converts a robot into a scene: one object per shape, and a default camera, sun and sky.
#pragma once

#include "renderer/import/model/import_options.h"
#include "renderer/import/model/model.h"
#include "renderer/json/mistakes.h"
#include "renderer/scene/moving_frame.h"
#include "renderer/scene/scene.h"

namespace minkray {

/// The values of joints at a time, as one row of a file.
struct JointRow {
  double time = 0;
  std::vector<std::pair<std::string, std::vector<double>>> values;
};

/// Applies the keyframe and joints of the options.
void pose_model(Model& model, const ImportOptions& options, Mistakes& mistakes);

/// Rows of values: from a CSV file with the joints' names in its first line (and "time", in
/// seconds), or from JSON: an object of joints' names and values, or a list of such. Mistakes are
/// added; they begin with the option that named the file. `rows_per_second` is for rows without
/// times.
std::vector<JointRow> read_joint_rows(const std::string& file, Model& model, Mistakes& mistakes,
                                      const std::string& option = "--joints",
                                      double rows_per_second = 24);

/// Selects the requested geoms. A link without visual shapes shows its collision shapes.
std::vector<bool> chosen_geoms(const Model& model, GeometryChoice choice);

/// Shapes chosen by the options. With several rows, objects move from row to row.
Scene scene_of(Model& model, const ImportOptions& options, const std::vector<JointRow>& rows);

/// Frame of a link, fixed or moving by the rows; nothing if there is none of that name.
std::optional<MovingFrame> frame_of_link(Model& model, const std::vector<JointRow>& rows,
                                         const std::string& name);

}  // namespace minkray
