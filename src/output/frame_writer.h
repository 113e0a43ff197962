// Where rendered frames go: a folder of PNG files, a video, or one image.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "io/files/output_files.h"
#include "output/picture.h"
#include "scarf/core/result.h"
#include "session/instants.h"

namespace scarf {

enum class OutputKind { folder, video, image, npy, hdf5 };

/// The kind of output by its name: .mp4 and .avi are videos, .png and .pgm images, .npy and .h5 or .hdf5
/// arrays of all frames, a name without an extension or ending in / is a folder. Errors: illegal_parameter
/// for any other extension.
Result<OutputKind> output_kind(const std::string& path);

/// Whether the output holds numbers as they are: floats too.
inline bool is_array(OutputKind kind) {
  return kind == OutputKind::npy || kind == OutputKind::hdf5;
}

/// Keeps the libraries behind videos from printing: what goes wrong is told by the writer. Sets environment
/// variables, so a program with threads calls it before it starts them.
void silence_video_messages();

/// Takes pictures of one size and type, in order: 8 bits, and floats where is_array().
class FrameWriter {
 public:
  virtual ~FrameWriter() = default;
  /// Errors: io.
  virtual Result<void> write(const Frame& frame, const PictureView& picture) = 0;
  /// Completes the output. Errors: io.
  virtual Result<void> finish() = 0;
};

/// `video_fps` is the speed at which a video is shown. A folder is made if it is not there, see
/// PictureFolder. Beside NAME.npy (n, height, width) comes NAME.csv, the list that a
/// folder has inside it; HDF5: see hdf5_writer.h. Errors: as check_outputs; io.
Result<std::unique_ptr<FrameWriter>> make_frame_writer(const std::string& path, OutputKind kind,
                                                       double video_fps, const OutputRule& rule);

/// The files that such a writer makes besides what it is named, and whether all of them may be written.
std::vector<std::string> companions_of(const std::string& path, OutputKind kind);
/// `more`: other files of the same command. Errors: as OutputRule::check and PictureFolder::check.
Result<void> check_outputs(const std::string& path, OutputKind kind, const std::vector<std::string>& more,
                           const OutputRule& rule);

}  // namespace scarf
