// SPDX-License-Identifier: MIT
// Results of queries, as JSON and for comparison with a case's `expect`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/cast/cast.h"
#include "core/gjk/subalgorithm.h"
#include "core/proof/check_certificate.h"
#include "renderer/json/json.h"
#include "renderer/query/query.h"

namespace minkray {

enum class Precision : unsigned char { in_float, in_double };

struct AnswerOptions {
  Precision precision = Precision::in_double;
  SolverKind solver = SolverKind::automatic;
  SubalgorithmKind subalgorithm = SubalgorithmKind::projection;  ///< for distances
  double tolerance = 1e-10;  ///< of signed distances, relative to the shapes' sizes
  bool trace = false;
  bool certify = false;  ///< prove the answers of casts
};

/// Facts of a result that --check compares.
struct AnswerFacts {
  std::string status;
  bool hit = false;  ///< hit or inside
  double t = 0;
  std::optional<Vec3<double>> normal;
  double distance = 0;
};

struct Answer {
  Json json;
  AnswerFacts facts;
  std::optional<CertificateVerdict> verdict;  ///< on the answer's certificate, if requested
};

Answer answer(const Query& query, const AnswerOptions& options);

/// Lists the errors of the answer: empty if it is as expected. In float, `float_allowance` is
/// added to the tolerances of a case, which are meant for double.
std::vector<std::string> complaints(const Query& query, const AnswerFacts& facts,
                                    Precision precision);

/// Tolerance between the exact answer and one in float, for the rounding of the query's own
/// numbers: in lengths, float_roundings machine epsilons of the largest coordinate; in t that,
/// divided by the speed against the surface; in the normal, as an angle, its square root.
inline constexpr double float_roundings = 8;

}  // namespace minkray
