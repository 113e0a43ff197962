// Every command that writes files, and every kind of file that is read, for tests of disks that fail.
#pragma once

#include <map>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "scarf/io/recordings.h"
#include "tests/tools/program.h"

namespace scarf::tools {

class EveryCommand : public Program {
 protected:
  // The inputs, in a folder of their own.
  void make_inputs() {
    namespace fs = std::filesystem;
    const std::string original = recording(5'000);
    fs::create_directories(path("in/ecd/images"));
    fs::copy(original, path("in/a.txt"));
    std::ofstream events(path("in/ecd/events.txt"));
    for (size_t i = 0; i < 200; ++i) {
      const Event& e = events_[i];
      events << text("0.00", 1000 + i, " ", e.x, " ", e.y, " ", int{e.p}, "\n");
    }
    std::ofstream images(path("in/ecd/images.txt"));
    for (const std::string name : {"images/frame_0.png", "images/frame_1.png"}) {
      cv::Mat picture(kSensor.height, kSensor.width, CV_8UC1);
      cv::randu(picture, 0, 255);
      cv::imwrite(path("in/ecd/" + name), picture);
      images << "0.0015 " << name << "\n";
    }
    for (const std::string format : {"dsec", "evt2", "evt21", "evt3", "evt4", "dat", "es", "npy", "csv"}) {
      if (is_written(format)) copy(events_, path("in/a." + format), format);
    }
    write_text(path("in/times"), text(events_[1'000].t, "\n", events_[3'000].t, "\n"));
    write_text(path("in/list"), "a.txt\n");
    write_text(path("in/recipe.toml"), "every = 500\noutput = [\".png\", \".npy\", \".frames/\"" +
                                           std::string(is_written("dsec") ? ", \".h5\"]\n" : "]\n"));
  }

  static bool is_written(const std::string& format) {
    for (const FormatInfo& info : formats()) {
      if (info.name == format) return info.written && info.missing.empty();
    }
    return false;
  }

  // Of command lines that write below a folder.
  std::vector<std::string> writers(const std::string& out) const {
    const std::string in = path("in/");
    std::vector<std::string> commands;
    for (const FormatInfo& format : formats()) {
      if (!is_written(format.name)) continue;
      commands.push_back(
          text("convert ", in, "a.txt ", out, "/copy.", format.name, " --output-format ", format.name));
    }
    const std::string render = text("render --cpu ", in, "a.txt ");
    const std::string frames = render + "--every 500 ";
    commands.push_back(text("cut ", in, "a.txt ", out, "/cut.raw --from ", events_[100].t));
    commands.push_back(text(render, "-o ", out, "/a.png"));
    commands.push_back(text(render, "-o ", out, "/a.pgm"));
    commands.push_back(text(frames, "-o ", out, "/a.npy"));
    commands.push_back(text(frames, "-o ", out, "/a.avi"));
    commands.push_back(text(frames, "-o ", out, "/frames/"));
    commands.push_back(text(frames, "-o ", out, "/a.npy --sparse ", out, "/sparse.npz"));
    if (is_written("dsec")) {
      commands.push_back(text(frames, "-o ", out, "/a.h5"));
      commands.push_back(text(frames, "-o ", out, "/a.npy --sparse ", out, "/sparse.h5"));
      commands.push_back(text(frames, "-o ", out, "/tensors.h5 --encoding voxel_grid:bins=2"));
    }
    commands.push_back(text("frames ", in, "ecd -o ", out, "/frames"));
    commands.push_back(text("digest --cpu ", in, "a.txt --dump ", out, "/a.state"));
    commands.push_back(
        text("simulate ", out, "/a.raw --duration 0.02 --sensor 64x48 --truth ", out, "/frames"));
    commands.push_back(
        text("reprocess ", in, "list -o ", out, "/results --cpu --recipe ", in, "recipe.toml"));
    return commands;
  }

  // Of command lines that write nothing, whose output tells what was read.
  std::vector<std::string> readers() const {
    std::vector<std::string> commands;
    for (const std::string name : {"a.txt", "ecd", "a.dsec", "a.evt2", "a.evt21", "a.evt3", "a.evt4", "a.dat",
                                   "a.es", "a.npy", "a.csv", "a.zip", "a.db3"}) {
      if (std::filesystem::exists(path("in/" + name))) commands.push_back("info " + path("in/" + name));
    }
    return commands;
  }

  // A run that may fail, whose complaints are not looked at; `program` and its arguments.
  Outcome run_unchecked(const std::string& program, const std::string& arguments) const {
    const std::string line =
        text("exec >", path("out"), " 2>", path("err"), "; exec ", program, " ", arguments);
    const int status = std::system(line.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content_of(path("out")), content_of(path("err"))};
  }

  // One line; of reprocess one for the recording that failed, and one if its summary did.
  static void expect_error(const Outcome& outcome, const std::string& what, const std::string& command) {
    EXPECT_EQ(outcome.exit_code, 1) << what << outcome.err;
    EXPECT_THAT(outcome.err, testing::StartsWith("scarf: ")) << what;
    const auto lines = std::count(outcome.err.begin(), outcome.err.end(), '\n');
    EXPECT_TRUE(lines == 1 || (command.starts_with("reprocess") && lines == 2)) << what << outcome.err;
  }

  // Files below a folder with their content, but for what a clock has written into.
  static std::map<std::string, std::string> files_below(const std::string& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
      if (!entry.is_regular_file()) continue;
      // Records tell how long it took, so their lengths differ, which the lists note.
      const std::string name = entry.path().filename().string();
      const bool timed = name.ends_with(".json") || name.ends_with(".scarf-files");
      files[entry.path().lexically_relative(folder).string()] =
          timed ? "" : content_of(entry.path().string());
    }
    return files;
  }

  // What a job that failed has left behind but whole files: those of the job that did not fail.
  static std::string left_behind(const std::string& folder, const std::map<std::string, std::string>& whole) {
    std::string names;
    for (const auto& [name, content] : files_below(folder)) {
      // A list of scarf's own may name files that did not come; and frames of a recording that broke off are
      // kept, with the list of those that are there.
      if (name.ends_with(".scarf-files") || name == "frames/frames.csv") continue;
      const auto found = whole.find(name);
      if (found == whole.end() || found->second != content) names += name + " ";
    }
    return names;
  }

 private:
  static void copy(const std::vector<Event>& events, const std::string& file, const std::string& format) {
    auto sink = *create_events(file, format, kSensor);
    EXPECT_TRUE(sink->write(events).ok()) << format;
    EXPECT_TRUE(sink->finish().ok()) << format;
  }
};

}  // namespace scarf::tools
