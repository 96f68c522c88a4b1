// SPDX-License-Identifier: MIT
// minkray-bench: rays at single shapes, ours beside other people's casters, on one thread.
//
// All casters of a shape answer the same batch of rays in turn, round after round, so that a noisy
// moment hits all of them; a caster's speed is the median over the rounds of its time divided by
// that of the default solver in float in the same round. Answers are judged by exact ones.
#include <Eigen/Core>
#include <algorithm>
#include <chrono>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <map>
#include <sstream>

#include "bench/peers/others.h"
#include "bench/peers/ours.h"
#include "bench/truth.h"
#include "core/derived/convert.h"
#include "core/derived/shape_bounds.h"
#include "renderer/json/json.h"
#include "tests/support/measured_shapes.h"

namespace {

using namespace minkray;
using namespace minkray::bench;

/// The one that all times are divided by.
constexpr std::string_view baseline = "minkray-auto/float";

struct Options {
  std::string json;
  std::string shape;   ///< only shapes whose names contain this
  std::string family;  ///< only this kind of rays
  std::string only;    ///< only peers whose names begin so, beside the baseline
  std::size_t rays = 4096;
  int rounds = 15;
  bool quick = false;
  bool fine_meshes = true;
  bool sweep = true;
};

struct Measured {
  std::string name;
  std::size_t triangles = 0;
  double nanoseconds = 0;  ///< a ray
  double ratio = 0;        ///< to the baseline
  Judgement judgement;
};

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Mistakes nearer to the silhouette than this are rounding's.
double band_of(const std::string& name) {
  return name.ends_with("/double") ? 1e-12 : 1e-6;
}

std::vector<Measured> measure(const Peers& peers, const Shape<double>& shape,
                              const RaysWithTruth& rays, int rounds) {
  using Clock = std::chrono::steady_clock;
  const std::size_t count = rays.batch.size();
  std::vector<Measured> all(peers.size());
  std::vector<std::vector<double>> times(peers.size());
  std::vector<Hit> hits(count);
  std::size_t base = 0;
  for (std::size_t p = 0; p < peers.size(); ++p) {
    // The first answers are judged; they also warm the caches.
    peers[p]->prepare(rays.batch);
    peers[p]->cast();
    peers[p]->read(hits);
    all[p].name = peers[p]->name();
    all[p].triangles = peers[p]->triangles();
    all[p].judgement = judge(shape, rays, hits, band_of(all[p].name));
    if (all[p].name == baseline) base = p;
  }
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t p = 0; p < peers.size(); ++p) {
      peers[p]->prepare(rays.batch);
      const auto begin = Clock::now();
      peers[p]->cast();
      const std::chrono::duration<double, std::nano> time = Clock::now() - begin;
      times[p].push_back(time.count() / static_cast<double>(count));
    }
  }
  for (std::size_t p = 0; p < peers.size(); ++p) {
    std::vector<double> ratios;
    for (std::size_t r = 0; r < times[p].size(); ++r)
      ratios.push_back(times[p][r] / times[base][r]);
    all[p].nanoseconds = median(times[p]);
    all[p].ratio = median(ratios);
  }
  return all;
}

Json as_json(const Spread& spread) {
  return {{"mean", spread.mean}, {"p999", spread.most_of_all}, {"max", spread.max}};
}

Json as_json(const Measured& m) {
  const Judgement& j = m.judgement;
  std::ostringstream hash;
  hash << std::hex << j.hash;
  Json json = {{"name", m.name},
               {"ns_per_ray", m.nanoseconds},
               {"ratio", m.ratio},
               {"rays", j.rays},
               {"hits", j.hits},
               {"unknown", j.unknown},
               {"exhausted", j.exhausted},
               {"wrong", j.wrong},
               {"false_hits", j.false_hits},
               {"false_misses", j.false_misses},
               {"band", j.band},
               {"t_error_along_normal", as_json(j.along_normal)},
               {"t_error_along_ray", as_json(j.along_ray)},
               {"normal_angle", as_json(j.normal_angle)},
               {"hash", hash.str()}};
  if (m.triangles > 0) json["triangles"] = m.triangles;
  if (j.supports_of_hits.max > 0) {
    json["supports_per_hit"] = as_json(j.supports_of_hits);
    json["supports_per_miss"] = as_json(j.supports_of_misses);
  }
  return json;
}

