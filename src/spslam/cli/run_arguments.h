// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The command line of `spslam run`.
#pragma once

#include <limits>
#include <string>

#include "spslam/cli/run_options.h"
#include "spslam/cli/vocabulary_file.h"
#include "spslam/io/dataset.h"

namespace spslam {

struct RunArguments {
  std::string dataset, output;
  OptionArguments options;
  DatasetOptions reading;
  int start = 0;
  int end = std::numeric_limits<int>::max();
  int samples = 6;
  double checkpoint = 30;  // s
  std::string save_map, load_map;
  std::string vocabulary = kBuiltIn;
  bool localize = false;
  bool sequential = false, realtime = false, ahead = false, overwrite = false, quiet = false;
};

}  // namespace spslam
