// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/eval/html_report.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "spslam/eval/html.h"
#include "spslam/eval/statistics.h"
#include "spslam/eval/svg_chart.h"

namespace spslam {
namespace {

constexpr const char* kStyle = R"(
:root{--ink:#1b2430;--dim:#5d6b7a;--paper:#f6f8fa;--card:#fff;--rule:#dfe5ea;--truth:#8a94a0;--estimate:#0b6bcb;--near:#1f9d4d;--far:#d1342f}
@media(prefers-color-scheme:dark){:root{--ink:#e4eaf0;--dim:#93a1af;--paper:#10151b;--card:#182029;--rule:#2b3642;--truth:#7d8894;--estimate:#58a6ff;--near:#3fb968;--far:#ff6b60}}
body{margin:0;background:var(--paper);color:var(--ink);font:15px/1.5 system-ui,sans-serif}
main{max-width:1080px;margin:0 auto;padding:28px 20px 60px}
h1{font-size:26px;margin:0 0 4px}h2{font-size:17px;margin:0 0 10px}.dim{color:var(--dim)}
.tiles{display:grid;grid-template-columns:repeat(auto-fit,minmax(150px,1fr));gap:12px;margin:20px 0}
.tile,section{background:var(--card);border:1px solid var(--rule);border-radius:10px}
.tile{padding:12px 14px}.tile b{display:block;font-size:22px;font-variant-numeric:tabular-nums}.tile span{color:var(--dim);font-size:13px}
section{padding:16px 18px;margin:14px 0;overflow-x:auto}
svg{width:100%;height:auto;display:block}
.grid{stroke:var(--rule);stroke-width:1;fill:none}.tick{font-size:11px;fill:var(--dim)}.label{font-size:12px;fill:var(--dim)}
.line{fill:none;stroke-width:1.6;stroke-linejoin:round}
.truth{stroke:var(--truth)}.estimate{stroke:var(--estimate)}.near{stroke:var(--near)}.far{stroke:var(--far)}
.guessed{stroke:var(--far);stroke-width:3}.line.truth{stroke-width:3;stroke-opacity:.6}.dot{stroke:none}.dot.truth{fill:var(--truth)}.dot.estimate{fill:var(--estimate)}
.lost{fill:var(--far);fill-opacity:.22}.coasting{fill:#d29922;fill-opacity:.25}.initializing{fill:var(--dim);fill-opacity:.2}
table{border-collapse:collapse;font-variant-numeric:tabular-nums}th,td{padding:4px 14px 4px 0;text-align:right;white-space:nowrap}
.facts td:last-child{white-space:normal;overflow-wrap:anywhere}
th:first-child{text-align:left;font-weight:500}tr.head th{color:var(--dim);font-weight:500;border-bottom:1px solid var(--rule)}
.images{display:grid;grid-template-columns:repeat(auto-fit,minmax(300px,1fr));gap:14px}figure{margin:0}img{width:100%;border-radius:6px}
figcaption{color:var(--dim);font-size:13px}pre{font-size:12px;overflow-x:auto}
.warning{color:var(--far);font-weight:600}
.two,.three{display:grid;gap:0 14px}.two{grid-template-columns:repeat(auto-fit,minmax(430px,1fr))}
.three{grid-template-columns:repeat(auto-fit,minmax(310px,1fr))}
)";

std::string section(const std::string& title, const std::string& body) {
  return body.empty() ? "" : "<section><h2>" + html_escaped(title) + "</h2>\n" + body + "</section>\n";
}

std::string tile(const std::string& value, const std::string& name) {
  return "<div class=\"tile\"><b>" + html_escaped(value) + "</b><span>" + html_escaped(name) +
         "</span></div>\n";
}

// "95 of 100", "frames tracked (3 coasting, 2 lost)"
std::string frames_tile(const std::vector<ReportFrame>& frames) {
  if (frames.empty()) return "";
  const auto count = [&](const char* state) {
    return std::count_if(frames.begin(), frames.end(),
                         [&](const ReportFrame& f) { return f.state == state; });
  };
  std::string others;
  for (const char* state : {"coasting", "lost", "initializing"})
    if (const auto n = count(state); n > 0)
      others += fmt::format("{}{} {}", others.empty() ? "" : ", ", n, state);
  return tile(fmt::format("{} of {}", count("tracking"), frames.size()),
              "frames tracked" + (others.empty() ? "" : " (" + others + ")"));
}

std::string tiles(const ReportInput& input) {
  std::string html;
  if (input.evaluation) {
    const Evaluation& e = *input.evaluation;
    html += tile(fmt::format("{:.3f} m", e.ate.position.rmse), "ATE RMSE");
    if (std::isfinite(e.scale_ratio))
      html += tile(fmt::format("{:.4f}", e.scale_ratio), "scale ratio (1 is right)");
    if (e.rpe_per_second.translation.count > 0) {
      html += tile(fmt::format("{:.3f} m/s", e.rpe_per_second.translation.rmse), "RPE RMSE");
      html += tile(fmt::format("{:.3f} °/s", e.rpe_per_second.rotation.rmse), "RPE RMSE, rotation");
    }
    if (e.kitti.count > 0) html += tile(fmt::format("{:.2f} %", e.kitti.t_rel), "KITTI t_rel");
    html += tile(fmt::format("{:.1f} m", e.truth_length), "true path");
  } else {
    html += tile(fmt::format("{:.1f} m", path_length(input.estimate)), "estimated path");
  }
  html += tile(std::to_string(input.estimate.size()), "poses") + frames_tile(input.frames);
  return "<div class=\"tiles\">\n" + html + "</div>\n";
}

Chart sized_chart(std::string title, std::string x_label, std::string y_label, int width, int height) {
  Chart chart;
  chart.title = std::move(title);
  chart.x_label = std::move(x_label);
  chart.y_label = std::move(y_label);
  chart.width = width;
  chart.height = height;
  return chart;
}

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// Where so much time passed between two neighbours that a line from one to the other would show what nobody
// knows.
std::vector<bool> gaps_before(const std::vector<double>& times) {
  constexpr double kMostSteps = 3.5;  // so that three frames left out are still no gap
  std::vector<bool> gaps(times.size(), false);
  std::vector<double> steps;
  for (std::size_t i = 1; i < times.size(); ++i) steps.push_back(times[i] - times[i - 1]);
  const double usual = statistics_of(steps).median;
  for (std::size_t i = 1; i < times.size(); ++i) gaps[i] = steps[i - 1] > kMostSteps * usual;
  return gaps;
}

// What is not finite breaks the line.
std::vector<Eigen::Vector2d> broken_at(const std::vector<bool>& gaps,
                                       const std::vector<Eigen::Vector2d>& points) {
  std::vector<Eigen::Vector2d> broken;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (gaps[i]) broken.emplace_back(kNan, kNan);
    broken.push_back(points[i]);
  }
  return broken;
}

// The poses of frames that were not measured, each with the one before it, from which it was carried on.
std::vector<Eigen::Vector2d> not_measured(const std::vector<ReportFrame>& frames,
                                          const std::vector<double>& times,
                                          const std::vector<Eigen::Vector2d>& points) {
  std::vector<Eigen::Vector2d> found;
  std::size_t last = points.size();
  auto frame = frames.begin();
  for (std::size_t i = 0; i < points.size(); ++i) {
    while (frame != frames.end() && frame->timestamp < times[i] - 1e-6) ++frame;
    if (frame == frames.end()) break;
    if (frame->timestamp > times[i] + 1e-6 || (frame->state != "coasting" && frame->state != "lost"))
      continue;
    if (i == 0 || last != i - 1) {
      found.emplace_back(kNan, kNan);
      if (i > 0) found.push_back(points[i - 1]);
    }
    found.push_back(points[i]);
    last = i;
  }
  return found;
}

std::vector<Eigen::Vector2d> seen_from_above(const std::vector<SE3>& poses, const Eigen::Matrix3d& page) {
  std::vector<Eigen::Vector2d> points;
  for (const SE3& pose : poses) points.emplace_back((page * pose.translation).head<2>());
  return points;
}

// The page is wider than high: a run that is longer up the page than across is turned to the right.
Eigen::Matrix3d turned_to_fit(const std::vector<SE3>& poses, const Eigen::Matrix3d& level) {
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& point : seen_from_above(poses, level)) box.extend(point);
  if (box.sizes().y() <= box.sizes().x()) return level;
  return so3_exp({0, 0, -M_PI / 2}) * level;
}

// The world's axis that a direction on the page is: "z, m", "-x, m"; "about z, m" if it is a little askew, as
// the water's plane may be.
std::string axis_label(const Eigen::RowVector3d& direction) {
  Eigen::Index axis = 0;
  const double along = direction.cwiseAbs().maxCoeff(&axis);
  if (along < 0.9) return "m";
  return fmt::format("{}{}{}, m", along < 0.999 ? "about " : "", direction[axis] < 0 ? "-" : "", "xyz"[axis]);
}

std::string top_view(const ReportInput& input) {
  std::vector<SE3> estimate, truth;
  std::vector<double> times;
  if (input.evaluation && !input.evaluation->poses.empty())
    for (const AssociatedPose& pose : input.evaluation->poses)
      estimate.push_back(pose.estimate), truth.push_back(pose.truth), times.push_back(pose.timestamp);
  else
    for (const StampedPose& pose : input.estimate)
      estimate.push_back(pose.world_from_camera), times.push_back(pose.timestamp);
  if (estimate.empty()) return "";
  const std::vector<SE3>& shown = truth.empty() ? estimate : truth;
  const bool level_already = !truth.empty() && input.evaluation->options.planar;
  const Eigen::Vector3d up = level_already ? Eigen::Vector3d(0, 0, 1) : up_direction(shown, UpAxis::kAuto);
  const Eigen::Matrix3d page = turned_to_fit(shown, level_from_world(up));
  Chart chart =
      sized_chart("The trajectory from above", axis_label(page.row(0)), axis_label(page.row(1)), 1000, 420);
  chart.equal_scales = true;
  const std::vector<bool> gaps = gaps_before(times);
  if (!truth.empty())
    chart.series.push_back({"ground truth", "truth", broken_at(gaps, seen_from_above(truth, page))});
  const std::vector<Eigen::Vector2d> points = seen_from_above(estimate, page);
  chart.series.push_back({"estimate (circle: start, square: end)", "estimate", broken_at(gaps, points)});
  std::vector<Eigen::Vector2d> guessed = not_measured(input.frames, times, points);
  if (!guessed.empty())
    chart.series.push_back({"not measured: coasting or lost", "guessed", std::move(guessed), false});
  return svg_chart(chart);
}

std::string error_chart(const char* title, const char* unit, const std::vector<double>& timestamps,
                        const std::vector<double>& errors) {
  if (errors.empty()) return "";
  Chart chart = sized_chart(title, "s", unit, 380, 230);
  ChartSeries series{title, "estimate", {}};
  for (std::size_t i = 0; i < errors.size(); ++i)
    series.points.emplace_back(timestamps[i] - timestamps.front(), errors[i]);
  series.points = broken_at(gaps_before(timestamps), series.points);
  chart.series.push_back(std::move(series));
  return svg_chart(chart);
}

std::string error_charts(const Evaluation& e) {
  std::vector<double> times;
  for (const AssociatedPose& pose : e.poses) times.push_back(pose.timestamp);
  const RpeResult& rpe = e.rpe_per_second;
  return "<div class=\"three\">" +
         section("Position error over time", error_chart("ATE", "m", times, e.ate.errors)) +
         section("Relative error per second",
                 error_chart("RPE, translation", "m/s", rpe.timestamps, rpe.translation_errors)) +
         section("Rotation error per second",
                 error_chart("RPE, rotation", "deg/s", rpe.timestamps, rpe.rotation_errors)) +
         "</div>\n";
}

std::vector<std::string> table_row(const char* name, const Statistics& s) {
  const auto cell = [&](double value) { return s.count ? fmt::format("{:.4f}", value) : std::string("-"); };
  return {name, cell(s.mean), cell(s.maximum), cell(s.rmse), cell(s.deviation), cell(s.median)};
}

std::string metrics_table(const Evaluation& e) {
  std::string html = html_table({{"", "mean", "max", "RMSE", "S.D.", "median"},
                                 table_row("ATE [m]", e.ate.position),
                                 table_row("RPE [m/s]", e.rpe_per_second.translation),
                                 table_row("RPE [deg/s]", e.rpe_per_second.rotation),
                                 table_row("RPE per frame [m]", e.rpe_per_frame.translation),
                                 table_row("RPE per frame [deg]", e.rpe_per_frame.rotation)});
  const char* mode = option_names(e.options.align)[static_cast<std::size_t>(e.options.align)];
  html += fmt::format(
      "<p class=\"dim\">{} of {} poses associated; alignment: {}{}; path {:.2f} m estimated, {:.2f} m true",
      e.associated_poses, e.estimate_poses, e.options.planar ? "planar " : "", mode, e.estimate_length,
      e.truth_length);
  if (e.kitti.count > 0)
    html += fmt::format("; KITTI t_rel {:.3f} %, r_rel {:.3f} deg/100 m", e.kitti.t_rel, e.kitti.r_rel);
  for (const std::string& note : e.notes) html += "<br>" + html_escaped(note);
  html += "</p>\n";
  for (const std::string& warning : e.warnings)
    html += "<p class=\"warning\">" + html_escaped(warning) + "</p>\n";
  return html;
}

// Neighbouring frames of one state that is not tracking make one band.
std::vector<ChartBand> state_bands(const std::vector<ReportFrame>& frames) {
  std::vector<ChartBand> bands;
  std::string open;
  for (const ReportFrame& frame : frames) {
    const double t = frame.timestamp - frames.front().timestamp;
    if (!open.empty()) bands.back().to = t;
    if (frame.state == open) continue;
    open = frame.state == "tracking" ? "" : frame.state;
    if (!open.empty())
      bands.push_back({t, t, open, open == "lost" || open == "coasting" ? open : "initializing"});
  }
  return bands;
}

std::string feature_chart(const std::vector<ReportFrame>& frames) {
  if (frames.empty()) return "";
  Chart chart = sized_chart("Near and far features of each frame", "s", "features", 1000, 240);
  ChartSeries near{"near", "near", {}}, far{"far", "far", {}};
  for (const ReportFrame& frame : frames) {
    near.points.emplace_back(frame.timestamp - frames.front().timestamp, frame.near);
    far.points.emplace_back(frame.timestamp - frames.front().timestamp, frame.far);
  }
  chart.series = {std::move(near), std::move(far)};
  chart.bands = state_bands(frames);
  return svg_chart(chart);
}

std::string images(const std::vector<ReportImage>& all) {
  std::string html;
  for (const ReportImage& image : all)
    html += "<figure><img alt=\"" + html_escaped(image.caption) + "\" src=\"data:image/png;base64," +
            base64(image.png) + "\"><figcaption>" + html_escaped(image.caption) + "</figcaption></figure>\n";
  return html.empty() ? "" : "<div class=\"images\">\n" + html + "</div>\n";
}

std::string timing_table(const std::vector<ReportStage>& stages) {
  if (stages.empty()) return "";
  std::vector<std::vector<std::string>> rows = {{"ms", "mean", "p50", "p95", "max"}};
  const auto cell = [](double value) {
    return std::isfinite(value) ? fmt::format("{:.2f}", value) : std::string("-");
  };
  for (const ReportStage& s : stages)
    rows.push_back({s.name, cell(s.mean), cell(s.p50), cell(s.p95), cell(s.maximum)});
  return html_table(rows);
}

std::string facts_table(const std::vector<std::pair<std::string, std::string>>& facts) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& [name, value] : facts) rows.push_back({name, value});
  return facts.empty() ? "" : html_table(rows, false);
}

}  // namespace

std::string html_report(const ReportInput& input) {
  std::string html =
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>" + html_escaped(input.title) +
      "</title>\n<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\"><style>" + kStyle +
      "</style></head>\n<body><main>\n<h1>" + html_escaped(input.title) +
      "</h1>\n<div class=\"dim\">SP-SLAM run report</div>\n";
  for (const std::string& note : input.notes) html += "<p class=\"warning\">" + html_escaped(note) + "</p>\n";
  html += tiles(input);
  html += section("From above", top_view(input));
  if (input.evaluation)
    html += section("Errors", metrics_table(*input.evaluation)) + error_charts(*input.evaluation);
  html += section("Near (green), far (red) and mirrored (orange) features", images(input.images));
  html += section("Features of each frame", feature_chart(input.frames));
  html += "<div class=\"two\">" + section("Time a frame", timing_table(input.timing)) +
          section("The run", "<div class=\"facts\">" + facts_table(input.facts) + "</div>") + "</div>\n";
  if (!input.config.empty())
    html += "<section><details><summary>Effective options</summary><pre>" + html_escaped(input.config) +
            "</pre></details></section>\n";
  return html + "</main></body></html>\n";
}

}  // namespace spslam
