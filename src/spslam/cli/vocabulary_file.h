// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// A vocabulary as the command line names it.
#pragma once

#include <string>

#include "spslam/loop/vocabulary.h"

namespace spslam {

inline constexpr const char* kBuiltIn = "built-in";

// kBuiltIn, a binary file, or, if its name ends in .txt, one in DBoW2's text format. Throws InputError.
inline Vocabulary read_vocabulary(const std::string& name) {
  if (name == kBuiltIn) return built_in_vocabulary();
  return name.ends_with(".txt") ? Vocabulary::read_dbow2_text(name) : Vocabulary::open(name);
}

}  // namespace spslam
