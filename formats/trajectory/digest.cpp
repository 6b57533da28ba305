// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/trajectory/digest.hpp"

#include <fmt/format.h>

#define XXH_STATIC_LINKING_ONLY  // the state on the stack
#include <xxhash.h>
#if __has_include(<xxh_x86dispatch.h>) && !defined(XXH_INLINE_ALL)
#include <xxh_x86dispatch.h>  // the widest vectors that the processor has: twice as fast
#endif

namespace grseg {
namespace {

class Hasher {
 public:
  Hasher(std::uint64_t before, bool float32) : float32_(float32)
  {
    XXH3_64bits_reset(&state_);
    add(&before, sizeof before);
  }
  void add(const void* data, std::size_t bytes)
  {
    if (bytes > 0) XXH3_64bits_update(&state_, data, bytes);
  }
  void add_reals(const double* values, std::size_t count)
  {
    if (!float32_) return add(values, count * sizeof(double));
    rounded_.assign(values, values + count);
    add(rounded_.data(), count * sizeof(float));
  }
  void add_reals(const std::vector<double>& values) { add_reals(values.data(), values.size()); }
  template <int D>
  void add_reals(const std::vector<Vector<D>>& values)
  {
    if (!values.empty()) add_reals(values.front().data(), D * values.size());
  }
  std::uint64_t digest() const { return XXH3_64bits_digest(&state_); }

 private:
  struct Rounded : std::vector<float> {
    void assign(const double* first, const double* last)
    {
      resize(static_cast<std::size_t>(last - first));
      for (auto& value : *this) value = static_cast<float>(*first++);
    }
  };
  XXH3_state_t state_;
  Rounded rounded_;
  bool float32_;
};

/// Those with an array in a frame, in the order of frame_digest.
constexpr Field fields_in_order[] = {
    Field::position,       Field::image,      Field::velocity,  Field::angular_velocity,
    Field::force,          Field::contact_i,  Field::contact_j, Field::contact_force,
    Field::contact_branch, Field::contact_gap};

template <class T>
void add_values(Hasher& hash, const std::vector<T>& values)
{
  hash.add(values.data(), values.size() * sizeof(T));
}

template <int D>
void add_field(Hasher& hash, Field field, const Frame<D>& frame)
{
  const auto& contacts = frame.contacts;
  switch (field) {
    case Field::position:
      return hash.add_reals(frame.position);
    case Field::image:
      return add_values(hash, frame.image);
    case Field::velocity:
      return hash.add_reals(frame.velocity);
    case Field::angular_velocity:
      return hash.add_reals(frame.angular_velocity);
    case Field::force:
      return hash.add_reals(frame.force);
    case Field::contact_i:
      return add_values(hash, contacts.i);
    case Field::contact_j:
      return add_values(hash, contacts.j);
    case Field::contact_force:
      return hash.add_reals(contacts.force);
    case Field::contact_branch:
      return hash.add_reals(contacts.branch);
    case Field::contact_gap:
      return hash.add_reals(contacts.gap);
    case Field::place:
    case Field::observables:
      break;  // not arrays of a frame
  }
}

std::uint64_t seed_of(Field field, std::uint64_t index)
{
  return 16 * index + static_cast<std::uint64_t>(field);
}

}  // namespace

template <int D>
std::uint64_t frame_digest(const Frame<D>& frame, std::uint64_t before, bool float32)
{
  Hasher hash(before, float32);
  hash.add(&frame.step, sizeof frame.step);
  hash.add(&frame.time, sizeof frame.time);
  for (const auto field : fields_in_order) add_field(hash, field, frame);
  return hash.digest();
}

template <int D>
std::uint64_t field_digest(Field field, std::uint64_t index, const Frame<D>& frame, bool float32)
{
  Hasher hash(seed_of(field, index), float32);
  add_field(hash, field, frame);
  return hash.digest();
}

template std::uint64_t frame_digest(const Frame<2>&, std::uint64_t, bool);
template std::uint64_t frame_digest(const Frame<3>&, std::uint64_t, bool);
template std::uint64_t field_digest(Field, std::uint64_t, const Frame<2>&, bool);
template std::uint64_t field_digest(Field, std::uint64_t, const Frame<3>&, bool);

std::uint64_t field_digest(std::uint64_t index, const FramePlace& place)
{
  Hasher hash(seed_of(Field::place, index), false);
  hash.add(&place.step, sizeof place.step);
  hash.add(&place.time, sizeof place.time);
  for (const auto number : {place.begin, place.end, place.chain}) hash.add(&number, sizeof number);
  return hash.digest();
}

std::uint64_t field_digest(std::uint64_t index, const std::vector<double>& observables)
{
  Hasher hash(seed_of(Field::observables, index), false);
  hash.add_reals(observables);
  return hash.digest();
}

std::uint64_t chain_digest(const void* data, std::size_t bytes, std::uint64_t before)
{
  Hasher hash(before, false);
  hash.add(data, bytes);
  return hash.digest();
}

std::string format_digest(std::uint64_t digest)
{
  return fmt::format("{:016x}", digest);
}

}  // namespace grseg
