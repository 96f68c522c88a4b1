// SPDX-License-Identifier: MIT
#include "renderer/jobs/audit_report.h"

#include <iostream>

namespace minkray {

void report(const RayAudit& audit) {
  std::uint64_t failed = 0;
  std::cerr << "certified   " << audit.certificates() << " certificates for";
  for (std::size_t i = 0; i < ray_kind_names.size(); ++i) {
    const auto kind = static_cast<RayKind>(i);
    failed += audit.failed(kind);
    std::cerr << (i == 0 ? " " : ", ") << audit.rays(kind) << " " << ray_kind_names[i] << " rays";
  }
  std::cerr << "; without proof " << failed << "\n";
  for (const AuditFailure& failure : audit.failures())
    std::cerr << failure.message << "\n" << failure.query << (failure.query.empty() ? "" : "\n");
  if (failed > 0)
    std::cerr << "pass the lines in braces to minkray cast --certify to see each failure\n";
}

}  // namespace minkray
