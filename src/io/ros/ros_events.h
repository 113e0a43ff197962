// Events and triggers out of messages of ROS. Source of the encodings: the README of event_camera_msgs and
// the driver of libcaer cameras for ROS.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/evt/evt3_decoder.h"
#include "io/ros/ros_message.h"
#include "scarf/core/event.h"
#include "scarf/io/frames.h"

namespace scarf {

/// Whether messages of this kind hold events, or triggers. Packets of an unknown encoding count as both, so
/// that they are reported and not passed over.
bool holds_events(const RosEvents& message);
bool holds_triggers(const RosEvents& message);

/// Decodes the messages of one topic in order; what a message does not say is what earlier ones said.
class RosEventDecoder {
 public:
  /// Appends the message's events. Returns what is wrong with it, or nothing.
  std::string decode(const RosEvents& message, std::vector<Event>& events);

  uint64_t gaps() const { return gaps_; }
  uint64_t unknown_words() const { return unknown_ + evt3_.unknown_words(); }
  /// Events of EventArray left out, as their polarity is no boolean.
  uint64_t undefined_polarities() const { return undefined_; }
  /// Bytes at the ends of messages that make no whole word.
  uint64_t truncated_bytes() const { return truncated_; }

 private:
  std::string decode_packet(const RosEvents& message, std::vector<Event>& events);
  std::string decode_array(const RosEvents& message, std::vector<Event>& events);
  void decode_evt3(std::span<const uint8_t> words, std::vector<Event>& events);
  void decode_libcaer(const RosEvents& message, std::vector<Event>& events);
  void decode_libcaer_cmp(const RosEvents& message, std::vector<Event>& events);
  void decode_mono(const RosEvents& message, std::vector<Event>& events);

  evt3::EventDecoder evt3_{evt3::Start::time_high_and_low};
  std::optional<uint64_t> next_seq_;
  uint16_t x_ = 0;       // of libcaer_cmp: the column ...
  uint16_t base_y_ = 0;  // ... and the place and polarity of the next vector
  uint8_t base_p_ = 0;
  uint64_t gaps_ = 0;
  uint64_t unknown_ = 0;
  uint64_t undefined_ = 0;
  uint64_t truncated_ = 0;
};

class RosTriggerDecoder {
 public:
  std::string decode(const RosEvents& message, std::vector<Trigger>& triggers);

 private:
  evt3::TriggerDecoder evt3_{evt3::Start::time_high_and_low};
};

}  // namespace scarf
