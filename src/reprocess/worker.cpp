#include "reprocess/worker.h"

#include <chrono>
#include <ctime>
#include <exception>
#include <filesystem>
#include <iomanip>
#include <new>
#include <sstream>
#include <utility>
#include <vector>

#include "core/text.h"
#include "io/open/open.h"
#include "output/event_list_writer.h"
#include "output/pictures.h"
#include "output/write_behind.h"
#include "reprocess/input_digest.h"
#include "reprocess/input_state.h"
#include "reprocess/record.h"
#include "reprocess/result_place.h"
#include "scarf/core/encoding.h"

namespace scarf::reprocess {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

std::string record_path(const std::string& out, const Job& job) {
  return (fs::path(out) / text(job.relative, kRecordSuffix)).string();
}

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  std::ostringstream out;
  out << std::put_time(&parts, "%FT%TZ");
  return out.str();
}

// Frames to several outputs at once.
class Several final : public FrameWriter {
 public:
  explicit Several(std::vector<std::unique_ptr<FrameWriter>> writers) : writers_(std::move(writers)) {}

  Result<void> write(const Frame& frame, const PictureView& picture) override {
    for (const auto& writer : writers_) {
      if (auto r = writer->write(frame, picture); !r) return r;
    }
    return {};
  }
  Result<void> finish() override {
    for (const auto& writer : writers_) {
      if (auto r = writer->finish(); !r) return r;
    }
    return {};
  }

 private:
  const std::vector<std::unique_ptr<FrameWriter>> writers_;
};

// Outputs are told apart by the names that they will have.
OutputKind kind_of(const std::string& suffix) {
  return *output_kind("recording" + suffix);  // parse_settings has let it pass
}

using Products = std::vector<std::unique_ptr<FrameProduct>>;

// What is written of each frame. Outputs that show the same share a product.
Result<Products> make_products(const Options& options, const ResultPlace& place,
                               const std::vector<Shown>& shown) {
  Representation& representation = *shown.front().representation;
  Products products;
  std::vector<std::unique_ptr<FrameWriter>> pictures;
  std::vector<std::unique_ptr<FrameWriter>> float_pictures;
  for (const std::string& suffix : options.outputs) {
    const OutputKind kind = kind_of(suffix);
    if (kind == OutputKind::image) continue;
    if (kind == OutputKind::hdf5 && !options.products.encoding.empty()) {
      const auto encoding = parse_encoding(options.products.encoding);
      if (!encoding) return encoding.error();
      auto tensors = tensor_product(representation, *encoding, place.working(suffix), OutputRule());
      if (!tensors) return tensors.error();
      products.push_back(*std::move(tensors));
      continue;
    }
    auto writer = make_frame_writer(place.working(suffix), kind, options.frames.shown_fps(), OutputRule());
    if (!writer) return writer.error();
    auto& group = options.products.floats && is_array(kind) ? float_pictures : pictures;
    group.push_back(std::make_unique<WriteBehind>(*std::move(writer)));
  }
  if (!pictures.empty()) {
    products.push_back(picture_product(shown, std::make_unique<Several>(std::move(pictures))));
  }
  if (!float_pictures.empty()) {
    products.push_back(float_product(representation, std::make_unique<Several>(std::move(float_pictures))));
  }
  if (!options.products.sparse.empty()) {
    auto writer =
        make_event_list_writer(place.working(options.products.sparse), representation.sensor(), OutputRule());
    if (!writer) return writer.error();
    products.push_back(event_product(representation, *std::move(writer)));
  }
  return products;
}

Result<void> write_final_pictures(const Options& options, const ResultPlace& place,
                                  const Computed& computed) {
  const Frame frame{computed.last_time, computed.report.events};
  for (const std::string& suffix : options.outputs) {
    if (kind_of(suffix) != OutputKind::image) continue;
    auto writer =
        make_frame_writer(place.working(suffix), OutputKind::image, options.frames.shown_fps(), OutputRule());
    if (!writer) return writer.error();
    if (auto r = (*writer)->write(frame, computed.image); !r) return r;
    if (auto r = (*writer)->finish(); !r) return r;
  }
  return {};
}

Outcome outcome_of(const Job& job, Status status) {
  Outcome outcome;
  outcome.relative = job.relative;
  outcome.status = status;
  outcome.bytes = job.bytes;
  return outcome;
}

Outcome failed(const Job& job, const Error& error) {
  Outcome outcome = outcome_of(job, Status::failed);
  outcome.message = in_settings(error.message);
  outcome.code = error.code;
  return outcome;
}

Result<Options> options_of(const Job& job) {
  auto options = parse_settings(job.settings);
  if (options) options->stream.file = job.path;
  return options;
}

// What a limit does not cut is the same with any limit.
SettingWords without_limit(SettingWords settings) {
  settings.erase("max-frames");
  return settings;
}

// The digest of the file of the frames' times; empty if there is none, or no regular one: who needs it
// will say so.
std::string times_digest(const Job& job, const Options& options) {
  if (options.frames.at_times.empty()) return {};
  const std::string file = side_file(options.frames.at_times, job.path);
  if (!file_state(file)) return {};
  const auto digest = input_digest(file, "");
  return digest ? *digest : std::string();
}

