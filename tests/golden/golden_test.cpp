// SPDX-License-Identifier: MIT
// Pictures have the same bits for any number of threads and any split into tiles and shares of the
// samples, and the bits recorded in hashes.txt. `./run golden` records them.
#include <gtest/gtest.h>

#include <map>

#include "renderer/base/hash.h"
#include "renderer/io/exr.h"
#include "tests/support/expect_exit.h"
#include "tests/support/recorded_hashes.h"
#include "tests/support/source_files.h"

namespace minkray {
namespace {

/// Hashes of the colours, and of each data channel by itself, so that changes are reported by
/// channel. The header is left out: it contains the date and the command of the picture.
std::map<std::string, std::string> hashes_of(const std::string& file) {
  std::map<std::string, std::string> hashes;
  for (const ExrPlane& plane : read_exr(file).planes) {
    Hash hash;
    std::visit(
        [&](const auto& values) {
          hash.add({reinterpret_cast<const char*>(values.data()),
                    values.size() * sizeof(values.front())});
        },
        plane.values);
    hashes[plane.name] = hash.text();
  }
  return hashes;
}

struct Picture {
  const char* name;
  const char* scene;  ///< a shell's words; $SCENES is the folder of scenes
  const char* options;
};

constexpr Picture pictures[] = {
    {"showcase", "$SCENES/showcase.json", "-r 96x54 -s 4"},
    {"shape-zoo", "$SCENES/shape-zoo.json", "-r 96x54 -s 2 --aov all"},
    {"boxes", "$SCENES/rounded-boxes-10k.json", "-r 64x48 -s 2 --bounces 2 --aov all"},
    {"particles", "particles.json", "-r 64x48 -s 2 --aov all"},
    {"cornell", "$SCENES/cornell.json", "-r 40x40 -s 5 --aov all"},
    {"glass", "$SCENES/glass.json", "-r 48x27 -s 3"},
    {"studio", "$SCENES/studio.json", "-r 48x27 -s 3"},
};

/// One way of many to make the same picture: $1 is the scene, $2 the file, $3... the options.
struct Way {
  const char* name;
  const char* script;
};

constexpr Way ways[] = {
    {"2 threads", "\"$MINKRAY\" render \"$scene\" -q -o \"$out\" -t 2 $options"},
    {"7 threads", "\"$MINKRAY\" render \"$scene\" -q -o \"$out\" -t 7 $options"},
    {"rays one by one", "\"$MINKRAY\" render \"$scene\" -q -o \"$out\" --ray-group 1 $options"},
    {"groups of 4 rays", "\"$MINKRAY\" render \"$scene\" -q -o \"$out\" --ray-group 4 $options"},
    {"groups of 8 rays", "\"$MINKRAY\" render \"$scene\" -q -o \"$out\" --ray-group 8 $options"},
    {"passes", "\"$MINKRAY\" render \"$scene\" -q -o \"$out\" --progressive $options"},
    {"5 tiles",
     "for i in 1 2 3 4 5; do \"$MINKRAY\" render \"$scene\" -q -o tile-$i.exr --tile $i/5 $options "
     "|| exit 1; done; \"$MINKRAY\" merge tile-?.exr -o \"$out\"; code=$?; rm tile-?.exr; exit "
     "$code"},
};
/// Data channels do not go with shares of the samples.
constexpr Way shares = {
    "2 shares of the samples, 2 tiles",
    "for i in 1 2; do for j in 1 2; do \"$MINKRAY\" render \"$scene\" -q -o share-$i$j.exr --tile "
    "$i/2 --sample-share $j/2 $options || exit 1; done; done; \"$MINKRAY\" merge share-??.exr -o "
    "\"$out\"; code=$?; rm share-??.exr; exit $code"};

class Golden : public ::testing::TestWithParam<Picture> {
 protected:
  Golden() {
    expect_exit(0, run_minkray(folder_, "generate capsules -n 2000 --seed 3 -o particles.json"));
  }

  std::map<std::string, std::string> made(const Way& way, const std::string& options) const {
    const std::string scenes = (source_folder() / "scenes").string();
    const ProgramOutcome outcome =
        run_shell("cd '" + (folder_ / ".") + "' || exit 99; SCENES='" + scenes + "'; scene=\"" +
                  GetParam().scene + "\"; options='" + options + "'; out=a.exr\n" + way.script);
    EXPECT_EQ(outcome.exit_code, 0) << way.name << ": " << outcome.err;
    return outcome.exit_code == 0 ? hashes_of(folder_ / "a.exr")
                                  : std::map<std::string, std::string>{};
  }

  TemporaryFolder folder_;
};

constexpr Way one_thread = {"1 thread",
                            "\"$MINKRAY\" render \"$scene\" -q -o \"$out\" -t 1 $options"};

TEST_P(Golden, the_same_bits_in_every_way_and_as_recorded) {
  const std::string name = GetParam().name, options = GetParam().options;
  const auto first = made(one_thread, options);
  ASSERT_GE(first.size(), 3u);
  for (const Way& way : ways) EXPECT_EQ(made(way, options), first) << way.name;
  const std::string colours = options.substr(0, options.find(" --aov"));
  const auto in_shares = made(shares, colours);
  for (const char* colour : {"R", "G", "B"})
    EXPECT_EQ(in_shares.contains(colour) ? in_shares.at(colour) : "none", first.at(colour))
        << shares.name << ", " << colour;
  std::map<std::string, std::string> named;
  for (const auto& [part, hash] : first) named[name + " " + part] = hash;
  testing::RecordedHashes recorded("hashes.txt", "the pictures of golden_test.cpp have been");
  if (testing::is_recording()) return recorded.replace(name + " ", named);
  if (!recorded.is_comparable())
    GTEST_SKIP() << "recorded with " << recorded.build() << ": other last bits are no mistake";
  for (const auto& [part, hash] : named)
    EXPECT_EQ(hash, recorded.find(part)) << part << " has changed; see ./run golden";
}

INSTANTIATE_TEST_SUITE_P(Pictures, Golden, ::testing::ValuesIn(pictures), [](const auto& instance) {
  std::string name = instance.param.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

}  // namespace
}  // namespace minkray
