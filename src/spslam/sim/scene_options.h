// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0
// The options of a simulated scene, a struct a subject. Lengths in m, world z up, water at z = 0.
#pragma once

#include <span>
#include <string>

#include "spslam/base/options.h"

namespace spslam::sim {

enum class PathShape { kFollow, kTurn, kLoop };
std::span<const char* const> option_names(PathShape);

struct PathOptions {
  PathShape shape = PathShape::kFollow;
  double length = 120;
  double bend = 0.25;
  double bend_length = 90;
  double turn_radius = 4;
  double speed = 1.0;
  double speed_variation = 0.2;
  int stops = 0;
  double stop_duration = 4;
  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.shape,
          {"shape", "", "follow (along the channel), turn (out, a half turn, back) or loop (round a lake)"});
    visit(self.length, {"length", "m", "way the boat makes", 5, 2000});
    visit(self.bend, {"bend", "rad", "how far the channel swings from its mean direction", 0, 1});
    visit(self.bend_length, {"bend_length", "m", "wavelength of those swings", 10, 1000});
    visit(self.turn_radius, {"turn_radius", "m", "radius of the half turn", 1, 50});
    visit(self.speed, {"speed", "m/s", "mean speed while under way", 0.05, 5});
    visit(self.speed_variation, {"speed_variation", "", "slow change of speed, as a share of it", 0, 0.6});
    visit(self.stops, {"stops", "", "how often the boat comes to a halt", 0, 20});
    visit(self.stop_duration, {"stop_duration", "s", "how long it lies still", 0, 60});
  }
};

enum class BankKind { kNone, kRubble, kMasonry, kBrick, kConcrete, kTimber, kEarth, kMixed };
std::span<const char* const> option_names(BankKind);

struct BankOptions {
  BankKind kind = BankKind::kRubble;
  double distance = 7;
  double distance_variation = 0.2;
  double height = 1.5;
  double slope = 35;
  bool railing = false;
  double trees = 12;
  double tree_height = 7;
  double overhang = 0;
  double bushes = 25;
  double reeds = 10;
  double piles = 4;
  double houses = 0;
  double house_setback = 8;
  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.kind,
          {"kind", "",
           "none, rubble, masonry, brick, concrete, timber, earth or mixed (changes along the way)"});
    visit(self.distance, {"distance", "m", "from the boat's way to the water's edge", 1, 1000});
    visit(self.distance_variation,
          {"distance_variation", "", "slow change of the distance, as a share of it", 0, 0.8});
    visit(self.height, {"height", "m", "of the bank above the water", 0.1, 10});
    visit(self.slope, {"slope", "deg", "of a rubble or earth bank", 5, 85});
    visit(self.railing, {"railing", "", "a railing on top"});
    visit(self.trees, {"trees", "per 100 m", "trees", 0, 100});
    visit(self.tree_height, {"tree_height", "m", "mean height of the trees", 1, 40});
    visit(self.overhang, {"overhang", "", "share of trees that hang over the water", 0, 1});
    visit(self.bushes, {"bushes", "per 100 m", "bushes", 0, 200});
    visit(self.reeds, {"reeds", "per 100 m", "clumps of reed at the water's edge", 0, 400});
    visit(self.piles, {"piles", "per 100 m", "groups of piles in front of the bank", 0, 100});
    visit(self.houses, {"houses", "per 100 m", "houses", 0, 10});
    visit(self.house_setback, {"house_setback", "m", "from the water's edge to the houses", 1, 200});
  }
};

enum class ShoreShape { kChannel, kLake };
std::span<const char* const> option_names(ShoreShape);

struct ShoreOptions {
  ShoreShape shape = ShoreShape::kChannel;
  BankOptions left, right;
  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(
        self.shape,
        {"shape", "", "channel (a left and a right bank) or lake (one shore all round, described by right)"});
    visit.group("left", self.left);
    visit.group("right", self.right);
  }
};

struct BackdropOptions {
  double tree_line = 150;
  double tree_density = 0.8;
  double hills = 700;
  double hill_height = 90;
  int towers = 24;
  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.tree_line, {"tree_line", "m", "from the scene's edge to the far line of trees", 5, 500});
    visit(self.tree_density, {"tree_density", "", "how closed that line is", 0, 1});
    visit(self.hills, {"hills", "m", "distance of the hills from the scene's middle", 200, 3000});
    visit(self.hill_height, {"hill_height", "m", "height of the hills", 0, 500});
    visit(self.towers, {"towers", "", "tall buildings on the skyline", 0, 300});
  }
};

struct BridgeOptions {
  int count = 0;
  double position = 0.5;
  double spacing = 60;
  double width = 6;
  double clearance = 3;
  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.count, {"count", "", "bridges over the channel", 0, 10});
    visit(self.position, {"position", "", "of the first, as a share of the channel's length", 0, 1});
    visit(self.spacing, {"spacing", "m", "from one to the next", 5, 1000});
    visit(self.width, {"width", "m", "of the roadway, along the channel", 1, 60});
    visit(self.clearance, {"clearance", "m", "under the beams", 1.5, 20});
  }
};

