// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/eval/html_report.h"

#include <gmock/gmock.h>

#include <limits>

#include "eval/synthetic.h"
#include "spslam/eval/html.h"
#include "spslam/eval/svg_chart.h"

namespace spslam {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

// Every element that is opened is closed in order; the void elements of this page are meta, img and br.
bool is_balanced(const std::string& html) {
  std::vector<std::string> open;
  for (std::size_t at = html.find('<'); at != std::string::npos; at = html.find('<', at + 1)) {
    const std::size_t end = html.find('>', at);
    if (end == std::string::npos) return false;
    const std::string tag = html.substr(at + 1, end - at - 1);
    const std::string name = tag.substr(tag[0] == '/', tag.find_first_of(" /", 1) - (tag[0] == '/'));
    if (tag[0] == '!' || tag.back() == '/' || name == "meta" || name == "img" || name == "br") continue;
    if (tag[0] != '/')
      open.push_back(name);
    else if (open.empty() || open.back() != tag.substr(1))
      return false;
    else
      open.pop_back();
  }
  return open.empty();
}

TEST(Html, Base64OfTheRfcsExamples) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64(std::string("\xff\x00\xfe", 3)), "/wD+");
}

TEST(Html, EscapesWhatHasAMeaning) {
  EXPECT_EQ(html_escaped("<a href=\"x\">&'"), "&lt;a href=&quot;x&quot;&gt;&amp;&#39;");
}

TEST(SvgChart, TicksAreRound) {
  EXPECT_DOUBLE_EQ(tick_step(10, 5), 2);
  EXPECT_DOUBLE_EQ(tick_step(9, 5), 1);
  EXPECT_DOUBLE_EQ(tick_step(0.027, 5), 0.005);
  EXPECT_DOUBLE_EQ(tick_step(3700, 5), 500);
  EXPECT_DOUBLE_EQ(tick_step(0, 5), 1);
  EXPECT_DOUBLE_EQ(tick_step(std::numeric_limits<double>::infinity(), 5), 1);
}

TEST(SvgChart, WhatIsNotFiniteBreaksTheLine) {
  Chart chart;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  chart.series.push_back({"a", "estimate", {{0, 1}, {1, 2}, {2, nan}, {3, 1}, {4, 2}}});
  const std::string svg = svg_chart(chart);
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  const std::string path = svg.substr(svg.find("class=\"line estimate\" d=\""), 120);
  EXPECT_EQ(count_of(path.substr(0, path.find("/>")), "M"), 2u);
  EXPECT_TRUE(is_balanced(svg));
}

TEST(SvgChart, NothingOrOnePointIsStillAChart) {
  Chart chart;
  EXPECT_TRUE(is_balanced(svg_chart(chart)));
  chart.series.push_back({"one", "truth", {{5, 5}}});
  chart.equal_scales = true;
  EXPECT_THAT(svg_chart(chart), AllOf(Not(HasSubstr("nan")), Not(HasSubstr("inf"))));
}

TEST(SvgChart, ALongSeriesKeepsItsExtremes) {
  Chart chart;
  ChartSeries series{"long", "estimate", {}};
  for (int i = 0; i < 200000; ++i) series.points.emplace_back(i, i == 123457 ? 100.0 : 1.0);
  chart.series.push_back(series);
  const std::string svg = svg_chart(chart);
  EXPECT_LT(svg.size(), 60000u);
  EXPECT_THAT(svg, HasSubstr(" 35.2")) << "the peak, 5 % below the top of the plot";
}

TEST(SvgChart, ALongSeriesKeepsItsBreaks) {
  Chart chart;
  ChartSeries series{"long", "estimate", {}};
  for (int i = 0; i < 50000; ++i) {
    const bool missing = i == 12345 || i == 40000;
    series.points.emplace_back(i, missing ? std::numeric_limits<double>::quiet_NaN() : 1.0 * (i % 7));
  }
  chart.series.push_back(series);
  const std::string svg = svg_chart(chart);
  const std::string path = svg.substr(svg.find("class=\"line estimate\" d=\""));
  EXPECT_EQ(count_of(path.substr(0, path.find("/>")), "M"), 3u);
}

