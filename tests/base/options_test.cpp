// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/base/options.h"

#include <gmock/gmock.h>

namespace spslam {
namespace {

enum class Shape { kDisc, kBox };
std::span<const char* const> option_names(Shape) {
  static constexpr const char* names[] = {"disc", "box"};
  return names;
}

struct Inner {
  int radius = 3;
  Shape shape = Shape::kDisc;
  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.radius, {"radius", "px", "half width", 1, 9});
    visit(self.shape, {"shape", "", "what it looks like"});
  }
};

struct Outer {
  bool enabled = true;
  double weight = 0.25;
  Inner inner;
  template <class Self, class Visitor>
  static void fields(Self& self, Visitor& visit) {
    visit(self.enabled, {"enabled", "", "whether at all"});
    visit(self.weight, {"weight", "", "how much", 0, 1});
    visit.group("inner", self.inner);
  }
};

std::string message_of(const std::function<void()>& f) {
  try {
    f();
  } catch (const OptionError& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST(Options, ListsAndSetsEveryField) {
  Outer options;
  set_option(options, "inner.radius", "5");
  set_option(options, "inner.shape", "box");
  set_option(options, "enabled", "false");
  set_option(options, "weight", "0.5");
  std::vector<std::string> values;
  for (const OptionText& option : list_options(options)) values.push_back(option.key + "=" + option.value);
  EXPECT_THAT(values,
              testing::ElementsAre("enabled=false", "weight=0.5", "inner.radius=5", "inner.shape=box"));
}

TEST(Options, UnknownKeyNamesTheNearest) {
  Outer options;
  EXPECT_THAT(message_of([&] { set_option(options, "iner.radus", "5"); }),
              testing::HasSubstr("'inner.radius'"));
  EXPECT_THAT(message_of([&] { set_option(options, "radius", "5"); }), testing::HasSubstr("'inner.radius'"));
}

TEST(Options, WrongValueNamesFieldAndConstraint) {
  Outer options;
  EXPECT_THAT(message_of([&] { set_option(options, "inner.radius", "5x"); }),
              testing::HasSubstr("whole number"));
  EXPECT_THAT(message_of([&] { set_option(options, "inner.shape", "ring"); }),
              testing::HasSubstr("disc, box"));
  options.inner.radius = 10;
  EXPECT_THAT(
      message_of([&] { check_options(options); }),
      testing::AllOf(testing::HasSubstr("inner.radius = 10"), testing::HasSubstr("between 1 and 9 px")));
  options.inner.radius = 3;
  options.weight = std::nan("");
  EXPECT_THROW(check_options(options), OptionError);
}

}  // namespace
}  // namespace spslam
