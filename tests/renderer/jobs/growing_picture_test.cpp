// SPDX-License-Identifier: MIT
// Pictures that are viewed while they grow: by a viewer that listens as tev does, and in their
// files.
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <thread>

#include "renderer/io/exr.h"
#include "renderer/io/tev.h"
#include "tests/support/expect_exit.h"

namespace minkray {
namespace {

/// Listens at a port of this machine, takes one connection and keeps all that comes.
class Receiver {
 public:
  Receiver() : listener_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t length = sizeof address;
    EXPECT_EQ(bind(listener_, reinterpret_cast<sockaddr*>(&address), length), 0);
    EXPECT_EQ(listen(listener_, 1), 0);
    EXPECT_EQ(getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &length), 0);
    port_ = ntohs(address.sin_port);
    thread_ = std::thread([this] {
      const int connection = accept(listener_, nullptr, nullptr);
      std::array<char, 65536> some;
      for (ssize_t count = 0; (count = read(connection, some.data(), some.size())) > 0;)
        bytes_.append(some.data(), static_cast<std::size_t>(count));
      close(connection);
    });
  }
  ~Receiver() {
    if (thread_.joinable()) thread_.join();
    close(listener_);
  }

  std::string address() const { return "127.0.0.1:" + std::to_string(port_); }
  /// All received bytes, once the sender has closed the connection.
  const std::string& bytes() {
    if (thread_.joinable()) thread_.join();
    return bytes_;
  }

 private:
  int listener_;
  int port_ = 0;
  std::string bytes_;
  std::thread thread_;
};

/// Reads packets as tev does.
class Viewer {
 public:
  explicit Viewer(const std::string& bytes) { look(bytes); }

  std::string name;
  Image image;
  int updates = 0;

 private:
  void look(const std::string& bytes) {
    for (std::size_t at = 0; at < bytes.size();) {
      std::uint32_t length = 0;
      ASSERT_LE(at + 4, bytes.size());
      std::memcpy(&length, bytes.data() + at, 4);
      ASSERT_GT(length, 4u);
      ASSERT_LE(at + length, bytes.size());
      packet_ = bytes.substr(at + 4, length - 4);
      read();
      EXPECT_TRUE(packet_.empty()) << "a packet is longer than what it says";
      at += length;
    }
  }

  template <class T>
  T take() {
    T value{};
    EXPECT_GE(packet_.size(), sizeof value);
    if (packet_.size() < sizeof value) return value;
    std::memcpy(&value, packet_.data(), sizeof value);
    packet_.erase(0, sizeof value);
    return value;
  }
  std::string take_text() {
    const std::size_t end = packet_.find('\0');
    EXPECT_NE(end, std::string::npos);
    const std::string text = packet_.substr(0, end);
    packet_.erase(0, end + 1);
    return text;
  }
  void take_channels() {
    ASSERT_EQ(take<std::int32_t>(), 3);
    for (const char* channel : {"R", "G", "B"}) EXPECT_EQ(take_text(), channel);
  }

  void read() {
    const char kind = take<char>();
    take<char>();  // flag to select the image
    const std::string named = take_text();
    if (kind == 4) {
      name = named;
      const auto width = take<std::int32_t>(), height = take<std::int32_t>();
      image = Image(width, height);
      take_channels();
      return;
    }
    ASSERT_EQ(kind, 6);
    EXPECT_EQ(named, name);
    take_channels();
    const auto x = take<std::int32_t>(), y = take<std::int32_t>();
    const auto width = take<std::int32_t>(), height = take<std::int32_t>();
    for (std::int64_t channel = 0; channel < 3; ++channel) EXPECT_EQ(take<std::int64_t>(), channel);
    for (int channel = 0; channel < 3; ++channel) EXPECT_EQ(take<std::int64_t>(), 3);
    ASSERT_LE(x + width, image.width);
    ASSERT_LE(y + height, image.height);
    ASSERT_EQ(packet_.size(), sizeof(float) * 3 * static_cast<std::size_t>(width * height));
    std::vector<float> values(packet_.size() / sizeof(float));
    std::memcpy(values.data(), packet_.data(), packet_.size());
    packet_.clear();
    const float* value = values.data();
    for (int row = y; row < y + height; ++row)
      for (int column = x; column < x + width; ++column)
        for (int channel = 0; channel < 3; ++channel) image.at(column, row)[channel] = *value++;
    ++updates;
  }

