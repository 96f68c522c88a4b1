// SPDX-License-Identifier: MIT
#include "bench/image/povray.h"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <iterator>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "bench/image/clock.h"
#include "bench/image/statistics.h"
#include "renderer/generate/generate.h"
#include "renderer/json/json.h"
#include "renderer/scene_json/scene_json.h"
#include "tests/support/temporary_folder.h"

namespace minkray::bench {
namespace {

/// A vector of POV-Ray's, whose frame is left-handed: y and z change places.
std::string pov(const Vec3<double>& v) {
  std::ostringstream text;
  text << std::setprecision(9) << '<' << v.x() << ',' << v.z() << ',' << v.y() << '>';
  return text.str();
}

/// The generated spheres under one light with shadows, and nothing else, so that both do the same
/// work: our scene file, and POV-Ray's.
void write_scenes(const std::string& generated, const std::string& ours, const std::string& povs,
                  const Resolution& resolution) {
  std::ifstream in(generated);
  Json json = Json::parse(std::string(std::istreambuf_iterator<char>(in), {}));
  json["lights"] = Json::array(
      {{{"type", "directional"}, {"direction", {-0.3, 1, -1.4}}, {"color", {2, 2, 2}}}});
  json["materials"] =
      Json::array({{{"name", "matt"}, {"type", "lambert"}, {"color", {0.7, 0.7, 0.7}}}});
  std::ofstream(ours) << json.dump(1) << "\n";

  const Scene scene = load_scene(ours);
  const CameraDescription& camera = scene.camera;
  std::ofstream out(povs);
  const double aspect = static_cast<double>(resolution.width) / resolution.height;
  // POV-Ray's angle is the picture's width.
  const double half = std::tan(camera.fov_y_degrees * std::numbers::pi / 360) * aspect;
  out << "#version 3.7;\nglobal_settings { assumed_gamma 1 ambient_light 0 }\n"
      << "background { color rgb <0.93, 0.94, 0.96> }\n"
      << "camera { location " << pov(camera.position) << " sky <0,1,0> right x*" << aspect
      << " angle " << std::setprecision(12) << 2 * std::atan(half) * 180 / std::numbers::pi
      << " look_at " << pov(camera.look_at)
      << " }\n"
      // A Lambert surface reflects its colour / pi of the irradiance; POV-Ray leaves pi out.
      << "light_source { " << pov(-1e4 * Vec3<double>(-0.3, 1, -1.4)) << " color rgb "
      << 2 / std::numbers::pi << " parallel point_at <0,0,0> }\n"
      << "#declare Matt = texture { pigment { rgb 0.7 } finish { ambient 0 diffuse 1 } }\n";
  for (const ParticleSet& set : scene.particles) {
    const double radius = std::get<Sphere>(set.shape.kind).radius;
    for (std::size_t i = 0; i < set.size(); ++i)
      out << "sphere { " << pov(set.pose(i).translation) << ", " << radius
          << " texture { Matt } }\n";
  }
  if (!out.flush()) throw std::runtime_error(povs + ": could not be written");
}

/// Time of a command, of all its threads together or of the wall clock.
double seconds_of(const std::string& command, int threads) {
  const auto children = [] {
    rusage usage;
    getrusage(RUSAGE_CHILDREN, &usage);
    const auto of = [](const timeval& t) {
      return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return of(usage.ru_utime) + of(usage.ru_stime);
  };
  const double before = children();
  const Clock clock;
  if (std::system(command.c_str()) != 0) throw std::runtime_error("failed: " + command);
  return threads == 1 ? children() - before : clock.seconds();
}

/// The bytes of a binary PPM, one per channel.
std::vector<unsigned char> read_ppm(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  std::string magic;
  in >> magic;
  // POV-Ray writes comments behind it.
  const auto number = [&] {
    std::size_t value = 0;
    std::string comment;
    while ((in >> std::ws).peek() == '#') std::getline(in, comment);
    in >> value;
    return value;
  };
  const std::size_t width = number(), height = number(), most = number();
  in.get();
  std::vector<unsigned char> bytes(3 * width * height);
  in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (magic != "P6" || most != 255 || !in) throw std::runtime_error(file + ": no 8 bit PPM");
  return bytes;
}

/// The floats of a PFM, rows from the top.
std::vector<float> read_pfm(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  std::string magic;
  std::size_t width = 0, height = 0;
  double order = 0;
  in >> magic >> width >> height >> order;
  in.get();
  std::vector<float> values(3 * width * height);
  for (std::size_t row = height; row-- > 0;)
    in.read(reinterpret_cast<char*>(values.data() + 3 * width * row),
            static_cast<std::streamsize>(3 * width * sizeof(float)));
  if (magic != "PF" || !in) throw std::runtime_error(file + ": no PFM");
  return values;
}

double srgb(double linear) {
  const double x = std::clamp(linear, 0.0, 1.0);
  return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
}

}  // namespace

std::optional<PovrayTimes> measure_povray(const PovrayOptions& options) {
  if (std::system("command -v povray >/dev/null 2>&1") != 0) return std::nullopt;
  const TemporaryFolder folder;
  const auto path = [&](const char* name) { return (folder.path() / name).string(); };
  generate_scene({"spheres", options.spheres, 0}, path("generated.json"));
  write_scenes(path("generated.json"), path("ours.json"), path("theirs.pov"), options.resolution);

  const std::string size =
      std::to_string(options.resolution.width) + "x" + std::to_string(options.resolution.height);
  const std::string threads = std::to_string(options.threads);
  const std::string our_command = "'" + options.minkray + "' render " + path("ours.json") + " -o " +
                                  path("ours.pfm") + " -r " + size + " -s " +
                                  std::to_string(options.samples) + " --threads " + threads +
                                  " --bounces 0 --checkpoint 0 2>/dev/null";
  const std::string their_command = "povray +I" + path("theirs.pov") + " +O" + path("theirs.ppm") +
                                    " +FP +W" + std::to_string(options.resolution.width) + " +H" +
                                    std::to_string(options.resolution.height) + " -D -A -P -V +WT" +
                                    threads + " File_Gamma=sRGB >/dev/null 2>&1";

  PovrayTimes times;
  std::vector<double> our_seconds, their_seconds, ratios;
  for (int round = 0; round < options.rounds; ++round) {
    our_seconds.push_back(seconds_of(our_command, options.threads));
    their_seconds.push_back(seconds_of(their_command, options.threads));
    ratios.push_back(their_seconds.back() / our_seconds.back());
  }
  times.minkray_seconds = median(our_seconds);
  times.povray_seconds = median(their_seconds);
  times.ratio = median(ratios);
  const std::vector<float> our_picture = read_pfm(path("ours.pfm"));
  const std::vector<unsigned char> their_picture = read_ppm(path("theirs.ppm"));
  if (our_picture.size() != their_picture.size())
    throw std::runtime_error("povray: a picture of another size");
  double sum = 0;
  for (std::size_t i = 0; i < our_picture.size(); ++i)
    sum += std::abs(srgb(static_cast<double>(our_picture[i])) - their_picture[i] / 255.0);
  times.picture_difference = sum / static_cast<double>(our_picture.size());
  return times;
}

}  // namespace minkray::bench
