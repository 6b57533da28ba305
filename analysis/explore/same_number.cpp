// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/explore/same_number.hpp"

#include "formats/cli/shell_word.hpp"

#include <fmt/format.h>

#include <optional>

namespace grseg {
namespace {

/// Options, each after a space, of what is not as without them.
class Options {
 public:
  template <class T>
  void add(const char* name, const T& value, const T& usual)
  {
    if (value != usual) text_ += fmt::format(" {} {}", name, shell_word(fmt::format("{}", value)));
  }
  void add(const char* name, const std::optional<double>& value)
  {
    if (value) text_ += fmt::format(" {} {}", name, *value);
  }
  void add_flag(const char* name, bool value)
  {
    if (value) text_ += fmt::format(" {}", name);
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

void add_times(Options& options, const WindowSettings& windows)
{
  options.add("--begin", windows.begin);
  options.add("--end", windows.end);
}

std::string stress_options(const FrameOptions& own)
{
  const FrameOptions usual;
  Options options;
  options.add("--layer", own.layer, usual.layer);
  options.add("--window", window_text(own.windows), window_text(usual.windows));
  add_times(options, own.windows);
  options.add("--stride", own.windows.stride, usual.windows.stride);
  for (const auto& group : own.grouping.groups) options.add("--group", group, std::string());
  options.add("--classes", own.grouping.classes, usual.grouping.classes);
  options.add("--edges", own.grouping.edges, usual.grouping.edges);
  options.add_flag("--trust", own.trust.trust);
  return options.text();
}

/// Of a table that was given the rows are chosen when B is found, of one that is made when it is made.
std::string fit_options(const ExploreSettings& own, bool given)
{
  const ExploreSettings usual;
  Options options;
  if (given) add_times(options, own.frames.windows);
  options.add("--heights", own.partition.filters.heights, std::string(inside_the_bed));
  options.add("--component", own.component, usual.component);
  options.add("--base-part", own.base, usual.base);
  options.add("--bootstrap", own.bootstrap, usual.bootstrap);
  options.add("--seed", own.seed, usual.seed);
  return options.text();
}

}  // namespace

nlohmann::ordered_json commands_of(const std::string& run, const Table* given,
                                   const ExploreSettings& settings, std::size_t number)
{
  const auto made = number == 0 ? std::string("sums.tsv") : fmt::format("sums-{}.tsv", number);
  return {{"sums", given == nullptr
                       ? "grseg-stress " + shell_word(run) + stress_options(settings.frames)
                       : std::string()},
          {"file", given == nullptr ? made : shell_word(given->name)},
          {"fit", fit_options(settings, given != nullptr)}};
}

}  // namespace grseg
