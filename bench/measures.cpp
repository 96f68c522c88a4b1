// SPDX-License-Identifier: MIT
// minkray-bench: rays at single shapes, ours compared with other casters, on one thread.
#include <fstream>
#include <iostream>
#include <sstream>

#include "bench/measured.h"
#include "bench/peers/others.h"
#include "bench/peers/ours.h"
#include "bench/truth.h"
#include "core/derived/shape_bounds.h"
#include "renderer/json/json.h"
#include "tests/support/measured_shapes.h"

namespace {

using namespace minkray;
using namespace minkray::bench;

struct Options {
  std::string json;
  std::string shape;   ///< only shapes whose names contain this
  std::string family;  ///< only this kind of rays
  std::string only;    ///< only peers whose names begin like this, and the baseline
  std::size_t rays = 4096;
  int rounds = 15;
  bool quick = false;
  bool fine_meshes = true;
  bool sweep = true;
};

void append(Peers& peers, Peers more) {
  for (auto& peer : more) peers.push_back(std::move(peer));
}

/// Measurements at one shape in one size: the families, and if others are compared.
struct Size {
  std::string label;
  double scale = 1;
  std::vector<std::string> families;
  bool with_others = true;
};

std::vector<Size> sizes(const Options& options) {
  const auto chosen = [&](std::vector<std::string> families) {
    if (!options.family.empty())
      std::erase_if(families, [&](const std::string& name) { return name != options.family; });
    return families;
  };
  if (options.quick) return {{"", 1, chosen({"random", "coherent"}), true}};
  return {{"", 1, chosen(family_names()), true},
          {" x 1e-2", 1e-2, chosen({"random"}), false},
          {" x 1e4", 1e4, chosen({"random"}), false}};
}

Peers make_peers(const Shape& shape, double radius, bool with_others, const Options& options) {
  Peers peers = scalar_solvers(shape, options.sweep && with_others);
  append(peers, packet_solvers(shape));
  if (!with_others) return peers;
  append(peers, closed_forms(shape));
  append(peers, embree_own(shape));
  append(peers, embree_triangles(tessellate(shape, 1e-4 * radius), "1e-4"));
  if (options.fine_meshes) {
    const TriangleMesh fine = tessellate(shape, 1e-6 * radius);
    append(peers, embree_triangles(fine, "1e-6"));
  }
  append(peers, mujoco(shape));
  append(peers, ode(shape));
  append(peers, bullet(shape));
  return peers;
}

std::string machine() {
  std::ifstream processors("/proc/cpuinfo");
  for (std::string line; std::getline(processors, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown";
}

Options read_options(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const auto value = [&]() -> std::string {
      if (i + 1 >= argc) throw std::invalid_argument(word + ": needs a value");
      return argv[++i];
    };
    if (word == "--json")
      options.json = value();
    else if (word == "--shape")
      options.shape = value();
    else if (word == "--family")
      options.family = value();
    else if (word == "--only")
      options.only = value();
    else if (word == "--rays")
      options.rays = static_cast<std::size_t>(std::stoul(value()));
    else if (word == "--rounds")
      options.rounds = std::stoi(value());
    else if (word == "--coarse")
      options.fine_meshes = false;
    else if (word == "--quick") {
      options.quick = true;
      options.rays = 1024;
      options.rounds = 5;
      options.fine_meshes = options.sweep = false;
    } else
      throw std::invalid_argument(
          word +
          ": unknown; takes --json FILE, --quick, --shape NAME, --family NAME, --rays N, "
          "--rounds N, --coarse (no meshes of error 1e-6), --only PEER (those whose name begins "
          "so, "
          "beside the baseline)");
  }
  if (options.rays < 64 || options.rounds < 1)
    throw std::invalid_argument("--rays: at least 64; --rounds: at least 1");
  return options;
}

void run(const Options& options) {
  Json json = {{"machine", machine()},
               {"compiler", __VERSION__},
               {"threads", 1},
               {"rays", options.rays},
               {"rounds", options.rounds},
               {"baseline", baseline},
               {"units",
                "errors in bounding radii, angles in radians, times in nanoseconds a ray; "
                "ratio: to the baseline, the median of the rounds' ratios"},
               {"shapes", Json::array()}};
  std::uint64_t hash = 0;
  std::cout << machine() << ", one thread, " << options.rays << " rays, " << options.rounds
            << " rounds; ratio: time by that of " << baseline << "; errors in bounding radii\n";
  for (const testing::MeasuredShape& subject : testing::measured_shapes()) {
    if (subject.name.find(options.shape) == std::string::npos) continue;
    for (const Size& size : sizes(options)) {
      const Shape shape =
          size.scale == 1 ? subject.shape : testing::scaled(subject.shape, size.scale);
      const double radius = ball_around(bounds_of(shape)).radius;
      if (size.families.empty()) continue;
      Peers peers = make_peers(shape, radius, size.with_others && options.only.empty(), options);
      if (!options.only.empty())
        std::erase_if(peers, [&](const auto& peer) {
          return peer->name() != baseline && !peer->name().starts_with(options.only);
        });
      Json families = Json::array();
      for (const std::string& family : size.families) {
        const RaysWithTruth rays = make_rays(shape, family, options.rays);
        const std::vector<Measured> measured = measure(peers, shape, rays, options.rounds);
        print(subject.name + size.label, family, measured);
        Json list = Json::array();
        for (const Measured& m : measured) {
          list.push_back(as_json(m));
          hash = hash * 31 + m.judgement.hash;
        }
        families.push_back({{"family", family}, {"peers", std::move(list)}});
      }
      json["shapes"].push_back({{"name", subject.name},
                                {"scale", size.scale},
                                {"radius", radius},
                                {"families", std::move(families)}});
    }
  }
  std::ostringstream text;
  text << std::hex << hash;
  json["hash"] = text.str();
  std::cout << "\nhash of all answers " << text.str() << "\n";
  if (options.json.empty()) return;
  const std::string temporary = options.json + ".tmp";
  std::ofstream file(temporary);
  file << json.dump(1) << "\n";
  file.close();
  if (!file || std::rename(temporary.c_str(), options.json.c_str()) != 0)
    throw std::runtime_error(options.json + ": could not be written");
}

}  // namespace

int main(int argc, char** argv) {
  constexpr int wrong_usage = 2, cannot_write = 4;
  try {
    run(read_options(argc, argv));
  } catch (const std::invalid_argument& error) {
    std::cerr << error.what() << "\n";
    return wrong_usage;
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return cannot_write;
  }
  return 0;
}
