// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/render/film.hpp"

#include "formats/cli/interruption.hpp"
#include "formats/core/errors.hpp"
#include "formats/core/files.hpp"
#include "formats/core/text.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string_view>
#include <thread>

namespace grseg {
namespace {

/// Linux starts no program with an argument of 128 KiB (MAX_ARG_STRLEN).
constexpr std::size_t longest_comment = 100000;

std::vector<std::string> words_of(const std::string& text)
{
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

std::vector<std::string> arguments(const std::string& path, const FilmFormat& format)
{
  auto all = words_of(fmt::format(
      "-hide_banner -nostdin -loglevel error -y -f rawvideo -pix_fmt bgr0 -s {}x{} -r {} "
      "-i pipe:0 -an -map_metadata -1 -fflags +bitexact -flags:v +bitexact -threads 4 "
      "-vf scale=out_color_matrix=bt709 -pix_fmt yuv420p -colorspace bt709 -color_primaries "
      "bt709 -color_trc bt709",
      format.size.x(), format.size.y(), format.fps));
  const auto coding =
      words_of(format.kind == PictureKind::mp4
                   ? "-c:v libx264 -preset superfast -crf 23 -movflags +faststart -f mp4"
                   : "-c:v libvpx-vp9 -deadline good -cpu-used 4 -crf 30 -b:v 0 -f webm");
  all.insert(all.end(), coding.begin(), coding.end());
  // As words of their own, since they may hold anything; "file:" so that no name is an address.
  all.insert(all.end(), {"-metadata", "comment=" + shortened(format.history, longest_comment),
                         "file:" + path});
  return all;
}

std::string last_line(const std::string& text)
{
  std::istringstream lines(text);
  std::string last = "it says nothing";
  for (std::string line; std::getline(lines, line);)
    if (!line.empty()) last = line;
  return printable(last);
}

}  // namespace

std::string find_ffmpeg()
{
  if (const auto path = find_program("ffmpeg")) return *path;
  throw RunError(
      "ffmpeg, which makes films, is not in PATH: install it (Debian: apt-get install ffmpeg), or "
      "make pictures (-o NAME.png)");
}

std::vector<std::size_t> film_frames(const std::vector<double>& times,
                                     const std::vector<std::size_t>& frames, double every,
                                     double step)
{
  if (every == 0 || frames.empty()) return frames;
  std::vector<std::size_t> shown;
  const double begin = times[frames.front()];
  double next = begin;
  for (const auto index : frames) {
    const double time = times[index] + step / 2;
    if (time < next) continue;
    shown.push_back(index);
    next = begin + every * (std::floor((time - begin) / every) + 1);
  }
  return shown;
}

std::string shortened(const std::string& text, std::size_t most)
{
  constexpr std::string_view left_out = "\n[the middle is left out]\n";
  if (text.size() <= most) return text;
  const auto inside = [&](std::size_t at) {  // a character of UTF-8
    return at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0U) == 0x80U;
  };
  const std::size_t half = (most - left_out.size()) / 2;
  std::size_t end = half, begin = text.size() - half;
  while (end > 0 && inside(end)) --end;
  while (inside(begin)) ++begin;
  return text.substr(0, end).append(left_out).append(text, begin);
}

Film::Film(const std::string& ffmpeg, const std::string& path, const FilmFormat& format)
    : program_(ffmpeg, arguments(path, format))
{
}

void Film::add(std::span<const std::uint8_t> pixels)
{
  if (!program_.write(pixels)) finish();
}

void Film::finish()
{
  const auto [code, said] = program_.finish();
  if (code != 0)
    throw RunError(fmt::format("ffmpeg failed with exit code {}: {}", code, last_line(said)));
}

namespace {

constexpr int patience = 50;  // ms, until an interruption is noticed

/// What posix_spawn is to do between fork and exec.
class SpawnSettings {
 public:
  SpawnSettings(int input, int errors)
  {
    posix_spawn_file_actions_init(&files_);
    posix_spawn_file_actions_adddup2(&files_, input, STDIN_FILENO);
    posix_spawn_file_actions_addopen(&files_, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&files_, errors, STDERR_FILENO);
    posix_spawnattr_init(&attributes_);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF);
    sigset_t defaults;
    sigemptyset(&defaults);
    sigaddset(&defaults, SIGPIPE);
    posix_spawnattr_setsigdefault(&attributes_, &defaults);
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;
  ~SpawnSettings()
  {
    posix_spawn_file_actions_destroy(&files_);
    posix_spawnattr_destroy(&attributes_);
  }

