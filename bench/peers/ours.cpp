// SPDX-License-Identifier: MIT
#include "bench/peers/ours.h"

#include "core/shape/convert.h"
#include "core/solver/cast.h"

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
  return single_rays<T>(std::move(name), [shape, options](const Ray<T>& ray) {
    return as_hit(cast_ray(*shape, ray, options));
  });
}

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

/// No packets yet: each `cast_packet` becomes a Peer here, "minkray-packet-8/float" and
/// "minkray-packet-4/double", whose prepare() brings the rays into packets. The table and the
/// comparisons in measures.cpp find them by these names.
Peers packet_solvers(const Shape<double>&) {
  return {};
}

}  // namespace minkray::bench
