// SPDX-License-Identifier: MIT
#include "bench/image/image_bench.h"

#include <fstream>
#include <iostream>
#include <set>

#include "bench/image/clock.h"
#include "bench/image/growth_plot.h"
#include "bench/image/memory.h"
#include "bench/image/povray.h"
#include "bench/image/report.h"
#include "bench/image/scenes_table.h"
#include "bench/image/statistics.h"
#include "core/parallel/parallel.h"
#include "renderer/io/output_file.h"

namespace minkray::bench {
namespace {

std::string machine() {
  std::ifstream processors("/proc/cpuinfo");
  for (std::string line; std::getline(processors, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown";
}

void write_text(const std::string& file, const std::string& text) {
  write_file(file, std::span(reinterpret_cast<const unsigned char*>(text.data()), text.size()));
}

/// Least of the contenders whose names begin so.
template <class List, class Ratio>
double least_ratio(const List& list, std::string_view name, const Ratio& ratio) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& one : list)
    if (std::string_view(one.contender).starts_with(name)) least = std::min(least, ratio(one));
  return least;
}

std::string count_text(std::size_t count) {
  if (count % 1000000 == 0) return std::to_string(count / 1000000) + "M";
  if (count % 1000 == 0) return std::to_string(count / 1000) + "k";
  return std::to_string(count);
}

/// Runs the parts and collects their output.
class Bench {
 public:
  explicit Bench(const ImageBenchOptions& options) : options_(options) {
    json_ = {{"machine", machine()},
             {"compiler", __VERSION__},
             {"ratios", "other / minkray in float; above 1: minkray is sooner"},
             {"rounds", options.rounds}};
  }

  void run() {
    std::cout << machine() << "; ratios: other / minkray in float, medians of " << options_.rounds
              << " interleaved rounds\n";
    const std::set<std::string> wanted(options_.parts.begin(), options_.parts.end());
    if (wanted.contains("scenes")) json_["scenes"] = measure_scenes(options_, goals_);
    if (wanted.contains("casts")) casts();
    if (wanted.contains("build")) build();
    if (wanted.contains("memory")) memory();
    if (wanted.contains("hulls")) hulls();
    if (wanted.contains("threads")) threads();
    if (wanted.contains("povray")) povray();
    if (wanted.contains("image")) image();
    if (wanted.contains("growth")) growth();
    if (!goals_.empty()) print(std::cout, goals_);
    json_["goals"] = as_json(goals_);
    if (!options_.json.empty()) write_text(options_.json, json_.dump(1) + "\n");
  }

 private:
  Subject subject(const std::string& kind, std::size_t objects) const {
    Subject made = make_subject(kind, objects);
    std::cerr << objects << " " << kind << ": generated in " << made.generate_seconds
              << " s, loaded in " << made.load_seconds << " s\n";
    return made;
  }

  void goal(std::string what, std::string asked, double bound, bool at_most, double measured) {
    goals_.push_back({std::move(what), std::move(asked), bound, at_most, measured});
  }

  void casts() {
    const Subject boxes = subject(options_.kind, options_.objects);
    const std::vector<Contender> contenders =
        contenders_for(boxes.scene, {options_.mesh_errors, true, false, false});
    const std::vector<CastResults> results =
        measure_casts(boxes, contenders, options_.rays, options_.rounds);
    Json list = Json::array();
    std::cout << "\n" << count_text(options_.objects) << " " << options_.kind << "\n";
    for (const CastResults& one : results) {
      print(std::cout, one);
      list.push_back(as_json(one));
    }
    json_["casts"] = std::move(list);
  }

