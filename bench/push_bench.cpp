// Google Benchmark's view of `scarf bench`: one push of 100,000 events and one image.
#include <benchmark/benchmark.h>

#include "bench/push.h"
#include "bench/scenes.h"
#include "scarf/device/stream.h"
#include "scarf/reference/reference.h"

namespace scarf::bench {
namespace {

constexpr SensorSize kSensor = {640, 480};

void push_and_image(benchmark::State& state, Scarf& scarf, Scene scene) {
  const std::vector<Event> events = make_scene(scene, kSensor, kEventsPerImage);
  for (auto _ : state) {
    const auto pushed = scarf.push(events);
    const auto image = scarf.u8_image().wait();
    if (!pushed || !image) {
      state.SkipWithError((pushed ? image.error() : pushed.error()).message.c_str());
      return;
    }
  }
  state.SetItemsProcessed(static_cast<int64_t>(state.iterations() * events.size()));
}

void reference(benchmark::State& state, Preset preset, Scene scene) {
  auto scarf = make_reference_scarf(*make_geometry(preset, kSensor));
  push_and_image(state, **scarf, scene);
}

void gpu(benchmark::State& state, Preset preset, Scene scene) {
  auto context = GpuContext::create();
  if (!context) return state.SkipWithError(context.error().message.c_str());
  auto scarf = make_gpu_scarf(*context, *make_geometry(preset, kSensor));
  if (!scarf) return state.SkipWithError(scarf.error().message.c_str());
  push_and_image(state, **scarf, scene);
}

BENCHMARK_CAPTURE(reference, paper_edges, Preset::paper, Scene::edges)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(reference, light_edges, Preset::light, Scene::edges)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(gpu, paper_edges, Preset::paper, Scene::edges)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(gpu, light_edges, Preset::light, Scene::edges)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(gpu, paper_hot_spot, Preset::paper, Scene::hot_spot)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace scarf::bench

BENCHMARK_MAIN();