// Whether an earlier run has finished the job: the record is there with the same recipe, so are the outputs
// that it names, and the inputs are the same.
std::optional<Record> finished(const Job& job, const Options& options, const std::string& out,
                               const InputState& input) {
  const auto record = read_record(record_path(out, job));
  if (!record || record->times_sha256 != times_digest(job, options)) return std::nullopt;
  if (without_limit(record->settings) != without_limit(job.settings)) return std::nullopt;
  std::error_code error;
  for (const std::string& suffix : record->outputs) {
    if (!fs::exists(fs::path(out) / (job.relative + suffix), error)) return std::nullopt;
  }
  return is_same_input(job.path, out, input, record->input) ? std::optional(*record) : std::nullopt;
}

// As open_recording, with the bytes that are read.
Result<OpenRecording> open_seen(const StreamRequest& options, BytesRead& read) {
  auto source = open_events(options.file, options.read, [&](std::span<const uint8_t> b) { read.add(b); });
  if (!source) return source.error();
  const auto sensor = require_sensor(**source, options.file);
  if (!sensor) return sensor.error();
  return OpenRecording{*std::move(source), *sensor};
}

Result<Outcome> process(const Job& job, const Workplace& workplace, Meter& meter) {
  const auto start = Clock::now();
  const std::string started = utc_now();
  const auto options = options_of(job);
  if (!options) return options.error();
  // It must stay as it is from now until all of it is read and its digest made.
  const auto input = input_state(job.path, workplace.out);
  if (!input) return input.error();
  if (workplace.resume) {
    if (const auto record = finished(job, *options, workplace.out, *input)) {
      Outcome kept = outcome_of(job, Status::kept);
      kept.events = record->events;
      kept.frames = record->frames;
      return kept;
    }
  }
  if (options->skip) {
    Outcome skipped = outcome_of(job, Status::skipped);
    skipped.message = "the recipe leaves it out";
    return skipped;
  }
  BytesRead read;
  auto recording = open_seen(options->stream, read);
  if (!recording) {
    if (recording.error().code != ErrorCode::unrecognised || job.listed) return recording.error();
    Outcome skipped = outcome_of(job, Status::skipped);
    skipped.message = "not a recording";
    return skipped;
  }
  const std::vector<std::string> outputs = suffixes_of(job.settings);
  OutputRule rule = workplace.rule;
  rule.add_input(job.path, workplace.out);
  auto place = ResultPlace::claim(workplace.out, job.relative, result_suffixes(job.settings),
                                  workplace.replaces(), rule);
  if (!place) return place.error();
  const std::string times = times_digest(job, *options);
  const auto computed = compute(
      *std::move(recording), job.path, *options, workplace.machine,
      [&](const std::vector<Shown>& shown) { return make_products(*options, *place, shown); }, meter);
  if (!computed) return computed.error();
  if (times_digest(job, *options) != times) {
    return Error{ErrorCode::bad_input, text(side_file(options->frames.at_times, job.path),
                                            " changed while the recording was read; process it again")};
  }
  auto identity = identify(job.path, workplace.out, *input, read);
  if (!identity) return identity.error();
  if (auto r = write_final_pictures(*options, *place, *computed); !r) return r.error();

  const Record record{*std::move(identity),    times,           job.settings, computed->digests, outputs,
                      computed->report.events, computed->frames};
  const auto seconds = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  const std::string content =
      record_text(record, job, *computed, workplace.machine.name(), {started, seconds()});
  if (auto r = place->complete(content); !r) return r.error();
  Outcome done = outcome_of(job, Status::done);
  done.events = computed->report.events;
  done.frames = computed->frames;
  done.seconds = seconds();
  return done;
}

// The names of the digests that differ.
std::string differences(const Digests& a, const Digests& b) {
  std::string names;
  for (const auto& [name, equal] :
       {std::pair{"state", a.state == b.state}, std::pair{"image", a.image == b.image},
        std::pair{"events", a.events == b.events}}) {
    if (!equal) names += text(names.empty() ? "" : ", ", name);
  }
  return names;
}

Result<Outcome> check(const Job& job, const Workplace& workplace, Meter& meter) {
  const auto start = Clock::now();
  const auto record = read_record(record_path(workplace.out, job));
  if (!record) return record.error();
  const auto options = options_of(job);
  if (!options) return options.error();
  auto recording = open_recording(options->stream);
  if (!recording) return recording.error();
  const Machine reference{nullptr, workplace.machine.batches};
  const auto computed = compute(*std::move(recording), job.path, *options, reference, {}, meter);
  if (!computed) return computed.error();
  const std::string different = differences(record->digests, computed->digests);
  Outcome outcome = outcome_of(job, different.empty() ? Status::identical : Status::differs);
  if (!different.empty()) outcome.message = text("on the CPU reference differ: ", different);
  outcome.events = computed->report.events;
  outcome.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return outcome;
}

}  // namespace

Outcome do_task(const Task& task, const Workplace& workplace, Meter& meter) {
  try {  // an exception, of OpenCV or for memory, must not end the thread
    const bool is_check = task.kind == Task::Kind::check;
    auto outcome = is_check ? check(task.job, workplace, meter) : process(task.job, workplace, meter);
    return outcome ? *std::move(outcome) : failed(task.job, outcome.error());
  } catch (const std::bad_alloc&) {
    return failed(task.job, {ErrorCode::out_of_memory, "out of memory; use fewer workers"});
  } catch (const std::exception& e) {
    return failed(task.job, {ErrorCode::bad_input, e.what()});
  }
}

bool has_record(const std::string& out, const Job& job) {
  std::error_code ignored;
  return fs::exists(record_path(out, job), ignored);
}

bool is_record(const std::string& out, const Job& job) {
  return read_record(record_path(out, job)).ok();
}

}  // namespace scarf::reprocess
