// Records of AEDAT 2, of a chip that the first byte chooses, or the header's lines as well; and of AEDAT 1.
#include "fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size == 0) return 0;
  constexpr std::string_view kHeaders[] = {"#!AER-DAT2.0\r\n# AEChip: DAVIS240C\r\n#End Of ASCII Header\r\n",
                                           "#!AER-DAT2.0\r\n# AEChip: DVS128\r\n",
                                           "#!AER-DAT2.0\r\n# AEChip: DVS640\n", "#!AER-DAT1.0\r\n",
                                           "#!AER-DAT2.0\r\n#"};
  scarf::ReadOptions options;
  if (data[0] % 8 == 4) options.sensor = scarf::SensorSize{346, 260};
  scarf::check_reader(kHeaders[data[0] % 8 % 5], {data + 1, size - 1}, options);
  return 0;
}
