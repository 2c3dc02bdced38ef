// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// What a run leaves: its files and the report on the terminal.
#pragma once

#include <optional>

#include "spslam/cli/run_folder.h"
#include "spslam/cli/run_tables.h"
#include "spslam/eval/evaluation.h"

namespace spslam {

// Against the data set's truth. Nothing without one, or if too little of it belongs to what was done.
std::optional<Evaluation> evaluate_run(const Dataset& dataset, const RunRecord& record);

// Every file is tried, whatever became of the others; throws the first failure.
void write_results(const ResultFolder& folder, const Dataset& dataset, const RunRecord& record,
                   const std::optional<Evaluation>& evaluation);

// For the terminal.
std::string report_text(const std::string& folder, const RunRecord& record,
                        const std::optional<Evaluation>& evaluation);

}  // namespace spslam
