// SPDX-License-Identifier: MIT
// Measurements, as tables to read and as JSON.
#pragma once

#include <iosfwd>

#include "bench/image/casts.h"
#include "bench/image/time_to_image.h"
#include "renderer/json/json.h"

namespace minkray::bench {

/// One line of the table of goals.
struct Goal {
  std::string what;
  std::string asked;     ///< "at least 3"
  double bound = 0;      ///< that number
  bool at_most = false;  ///< else at least
  double measured = 0;

  bool met() const { return at_most ? measured <= bound : measured >= bound; }
};

void print(std::ostream& out, const CastResults& results);
void print(std::ostream& out, const std::vector<ImageTime>& times);
void print(std::ostream& out, const std::vector<Goal>& goals);

Json as_json(const CastResults& results);
Json as_json(const std::vector<ImageTime>& times);
Json as_json(const std::vector<Goal>& goals);

}  // namespace minkray::bench