  const posix_spawn_file_actions_t* files() const { return &files_; }
  const posix_spawnattr_t* attributes() const { return &attributes_; }

 private:
  posix_spawn_file_actions_t files_{};
  posix_spawnattr_t attributes_{};
};

}  // namespace

std::optional<std::string> find_program(const std::string& name)
{
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    const auto file = (std::filesystem::path(folder.empty() ? "." : folder) / name).string();
    std::error_code ignored;
    if (std::filesystem::is_regular_file(file, ignored) && access(file.c_str(), X_OK) == 0)
      return file;
  }
  return std::nullopt;
}

PipedProgram::PipedProgram(const std::string& path, const std::vector<std::string>& arguments)
    : errors_(std::tmpfile())
{
  if (!errors_) throw RunError(fmt::format("cannot make a temporary file: {}", reason(errno)));
  fcntl(fileno(errors_.get()), F_SETFD, FD_CLOEXEC);
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0)
    throw RunError(fmt::format("cannot make a pipe: {}", reason(errno)));
  // So that an interruption is noticed while the other end reads nothing.
  fcntl(ends[1], F_SETFL, O_NONBLOCK);
  std::signal(SIGPIPE, SIG_IGN);
  std::vector<std::string> words{path};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (auto& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const SpawnSettings settings(ends[0], fileno(errors_.get()));
  const int error = posix_spawn(&process_, path.c_str(), settings.files(), settings.attributes(),
                                pointers.data(), environ);
  close(ends[0]);
  pipe_ = ends[1];
  if (error == 0) return;
  close(pipe_);
  throw RunError(fmt::format("{}: cannot be started: {}", path, reason(error)));
}

PipedProgram::~PipedProgram()
{
  if (process_ < 0) return;
  kill(process_, SIGKILL);
  if (pipe_ >= 0) close(pipe_);
  ended(true);
}

bool PipedProgram::write(std::span<const std::uint8_t> bytes)
{
  while (!bytes.empty()) {
    const auto taken = ::write(pipe_, bytes.data(), bytes.size());
    if (taken >= 0) {
      bytes = bytes.subspan(static_cast<std::size_t>(taken));
    } else if (errno == EAGAIN) {
      stop_if_interrupted();
      pollfd room{pipe_, POLLOUT, 0};
      poll(&room, 1, patience);
    } else if (errno != EINTR) {
      return false;
    }
  }
  return true;
}

std::optional<int> PipedProgram::ended(bool wait)
{
  int status = 0;
  pid_t process = 0;
  do process = waitpid(process_, &status, wait ? 0 : WNOHANG);
  while (process < 0 && errno == EINTR);
  if (process == 0) return std::nullopt;
  process_ = -1;
  return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

PipedProgram::End PipedProgram::finish()
{
  close(pipe_);
  pipe_ = -1;
  End end{};
  for (auto code = ended(false);; code = ended(false)) {
    if (code) {
      end.code = *code;
      break;
    }
    stop_if_interrupted();
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  std::rewind(errors_.get());
  char buffer[4096];
  for (std::size_t n = 0; (n = std::fread(buffer, 1, sizeof buffer, errors_.get())) > 0;)
    end.said.append(buffer, n);
  return end;
}

}  // namespace grseg
