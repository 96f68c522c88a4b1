// SPDX-License-Identifier: MIT
// Many rays at closed meshes through the library as it is installed: leaks, sides, bounds of t, and
// equal results of all ways to cast (./run many-mesh-rays). Prints what is wrong.
#include <atomic>
#include <bit>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <thread>

#include "tests/proof/exact_triangle.h"
#include "tests/proof/rays_at_grid_meshes.h"

namespace minkray::testing {
namespace {

constexpr std::size_t rays_in_chunk = 4096;

/// Number of rays or lines per check that takes longer than a cast.
constexpr std::size_t every_single = 8, every_exact = 16;
/// A check of all triangles takes as long as this many casts, divided by their number.
constexpr std::size_t triangles_per_ray = 16;

struct Counts {
  long long rays = 0, hits = 0, leaks = 0, wrong_sides = 0, contradictions = 0, ties = 0;
  long long singles = 0, differing_singles = 0;
  long long exact = 0, off_bounds = 0, all = 0, wrong_of_all = 0;
  double worst_of_bound = 0, worst_error = 0;  ///< of t: over its bound, and as a distance

  void add(const Counts& more) {
    rays += more.rays, hits += more.hits, leaks += more.leaks;
    wrong_sides += more.wrong_sides, contradictions += more.contradictions, ties += more.ties;
    singles += more.singles, differing_singles += more.differing_singles;
    exact += more.exact, off_bounds += more.off_bounds;
    all += more.all, wrong_of_all += more.wrong_of_all;
    worst_of_bound = std::max(worst_of_bound, more.worst_of_bound);
    worst_error = std::max(worst_error, more.worst_error);
  }
  bool hold() const {
    return leaks + wrong_sides + contradictions + differing_singles + off_bounds + wrong_of_all ==
           0;
  }
};

bool same_bits(const Hit& a, const Hit& b) {
  const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); };
  const auto same = [&](const Vec3& u, const Vec3& v) {
    return bits(u.x) == bits(v.x) && bits(u.y) == bits(v.y) && bits(u.z) == bits(v.z);
  };
  return bits(a.t) == bits(b.t) && bits(a.t_lo) == bits(b.t_lo) && bits(a.t_hi) == bits(b.t_hi) &&
         bits(a.t_base) == bits(b.t_base) && bits(a.t_offset) == bits(b.t_offset) &&
         same(a.point, b.point) && same(a.normal, b.normal) && a.object == b.object &&
         a.status == b.status && a.part == b.part;
}

class Judge {
 public:
  Judge(const GridMesh& mesh, const Scene& scene) : mesh_(mesh), scene_(scene) {}

  Counts chunk(std::uint64_t seed, bool is_within) {
    counts_ = {};
    RaysAtMesh random(mesh_, seed);
    rays_.clear();
    inner_.clear();
    lines_.clear();
    while (rays_.size() < rays_in_chunk) {
      if (is_within) {
        inner_.push_back(random.inner());
        rays_.push_back(inner_.back().ray);
      } else {
        lines_.push_back(random.line());
        rays_.insert(rays_.end(), lines_.back().rays.begin(), lines_.back().rays.end());
      }
    }
    hits_.assign(rays_.size(), {});
    Options options;
    options.threads = 1;
    scene_.cast({rays_.data(), rays_.size()}, {hits_.data(), hits_.size()}, options);
    for (std::size_t i = 0; i < inner_.size(); ++i) judge_inner(i);
    for (std::size_t i = 0; i < lines_.size(); ++i) judge_line(i);
    for (std::size_t i = seed % every_single; i < rays_.size(); i += every_single) judge_single(i);
    for (std::size_t i = seed % every_exact; i < rays_.size(); i += every_exact) judge_exactly(i);
    const std::size_t every_all =
        std::max<std::size_t>(1, mesh_.triangles.size() / triangles_per_ray);
    const std::size_t first = seed % (1 << 20) * rays_in_chunk;
    for (std::size_t i = 0; i < rays_.size(); ++i)
      if ((first + i) % every_all == 0) judge_by_all(i);
    counts_.rays = static_cast<long long>(rays_.size());
    for (const Hit& hit : hits_) counts_.hits += hit.status == hit_status ? 1 : 0;
    return counts_;
  }

