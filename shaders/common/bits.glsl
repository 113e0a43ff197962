// Choices by single bits of a word, without conditions. LLVM 19 to 22 turn two choices in a row whose conditions test
// single bits, (b & 0x1000) != 0 ? x : y and then (b & 0x4000) != 0 ? f(of the first) : it, into wrong code for x86:
// llvmpipe takes the second condition for false. So no condition in a shader tests a bit; ShaderRules in
// tests/vulkan/shader_rules_test.cpp looks for those that do.

// Bit number `bit` of a word, 0 or 1.
uint bit_of(uint word, uint bit) { return word >> bit & 1; }

// All bits if one bit of a word is set, else none. `mark`: that bit, a constant.
uint all_if(uint word, uint mark) { return 0u - bit_of(word, findMSB(mark)); }

// `yes` where `mask` has ones, `no` where it has zeros.
uint blend(uint mask, uint yes, uint no) { return (no & ~mask) | (yes & mask); }
int blend(uint mask, int yes, int no) { return int(blend(mask, uint(yes), uint(no))); }
