// scarf render: arrays, tensors and sparse events. What is in HDF5 files: hdf5_writer_test.cpp.
#include <fstream>
#include <iterator>

#include "core/little_endian.h"
#include "scarf/core/encoding.h"
#include "tests/tools/program.h"

namespace scarf::tools {
namespace {

using testing::HasSubstr;

constexpr size_t kHeader = 128;

class Products : public Program {
 protected:
  std::string bytes_of(const std::string& file) const {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
};

TEST_F(Products, AnNpyArrayHoldsThePicturesOfTheFrames) {
  const std::string file = recording(20'000);
  for (const std::string device : {"", " --cpu"}) {
    ASSERT_EQ(
        run("render --overwrite " + file + " -o " + path("frames.npy") + " --every 7000" + device).exit_code,
        0);
    const std::string bytes = bytes_of(path("frames.npy"));
    ASSERT_EQ(bytes.size(), kHeader + 2 * 64 * 48);
    EXPECT_THAT(bytes.substr(0, kHeader), HasSubstr("'descr': '|u1'"));
    EXPECT_THAT(bytes.substr(0, kHeader), HasSubstr("'shape': (2, 48, 64,)"));
    for (size_t i = 0; i < 2; ++i) {
      const cv::Mat expected = reference_picture(7'000 * (i + 1));
      EXPECT_EQ(std::memcmp(bytes.data() + kHeader + i * 64 * 48, expected.data, 64 * 48), 0)
          << "frame " << i;
    }
    EXPECT_EQ(content_of(path("frames.csv")),
              text("index,t_us,events\n0,", events_[6'999].t, ",7000\n1,", events_[13'999].t, ",14000\n"));
  }
}

TEST_F(Products, FloatsAreTheReferencesFloats) {
  const std::string file = recording(20'000);
  ASSERT_EQ(run("render " + file + " -o " + path("frames.npy") + " --pixels float --every 20000").exit_code,
            0);
  const std::string bytes = bytes_of(path("frames.npy"));
  ASSERT_EQ(bytes.size(), kHeader + 4 * 64 * 48);
  EXPECT_THAT(bytes.substr(0, kHeader), HasSubstr("'descr': '<f4'"));
  const auto scarf = *make_reference_scarf(*make_geometry(Preset::paper, kSensor));
  ASSERT_TRUE(scarf->push(events_).ok());
  const Image<float> image = *scarf->float_image().wait();
  EXPECT_EQ(std::memcmp(bytes.data() + kHeader, image.pixels.data(), 4 * 64 * 48), 0);
}

TEST_F(Products, WhatDoesNotGoTogetherIsRefused) {
  const std::string file = recording(100);
  for (const std::string& arguments : std::vector<std::string>{
           "a.png --pixels float", "a.npy --encoding tore", "a.h5 --encoding nonsense",
           "a.h5 --compare-window --encoding tore", "folder --sparse b.txt",
           "folder --sparse b.h5 --representation all", "folder --sparse b.h5 --representation aae"}) {
    EXPECT_EQ(run("render " + file + " --cpu --every 50 -o " + path(arguments)).exit_code, 2) << arguments;
  }
  // No frame, no file.
  const Outcome none = run("render " + file + " --cpu -o " + path("none.npy") + " --every 1000");
  EXPECT_EQ(none.exit_code, 1);
  EXPECT_THAT(none.err, HasSubstr("no frame was due"));
  EXPECT_FALSE(std::filesystem::exists(path("none.npy")));
}

// Independent readers: numpy and h5py.
TEST_F(Products, SparseEventsAndTensorsAreReadByPython) {
  if (std::system("python3 -c 'import numpy, h5py' 2>/dev/null") != 0 &&
      std::system("/usr/bin/python3 -c 'import numpy, h5py' 2>/dev/null") != 0) {
    GTEST_SKIP() << "python3 with numpy and h5py is not installed";
  }
  const std::string file = recording(20'000);
  for (const std::string device : {"", " --cpu"}) {
    ASSERT_EQ(run("render --overwrite " + file + " -o " + path("a.h5") + " --every 5000 --sparse " +
                  path("s.npz") + device)
                  .exit_code,
              0);
    ASSERT_EQ(run("render --overwrite " + file + " -o " + path("t.h5") +
                  " --every 5000 --encoding voxel_grid:bins=3 --sparse " + path("s.h5") + device)
                  .exit_code,
              0);
    std::ofstream(path("check.py")) << R"(
import sys, h5py, numpy as np
folder = sys.argv[1]
pictures, z = h5py.File(folder + "/a.h5")["frames"][:], np.load(folder + "/s.npz")
sparse, tensors = h5py.File(folder + "/s.h5"), h5py.File(folder + "/t.h5")["data"][:]
assert pictures.shape == (4, 48, 64) and tensors.shape == (4, 3, 48, 64)
for name in "xypt":
    assert (z[name] == sparse["events/" + name][:]).all()
offsets = z["frame_offsets"]
assert (offsets == sparse["frame_offsets"][:]).all() and list(z["stream_events"]) == [5000, 10000, 15000, 20000]
levels = np.array([0, 76, 153, 230, 255])
for k in range(4):
    part = slice(offsets[k], offsets[k + 1])
    counts = np.zeros((48, 64), int)
    np.add.at(counts, (z["y"][part], z["x"][part]), 1)
    assert (levels[np.minimum(counts, 4)] == pictures[k]).all()
    # The bins share out all events: ON adds, OFF subtracts.
    signed = np.where(z["p"][part] == 1, 1, -1).sum()
    assert abs(tensors[k].sum() - signed) < 0.1, (tensors[k].sum(), signed)
)";
    const std::string script = path("check.py") + " " + path("");
    EXPECT_TRUE(std::system(("python3 " + script + " 2>/dev/null").c_str()) == 0 ||
                std::system(("/usr/bin/python3 " + script).c_str()) == 0);
  }
}

}  // namespace
}  // namespace scarf::tools
