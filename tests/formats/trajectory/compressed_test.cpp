// SPDX-License-Identifier: GPL-3.0-or-later
// Compressed runs, which threads decompress outside HDF5: numbers do not depend on how chunks are stored.
#include "formats/trajectory/writer.hpp"
#include "tests/formats/trajectory/trajectory_fixture.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <thread>

namespace grseg {
namespace {

constexpr TrajectoryReader::Fields everything{.velocity = true, .contacts = true, .force = true};
constexpr int frames = 7;
const char* const gaps = "/grseg/contacts/gap";

/// A chunk as stored in the file.
struct Stored {
  std::vector<char> bytes;
  std::uint32_t filters_left_out = 0;
};

Stored read_chunk(hid_t file, const char* dataset, hsize_t row)
{
  const hid_t id = H5Dopen2(file, dataset, H5P_DEFAULT);
  const hsize_t at[3] = {row, 0, 0};
  hsize_t size = 0;
  H5Dget_chunk_storage_size(id, at, &size);
  Stored chunk{std::vector<char>(size), 0};
  H5Dread_chunk(id, H5P_DEFAULT, at, &chunk.filters_left_out, chunk.bytes.data());
  H5Dclose(id);
  return chunk;
}

void write_chunk(hid_t file, const char* dataset, hsize_t row, const Stored& chunk)
{
  const hid_t id = H5Dopen2(file, dataset, H5P_DEFAULT);
  const hsize_t at[3] = {row, 0, 0};
  EXPECT_GE(H5Dwrite_chunk(id, H5P_DEFAULT, chunk.filters_left_out, at, chunk.bytes.size(),
                           chunk.bytes.data()),
            0);
  H5Dclose(id);
}

void expect_part(const std::string& text, const std::string& part)
{
  EXPECT_NE(text.find(part), std::string::npos) << text;
}

void expect_three_grains(const std::string& path)
{
  const TrajectoryReader reader(path);
  ASSERT_EQ(reader.size(), static_cast<std::size_t>(frames));
  Frame<2> frame;
  for (int k = 0; k < frames; ++k) {
    reader.read(static_cast<std::size_t>(k), frame, everything);
    expect_same(frame, three_grains::frame(k));
  }
}

TEST_F(Trajectory, ChunksOfSeveralFramesAndFramesOfSeveralChunksGiveTheSameNumbers)
{
  for (const std::size_t contacts : {1U, 2U, 3U, 5U, 8192U}) {
    three_grains::write(path, frames, {.compression = 6, .contact_chunk = contacts});
    expect_three_grains(path);
  }
}

// HDF5 stores a chunk like this if compression would not make it smaller.
TEST_F(Trajectory, AChunkThatIsStoredAsItIsGivesTheSameNumbers)
{
  three_grains::write(path, frames, {.compression = 6, .contact_chunk = 4});
  tamper([](hid_t file) {
    std::array<double, 4> rows{};
    const hid_t id = H5Dopen2(file, gaps, H5P_DEFAULT);
    const hid_t space = H5Dget_space(id),
                memory = H5Screate_simple(1, std::array{hsize_t{4}}.data(), nullptr);
    const hsize_t start = 4, count = 4;
    H5Sselect_hyperslab(space, H5S_SELECT_SET, &start, nullptr, &count, nullptr);
    H5Dread(id, H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, rows.data());
    H5Sclose(memory);
    H5Sclose(space);
    H5Dclose(id);
    Stored plain{std::vector<char>(sizeof rows), 3};
    std::memcpy(plain.bytes.data(), rows.data(), sizeof rows);
    write_chunk(file, gaps, 4, plain);
    Stored shuffled{std::vector<char>(sizeof rows), 2};
    for (std::size_t k = 0; k < sizeof rows; ++k)
      shuffled.bytes[k % 8 * 4 + k / 8] = plain.bytes[k];
    write_chunk(file, gaps, 4, shuffled);
  });
  expect_three_grains(path);
}

TEST_F(Trajectory, AChunkThatDecompressesToAnotherSizeIsNamed)
{
  const char* const forces = "/grseg/contacts/force";
  for (const bool smaller : {true, false}) {
    three_grains::write(path, frames, {.compression = 6, .contact_chunk = 4});
    tamper([&](hid_t file) {
      const char *from = gaps, *to = forces;
      if (!smaller) std::swap(from, to);
      write_chunk(file, to, 4, read_chunk(file, from, 4));
    });
    expect_part(complaint(), path + ": " + (smaller ? forces : gaps) +
                                 ": chunk 1, from row 4, does not decompress to its " +
                                 (smaller ? "64" : "32") + " bytes");
  }
}

TEST_F(Trajectory, AChunkThatIsCutShortOrChangedIsNamed)
{
  three_grains::write(path, frames, {.compression = 6, .contact_chunk = 4});
  tamper([](hid_t file) {
    auto chunk = read_chunk(file, gaps, 4);
    chunk.bytes.resize(chunk.bytes.size() / 2);
    write_chunk(file, gaps, 4, chunk);
  });
  expect_part(complaint(), std::string(gaps) + ": chunk 1");

  const char* const positions = "/particles/grains/position/value";
  three_grains::write(path, frames, {.compression = 6});
  tamper([&](hid_t file) { write_chunk(file, positions, 1, read_chunk(file, positions, 0)); });
  EXPECT_EQ(complaint(), path + ": /particles/grains/position of frame 1" + changed);
}

TEST_F(Trajectory, AChunkWhoseFiltersWereLeftOutMustHaveItsSize)
{
  three_grains::write(path, frames, {.compression = 6, .contact_chunk = 4});
  tamper([](hid_t file) {
    auto chunk = read_chunk(file, gaps, 4);
    chunk.filters_left_out = 3;
    chunk.bytes.push_back(0);  // HDF5 ignores a different mask if the size is equal
    write_chunk(file, gaps, 4, chunk);
  });
  expect_part(complaint(), std::string(gaps) + ": chunk 1");
}

// Each thread has loaded all its frames before another one decompresses, so that they share chunks.
TEST_F(Trajectory, SeveralThreadsUnpackTheSameChunks)
{
  three_grains::write(path, frames, {.compression = 6});
  const TrajectoryReader reader(path);
  constexpr std::size_t threads = 4;
  std::array<std::array<Frame<2>, frames>, threads> read;
  std::array<std::vector<TrajectoryReader::Packed>, threads> packed;
  for (std::size_t t = 0; t < threads; ++t)
    for (std::size_t k = 0; k < frames; ++k)
      packed[t].push_back(reader.load(k, read[t][k], everything));
  {
    std::vector<std::jthread> all;
    for (std::size_t t = 0; t < threads; ++t)
      all.emplace_back([&, t] {
        for (std::size_t k = 0; k < frames; ++k) reader.unpack(packed[t][k], read[t][k]);
      });
  }
  for (const auto& of_thread : read)
    for (int k = 0; k < frames; ++k)
      expect_same(of_thread[static_cast<std::size_t>(k)], three_grains::frame(k));
}

}  // namespace
}  // namespace grseg
