// SPDX-License-Identifier: MIT
// The choice between code for different instruction sets: one test for the whole library.
#pragma once

namespace minkray {

/// Instruction sets that vector code is compiled for. `avx2` includes FMA.
enum class InstructionSet : unsigned char { sse2, avx2 };

/// The widest of these that this machine has.
[[gnu::always_inline]] inline InstructionSet best_instruction_set() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return InstructionSet::avx2;
#endif
  return InstructionSet::sse2;
}

[[gnu::always_inline]] inline bool has_avx2() {
  return best_instruction_set() == InstructionSet::avx2;
}

}  // namespace minkray
