// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/core/files.hpp"

#include "formats/core/errors.hpp"
#include "tests/folder.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/syscall.h>

#include <cerrno>
#include <filesystem>

namespace {

int error_of_renameat2 = 0;  // error number that the file system returns; 0: none

}  // namespace

/// Replaces the function of the C library.
extern "C" int renameat2(int from_folder, const char* from, int to_folder, const char* to,
                         unsigned flags) noexcept
{
  if (error_of_renameat2 == 0)
    return static_cast<int>(syscall(SYS_renameat2, from_folder, from, to_folder, to, flags));
  errno = error_of_renameat2;
  return -1;
}

namespace grseg {
namespace {

namespace fs = std::filesystem;

/// Test parameter: error number of the file system for renaming without replacing.
class Publishing : public TestInFolder, public testing::WithParamInterface<int> {
 protected:
  void SetUp() override
  {
    TestInFolder::SetUp();
    error_of_renameat2 = GetParam();
  }
  void TearDown() override
  {
    error_of_renameat2 = 0;
    TestInFolder::TearDown();
  }
};

INSTANTIATE_TEST_SUITE_P(WhateverTheFileSystemKnows, Publishing,
                         testing::Values(0, EINVAL, ENOSYS));

TEST_P(Publishing, GivesAFileItsName)
{
  publish_file(put("t.tsv.tmp", "whole"), path("t.tsv"), false);
  EXPECT_EQ(content("t.tsv"), "whole");
  EXPECT_EQ(names(), std::set<std::string>{"t.tsv"});
}

TEST_P(Publishing, ReplacesNothing)
{
  put("t.tsv", "another's");
  const auto temporary = put("t.tsv.tmp", "whole");
  EXPECT_EQ(complaint_of<RunError>([&] { publish_file(temporary, path("t.tsv"), false); }),
            path("t.tsv") +
                " has appeared since this program began and is not replaced; choose another name");
  EXPECT_EQ(content("t.tsv"), "another's");
  EXPECT_EQ(content("t.tsv.tmp"), "whole");
}

TEST_P(Publishing, ReplacesNoLinkThatLeadsNowhere)
{
  fs::create_symlink("nowhere", path("t.tsv"));
  const auto temporary = put("t.tsv.tmp", "whole");
  EXPECT_THROW(publish_file(temporary, path("t.tsv"), false), RunError);
}

TEST_P(Publishing, ReplacesAFileWhereAsked)
{
  put("t.tsv", "old");
  publish_file(put("t.tsv.tmp", "whole"), path("t.tsv"), true);
  EXPECT_EQ(content("t.tsv"), "whole");
}

TEST_P(Publishing, RenamesFoldersToo)
{
  fs::create_directory(path("new"));
  put("new/a", "a");
  fs::create_directory(path("old"));
  EXPECT_THROW(rename_to_new(path("new"), path("old"), "choose another name"), RunError);
  rename_to_new(path("new"), path("other"), "choose another name");
  EXPECT_EQ(content("other/a"), "a");
}

class OutputCheck : public TestInFolder {
 protected:
  std::string complaint(const std::string& output, bool overwrite = true) const
  {
    return complaint_of<UsageError>([&] { check_output(output, overwrite, {"absent", input}); });
  }
  void SetUp() override
  {
    TestInFolder::SetUp();
    input = put("run.h5", "frames");
  }
  std::string input;
};

TEST_F(OutputCheck, RefusesAnInputAlsoWhereFilesMayBeReplaced)
{
  EXPECT_EQ(complaint(input), input + " is an input and cannot be the output; choose another name");
  EXPECT_EQ(complaint(input, false), complaint(input));
}

TEST_F(OutputCheck, KnowsAnInputUnderAnyName)
{
  fs::create_symlink(input, path("soft"));
  fs::create_hard_link(input, path("hard"));
  for (const auto& name : {path("soft"), path("hard"), (folder / "." / "run.h5").string()})
    EXPECT_EQ(complaint(name), name + " is the input " + input +
                                   " under another name and cannot be the output; choose another "
                                   "name");
}

TEST_F(OutputCheck, RefusesWhatExistsUnlessItMayBeReplaced)
{
  const auto old = put("old.tsv", "old");
  EXPECT_EQ(complaint(old), "no complaint");
  EXPECT_EQ(complaint(old, false), already_exists(old));
  fs::create_symlink("nowhere", path("soft"));
  EXPECT_EQ(complaint(path("soft"), false),
            path("soft") + " is a link to " + path("nowhere") +
                ", which does not exist; choose another name, remove it, or pass --overwrite to "
                "write there");
  EXPECT_EQ(complaint(path("new.tsv"), false), "no complaint");
}

TEST_F(OutputCheck, RefusesFoldersAndDevices)
{
  EXPECT_EQ(complaint(folder.string()), folder.string() + " is a folder; name a file inside it");
  EXPECT_EQ(complaint("/dev/null"), "/dev/null is a device or a pipe; name a file");
}

TEST_F(OutputCheck, NamesAFolderThatIsMissing)
{
  EXPECT_EQ(complaint_of<RunError>([&] { check_output(path("absent/t.tsv"), false, {}); }),
            "cannot create " + path("absent/t.tsv") + ": No such file or directory");
  EXPECT_NO_THROW(check_output("a_file_of_this_name_is_nowhere", false, {}));
}

TEST_F(OutputCheck, KnowsAnInputInsideAFolder)
{
  fs::create_directories(path("view/deep"));
  put("view/deep/run.h5", "frames");
  const auto refused = [&](const std::string& in, const std::string& out) {
    return complaint_of<UsageError>([&] { refuse_input_as_output(path(out), {path(in)}); });
  };
  EXPECT_EQ(refused("view/deep/run.h5", "view"),
            "the input " + path("view/deep/run.h5") + " lies in the folder " + path("view") +
                ", which cannot be the output; choose another name");
  EXPECT_EQ(refused("run.h5", "view"), "no complaint");
}

TEST(Reason, ALimitOnFileSizesIsNamedWithAQuestion)
{
  EXPECT_EQ(reason(EFBIG), "File too large; is there a limit (ulimit -f, quota)?");
  EXPECT_EQ(reason(ENOSPC), "No space left on device");
}

}  // namespace
}  // namespace grseg
