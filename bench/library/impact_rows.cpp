// SPDX-License-Identifier: MIT
// Times of impact of two shapes that move and do not turn, compared with Bullet's three casts.
#include <BulletCollision/NarrowPhaseCollision/btContinuousConvexCollision.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkConvexCast.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btSubSimplexConvexCast.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

#include "pairs.h"
#include "sections.h"

namespace bench {
namespace {

class OurImpacts : public Caster {
 public:
  OurImpacts(const Pair& pair, const std::vector<Meeting>& meetings)
      : Caster("time_of_impact"), pair_(pair), meetings_(meetings), found_(meetings.size()) {}

  void cast() override {
    for (std::size_t i = 0; i < meetings_.size(); ++i) {
      const Meeting& one = meetings_[i];
      found_[i] = mk::time_of_impact(pair_.a.ours.shape, one.a, {}, pair_.b.ours.shape, one.b,
                                     {{one.motion.x, one.motion.y, one.motion.z}, {}}, 1);
    }
  }
  std::vector<Answer> answers() const override {
    std::vector<Answer> all;
    for (const mk::Impact& found : found_)
      all.push_back(static_cast<int>(found.status) == MINKRAY_IMPACT ? Answer{found.t_lo, 0}
                                                                     : Answer{});
    return all;
  }

 private:
  const Pair& pair_;
  const std::vector<Meeting>& meetings_;
  std::vector<mk::Impact> found_;
};

template <class Make>
class BulletImpacts : public Caster {
 public:
  BulletImpacts(const char* name_, const Pair& pair, const std::vector<Meeting>& meetings,
                const Make& make)
      : Caster(name_),
        a_(pair.a.without_margin),
        b_(pair.b.without_margin),
        make_(make),
        found_(meetings.size()) {
    for (const Meeting& one : meetings) {
      btTransform end = to_bullet(one.b);
      end.getOrigin() += to_bullet(one.motion);
      poses_.push_back({to_bullet(one.a), to_bullet(one.b), end});
    }
  }

  void cast() override {
    for (std::size_t i = 0; i < poses_.size(); ++i) {
      const Poses& at = poses_[i];
      btVoronoiSimplexSolver simplex;
      auto caster = make_(a_.get(), b_.get(), &simplex);
      btConvexCast::CastResult result;
      const bool met = caster.calcTimeOfImpact(at.a, at.a, at.b, at.end, result);
      found_[i] = met && result.m_fraction <= 1 ? Answer{result.m_fraction, 0} : Answer{};
    }
  }
  std::vector<Answer> answers() const override { return found_; }

 private:
  struct Poses {
    btTransform a, b, end;
  };
  std::shared_ptr<btConvexShape> a_, b_;
  Make make_;
  std::vector<Poses> poses_;
  std::vector<Answer> found_;
};

void measure(Table& table, const Options& options, const Pair& pair) {
  using Shape = const btConvexShape*;
  using Simplex = btSimplexSolverInterface*;
  const std::vector<Meeting> where = meetings(pair, options.queries, true);
  btGjkEpaPenetrationDepthSolver depth;
  Casters ours, peers;
  ours.push_back(std::make_unique<OurImpacts>(pair, where));
  const auto add = [&](const char* name, const auto& make) {
    using Made = BulletImpacts<std::decay_t<decltype(make)>>;
    peers.push_back(std::make_unique<Made>(name, pair, where, make));
  };
  add("subsimplex", [](Shape a, Shape b, Simplex s) { return btSubsimplexConvexCast(a, b, s); });
  add("GJK", [](Shape a, Shape b, Simplex s) { return btGjkConvexCast(a, b, s); });
  add("continuous", [&depth](Shape a, Shape b, Simplex s) {
    return btContinuousConvexCollision(a, b, s, &depth);
  });
  race({&ours, &peers}, options.rounds);
  // Bullet stops at a thousandth of a length; motions are about as long as the shapes or longer.
  constexpr Trust trust = {2e-4};
  const auto right = [&](const Caster& peer) {
    return compare(ours[0]->answers(), peer.answers(), trust).holds;
  };
  table.add(Duel{"time of impact: " + pair.name, "translations", *ours[0], fastest(peers, right),
                 "Bullet's cast, ", where.size(), pair.impact_goal, trust});
}

}  // namespace

std::vector<Section> impact_sections() {
  std::vector<Section> sections;
  for (const Pair& pair : all_pairs())
    sections.push_back(
        {"time of impact: " + pair.name,
         [pair](Table& table, const Options& options) { measure(table, options, pair); }});
  return sections;
}

}  // namespace bench
