// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// spslam_bench_adjustment [MAP...]: bundle adjustment by our solver and by Ceres, at the same cost. The
// problems are those that local mapping and the loop closer make of a map of a real run (spslam run
// --save-map), disturbed; without a map, made up ones.

#include <fmt/core.h>
#include <tbb/global_control.h>
#include <tbb/info.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <ctime>
#include <filesystem>

#include "optimize/with_ceres.h"
#include "spslam/base/random.h"
#include "spslam/loop/full_adjustment.h"
#include "spslam/optimize/synthetic.h"
#include "spslam/system/map_file.h"

namespace {

using namespace spslam;  // NOLINT

constexpr double kTranslation = 0.01, kRotation = 0.1 * M_PI / 180;  // m, rad; 1 sigma
constexpr double kSameCost = 1e-4;                                   // relative, above the minimum
constexpr int kThorough = 60;                                        // steps

struct Settings {
  std::vector<std::filesystem::path> maps;
  int windows = 5, repetitions = 7, threads = tbb::info::default_concurrency();
};

struct Case {
  std::string name;
  Problem problem;
  SolverOptions options;
};

// Poses by 1 cm and 0.1 degrees, inverse depths by what the map says they are uncertain by.
Case disturbed(std::string name, AdjustmentProblem made, const Map& map, const SolverOptions& options) {
  disturb(made.problem, {kTranslation, kRotation, 0, 1});
  Random random(2);
  for (std::size_t l = 0; l < made.landmarks.size(); ++l) {
    const double information = map.find(made.landmarks[l])->information, by = random.normal();
    if (information > 0) made.problem.landmarks[l].inverse_depth += by / std::sqrt(information);
  }
  return {std::move(name), std::move(made.problem), options};
}

// Windows around keyframes spread over the map, and all of it.
std::vector<Case> cases_of(const std::filesystem::path& path, int windows) {
  const SavedMap saved = load_map(path);
  std::vector<KeyframeId> ids;
  for (const auto& [id, keyframe] : saved.map.keyframes()) ids.push_back(id);
  std::vector<Case> cases;
  const AdjustmentOptions local;
  for (int i = 1; i <= windows; ++i) {
    const KeyframeId id =
        ids[(ids.size() - 1) * static_cast<std::size_t>(i) / static_cast<std::size_t>(windows)];
    cases.push_back(disturbed(fmt::format("{} keyframe {}", path.stem().string(), id.value),
                              copy_neighbourhood(saved.map, saved.rig, id, local), saved.map, local.solver));
  }
  FullAdjustmentOptions full;
  full.max_keyframes = 10000;
  cases.push_back(disturbed(path.stem().string() + " whole", copy_full_problem(saved.map, saved.rig, full),
                            saved.map, full.solver));
  return cases;
}

std::vector<Case> made_up_cases() {
  std::vector<Case> cases;
  for (const auto& [cameras, points] : {std::pair{8, 1500}, std::pair{60, 6000}}) {
    SyntheticOptions world;
    world.cameras = cameras, world.hosts = cameras - 1, world.points = points, world.outlier_share = 0.02;
    Case made{fmt::format("made up, {} cameras", cameras), make_synthetic_world(world).truth, {}};
    disturb(made.problem, {kTranslation, kRotation, 0.005, 1});
    cases.push_back(std::move(made));
  }
  return cases;
}

// Milliseconds by the clock, and of the processor: what counts on a machine that has other things to do.
struct Times {
  double wall, cpu;
};

Times milliseconds(const std::function<void()>& work) {
  const auto begin = std::chrono::steady_clock::now();
  const std::clock_t cpu = std::clock();
  work();
  return {std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count(),
          1e3 * static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC};
}

double median(const std::vector<Times>& times, double Times::*which) {
  std::vector<double> values;
  for (const Times& time : times) values.push_back(time.*which);
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Who solves, how often it steps until it is there, and how long that took.
struct Contestant {
  std::string name;
  std::optional<ceres::LinearSolverType> ceres;  // nothing: ours
  int threads = 1, steps = 0;
  double cost = 0;
  std::vector<Times> times = {}, preparing = {};
};

ceres::Solver::Options ceres_options(ceres::LinearSolverType type, int threads, int steps) {
  ceres::Solver::Options options;
  options.linear_solver_type = type;
  options.num_threads = threads;
  options.max_num_iterations = steps;
  options.function_tolerance = options.gradient_tolerance = options.parameter_tolerance = 0;
  options.logging_type = ceres::SILENT;
  return options;
}

// The costs after each step. Of ours: a run for each number of steps, until nothing changes any more.
std::vector<double> costs_of(const Case& made, const Contestant& who) {
  std::vector<double> costs;
  if (who.ceres) {
    test::CeresProblem problem(made.problem, made.options.loss, made.options.loss_scale);
    ceres::Solver::Options options = ceres_options(*who.ceres, who.threads, kThorough);
    options.function_tolerance = 1e-9;
    for (const ceres::IterationSummary& step : problem.solve(options).iterations)
      costs.push_back(2 * step.cost);  // of the best so far
    return costs;
  }
  SolverOptions options = made.options;
  options.relative_decrease = 1e-9;
  for (options.iterations = 0; options.iterations <= kThorough; ++options.iterations) {
    Problem problem = made.problem;
    const SolveSummary summary = solve(problem, options);
    costs.push_back(summary.final_cost);
    if (summary.status == SolveStatus::kConverged) break;
  }
  return costs;
}

void time_once(const Case& made, Contestant& who) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(who.threads));
  if (!who.ceres) {
    Problem problem = made.problem;
    SolverOptions options = made.options;
    options.iterations = who.steps, options.relative_decrease = 0;
    who.times.push_back(milliseconds([&] { who.cost = solve(problem, options).final_cost; }));
    return;
  }
  std::optional<test::CeresProblem> problem;
  who.preparing.push_back(
      milliseconds([&] { problem.emplace(made.problem, made.options.loss, made.options.loss_scale); }));
  const ceres::Solver::Options options = ceres_options(*who.ceres, who.threads, who.steps);
  who.times.push_back(milliseconds([&] { who.cost = problem->solve(options).final_cost; }));
}

