// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cli/progress.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <utility>

namespace grseg {
namespace {

constexpr double first_on_terminal = 0.3, between_on_terminal = 0.2;  // s
constexpr double first_in_file = 10, between_in_file = 30;            // s

std::string bar(std::size_t done, std::size_t total)
{
  constexpr std::size_t length = 24;
  const std::size_t full = total == 0 ? length : length * done / total;
  return fmt::format("[{:#<{}}{:.<{}}]", "", full, "", length - full);
}

}  // namespace

std::string progress_text(std::size_t done, std::size_t total, const std::string& things,
                          double seconds)
{
  auto text = fmt::format("{} of {} {}", done, total, things);
  if (done == 0 || !(seconds > 0)) return text;
  const double rate = static_cast<double>(done) / seconds;
  const auto left = std::lround(static_cast<double>(total - done) / rate);
  return fmt::format("{}, {:.{}f}/s, {}:{:02} left", text, rate, rate < 10 ? 1 : 0, left / 60,
                     left % 60);
}

ProgressBar::ProgressBar(const char* program, std::string things, std::size_t total, bool quiet)
    : program_(program),
      things_(std::move(things)),
      total_(total),
      where_(standard_error(quiet)),
      next_(where_ == Where::terminal ? first_on_terminal : first_in_file)
{
}

ProgressBar::~ProgressBar()
{
  if (where_ == Where::terminal) fmt::print(stderr, "\r\033[K");
}

ProgressBar::Where ProgressBar::standard_error(bool quiet)
{
  if (quiet) return Where::nowhere;
  if (isatty(STDERR_FILENO) == 1) return Where::terminal;
  struct stat status {};
  const bool is_file = fstat(STDERR_FILENO, &status) == 0 && S_ISREG(status.st_mode);
  return is_file ? Where::file : Where::nowhere;
}

void ProgressBar::show(std::size_t done)
{
  if (where_ == Where::nowhere) return;
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin_;
  if (passed.count() < next_) return;
  const auto text = progress_text(done, total_, things_, passed.count());
  if (where_ == Where::terminal) {
    next_ = passed.count() + between_on_terminal;
    fmt::print(stderr, "\r\033[K{}: {} {}", program_, bar(done, total_), text);
    std::fflush(stderr);
  } else {
    next_ = passed.count() + between_in_file;
    fmt::print(stderr, "{}: {}\n", program_, text);
  }
}

}  // namespace grseg
