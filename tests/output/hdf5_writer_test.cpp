// The HDF5 files of frames, tensors and sparse events, read back with libhdf5.
#include "output/hdf5_writer.h"

#include <gtest/gtest.h>
#include <hdf5.h>

#include <filesystem>

#include "tests/tools/temporary_folder.h"

namespace scarf::tools {
namespace {

struct Stored {
  std::vector<hsize_t> shape;
  std::vector<double> values;
};

Stored stored(const std::string& path, const char* dataset) {
  Stored result;
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t opened = H5Dopen2(file, dataset, H5P_DEFAULT);
  EXPECT_GE(opened, 0) << dataset;
  const hid_t space = H5Dget_space(opened);
  result.shape.resize(static_cast<size_t>(H5Sget_simple_extent_ndims(space)));
  H5Sget_simple_extent_dims(space, result.shape.data(), nullptr);
  result.values.resize(static_cast<size_t>(H5Sget_simple_extent_npoints(space)));
  EXPECT_GE(H5Dread(opened, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, result.values.data()), 0);
  H5Sclose(space);
  H5Dclose(opened);
  H5Fclose(file);
  return result;
}

TEST(Hdf5Writer, FramesGrowOneByOne) {
  const TemporaryFolder folder;
  const std::string path = folder.path("frames.h5");
  auto made = create_hdf5_arrays(path, kHdf5Frames, Hdf5Element::u8, {2, 3}, OutputRule());
  ASSERT_TRUE(made.ok()) << made.error().message;
  for (uint8_t i = 0; i < 3; ++i) {
    const std::vector<uint8_t> picture = {i, 1, 2, 3, 4, 255};
    ASSERT_TRUE((*made)->write({-5 + i, uint64_t{i} * 100}, picture).ok());
  }
  EXPECT_FALSE(std::filesystem::exists(path)) << "not before it is complete";
  ASSERT_TRUE((*made)->finish().ok());
  const Stored frames = stored(path, "frames");
  EXPECT_EQ(frames.shape, (std::vector<hsize_t>{3, 2, 3}));
  EXPECT_EQ(frames.values[6], 1);
  EXPECT_EQ(frames.values[17], 255);
  EXPECT_EQ(stored(path, "times").values, (std::vector<double>{-5, -4, -3}));
  EXPECT_EQ(stored(path, "events").values, (std::vector<double>{0, 100, 200}));
}

TEST(Hdf5Writer, TensorsHaveTheirChannels) {
  const TemporaryFolder folder;
  const std::string path = folder.path("tensors.h5");
  auto made = create_hdf5_arrays(path, kHdf5Tensors, Hdf5Element::f32, {2, 1, 2}, OutputRule());
  ASSERT_TRUE(made.ok()) << made.error().message;
  ASSERT_TRUE((*made)->write({7, 9}, std::vector<float>{0.5F, -1, 2, 3}).ok());
  ASSERT_TRUE((*made)->finish().ok());
  EXPECT_EQ(stored(path, "data").shape, (std::vector<hsize_t>{1, 2, 1, 2}));
  EXPECT_EQ(stored(path, "data").values, (std::vector<double>{0.5, -1, 2, 3}));
}

TEST(Hdf5Writer, RefusesOtherArrays) {
  const TemporaryFolder folder;
  auto made = create_hdf5_arrays(folder.path("a.h5"), kHdf5Frames, Hdf5Element::u8, {2, 2}, OutputRule());
  ASSERT_TRUE(made.ok());
  EXPECT_FALSE((*made)->write({}, std::vector<uint8_t>(5)).ok());
  EXPECT_FALSE((*made)->write({}, std::vector<float>(4)).ok());
}

TEST(Hdf5Writer, SparseEventsOfFrames) {
  const TemporaryFolder folder;
  const std::string path = folder.path("events.h5");
  auto made = create_hdf5_events(path, {640, 480}, OutputRule());
  ASSERT_TRUE(made.ok()) << made.error().message;
  ASSERT_TRUE((*made)->write({10, 2}, std::vector<Event>{{-1, 2, 3, 1}, {5, 639, 479, 0}}).ok());
  ASSERT_TRUE((*made)->write({20, 2}, std::vector<Event>{}).ok());
  ASSERT_TRUE((*made)->write({30, 3}, std::vector<Event>{{int64_t{1} << 40, 4, 5, 1}}).ok());
  ASSERT_TRUE((*made)->finish().ok());
  EXPECT_EQ(stored(path, "frame_offsets").values, (std::vector<double>{0, 2, 2, 3}));
  EXPECT_EQ(stored(path, "stream_events").values, (std::vector<double>{2, 2, 3}));
  EXPECT_EQ(stored(path, "times").values, (std::vector<double>{10, 20, 30}));
  EXPECT_EQ(stored(path, "events/x").values, (std::vector<double>{2, 639, 4}));
  EXPECT_EQ(stored(path, "events/y").values, (std::vector<double>{3, 479, 5}));
  EXPECT_EQ(stored(path, "events/p").values, (std::vector<double>{1, 0, 1}));
  EXPECT_EQ(stored(path, "events/t").values, (std::vector<double>{-1, 5, 1099511627776.0}));
  EXPECT_EQ(stored(path, "events/width").values, (std::vector<double>{640}));
}

TEST(Hdf5Writer, AnAbandonedFileLeavesNone) {
  const TemporaryFolder folder;
  const std::string path = folder.path("a.h5");
  { auto made = create_hdf5_arrays(path, kHdf5Frames, Hdf5Element::u8, {1, 1}, OutputRule()); }
  EXPECT_FALSE(std::filesystem::exists(path));
  EXPECT_FALSE(create_hdf5_events("/nonexistent/a.h5", {1, 1}, OutputRule()).ok());
}

}  // namespace
}  // namespace scarf::tools
