// Rules for the sources of shaders that no compiler checks.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

namespace scarf {
namespace {

// Where a line compares the bits of a mask, a & b, with a number: a condition on single bits; see
// shaders/common/bits.glsl.
std::vector<std::string> bit_conditions(const std::string& line) {
  static const std::regex condition(R"([^&]&(?!&)[^&|<>?;]*\)\s*[!=]=|[!=]=\s*\(?[^&|()<>?;]*[^&]&(?!&)|)"
                                    R"((bit_of|packed_polarity)\([^;?]*\)\s*[!=]=)");
  const std::string code = line.substr(0, line.find("//"));
  std::vector<std::string> found;
  for (auto m = std::sregex_iterator(code.begin(), code.end(), condition); m != std::sregex_iterator(); ++m) {
    found.push_back(m->str());
  }
  return found;
}

TEST(ShaderRules, TheLookFindsConditionsOnBits) {
  for (const char* line :
       {"return (behind & mark) != 0 ? a : b;", "if ((b.low & kSet) == 0 && a.last == b.first) {",
        "if ((kKnown >> type & 1) == 0) ++unknown;", "const bool odd = 1 == (size & 1);",
        "x = (f(a) & f(b)) == f(b) ? y : z;", "if (bit_of(word, 3) != 0) return;"}) {
    EXPECT_EQ(bit_conditions(line).size(), 1u) << line;
  }
  for (const char* line :
       {"if (a == b && c != 0) return;", "if (value == 0 && push.begin != 0) {", "x = (a & ~b) | (c & b);",
        "counters[position / 4] += 1 << 8 * (position & 3);",
        "if (high == s.time_high) return;  // a & b == 0", "if (bits != 0) bits &= bits - 1;"}) {
    EXPECT_EQ(bit_conditions(line).size(), 0u) << line;
  }
}

TEST(ShaderRules, NoConditionTestsABit) {
  size_t sources = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(SCARF_SHADERS)) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".comp" && extension != ".glsl") continue;
    ++sources;
    std::ifstream in(entry.path());
    int number = 0;
    for (std::string line; std::getline(in, line);) {
      ++number;
      for (const std::string& found : bit_conditions(line)) {
        ADD_FAILURE() << entry.path().filename().string() << ":" << number << ": '" << found
                      << "': choose with all_if() and blend() of bits.glsl";
      }
    }
  }
  EXPECT_GT(sources, 90u);
}

}  // namespace
}  // namespace scarf
