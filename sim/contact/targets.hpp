// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The instruction sets that Highway compiles for; to be included before Highway itself.

// One per generation of processors. Left out are SSSE3, AVX3_DL, AVX3_ZEN4, AVX3_SPR and AVX10_2,
// which make no difference to these loops, by their bits in hwy/detect_targets.h: older versions
// lack some names. Vectors of SVE have no size that the compiler knows, so they cannot be members;
// processors with SVE have NEON, too.
#define HWY_DISABLED_TARGETS (0x10D8 | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128)
// Scalar code is compiled where every processor has vectors, too: it is what vectors are compared
// with. Highway's imitation of vectors (EMU128) would not be scalar.
#define HWY_COMPILE_ALL_ATTAINABLE
#define HWY_BROKEN_EMU128 1
