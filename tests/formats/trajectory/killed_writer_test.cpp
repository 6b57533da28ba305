// SPDX-License-Identifier: GPL-3.0-or-later
// Files after a kill that interrupts a write. Linux copies written data page by page, and a signal
// that ends the process stops it between two pages.
#include "tests/formats/trajectory/trajectory_fixture.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/syscall.h>

#include <algorithm>
#include <string_view>

namespace grseg {
namespace {

constexpr std::int64_t page = 4096;

struct Write {
  std::int64_t begin;
  std::string bytes;
  std::size_t committed;  ///< number of frames committed before the write

  std::int64_t end() const { return begin + static_cast<std::int64_t>(bytes.size()); }
  bool crosses_a_page() const { return begin / page != (end() - 1) / page; }
  /// True if HDF5 detects a wrong byte anywhere in it, because it is a header or a part of an index.
  bool is_checked_as_a_whole() const
  {
    constexpr std::string_view marks[] = {"OHDR", "OCHK", "EAHD", "EAIB", "EASB",   "EADB",
                                          "BTHD", "BTIN", "BTLF", "FRHP", "FHDB",   "FHIB",
                                          "FSHD", "FSSE", "SMTB", "SMLI", "\x89HDF"};
    return std::any_of(std::begin(marks), std::end(marks),
                       [&](auto mark) { return bytes.starts_with(mark); });
  }
};

std::vector<Write>* record = nullptr;  ///< list of all writes, if recording
std::size_t committed = 0;

struct LiveRun {
  std::vector<Write> writes;
  std::size_t creation = 0;  ///< number of writes before the file had its name
};

LiveRun live_run(const std::string& path, std::size_t frames)
{
  LiveRun run;
  committed = 0;
  record = &run.writes;
  TrajectoryWriter writer(path, three_grains::description(), {.live = true});
  run.creation = run.writes.size();
  for (; committed < frames; ++committed)
    writer.append(three_grains::frame(static_cast<std::int64_t>(committed)),
                  std::vector<double>{0});
  record = nullptr;
  return run;
}

ssize_t write_at(int file, const void* bytes, std::size_t count, off_t at)
{
  return syscall(SYS_pwrite64, file, bytes, count, at);
}

}  // namespace
}  // namespace grseg

/// Replaces the function of the C library, which HDF5 calls.
extern "C" ssize_t pwrite(int file, const void* bytes, size_t count, off_t at)
{
  using namespace grseg;
  if (record != nullptr)
    record->push_back({at, std::string(static_cast<const char*>(bytes), count), committed});
  return write_at(file, bytes, count, at);
}

namespace grseg {
namespace {

class KilledWriter : public Trajectory {
 protected:
  void TearDown() override
  {
    Trajectory::TearDown();
    fs::remove(left);
  }
  /// Expects all committed frames, and at most the one that was being written in addition.
  void expect_all(std::size_t frames, const std::string& after) const
  {
    const TrajectoryReader reader(left);
    ASSERT_GE(reader.size(), frames) << after;
    ASSERT_LE(reader.size(), frames + 1) << after;
    Frame<2> frame;
    for (std::size_t k = 0; k < reader.size(); ++k) {
      reader.read(k, frame, {.velocity = true, .contacts = true, .force = true});
      expect_same(frame, three_grains::frame(static_cast<std::int64_t>(k)));
    }
  }

  std::string left = path + ".left";
};

TEST_F(KilledWriter, LeavesAllCommittedFramesWhereverItsWritesAreCut)
{
  // From here on, parts of the index no longer fit into 512 bytes.
  constexpr std::size_t judged_from = 116, frames = 124;
  const auto run = live_run(path, frames);
  const int file = open(left.c_str(), O_RDWR | O_CREAT | O_TRUNC, 0600);
  ASSERT_GE(file, 0);
  std::size_t cuts = 0;
  for (const auto& write : run.writes) {
    const bool judged = write.committed >= judged_from;
    for (auto cut = (write.begin / page + 1) * page; judged && cut < write.end(); cut += page) {
      ++cuts;
      write_at(file, write.bytes.data(), static_cast<std::size_t>(cut - write.begin), write.begin);
      expect_all(write.committed, fmt::format("{} bytes at {}", cut - write.begin, write.begin));
    }
    write_at(file, write.bytes.data(), write.bytes.size(), write.begin);
    if (judged) expect_all(write.committed, fmt::format("all bytes at {}", write.begin));
    if (HasFatalFailure()) break;
  }
  close(file);
  EXPECT_GT(cuts, 0u);
}

TEST_F(KilledWriter, WritesNoHeaderAndNoPartOfAnIndexAcrossPages)
{
  const auto run = live_run(path, 3000);
  std::size_t longest = 0;
  for (std::size_t k = run.creation; k < run.writes.size(); ++k) {
    const auto& write = run.writes[k];
    if (!write.is_checked_as_a_whole()) continue;
    longest = std::max(longest, write.bytes.size());
    ASSERT_FALSE(write.crosses_a_page())
        << write.bytes.substr(0, 4) << ", " << write.bytes.size() << " bytes at " << write.begin;
  }
  EXPECT_GT(longest, 1024u);
}

}  // namespace
}  // namespace grseg
