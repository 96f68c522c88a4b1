// SPDX-License-Identifier: MIT
#include "tests/support/dart_frames.h"

#include <algorithm>

#include "renderer/import/import.h"
#include "renderer/json/json.h"
#include "tests/support/program.h"
#include "tests/support/source_files.h"

namespace minkray {

std::optional<FrameErrors> frames_beside_dart(const std::string& urdf, int states) {
  const TemporaryFolder folder;
  const std::string out = folder / "frames.json";
  const std::string script = (source_folder() / "tests/oracle/dart_frames.py").string();
  // Debian's Python is the one that has Debian's module.
  const ProgramOutcome outcome =
      run_shell("/usr/bin/python3 '" + script + "' '" + urdf + "' " + std::to_string(states) +
                " 20 '" + out + "' >/dev/null 2>&1");
  if (outcome.exit_code != 0) return std::nullopt;
  const Json theirs = Json::parse(text_of_file(out));

  Mistakes mistakes(urdf);
  ImportOptions options;
  options.skip_missing_meshes = true;
  std::optional<Model> model = load_model(urdf, options, mistakes);
  FrameErrors errors;
  if (!model) {
    errors.missing = mistakes.text();
    return errors;
  }
  errors.states = theirs.size();
  for (std::size_t state = 0; state < theirs.size(); ++state) {
    for (const auto& [name, value] : theirs[state]["values"].members()) {
      ModelJoint* joint = find_joint(*model, name);
      if (joint)
        joint->value = {value.get<double>()};
      else
        errors.missing = name;
    }
    const std::vector<Affine<double>> poses = link_poses(*model);
    const Json& frames = theirs[state]["frames"];
    errors.links = 0;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      // A link of this name is the world itself there.
      if (model->links[i].name == "world") continue;
      const Json* frame = frames.find(model->links[i].name);
      if (!frame) {
        errors.missing = model->links[i].name;
        continue;
      }
      ++errors.links;
      for (int row = 0; row < 3; ++row) {
        const Json& numbers = (*frame)[row];
        for (int column = 0; column < 3; ++column)
          errors.worst = std::max(
              errors.worst, std::abs(poses[i].linear(row, column) - numbers[column].get<double>()));
        errors.worst =
            std::max(errors.worst, std::abs(poses[i].translation[row] - numbers[3].get<double>()));
      }
    }
  }
  return errors;
}

}  // namespace minkray