  void build() {
    const Subject boxes = subject(options_.kind, options_.build_objects);
    const std::vector<Contender> contenders = contenders_for(boxes.scene, {{}, true, true, false});
    // The picture is small: building is what is measured.
    const std::vector<ImageTime> times =
        measure_images(boxes, contenders, {{64, 64}, 1, 1, options_.rounds});
    std::cout << "\nbuilding " << count_text(options_.build_objects) << " " << options_.kind
              << ", one thread\n";
    print(std::cout, times);
    json_["build"] = as_json(times);
    const auto whole = [](const ImageTime& time) { return 1 / time.build_ratio; };
    const auto hierarchy = [](const ImageTime& time) { return 1 / time.hierarchy_ratio; };
    const std::string what = "build of " + count_text(options_.build_objects) + " " +
                             options_.kind + ", of Embree's user geometry: ";
    goal(what + "instances and hierarchy", "<= 1.3", 1.3, true,
         least_ratio(times, "embree user, our cast", whole));
    goal(what + "the hierarchy alone", "<= 1.3", 1.3, true,
         least_ratio(times, "embree user, our cast", hierarchy));
  }

  void memory() {
    const MemoryOfUnshared memory = measure_memory(1000, 2, 1e-6);
    std::cout << "\nrounded boxes, each of its own shape, bytes an object: minkray "
              << memory.our_bytes << " (heap " << memory.our_heap_bytes << "), embree triangles "
              << memory.triangle_bytes << " for " << memory.triangles << " triangles\n";
    json_["memory"] = {{"our_bytes", memory.our_bytes},
                       {"our_heap_bytes", memory.our_heap_bytes},
                       {"triangle_bytes", memory.triangle_bytes},
                       {"triangles", memory.triangles}};
    goal("memory, no sharing, of Embree's triangles of error 1e-6", ">= 100", 100, false,
         memory.triangle_bytes / std::max(memory.our_heap_bytes, memory.our_bytes));
  }

  void hulls() {
    const Subject hulls = subject("rounded-hulls", 1000);
    const std::vector<Contender> contenders =
        contenders_for(hulls.scene, {{1e-4}, true, false, true});
    const Resolution resolution{options_.width, options_.height};
    // Embree's building alone takes half a minute; fewer rounds will do.
    const int rounds = (options_.rounds + 2) / 3;
    const std::vector<ImageTime> times =
        measure_images(hulls, contenders, {resolution, options_.samples, 1, rounds});
    std::cout << "\n1000 different rounded hulls, " << resolution.width << "x" << resolution.height
              << ", " << options_.samples << " samples, one thread\n";
    print(std::cout, times);
    json_["hulls"] = as_json(times);
    const auto measured = [](const ImageTime& time) { return time.image_ratio; };
    goal("time to image, 1000 rounded hulls, " + std::to_string(resolution.width) + "x" +
             std::to_string(resolution.height) + ", " + std::to_string(options_.samples) +
             (options_.samples == 1 ? " sample" : " samples") +
             ": Embree's triangles of error 1e-4",
         ">= 3", 3, false, least_ratio(times, "embree triangles 0.0001", measured));
    if (options_.samples == 16) return;
    // Tracing time is proportional to the samples, building time is not.
    const double more = 16.0 / options_.samples;
    const auto projected = [&](const ImageTime& time) {
      return (time.build_seconds + more * time.trace_seconds) /
             (times[0].build_seconds + more * times[0].trace_seconds);
    };
    goal("the same, projected to 16 samples", ">= 3", 3, false,
         least_ratio(times, "embree triangles 0.0001", projected));
  }

  void threads() {
    const Subject boxes = subject(options_.kind, options_.objects);
    const std::vector<Contender> contenders =
        contenders_for(boxes.scene, {{}, false, false, false});
    const Resolution resolution{960, 540};
    std::vector<double> trace, image;
    for (int round = 0; round < options_.rounds; ++round) {
      std::vector<ImageTime> one, two;
      // The wall's clock for both.
      with_threads(1, [&] { one = wall_times(boxes, contenders, resolution, 1); });
      with_threads(2, [&] { two = wall_times(boxes, contenders, resolution, 2); });
      trace.push_back(one[0].trace_seconds / two[0].trace_seconds);
      image.push_back((one[0].build_seconds + one[0].trace_seconds) /
                      (two[0].build_seconds + two[0].trace_seconds));
    }
    json_["two_threads"] = {{"trace", median(trace)}, {"image", median(image)}};
    goal("2 threads against 1, " + count_text(options_.objects) + " " + options_.kind + ": trace",
         ">= 1.9", 1.9, false, median(trace));
    goal("2 threads against 1, build and trace", ">= 1.8", 1.8, false, median(image));
  }

