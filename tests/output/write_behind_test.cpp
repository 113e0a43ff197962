// The thread that writes frames: all of them, in order, and no error of an earlier frame is lost.
#include "output/write_behind.h"

#include <gtest/gtest.h>

#include <vector>

namespace scarf {
namespace {

struct Written {
  std::vector<int> frames;
  bool finished = false;
};

// Notes what is written; full after `room` frames.
class Note final : public FrameWriter {
 public:
  Note(Written& written, size_t room) : written_(written), room_(room) {}
  Result<void> write(const Frame& /*frame*/, const PictureView& picture) override {
    if (written_.frames.size() == room_) return Error{ErrorCode::io, "full"};
    written_.frames.push_back(std::get<0>(picture.pixels)[0]);
    return {};
  }
  Result<void> finish() override {
    written_.finished = true;
    return {};
  }

 private:
  Written& written_;
  const size_t room_;
};

TEST(WriteBehind, WritesCopiesInOrder) {
  Written written;
  WriteBehind writer(std::make_unique<Note>(written, 1000));
  Image<uint8_t> image(4, 4);
  std::vector<int> given;
  for (int i = 0; i < 200; ++i) {
    image.pixels[0] = static_cast<uint8_t>(i);
    given.push_back(i);
    ASSERT_TRUE(writer.write({}, image));
  }
  ASSERT_TRUE(writer.finish());
  EXPECT_EQ(written.frames, given);
  EXPECT_TRUE(written.finished);
}

TEST(WriteBehind, AnErrorOfAnEarlierFrameIsTold) {
  Written written;
  WriteBehind writer(std::make_unique<Note>(written, 3));
  const Image<uint8_t> image(4, 4);
  for (int i = 0; i < 50; ++i) (void)writer.write({}, image);
  const auto finished = writer.finish();
  ASSERT_FALSE(finished);
  EXPECT_EQ(finished.error().message, "full");
  EXPECT_EQ(written.frames.size(), 3u);
  EXPECT_FALSE(written.finished);
}

}  // namespace
}  // namespace scarf
