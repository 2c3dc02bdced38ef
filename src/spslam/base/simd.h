// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// SPSLAM_SIMD before a hot function: the compiler makes one version for any x86-64 and one for AVX2, and the
// machine picks at run time (a level, not a CPU: "arch=haswell" would be taken on that very model only). Not
// under the sanitizers (their runtime is not up when the choice is made).
#pragma once

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(SPSLAM_SANITIZED)
#define SPSLAM_SIMD __attribute__((target_clones("arch=x86-64-v3", "default")))
#else
#define SPSLAM_SIMD
#endif
