// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "formats/import/common/archive.hpp"

#include <sys/types.h>

#include <cstring>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace grseg {

/// Work in a process of its own on a file that anybody may have made. The HDF5 library crashes, never
/// ends or asks for any memory on some damaged files; here this becomes a sentence.
class Apart {
 public:
  using Send = std::function<void(const std::string& message)>;
  using Work = std::function<void(const Send& send)>;

  /// Begins `work`, which sends messages about `file`. RunError where no process can be had.
  Apart(std::string file, const Work& work);
  Apart(const Apart&) = delete;
  Apart& operator=(const Apart&) = delete;
  /// Ends the process.
  ~Apart();

  /// The next message, which stays until the one behind it is received. ToolError with the sentence
  /// and the exit code of what `work` threw. FormatError naming `place` where the process crashes, or
  /// where the message takes more processor time or memory than the size of the file explains.
  const std::string& receive(const std::string& place);

 private:
  [[noreturn]] void explain_end(const std::string& place);

  std::string file_;
  pid_t process_ = -1;
  int end_ = -1;  // of the pipe
  std::string message_;
};

}  // namespace grseg

/// Values as bytes and back, for another process of the same program. `each_of(value, pass)` calls
/// `pass` with all members of a struct; it stands in the namespace of the struct.
namespace grseg::packing {

template <class T>
constexpr bool is_plain = std::is_trivially_copyable_v<T> || std::is_same_v<T, Vec3>;

class Pack {
 public:
  template <class... T>
  void operator()(T&... values)
  {
    (add(values), ...);
  }
  std::string bytes;

 private:
  void add_bytes(const void* data, std::size_t count)
  {
    bytes.append(static_cast<const char*>(data), count);
  }
  void add_size(std::size_t size) { add_bytes(&size, sizeof size); }
  template <class T>
  void add(std::optional<T>& value)
  {
    add_size(value ? 1 : 0);
    if (value) add(*value);
  }
  void add(std::string& text)
  {
    add_size(text.size());
    add_bytes(text.data(), text.size());
  }
  template <class T>
  void add(std::vector<T>& values)
  {
    add_size(values.size());
    if constexpr (is_plain<T>)
      add_bytes(values.data(), values.size() * sizeof(T));
    else
      for (auto& value : values) add(value);
  }
  template <class T>
  void add(T& value)
  {
    if constexpr (is_plain<T>)
      add_bytes(&value, sizeof(T));
    else
      each_of(value, *this);
  }
};

class Unpack {
 public:
  explicit Unpack(const std::string& bytes) : next_(bytes.data()) {}
  template <class... T>
  void operator()(T&... values)
  {
    (take(values), ...);
  }

 private:
  void take_bytes(void* data, std::size_t count)
  {
    if (count > 0) std::memcpy(data, next_, count);
    next_ += count;
  }
  std::size_t take_size()
  {
    std::size_t size = 0;
    take_bytes(&size, sizeof size);
    return size;
  }
  template <class T>
  void take(std::optional<T>& value)
  {
    value.reset();
    if (take_size() > 0) take(value.emplace());
  }
  void take(std::string& text)
  {
    text.resize(take_size());
    take_bytes(text.data(), text.size());
  }
  template <class T>
  void take(std::vector<T>& values)
  {
    values.resize(take_size());
    if constexpr (is_plain<T>)
      take_bytes(values.data(), values.size() * sizeof(T));
    else
      for (auto& value : values) take(value);
  }
  template <class T>
  void take(T& value)
  {
    if constexpr (is_plain<T>)
      take_bytes(&value, sizeof(T));
    else
      each_of(value, *this);
  }

  const char* next_;
};

}  // namespace grseg::packing

namespace grseg {

/// The archive that `open` opens, of one `file` and of a format without --columns, read in a process
/// of its own (apart.hpp).
std::unique_ptr<Archive> open_apart(const std::string& file,
                                    const std::function<std::unique_ptr<Archive>()>& open);

}  // namespace grseg
