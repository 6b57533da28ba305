// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/trajectory/digest.hpp"

#include <fmt/format.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

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
  void add_reals(const std::vector<Vec2>& values)
  {
    if (!values.empty()) add_reals(values.front().data(), 2 * values.size());
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

}  // namespace

std::uint64_t frame_digest(const Frame& frame, std::uint64_t before, bool float32)
{
  Hasher hash(before, float32);
  hash.add(&frame.step, sizeof frame.step);
  hash.add(&frame.time, sizeof frame.time);
  hash.add_reals(frame.position);
  hash.add(frame.image.data(), frame.image.size() * sizeof frame.image[0]);
  hash.add_reals(frame.velocity);
  hash.add_reals(frame.angular_velocity);
  hash.add_reals(frame.force);
  const auto& contacts = frame.contacts;
  hash.add(contacts.i.data(), contacts.i.size() * sizeof contacts.i[0]);
  hash.add(contacts.j.data(), contacts.j.size() * sizeof contacts.j[0]);
  hash.add_reals(contacts.force);
  hash.add_reals(contacts.branch);
  hash.add_reals(contacts.gap);
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
