// SPDX-FileCopyrightText: 2026 The SP-SLAM authors
// SPDX-License-Identifier: Apache-2.0

#include "spslam/eval/svg_chart.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "spslam/eval/html.h"

namespace spslam {
namespace {

constexpr double kLeft = 58, kRight = 14, kTop = 26, kBottom = 40;  // px, margins around the plot

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void include(double value) { low = std::min(low, value), high = std::max(high, value); }
  double size() const { return high - low; }
};

// From data to pixels.
struct Frame {
  Range x, y;
  double width = 0, height = 0;  // px, of the plot without margins

  double px(double value) const { return kLeft + (value - x.low) / x.size() * width; }
  double py(double value) const { return kTop + height - (value - y.low) / y.size() * height; }
};

void make_usable(Range& range) {
  if (!(range.size() >= 0)) range = {0, 1};
  if (range.size() <= 1e-12 * std::max(1.0, std::abs(range.high)))
    range = {range.low - 0.5, range.high + 0.5};
}

// Widens the shorter range until both have the same scale.
void make_equal(Frame& frame) {
  const double per_pixel = std::max(frame.x.size() / frame.width, frame.y.size() / frame.height) * 1.06;
  for (auto [range, pixels] : {std::pair{&frame.x, frame.width}, std::pair{&frame.y, frame.height}}) {
    const double middle = 0.5 * (range->low + range->high), half = 0.5 * per_pixel * pixels;
    *range = {middle - half, middle + half};
  }
}

Frame frame_of(const Chart& chart) {
  Frame frame;
  frame.width = chart.width - kLeft - kRight, frame.height = chart.height - kTop - kBottom;
  for (const ChartSeries& series : chart.series)
    for (const Eigen::Vector2d& p : series.points)
      if (p.allFinite()) frame.x.include(p.x()), frame.y.include(p.y());
  if (chart.from_zero && !chart.equal_scales) frame.y.include(0);
  make_usable(frame.x);
  make_usable(frame.y);
  if (chart.equal_scales)
    make_equal(frame);
  else
    frame.y.high += 0.05 * frame.y.size();
  return frame;
}

std::string number_text(double value, double step) {
  if (std::abs(value) < 1e-9 * step) value = 0;
  const int digits = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 9);
  return fmt::format("{:.{}f}", value, digits);
}

std::string axes(const Chart& chart, const Frame& frame) {
  const double bottom = kTop + frame.height, right = kLeft + frame.width;
  std::string svg;
  const double step_x = tick_step(frame.x.size(), 5), step_y = tick_step(frame.y.size(), 4);
  for (double i = std::ceil(frame.x.low / step_x); i * step_x <= frame.x.high; ++i)
    svg += fmt::format(
        "<path class=\"grid\" d=\"M{0:.1f} {1:.1f}V{2:.1f}\"/><text class=\"tick\" x=\"{0:.1f}\" "
        "y=\"{3:.1f}\" "
        "text-anchor=\"middle\">{4}</text>\n",
        frame.px(i * step_x), kTop, bottom, bottom + 15, number_text(i * step_x, step_x));
  for (double i = std::ceil(frame.y.low / step_y); i * step_y <= frame.y.high; ++i)
    svg += fmt::format(
        "<path class=\"grid\" d=\"M{0:.1f} {1:.1f}H{2:.1f}\"/><text class=\"tick\" x=\"{3:.1f}\" "
        "y=\"{4:.1f}\" "
        "text-anchor=\"end\">{5}</text>\n",
        kLeft, frame.py(i * step_y), right, kLeft - 6, frame.py(i * step_y) + 4,
        number_text(i * step_y, step_y));
  svg += fmt::format("<text class=\"label\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n",
                     kLeft + 0.5 * frame.width, bottom + 33, html_escaped(chart.x_label));
  svg += fmt::format(
      "<text class=\"label\" transform=\"translate(14 {:.1f}) rotate(-90)\" "
      "text-anchor=\"middle\">{}</text>\n",
      kTop + 0.5 * frame.height, html_escaped(chart.y_label));
  return svg;
}

std::string bands(const Chart& chart, const Frame& frame) {
  std::string svg;
  for (const ChartBand& band : chart.bands) {
    const double from = frame.px(std::max(band.from, frame.x.low)),
                 to = frame.px(std::min(band.to, frame.x.high));
    if (!(to >= from)) continue;
    svg += fmt::format(
        "<rect class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" "
        "height=\"{:.1f}\"><title>{}</title></rect>\n",
        band.css_class, from, kTop, std::max(to - from, 1.0), frame.height, html_escaped(band.name));
  }
  return svg;
}