std::string short_number(double value, int digits) {
  std::ostringstream text;
  text << std::setprecision(digits) << value;
  return text.str();
}

/// One line a caster.
void print(const std::string& subject, const std::string& family,
           const std::vector<Measured>& measured) {
  std::cout << "\n"
            << subject << ", " << family << "\n"
            << std::left << std::setw(40) << "" << std::right << std::setw(9) << "ns"
            << std::setw(8) << "ratio" << std::setw(21) << "supports a hit" << std::setw(8)
            << "a miss" << std::setw(9) << "dt*cos" << std::setw(9) << "dt" << std::setw(9)
            << "normal" << std::setw(7) << "wrong" << std::setw(7) << "false" << std::setw(6)
            << "exh."
            << "\n";
  for (const Measured& m : measured) {
    const Judgement& j = m.judgement;
    std::string supports, of_misses;
    if (j.supports_of_hits.max > 0) {
      supports = short_number(j.supports_of_hits.mean, 3) + "/" +
                 short_number(j.supports_of_hits.most_of_all, 4) + "/" +
                 short_number(j.supports_of_hits.max, 4);
      of_misses = short_number(j.supports_of_misses.mean, 3);
    }
    std::string name = m.name;
    if (m.triangles > 0) name += " (" + std::to_string(m.triangles) + ")";
    std::cout << std::left << std::setw(40) << name << std::right << std::setw(9)
              << short_number(m.nanoseconds, 3) << std::setw(8) << short_number(m.ratio, 3)
              << std::setw(21) << supports << std::setw(8) << of_misses << std::setw(9)
              << short_number(j.along_normal.max, 2) << std::setw(9)
              << short_number(j.along_ray.max, 2) << std::setw(9)
              << short_number(j.normal_angle.max, 2) << std::setw(7) << j.wrong << std::setw(7)
              << j.false_hits + j.false_misses << std::setw(6) << j.exhausted << "\n";
  }
  std::cout << std::flush;
}

void append(Peers& peers, Peers more) {
  for (auto& peer : more) peers.push_back(std::move(peer));
}

/// What is measured at one shape: which families, and whether beside others.
struct Part {
  std::string label;
  double scale = 1;
  std::vector<std::string> families;
  bool with_others = true;
};

std::vector<Part> parts(const Options& options) {
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

Peers make_peers(const Shape<double>& shape, double radius, bool with_others,
                 const Options& options) {
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
    for (const Part& part : parts(options)) {
      // All numbers that a float can hold, so that every precision has the same shape.
      const Shape<double> wished =
          part.scale == 1 ? subject.shape : testing::scaled(subject.shape, part.scale);
      const Shape<double> shape = convert<double>(convert<float>(wished));
      const double radius = ball_around(bounds_of<double>(shape)).radius;
      if (part.families.empty()) continue;
      Peers peers = make_peers(shape, radius, part.with_others && options.only.empty(), options);
      if (!options.only.empty())
        std::erase_if(peers, [&](const auto& peer) {
          return peer->name() != baseline && !peer->name().starts_with(options.only);
        });
      Json families = Json::array();
      for (const std::string& family : part.families) {
        const RaysWithTruth rays = make_rays(shape, family, options.rays);
        const std::vector<Measured> measured = measure(peers, shape, rays, options.rounds);
        print(subject.name + part.label, family, measured);
        Json list = Json::array();
        for (const Measured& m : measured) {
          list.push_back(as_json(m));
          hash = hash * 31 + m.judgement.hash;
        }
        families.push_back({{"family", family}, {"peers", std::move(list)}});
      }
      json["shapes"].push_back({{"name", subject.name},
                                {"scale", part.scale},
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
