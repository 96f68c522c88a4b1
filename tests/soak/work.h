// SPDX-License-Identifier: MIT
// The kinds of work of a round, each a function whose answers are the same bits in every round.
#pragma once

#include <minkray/minkray.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace soak {

namespace mk = minkray;

/// A hash of the answers' bits in the order in which they come (FNV-1a).
class Answers {
 public:
  template <class T>
  requires std::is_trivially_copyable_v<T>
  void add(const T& value) { add_bytes(&value, sizeof value); }
  template <class T>
  void add_all(const std::vector<T>& values) {
    add_bytes(values.data(), values.size() * sizeof(T));
  }
  void add_text(const std::string& text) { add_bytes(text.c_str(), text.size() + 1); }
  std::uint64_t hash() const { return hash_; }

 private:
  void add_bytes(const void* data, std::size_t size) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < size; ++i) hash_ = (hash_ ^ bytes[i]) * 0x100000001b3u;
  }
  std::uint64_t hash_ = 0xcbf29ce484222325u;
};

/// Data shared by all the work of one phase of a round.
struct Common {
  const mk::Scene& scene;      ///< queried by all at once
  int threads = 1;             ///< that a call may use: another number in each round
  std::atomic<long>& stopped;  ///< counts the calls that were stopped half-way
};

struct Kind {
  const char* name;
  void (*work)(const Common& common, Answers& answers);
};

void single_casts(const Common& common, Answers& answers);
void batches(const Common& common, Answers& answers);
void proofs(const Common& common, Answers& answers);
void scans(const Common& common, Answers& answers);
void stopped_casts(const Common& common, Answers& answers);
void distances(const Common& common, Answers& answers);
void first_contacts(const Common& common, Answers& answers);
void clearances(const Common& common, Answers& answers);
void edits(const Common& common, Answers& answers);
void files(const Common& common, Answers& answers);
void custom_shapes(const Common& common, Answers& answers);
void pictures(const Common& common, Answers& answers);
void paths_of_light(const Common& common, Answers& answers);
void stopped_pictures(const Common& common, Answers& answers);
void mistakes(const Common& common, Answers& answers);

inline constexpr Kind kinds[] = {
    {"single casts", single_casts},
    {"batches", batches},
    {"proofs", proofs},
    {"scans", scans},
    {"stopped casts", stopped_casts},
    {"distances", distances},
    {"first contacts", first_contacts},
    {"clearances", clearances},
    {"edits", edits},
    {"files", files},
    {"custom shapes", custom_shapes},
    {"pictures", pictures},
    {"paths of light", paths_of_light},
    {"stopped pictures", stopped_pictures},
    {"mistakes", mistakes},
};

/// A file of the source tree.
std::string source_file(const std::string& name);

inline void expect(bool holds, const char* what) {
  if (!holds) throw std::runtime_error(what);
}

/// Calls `call(options)`, and stops it once this part of it is done. The call must end as stopped
/// if and only if it was requested to; returns true if it was.
bool stopped_after(double part, int threads, const std::function<void(const mk::Options&)>& call);

}  // namespace soak
