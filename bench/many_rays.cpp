// SPDX-License-Identifier: MIT
// Compares millions of casts per measured shape with an oracle in long double
// (tests/oracle/line_entry.h): errors, false hits and misses, casts without convergence, casts that
// the filter left to later stages, and the largest error relative to its bound.
//   many_rays [RAYS [NAME]]   RAYS random rays (default 100,000), a tenth as many of other kinds;
//                             only shapes whose name contains NAME
#include <algorithm>
#include <iomanip>
#include <iostream>
#include <iterator>
#include <mutex>
#include <sstream>
#include <string>

#include "core/cast/cast.h"
#include "core/parallel/parallel.h"
#include "tests/support/cast_judge.h"
#include "tests/support/measured_shapes.h"
#include "tests/support/ray_families.h"

namespace {

using namespace minkray;
using testing::CastJudge;
using testing::Judgement;
using testing::TrueEntry;
using testing::Verdict;

struct Count {
  long hits = 0, exhausted = 0;
  long undecided = 0;       ///< by the oracle
  long mistaken = 0;        ///< a hit for a miss or the reverse
  long false_answers = 0;   ///< those of them further from the silhouette than the band
  long coarse = 0;          ///< hits with an error above the allowed one
  long doubtful = 0;        ///< not answered by the filter
  long broken = 0;          ///< hits whose t lies beyond the bound that they claim
  double by_bound = 0;      ///< the greatest error of a hit, by that bound
  double along_normal = 0;  ///< the greatest |t - exact| * cosine of a hit, in units of R
  double supports_of_hits = 0;
  int most_supports = 0;
  std::string worst;        ///< the ray of along_normal
  std::string first_false;  ///< an answer of false_answers, with its ray

  void operator+=(const Count& other) {
    hits += other.hits;
    exhausted += other.exhausted;
    undecided += other.undecided;
    mistaken += other.mistaken;
    false_answers += other.false_answers;
    coarse += other.coarse;
    doubtful += other.doubtful;
    broken += other.broken;
    by_bound = std::max(by_bound, other.by_bound);
    supports_of_hits += other.supports_of_hits;
    most_supports = std::max(most_supports, other.most_supports);
    if (other.along_normal > along_normal) {
      along_normal = other.along_normal;
      worst = other.worst;
    }
    if (first_false.empty()) first_false = other.first_false;
  }
};

std::string told(const Ray<double>& ray) {
  std::ostringstream out;
  out << std::setprecision(17) << "origin " << ray.origin.transpose() << ", direction "
      << ray.direction.transpose();
  return out.str();
}

void judge_one(const CastJudge& judge, const Ray<double>& ray, const CastResult<double>& answer,
               const TrueEntry& truth, Count& count) {
  const Judgement judged = judge(ray, answer, truth);
  count.doubtful += answer.path != Path::filter;
  count.exhausted += judged.verdict == Verdict::exhausted;
  count.undecided += judged.verdict == Verdict::undecided;
  count.mistaken += judged.verdict == Verdict::at_silhouette || judged.verdict == Verdict::wrong;
  count.false_answers += judged.verdict == Verdict::wrong;
  if (judged.verdict == Verdict::wrong && count.first_false.empty())
    count.first_false = std::string(name_of(answer.status)) + " at " + told(ray);
  if (judged.verdict != Verdict::right || answer.status != Status::hit) return;
  ++count.hits;
  const double by_bound = judge.error_by_bound(ray, answer, truth);
  count.broken += !(by_bound <= 1);
  count.by_bound = std::max(count.by_bound, by_bound);
  count.coarse += !(judged.error <= testing::allowed_error);
  count.supports_of_hits += answer.supports;
  count.most_supports = std::max(count.most_supports, answer.supports);
  if (!(judged.error <= count.along_normal)) {
    count.along_normal = judged.error;
    count.worst = told(ray);
  }
}

struct Candidate {
  explicit Candidate(const testing::MeasuredShape& of)
      : shape(of.same), prepared(of.shape), judge(of.same) {}