struct SkyOptions {
  double sun_azimuth = 140;
  double sun_elevation = 50;
  double sun = 1.0;
  double brightness = 1.0;
  double cloud_cover = 0.45;
  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.sun_azimuth, {"sun_azimuth", "deg", "from the first heading, to the left", -360, 360});
    visit(self.sun_elevation, {"sun_elevation", "deg", "above the horizon", 1, 90});
    visit(self.sun, {"sun", "", "strength of the sunlight, 0 = overcast", 0, 3});
    visit(self.brightness, {"brightness", "", "of the sky", 0.001, 10});
    visit(self.cloud_cover, {"cloud_cover", "", "share of the sky under clouds", 0, 1});
  }
};

struct WaterOptions {
  double wind = 2.5;
  double wind_direction = 60;
  double fetch = 150;
  double chop = 1.0;
  double turbidity = 0.06;
  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.wind, {"wind", "m/s", "wind at 10 m, makes the waves (JONSWAP)", 0.3, 15});
    visit(self.wind_direction,
          {"wind_direction", "deg", "where it blows to, from the first heading to the left", -360, 360});
    visit(self.fetch, {"fetch", "m", "over which the wind has blown", 5, 100000});
    visit(self.chop, {"chop", "", "factor on the slopes of the waves", 0, 4});
    visit(self.turbidity, {"turbidity", "", "light that comes back out of the water, as an albedo", 0, 1});
  }
};

struct AirOptions {
  double visibility = 6000;
  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.visibility, {"visibility", "m", "where contrast falls to 2 % (fog below 1000 m)", 5, 100000});
  }
};

struct TrafficOptions {
  int boats = 0;
  double speed = 1.5;
  double spread = 40;
  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.boats, {"boats", "", "other boats under way", 0, 50});
    visit(self.speed, {"speed", "m/s", "their mean speed", 0, 10});
    visit(self.spread, {"spread", "m", "how far ahead of the camera they are spread", 5, 500});
  }
};

struct MotionOptions {
  double wave_height = 0.12;
  double wave_period = 1.8;
  double roll = 1.6;
  double pitch = 1.1;
  double yaw = 0.9;
  double heave = 0.025;
  double roll_frequency = 0.7;
  double pitch_frequency = 0.9;
  double jitter = 0.015;
  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.wave_height, {"wave_height", "m",
                             "significant height; scales all of roll, pitch, yaw and heave from 0.12", 0, 2});
    visit(self.wave_period,
          {"wave_period", "s", "peak period of the JONSWAP spectrum that drives the boat", 0.3, 12});
    visit(self.roll, {"roll", "deg", "RMS at 0.12 m of wave height", 0, 20});
    visit(self.pitch, {"pitch", "deg", "RMS at 0.12 m of wave height", 0, 20});
    visit(self.yaw, {"yaw", "deg", "RMS at 0.12 m of wave height", 0, 20});
    visit(self.heave, {"heave", "m", "RMS at 0.12 m of wave height", 0, 1});
    visit(self.roll_frequency, {"roll_frequency", "Hz", "natural frequency of the hull in roll", 0.05, 5});
    visit(self.pitch_frequency,
          {"pitch_frequency", "Hz", "natural frequency of the hull in pitch and heave", 0.05, 5});
    visit(self.jitter, {"jitter", "deg", "RMS of the engine's shaking, 8 to 25 Hz", 0, 2});
  }
};

struct RigOptions {
  double focal = 360;
  int width = 640;
  int height = 320;
  double baseline = 0.08;
  double above_water = 0.8;
  double forward = 0.4;
  double tilt = 3.0;
  double pan = 0.0;
  double rate = 10;
  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.focal, {"focal", "px", "focal length", 1, 10000});
    visit(self.width, {"width", "px", "image width", 16, 8192});
    visit(self.height, {"height", "px", "image height", 16, 8192});
    visit(self.baseline, {"baseline", "m", "from the left to the right eye", 0.001, 5});
    visit(self.above_water, {"above_water", "m", "height of the eyes", 0.05, 20});
    visit(self.forward, {"forward", "m", "of the boat's middle", -10, 10});
    visit(self.tilt, {"tilt", "deg", "of the optical axes below the horizon, negative = up", -45, 45});
    visit(self.pan, {"pan", "deg", "of the optical axes to the left of the bow", -180, 180});
    visit(self.rate, {"rate", "Hz", "frames", 0.1, 200});
  }
};

struct RenderOptions {
  int samples = 2;
  int edge_samples = 3;
  double edge_contrast = 0.35;
  double detail = 1.0;
  double lens_blur = 0.45;
  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.samples, {"samples", "", "rays a pixel everywhere", 1, 64});
    visit(self.edge_samples, {"edge_samples", "", "further rays where they differ", 0, 256});
    visit(self.edge_contrast, {"edge_contrast", "", "relative difference that calls for them", 0, 10});
    visit(self.detail, {"detail", "", "factor on the number of leaves and stones", 0.02, 10});
    visit(self.lens_blur, {"lens_blur", "px", "standard deviation of the lens's point spread", 0, 3});
  }
};

}  // namespace spslam::sim

#include "spslam/sim/sensor_options.h"