 private:
  static constexpr Status hit_status = minkray::hit;

  void complain(const char* what, std::size_t i) const {
    const Ray& r = rays_[i];
    const Hit& h = hits_[i];
    std::printf(
        "%s: %s: from %a %a %a along %a %a %a: status %d, t %.17g in [%.17g, %.17g], "
        "triangle %d\n",
        mesh_.name.c_str(), what, r.origin.x, r.origin.y, r.origin.z, r.direction.x, r.direction.y,
        r.direction.z, static_cast<int>(h.status), h.t, h.t_lo, h.t_hi, h.part);
  }
  bool is_hit(std::size_t i) const { return hits_[i].status == hit_status; }
  std::size_t part(std::size_t i) const { return static_cast<std::size_t>(hits_[i].part); }

  /// The side of the triangle that the ray meets: 1 its front, -1 its back; 0 if the ray passes
  /// just through an edge, where either neighbour may be the one that is hit, or if there is
  /// another hit within the bounds of t.
  int side_met(std::size_t i, int expected) {
    const double fall = dot(rays_[i].direction, mesh_.normal(part(i)));
    if (fall * expected < -1e-12) return expected;
    const ExactHit hit = exact_hit(mesh_, part(i), rays_[i]);
    if (hit.facing == expected) return expected;
    if (hit.is_at_edge) return 0;
    for (const ExactHit& other : all_exact_hits(mesh_, rays_[i]))
      if (other.facing == expected && other.t >= Quad(hits_[i].t_lo) &&
          other.t <= Quad(hits_[i].t_hi))
        return 0;
    return hit.facing;
  }

  void judge_side(std::size_t i, int expected) {
    if (!is_hit(i)) return;
    const int side = side_met(i, expected);
    counts_.ties += side == 0 ? 1 : 0;
    if (side != -expected) return;
    ++counts_.wrong_sides;
    complain("wrong side", i);
  }

  void judge_inner(std::size_t i) {
    if (!is_hit(i) || (inner_[i].is_exact && hits_[i].t_lo > 1)) {
      ++counts_.leaks;
      complain("leak", i);
    }
    judge_side(i, -1);
  }

  void judge_line(std::size_t n) {
    const Line& line = lines_[n];
    const std::size_t i = 4 * n, from_end = i + 1, on = i + 2, back = i + 3;
    for (const std::size_t end : {i, from_end}) {
      if (!is_hit(end) || hits_[end].t_lo > line.t_at_point) {
        ++counts_.leaks;
        complain("leak", end);
      }
      judge_side(end, 1);
    }
    judge_between(on, back);
  }

  /// Both ways from one point meet the same sides. From the surface itself they may meet any.
  void judge_between(std::size_t on, std::size_t back) {
    int sides[2] = {1, 1};  // a miss: outside
    for (const std::size_t ray : {on, back}) {
      if (!is_hit(ray)) continue;
      if (hits_[ray].t_lo <= 0) return;
      sides[ray - on] = dot(rays_[ray].direction, mesh_.normal(part(ray))) > 0 ? -1 : 1;
    }
    if (sides[0] == sides[1]) return;
    for (const std::size_t ray : {on, back})
      if (is_hit(ray) && (exact_hit(mesh_, part(ray), rays_[ray]).is_at_edge ||
                          side_met(ray, -sides[ray - on]) != sides[ray - on]))
        return;
    ++counts_.contradictions;
    complain("inside and outside", on);
    complain("inside and outside", back);
  }

  void judge_single(std::size_t i) {
    ++counts_.singles;
    if (same_bits(scene_.cast(rays_[i]), hits_[i]) &&
        scene_.occluded(rays_[i]) == (is_hit(i) ? hit_status : miss))
      return;
    ++counts_.differing_singles;
    complain("cast alone, or `occluded`, differs", i);
  }

