// scarf frames: the greyscale frames that a recording holds beside its events.
#include "scarf/io/frames.h"

#include <iostream>

#include "core/text.h"
#include "output/pictures.h"
#include "session/request.h"
#include "tools/commands.h"
#include "tools/file_options.h"
#include "tools/options.h"

namespace scarf::tools {
namespace {

constexpr std::string_view kName = "frame";

struct FramesOptions {
  std::string file;
  std::string output;
  ReadOptions read;
  bool allow_empty = false;
};

Result<int> frames(const FramesOptions& options, const OutputRule& rule) {
  if (auto r = PictureFolder::check(options.output, {kName}, rule); !r) return r.error();
  const auto source = open_frames(options.file, options.read);
  if (!source) return source.error();
  // Nothing is made for a recording without frames.
  auto frame = (*source)->read();
  if (!frame) return frame.error();
  const PassedFrames& passed = (*source)->passed_over();
  const auto passed_over = [&] {
    return text(passed.count, " frames or broken places were passed over; the first at byte ",
                passed.first->byte, ": ", passed.first->what);
  };
  if (!*frame && passed.count > 0) {
    return Error{ErrorCode::bad_input, text(options.file, ": no frame was read: ", passed_over())};
  }
  if (!*frame && !options.allow_empty) {
    return Error{ErrorCode::bad_input,
                 text(options.file, ": it holds no frame; if that is right, give --allow-empty")};
  }
  auto folder = PictureFolder::create(options.output, {kName}, rule);
  if (!folder) return folder.error();
  std::string list = "index,t_us,exposure_begin_us,exposure_end_us\n";
  for (uint64_t index = 0; *frame; ++index) {
    const GreyFrame& f = **frame;
    if (auto r = folder->write(kName, index, f.image); !r) return r.error();
    list += text(index, ",", f.t, ",", f.exposure_begin, ",", f.exposure_end, "\n");
    frame = (*source)->read();
    if (frame) continue;
    // A recording may break off: the pictures before that are kept, and the list names them.
    if (auto r = folder->finish(list); !r) return r.error();
    return frame.error();
  }
  if (auto r = folder->finish(list); !r) return r.error();
  if (passed.count > 0) std::cout << "lost: " << passed_over() << "\n";
  return 0;
}

}  // namespace

void add_frames(CLI::App& program, Command& command) {
  CLI::App* app = program.add_subcommand(
      "frames", "The greyscale frames of a recording as frame_NNNNNN.png, and frames.csv with their times");
  auto options = std::make_shared<FramesOptions>();
  add_input_option(*app, "file", options->file, "Recording, or its folder")->required();
  add_output_option(
      *app, "-o,--output", options->output,
      "Folder for PNG frames and their list frames.csv; with --overwrite those of an earlier run "
      "are replaced")
      ->required();
  add_settings(*app, read_settings(options->read));
  add_settings(*app, empty_settings(options->allow_empty));
  app->callback([&command, app, options] {
    command.run = [app, options] { return frames(*options, output_rule(*app)); };
  });
}

}  // namespace scarf::tools
