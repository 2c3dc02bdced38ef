// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The files that a run leaves.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "spslam/cli/run_folder.h"
#include "spslam/cli/run_tables.h"
#include "spslam/eval/evaluation.h"

namespace spslam {

// Against the data set's truth. Nothing without one, or if too little of it belongs to what was done.
std::optional<Evaluation> evaluate_run(const Dataset& dataset, const RunRecord& record);

// What is tried whatever became of what was tried before: a map must not be lost because a table could not be
// written.
class Attempts {
 public:
  // Does it; logs and keeps what is thrown.
  void attempt(const std::function<void()>& work);
  // One error that says all that failed, if anything did.
  void throw_failures() const;

 private:
  std::vector<std::string> failures_;
};

void write_results(const ResultFolder& folder, const Dataset& dataset, const RunRecord& record,
                   const std::optional<Evaluation>& evaluation, Attempts& attempts);

}  // namespace spslam
