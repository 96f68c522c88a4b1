// SPDX-License-Identifier: MIT
// Checks a user's support function: results must be finite and consistent. Support points s_i along
// unit directions n_i belong to a convex shape if and only if no s_j lies beyond a plane through
// s_i with normal n_i: their hull is one. So proofs from consistent results hold for some shape
// with these points.
#pragma once

#include <atomic>
#include <mutex>
#include <string>
#include <vector>

#include "core/math/bounds.h"
#include "core/shape/custom.h"
#include "core/shape/shape.h"
#include "renderer/library/handles/c_header.h"
#include "renderer/library/handles/gather.h"

namespace minkray {

/// Tolerance by which a support point may lie beyond the plane of another, in sizes of the shape:
/// some thousand roundings of double, but less than any float would make.
inline constexpr double support_contradiction = 1e-12;

/// Any number of threads may call it. After the first inconsistency it returns the same point for
/// ever.
class CustomSupport final : public SupportSource, public BatchSource {
 public:
  /// Calls the function in some hundred directions. Throws CallError if it fails or is
  /// inconsistent.
  explicit CustomSupport(const minkray_support& function, std::size_t gathered = 0,
                         minkray_jet_function with_derivatives = nullptr);
  ~CustomSupport() override;

  /// Description of an invalid result; empty if there was none.
  std::string complaint() const;
  bool has_lied() const { return lied_.load(std::memory_order_acquire); }

  std::size_t most_at_once() const override { return gathered_; }

  /// Compares two of its results; records a contradiction.
  void compare(const Vec3<double>& n, const Vec3<double>& along_n, const Vec3<double>& m,
               const Vec3<double>& along_m) const;

 private:
  /// Directions and results of the first calls, number by number, for loops without branches.
  struct Probes {
    std::vector<double> nx, ny, nz;  ///< directions
    std::vector<double> x, y, z;     ///< their points
    std::vector<double> h;           ///< support function along them
  };

  void support(std::size_t count, const Coordinates* directions,
               Coordinates* points) const override;
  void jets(std::size_t count, const Coordinates* directions, Coordinates* points,
            Derivative* derivatives) const override;
  void answer(std::size_t count, const Coordinates* directions, Coordinates* points) const override;
  void probe();
  void probe_jets(const Coordinates* directions, const Coordinates* points, std::size_t count);
  void check(const Coordinates& n, const Coordinates& point) const;
  void complain(const std::string& what) const;
  /// Runs a function of the user's, which is named in the complaint if it fails.
  template <class Call>
  void run(const char* function, Call&& call) const;

  minkray_support function_;
  minkray_jet_function jets_;
  std::size_t gathered_;
  bool has_bounds_;
  Bounds<double> bounds_;
  double allowed_ = 0;  ///< beyond planes and bounds, in lengths
  Coordinates fallback_ = {0, 0, 0};
  Probes probes_;
  mutable std::atomic<bool> lied_ = false;
  mutable std::mutex mutex_;
  mutable std::string complaint_;
};

/// The custom shapes that a shape is made of, each once.
std::vector<std::shared_ptr<const CustomSupport>> customs_of(const Shape& shape);

/// True if one of them wants many directions per call.
bool are_gathered(const std::vector<std::shared_ptr<const CustomSupport>>& customs);

/// Throws CallError if one of them has lied.
void throw_lie(const std::vector<std::shared_ptr<const CustomSupport>>& customs);
inline void throw_if_lied(const std::vector<std::shared_ptr<const CustomSupport>>& customs) {
  if (!customs.empty()) [[unlikely]]
    throw_lie(customs);
}

/// Throws CallError if this thread is running the function of one of them: a query from within it
/// would never end.
void refuse_running(const std::vector<std::shared_ptr<const CustomSupport>>& customs,
                    const char* argument);
inline void refuse_if_running(const std::vector<std::shared_ptr<const CustomSupport>>& customs,
                              const char* argument) {
  if (!customs.empty()) [[unlikely]]
    refuse_running(customs, argument);
}

/// Keeps why the support function that this thread is running fails.
void keep_support_failure(const char* reason);

}  // namespace minkray
