// SPDX-License-Identifier: MIT
#include "renderer/film/cryptomatte.h"

#include <algorithm>
#include <bit>

#include "renderer/film/camera_rays.h"
#include "renderer/json/json.h"

namespace minkray {
namespace {

/// Number of objects stored per pixel, two in each layer of four planes.
constexpr int ranks = 6;

std::string hex(std::uint32_t number) {
  std::string digits(8, '0');
  for (auto digit = digits.rbegin(); digit != digits.rend(); ++digit, number >>= 4)
    *digit = "0123456789abcdef"[number & 15u];
  return digits;
}

std::uint32_t bits_of_id(std::string_view name) {
  std::uint32_t hash = cryptomatte_hash(name);
  // Neither denormal nor infinite nor no number.
  const std::uint32_t exponent = hash >> 23 & 255u;
  if (exponent == 0 || exponent == 255) hash ^= 1u << 23;
  return hash;
}

/// Names by instance, without a name for each particle.
class Names {
 public:
  explicit Names(const Scene& scene) {
    for (const Object& object : scene.objects) add(object.name, 1);
    for (const ParticleSet& set : scene.particles) add(set.name, set.size());
  }
  /// Name of an instance: an index into ids().
  std::uint32_t of(std::uint32_t instance) const {
    const auto after = std::upper_bound(first_.begin(), first_.end(), instance);
    return static_cast<std::uint32_t>(after - first_.begin() - 1);
  }
  const std::vector<float>& ids() const { return ids_; }
  std::string manifest() const { return manifest_.dump(); }

 private:
  void add(const std::string& name, std::size_t count) {
    first_.push_back(instances_);
    ids_.push_back(cryptomatte_id(name));
    manifest_[name] = hex(bits_of_id(name));
    instances_ += static_cast<std::uint32_t>(count);
  }

  std::vector<std::uint32_t> first_;
  std::vector<float> ids_;
  Json manifest_ = Json::object();
  std::uint32_t instances_ = 0;
};

/// Objects hit by one pixel's samples, by the index of the name.
struct Met {
  std::vector<std::pair<std::uint32_t, int>> counts;

  void add(std::uint32_t name) {
    for (auto& [known, count] : counts)
      if (known == name) {
        ++count;
        return;
      }
    counts.emplace_back(name, 1);
  }
  void sort() {
    std::sort(counts.begin(), counts.end(), [](const auto& a, const auto& b) {
      return a.second != b.second ? a.second > b.second : a.first < b.first;
    });
  }
};

}  // namespace

std::uint32_t cryptomatte_hash(std::string_view name) {
  constexpr std::uint32_t c1 = 0xcc9e2d51u, c2 = 0x1b873593u;
  const auto byte = [&](std::size_t i) {
    return static_cast<std::uint32_t>(static_cast<unsigned char>(name[i]));
  };
  const auto scrambled = [&](std::uint32_t k) { return std::rotl(k * c1, 15) * c2; };
  std::uint32_t hash = 0;
  std::size_t at = 0;
  for (; at + 4 <= name.size(); at += 4) {
    hash ^= scrambled(byte(at) | byte(at + 1) << 8 | byte(at + 2) << 16 | byte(at + 3) << 24);
    hash = std::rotl(hash, 13) * 5 + 0xe6546b64u;
  }
  std::uint32_t rest = 0;
  for (std::size_t i = name.size(); i-- > at;) rest = rest << 8 | byte(i);
  if (at < name.size()) hash ^= scrambled(rest);
  hash ^= static_cast<std::uint32_t>(name.size());
  hash = (hash ^ hash >> 16) * 0x85ebca6bu;
  hash = (hash ^ hash >> 13) * 0xc2b2ae35u;
  return hash ^ hash >> 16;
}

float cryptomatte_id(std::string_view name) {
  return std::bit_cast<float>(bits_of_id(name));
}

Cryptomatte measure_cryptomatte(const Scene& scene, const World& world,
                                const RenderOptions& options, const RenderWatch& watch) {
  const Names names(scene);
  const CameraRays rays(scene, world, options);
  const PixelRect region = options.region();

  Cryptomatte made;
  for (int layer = 0; layer < ranks / 2; ++layer)
    for (const char channel : {'R', 'G', 'B', 'A'})
      made.planes.push_back(
          {std::string(cryptomatte_layer) + "0" + std::to_string(layer) + "." + channel,
           std::vector<float>(pixel_count(region))});
  const auto put = [&](std::size_t plane, std::size_t pixel, float value) {
    std::get<std::vector<float>>(made.planes[plane].values)[pixel] = value;
  };

  RayCounts counts;
  for_pixels(region, counts, watch, [&](const Pixel& pixel, RayCounts& of_tile) {
    Met met;
    constexpr int at_once = 64;
    std::array<WorldRay, at_once> asked;
    std::array<WorldHit, at_once> hits;
    for (int first = 0; first < options.samples && !watch.stopped();) {
      const int count = std::min(options.samples - first, at_once);
      for (int i = 0; i < count; ++i) {
        const TracedRay ray = rays.ray(pixel, first + i);
        asked[static_cast<std::size_t>(i)] = {ray.ray, ray.left, ray.time, camera_rays};
      }
      const auto together = std::span(asked).first(static_cast<std::size_t>(count));
      world.closest_hits(together, hits, of_tile.work);
      of_tile.camera += together.size();
      for (std::size_t i = 0; i < together.size(); ++i)
        if (hits[i].found()) met.add(names.of(hits[i].instance));
      first += count;
    }
    met.sort();
    const std::size_t told = std::min<std::size_t>(met.counts.size(), ranks);
    for (std::size_t rank = 0; rank < told; ++rank) {
      put(2 * rank, pixel.index, names.ids()[met.counts[rank].first]);
      put(2 * rank + 1, pixel.index,
          static_cast<float>(static_cast<double>(met.counts[rank].second) / options.samples));
    }
  });

  const std::string key =
      "cryptomatte/" + hex(cryptomatte_hash(cryptomatte_layer)).substr(0, 7) + "/";
  made.texts = {{key + "name", cryptomatte_layer},
                {key + "hash", "MurmurHash3_32"},
                {key + "conversion", "uint32_to_float32"},
                {key + "manifest", names.manifest()}};
  return made;
}

}  // namespace minkray
