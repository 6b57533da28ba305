// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Instruction sets for which Highway compiles. Include this file before any header of Highway.

// One instruction set per generation of processors. The bits of hwy/detect_targets.h leave out
// SSSE3, AVX3_DL, AVX3_ZEN4, AVX3_SPR and AVX10_2, which make no difference to these loops; bits
// are used because older versions lack some names. Vectors of SVE have no size known to the
// compiler, so they cannot be members; processors with SVE also have NEON.
#define HWY_DISABLED_TARGETS (0x10D8 | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128)
// Scalar code is also compiled if every processor has vectors, because tests compare vectors with
// it. Highway's emulation of vectors (EMU128) would not be scalar.
#define HWY_COMPILE_ALL_ATTAINABLE
#define HWY_BROKEN_EMU128 1
