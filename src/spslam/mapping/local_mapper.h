// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// Local mapping, the second of the three threads: the only writer of the map. It takes keyframes in, corrects
// landmarks by several views (Figure 7) and their neighbourhood by bundle adjustment (3.2.2), forgets what is
// not needed, and publishes the neighbourhood of the newest keyframe for the tracker.
#pragma once

#include "spslam/mapping/culling.h"
#include "spslam/mapping/describe.h"
#include "spslam/mapping/fuse.h"
#include "spslam/mapping/local_adjustment.h"
#include "spslam/mapping/retriangulate.h"
#include "spslam/mapping/triangulate.h"

namespace spslam {

struct LocalMapperOptions {
  int view_keyframes = 20;
  DescribeOptions features;
  RetriangulationOptions retriangulation;
  AdjustmentOptions adjustment;
  TriangulationOptions triangulation;
  DuplicateOptions duplicates;
  CullingOptions culling;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.view_keyframes,
          {"view_keyframes", "", "keyframes in the view that is published for the tracker", 1, 1000});
    visit.group("features", self.features);
    visit.group("retriangulation", self.retriangulation);
    visit.group("adjustment", self.adjustment);
    visit.group("triangulation", self.triangulation);
    visit.group("duplicates", self.duplicates);
    visit.group("culling", self.culling);
  }
};

// What became of one keyframe.
struct MappingResult {
  KeyframeId keyframe;
  int retriangulated = 0;   // landmarks
  SolveSummary adjustment;  // of the local bundle adjustment, if it ran
  int outliers = 0, culled_landmarks = 0;
  int triangulated = 0, fused = 0;  // landmarks made between keyframes; duplicates that became one
  std::vector<KeyframeId> culled;   // keyframes
  LocalMapView view;
};

class LocalMapper {
 public:
  // Throws OptionError. map: what is known already.
  LocalMapper(const StereoRig& rig, const OrbOptions& orb, const LocalMapperOptions& options, Map map = {});

  // Takes a keyframe in. `stop` says that a newer one waits: adjustment ends with what it has.
  MappingResult insert(KeyframeProposal proposal, const std::function<bool()>& stop = {});
  // Lets somebody else's correction (a closed loop, an adjustment of the whole map) be written, so that there
  // is one writer, and says what the neighbourhood of the newest keyframe looks like then.
  LocalMapView correct(const std::function<void(Map&)>& write);
  const Map& map() const { return map_; }

 private:
  void add(KeyframeProposal proposal);
  void adjust(const std::function<bool()>& stop, MappingResult& result);
  LocalMapView view(KeyframeId newest);

  StereoRig rig_;
  LocalMapperOptions options_;
  OrbExtractor extractor_;
  Map map_;
  LandmarkId next_landmark_;  // of those made here; not valid when the ids are used up
  std::int64_t revision_ = 0;
  std::vector<KeyframeId> with_images_;  // ascending
};

}  // namespace spslam
