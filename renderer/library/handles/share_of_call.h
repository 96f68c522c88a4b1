// SPDX-License-Identifier: MIT
// Progress of a call that works in several passes.
#pragma once

#include <cstddef>
#include <functional>

#include "renderer/library/handles/work_on_rays.h"

namespace minkray {

/// Runs parts of work that is the share from `first` to `last` of a call.
class ShareOfCall {
 public:
  ShareOfCall(const minkray_options* how, double first, double last)
      : how_(how), first_(first), last_(last) {
    if (!how) return;
    shared_ = {sizeof shared_, how->threads, 0, nullptr, this};
    if (how->progress) shared_.progress = &ShareOfCall::tell;
  }
  ShareOfCall(const ShareOfCall&) = delete;
  ShareOfCall& operator=(const ShareOfCall&) = delete;

  void run(std::size_t count, std::size_t part_size,
           const std::function<void(std::size_t begin, std::size_t end)>& body) const {
    work_on_parts(count, part_size, how_ ? &shared_ : nullptr, body);
  }

 private:
  static int tell(void* user, double done) {
    const auto& self = *static_cast<const ShareOfCall*>(user);
    return self.how_->progress(self.how_->user, self.first_ + done * (self.last_ - self.first_));
  }

  const minkray_options* how_;
  double first_, last_;
  minkray_options shared_ = {};
};

}  // namespace minkray
