#include "io/hdf5/lzf_filter.h"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

namespace scarf::hdf5 {
namespace {

std::string decoded(const std::vector<uint8_t>& bytes, size_t size) {
  std::vector<uint8_t> out(size);
  return decode_lzf(bytes, out) ? std::string(out.begin(), out.end()) : "refused";
}

TEST(LzfFilter, LiteralsAndReferences) {
  EXPECT_EQ(decoded({2, 'a', 'b', 'c'}, 3), "abc");
  EXPECT_EQ(decoded({2, 'a', 'b', 'c', 2 << 5, 2}, 7), "abcabca") << "four bytes from three back";
  EXPECT_EQ(decoded({0, 'x', 7 << 5, 1, 0}, 11), "xxxxxxxxxxx") << "a long reference that overlaps itself";
  EXPECT_EQ(decoded({}, 0), "");
}

TEST(LzfFilter, RefusesWhatDoesNotFit) {
  EXPECT_EQ(decoded({2, 'a', 'b'}, 3), "refused") << "literals missing";
  EXPECT_EQ(decoded({2, 'a', 'b', 'c'}, 2), "refused") << "too many";
  EXPECT_EQ(decoded({2, 'a', 'b', 'c'}, 4), "refused") << "too few";
  EXPECT_EQ(decoded({0, 'a', 1 << 5, 1}, 4), "refused") << "from before the beginning";
  EXPECT_EQ(decoded({0, 'a', 7 << 5}, 10), "refused");
  EXPECT_EQ(decoded({0, 'a', 7 << 5, 0}, 10), "refused");
}

TEST(LzfFilter, AnyBytes) {
  std::mt19937 random(4);
  for (int round = 0; round < 20'000; ++round) {
    std::vector<uint8_t> bytes(random() % 60);
    for (uint8_t& b : bytes) b = static_cast<uint8_t>(random() % 2 == 0 ? random() : random() % 4);
    std::vector<uint8_t> out(random() % 200);
    static_cast<void>(decode_lzf(bytes, out));
  }
}

}  // namespace
}  // namespace scarf::hdf5
