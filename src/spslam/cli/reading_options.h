// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// How data sets are read, as every subcommand that reads them takes it from the command line.
#pragma once

#include <CLI/CLI.hpp>

#include "spslam/io/dataset.h"

namespace spslam {

// Adds an option for each field of DatasetOptions: --format, --calibration, --rate, --pair-tolerance, ...
void add_reading_options(CLI::App& command, DatasetOptions& reading);

void log_warnings(const Dataset& dataset);

}  // namespace spslam
