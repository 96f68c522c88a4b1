// SPDX-License-Identifier: MIT
// Answers queries in which a body is a mesh: rays as in a World, pairs as in core/parts.
#pragma once

#include "renderer/query/answer.h"

namespace minkray {

void answer_at_mesh(const RayQuery& query, const AnswerOptions& options, Answer& answer);
void answer_at_mesh(const ShapeQuery& query, const AnswerOptions& options, Answer& answer);
void answer_at_mesh(const DistanceQuery& query, const AnswerOptions& options, Answer& answer);
void answer_at_mesh(const SignedDistanceQuery& query, const AnswerOptions& options, Answer& answer);
void answer_at_mesh(const ManifoldQuery& query, const AnswerOptions& options, Answer& answer);
void answer_at_mesh(const ImpactQuery& query, const AnswerOptions& options, Answer& answer);

}  // namespace minkray
