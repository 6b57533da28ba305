// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/grouping.hpp"
#include "analysis/frames/in_order.hpp"
#include "analysis/frames/layers.hpp"
#include "analysis/frames/map_grid.hpp"
#include "analysis/frames/windows.hpp"
#include "formats/cli/output.hpp"
#include "formats/cli/part.hpp"
#include "formats/cli/progress.hpp"
#include "formats/cli/provenance.hpp"
#include "formats/cli/table.hpp"
#include "formats/cli/tool.hpp"
#include "formats/trajectory/reader.hpp"

#include <algorithm>
#include <cstddef>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

namespace grseg {

/// The options of every tool that sums over the frames of a run by layer and window.
struct FrameOptions {
  TableOptions output;
  std::string layer = "4dS", bins = "layers";
  WindowSettings windows;
  int threads = 1;
  bool json = false, quiet = false;
  TrustOption trust;
  GroupingOptions grouping;
  PartOptions parts;

  enum class Makes { table, page };
  /// Adds --output --overwrite --begin --end --stride --layer --window --threads --trust --json
  /// --quiet --group --classes --edges, and of a table --short --digits.
  void add_to(po::options_description& options, Makes makes = Makes::table);
  /// Adds --bins, for tools that also know annuli and maps.
  void add_bins_to(po::options_description& options);
  /// Adds --part and --join, for tools whose table has rows of one window each.
  void add_parts_to(po::options_description& options) { parts.add_to(options); }

  bool annuli() const { return bins.starts_with("radius"); }
  /// The plane of a map, where --bins names one.
  std::optional<MapPlane> map() const;
  /// x and y of the axis about which bins lie: the one that --bins names, or else the axis of the
  /// run's drum. UsageError where --bins names neither a kind of bins nor an axis.
  std::optional<Vec2> axis(const TrajectoryReader& run) const;
  /// These options with the number of threads in place of 0 and, with --part, the name of the
  /// part's file as output. UsageError where the output cannot be made, or not with these options.
  FrameOptions checked(const po::variables_map& values) const;
};

/// UsageError, "--option why", where one of `options` was given although it has no meaning here.
void refuse_options(const po::variables_map& values, const std::vector<const char*>& options,
                    const char* why);

/// A run cut into layers, or the cells of a map, and windows. All tools use this class, so that
/// their rows join on (t0, t1, y0, y1), and rows of maps on (t0, t1, x0, x1, y0, y1) or their own
/// axes. Results go to a table (table_writer.hpp).
class FrameLoop {
 public:
  /// Opens the one run that the command line names. UsageError where it names none or several.
  FrameLoop(const ToolInfo& info, const po::variables_map& values, const FrameOptions& options);

  const ToolInfo& info() const { return info_; }
  /// As given, but checked (FrameOptions::checked).
  const FrameOptions& options() const { return options_; }
  /// The value of --preset.
  const std::string& preset() const { return preset_; }
  const TrajectoryReader& run() const { return run_; }
  /// 2 or 3: the D of `sum`.
  int dimension() const { return run_.dimension(); }
  /// The grains with the species that are told apart (grouping.hpp), and these.
  const Grains& grains() const { return grouped_.grains; }
  const SpeciesList& species() const { return grouped_.species; }
  /// UsageError with the remedy unless these are two.
  void require_two_species() const;
  /// FormatError unless the run has the forces on its grains; `what` they are needed for, `remedy`.
  void require_forces(const char* what, const char* remedy) const;
  const Layers& layers() const { return layers_; }
  double window_length() const { return windows_.length; }  // s
  /// Windows to sum over: all, or the part that --part names; none with --join, whose rows other
  /// files have.
  std::span<const Window> windows() const;

  /// How often `sum` will be called for each window, for the progress that is shown; once, unless
  /// told.
  void expect_passes(int passes);
  void clear_progress() { progress_.clear(); }

  /// Sums over the frames of a window. Each of `empty`, accumulators without frames, is returned
  /// with all frames added:
  ///
  ///   const auto [areas, stress] =
  ///       loop.sum<D>(window, fields, Composition<D>(...), PartialContactStress<D>(...));
  ///
  /// An accumulator has add(grains, frame) and merge(others), which adds the sums of another one.
  /// Threads sum blocks of frames, and the blocks' sums are merged in order. A block has the same
  /// number of frames whatever the number of threads, so that results are bitwise identical. As
  /// many frames are in memory as there are threads.
  template <int D, class... Sums>
  std::tuple<Sums...> sum(const Window& window, TrajectoryReader::Fields fields,
                          const Sums&... empty);

 private:
  template <int D>
  void read(std::size_t index, Frame<D>& frame, TrajectoryReader::Fields fields);
  /// The cells that hold the grains of all windows, whose frames are read for that.
  template <int D>
  Layers map_of(MapPlane plane, const std::optional<Vec2>& axis);

  ToolInfo info_;
  FrameOptions options_;
  std::string preset_;
  TrajectoryReader run_;
  GroupedGrains grouped_;
  Layers layers_;
  Windows windows_;
  ProgressBar progress_;
  std::size_t frames_done_ = 0;
  std::mutex reading_;  // the HDF5 library knows no threads
};

template <int D, class... Sums>
std::tuple<Sums...> FrameLoop::sum(const Window& window, TrajectoryReader::Fields fields,
                                   const Sums&... empty)
{
  constexpr std::size_t block = 4;
  const auto& frames = window.frames;
  const auto sums_of_block = [&](std::size_t number) {
    std::tuple<Sums...> sums(empty...);
    Frame<D> frame;
    const std::size_t end = std::min(frames.size(), (number + 1) * block);
    for (std::size_t k = number * block; k < end; ++k) {
      read(frames[k], frame, fields);
      std::apply([&](Sums&... each) { (each.add(grouped_.grains, frame), ...); }, sums);
    }
    return sums;
  };
  std::tuple<Sums...> total(empty...);
  std::size_t done = 0;  // of this window
  const auto merge = [&](const std::tuple<Sums...>& sums) {
    std::apply(
        [&](Sums&... all) {
          std::apply([&](const Sums&... each) { (all.merge(each), ...); }, sums);
        },
        total);
    const std::size_t more = std::min(block, frames.size() - done);
    done += more;
    frames_done_ += more;
    progress_.show(static_cast<double>(frames_done_));
  };
  in_order(options_.threads, (frames.size() + block - 1) / block, sums_of_block, merge);
  return total;
}

}  // namespace grseg
