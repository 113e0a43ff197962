// scarf frames: the greyscale frames that a recording holds beside its events.
#include "scarf/frames.h"

#include <iostream>

#include "core/text.h"
#include "tools/commands.h"
#include "tools/files.h"
#include "tools/pictures.h"
#include "tools/read_options.h"

namespace scarf::tools {
namespace {

constexpr std::string_view kName = "frame";

struct FramesOptions {
  std::string file;
  std::string output;
  ReadOptions read;
  bool allow_empty = false;
};

Result<int> frames(const FramesOptions& options) {
  const auto source = open_frames(options.file, options.read);
  if (!source) return source.error();
  // Nothing is made for a recording without frames.
  auto frame = (*source)->read();
  if (!frame) return frame.error();
  if (!*frame && !options.allow_empty) {
    return Error{ErrorCode::bad_input,
                 text(options.file, ": it holds no frame; if that is right, give --allow-empty")};
  }
  if (auto r = make_picture_folder(options.output, {kName}); !r) return r.error();
  uint64_t index = 0;
  std::string list = "index,t_us,exposure_begin_us,exposure_end_us\n";
  // A recording may break off: the list names the pictures before that, too.
  const auto write_list = [&] { return write_file(text(options.output, "/", kPictureList), list); };
  for (; *frame; ++index) {
    const GreyFrame& f = **frame;
    const std::string picture = text(options.output, "/", numbered_picture(kName, index));
    if (auto r = write_picture(picture, as_picture(f.image)); !r) return r.error();
    list += text(index, ",", f.t, ",", f.exposure_begin, ",", f.exposure_end, "\n");
    frame = (*source)->read();
    if (frame) continue;
    if (auto r = write_list(); !r) return r.error();
    return frame.error();
  }
  if (auto r = write_list(); !r) return r.error();
  const PassedFrames& passed = (*source)->passed_over();
  if (passed.count == 0) return 0;
  const std::string what = text(passed.count, " frames or broken places were passed over; the first at byte ",
                                passed.first->byte, ": ", passed.first->what);
  if (index == 0) return Error{ErrorCode::bad_input, text(options.file, ": no frame was read: ", what)};
  std::cout << "lost: " << what << "\n";
  return 0;
}

}  // namespace

void add_frames(CLI::App& program, Command& command) {
  CLI::App* app = program.add_subcommand(
      "frames", "The greyscale frames of a recording as frame_NNNNNN.png, and frames.csv with their times");
  auto options = std::make_shared<FramesOptions>();
  app->add_option("file", options->file, "Recording, or its folder")->required();
  app->add_option("-o,--output", options->output,
                  "Folder for PNG frames and their list frames.csv; frames of an earlier run are removed")
      ->required();
  add_read_options(*app, options->read);
  add_allow_empty(*app, options->allow_empty);
  app->callback([&command, options] { command.run = [options] { return frames(*options); }; });
}

}  // namespace scarf::tools
