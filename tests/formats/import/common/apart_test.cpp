// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/common/apart.hpp"

#include "formats/core/errors.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <ctime>
#include <vector>

namespace grseg {
namespace {

/// Result of `work` on the file "run.hdf5", which does not exist: the message with its exit code.
std::string outcome(const Apart::Work& work)
{
  try {
    return Apart("run.hdf5", work).receive("run.hdf5, t = 2");
  } catch (const ToolError& error) {
    return std::to_string(error.code()) + " " + error.what();
  }
}

TEST(Apart, MessagesArriveInTheirOrder)
{
  const std::string long_one(1 << 20, 'x');  // longer than the buffer of a pipe
  Apart apart("run.hdf5", [&](const Apart::Send& send) {
    send(long_one);
    send("");
    send("last");
  });
  EXPECT_EQ(apart.receive("run.hdf5"), long_one);
  EXPECT_EQ(apart.receive("run.hdf5"), "");
  EXPECT_EQ(apart.receive("run.hdf5"), "last");
}

TEST(Apart, WhatIsThrownArrivesWithItsExitCode)
{
  EXPECT_EQ(outcome([](const auto&) { throw UsageError("no such file"); }), "2 no such file");
  EXPECT_EQ(outcome([](const auto&) { throw FormatError("row 3"); }), "3 row 3");
  EXPECT_EQ(outcome([](const auto&) { throw RunError("disk"); }), "1 disk");
}

TEST(Apart, ACrashBecomesAMessage)
{
  EXPECT_EQ(outcome([](const auto&) { _exit(7); }),
            "3 run.hdf5, t = 2: reading ends in a crash (exit code 7); the file is "
            "damaged: copy it again");
  const auto said = outcome([](const auto&) {
    std::signal(SIGSEGV, SIG_DFL);
    std::raise(SIGSEGV);
  });
  EXPECT_NE(said.find("3 run.hdf5, t = 2: reading ends in a crash (signal 11)"), std::string::npos)
      << said;
}

TEST(Apart, WorkWithoutAnEndIsStopped)
{
  EXPECT_EQ(outcome([](const auto&) {
              const volatile bool more = true;
              while (more) {
              }
            }),
            "3 run.hdf5, t = 2: reading does not end; the file is damaged: copy it again");
}

TEST(Apart, ALongWorkMayTakeItsTimeForEachMessage)
{
  Apart apart("run.hdf5", [](const Apart::Send& send) {
    for (int k = 0; k < 3; ++k) {
      const auto end = std::clock() + CLOCKS_PER_SEC * 6 / 10;
      while (std::clock() < end) {
      }
      send(std::to_string(k));
    }
  });
  for (int k = 0; k < 3; ++k) EXPECT_EQ(apart.receive("run.hdf5"), std::to_string(k));
}

TEST(Apart, MemoryIsLimited)
{
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "the sanitizer reserves any memory itself";
#endif
  const auto said = outcome([](const Apart::Send& send) {
    const std::vector<char> much(std::size_t{4} << 30);
    send(std::string(much.data(), 1));
  });
  EXPECT_EQ(said.find("3 run.hdf5: reading asks for more memory than a file of this size can "
                      "fill"),
            0u)
      << said;
}

TEST(Apart, TheProcessEndsWithTheOneThatListens)
{
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  {
    Apart apart("run.hdf5", [&](const Apart::Send& send) {
      close(ends[0]);
      send("begun");
      while (true) send(std::string(1 << 20, 'x'));
    });
    EXPECT_EQ(apart.receive("run.hdf5"), "begun");
  }
  close(ends[1]);
  char byte = 0;
  EXPECT_EQ(read(ends[0], &byte, 1), 0);  // no process has the other end open
  close(ends[0]);
}

/// An archive of two frames with data in every array, and a third frame that is refused.
class Invented : public Archive {
 public:
  Invented()
  {
    facts_.step = 0.5;
    facts_.gravity = Vec3(1, 2, 3);
    facts_.walls = {"floor", ""};
    facts_.tolerance_reason = "why";
  }
  const ArchiveFacts& facts() const override { return facts_; }
  std::vector<std::string> remarks() const override { return {"at " + std::to_string(count_)}; }
  bool next(ArchiveFrame& frame) override
  {
    if (++count_ > 2) throw FormatError("no third one");
    frame = {};
    frame.step = count_;
    frame.low = {-1, -2, -3};
    frame.periodic = {true, false, true};
    frame.place = "here";
    frame.grains.id = {7, 9};
    frame.grains.position = {{1, 2, 3}, {4, 5, 6}};
    frame.grains.image = {{1, 0, -1}, {0, 0, 0}};
    frame.grains.missing = {"vz"};
    frame.contacts.force = {{0, -1, 0.25}};
    frame.questions = {{"a step", "--step DT", "none"}};
    return true;
  }

 private:
  ArchiveFacts facts_;
  std::int64_t count_ = 0;
};

TEST(ApartArchive, ArrivesWhole)
{
  const auto archive = open_apart("run.hdf5", [] { return std::make_unique<Invented>(); });
  EXPECT_EQ(archive->facts().step, 0.5);
  EXPECT_EQ(archive->facts().gravity, Vec3(1, 2, 3));
  EXPECT_FALSE(archive->facts().density.has_value());
  EXPECT_EQ(archive->facts().walls, (std::vector<std::string>{"floor", ""}));
  EXPECT_EQ(archive->facts().tolerance_reason, "why");
  ArchiveFrame frame;
  for (const std::int64_t count : {1, 2}) {
    ASSERT_TRUE(archive->next(frame));
    EXPECT_EQ(frame.step, count);
    EXPECT_FALSE(frame.time.has_value());
    EXPECT_EQ(frame.low, Vec3(-1, -2, -3));
    EXPECT_EQ(frame.periodic, (std::array<bool, 3>{true, false, true}));
    EXPECT_EQ(frame.place, "here");
    EXPECT_EQ(frame.grains.id, (std::vector<std::int64_t>{7, 9}));
    EXPECT_EQ(frame.grains.position[1], Vec3(4, 5, 6));
    EXPECT_EQ(frame.grains.image[0][2], -1);
    EXPECT_EQ(frame.grains.missing, std::vector<std::string>{"vz"});
    EXPECT_EQ(frame.contacts.force[0], Vec3(0, -1, 0.25));
    EXPECT_EQ(frame.questions.at(0).option, "--step DT");
    EXPECT_EQ(archive->remarks().at(0), "at " + std::to_string(count));
  }
  EXPECT_THROW(archive->next(frame), FormatError);
}

}  // namespace
}  // namespace grseg
