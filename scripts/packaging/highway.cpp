// SPDX-License-Identifier: GPL-3.0-or-later
// Three functions of the library Highway (hwy/targets.h), for static programs, because Debian has
// no static library of Highway.
#include "sim/contact/targets.hpp"

#include <hwy/highway.h>

namespace hwy {
namespace {

std::int64_t only = 0;  // bits of the instruction sets that a user allows; 0: all

/// Bits of the instruction sets of this processor that have all features which Highway uses.
std::int64_t detected()
{
  std::int64_t targets = HWY_SCALAR | HWY_STATIC_TARGET;
#ifdef __x86_64__
  __builtin_cpu_init();
  const bool sse4 = __builtin_cpu_supports("sse4.2") && __builtin_cpu_supports("aes") &&
                    __builtin_cpu_supports("pclmul");
  const bool avx2 = sse4 && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                    __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2") &&
                    __builtin_cpu_supports("f16c") && __builtin_cpu_supports("lzcnt");
  const bool avx3 = avx2 && __builtin_cpu_supports("avx512f") &&
                    __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq") &&
                    __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512cd");
  targets |= (sse4 ? HWY_SSE4 : 0) | (avx2 ? HWY_AVX2 : 0) | (avx3 ? HWY_AVX3 : 0);
#endif
  return targets;
}

}  // namespace

std::int64_t SupportedTargets()
{
  return only != 0 ? only : detected();
}

void SetSupportedTargetsForTest(std::int64_t targets)
{
  only = targets;
  GetChosenTarget().DeInit();
}

ChosenTarget& GetChosenTarget()
{
  static ChosenTarget chosen;
  return chosen;
}

}  // namespace hwy