  /// The triangle is hit, at the t that is claimed.
  void judge_exactly(std::size_t i) {
    if (!is_hit(i)) return;
    ++counts_.exact;
    const ExactHit truth = exact_hit(mesh_, part(i), rays_[i]);
    const auto error = static_cast<double>(Quad(hits_[i].t) - truth.t);
    const double bound = std::max(hits_[i].t_hi - hits_[i].t, hits_[i].t - hits_[i].t_lo);
    if (bound > 0)
      counts_.worst_of_bound = std::max(counts_.worst_of_bound, std::abs(error) / bound);
    counts_.worst_error =
        std::max(counts_.worst_error, std::abs(error) * length(rays_[i].direction));
    if (truth.is_hit && truth.t >= Quad(hits_[i].t_lo) && truth.t <= Quad(hits_[i].t_hi)) return;
    ++counts_.off_bounds;
    complain("triangle not hit, or elsewhere", i);
  }

  /// No triangle is hit before.
  void judge_by_all(std::size_t i) {
    ++counts_.all;
    const std::vector<ExactHit> truth = all_exact_hits(mesh_, rays_[i]);
    bool is_wrong = truth.empty() == is_hit(i);
    for (const ExactHit& hit : truth) is_wrong |= is_hit(i) && hit.t < Quad(hits_[i].t_lo);
    if (!is_wrong) return;
    ++counts_.wrong_of_all;
    complain("not the first of all triangles", i);
  }

  const GridMesh& mesh_;
  const Scene& scene_;
  std::vector<InnerRay> inner_;
  std::vector<Line> lines_;
  std::vector<Ray> rays_;
  std::vector<Hit> hits_;
  Counts counts_;
};

/// Results do not depend on the number of threads: each chunk has its own seed.
Counts judge(const GridMesh& mesh, long long rays, std::uint64_t seed) {
  Scene scene;
  scene.add(minkray::mesh(
      {mesh.vertices.data(), mesh.vertices.size()},
      View<const std::uint32_t>(mesh.triangles[0].data(), 3 * mesh.triangles.size())));
  scene.commit();
  const long long chunks =
      (rays + static_cast<long long>(rays_in_chunk) - 1) / static_cast<long long>(rays_in_chunk);
  std::atomic<long long> next = 0;
  std::vector<Counts> counts(std::max(1u, std::thread::hardware_concurrency()));
  {
    std::vector<std::jthread> threads;
    for (Counts& own : counts)
      threads.emplace_back([&] {
        Judge judge(mesh, scene);
        for (long long i = next++; i < chunks; i = next++)
          own.add(judge.chunk((seed << 32u) + static_cast<std::uint64_t>(i), i % 2 == 0));
      });
  }
  Counts sum;
  for (const Counts& own : counts) sum.add(own);
  return sum;
}

int run(long long rays, std::uint64_t seed) {
  std::printf(
      "| mesh | rays | hits | leaks | wrong sides | in and out | ties | single or occluded "
      "differ | t off its bounds | worst error / bound | worst error | "
      "not first of all |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  bool holds = true;
  for (const GridMesh& mesh :
       {grid_torus(2000, 8), grid_ball(50, 100), grid_ball(160, 312), grid_ball(500, 1000)}) {
    const Counts c = judge(mesh, rays / 4, seed);
    std::printf(
        "| %s | %lld | %lld | %lld | %lld | %lld | %lld | %lld of %lld | "
        "%lld of %lld | %.2f | %.1e | %lld of %lld |\n",
        mesh.name.c_str(), c.rays, c.hits, c.leaks, c.wrong_sides, c.contradictions, c.ties,
        c.differing_singles, c.singles, c.off_bounds, c.exact, c.worst_of_bound, c.worst_error,
        c.wrong_of_all, c.all);
    std::fflush(stdout);
    holds &= c.hold();
  }
  return holds ? 0 : 1;
}

}  // namespace
}  // namespace minkray::testing

int main(int count, char** words) {
  const long long rays = count > 1 ? std::atoll(words[1]) : 1'000'000;
  const std::uint64_t seed = count > 2 ? static_cast<std::uint64_t>(std::atoll(words[2])) : 1;
  return minkray::testing::run(rays, seed);
}
