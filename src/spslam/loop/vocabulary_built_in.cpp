// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The bytes of config/vocabulary.spv become part of this object file: the assembler copies them in.
// CMakeLists.txt names the file and makes this depend on it. Works with GCC and Clang, wherever programs are
// ELF files.

#include "spslam/loop/vocabulary.h"

asm(R"(
  .pushsection .rodata
  .balign 64
  .hidden spslam_vocabulary_begin
  .hidden spslam_vocabulary_end
  .global spslam_vocabulary_begin
  .global spslam_vocabulary_end
spslam_vocabulary_begin:
  .incbin ")" SPSLAM_VOCABULARY R"("
spslam_vocabulary_end:
  .byte 0
  .popsection
)");

extern "C" {
extern const std::byte spslam_vocabulary_begin[];  // NOLINT(modernize-avoid-c-arrays)
extern const std::byte spslam_vocabulary_end[];    // NOLINT(modernize-avoid-c-arrays)
}

namespace spslam {

Vocabulary built_in_vocabulary() {
  // Nobody owns the bytes: they are there as long as the program.
  return {nullptr, {spslam_vocabulary_begin, spslam_vocabulary_end}, "built-in vocabulary"};
}

}  // namespace spslam
