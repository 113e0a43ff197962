#include "bench/plot.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "core/text.h"

namespace scarf::bench {
namespace {

// Pixels.
constexpr double kPanelWidth = 400;
constexpr double kPanelHeight = 300;
constexpr double kLeft = 70;  // of a panel, for the numbers and the label of the axis
constexpr double kRight = 20;
constexpr double kAbove = 40;  // for the panel's title
constexpr double kBelow = 50;
constexpr double kTitle = 40;
constexpr double kLegend = 170;
constexpr double kLegendStep = 22;
constexpr double kMarker = 4;

// Okabe and Ito's colours, which people with any colour vision tell apart, and grey. Yellow is darker here:
// lines are thin.
constexpr std::string_view kColours[] = {"#000000", "#E69F00", "#56B4E9", "#009E73", "#0072B2",
                                         "#D55E00", "#CC79A7", "#B3A400", "#888888"};

std::string escaped(std::string_view words) {
  std::string out;
  for (const char c : words) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

struct Range {
  double low;
  double high;
  // 0 at `low`, 1 at `high`.
  double place(double value) const { return std::log(value / low) / std::log(high / low); }
};

// Whole powers of ten around all y.
Range y_range(const Plot& plot) {
  double low = INFINITY;
  double high = 0;
  const auto include = [&](double y) {
    low = std::min(low, y);
    high = std::max(high, y);
  };
  for (const Panel& panel : plot.panels) {
    if (panel.level) include(*panel.level);
    for (const auto& line : panel.lines) {
      for (const auto& [x, y] : line) include(y);
    }
  }
  if (high == 0) return {1, 10};
  const double first = std::floor(std::log10(low));
  return {std::pow(10, first), std::pow(10, std::max(first + 1, std::ceil(std::log10(high))))};
}

std::string words(double x, double y, std::string_view anchor, std::string_view content,
                  std::string_view more = "") {
  return text("<text x=\"", x, "\" y=\"", y, "\" text-anchor=\"", anchor, "\"", more, ">", escaped(content),
              "</text>\n");
}

std::string rule(double x0, double y0, double x1, double y1, std::string_view style) {
  return text("<line x1=\"", x0, "\" y1=\"", y0, "\" x2=\"", x1, "\" y2=\"", y1, "\" ", style, "/>\n");
}

// Colours alone are hard to name: lines take turns in three markers.
std::string marker(size_t line, double x, double y) {
  const std::string_view colour = kColours[line % std::size(kColours)];
  const double r = kMarker;
  switch (line % 3) {
    case 0:
      return text("<circle cx=\"", x, "\" cy=\"", y, "\" r=\"", r, "\" fill=\"", colour, "\"/>\n");
    case 1:
      return text("<rect x=\"", x - r, "\" y=\"", y - r, "\" width=\"", 2 * r, "\" height=\"", 2 * r,
                  "\" fill=\"", colour, "\"/>\n");
    default:
      return text("<path d=\"M", x, " ", y - r, "L", x + r, " ", y + r, "H", x - r, "Z\" fill=\"", colour,
                  "\"/>\n");
  }
}

constexpr std::string_view kGrid = "stroke=\"#dddddd\"";
constexpr std::string_view kFineGrid = "stroke=\"#f2f2f2\"";
constexpr std::string_view kDashed = "stroke=\"#444444\" stroke-dasharray=\"6 4\"";

class Drawing {
 public:
  explicit Drawing(const Plot& plot)
      : plot_(plot),
        x_{plot.x_ticks.front(), std::max(plot.x_ticks.back(), plot.x_ticks.front() * 1.001)},
        y_(y_range(plot)) {}

  std::string document() const {
    const size_t columns = std::min(plot_.columns, std::max<size_t>(plot_.panels.size(), 1));
    const size_t rows = (plot_.panels.size() + columns - 1) / columns;
    const double panels_width = static_cast<double>(columns) * (kLeft + kPanelWidth + kRight);
    const double width = panels_width + kLegend;
    const double panels_height = static_cast<double>(rows) * (kAbove + kPanelHeight + kBelow);
    const double height = kTitle + std::max(panels_height, kAbove + legend_height());
    std::string out =
        text("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"", width, "\" height=\"", height,
             "\" viewBox=\"0 0 ", width, " ", height, "\" font-family=\"sans-serif\" font-size=\"13\">\n",
             "<rect width=\"", width, "\" height=\"", height, "\" fill=\"white\"/>\n",
             words(width / 2, 28, "middle", plot_.title, " font-size=\"16\""));
    for (size_t i = 0; i < plot_.panels.size(); ++i) {
      const size_t row = i / columns;
      const double left = static_cast<double>(i % columns) * (kLeft + kPanelWidth + kRight) + kLeft;
      const double top = kTitle + static_cast<double>(row) * (kAbove + kPanelHeight + kBelow) + kAbove;
      out += panel(plot_.panels[i], left, top);
    }
    return out + legend(panels_width, kTitle + kAbove) + "</svg>\n";
  }

 private:
  std::string panel(const Panel& panel, double left, double top) const {
    const auto x_at = [&](double x) { return left + x_.place(x) * kPanelWidth; };
    const auto y_at = [&](double y) { return top + (1 - y_.place(y)) * kPanelHeight; };
    const double right = left + kPanelWidth;
    const double bottom = top + kPanelHeight;
    std::string out = words(left + kPanelWidth / 2, top - 12, "middle", panel.title, " font-size=\"14\"");
    // Factors of ten that are not quite whole still end before the next.
    for (double ten = y_.low; ten < y_.high * 1.5; ten *= 10) {
      for (int i = 2; i < 10 && ten < y_.high / 1.5; ++i)
        out += rule(left, y_at(i * ten), right, y_at(i * ten), kFineGrid);
      out +=
          rule(left, y_at(ten), right, y_at(ten), kGrid) + words(left - 8, y_at(ten) + 4, "end", text(ten));
    }
    for (const double x : plot_.x_ticks) {
      out += rule(x_at(x), top, x_at(x), bottom, kGrid) + words(x_at(x), bottom + 18, "middle", text(x));
    }
    out += text("<rect x=\"", left, "\" y=\"", top, "\" width=\"", kPanelWidth, "\" height=\"", kPanelHeight,
                "\" fill=\"none\" stroke=\"#444444\"/>\n");
    if (panel.level) out += rule(left, y_at(*panel.level), right, y_at(*panel.level), kDashed);
    for (size_t i = 0; i < panel.lines.size(); ++i) {
      if (panel.lines[i].empty()) continue;
      std::string points;
      std::string markers;
      for (const auto& [x, y] : panel.lines[i]) {
        points += text(points.empty() ? "" : " ", x_at(x), ",", y_at(y));
        markers += marker(i, x_at(x), y_at(y));
      }
      out += text("<polyline fill=\"none\" stroke-width=\"2\" stroke=\"", kColours[i % std::size(kColours)],
                  "\" points=\"", points, "\"/>\n", markers);
    }
    const double middle = top + kPanelHeight / 2;
    return out + words(left + kPanelWidth / 2, bottom + 38, "middle", plot_.x_label) +
           words(left - 50, middle, "middle", plot_.y_label,
                 text(" transform=\"rotate(-90 ", left - 50, " ", middle, ")\""));
  }

  double legend_height() const { return kLegendStep * static_cast<double>(plot_.labels.size() + 1); }

  std::string legend(double left, double top) const {
    std::string out;
    double y = top + kLegendStep / 2;
    for (size_t i = 0; i < plot_.labels.size(); ++i, y += kLegendStep) {
      const std::string_view colour = kColours[i % std::size(kColours)];
      out += rule(left, y, left + 30, y, text("stroke-width=\"2\" stroke=\"", colour, "\"")) +
             marker(i, left + 15, y) + words(left + 38, y + 4, "start", plot_.labels[i]);
    }
    if (plot_.level_label.empty()) return out;
    return out + rule(left, y, left + 30, y, kDashed) + words(left + 38, y + 4, "start", plot_.level_label);
  }

  const Plot& plot_;
  const Range x_;
  const Range y_;
};

}  // namespace

std::string svg(const Plot& plot) {
  return Drawing(plot).document();
}

}  // namespace scarf::bench
