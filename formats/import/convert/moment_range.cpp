// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/convert/moment_range.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace grseg {
namespace {

template <class Number>
bool parse(const std::string& text, Number& number)
{
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, number);
  return error == std::errc() && end == last;
}

std::string in_words(const ArchiveMoment& moment)
{
  if (!moment.time) return fmt::format("step {}", *moment.step);
  if (!moment.step) return fmt::format("t = {:g}", *moment.time);
  return fmt::format("t = {:g} (step {})", *moment.time, *moment.step);
}

}  // namespace

MomentBound parse_bound(const std::string& text, const std::string& option)
{
  MomentBound bound;
  if (text.starts_with("step:")) {
    if (parse(text.substr(5), bound.step)) return bound;
  } else if (double time = 0; parse(text, time) && std::isfinite(time)) {
    bound.time = time;
    return bound;
  }
  throw UsageError(
      fmt::format("{} {} is neither a time in the archive's units, as in 12.5, nor a step, as in "
                  "step:100000",
                  option, text));
}

MomentRange::MomentRange(const std::optional<std::string>& begin,
                         const std::optional<std::string>& end)
{
  const auto take = [&](const std::optional<std::string>& text, const char* option) {
    std::optional<MomentBound> bound;
    if (!text) return bound;
    bound = parse_bound(*text, option);
    text_ += fmt::format("{}{} {}", text_.empty() ? "" : " ", option, *text);
    return bound;
  };
  begin_ = take(begin, "--begin");
  end_ = take(end, "--end");
}

/// -1, 0 or 1: the moment comes before the bound, at it, or after it.
int MomentRange::compare(const ArchiveMoment& moment, const MomentBound& bound,
                         const char* option) const
{
  const bool known = bound.time ? moment.time.has_value() : moment.step.has_value();
  if (!known && !(step_ && *step_ > 0))
    throw UsageError(fmt::format(
        "{} is a {}, but the archive has {} only, and the length of a time step is not known: pass "
        "it with --step, or give a {}",
        option, bound.time ? "time" : "step", bound.time ? "steps" : "times",
        bound.time ? "step, as in step:100000" : "time"));
  if (!bound.time) {
    const auto step = moment.step ? *moment.step : std::llround(*moment.time / *step_);
    return step < bound.step ? -1 : step > bound.step ? 1 : 0;
  }
  constexpr double digits = 1e-9;
  const double time = moment.time ? *moment.time : static_cast<double>(*moment.step) * *step_;
  if (std::abs(time - *bound.time) <= digits * std::max(std::abs(time), std::abs(*bound.time)))
    return 0;
  return time < *bound.time ? -1 : 1;
}

MomentRange::Side MomentRange::side(const ArchiveMoment& moment)
{
  last_ = in_words(moment);
  if (count_++ == 0) first_ = last_;
  if (begin_ && compare(moment, *begin_, "--begin") < 0) return Side::before;
  if (end_ && compare(moment, *end_, "--end") >= 0) return Side::after;
  return Side::within;
}

std::string MomentRange::seen() const
{
  return count_ == 1 ? fmt::format("one moment, {}", first_)
                     : fmt::format("{} moments from {} to {}", count_, first_, last_);
}

std::string MomentRange::text() const
{
  return text_;
}

}  // namespace grseg
