// SPDX-License-Identifier: MIT
#include "bench/peers/ours.h"

#include <algorithm>

#include "core/cast/packet_cast.h"
#include "renderer/paper/solvers.h"

namespace minkray::bench {
namespace {

Hit as_hit(const CastResult<double>& result) {
  Hit hit;
  hit.supports = result.supports;
  if (result.status == Status::exhausted) hit.outcome = Outcome::exhausted;
  if (!result.found()) return hit;
  hit.outcome = Outcome::hit;
  hit.t_base = result.t_base;
  hit.t_offset = result.t_offset;
  hit.normal = result.normal.cast<float>();
  return hit;
}

std::unique_ptr<Peer> solver(std::string name, const std::shared_ptr<PreparedShape>& shape,
                             const CastOptions& options) {
  return single_rays<double>(
      std::move(name),
      [shape, options](const Ray<double>& ray) { return cast_ray(*shape, ray, options); }, as_hit);
}

/// Neighbours in packets, in the order of the batch.
class Packets : public Peer {
 public:
  Packets(std::string name, std::shared_ptr<PreparedShape> shape, InstructionSet set)
      : Peer(std::move(name)), shape_(std::move(shape)), set_(set) {}

  void prepare(const RayBatch& rays) override {
    packets_.assign((rays.size() + lanes - 1) / lanes, {});
    answers_.assign(packets_.size(), {});
    for (std::size_t i = 0; i < packets_.size() * lanes; ++i) {
      const std::size_t from = std::min(i, rays.size() - 1);
      packets_[i / lanes].set(static_cast<int>(i % lanes), rays.in_double[from]);
    }
  }

  void cast() override {
    for (std::size_t i = 0; i < packets_.size(); ++i)
      cast_packet(*shape_, packets_[i], all_lanes, answers_[i], set_);
  }

  void read(std::span<Hit> hits) const override {
    for (std::size_t i = 0; i < hits.size(); ++i)
      hits[i] = as_hit(answers_[i / lanes].result(static_cast<int>(i % lanes)));
  }

 private:
  static constexpr std::size_t lanes = static_cast<std::size_t>(packet_lanes);

  std::shared_ptr<PreparedShape> shape_;
  InstructionSet set_;
  std::vector<RayPacket> packets_;
  std::vector<CastPacket> answers_;
};

}  // namespace

Peers scalar_solvers(const Shape& shape, bool sweep) {
  const auto prepared = std::make_shared<PreparedShape>(shape);
  Peers peers;
  for (const auto& description : named_solvers) {
    // The slow references of the paper's convergence study are not for speed.
    const bool measured = description.kind != &solver::first_solution &&
                          description.kind != &solver::paper_johnson &&
                          description.kind != &solver::paper_signed_volumes;
    if (!measured) continue;
    CastOptions options;
    options.solver = description.kind;
    peers.push_back(solver("minkray-" + std::string(description.name), prepared, options));
  }
  struct Tolerance {
    double eps_tol;
    const char* text;
    bool always;
  };
  for (const Tolerance& tolerance :
       {Tolerance{1e-2, "1e-2", false}, Tolerance{1e-3, "1e-3", false},
        Tolerance{1e-4, "1e-4", true}, Tolerance{1e-5, "1e-5", false},
        Tolerance{1e-6, "1e-6", false}, Tolerance{1e-8, "1e-8", false}}) {
    if (!tolerance.always && !sweep) continue;
    CastOptions options;
    options.solver = &solver::gjk_alone;
    options.eps_tol = tolerance.eps_tol;
    peers.push_back(solver(std::string("paper-") + tolerance.text, prepared, options));
  }
  return peers;
}

Peers packet_solvers(const Shape& shape) {
  Peers peers;
  const auto prepared = std::make_shared<PreparedShape>(shape);
  peers.push_back(std::make_unique<Packets>("minkray-packet-4", prepared, best_instruction_set()));
  if (best_instruction_set() != InstructionSet::sse2)
    peers.push_back(
        std::make_unique<Packets>("minkray-packet-4-sse2", prepared, InstructionSet::sse2));
  return peers;
}

}  // namespace minkray::bench
