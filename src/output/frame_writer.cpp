#include "output/frame_writer.h"

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
#include "io/files/write_file.h"
#include "output/hdf5_writer.h"
#include "output/npy_file.h"
#include "output/opencv_picture.h"
#include "output/pictures.h"
#include "output/whole_video.h"

namespace scarf {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kFrame = "frame";
constexpr std::string_view kListHeader = "index,t_us,events\n";

std::string list_line(uint64_t index, const Frame& frame) {
  return text(index, ",", frame.t, ",", frame.events, "\n");
}

Error no_frame(const std::string& path) {
  return {ErrorCode::bad_input,
          text("no frame was due, so ", path,
               " was not written; use a higher FrameRequest::rate, or FrameRequest::at end")};
}

class FolderWriter final : public FrameWriter {
 public:
  explicit FolderWriter(PictureFolder folder) : folder_(std::move(folder)) {}

  Result<void> write(const Frame& frame, const PictureView& picture) override {
    list_ += list_line(index_, frame);
    return folder_.write(kFrame, index_++, picture);
  }

  Result<void> finish() override { return folder_.finish(list_); }

 private:
  PictureFolder folder_;
  uint64_t index_ = 0;
  std::string list_{kListHeader};
};

class ImageWriter final : public FrameWriter {
 public:
  ImageWriter(std::string path, const OutputRule& rule) : path_(std::move(path)), rule_(rule) {}

  Result<void> write(const Frame&, const PictureView& picture) override {
    return write_picture(path_, picture, rule_);
  }
  Result<void> finish() override { return {}; }

 private:
  const std::string path_;
  const OutputRule rule_;
};

class VideoFileWriter final : public FrameWriter {
 public:
  VideoFileWriter(OutputFile file, double fps) : path_(file.path()), file_(std::move(file)), fps_(fps) {
    silence_video_messages();
  }

  Result<void> write(const Frame&, const PictureView& picture) override {
    if (frames_ == 0 && !open({picture.size.width, picture.size.height})) {
      return Error{ErrorCode::io,
                   text("OpenCV cannot write the video ", path_,
                        "; check that its folder may be written and that OpenCV has FFmpeg, or "
                        "give a folder for PNG frames")};
    }
    cv::Mat colours;
    cv::cvtColor(as_mat(picture), colours,
                 cv::COLOR_GRAY2BGR);  // not every encoder takes single-channel pictures
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
    return file_.publish();
  }

 private:
  bool open(cv::Size size) {
    const bool mp4 = fs::path(path_).extension() == ".mp4";
    const int codec =
        mp4 ? cv::VideoWriter::fourcc('m', 'p', '4', 'v') : cv::VideoWriter::fourcc('M', 'J', 'P', 'G');
    return video_.open(file_.name(), codec, fps_, size);
  }

  const std::string path_;
  OutputFile file_;
  const double fps_;
  cv::VideoWriter video_;
  uint64_t frames_ = 0;
};

// Height and width, as arrays have them.
std::vector<size_t> shape_of(const PictureView& picture) {
  return {static_cast<size_t>(picture.size.height), static_cast<size_t>(picture.size.width)};
}

class NpyWriter final : public FrameWriter {
 public:
  NpyWriter(const std::string& path, const OutputRule& rule) : path_(path), rule_(rule) {}

  Result<void> write(const Frame& frame, const PictureView& picture) override {
    if (!file_) {
      auto file = NpyFile::create(path_, picture.floats() ? "<f4" : "|u1", shape_of(picture), rule_);
      if (!file) return file.error();
      file_.emplace(*std::move(file));
    }
    list_ += list_line(frames_++, frame);
    return std::visit([&](const auto pixels) { return file_->append(pixels); }, picture.pixels);
  }

  Result<void> finish() override {
    if (!file_) return no_frame(path_);
    if (auto r = file_->finish(); !r) return r;
    return write_file(companions_of(path_, OutputKind::npy).front(), list_, rule_);
  }

 private:
  const std::string path_;
  const OutputRule rule_;
  std::optional<NpyFile> file_;
  uint64_t frames_ = 0;
  std::string list_{kListHeader};
};

class Hdf5Writer final : public FrameWriter {
 public:
  Hdf5Writer(const std::string& path, const OutputRule& rule) : path_(path), rule_(rule) {}

  Result<void> write(const Frame& frame, const PictureView& picture) override {
    if (!file_) {
      auto file =
          create_hdf5_arrays(path_, kHdf5Frames, picture.floats() ? Hdf5Element::f32 : Hdf5Element::u8,
                             shape_of(picture), rule_);
      if (!file) return file.error();
      file_ = *std::move(file);
    }
    return std::visit([&](const auto pixels) { return file_->write(frame, pixels); }, picture.pixels);
  }

  Result<void> finish() override { return file_ ? file_->finish() : Result<void>(no_frame(path_)); }

 private:
  const std::string path_;
  const OutputRule rule_;
  std::unique_ptr<Hdf5ArrayWriter> file_;
};

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

std::vector<std::string> companions_of(const std::string& path, OutputKind kind) {
  if (kind != OutputKind::npy) return {};
  return {fs::path(path).replace_extension(".csv").string()};
}

Result<void> check_outputs(const std::string& path, OutputKind kind, const std::vector<std::string>& more,
                           const OutputRule& rule) {
  std::vector<std::string> files = companions_of(path, kind);
  files.insert(files.end(), more.begin(), more.end());
  if (kind == OutputKind::folder) {
    if (auto r = PictureFolder::check(path, {kFrame}, rule); !r) return r;
  } else {
    files.insert(files.begin(), path);
  }
  return rule.check(files);
}

Result<std::unique_ptr<FrameWriter>> make_frame_writer(const std::string& path, OutputKind kind,
                                                       double video_fps, const OutputRule& rule) {
  using Made = std::unique_ptr<FrameWriter>;
  if (kind == OutputKind::folder) {
    auto folder = PictureFolder::create(path, {kFrame}, rule);
    if (!folder) return folder.error();
    return Made(std::make_unique<FolderWriter>(*std::move(folder)));
  }
  if (kind == OutputKind::video) {
    auto file = OutputFile::create(path, rule);
    if (!file) return file.error();
    return Made(std::make_unique<VideoFileWriter>(*std::move(file), video_fps));
  }
  if (auto r = check_outputs(path, kind, {}, rule); !r) return r.error();  // early, before the work
  if (kind == OutputKind::npy) return Made(std::make_unique<NpyWriter>(path, rule));
  if (kind == OutputKind::hdf5) return Made(std::make_unique<Hdf5Writer>(path, rule));
  return Made(std::make_unique<ImageWriter>(path, rule));
}

}  // namespace scarf
