// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "analysis/layers.hpp"
#include "analysis/windows.hpp"
#include "formats/table.hpp"
#include "formats/tool.hpp"
#include "formats/trajectory_reader.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace grseg {

/// The options of every tool that goes through the frames of a run by layer and window.
struct FrameOptions {
  std::string output, layer = "4dS";
  WindowSettings windows;
  bool quiet = false;

  /// Adds --output --begin --end --stride --layer --window --quiet.
  void add_to(po::options_description& options);
};

/// Which of `words` was given. UsageError, naming them all, where none.
std::size_t choose(const std::string& word, const char* option,
                   const std::vector<std::string>& words);

/// A run cut into layers and windows. All tools get theirs here, so that their rows join on
/// (t0, t1, y0, y1).
class FrameLoop {
 public:
  /// Opens the one run that the command line names. UsageError where it names none or several.
  FrameLoop(const ToolInfo& info, const po::variables_map& values, const FrameOptions& options);
  ~FrameLoop();

  const TrajectoryReader& run() const { return run_; }
  const Layers& layers() const { return layers_; }
  const std::vector<Window>& windows() const { return windows_; }

  /// Calls use(grains, frame) for every frame of a window.
  template <class Use>
  void for_each_frame(const Window& window, TrajectoryReader::Fields fields, const Use& use)
  {
    for (const std::size_t k : window.frames) {
      run_.read(k, frame_, fields);
      use(run_.grains(), frame_);
    }
    report_progress(window);
  }

  /// A table without rows: header with program, history, content digest of the run, the numbers
  /// that later tools need and `settings` of the tool; key columns, then `columns`.
  Table make_table(const std::string& command,
                   const std::vector<std::pair<std::string, std::string>>& settings,
                   const std::vector<std::string>& columns) const;
  /// The key columns t0 t1 y0 y1 frames V of a layer, followed by `values`.
  std::vector<double> row(const Window& window, std::size_t layer,
                          const std::vector<double>& values) const;
  /// The same for the whole bed of a given height: y0 = y1 = nan, V = Lx times the height.
  std::vector<double> bed_row(const Window& window, double height,
                              const std::vector<double>& values) const;
  /// To the file of --output, or to standard output.
  void write(const Table& table) const;

 private:
  void report_progress(const Window& window);

  ToolInfo info_;
  FrameOptions options_;
  TrajectoryReader run_;
  Layers layers_;
  std::vector<Window> windows_;
  bool progress_;
  Frame frame_;
};

}  // namespace grseg
