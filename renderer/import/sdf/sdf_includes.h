// SPDX-License-Identifier: MIT
// Replaces each <include> by the model that it names, so that other elements can name its links and
// frames as those of any nested model.
#pragma once

#include <filesystem>
#include <map>
#include <optional>

#include "core/math/affine.h"
#include "renderer/import/model/import_options.h"
#include "renderer/import/model/model.h"
#include "renderer/import/model/xml.h"

namespace minkray {

/// Files may include each other so deeply, and models be nested so deeply.
inline constexpr int deepest_sdf_model = 32;

class SdfIncludes {
 public:
  /// Notes on skipped elements go to `model`.
  SdfIncludes(Model& model, XmlFiles& files, const ImportOptions& options)
      : model_(model), files_(files), options_(options) {}

  /// Each <include> under the root becomes the <model> it names, under the name and the pose that
  /// the <include> gives it, or what that model holds if it is to be merged. A URDF is made a
  /// model; lights are passed over. There stay those that could not be read, which is a mistake,
  /// and Gazebo's own sun and ground_plane where they are not there.
  void expand(XmlElement& root);

  /// The version of SDF that the element's file is written in.
  double version_of(const XmlElement& element) const;

 private:
  void expand(XmlElement& parent, int depth);
  void merge(XmlElement model, std::vector<XmlElement>& children);
  /// The pose becomes that of the model one of whose frames, `placed` in the model, it was given
  /// of.
  void place_by(const Affine<double>& placed, XmlElement& pose);
  std::optional<XmlElement> model_for(const XmlElement& include);
  std::filesystem::path file_of_config(const std::filesystem::path& config,
                                       const XmlElement& include);

  Model& model_;
  XmlFiles& files_;
  const ImportOptions& options_;
  int count_ = 0;
  std::map<std::uint32_t, double> version_of_file_;
};

}  // namespace minkray