  static std::vector<ImageTime> wall_times(const Subject& subject,
                                           const std::vector<Contender>& contenders,
                                           const Resolution& resolution, int threads) {
    const Clock building;
    const std::unique_ptr<Tracer> tracer = contenders[0].make(subject.scene, threads);
    ImageTime time;
    time.build_seconds = building.seconds();
    const Clock tracing;
    trace_frame(*tracer, 1, subject.scene, resolution, 1);
    time.trace_seconds = tracing.seconds();
    return {time};
  }

  void povray() {
    PovrayOptions options;
    options.minkray = options_.minkray;
    options.rounds = options_.rounds;
    options.spheres = options_.objects;
    const std::optional<PovrayTimes> times = measure_povray(options);
    if (!times) {
      std::cout << "\nPOV-Ray is not installed\n";
      return;
    }
    std::cout << "\n"
              << count_text(options.spheres) << " spheres, " << options.resolution.width << "x"
              << options.resolution.height
              << ", one ray a pixel and a shadow ray, the whole commands on one thread: povray "
              << times->povray_seconds << " s, minkray render " << times->minkray_seconds
              << " s, ratio " << times->ratio << "; mean difference of the pictures "
              << times->picture_difference << " of 1\n";
    json_["povray"] = {{"spheres", options.spheres},
                       {"povray_seconds", times->povray_seconds},
                       {"minkray_seconds", times->minkray_seconds},
                       {"ratio", times->ratio},
                       {"picture_difference", times->picture_difference}};
  }

  void image() {
    const Subject made = subject(options_.kind, options_.objects);
    const std::vector<Contender> contenders =
        contenders_for(made.scene, {options_.mesh_errors, true, false, false});
    const std::vector<ImageTime> times = measure_images(
        made, contenders,
        {{options_.width, options_.height}, options_.samples, options_.threads, options_.rounds});
    std::cout << "\n"
              << count_text(options_.objects) << " " << options_.kind << ", " << options_.width
              << "x" << options_.height << ", " << options_.samples << " samples, "
              << options_.threads << " threads\n";
    print(std::cout, times);
    json_["image"] = as_json(times);
  }

  void growth() {
    std::vector<GrowthLine> lines;
    Json list = Json::array();
    for (std::size_t objects = options_.growth_from; objects <= options_.growth_to; objects *= 10) {
      const Subject made = subject(options_.kind, objects);
      const std::vector<Contender> contenders =
          contenders_for(made.scene, {options_.mesh_errors, true, false, false});
      const std::vector<ImageTime> times = measure_images(
          made, contenders,
          {{options_.width, options_.height}, options_.samples, options_.threads, options_.rounds});
      std::cout << "\n"
                << objects << " " << options_.kind << ", " << options_.width << "x"
                << options_.height << ", " << options_.threads << " threads\n";
      print(std::cout, times);
      list.push_back(
          {{"objects", objects}, {"load_seconds", made.load_seconds}, {"tracers", as_json(times)}});
      lines.resize(times.size());
      const auto x = static_cast<double>(objects);
      for (std::size_t i = 0; i < times.size(); ++i) {
        lines[i].name = times[i].contender;
        lines[i].trace.emplace_back(x, times[i].trace_seconds);
        lines[i].build.emplace_back(x, times[i].build_seconds);
        lines[i].bytes.emplace_back(
            x, static_cast<double>(std::max(times[i].bytes, times[i].heap_bytes)));
      }
    }
    json_["growth"] = std::move(list);
    if (options_.plot.empty()) return;
    write_text(options_.plot, growth_svg(options_.kind + ": camera, shadow and ambient rays of " +
                                             std::to_string(options_.width) + "x" +
                                             std::to_string(options_.height) + " pixels on " +
                                             std::to_string(options_.threads) +
                                             (options_.threads == 1 ? " thread" : " threads"),
                                         lines));
  }

  const ImageBenchOptions& options_;
  Json json_;
  std::vector<Goal> goals_;
};

}  // namespace

void run_image_bench(const ImageBenchOptions& options) {
  Bench(options).run();
}

}  // namespace minkray::bench
