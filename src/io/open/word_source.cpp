#include <algorithm>
#include <utility>

#include "core/text.h"
#include "io/base/byte_reader.h"
#include "io/base/input_files.h"
#include "io/base/memory_guard.h"
#include "io/base/prophesee_header.h"
#include "io/base/watched_source.h"
#include "scarf/io/words.h"

namespace scarf {
namespace {

class WordFile final : public WordSource {
 public:
  WordFile(ByteReader input, std::unique_ptr<const InputFiles> files, std::string name, std::string format,
           std::optional<SensorSize> sensor)
      : input_(std::move(input)),
        files_(std::move(files)),
        name_(std::move(name)),
        format_(std::move(format)),
        sensor_(sensor) {}

  std::string_view format() const override { return format_; }
  std::optional<SensorSize> sensor() const override { return sensor_; }
  Result<size_t> read(std::span<uint8_t> out) override {
    while (input_.available().empty() && !input_.ended()) {
      if (auto r = input_.refill(); !r) {
        return reason(*files_, {r.error().code, text(name_, ": ", r.error().message)});
      }
    }
    const auto bytes = input_.available();
    const size_t count = std::min(bytes.size(), out.size());
    std::copy_n(bytes.begin(), count, out.begin());
    input_.skip(count);
    if (count == 0) {
      if (auto r = files_->unchanged(); !r) return r.error();
    }
    return count;
  }
  Result<void> unchanged() const override { return files_->unchanged(); }

 private:
  ByteReader input_;
  std::unique_ptr<const InputFiles> files_;
  std::string name_;
  std::string format_;
  std::optional<SensorSize> sensor_;
};

Result<std::unique_ptr<WordSource>> open_unguarded(const std::string& path, const ReadOptions& options) {
  if (path == "-") {
    return Error{ErrorCode::illegal_parameter,
                 "standard input cannot be opened twice, as undecoded words need; give a file"};
  }
  // From before the first time that it is opened until the last byte is read it must be the same file.
  auto files = std::make_unique<InputFiles>();
  auto input = files->open(path);
  if (!input) return Error{input.error().code, text(path, ": ", input.error().message)};
  const auto events = open_events(path, options);
  if (!events) return events.error();
  const std::string format((*events)->format());
  if (format != "evt2" && format != "evt3") {
    return Error{ErrorCode::bad_input, text(path, " is a recording of ", format,
                                            ", whose words only the CPU decodes; EVT2 and EVT3 "
                                            "can be decoded on a device")};
  }
  if (const auto header = read_prophesee_header(*input); !header) {
    return Error{header.error().code, text(path, ": ", header.error().message)};
  }
  return std::unique_ptr<WordSource>(
      std::make_unique<WordFile>(*std::move(input), std::move(files), path, format, (*events)->sensor()));
}

}  // namespace

Result<std::unique_ptr<WordSource>> open_words(const std::string& path, const ReadOptions& options) {
  return as_result([&]() -> Result<std::unique_ptr<WordSource>> {
    auto words = open_unguarded(path, options);
    if (!words) return words.error();
    return guarded(*std::move(words));
  });
}

}  // namespace scarf
