#include "simulate/scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "simulate/view.h"

namespace scarf::simulate {
namespace {

TEST(Motion, GoesToAndFroAndStays) {
  const Motion m = {{10, 0}, {30, 40}, 2.0, 1.0, 6.0};
  EXPECT_EQ(m.at(0.5), (Point{10, 0}));
  EXPECT_EQ(m.at(2.0), (Point{20, 20}));
  EXPECT_EQ(m.at(3.0), (Point{30, 40}));
  EXPECT_EQ(m.at(4.0), (Point{20, 20}));
  EXPECT_EQ(m.at(6.0), m.at(100.0));
  EXPECT_EQ(m.at(6.0), (Point{20, 20}));
  EXPECT_DOUBLE_EQ(m.speed(), std::sqrt(20.0 * 20 + 40 * 40) / 2);
}

TEST(Shape, SignedDistance) {
  const Shape round = disc(5, {}, {});
  EXPECT_DOUBLE_EQ(round.signed_distance({3, 4}), 0);
  EXPECT_DOUBLE_EQ(round.signed_distance({0, 0}), -5);
  EXPECT_DOUBLE_EQ(round.signed_distance({0, 8}), 3);

  const Shape square = polygon({{-2, -2}, {2, -2}, {2, 2}, {-2, 2}}, {}, {});
  EXPECT_EQ(square.reach, (Point{2, 2}));
  EXPECT_DOUBLE_EQ(square.signed_distance({0, 0}), -2);
  EXPECT_DOUBLE_EQ(square.signed_distance({1.5, 0}), -0.5);
  EXPECT_DOUBLE_EQ(square.signed_distance({3, 1}), 1);
  EXPECT_DOUBLE_EQ(square.signed_distance({5, 6}), 5);

  // A dent: the point lies in the hull, but outside.
  const Shape dented = polygon({{-4, -4}, {4, -4}, {4, 4}, {0, 0}, {-4, 4}}, {}, {});
  EXPECT_GT(dented.signed_distance({0, 2}), 0);
  EXPECT_LT(dented.signed_distance({0, -2}), 0);
}

TEST(Scene, NothingMovesFartherThanAskedInAStep) {
  constexpr double kDistance = 1.0 / 3;
  for (const auto name : names()) {
    const Scene scene = scene_maker(name)({346, 260}, 2.0);
    for (double t = 0; t < 2.0;) {
      const double step = std::min(scene.longest_step(t, kDistance), 0.01);
      ASSERT_GT(step, 0);
      const Point camera0 = scene.shake.at(t);
      const Point camera1 = scene.shake.at(t + step);
      for (const Shape& shape : scene.shapes) {
        const Point a = shape.motion.at(t);
        const Point b = shape.motion.at(t + step);
        ASSERT_LE(std::hypot(b.x - a.x - camera1.x + camera0.x, b.y - a.y - camera1.y + camera0.y),
                  kDistance + 1e-9)
            << name << " at " << t;
      }
      t += step;
    }
  }
}

TEST(View, CoverageIsAntiAliased) {
  // A white square on black whose left outline is at x = 10.25.
  Scene scene;
  scene.background = {0, 0};
  scene.shapes = {polygon({{0, -20}, {40, -20}, {40, 20}, {0, 20}}, {1, 0}, {{10.25, 20}, {10.25, 20}})};
  View view({64, 40}, scene);
  std::vector<uint16_t> row;
  view.render({8, 20, 13, 21}, 0, row);
  EXPECT_EQ(row, (std::vector<uint16_t>{0, 0, 49151, 65535, 65535}));
}

TEST(View, ChangedBoxesHoldEveryChange) {
  for (const auto name : names()) {
    View view({80, 60}, scene_maker(name)({80, 60}, 2.0));
    for (const double t : {0.1, 0.999, 1.5}) {
      std::vector<uint16_t> before, after;
      view.render(view.whole(), t, before);
      view.render(view.whole(), t + 0.002, after);
      const auto boxes = view.changed(t, t + 0.002);
      for (int32_t y = 0; y < 60; ++y) {
        for (int32_t x = 0; x < 80; ++x) {
          const bool in_a_box = std::any_of(boxes.begin(), boxes.end(), [&](const Box& b) {
            return x >= b.x0 && x < b.x1 && y >= b.y0 && y < b.y1;
          });
          ASSERT_TRUE(in_a_box || before[y * 80 + x] == after[y * 80 + x]) << name << " at " << x << "," << y;
        }
      }
    }
  }
}

TEST(View, EdgesOfHiddenOutlinesAreNotShown) {
  Scene scene;
  scene.shapes = {disc(5, {1, 0}, {{20, 20}, {20, 20}}), disc(10, {0, 0}, {{20, 20}, {20, 20}})};
  const View view({40, 40}, scene);
  const auto edges = view.edges(0);
  for (int32_t y = 0; y < 40; ++y) {
    for (int32_t x = 0; x < 40; ++x) {
      const double distance = std::hypot(x + 0.5 - 20, y + 0.5 - 20) - 10;
      ASSERT_EQ(edges.at(x, y), std::abs(distance) < 0.5 ? 255 : 0) << x << "," << y;
    }
  }
}

}  // namespace
}  // namespace scarf::simulate
