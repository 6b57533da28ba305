// SPDX-License-Identifier: GPL-3.0-or-later
#include "sim/run/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>

namespace grseg {

double seconds_now()
{
  using namespace std::chrono;
  return duration<double>(steady_clock::now().time_since_epoch()).count();
}

Progress::Progress(double from, double end, bool quiet)
    : from_(from), end_(end), shown_(!quiet && isatty(STDERR_FILENO) != 0)
{
}

void Progress::clear() const
{
  show("");
}

void Progress::show(const std::string& text) const
{
  if (shown_) fmt::print(stderr, "\r\033[K{}", text);
}

void Progress::show_time(double time)
{
  const double now = seconds_now();
  if (!shown_ || now - last_ < 0.2) return;
  last_ = now;
  const double left = time > from_ ? (now - begin_) * (end_ - time) / (time - from_) : 0;
  show(fmt::format("t = {:.2f} of {:g} s, {:.0f}:{:02.0f} left", time, end_, std::floor(left / 60),
                   std::floor(std::fmod(left, 60))));
}

}  // namespace grseg
