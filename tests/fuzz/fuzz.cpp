// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/fuzz/fuzz.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

namespace grseg::fuzz {

void require(bool holds, const char* promise)
{
  if (holds) return;
  std::fprintf(stderr, "broken promise: %s\n", promise);
  std::abort();
}

std::vector<std::string_view> parts_of(std::string_view text)
{
  constexpr std::string_view border = "=====\n";
  std::vector<std::string_view> parts;
  while (true) {
    const auto end = text.find(border);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + border.size());
  }
}

ScratchFile::ScratchFile(const std::string& name)
    : folder_("/dev/shm/grseg-fuzz." + std::to_string(getpid())), path_(folder_ + "/" + name)
{
  mkdir(folder_.c_str(), 0700);
  file_ = open(path_.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  require(file_ >= 0, "/dev/shm can be written");
}

ScratchFile::~ScratchFile()
{
  close(file_);
  unlink(path_.c_str());
  rmdir(folder_.c_str());  // succeeds when the last file is gone
}

void ScratchFile::write(std::string_view bytes)
{
  const auto size = static_cast<ssize_t>(bytes.size());
  require(ftruncate(file_, size) == 0 && pwrite(file_, bytes.data(), bytes.size(), 0) == size,
          "/dev/shm can be written");
}

}  // namespace grseg::fuzz
