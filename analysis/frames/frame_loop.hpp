// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/frames/grouping.hpp"
#include "analysis/frames/in_order.hpp"
#include "analysis/frames/layers.hpp"
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
#include <utility>
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
};

/// A run cut into layers, or the cells of a map, and windows. All tools use this class, so that
/// their rows join on (t0, t1, y0, y1), those of maps on (t0, t1, x0, x1, y0, y1) or what their axes
/// are.
class FrameLoop {
 public:
  /// Opens the one run that the command line names. UsageError where it names none or several.
  FrameLoop(const ToolInfo& info, const po::variables_map& values, const FrameOptions& options);

  const TrajectoryReader& run() const { return run_; }
  /// 2 or 3: the D of `sum`.
  int dimension() const { return run_.dimension(); }
  /// The grains with the species that are told apart (grouping.hpp), and these.
  const Grains& grains() const { return grouped_.grains; }
  const SpeciesList& species() const { return grouped_.species; }
  /// UsageError with the remedy unless these are two.
  void require_two_species() const;
  const Layers& layers() const { return layers_; }
  /// Those to sum over: all, or those of --part; none with --join, whose rows `write` has.
  std::span<const Window> windows() const;
  /// How often `sum` will be called for each window, for the progress that is shown; once, unless told.
  void expect_passes(int passes);

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

  /// A table without rows: header with program, preset, history, content digest of the run, what
  /// of it was verified, the numbers that later tools need ("unknown" where the run does not have its
  /// density, friction or restitution) and `settings` of the tool, which stand for what the run says of
  /// the same; key columns, then `columns`.
  Table make_table(const std::string& command,
                   const std::vector<std::pair<std::string, std::string>>& settings,
                   const std::vector<std::string>& columns) const;
  /// The key columns t0 t1 y0 y1 frames V of a layer, or those of a cell, followed by `values`.
  std::vector<double> row(const Window& window, std::size_t layer,
                          const std::vector<double>& values) const;
  /// The same for the whole bed of a given height: y0 = y1 = nan, V = Lx (Lz) times the height,
  /// nan for a bed whose top lies below y = 0, as in a hopper that runs out.
  std::vector<double> bed_row(const Window& window, double height,
                              const std::vector<double>& values) const;
  /// Adds a row. Where there are many, they are written and removed, so that a table of any size needs
  /// little memory; JSON, files of maps and tables of parts keep theirs.
  void add(Table& table, std::vector<double> row);
  /// To the file of --output, or to standard output. A map may become a file for other programs
  /// (formats/export/map_file.hpp).
  /// `next` is what a reader of that file runs, without its name: "grseg-fit".
  void write(Table table, const std::string& next = "");

 private:
  template <int D>
  void read(std::size_t index, Frame<D>& frame, TrajectoryReader::Fields fields);
  /// UsageError where the sums of one window need more memory than there is.
  void require_memory(std::size_t columns) const;
  /// The table with the rows of all parts.
  Table joined(const Table& table) const;
  /// The cells that hold the grains of all windows, whose frames are read for that.
  template <int D>
  Layers map_of(MapPlane plane);

  ToolInfo info_;
  FrameOptions options_;
  std::string preset_;
  TrajectoryReader run_;
  GroupedGrains grouped_;
  Layers layers_;
  Windows windows_;
  ProgressBar progress_;
  std::size_t frames_done_ = 0;
  std::optional<GrowingTable> growing_;
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
