// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/cli/progress.hpp"

#include "formats/core/text.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace grseg {
namespace {

// Time until the first output, and time between two outputs, s.
constexpr double first_on_terminal = 0.3, between_on_terminal = 0.2;
constexpr double first_in_file = 10, between_in_file = 30;

std::string bar(double done, double total)
{
  constexpr double length = 24;
  const auto full = static_cast<int>(length * std::clamp(done / total, 0.0, 1.0));
  return fmt::format("[{:#<{}}{:.<{}}] ", "", full, "", static_cast<int>(length) - full);
}

}  // namespace

std::string progress_text(double done, const Work& work, double seconds)
{
  const bool has_total = work.total > 0 && done <= work.total;
  auto text = fmt::format("{:.{}f}", done, work.digits);
  if (has_total) text += fmt::format(" of {:.{}f}", work.total, work.digits);
  text += " " + work.things;
  if (!(done > work.from) || !(seconds > 0)) return text;
  const double rate = (done - work.from) / seconds;
  text += fmt::format(", {:.{}f}/s", rate, rate < 1 ? 2 : rate < 10 ? 1 : 0);
  if (!has_total) return text;
  const auto left = std::lround((work.total - done) / rate);
  return fmt::format("{}, {}:{:02} left", text, left / 60, left % 60);
}

void tell(std::string_view text)
{
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

ProgressBar::ProgressBar(const char* program, Work work, bool quiet)
    : program_(program), where_(standard_error(quiet))
{
  begin(std::move(work));
}

ProgressBar::Where ProgressBar::standard_error(bool quiet)
{
  if (quiet) return Where::nowhere;
  if (isatty(STDERR_FILENO) == 1) return Where::terminal;
  struct stat status {};
  const bool is_file = fstat(STDERR_FILENO, &status) == 0 && S_ISREG(status.st_mode);
  return is_file ? Where::file : Where::nowhere;
}

void ProgressBar::begin(Work work)
{
  work_ = std::move(work);
  begin_ = std::chrono::steady_clock::now();
  next_ = where_ == Where::terminal ? first_on_terminal : first_in_file;
}

void ProgressBar::show(double done)
{
  if (where_ == Where::nowhere) return;
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin_;
  if (passed.count() < next_) return;
  const auto text = progress_text(done, work_, passed.count());
  if (where_ == Where::terminal) {
    next_ = passed.count() + between_on_terminal;
    say((work_.total > 0 && done <= work_.total ? bar(done, work_.total) : "") + text);
  } else {
    next_ = passed.count() + between_in_file;
    tell(fmt::format("{}: {}\n", program_, text));
  }
}

void ProgressBar::say(const std::string& text) const
{
  if (where_ != Where::terminal) return;
  tell(fmt::format("\r\033[K{}: {}", program_, printable(text)));
}

void ProgressBar::clear() const
{
  if (where_ == Where::terminal) tell("\r\033[K");
}

void say_next(const std::string& command, bool quiet)
{
  if (quiet || isatty(STDERR_FILENO) != 1) return;
  fmt::print(stderr, "next: {}\n", printable(command));
}

}  // namespace grseg
