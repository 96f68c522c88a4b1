// SPDX-License-Identifier: MIT
#include "bench/measured.h"

#include <algorithm>
#include <chrono>
#include <iomanip>
#include <iostream>
#include <sstream>

namespace minkray::bench {
namespace {

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Mistakes nearer to the silhouette than this are rounding's.
double band_of(const std::string& name) {
  return name.ends_with("/double") ? 1e-12 : 1e-6;
}

Json as_json(const Spread& spread) {
  return {{"mean", spread.mean}, {"p999", spread.most_of_all}, {"max", spread.max}};
}

std::string short_number(double value, int digits) {
  std::ostringstream text;
  text << std::setprecision(digits) << value;
  return text.str();
}

}  // namespace

std::vector<Measured> measure(const Peers& peers, const Shape& shape, const RaysWithTruth& rays,
                              int rounds) {
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

}  // namespace minkray::bench
