// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Local mapping, the second of the three threads: the only writer of the map. It takes keyframes in and
// publishes the neighbourhood of the newest one for the tracker.
#pragma once

#include "spslam/map/map.h"

namespace spslam {

struct LocalMapperOptions {
  int view_keyframes = 10;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.view_keyframes,
          {"view_keyframes", "", "newest keyframes in the view that is published for the tracker", 1, 1000});
  }
};

class LocalMapper {
 public:
  explicit LocalMapper(const LocalMapperOptions& options) : options_(options) { check_options(options); }

  // Inserts the keyframe and its landmarks and takes over the tracker's estimates of those it knows.
  LocalMapView insert(KeyframeProposal proposal);
  const Map& map() const { return map_; }

 private:
  LocalMapView view() const;

  LocalMapperOptions options_;
  Map map_;
  std::int64_t revision_ = 0;
};

}  // namespace spslam
