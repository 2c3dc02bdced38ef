// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// An evaluation as text and as JSON.

#include <spdlog/fmt/fmt.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "spslam/base/error.h"
#include "spslam/base/options.h"
#include "spslam/eval/evaluation.h"

namespace spslam {
namespace {

using Json = nlohmann::ordered_json;

std::string row(const char* name, const Statistics& s) {
  if (s.count == 0) return fmt::format("{:<24}         -\n", name);
  return fmt::format("{:<24}{:>10.5f}{:>10.5f}{:>10.5f}{:>10.5f}{:>10.5f}\n", name, s.mean, s.maximum, s.rmse,
                     s.deviation, s.median);
}

std::string head(const Evaluation& e) {
  const AssociationOptions& association = e.options.association;
  std::string how = "by index";
  if (!association.by_index)
    how = association.interpolate ? "to the interpolated truth"
                                  : fmt::format("by time within {} s", association.tolerance);
  std::string text = fmt::format("associated   {} of {} poses with {} of the ground truth, {}\n",
                                 e.associated_poses, e.estimate_poses, e.truth_poses, how);
  text += fmt::format("path length  {:.3f} m estimated, {:.3f} m true", e.estimate_length, e.truth_length);
  if (e.duration > 0) text += fmt::format(", in {:.2f} s", e.duration);
  const char* mode = option_names(e.options.align)[static_cast<std::size_t>(e.options.align)];
  text += fmt::format("\nalignment    {}{}", e.options.planar ? "planar " : "", mode);
  if (std::isfinite(e.scale_ratio))
    text += fmt::format("; scale ratio {:.5f} (estimate times this fits best)", e.scale_ratio);
  return text + "\n";
}

std::string kitti_text(const KittiResult& kitti, bool each_length) {
  if (kitti.count == 0) return "KITTI metric: the path is too short (it needs more than 100 m)\n";
  std::string text = fmt::format("KITTI t_rel {:.4f} %, r_rel {:.4f} deg/100 m over {} motions\n",
                                 kitti.t_rel, kitti.r_rel, kitti.count);
  if (each_length)
    for (const KittiLength& at : kitti.lengths)
      text += fmt::format("  {:>4.0f} m: {:.4f} %, {:.4f} deg/100 m ({} motions)\n", at.length,
                          at.translation, at.rotation, at.count);
  return text;
}

Json json_of(const Statistics& s) {
  return {{"count", s.count}, {"mean", s.mean},    {"max", s.maximum},
          {"rmse", s.rmse},   {"sd", s.deviation}, {"median", s.median}};
}

Json json_of(const KittiResult& kitti) {
  Json lengths = Json::array();
  for (const KittiLength& at : kitti.lengths)
    lengths.push_back({{"length_m", at.length},
                       {"count", at.count},
                       {"t_rel_percent", at.translation},
                       {"r_rel_deg_per_100m", at.rotation}});
  return {{"count", kitti.count},
          {"t_rel_percent", kitti.t_rel},
          {"r_rel_deg_per_100m", kitti.r_rel},
          {"lengths", lengths}};
}

Json json_of(const Similarity& s) {
  Json rotation = Json::array(), translation = Json::array();
  for (int i = 0; i < 3; ++i) translation.push_back(s.translation[i]);
  for (int i = 0; i < 9; ++i) rotation.push_back(s.rotation(i / 3, i % 3));
  return {{"scale", s.scale}, {"rotation_row_major", rotation}, {"translation_m", translation}};
}

// A figure that does not exist is null.
double figure(const Json& object, const char* name) {
  return object.contains(name) && object[name].is_number() ? object[name].get<double>() : std::nan("");
}

std::size_t count_in(const Json& object, const char* name) {
  return object.at(name).get<std::size_t>();
}

Statistics statistics_in(const Json& object) {
  return {count_in(object, "count"), figure(object, "mean"), figure(object, "max"),
          figure(object, "rmse"),    figure(object, "sd"),   figure(object, "median")};
}

KittiResult kitti_in(const Json& object) {
  KittiResult kitti;
  kitti.count = object.at("count").get<decltype(kitti.count)>();
  kitti.t_rel = figure(object, "t_rel_percent");
  kitti.r_rel = figure(object, "r_rel_deg_per_100m");
  return kitti;
}

Evaluation evaluation_in(const Json& json) {
  Evaluation e;
  e.estimate_poses = count_in(json, "estimate_poses");
  e.truth_poses = count_in(json, "truth_poses");
  e.associated_poses = count_in(json, "associated_poses");
  e.options.association.by_index = json.at("associated_by") == "index";
  detail::from_text("align", json.at("align").get<std::string>(), e.options.align);
  e.options.planar = json.at("planar").get<bool>();
  e.estimate_length = figure(json, "estimate_length_m");
  e.truth_length = figure(json, "truth_length_m");
  e.duration = figure(json, "duration_s");
  e.scale_ratio = figure(json, "scale_ratio");
  e.ate.position = statistics_in(json.at("ate_m"));
  e.rpe_per_second.translation = statistics_in(json.at("rpe_m_per_s"));
  e.rpe_per_second.rotation = statistics_in(json.at("rpe_deg_per_s"));
  e.rpe_per_frame.translation = statistics_in(json.at("rpe_m_per_frame"));
  e.rpe_per_frame.rotation = statistics_in(json.at("rpe_deg_per_frame"));
  e.kitti = kitti_in(json.at("kitti"));
  for (const Json& note : json.at("notes")) e.notes.push_back(note.get<std::string>());
  if (json.contains("warnings"))
    for (const Json& warning : json.at("warnings")) e.warnings.push_back(warning.get<std::string>());
  return e;
}

}  // namespace

Evaluation parse_json_report(std::string_view text, const std::string& name) {
  try {
    return evaluation_in(Json::parse(text));
  } catch (const Json::exception& error) {
    throw InputError(name + ": is no report of errors as spslam writes it (" + error.what() + ")");
  } catch (const OptionError& error) {
    throw InputError(name + ": " + error.what());
  }
}

std::string brief_report(const Evaluation& e, const ReportStyle& style) {
  std::string text = head(e);
  text += fmt::format("{:<24}{:>10}{:>10}{:>10}{:>10}{:>10}\n", "", "mean", "max", "RMSE", "S.D.", "median");
  text += row("ATE [m]", e.ate.position);
  if (!e.options.association.by_index) {
    text += row("RPE per second [m/s]", e.rpe_per_second.translation);
    text += row("RPE per second [deg/s]", e.rpe_per_second.rotation);
  }
  text += row("RPE per frame [m]", e.rpe_per_frame.translation);
  text += row("RPE per frame [deg]", e.rpe_per_frame.rotation);
  if (e.options.within > 0)
    text += fmt::format("within {} m          {:.1f} % of the {} poses of the truth\n", e.options.within,
                        100 * e.share_within, e.truth_poses);
  if (style.kitti_lengths || e.kitti.count > 0) text += kitti_text(e.kitti, style.kitti_lengths);
  for (const std::string& note : e.notes) text += "note: " + note + "\n";
  for (const std::string& warning : e.warnings) text += "WARNING: " + warning + "\n";
  return text;
}

std::string json_report(const Evaluation& e) {
  const char* mode = option_names(e.options.align)[static_cast<std::size_t>(e.options.align)];
  const Json json = {
      {"estimate_poses", e.estimate_poses},
      {"truth_poses", e.truth_poses},
      {"associated_poses", e.associated_poses},
      {"associated_by", e.options.association.by_index ? "index" : "time"},
      {"align", mode},
      {"planar", e.options.planar},
      {"estimate_length_m", e.estimate_length},
      {"truth_length_m", e.truth_length},
      {"duration_s", e.duration},
      {"scale_ratio", e.scale_ratio},
      {"truth_from_estimate", json_of(e.truth_from_estimate)},
      {"ate_m", json_of(e.ate.position)},
      {"share_within", e.options.within > 0 ? Json(e.share_within) : Json()},
      {"rpe_m_per_s", json_of(e.rpe_per_second.translation)},
      {"rpe_deg_per_s", json_of(e.rpe_per_second.rotation)},
      {"rpe_m_per_frame", json_of(e.rpe_per_frame.translation)},
      {"rpe_deg_per_frame", json_of(e.rpe_per_frame.rotation)},
      {"kitti", json_of(e.kitti)},
      {"notes", e.notes},
      {"warnings", e.warnings},
  };
  return json.dump(2) + "\n";
}

}  // namespace spslam
