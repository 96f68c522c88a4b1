// SPDX-License-Identifier: MIT
#include "bench/peers/ours.h"

#include <algorithm>

#include "core/cast/packet_cast.h"
#include "core/derived/convert.h"

namespace minkray::bench {
namespace {

template <class T>
Hit as_hit(const CastResult<T>& result) {
  Hit hit;
  hit.supports = result.supports;
  if (result.status == Status::exhausted) hit.outcome = Outcome::exhausted;
  if (!result.found()) return hit;
  hit.outcome = Outcome::hit;
  hit.t_base = double(result.t_base);
  hit.t_offset = double(result.t_offset);
  hit.normal = result.normal.template cast<float>();
  return hit;
}

template <class T>
std::unique_ptr<Peer> solver(std::string name, const std::shared_ptr<PreparedShape<T>>& shape,
                             const CastOptions<T>& options) {
  return single_rays<T>(
      std::move(name),
      [shape, options](const Ray<T>& ray) { return cast_ray(*shape, ray, options); }, as_hit<T>);
}

/// Neighbours in packets, in the order of the batch.
template <class T>
class Packets : public Peer {
 public:
  Packets(std::string name, std::shared_ptr<PreparedShape<T>> shape, InstructionSet set)
      : Peer(std::move(name)), shape_(std::move(shape)), set_(set) {}

  void prepare(const RayBatch& rays) override {
    packets_.assign((rays.size() + lanes - 1) / lanes, {});
    answers_.assign(packets_.size(), {});
    for (std::size_t i = 0; i < packets_.size() * lanes; ++i) {
      const std::size_t from = std::min(i, rays.size() - 1);
      Ray<T> ray;
      if constexpr (std::is_same_v<T, float>)
        ray = rays.in_float[from];
      else
        ray = rays.in_double[from];
      packets_[i / lanes].set(static_cast<int>(i % lanes), ray);
    }
  }

  void cast() override {
    for (std::size_t i = 0; i < packets_.size(); ++i)
      cast_packet(*shape_, packets_[i], all_lanes<T>, answers_[i], set_);
  }

  void read(std::span<Hit> hits) const override {
    for (std::size_t i = 0; i < hits.size(); ++i)
      hits[i] = as_hit(answers_[i / lanes].result(static_cast<int>(i % lanes)));
  }

 private:
  static constexpr std::size_t lanes = static_cast<std::size_t>(packet_lanes<T>);

  std::shared_ptr<PreparedShape<T>> shape_;
  InstructionSet set_;
  std::vector<RayPacket<T>> packets_;
  std::vector<CastPacket<T>> answers_;
};

}  // namespace

Peers scalar_solvers(const Shape<double>& shape, bool sweep) {
  const auto f = std::make_shared<PreparedShape<float>>(convert<float>(shape));
  const auto d = std::make_shared<PreparedShape<double>>(shape);
  Peers peers;
  for (const SolverDescription& description : solver_descriptions) {
    // The slow references of the paper's convergence study are not for speed.
    const bool measured = description.kind != SolverKind::first_solution &&
                          description.kind != SolverKind::paper_johnson &&
                          description.kind != SolverKind::paper_signed_volumes;
    if (!measured) continue;
    const std::string name = "minkray-" + std::string(description.name);
    CastOptions<float> in_float;
    in_float.solver = description.kind;
    CastOptions<double> in_double;
    in_double.solver = description.kind;
    peers.push_back(solver<float>(name + "/float", f, in_float));
    peers.push_back(solver<double>(name + "/double", d, in_double));
  }
  struct Tolerance {
    float eps_tol;
    const char* text;
    bool always;
  };
  for (const Tolerance& tolerance :
       {Tolerance{1e-2f, "1e-2", false}, Tolerance{1e-3f, "1e-3", false},
        Tolerance{1e-4f, "1e-4", true}, Tolerance{1e-5f, "1e-5", false},
        Tolerance{1e-6f, "1e-6", false}, Tolerance{1e-8f, "1e-8", false}}) {
    if (!tolerance.always && !sweep) continue;
    CastOptions<float> options;
    options.solver = SolverKind::paper;
    options.eps_tol = tolerance.eps_tol;
    peers.push_back(solver<float>(std::string("paper-") + tolerance.text + "/float", f, options));
  }
  return peers;
}

Peers packet_solvers(const Shape<double>& shape) {
  Peers peers;
  const auto f = std::make_shared<PreparedShape<float>>(convert<float>(shape));
  const auto d = std::make_shared<PreparedShape<double>>(shape);
  peers.push_back(
      std::make_unique<Packets<float>>("minkray-packet-8/float", f, best_instruction_set()));
  peers.push_back(
      std::make_unique<Packets<double>>("minkray-packet-4/double", d, best_instruction_set()));
  if (best_instruction_set() != InstructionSet::sse2)
    peers.push_back(
        std::make_unique<Packets<float>>("minkray-packet-8-sse2/float", f, InstructionSet::sse2));
  return peers;
}

}  // namespace minkray::bench
