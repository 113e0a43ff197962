// Triggers out of the words of a recording.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "core/little_endian.h"
#include "core/text.h"
#include "io/base/format.h"
#include "scarf/io/frames.h"

namespace scarf {

/// A decoder for DecodedTriggers out of a `take(word)` that gives a trigger for some words.
template <class Word, class Taker>
class TriggersByWord {
 public:
  explicit TriggersByWord(Taker taker) : taker_(std::move(taker)) {}

  struct Decoded {
    size_t bytes = 0;
    size_t triggers = 0;
  };

  Decoded decode(std::span<const uint8_t> bytes, std::span<Trigger> out) {
    Decoded decoded;
    while (decoded.triggers < out.size() && decoded.bytes + sizeof(Word) <= bytes.size()) {
      const std::optional<Trigger> trigger =
          taker_.take(load_little_endian<Word>(bytes.data() + decoded.bytes));
      decoded.bytes += sizeof(Word);
      if (trigger) out[decoded.triggers++] = *trigger;
    }
    return decoded;
  }

 private:
  Taker taker_;
};

/// `Decoder`: decode(bytes, out) takes whole words off the front of `bytes` until `out` is full or none is
/// left.
template <class Decoder>
class DecodedTriggers final : public TriggerSource {
 public:
  DecodedTriggers(ByteReader input, std::string name, Decoder decoder)
      : input_(std::move(input)), name_(std::move(name)), decoder_(std::move(decoder)) {}

  Result<size_t> read(std::span<Trigger> out) override {
    for (;;) {
      const auto decoded = decoder_.decode(input_.available(), out);
      input_.skip(decoded.bytes);
      if (decoded.triggers > 0 || input_.ended()) return decoded.triggers;
      if (const auto refilled = input_.refill(); !refilled) {
        return Error{refilled.error().code, text(name_, ": ", refilled.error().message)};
      }
    }
  }

 private:
  ByteReader input_;
  std::string name_;
  Decoder decoder_;
};

/// Errors: illegal_parameter, if the times are to be shifted: by what is known from the events only.
template <class Decoder>
Result<std::unique_ptr<TriggerSource>> make_decoded_triggers(Input input, const ReadOptions& options,
                                                             Decoder decoder) {
  if (options.time_shift != TimeShift::none) {
    return Error{
        ErrorCode::illegal_parameter,
        "ReadOptions::time_shift is not used by triggers; leave it out, and read the events without it"};
  }
  return std::unique_ptr<TriggerSource>(std::make_unique<DecodedTriggers<Decoder>>(
      std::move(input.bytes), std::move(input.name), std::move(decoder)));
}

}  // namespace scarf
