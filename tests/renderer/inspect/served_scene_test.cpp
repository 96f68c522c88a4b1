// SPDX-License-Identifier: MIT
// Replies of `minkray inspect --serve`, without a browser.
#include "renderer/inspect/served_scene.h"

#include <gtest/gtest.h>

#include "core/shape/sphere.h"
#include "tests/support/shifted.h"

namespace minkray {
namespace {

class AServedScene : public ::testing::Test {
 protected:
  AServedScene() {
    scene_.camera.position = {0, -5, 1};
    scene_.camera.look_at = {0, 0, 0};
    scene_.lights = {EnvironmentLight{{1, 1, 1}, {1, 1, 1}}};
    scene_.materials = {{"grey", LambertMaterial{{0.5, 0.5, 0.5}}}};
    scene_.objects = {{"ball", Sphere{1}, shifted_by(0, 0, 0), 0}};
    solvers_.push_back({"auto", SceneCasts(scene_, {})});
    options_.picture.resolution = {40, 30};
  }
  WebReply answer(const std::string& path, bool is_abandoned) {
    ServedScene served(scene_, solvers_, options_, "", {{}, [] { return false; }});
    WebRequest request;
    request.path = path;
    request.is_abandoned = [=] { return is_abandoned; };
    return served.answer(request);
  }
  Scene scene_;
  std::vector<InspectedSolver> solvers_;
  InspectOptions options_;
};

/// A client that closed only its half of the connection, as netcat does, got a black picture as if
/// it were the scene's.
TEST_F(AServedScene, what_was_left_is_no_answer) {
  for (const char* path : {"picture", "view"}) {
    EXPECT_EQ(answer(path, false).status, 200) << path;
    const WebReply reply = answer(path, true);
    EXPECT_EQ(reply.status, 503) << path;
    EXPECT_TRUE(reply.type.starts_with("text/plain")) << path;
  }
}

}  // namespace
}  // namespace minkray
