// SPDX-License-Identifier: MIT
#include "tests/oracle/sdformat_links.h"

#include <sdf/Console.hh>
#include <sdf/Joint.hh>
#include <sdf/JointAxis.hh>
#include <sdf/Link.hh>
#include <sdf/Model.hh>
#include <sdf/Root.hh>
#include <sdf/World.hh>

namespace minkray::testing {
namespace {

Affine<double> affine(const ignition::math::Pose3d& pose) {
  const auto& q = pose.Rot();
  return {rotation_matrix(q.X(), q.Y(), q.Z(), q.W()),
          {pose.Pos().X(), pose.Pos().Y(), pose.Pos().Z()}};
}

class Collector {
 public:
  explicit Collector(SdformatLinks& all) : all_(all) {}

  void add(const sdf::Model& model, const Affine<double>& outer, const std::string& prefix) {
    // In the frame that it is in; a model in no world has no frames around it.
    ignition::math::Pose3d own = model.RawPose();
    if (!model.SemanticPose().Resolve(own).empty()) own = model.RawPose();
    const Affine<double> pose = outer * affine(own);
    const std::string inner = prefix + model.Name() + "::";
    for (std::uint64_t i = 0; i < model.LinkCount(); ++i) {
      const sdf::Link& link = *model.LinkByIndex(i);
      ignition::math::Pose3d at;
      if (link.SemanticPose().Resolve(at, "__model__").empty())
        all_.links[inner + link.Name()] = pose * affine(at);
    }
    for (std::uint64_t i = 0; i < model.JointCount(); ++i) {
      const sdf::Joint& joint = *model.JointByIndex(i);
      if (!joint.Axis(0)) continue;
      ignition::math::Vector3d axis;
      if (joint.Axis(0)->ResolveXyz(axis, joint.ChildLinkName()).empty())
        all_.axes[inner + joint.Name()] = {axis.X(), axis.Y(), axis.Z()};
    }
    for (std::uint64_t i = 0; i < model.ModelCount(); ++i) add(*model.ModelByIndex(i), pose, inner);
  }

 private:
  SdformatLinks& all_;
};

}  // namespace
}  // namespace minkray::testing

extern "C" bool minkray_sdformat_links(const std::string& file,
                                       minkray::testing::SdformatLinks& all, std::string& why) {
  sdf::Console::Instance()->SetQuiet(true);
  sdf::Root root;
  const sdf::Errors errors = root.Load(file);
  if (!errors.empty()) {
    why = errors.front().Message();
    return false;
  }
  minkray::testing::Collector collector(all);
  if (root.Model()) collector.add(*root.Model(), {}, "");
  for (std::uint64_t w = 0; w < root.WorldCount(); ++w)
    for (std::uint64_t i = 0; i < root.WorldByIndex(w)->ModelCount(); ++i)
      collector.add(*root.WorldByIndex(w)->ModelByIndex(i), {}, "");
  return true;
}
