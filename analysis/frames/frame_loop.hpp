// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/grouping.hpp"
#include "analysis/frames/in_order.hpp"
#include "analysis/frames/layers.hpp"
#include "analysis/frames/map_grid.hpp"
#include "analysis/frames/windows.hpp"
#include "formats/cli/output.hpp"
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

  enum class Makes { table, page };
  /// Adds --output --overwrite --begin --end --stride --layer --window --threads --trust --json
  /// --quiet --group --classes --edges; for a table also --short --digits.
  void add_to(po::options_description& options, Makes makes = Makes::table);
  /// Adds --bins, for tools that also offer maps and, if `about_axis`, annuli and maps rz.
  void add_bins_to(po::options_description& options, bool about_axis = true);

  bool annuli() const { return bins.starts_with("radius"); }
  /// True if grains that have left the bed belong to no bin, since bins have no height of their own
  /// below the base: layers and maps xz.
  bool of_bed() const { return bins == "layers" || bins == "xz"; }
  /// The plane of the map; nothing unless --bins asks for a map.
  std::optional<MapPlane> map() const;
  /// x and y of the axis of annuli or of a map rz, m: the axis in --bins, or else the axis of the
  /// run's drum. Nothing for other bins. Throws UsageError if --bins is not a kind of bins, or has
  /// no valid axis.
  std::optional<Vec2> axis(const TrajectoryReader& run) const;
  /// These options with --threads 0 replaced by the number of processors. Throws UsageError if the
  /// output cannot be written, or not with these options.
  FrameOptions checked(const po::variables_map& values) const;
};

/// Throws UsageError, "--option why", if the user gave one of `options`, which do not apply here.
void refuse_options(const po::variables_map& values, const std::vector<const char*>& options,
                    const char* why);

/// A run, divided into windows and into layers or the cells of a map. All tools use this class, so
/// that their tables can be joined on the columns (t0, t1, y0, y1), and maps on (t0, t1, x0, x1,
/// y0, y1) or the edges along the map's own axes. table_writer.hpp writes the results.
class FrameLoop {
 public:
  /// Opens the run that the command line names. Throws UsageError unless it names exactly one.
  FrameLoop(const ToolInfo& info, const po::variables_map& values, const FrameOptions& options);

  const ToolInfo& info() const { return info_; }
  /// The options after FrameOptions::checked().
  const FrameOptions& options() const { return options_; }
  /// The value of --preset.
  const std::string& preset() const { return preset_; }
  const TrajectoryReader& run() const { return run_; }
  /// Dimension of the run, 2 or 3: the D of `sum`.
  int dimension() const { return run_.dimension(); }
  /// Grains and species after --group, --classes or --edges (grouping.hpp).
  const Grains& grains() const { return grouped_.grains; }
  const SpeciesList& species() const { return grouped_.species; }
  /// Throws UsageError, with a remedy, unless there are two species.
  void require_two_species() const;
  /// Throws FormatError with `what`, the quantity that needs the forces on grains, and `remedy`,
  /// unless the run stores these forces.
  void require_forces(const char* what, const char* remedy) const;
  const Layers& layers() const { return layers_; }
  /// Sentence about the grains that were left out because they lie below the base
  /// (grains_below.hpp); "" if there were none. Maps and annuli contain all grains.
  std::string about_grains_below() const;
  double window_length() const { return windows_.length; }  // length of a window, s
  std::span<const Window> windows() const { return windows_.list; }

  /// Sets how often `sum` will be called for each window (default: once), for the progress bar.
  void expect_passes(int passes);
  void clear_progress() { progress_.clear(); }

  /// Copies of `empty`, accumulators without frames, to which the frames of a window are added:
  ///
  ///   const auto [areas, stress] =
  ///       loop.sum<D>(window, fields, Composition<D>(...), PartialContactStress<D>(...));
  ///
  /// An accumulator has add(grains, frame) and merge(others), which adds another one's sums. Each
  /// thread sums blocks of frames, and the sums of the blocks are merged in the order of time. The
  /// size of a block does not depend on the number of threads, so results are bitwise identical.
  /// The memory contains as many frames as there are threads.
  template <int D, class... Sums>
  std::tuple<Sums...> sum(const Window& window, TrajectoryReader::Fields fields,
                          const Sums&... empty);

 private:
  template <int D>
  void read(std::size_t index, Frame<D>& frame, TrajectoryReader::Fields fields);
  /// Cells that cover the grains in all windows. Reads all frames to find where the grains are.
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
  std::size_t most_below_ = 0;  // largest number of grains below the base in a frame
  std::mutex reading_;  // protects the HDF5 library, which is not thread-safe, and most_below_
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
  std::size_t done = 0;  // frames of this window that are merged
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
