// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/loop/vocabulary_recall.h"

#include <algorithm>
#include <chrono>
#include <numbers>

#include "spslam/loop/keyframe_index.h"

namespace spslam {
namespace {

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

bool same_place(const PlaceView& a, const PlaceView& b, const PlaceRecallOptions& options) {
  const SE3 motion = a.world_from_camera.inverse() * b.world_from_camera;
  const double cosine = motion.rotation(2, 2);  // between the optical axes
  return motion.translation.norm() <= options.distance &&
         cosine >= std::cos(options.angle * std::numbers::pi / 180) - 1e-12;
}

// Asks one image after the other and counts.
class Measurement {
 public:
  Measurement(std::span<const PlaceView> database, const Vocabulary& vocabulary,
              const PlaceRecallOptions& options)
      : database_(database), options_(options), index_(vocabulary) {}

  // Puts the database's next image into the index.
  void add_next() {
    const auto next = static_cast<std::int64_t>(index_.size());
    index_.add(KeyframeId{next},
               index_.vocabulary().describe(database_[static_cast<std::size_t>(next)].descriptors));
  }
  std::size_t added() const { return index_.size(); }

  void ask(const PlaceView& view) {
    if (added() == 0) return;
    const auto start = std::chrono::steady_clock::now();
    const WordVector words = index_.vocabulary().describe(view.descriptors);
    const double describing = milliseconds_since(start);
    const std::vector<Candidate> answers = index_.query(words);
    result_.describe_ms += describing;
    result_.query_ms += milliseconds_since(start) - describing;
    ++result_.queries;
    count(view, answers);
  }

  RecallResult result() {
    RecallResult out = result_;
    out.certain = static_cast<int>(std::count_if(right_scores_.begin(), right_scores_.end(),
                                                 [&](double score) { return score > out.highest_wrong; }));
    if (out.queries > 0) out.describe_ms /= out.queries, out.query_ms /= out.queries;
    return out;
  }

 private:
  void count(const PlaceView& view, std::span<const Candidate> answers) {
    const auto present = database_.first(added());
    const auto right = [&](const PlaceView& other) { return same_place(view, other, options_); };
    const auto answer_right = [&](const Candidate& answer) {
      return right(database_[static_cast<std::size_t>(answer.id.value)]);
    };
    const bool revisit = std::any_of(present.begin(), present.end(), right);
    const bool first = !answers.empty() && answer_right(answers.front());
    const auto five = answers.first(std::min<std::size_t>(5, answers.size()));
    result_.revisits += revisit;
    result_.first += first;
    result_.among_five += std::any_of(five.begin(), five.end(), answer_right);
    if (first) right_scores_.push_back(answers.front().score);
    if (!first && !answers.empty())
      result_.highest_wrong = std::max(result_.highest_wrong, answers.front().score);
  }

  std::span<const PlaceView> database_;
  const PlaceRecallOptions& options_;
  KeyframeIndex index_;
  RecallResult result_;
  std::vector<double> right_scores_;  // of best answers
};

}  // namespace

RecallResult measure_recall(std::span<const PlaceView> views, const Vocabulary& vocabulary,
                            const PlaceRecallOptions& options) {
  Measurement measurement(views, vocabulary, options);
  for (const PlaceView& view : views) {
    while (views[measurement.added()].timestamp < view.timestamp - options.gap) measurement.add_next();
    measurement.ask(view);
  }
  return measurement.result();
}

RecallResult measure_recall(std::span<const PlaceView> views, std::span<const PlaceView> map,
                            const Vocabulary& vocabulary, const PlaceRecallOptions& options) {
  Measurement measurement(map, vocabulary, options);
  while (measurement.added() < map.size()) measurement.add_next();
  for (const PlaceView& view : views) measurement.ask(view);
  return measurement.result();
}

}  // namespace spslam
