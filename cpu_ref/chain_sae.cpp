// CHAIN-SAE (chained surface of active events), as defined: the pixels in the order in which they last fired.
// Source: Lin et al., "Efficient Spatial-Temporal Normalization of SAE Representation for Event Camera",
// 2020.
#include <list>

#include "core/tables.h"
#include "cpu_ref/references.h"
#include "cpu_ref/surface.h"

namespace scarf {
namespace {

class ChainSae final : public Surface {
 public:
  ChainSae(const ChainSaeParameters& parameters, SensorSize sensor)
      : Surface(sensor),
        event_driven_(parameters.rule == ChainSaeParameters::Rule::event_driven),
        weights_(chain_table(static_cast<int64_t>(pixels()), parameters.linear)) {
    begin();
  }

 private:
  void update(const Event& e) override {
    const auto i = static_cast<uint32_t>(pixel(e));
    if (place_[i] == chain_.end())
      place_[i] = chain_.insert(chain_.begin(), i);
    else
      chain_.splice(chain_.begin(), chain_, place_[i]);
    if (event_driven_) cells_[cell(i)] = 0;
  }

  void clear() override { begin(); }

  void begin() {
    chain_.clear();
    place_.assign(pixels(), chain_.end());
    cells_.assign(pixels(), no_rank());
    if (!event_driven_) return;
    for (uint32_t i = 0; i < pixels(); ++i) place_[i] = chain_.insert(chain_.begin(), i);
  }

  // Its weight is 0.
  int32_t no_rank() const { return static_cast<int32_t>(pixels()); }

  // With Rule::event_driven the last pixel shows its rank in the first one's cell.
  uint32_t cell(uint32_t i) const { return event_driven_ && i == pixels() - 1 ? 0 : i; }

  // The rank that each pixel shows.
  const std::vector<int32_t>& ranks() {
    if (!event_driven_) cells_.assign(pixels(), no_rank());
    int32_t rank = 0;
    for (const uint32_t i : chain_) {
      // With Rule::event_driven the cell of the oldest pixel keeps what it showed.
      if (event_driven_ && i == chain_.back()) break;
      cells_[cell(i)] = rank++;
    }
    return cells_;
  }

  Image<uint8_t> u8_picture(std::optional<int64_t>) override {
    return picture<uint8_t>(ranks(), [this](int32_t rank) { return weights_.u8[rank]; });
  }
  Image<float> float_picture(std::optional<int64_t>) override {
    return picture<float>(ranks(), [this](int32_t rank) { return weights_.f32[rank]; });
  }
  Image<int64_t> raw_picture() override {
    return picture<int64_t>(ranks(), [this](int32_t rank) { return rank == no_rank() ? -1 : rank; });
  }

  std::vector<uint8_t> state_bytes() const override {
    std::vector<uint8_t> bytes;
    if (!event_driven_) append_little_endian(bytes, static_cast<uint32_t>(chain_.size()));
    for (const uint32_t i : chain_) append_little_endian(bytes, i);
    if (event_driven_) append_all(bytes, cells_);
    return bytes;
  }

  const bool event_driven_;
  const Levels weights_;                              // by rank
  std::list<uint32_t> chain_;                         // pixels from newest to oldest
  std::vector<std::list<uint32_t>::iterator> place_;  // of each pixel in the chain; its end if it has none
  std::vector<int32_t> cells_;  // the rank that each pixel shows; part of the state with Rule::event_driven
};

}  // namespace

Reference make_reference(const ChainSaeParameters& parameters, SensorSize sensor) {
  return std::make_unique<ChainSae>(parameters, sensor);
}

}  // namespace scarf
