// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/common/apart_archive.hpp"

#include "formats/import/common/apart.hpp"
#include "formats/import/common/packing.hpp"

#include <fmt/format.h>

namespace grseg {

// All members: a struct that gets another one does not compile until it is named here, too.
template <class Pass>
void each_of(Question& question, Pass& pass)
{
  auto& [what, option, reason] = question;
  pass(what, option, reason);
}

template <class Pass>
void each_of(ArchiveGrains& grains, Pass& pass)
{
  auto& [id, type, type_names, radius, mass, position, image, velocity, angular_velocity, force,
         fixed, missing, unwrapped] = grains;
  pass(id, type, type_names, radius, mass, position, image, velocity, angular_velocity, force,
       fixed, missing, unwrapped);
}

template <class Pass>
void each_of(ArchiveContacts& contacts, Pass& pass)
{
  auto& [i, j, wall, force, overlap, distance, branch, missing] = contacts;
  pass(i, j, wall, force, overlap, distance, branch, missing);
}

template <class Pass>
void each_of(ArchiveMoment& moment, Pass& pass)
{
  auto& [step, time, low, high, periodic, cell, grains, contacts, place, questions] = moment;
  pass(step, time, low, high, periodic, cell, grains, contacts, place, questions);
}

template <class Pass>
void each_of(ArchiveFacts& facts, Pass& pass)
{
  auto& [step, density, gravity, discs, walls, units, late, lists_all, tolerance, reason] = facts;
  pass(step, density, gravity, discs, walls, units, late, lists_all, tolerance, reason);
}

namespace {

/// What the archive says when it has been opened, and with each moment.
struct News {
  ArchiveFacts facts;
  std::vector<std::string> remarks;
  bool more = true;
  ArchiveMoment moment;
};

template <class Pass>
void each_of(News& news, Pass& pass)
{
  auto& [facts, remarks, more, moment] = news;
  pass(facts, remarks, more, moment);
}

void read_apart(Archive& archive, const Apart::Send& send)
{
  News news;
  packing::Pack pack;
  const auto tell = [&] {
    news.facts = archive.facts();
    news.remarks = archive.remarks();
    pack.bytes.clear();
    pack(news);
    send(pack.bytes);
  };
  tell();
  while (news.more) {
    news.more = archive.next(news.moment);
    tell();
  }
}

class ApartArchive : public Archive {
 public:
  ApartArchive(const std::string& file, const std::function<std::unique_ptr<Archive>()>& open)
      : apart_(file, [&](const Apart::Send& send) { read_apart(*open(), send); }), place_(file)
  {
    hear();
  }
  const ArchiveFacts& facts() const override { return news_.facts; }
  std::vector<std::string> remarks() const override { return news_.remarks; }
  bool next(ArchiveMoment& moment) override
  {
    if (!news_.more) return false;
    hear();
    std::swap(moment, news_.moment);  // memory is kept for the next but one
    if (news_.more) place_ = fmt::format("{} or behind", moment.place);
    return news_.more;
  }

 private:
  void hear()
  {
    packing::Unpack unpack(apart_.receive(place_));
    unpack(news_);
  }

  Apart apart_;
  News news_;
  std::string place_;
};

}  // namespace

std::unique_ptr<Archive> open_apart(const std::string& file,
                                    const std::function<std::unique_ptr<Archive>()>& open)
{
#ifdef GRSEG_FUZZ
  return open();  // a fuzzer must see which code a file reaches
#else
  return std::make_unique<ApartArchive>(file, open);
#endif
}

}  // namespace grseg
