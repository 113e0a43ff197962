#include "tools/frame_writer.h"

#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <optional>
#include <span>
#include <system_error>
#include <utility>

#include "core/text.h"
#include "io/atomic_file.h"
#include "tools/files.h"
#include "tools/hdf5_writer.h"
#include "tools/npy_file.h"
#include "tools/pictures.h"
#include "tools/whole_video.h"

namespace scarf::tools {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kFrame = "frame";
constexpr std::string_view kListHeader = "index,t_us,events\n";

std::string list_line(uint64_t index, const Frame& frame) {
  return text(index, ",", frame.t, ",", frame.events, "\n");
}

Error no_frame(const std::string& path) {
  return {ErrorCode::bad_input,
          text("no frame was due, so ", path, " was not written; use a higher --rate, or --at end")};
}

class FolderWriter final : public FrameWriter {
 public:
  explicit FolderWriter(fs::path folder) : folder_(std::move(folder)) {}

  // Pictures without their list are no result.
  ~FolderWriter() override {
    std::error_code ignored;
    for (uint64_t i = 0; !finished_ && i < index_; ++i) fs::remove(picture_path(i), ignored);
  }

  Result<void> write(const Frame& frame, const cv::Mat& picture) override {
    list_ += list_line(index_, frame);
    return write_picture(picture_path(index_++), picture);
  }

  Result<void> finish() override {
    const auto written = write_file((folder_ / kPictureList).string(), list_);
    finished_ = written.ok();
    return written;
  }

 private:
  std::string picture_path(uint64_t index) const {
    return (folder_ / numbered_picture(kFrame, index)).string();
  }

  const fs::path folder_;
  uint64_t index_ = 0;
  bool finished_ = false;
  std::string list_{kListHeader};
};

class ImageWriter final : public FrameWriter {
 public:
  explicit ImageWriter(std::string path) : path_(std::move(path)) {}

  Result<void> write(const Frame&, const cv::Mat& picture) override { return write_picture(path_, picture); }
  Result<void> finish() override { return {}; }

 private:
  const std::string path_;
};

class VideoFileWriter final : public FrameWriter {
 public:
  VideoFileWriter(const std::string& path, double fps) : path_(path), file_(path), fps_(fps) {
    silence_video_messages();
  }

  Result<void> write(const Frame&, const cv::Mat& picture) override {
    if (frames_ == 0 && !open(picture.size())) {
      return Error{ErrorCode::io,
                   text("OpenCV cannot write the video ", path_,
                        "; check that its folder may be written and that OpenCV has FFmpeg, or "
                        "give a folder for PNG frames")};
    }
    cv::Mat colours;
    cv::cvtColor(picture, colours, cv::COLOR_GRAY2BGR);  // not every encoder takes single-channel pictures
    video_.write(colours);
    ++frames_;
    return {};
  }

  Result<void> finish() override {
    if (frames_ == 0) return no_frame(path_);
    video_.release();
    // The encoder does not tell of a full disk, but then the file is not whole, or cannot be read back.
    if (auto r = check_whole_video(file_.name(), path_); !r) return r;
    cv::VideoCapture written(file_.name());
    const double found = written.isOpened() ? written.get(cv::CAP_PROP_FRAME_COUNT) : 0;
    if (found != static_cast<double>(frames_)) {
      return Error{ErrorCode::io, text("cannot write ", path_, ": ", found, " of ", frames_,
                                       " frames can be read back; check the space on its disk")};
    }
    return file_.put_in_place();
  }

 private:
  bool open(cv::Size size) {
    const bool mp4 = fs::path(path_).extension() == ".mp4";
    const int codec =
        mp4 ? cv::VideoWriter::fourcc('m', 'p', '4', 'v') : cv::VideoWriter::fourcc('M', 'J', 'P', 'G');
    return video_.open(file_.name(), codec, fps_, size);
  }

  const std::string path_;
  AtomicFile file_;
  const double fps_;
  cv::VideoWriter video_;
  uint64_t frames_ = 0;
};

// Pictures as rows of numbers, whatever cv::Mat has between its lines.
template <class T>
std::span<const T> pixels_of(const cv::Mat& continuous) {
  return {continuous.ptr<T>(), continuous.total()};
}

class NpyWriter final : public FrameWriter {
 public:
  explicit NpyWriter(const std::string& path) : path_(path) {}