ReportInput full_input() {
  ReportInput input;
  const Trajectory truth = testing_eval::figure_of_eight(300);
  input.title = "bank & <loop>";
  input.estimate = testing_eval::transformed(truth, testing_eval::some_motion(), 0.98);
  input.evaluation = evaluate(input.estimate, truth, {});
  for (int i = 0; i < 300; ++i) {
    const char* state = i < 3 ? "initializing" : i >= 100 && i < 120 ? "lost" : "tracking";
    input.frames.push_back({0.1 * i, state, 200.0 + i, 100.0, i % 10 == 0});
  }
  input.timing = {{"features", 1.5, 1.25, 2.5, 9.75}};
  input.images = {{"frame 7", "PNGBYTES"}};
  input.facts = {{"preset", "sp-slam"}};
  input.config = "preset: sp-slam\n";
  return input;
}

TEST(HtmlReport, HasEveryPartAndLoadsNothing) {
  const std::string html = html_report(full_input());
  for (const char* part :
       {"bank &amp; &lt;loop&gt;", "From above", "Position error over time", "Relative error per second",
        "Features of each frame", "lost", "initializing", "Time a frame", "9.75", "frame 7",
        "data:image/png;base64,UE5HQllURVM=", "ATE [m]", "RPE [deg/s]", "preset: sp-slam"})
    EXPECT_THAT(html, HasSubstr(part));
  EXPECT_THAT(html, AllOf(Not(HasSubstr("<script")), Not(HasSubstr("http")), Not(HasSubstr("<link")),
                          Not(HasSubstr("nan"))));
  EXPECT_EQ(count_of(html, "<svg"), 5u);
  EXPECT_TRUE(is_balanced(html));
}

TEST(HtmlReport, LeavesOutWhatIsNotThere) {
  ReportInput input;
  input.title = "only a way";
  input.estimate = testing_eval::straight_line(20);
  const std::string html = html_report(input);
  EXPECT_THAT(html, AllOf(HasSubstr("1.9 m"), Not(HasSubstr("Errors")), Not(HasSubstr("Time a frame"))));
  EXPECT_EQ(count_of(html, "<svg"), 1u);
  EXPECT_TRUE(is_balanced(html));
}

TEST(HtmlReport, CountsStatesAndMarksWhatWasNotMeasured) {
  ReportInput input = full_input();
  const std::string html = html_report(input);
  EXPECT_THAT(html, AllOf(HasSubstr("277 of 300"), HasSubstr("frames tracked (20 lost, 3 initializing)"),
                          HasSubstr("not measured: coasting or lost"), HasSubstr("class=\"line guessed\"")));
  EXPECT_THAT(html, AllOf(HasSubstr("x, m<"), HasSubstr("z, m<"))) << "seen along y";
  for (ReportFrame& frame : input.frames) frame.state = "tracking";
  EXPECT_THAT(html_report(input), Not(HasSubstr("line guessed")));
}

TEST(HtmlReport, BreaksTheWayWherePosesAreMissing) {
  const auto parts = [](const ReportInput& input) {
    const std::string html = html_report(input);
    const std::string path = html.substr(html.find("class=\"line estimate\" d=\""));
    return count_of(path.substr(0, path.find("/>")), "M");
  };
  ReportInput input;
  input.estimate = testing_eval::figure_of_eight(100);
  EXPECT_EQ(parts(input), 1u);
  input.estimate.erase(input.estimate.begin() + 20, input.estimate.begin() + 22);
  EXPECT_EQ(parts(input), 1u) << "two frames left out";
  input.estimate.erase(input.estimate.begin() + 50, input.estimate.begin() + 70);
  EXPECT_EQ(parts(input), 2u);
}

TEST(HtmlReport, ErrorsWithoutPosesAreATable) {
  ReportInput input = full_input();
  input.evaluation = parse_json_report(json_report(*input.evaluation), "metrics.json");
  const std::string html = html_report(input);
  EXPECT_THAT(html,
              AllOf(HasSubstr("ATE RMSE"), HasSubstr("ATE [m]"), HasSubstr("300 of 300 poses associated"),
                    Not(HasSubstr("Position error over time")), Not(HasSubstr("ground truth"))));
  EXPECT_EQ(count_of(html, "<svg"), 2u);
}

TEST(HtmlReport, IsTheSameEveryTime) {
  EXPECT_EQ(html_report(full_input()), html_report(full_input()));
}

}  // namespace
}  // namespace spslam
