// Words of the command line: presets, filters, encodings, parameters, columns, units, numbers. Whatever is
// taken is legal.
#include <array>
#include <map>

#include "core/parse.h"
#include "fuzz/fuzz_reader.h"
#include "io/base/columns.h"
#include "scarf/core/encoding.h"
#include "scarf/core/filter.h"
#include "scarf/core/parameters.h"
#include "scarf/core/patch_grid.h"
#include "session/batch_sizes.h"
#include "session/instants.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace scarf;
  if (size == 0) return 0;
  const std::string word(reinterpret_cast<const char*>(data) + 1, size - 1);
  switch (data[0] % 8) {
    case 0:
      if (const auto filter = parse_filter(word)) require(checked_filter(*filter).ok());
      break;
    case 1:
      if (const auto encoding = parse_encoding(word)) require(checked_encoding(*encoding).ok());
      break;
    case 2: {
      // NAME,PARAMETER=VALUE,...
      std::map<std::string, std::string> values;
      const size_t first = word.find(',');
      for (size_t at = first; at < word.size();) {
        const size_t end = std::min(word.find(',', at + 1), word.size());
        const std::string pair = word.substr(at + 1, end - at - 1);
        const size_t equals = std::min(pair.find('='), pair.size());
        values[pair.substr(0, equals)] = pair.substr(std::min(equals + 1, pair.size()));
        at = end;
      }
      if (const auto parameters = parse_parameters(word.substr(0, first), values)) {
        require(checked_parameters(*parameters).ok());
      }
      break;
    }
    case 3:
      if (const auto preset = preset_from_name(word); preset && *preset != Preset::explicit_) {
        require(make_geometry(*preset, {346, 260}).ok());
      }
      break;
    case 4:
      if (const auto columns = columns_from(word)) require(!columns->empty());
      (void)time_exponent_from(word);
      break;
    case 5:
      if (const auto rate = parse_frame_rate(word)) require(rate->numerator > 0 && rate->denominator > 0);
      (void)parse_time_unit(word);
      break;
    case 6:
      if (auto sizes = parse_batch_sizes(word)) {
        const size_t events = sizes->next();
        require(events >= 1 && events <= kMaxBatch);
      }
      break;
    default:
      if (const auto sensor = parse_sensor(word)) require(sensor->width > 0 && sensor->height > 0);
      (void)parse_by(word);
      (void)parse_comma(word);
      (void)parse_positive(word);
  }
  return 0;
}