// One point in a series, or of each stretch of a long series the lowest and the highest.
std::vector<Eigen::Vector2d> thinned(const Chart& chart, const std::vector<Eigen::Vector2d>& points) {
  const std::size_t most = 2 * static_cast<std::size_t>(chart.width);
  const std::size_t stretch = (points.size() + most - 1) / most;
  if (stretch <= 1) return points;
  std::vector<Eigen::Vector2d> kept;
  for (std::size_t i = 0; i < points.size(); i += 2 * stretch) {
    const auto first = points.begin() + static_cast<std::ptrdiff_t>(i);
    const auto last = points.begin() + static_cast<std::ptrdiff_t>(std::min(i + 2 * stretch, points.size()));
    // A break must stay one, and it compares with nothing.
    if (!std::all_of(first, last, [](const Eigen::Vector2d& p) { return p.allFinite(); })) {
      kept.insert(kept.end(), first, last);
      continue;
    }
    auto [low, high] =
        std::minmax_element(first, last, [](const auto& a, const auto& b) { return a.y() < b.y(); });
    if (high < low) std::swap(low, high);
    kept.push_back(*low);
    if (high != low) kept.push_back(*high);
  }
  return kept;
}

std::string line(const Chart& chart, const Frame& frame, const ChartSeries& series) {
  std::string path;
  bool drawing = false;
  for (const Eigen::Vector2d& p : thinned(chart, series.points)) {
    if (p.allFinite())
      path += fmt::format("{}{:.1f} {:.1f}", drawing ? "L" : "M", frame.px(p.x()), frame.py(p.y()));
    drawing = p.allFinite();
  }
  std::string svg = fmt::format("<path class=\"line {}\" d=\"{}\"/>\n", series.css_class, path);
  if (!chart.equal_scales || !series.has_ends || series.points.empty()) return svg;
  const Eigen::Vector2d start = series.points.front(), end = series.points.back();
  svg += fmt::format(
      "<circle class=\"dot {}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\"><title>{}: start</title></circle>\n",
      series.css_class, frame.px(start.x()), frame.py(start.y()), html_escaped(series.name));
  svg += fmt::format(
      "<rect class=\"dot {}\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"8\" height=\"8\"><title>{}: "
      "end</title></rect>\n",
      series.css_class, frame.px(end.x()) - 4, frame.py(end.y()) - 4, html_escaped(series.name));
  return svg;
}

std::string legend(const Chart& chart) {
  std::string svg;
  double x = kLeft;
  const auto entry = [&](const std::string& mark, const std::string& name) {
    svg += fmt::format(
        "<g transform=\"translate({:.0f} 8)\">{}<text class=\"label\" x=\"20\" y=\"8\">{}</text></g>\n", x,
        mark, html_escaped(name));
    x += 36 + 6.6 * static_cast<double>(name.size());
  };
  for (const ChartSeries& series : chart.series)
    entry("<path class=\"line " + series.css_class + "\" d=\"M0 4H15\"/>", series.name);
  std::vector<std::string> named;
  for (const ChartBand& band : chart.bands) {
    if (std::find(named.begin(), named.end(), band.name) != named.end()) continue;
    named.push_back(band.name);
    entry("<rect class=\"" + band.css_class + "\" width=\"15\" height=\"9\"/>", band.name);
  }
  return svg;
}

}  // namespace

double tick_step(double range, int count) {
  if (!(range > 0) || !std::isfinite(range) || count < 1) return 1;
  const double ideal = range / count, power = std::pow(10.0, std::floor(std::log10(ideal)));
  for (const double factor : {5.0, 2.0})
    if (factor * power <= ideal) return factor * power;
  return power;
}

std::string svg_chart(const Chart& chart) {
  const Frame frame = frame_of(chart);
  std::string svg = fmt::format("<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">\n", chart.width,
                                chart.height, html_escaped(chart.title));
  svg += bands(chart, frame) + axes(chart, frame);
  for (const ChartSeries& series : chart.series) svg += line(chart, frame, series);
  return svg + legend(chart) + "</svg>\n";
}

}  // namespace spslam
