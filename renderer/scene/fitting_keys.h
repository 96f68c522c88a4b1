// SPDX-License-Identifier: MIT
// Checks keys of an object that are valid alone but must fit its other keys. Each function adds
// mistakes about the object at `path`; messages quote its JSON where it is given.
#pragma once

#include "renderer/json/json.h"
#include "renderer/json/mistakes.h"
#include "renderer/scene/scene.h"

namespace minkray {

/// Numbers that the camera's type allows or not.
void check_lens(const CameraDescription& camera, const Json& json, const JsonPath& path,
                Mistakes& mistakes);

/// Takes another direction for up where that is the direction of view.
void choose_up(CameraDescription& camera);

/// A camera must look somewhere, and its "up" elsewhere.
void check_view(const CameraDescription& camera, const JsonPath& path, Mistakes& mistakes);

/// Settles where the sun is: by its direction, or by time and place.
void find_sun(SunSkyLight& day, const Json& json, const JsonPath& path, Mistakes& mistakes);

/// A sun that moves must stay above the horizon.
void check_suns(const MemberKeys<Light>& keys, const JsonPath& path, Mistakes& mistakes);

void check_relief(const Relief& relief, const JsonPath& path, Mistakes& mistakes);

void check_metal(const MaterialKind& kind, const JsonPath& path, Mistakes& mistakes);

}  // namespace minkray