std::vector<Contestant> contestants(int threads) {
  std::vector<Contestant> all;
  for (int count = 1; count <= threads; count = count == 1 && threads > 1 ? threads : threads + 1) {
    all.push_back({"ours", {}, count});
    all.push_back({"Ceres, dense", ceres::DENSE_SCHUR, count});
    all.push_back({"Ceres, sparse", ceres::SPARSE_SCHUR, count});
  }
  return all;
}

// Each as many steps as it takes to come within kSameCost of the higher one of the two solvers' minima.
void find_steps(const Case& made, std::vector<Contestant>& all) {
  std::vector<std::vector<double>> costs;
  double target = 0;
  for (const Contestant& who : all) {
    costs.push_back(costs_of(made, who));
    target = std::max(target, (1 + kSameCost) * costs.back().back());
  }
  for (std::size_t i = 0; i < all.size(); ++i)
    all[i].steps = static_cast<int>(
        std::find_if(costs[i].begin(), costs[i].end(), [&](double cost) { return cost <= target; }) -
        costs[i].begin());
}

void compare(const Case& made, const Settings& settings) {
  const auto held = std::count_if(made.problem.poses.begin(), made.problem.poses.end(),
                                  [](const PoseVariable& pose) { return pose.fixed; });
  fmt::print("{}: {} poses and {} held, {} landmarks, {} observations, {}\n", made.name,
             static_cast<std::ptrdiff_t>(made.problem.poses.size()) - held, held,
             made.problem.landmarks.size(), made.problem.observations.size(),
             option_names(made.options.loss)[static_cast<std::size_t>(made.options.loss)]);
  std::vector<Contestant> all = contestants(settings.threads);
  find_steps(made, all);
  for (int i = 0; i < settings.repetitions; ++i)
    for (Contestant& who : all) time_once(made, who);
  Times ours = {};
  for (const Contestant& who : all) {
    const Times time = {median(who.times, &Times::wall), median(who.times, &Times::cpu)};
    if (!who.ceres) ours = time;
    fmt::print("  {:14} {} threads  {:3} steps  cost {:12.3f}  {:9.2f} ms, {:9.2f} ms of CPU", who.name,
               who.threads, who.steps, who.cost, time.wall, time.cpu);
    if (who.ceres)
      fmt::print("  {:6.1f} and {:6.1f} times ours; {:.1f} ms of CPU to prepare", time.wall / ours.wall,
                 time.cpu / ours.cpu, median(who.preparing, &Times::cpu));
    fmt::print("\n");
  }
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  CLI::App app("Bundle adjustment: ours against Ceres");
  app.add_option("maps", settings.maps, "maps of runs (spslam run --save-map)");
  app.add_option("--windows", settings.windows, "local problems of each map")->check(CLI::PositiveNumber);
  app.add_option("--repetitions", settings.repetitions, "their median counts")->check(CLI::PositiveNumber);
  app.add_option("--threads", settings.threads, "beside one")->check(CLI::PositiveNumber);
  CLI11_PARSE(app, argc, argv);
  try {
    if (settings.maps.empty())
      for (const Case& made : made_up_cases()) compare(made, settings);
    for (const std::filesystem::path& path : settings.maps)
      for (const Case& made : cases_of(path, settings.windows)) compare(made, settings);
  } catch (const std::exception& error) {
    fmt::print(stderr, "spslam_bench_adjustment: {}\n", error.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
