// SPDX-License-Identifier: MIT
#include "renderer/scene_json/read_camera.h"

#include "renderer/json/object_reader.h"
#include "renderer/member_json/read_member_keys.h"
#include "renderer/scene/find_focus.h"
#include "renderer/scene/fitting_keys.h"
#include "renderer/scene/framing.h"

namespace minkray {

void CameraReader::read(const Json& json, const JsonPath& path, int version) {
  ObjectReader object(json, path, mistakes_);
  is_version_one_ = version == 1;
  json_ = &json;
  path_ = path;
  is_good_ = true;
  scene_.camera = CameraDescription();
  if (!object.is_object()) {
    is_good_ = false;
    return;
  }
  is_good_ = read_members(object, scene_.camera, files_,
                          is_version_one_ ? Leave::optional_ones : Leave::any);
  if (!is_version_one_) object.allow({"keys"});
  object.finish();
  check_lens(scene_.camera, json, path, mistakes_);
  has_position_ = json.contains("position");
  has_look_at_ = json.contains("look_at");
  has_up_ = json.contains("up");
  if (!is_good_ || (!is_version_one_ && !(has_position_ && has_look_at_))) return;
  if (!is_version_one_ && !has_up_) choose_up(scene_.camera);
  check_view(scene_.camera, path, mistakes_);
}

void CameraReader::settle(const JsonPath& path) {
  const bool is_placed = has_position_ && has_look_at_;
  // Framing needs a valid scene.
  if (!is_version_one_ && is_good_ && !is_placed && mistakes_.none()) {
    CameraDescription& camera = scene_.camera;
    const CameraDescription written = camera;
    frame_with_own_lens(scene_);
    const Vec3<double> back = camera.position - camera.look_at;
    if (has_position_) camera.position = written.position;
    if (has_look_at_) {
      camera.look_at = written.look_at;
      camera.position = written.look_at + back;
    }
    // Keys start at the position and must not be framed again.
    scene_.camera_is_framed =
        !has_position_ && !has_look_at_ && !(json_ && json_->contains("keys"));
    if (!has_up_) choose_up(camera);
    check_view(camera, path, mistakes_);
  }
  find_focus(scene_, path, mistakes_);
  if (!is_version_one_ && json_ && json_->contains("keys")) read_keys();
}

void CameraReader::read_keys() {
  const JsonPath path = path_ / "keys";
  const Json& json = json_->at("keys");
  MemberKeys<CameraDescription> made =
      read_member_keys(json, path, mistakes_, files_, scene_.camera);
  Vec3<double> before = Vec3<double>::Zero();
  for (std::size_t i = 0; i < made.keys.size(); ++i) {
    if (json[i].is_object()) check_lens(made.keys[i].values, json[i], path / i, mistakes_);
    const CameraDescription camera = made.at(made.keys[i].time);
    const Vec3<double> view = unit<double>(camera.look_at - camera.position);
    if (view.isZero())
      mistakes_.add(path / i, "must not place the camera at look_at");
    else if (i > 0)
      check_turn(before, view, path / i, mistakes_);
    before = view;
  }
  if (mistakes_.none()) scene_.camera_keys = std::move(made);
}

}  // namespace minkray