  std::string packet_;
};

std::vector<float> plane(const std::string& file, const char* name) {
  const ExrImage exr = read_exr(file);
  const ExrPlane* found = exr.find(name);
  EXPECT_NE(found, nullptr) << file << " " << name;
  return found ? std::get<std::vector<float>>(found->values) : std::vector<float>();
}

class GrowingPicture : public ::testing::Test {
 protected:
  GrowingPicture() { write_ball_scene(folder_ / "scene.json"); }

  ProgramOutcome render(const std::string& options) const {
    return run_minkray(folder_, "render scene.json -r 50x40 -q " + options);
  }
  TemporaryFolder folder_;
};

TEST_F(GrowingPicture, a_viewer_ends_with_the_picture_that_is_in_the_file) {
  for (const std::string options : {"-s 2", "-s 9 --progressive", "-s 2 --crop 7,5,41,33"}) {
    Receiver receiver;
    expect_exit(0, render("-o a.exr --tev " + receiver.address() + " " + options));
    const Viewer viewer(receiver.bytes());
    EXPECT_EQ(viewer.name, "a.exr");
    const std::vector<float> red = plane(folder_ / "a.exr", "R"),
                             blue = plane(folder_ / "a.exr", "B");
    ASSERT_EQ(viewer.image.pixels.size(), red.size()) << options;
    for (std::size_t i = 0; i < red.size(); ++i) {
      EXPECT_EQ(viewer.image.pixels[i].x(), red[i]);
      EXPECT_EQ(viewer.image.pixels[i].z(), blue[i]);
    }
    EXPECT_GT(viewer.updates, 6);  // tiles, and passes
  }
}

TEST_F(GrowingPicture, without_a_viewer_nothing_is_rendered_and_it_is_said) {
  const ProgramOutcome made = render("-o a.exr --tev 127.0.0.1:1");
  EXPECT_NE(made.exit_code, 0);
  EXPECT_TRUE(has(made.err, "--tev: no viewer listens at 127.0.0.1:1"));
  EXPECT_EQ(folder_.files(), std::vector<std::string>{"scene.json"});
}

TEST_F(GrowingPicture, in_passes_the_last_file_has_the_same_pixels) {
  ASSERT_EQ(render("-s 11 -o a.exr --aov all").exit_code, 0);
  ASSERT_EQ(render("-s 11 -o b.exr --aov all --progressive").exit_code, 0);
  const ExrImage a = read_exr(folder_ / "a.exr"), b = read_exr(folder_ / "b.exr");
  ASSERT_EQ(a.planes.size(), b.planes.size());
  for (std::size_t i = 0; i < a.planes.size(); ++i)
    EXPECT_TRUE(a.planes[i].values == b.planes[i].values) << a.planes[i].name;
}

TEST_F(GrowingPicture, what_needs_a_whole_picture_is_refused_for_parts) {
  for (const std::string flag : {"--progressive", "--tev localhost", "--denoise"}) {
    const ProgramOutcome made = render("-o a.exr --tile 1/2 " + flag);
    EXPECT_EQ(made.exit_code, 2) << flag;
    EXPECT_TRUE(has(made.err, "not allowed with --tile"));
  }
  EXPECT_TRUE(has(render("-s 1 -o a.exr --denoise").err, "at least 2 samples"));
}

TEST_F(GrowingPicture, denoised_light_is_told_by_the_header_and_its_parts_are_not) {
  ASSERT_EQ(render("-s 4 -o a.exr --aov direct,indirect").exit_code, 0);
  ASSERT_EQ(render("-s 4 -o b.exr --aov direct,indirect --denoise").exit_code, 0);
  EXPECT_EQ(read_exr(folder_ / "b.exr").texts.at("minkray.denoised"), "yes");
  EXPECT_FALSE(read_exr(folder_ / "a.exr").texts.contains("minkray.denoised"));
  EXPECT_EQ(plane(folder_ / "a.exr", "direct.R"), plane(folder_ / "b.exr", "direct.R"));
  EXPECT_EQ(plane(folder_ / "a.exr", "indirect.G"), plane(folder_ / "b.exr", "indirect.G"));
  EXPECT_NE(plane(folder_ / "a.exr", "R"), plane(folder_ / "b.exr", "R"));
}

}  // namespace
}  // namespace minkray