  Shape shape;
  PreparedShape prepared;
  CastJudge judge;
};

/// An index range of a family's rays is cast by one call.
Count cast_many(const Candidate& candidate, testing::RayFamily family, long rays,
                std::uint64_t seed) {
  testing::FamilyRays source(candidate.shape, family, seed);
  Count count;
  for (long i = 0; i < rays; ++i) {
    const Ray<double> ray = source.next();
    const CastResult<double> answer = cast_ray(candidate.prepared, ray);
    const TrueEntry truth = candidate.judge.truth(ray, answer.normal);
    judge_one(candidate.judge, ray, answer, truth, count);
  }
  return count;
}

void print(const std::string& name, std::string_view family, long rays, const Count& count) {
  std::cout << std::left << std::setw(22) << name << std::setw(11) << family << std::right
            << std::setw(10) << rays << std::setw(10) << count.hits << std::setw(6)
            << count.exhausted << std::setw(7) << count.undecided << std::setw(9) << count.mistaken
            << std::setw(7) << count.false_answers << std::setw(7) << count.coarse
            << std::setprecision(2) << std::scientific << std::setw(10) << count.along_normal
            << std::setw(9)
            << 100.0 * static_cast<double>(count.doubtful) / static_cast<double>(rays) << std::fixed
            << std::setw(8) << count.by_bound << std::setw(7) << count.broken << std::setw(7)
            << count.supports_of_hits / static_cast<double>(std::max(count.hits, 1L))
            << std::setw(5) << count.most_supports << "\n";
  if (count.coarse > 0) std::cout << "  # the greatest error: " << count.worst << "\n";
  if (!count.first_false.empty()) std::cout << "  # false: " << count.first_false << "\n";
  std::cout << std::flush;
}

}  // namespace

int main(int argc, char** argv) {
  const long rays = argc > 1 ? std::stol(argv[1]) : 100000;
  const std::string wanted = argc > 2 ? argv[2] : "";
  constexpr long range_size = 65536;
  std::cout << std::left << std::setw(22) << "shape" << std::setw(11) << "rays" << std::right
            << std::setw(10) << "count" << std::setw(10) << "hits" << std::setw(6) << "exh."
            << std::setw(7) << "undec." << std::setw(9) << "mistaken" << std::setw(7) << "false"
            << std::setw(7) << "coarse" << std::setw(10) << "dt*cos/R" << std::setw(9) << "doubt %"
            << std::setw(8) << "/bound" << std::setw(7) << "broken" << std::setw(7) << "supp."
            << std::setw(5) << "max"
            << "\n";
  bool is_good = true, is_any = false;
  std::vector<testing::MeasuredShape> subjects = testing::measured_shapes();
  std::ranges::move(testing::derived_shapes(), std::back_inserter(subjects));
  for (const testing::MeasuredShape& subject : subjects) {
    if (subject.name.find(wanted) == std::string::npos) continue;
    is_any = true;
    const Candidate candidate(subject);
    for (const testing::RayFamilyDescription& family : testing::ray_families) {
      const bool is_random = family.family == testing::RayFamily::random;
      const long count = std::max(is_random ? rays : rays / 10, 1L);
      Count all;
      std::mutex mutex;
      parallel_for(static_cast<std::size_t>((count + range_size - 1) / range_size), 1,
                   [&](std::size_t begin, std::size_t end) {
                     for (std::size_t i = begin; i < end; ++i) {
                       const long here =
                           std::min(range_size, count - static_cast<long>(i) * range_size);
                       const Count counted = cast_many(candidate, family.family, here, 1000 + i);
                       const std::lock_guard lock(mutex);
                       all += counted;
                     }
                   });
      print(subject.name, family.name, count, all);
      const bool is_ordinary = family.family != testing::RayFamily::degenerate;
      is_good = is_good && all.false_answers == 0 && all.exhausted == 0 && all.broken == 0 &&
                (all.coarse == 0 || !is_ordinary);
    }
  }
  if (!is_any) std::cerr << "no shape's name contains " << wanted << "\n";
  return is_good && is_any ? 0 : 1;
}
