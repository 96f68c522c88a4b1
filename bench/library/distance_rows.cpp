// SPDX-License-Identifier: MIT
// Signed distances of two shapes, compared with Bullet's GJK and EPA.
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

#include "pairs.h"
#include "sections.h"

namespace bench {
namespace {

class OurDistances : public Caster {
 public:
  OurDistances(const Pair& pair, const std::vector<Meeting>& meetings)
      : Caster("signed_distance"), pair_(pair), meetings_(meetings), found_(meetings.size()) {}

  void cast() override {
    for (std::size_t i = 0; i < meetings_.size(); ++i)
      found_[i] = mk::signed_distance(pair_.a.ours.shape, meetings_[i].a, pair_.b.ours.shape,
                                      meetings_[i].b);
  }
  std::vector<Answer> answers() const override {
    std::vector<Answer> all;
    for (const mk::Distance& found : found_) all.push_back({found.value, 0});
    return all;
  }

 private:
  const Pair& pair_;
  const std::vector<Meeting>& meetings_;
  std::vector<mk::Distance> found_;
};

class BulletDistances : public Caster {
 public:
  BulletDistances(const std::string& name_, std::shared_ptr<btConvexShape> a,
                  std::shared_ptr<btConvexShape> b, const std::vector<Meeting>& meetings)
      : Caster(name_), a_(std::move(a)), b_(std::move(b)), found_(meetings.size()) {
    for (const Meeting& one : meetings) poses_.push_back({to_bullet(one.a), to_bullet(one.b)});
  }

  void cast() override {
    for (std::size_t i = 0; i < poses_.size(); ++i) {
      btVoronoiSimplexSolver simplex;
      btGjkPairDetector detector(a_.get(), b_.get(), &simplex, &depth_);
      btGjkPairDetector::ClosestPointInput input;
      input.m_transformA = poses_[i].first;
      input.m_transformB = poses_[i].second;
      btPointCollector output;
      detector.getClosestPoints(input, output, nullptr);
      found_[i] = output.m_hasResult ? Answer{output.m_distance, 0} : Answer{};
    }
  }
  std::vector<Answer> answers() const override { return found_; }

 private:
  std::shared_ptr<btConvexShape> a_, b_;
  btGjkEpaPenetrationDepthSolver depth_;
  std::vector<std::pair<btTransform, btTransform>> poses_;
  std::vector<Answer> found_;
};

void measure(Table& table, const Options& options, const Pair& pair, bool apart) {
  const std::vector<Meeting> where = meetings(pair, options.queries, apart);
  Casters ours, peers;
  ours.push_back(std::make_unique<OurDistances>(pair, where));
  peers.push_back(std::make_unique<BulletDistances>("no margin", pair.a.without_margin,
                                                    pair.b.without_margin, where));
  if (pair.a.with_margin && pair.b.with_margin)
    peers.push_back(std::make_unique<BulletDistances>("usual margin", pair.a.with_margin,
                                                      pair.b.with_margin, where));
  race({&ours, &peers}, options.rounds);
  // Bullet counts in floats and stops at a thousandth of the distance; its depths are coarser.
  const Trust trust = {apart ? 1e-4 : 1e-3};
  const auto right = [&](const Caster& peer) {
    return compare(ours[0]->answers(), peer.answers(), trust).holds;
  };
  table.add(Duel{"distance: " + pair.name, apart ? "apart" : "overlapping", *ours[0],
                 fastest(peers, right), "Bullet's GJK and EPA, ", where.size(),
                 apart ? pair.distance_goal : 0, trust});
}

}  // namespace

std::vector<Section> distance_sections() {
  std::vector<Section> sections;
  for (const Pair& pair : all_pairs())
    sections.push_back({"distance: " + pair.name, [pair](Table& table, const Options& options) {
                          measure(table, options, pair, true);
                          measure(table, options, pair, false);
                        }});
  return sections;
}

}  // namespace bench
