// SPDX-License-Identifier: GPL-3.0-or-later
// Reads damaged copies of a file as the programs do, and reports each result. scripts/fault-trials
// writes the damages, a line per copy, to standard input:
//   none | flip OFFSET BIT | cut LENGTH | zero OFFSET LENGTH
// Usage: read_damaged run|checkpoint|table|archive FILE SCRATCH [words for grseg-import]
// Each line of the answer is the line that was read, a tab, and a word or words for every way to
// read the file:
//   same | other | refused CODE SENTENCE | thrown WORDS
// They are separated by tabs. If opening the file is refused, only that is reported; "crash SIGNAL", "hang"
// or "report" (of a sanitizer) stands for all ways.
#include "formats/cli/table.hpp"
#include "formats/core/errors.hpp"
#include "formats/core/frame.hpp"
#include "formats/import/convert/verified_frames.hpp"
#include "formats/import/facts/import_settings.hpp"
#include "formats/trajectory/layout_check.hpp"
#include "formats/trajectory/reader.hpp"
#include "sim/run/restart.hpp"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <functional>
#include <iostream>
#include <iterator>
#include <sstream>

namespace {

using namespace grseg;
namespace po = boost::program_options;

constexpr unsigned patience = 10;  // s; a longer time counts as a hang
constexpr int sanitizer_exit = 99;

/// All data that were read, as bytes.
class Content {
 public:
  template <class T>
  void add(const std::vector<T>& values)
  {
    bytes_ += fmt::format("{}:", values.size());
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
  }
  void add(const std::vector<std::string>& texts)
  {
    for (const auto& text : texts) add(text);
  }
  void add(const std::string& text) { bytes_ += fmt::format("{}:{}", text.size(), text); }
  void add(double value) { bytes_ += fmt::format("{:a} ", value); }
  void add(const Grains& grains)
  {
    add(grains.id);
    add(grains.species);
    add(grains.radius);
    add(grains.mass);
    add(grains.fixed);
  }
  void add(const Box& box)
  {
    for (const double value : {box.length_x, box.length_y, box.periodic_x ? 1.0 : 0.0, box.length_z,
                               box.periodic_z ? 1.0 : 0.0})
      add(value);
  }
  void add(const Parameters& parameters)
  {
    for (const auto& [name, values] : parameters.numbers) {
      add(name);
      add(values);
    }
    for (const auto& [name, text] : parameters.texts) {
      add(name);
      add(text);
    }
  }
  template <int D>
  void add(const Frame<D>& frame)
  {
    add(static_cast<double>(frame.step));
    add(frame.time);
    add(frame.position);
    add(frame.image);
    add(frame.velocity);
    add(frame.angular_velocity);
    add(frame.force);
    add(frame.contacts.i);
    add(frame.contacts.j);
    add(frame.contacts.force);
    add(frame.contacts.branch);
    add(frame.contacts.gap);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

using Way = std::function<void(const std::string& path, Content& content)>;

Way frames_with(TrajectoryReader::Fields fields, std::size_t stride)
{
  return [=](const std::string& path, Content& content) {
    const TrajectoryReader run(path);
    content.add(run.grains());
    content.add(run.box());
    content.add(run.parameters());
    content.add(run.steps());
    content.add(run.times());
    content.add(fmt::format("{:x}", run.digest()));
    with_dimension(run.dimension(), [&](auto d) {
      Frame<d> frame;
      for (std::size_t n = 0; n < run.size(); n += stride) {
        run.read(n, frame, fields);
        content.add(frame);
      }
    });
  };
}

/// Reads what every program reads first.
void opened(const std::string& path, Content& content)
{
  content.add(TrajectoryReader(path).parameters());
}

void all_of_run(const std::string& path, Content& content)
{
  const TrajectoryReader run(path);
  for (const auto& observable : run.observables()) {
    content.add(observable.name + observable.unit);
    content.add(run.observable(observable.name));
  }
  content.add(run.digests());
  for (const auto& departure : check_layout(run).departures)
    content.add(departure.path + departure.what);
}

template <int D>
void add_checkpoint(const Checkpoint<D>& read, const std::string& path, Content& content)
{
  const auto scene = scene_of(read.scene, path);
  restored_simulation(read, scene, scene, {});
  content.add({read.scene, read.program, read.history});
  content.add(read.grains);
  content.add(read.box);
  content.add(read.deposited_height);
  content.add(read.state.position);
  content.add(read.state.image);
  content.add(read.state.velocity);
  content.add(read.state.rim);
  content.add(read.state.row);
  content.add(static_cast<double>(read.state.steps_done));
  content.add(fmt::format("{} {:x} {} {}", read.trajectory.frames, read.trajectory.digest,
                          read.trajectory.begin, read.trajectory.wall));
}

void checkpoint(const std::string& path, Content& content)
{
  std::visit([&](const auto& read) { add_checkpoint(read, path, content); }, read_checkpoint(path));
}

void table(const std::string& path, Content& content)
{
  content.add(Table::read(path).to_text());
}

void archive(const std::vector<std::string>& words, const std::string& original,
             const std::string& path, Content& content)
{
  ImportSettings settings;
  po::variables_map values;
  po::store(po::command_line_parser(words).options(import_options(settings)).run(), values);
  po::notify(values);
  for (auto* list : {&settings.files.grains, &settings.files.contacts})
    for (auto& file : *list)
      if (file == original) file = path;
  if (settings.files.restart == original) settings.files.restart = path;
  VerifiedFrames frames(ScannedArchive(settings), settings);
  content.add(frames.bed().grains);
  content.add(frames.bed().box);
  for (Frame<3> frame; frames.next(frame);) {
    if (frames.complaint()) throw CheckError(frames.complaint()->sentence);
    content.add(frame);
  }
}

std::vector<Way> ways_to_read(const std::string& kind, const std::string& original,
                              const std::vector<std::string>& words)
{
  if (kind == "checkpoint") return {checkpoint};
  if (kind == "table") return {table};
  if (kind == "archive")
    return {[=](const auto& path, Content& content) { archive(words, original, path, content); }};
  // Ways in which programs read a run: completely (check, export), without forces, one of the two.
  std::vector<Way> ways{opened, all_of_run};
  for (const TrajectoryReader::Fields fields : {TrajectoryReader::Fields{true, true, true},
                                                {true, true, false},
                                                {true, false, false},
                                                {false, true, false}})
    ways.push_back(frames_with(fields, fields.velocity && fields.contacts ? 1 : 2));
  return ways;
}

/// Result of reading `path` in one way; its content is added to `bytes` if it is not refused.
std::string outcome(const Way& way, const std::string& path, std::string& bytes)
{
  try {
    Content content;
    way(path, content);
    bytes = content.bytes();
    return "read";
  } catch (const ToolError& error) {
    return fmt::format("refused {} {}", static_cast<int>(error.code()), error.what());
  } catch (const std::exception& error) {
    return fmt::format("thrown {}", error.what());
  }
}

void damage(std::string& bytes, const std::string& how)
{
  std::istringstream words(how);
  std::string what;
  std::size_t at = 0, more = 0;
  words >> what >> at >> more;
  if (what == "flip") bytes.at(at) = static_cast<char>(bytes.at(at) ^ (1 << more));
  if (what == "cut") bytes.resize(at);
  if (what == "zero") bytes.replace(at, std::min(more, bytes.size() - at), more, '\0');
}

class Trials {
 public:
  Trials(std::vector<Way> ways, const std::string& original, std::string scratch)
      : ways_(std::move(ways)), whole_(ways_.size()), scratch_(std::move(scratch))
  {
    std::ifstream file(original, std::ios::binary);
    bytes_.assign(std::istreambuf_iterator<char>(file), {});
  }

  /// Writes the answers to `damages` from number `next` on as lines to `out`; runs in a process of its own.
  void answer(const std::vector<std::string>& damages, std::size_t next, std::FILE* out)
  {
    for (std::size_t w = 0; w < ways_.size(); ++w) {
      write(bytes_);
      const auto what = outcome(ways_[w], scratch_, whole_[w]);
      if (what != "read") throw RunError("the whole file: " + what);
    }
    for (; next < damages.size(); ++next) {
      auto bytes = bytes_;
      damage(bytes, damages[next]);
      write(bytes);
      alarm(patience);
      std::string line = damages[next];
      for (std::size_t w = 0; w < ways_.size(); ++w) {
        std::string found;
        auto what = outcome(ways_[w], scratch_, found);
        if (what == "read") what = found == whole_[w] ? "same" : "other";
        line += '\t';
        line += what;
        if (w == 0 && what.starts_with("refused")) break;
      }
      alarm(0);
      std::fprintf(out, "%s\n", line.c_str());
      std::fflush(out);
    }
  }

 private:
  void write(const std::string& bytes) const
  {
    std::ofstream(scratch_, std::ios::binary | std::ios::trunc) << bytes;
  }

  std::vector<Way> ways_;
  std::vector<std::string> whole_;  // content that each way reads from the undamaged file
  std::string scratch_, bytes_;
};

std::string end_of(int status)
{
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM) return "hang";
  if (WIFSIGNALED(status)) return fmt::format("crash {}", WTERMSIG(status));
  return WEXITSTATUS(status) == sanitizer_exit ? "report"
                                               : fmt::format("exit {}", WEXITSTATUS(status));
}

}  // namespace

int main(int argc, char** argv)
{
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (words.size() < 3) {
    std::cerr << "read_damaged: run|checkpoint|table|archive FILE SCRATCH [words]\n";
    return 2;
  }
  std::vector<std::string> damages;
  for (std::string line; std::getline(std::cin, line);) damages.push_back(line);
  Trials trials(ways_to_read(words[0], words[1], {words.begin() + 3, words.end()}), words[1],
                words[2]);
  // If a process ends because of a damaged file, another process continues with the next damage.
  for (std::size_t done = 0; done < damages.size();) {
    int ends[2];
    if (pipe(ends) != 0) return 1;
    const auto child = fork();
    if (child == 0) {
      close(ends[0]);
      try {
        trials.answer(damages, done, fdopen(ends[1], "w"));
        _exit(0);
      } catch (const std::exception& error) {
        std::cerr << "read_damaged: " << error.what() << "\n";
        _exit(1);
      }
    }
    close(ends[1]);
    auto* in = fdopen(ends[0], "r");
    for (char* line = nullptr; true; ++done) {
      std::size_t room = 0;
      if (getline(&line, &room, in) < 0) break;
      std::fputs(line, stdout);
      free(line);
      line = nullptr;
    }
    std::fclose(in);
    int status = 0;
    waitpid(child, &status, 0);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 1) return 1;
    if (done < damages.size()) {
      std::printf("%s\t%s\n", damages[done].c_str(), end_of(status).c_str());
      ++done;
    }
  }
  std::remove(words[2].c_str());
  return 0;
}
