// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// What was run, for whoever finds the folder of results a year later.
#pragma once

#include "spslam/cli/run_arguments.h"

namespace spslam {

// "command: spslam run ...", the folder it was given in, the data set and everything else that the options do
// not say; a line each.
std::vector<std::string> provenance(const RunArguments& arguments, const SlamOptions& options);

// config.yaml: version and provenance as comments, then the options. apply_yaml() reads it.
std::string config_text(const std::vector<std::string>& provenance, const SlamOptions& options);

// "preset paper", or with what differs from the nearest preset: "preset paper with threads=sequential". Of
// the options as they are, wherever they came from.
std::string described_options(const SlamOptions& options);

// As a shell takes it; on one line whatever is in it.
std::string shell_word(const std::string& word);

}  // namespace spslam