  Result<void> write(const Frame& frame, const cv::Mat& picture) override {
    const bool floats = picture.type() == CV_32FC1;
    if (!file_) {
      auto file = NpyFile::create(path_, floats ? "<f4" : "|u1",
                                  {static_cast<size_t>(picture.rows), static_cast<size_t>(picture.cols)});
      if (!file) return file.error();
      file_ = *std::move(file);
    }
    list_ += list_line(frames_++, frame);
    const cv::Mat whole = picture.isContinuous() ? picture : picture.clone();
    return floats ? file_->append(pixels_of<float>(whole)) : file_->append(pixels_of<uint8_t>(whole));
  }

  Result<void> finish() override {
    if (!file_) return no_frame(path_);
    if (auto r = file_->finish(); !r) return r;
    return write_file(fs::path(path_).replace_extension(".csv").string(), list_);
  }

 private:
  const std::string path_;
  std::optional<NpyFile> file_;
  uint64_t frames_ = 0;
  std::string list_{kListHeader};
};

class Hdf5Writer final : public FrameWriter {
 public:
  explicit Hdf5Writer(const std::string& path) : path_(path) {}

  Result<void> write(const Frame& frame, const cv::Mat& picture) override {
    const bool floats = picture.type() == CV_32FC1;
    if (!file_) {
      auto file = create_hdf5_arrays(path_, kHdf5Frames, floats ? Hdf5Element::f32 : Hdf5Element::u8,
                                     {static_cast<size_t>(picture.rows), static_cast<size_t>(picture.cols)});
      if (!file) return file.error();
      file_ = *std::move(file);
    }
    const cv::Mat whole = picture.isContinuous() ? picture : picture.clone();
    return floats ? file_->write(frame, pixels_of<float>(whole))
                  : file_->write(frame, pixels_of<uint8_t>(whole));
  }

  Result<void> finish() override { return file_ ? file_->finish() : Result<void>(no_frame(path_)); }

 private:
  const std::string path_;
  std::unique_ptr<Hdf5ArrayWriter> file_;
};

// An early answer, before a long recording is worked through.
Result<void> check_folder_of(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  std::error_code ignored;
  if (folder.empty() || fs::is_directory(folder, ignored)) return {};
  return Error{ErrorCode::io, text("the folder of ", path, " does not exist; create it first")};
}

}  // namespace

void silence_video_messages() {
  static std::once_flag done;
  std::call_once(done, [] {
    cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
    setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", /*overwrite=*/0);  // AV_LOG_QUIET
  });
}

Result<OutputKind> output_kind(const std::string& path) {
  if (path.empty()) return Error{ErrorCode::illegal_parameter, "the name of the output is empty"};
  std::error_code ignored;
  const std::string extension = fs::path(path).extension().string();
  if (extension.empty() || fs::is_directory(path, ignored))
    return OutputKind::folder;  // "out/" has no extension
  if (extension == ".mp4" || extension == ".avi") return OutputKind::video;
  if (extension == ".png" || extension == ".pgm") return OutputKind::image;
  if (extension == ".npy") return OutputKind::npy;
  if (extension == ".h5" || extension == ".hdf5") return OutputKind::hdf5;
  return Error{
      ErrorCode::illegal_parameter,
      text("output ", path,
           " is of no known kind; use .mp4 or .avi for a video, .png or .pgm for an image, .npy or .h5 "
           "for an array of frames, or end the name in / for a folder of frames")};
}

Result<std::unique_ptr<FrameWriter>> make_frame_writer(const std::string& path, OutputKind kind,
                                                       double video_fps) {
  if (kind == OutputKind::folder) {
    if (auto r = make_picture_folder(path, {kFrame}); !r) return r.error();
    return std::unique_ptr<FrameWriter>(std::make_unique<FolderWriter>(path));
  }
  if (auto r = check_folder_of(path); !r) return r.error();
  if (kind == OutputKind::npy) return std::unique_ptr<FrameWriter>(std::make_unique<NpyWriter>(path));
  if (kind == OutputKind::hdf5) return std::unique_ptr<FrameWriter>(std::make_unique<Hdf5Writer>(path));
  if (kind == OutputKind::image) return std::unique_ptr<FrameWriter>(std::make_unique<ImageWriter>(path));
  return std::unique_ptr<FrameWriter>(std::make_unique<VideoFileWriter>(path, video_fps));
}

}  // namespace scarf::tools
