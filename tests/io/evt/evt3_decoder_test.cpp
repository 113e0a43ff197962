// What the decoder adds to the reader: pieces of a stream, triggers, where words begin to count.
#include "io/evt/evt3_decoder.h"

#include <gmock/gmock.h>

#include "tests/io/io_test_helpers.h"

namespace scarf {
namespace {

using evt3::Start;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<Event> events_of(evt3::EventDecoder& decoder, std::initializer_list<uint16_t> words) {
  std::vector<Event> events(100);
  const Bytes bytes = with_words("", words);
  const auto decoded = decoder.decode(bytes, events);
  EXPECT_EQ(decoded.bytes, bytes.size());
  events.resize(decoded.events);
  return events;
}

std::vector<Trigger> triggers_of(evt3::TriggerDecoder& decoder, std::initializer_list<uint16_t> words) {
  std::vector<Trigger> triggers(100);
  const Bytes bytes = with_words("", words);
  const auto decoded = decoder.decode(bytes, triggers);
  EXPECT_EQ(decoded.bytes, bytes.size());
  triggers.resize(decoded.triggers);
  return triggers;
}

TEST(Evt3Decoder, GoesOnFromPieceToPiece) {
  evt3::EventDecoder decoder;
  // High 1, low 3, row 5, base 7 ON, a vector.
  EXPECT_THAT(events_of(decoder, {0x8001, 0x6003, 0x0005, 0x3807, 0x4001}),
              ElementsAre(Event{4099, 7, 5, 1}));
  EXPECT_THAT(events_of(decoder, {0x5001, 0x2009}), ElementsAre(Event{4099, 19, 5, 1}, Event{4099, 9, 5, 0}));
}

TEST(Evt3Decoder, CanWaitForTimeHighAndLow) {
  const auto words = {uint16_t{0x6001}, uint16_t{0x0009}, uint16_t{0x2001}, uint16_t{0x8002},
                      uint16_t{0x2002}, uint16_t{0x6003}, uint16_t{0x2003}};
  evt3::EventDecoder from_high(Start::time_high);
  EXPECT_THAT(events_of(from_high, words), ElementsAre(Event{8192, 2, 0, 0}, Event{8195, 3, 0, 0}));
  evt3::EventDecoder from_both(Start::time_high_and_low);
  EXPECT_THAT(events_of(from_both, words), ElementsAre(Event{8195, 3, 0, 0}));
}

TEST(Evt3Decoder, TriggersHaveTheTimeOfTheWordsBefore) {
  evt3::TriggerDecoder decoder;
  // Input 6 rises, falls; between them words of events.
  EXPECT_THAT(triggers_of(decoder, {0xA001, 0x8001, 0x6002, 0xA601, 0x0003, 0x2004, 0x6009, 0xA600}),
              ElementsAre(Trigger{4098, 6, 1}, Trigger{4105, 6, 0}));
  EXPECT_THAT(triggers_of(decoder, {0x8002, 0xAF01}), ElementsAre(Trigger{8192, 15, 1}));
  evt3::TriggerDecoder from_both(Start::time_high_and_low);
  EXPECT_THAT(triggers_of(from_both, {0x8001, 0xA001}), IsEmpty());
}

TEST(Evt3Decoder, CountsStepsOfTimeHighOverMissingValues) {
  evt3::EventDecoder decoder;
  events_of(decoder, {0x8007, 0x8007, 0x8008, 0x8FFF, 0x8000, 0x8001});
  EXPECT_EQ(decoder.clock().gaps(), 1u) << "8 to 4095";
  events_of(decoder, {0x8003, 0x8002});
  EXPECT_EQ(decoder.clock().gaps(), 3u) << "1 to 3, and back to 2";
}

}  // namespace
}  // namespace scarf
