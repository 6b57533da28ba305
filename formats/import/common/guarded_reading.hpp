// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/errors.hpp"
#include "formats/import/common/archive.hpp"

#include <sys/resource.h>

#include <functional>
#include <memory>
#include <new>
#include <string>

/// Reading of untrusted files. On some damaged files the HDF5 library crashes, never ends or asks
/// for unlimited memory. The program therefore works in a child process, whose parent explains such
/// an end.
namespace grseg {

/// Continues in a child process. The calling process passes signals on and ends as the child does.
/// If the child is killed within read_guarded(), the caller prints "`program`: place: ...; the file
/// is damaged", removes the temporary files of `output` and exits with exit_content. Throws RunError
/// if no process can be started.
void continue_in_child(const std::string& program, const std::string& output);

/// While it exists, a process that continue_in_child() has made may use only the processor time and
/// the additional memory that the size of the file explains. In other processes it does nothing.
class LimitedReading {
 public:
  LimitedReading(const std::string& file, const std::string& place);
  LimitedReading(const LimitedReading&) = delete;
  LimitedReading& operator=(const LimitedReading&) = delete;
  ~LimitedReading();

 private:
  rlimit memory_{};  // limit before
};

/// Throws FormatError: reading asks for more memory than the file can fill.
[[noreturn]] void refuse_as_too_large(const std::string& file);

/// Result of `read`, which reads `place` of the file. Throws FormatError if it needs more memory
/// than a file of this size can fill.
template <class Read>
auto read_guarded(const std::string& file, const std::string& place, const Read& read)
{
  const LimitedReading limits(file, place);
  try {
    return read();
  } catch (const std::bad_alloc&) {
    refuse_as_too_large(file);
  }
}

/// Opens an archive of a single `file` by `open`; opening and each frame are read by
/// read_guarded(). Only for formats without --columns.
std::unique_ptr<Archive> open_guarded(const std::string& file,
                                      const std::function<std::unique_ptr<Archive>()>& open);

}  // namespace grseg
