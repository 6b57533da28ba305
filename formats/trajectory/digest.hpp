// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

/// Digests of what a trajectory holds, all xxh3 (64 bit) of bytes in little endian. They reveal
/// damage; they are no proof against somebody who means to deceive.
namespace grseg {

/// Digest of a frame as it is stored, chained with the digest of the frame before (0 if it is
/// first). The bytes are, in this order: step, time, position, image, velocity, angular_velocity,
/// force, then i, j, force, branch, gap of the contacts. With `float32` the floating-point arrays
/// (not `time`) are rounded to 4 bytes first, as in the file.
template <int D>
std::uint64_t frame_digest(const Frame<D>& frame, std::uint64_t before, bool float32);

/// The parts of a frame that have digests of their own, the columns of /grseg/field_digest: a
/// reader that takes some of them verifies those.
enum class Field {
  place,  // step, time, its rows among the contacts, and the digest of the frame in the chain
  position,
  image,
  velocity,
  angular_velocity,
  force,
  contact_i,
  contact_j,
  contact_force,
  contact_branch,
  contact_gap,
  observables,
};
constexpr std::size_t number_of_fields = 12;
using FieldDigests = std::array<std::uint64_t, number_of_fields>;

/// use(field, array) for the arrays of a frame, in the order of frame_digest.
template <class SomeFrame, class Use>
void for_each_array(SomeFrame&& frame, const Use& use)
{
  auto& contacts = frame.contacts;
  use(Field::position, frame.position);
  use(Field::image, frame.image);
  use(Field::velocity, frame.velocity);
  use(Field::angular_velocity, frame.angular_velocity);
  use(Field::force, frame.force);
  use(Field::contact_i, contacts.i);
  use(Field::contact_j, contacts.j);
  use(Field::contact_force, contacts.force);
  use(Field::contact_branch, contacts.branch);
  use(Field::contact_gap, contacts.gap);
}
inline bool is_of_contacts(Field field)
{
  return Field::contact_i <= field && field <= Field::contact_gap;
}
/// True for arrays of floating-point numbers or vectors, false for whole numbers.
inline bool holds_reals(Field field)
{
  return field != Field::image && field != Field::contact_i && field != Field::contact_j;
}

/// Where a frame stands: Field::place.
struct FramePlace {
  std::int64_t step = 0;
  double time = 0;                   // s
  std::uint64_t begin = 0, end = 0;  // rows of its contacts
  std::uint64_t chain = 0;           // frame_digest
};

/// Digest of a field of frame number `index`: of the number 16 index + field, then the bytes of the
/// field, floating-point numbers as in frame_digest. A field that moved to another frame or dataset
/// has another digest. Not for `place` and `observables`.
template <int D>
std::uint64_t field_digest(Field field, std::uint64_t index, const Frame<D>& frame, bool float32);
/// Digest of Field::place.
std::uint64_t field_digest(std::uint64_t index, const FramePlace& place);
/// Digest of Field::observables: one value per observable, in the alphabetical order of names.
std::uint64_t field_digest(std::uint64_t index, const std::vector<double>& observables);

/// Digest of any bytes, chained with the digest of the bytes before.
std::uint64_t chain_digest(const void* data, std::size_t bytes, std::uint64_t before);

/// Chains the digest of everything that is added to it, sizes in bytes included.
class Digester {
 public:
  void add(std::string_view text) { add(text.data(), text.size()); }
  template <class T>
  void add(const std::vector<T>& values)
  {
    add(values.data(), values.size() * sizeof(T));
  }
  template <class T>
  void add(const T& value) requires std::is_arithmetic_v<T> || std::is_enum_v<T>
  {
    add(&value, sizeof value);
  }
  void add(const void* data, std::size_t bytes)
  {
    const std::uint64_t size = bytes;
    digest_ = chain_digest(&size, sizeof size, digest_);
    digest_ = chain_digest(data, bytes, digest_);
  }
  std::uint64_t digest() const { return digest_; }

 private:
  std::uint64_t digest_ = 0;
};

/// 16 hexadecimal digits.
std::string format_digest(std::uint64_t digest);

}  // namespace grseg
