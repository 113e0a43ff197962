#include "reprocess/settings.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>
#include <utility>

#include "core/text.h"
#include "output/event_list_writer.h"
#include "reprocess/result_place.h"
#include "scarf/core/encoding.h"

namespace scarf::reprocess {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 4> kInstants = {"rate", "every", "at", "at-times"};

Error illegal(const std::string& message) {
  return {ErrorCode::illegal_parameter, message};
}

Result<void> check_suffix(const std::string& output) {
  const std::string name = output.substr(0, output.size() - (output.ends_with('/') ? 1 : 0));
  if (name.empty() || name.find('/') != name.npos) {
    return illegal(text("output '", output,
                        "' is not something to add to a recording's name, such as .png, .mp4 or .frames/"));
  }
  if (name == kRecordSuffix || name.ends_with(kUnfinishedSuffix)) {
    return illegal(text("output '", output, "' is taken by the program itself; choose another name"));
  }
  return {};
}

Result<void> check_output(const FrameRequest& frames, const std::string& output) {
  if (auto r = check_suffix(output); !r) return r;
  const auto kind = output_kind("recording" + output);
  if (!kind) return kind.error();
  if (*kind == OutputKind::image) return {};  // shows the end, whatever the others show
  if (*kind == OutputKind::video) return check_frames(frames, output, *kind);
  FrameRequest without_speed = frames;
  without_speed.video_fps.reset();  // of a video beside it
  return check_frames(without_speed, output, *kind);
}

// Settings that no output makes use of are mistakes.
Result<void> check_use(const Options& options) {
  bool sequence = !options.products.sparse.empty();
  bool video = false;
  bool float_array = false;
  bool tensors = false;
  for (const std::string& output : options.outputs) {
    const OutputKind kind = *output_kind("recording" + output);
    const bool tensor = kind == OutputKind::hdf5 && !options.products.encoding.empty();
    sequence |= kind != OutputKind::image;
    video |= kind == OutputKind::video;
    tensors |= tensor;
    float_array |= is_array(kind) && !tensor;
  }
  if (options.frames.timed() && !sequence) {
    return illegal(
        "rate, every and at-times are used by outputs with several frames only; add output = \".frames/\" or "
        "\".mp4\"");
  }
  if (options.frames.video_fps && !video) {
    return illegal("video-fps is used by videos only; add output = \".mp4\", or leave it out");
  }
  if (options.products.floats && !float_array) {
    return illegal("pixels = \"float\" is used by arrays only; add output = \".npy\", or leave it out");
  }
  if (!options.products.encoding.empty() && !tensors) {
    return illegal("encoding makes tensors, which go into an .h5; add output = \".h5\", or leave it out");
  }
  return {};
}

Result<void> check_products(const Options& options) {
  const ProductRequest& products = options.products;
  if (!products.encoding.empty()) {
    if (const auto encoding = parse_encoding(products.encoding); !encoding) return encoding.error();
  }
  if (!products.sparse.empty()) {
    if (auto r = check_suffix(products.sparse); !r) return r;
    if (auto r = check_event_list("recording" + products.sparse); !r) return r;
  }
  if (products.special() && options.stream.representation == "aae") {
    return illegal(
        "pixels, encoding and sparse would ask aae several times for a frame, which changes its state each "
        "time; use another representation, or pictures alone");
  }
  return {};
}

}  // namespace

Settings settings_of(Options& options) {
  Settings settings("Options");
  settings.join(read_settings(options.stream.read));
  settings.join(representation_settings(options.stream));
  settings.join(frame_settings(options.frames));
  settings.join(empty_settings(options.stream.allow_empty));
  settings.join(product_settings(options.products, ""));
  settings
      .add(Setting::Kind::word, "output", "What is made: .png, .mp4, .frames/ and so on",
           [&options](const std::string& word) -> Result<void> {
             options.outputs.push_back(word);
             return {};
           })
      .repeated = true;
  settings.add_flag("skip", options.skip, "The recording is left out");
  return settings;
}

std::vector<std::string> suffixes_of(const SettingWords& settings) {
  std::vector<std::string> suffixes = settings.at("output");
  const auto sparse = settings.find("sparse");
  if (sparse != settings.end()) suffixes.insert(suffixes.end(), sparse->second.begin(), sparse->second.end());
  return suffixes;
}

std::vector<std::string> result_suffixes(const SettingWords& settings) {
  const std::string name = "recording";
  std::vector<std::string> all = suffixes_of(settings);
  for (const std::string& suffix : suffixes_of(settings)) {
    const auto kind = output_kind(name + suffix);
    if (!kind) continue;  // of sparse events
    for (const std::string& file : companions_of(name + suffix, *kind))
      all.push_back(file.substr(name.size()));
  }
  return all;
}

void lay_over(SettingWords& settings, const SettingWords& more) {
  const auto is_instant = [&](std::string_view name) { return more.contains(std::string(name)); };
  if (std::any_of(kInstants.begin(), kInstants.end(), is_instant)) {
    for (const std::string_view name : kInstants) settings.erase(std::string(name));
    if (!more.contains("at-times")) {
      settings.erase("times-column");
      settings.erase("times-unit");
    }
  }
  for (const auto& [name, words] : more) settings[name] = words;
}

Result<Options> parse_settings(const SettingWords& words) {
  Options options;
  if (auto r = set(settings_of(options), words); !r) return r.error();
  for (const std::string& output : options.outputs) {
    if (auto r = check_output(options.frames, output); !r) return illegal(in_settings(r.error().message));
  }
  if (auto r = check_products(options); !r) return illegal(in_settings(r.error().message));
  if (auto r = check_use(options); !r) return r.error();
  return options;
}

std::string in_settings(const std::string& message) {
  Options options;
  return with_names(message, settings_of(options), [](const Setting& setting) { return setting.name; });
}

std::string side_file(const std::string& name, const std::string& recording) {
  const fs::path path = fs::path(recording).lexically_normal();
  const bool ends_in_slash = path.filename().empty();
  const fs::path file = ends_in_slash ? path.parent_path() : path;
  std::error_code ignored;
  const fs::path folder = fs::is_directory(file, ignored) ? file : file.parent_path();
  std::string filled = name;
  for (const auto& [word, value] :
       {std::pair{"{path}", file.string()}, std::pair{"{folder}", folder.string()},
        std::pair{"{name}", file.filename().string()}, std::pair{"{stem}", file.stem().string()}}) {
    for (size_t at = 0; (at = filled.find(word, at)) != filled.npos; at += value.size()) {
      filled.replace(at, std::string_view(word).size(), value);
    }
  }
  // What begins with {path} or {folder} is complete already.
  const bool complete = name.starts_with("{path}") || name.starts_with("{folder}");
  return complete ? filled : (folder / filled).string();
}

}  // namespace scarf::reprocess
