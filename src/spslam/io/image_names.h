// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The images of two eyes by the names of their files: which belong together and in what order they come. For
// io/ only.
//
// Names that are PREFIX number SUFFIX with one prefix and one suffix an eye (left_000012.png,
// 1700000000.05.jpg) are matched and ordered by their number: a decimal, compared as text, without rounding.
// Others are matched by the whole name, "9" before "10". Only names that have nothing in common are taken in
// their order, which is a guess and says so.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace spslam {

struct ImagePairs {
  std::vector<std::filesystem::path> left, right;  // one a frame, in order; some files may be missing
  std::string found;                               // "A has 6 images and B has 5", for messages
  std::string warning;                             // empty unless pairs were guessed
};

// An image that only one eye has is a frame with a missing file. Images that neither eye has are, too, where
// the names count from 0 and the last number says that there were `frames` of them (0: not known). Throws
// InputError for an eye without images, one that ends before the other (a broken copy, no lost image), a name
// that is there twice, and counts that differ where names have nothing in common.
ImagePairs pair_images(const std::filesystem::path& left, const std::filesystem::path& right,
                       std::size_t frames);

}  // namespace spslam
