// Synthetic event streams for benchmarks, by where the events fall. Fixed seeds: a scene is the same
// everywhere.
#pragma once

#include <string_view>
#include <vector>

#include "scarf/core/event.h"

namespace scarf::bench {

enum class Scene {
  edges,         ///< 20 slanted 2-pixel bars of different speeds; every 20th event is noise
  uniform,       ///< anywhere
  hot_spot,      ///< half of the events anywhere, half in one 8x8 block
  one_tile,      ///< all in one 8x8 block
  single_pixel,  ///< all in one pixel
};
inline constexpr Scene kScenes[] = {Scene::edges, Scene::uniform, Scene::hot_spot, Scene::one_tile,
                                    Scene::single_pixel};

std::string_view scene_name(Scene scene);

/// `count` events at 25 million per second.
std::vector<Event> make_scene(Scene scene, SensorSize sensor, size_t count);

}  // namespace scarf::bench
