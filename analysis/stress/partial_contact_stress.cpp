// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/stress/partial_contact_stress.hpp"

#include "analysis/frames/accumulate.hpp"

#include <fmt/format.h>

#include <cassert>
#include <cmath>

namespace grseg {
namespace {

struct TensorColumn {
  const char* name;
  Tensor2 ContactSums::*member;
};

constexpr std::array<TensorColumn, 9> tensor_columns{{{"A_SS", &ContactSums::ss},
                                                      {"A_LL", &ContactSums::ll},
                                                      {"M", &ContactSums::mixed},
                                                      {"Msize", &ContactSums::mixed_size},
                                                      {"Mcp", &ContactSums::mixed_contact},
                                                      {"A_Sb", &ContactSums::base_small},
                                                      {"A_Lb", &ContactSums::base_large},
                                                      {"F_Sb", &ContactSums::whole_small},
                                                      {"F_Lb", &ContactSums::whole_large}}};

struct CentreColumn {
  const char* name;
  Tensor2 ContactSums::AtCentres::*member;
};

constexpr std::array<CentreColumn, 4> centre_columns{
    {{"HSS", &ContactSums::AtCentres::ss},
     {"HLL", &ContactSums::AtCentres::ll},
     {"ML", &ContactSums::AtCentres::mixed_large},
     {"MS", &ContactSums::AtCentres::mixed_small}}};

void append_names(std::vector<std::string>& names, const std::string& tensor)
{
  for (const char* component : {"xx", "xy", "yx", "yy"})
    names.push_back(fmt::format("{}_{}[N m]", tensor, component));
}

void append(std::vector<double>& row, const Tensor2& t)
{
  row.insert(row.end(), {t(0, 0), t(0, 1), t(1, 0), t(1, 1)});
}

}  // namespace

PartialContactStress::PartialContactStress(const Layers& layers, Assignment assignment,
                                           std::optional<double> power,
                                           std::optional<Kernel> kernel)
    : layers_(layers), assignment_(assignment), power_(power), kernel_(kernel)
{
  assert(kernel_ || assignment_ != Assignment::kernel);
}

void PartialContactStress::book(Part part, const Contact& contact, const Stretch& stretch)
{
  const Tensor2 stress = stretch.weight * contact.stress;
  const auto share = [&](std::size_t layer, double of_it) {
    sums_[layer].tensor[part] += of_it * stress;
  };
  switch (assignment_) {
    case Assignment::contact_point:
      return share(contact.layer, 1);
    case Assignment::branch:
      return layers_.share_segment(stretch.from, stretch.to, count_, share);
    case Assignment::kernel:
      return share_kernel(layers_, *kernel_, stretch.from, stretch.to, count_, share);
    case Assignment::grain:
      return share(std::min(layers_.at(stretch.from), count_ - 1), 1);
  }
}

void PartialContactStress::add_equal(Species species, const Contact& contact, double y_i,
                                     double y_j, double share_i)
{
  const bool small = species == Species::small;
  const Part part = small ? A_SS : A_LL, halves = small ? HSS : HLL;
  if (assignment_ != Assignment::grain) return book(part, contact, {y_i, y_j, 1});
  book(part, contact, {y_i, y_j, share_i});
  book(part, contact, {y_j, y_i, 1 - share_i});
  book(halves, contact, {y_i, y_j, 0.5});
  book(halves, contact, {y_j, y_i, 0.5});
}

void PartialContactStress::add_mixed(const Contact& contact, double y_large, double y_small,
                                     double by_size, double by_contact)
{
  const auto along = [&](double share) { return y_large + share * (y_small - y_large); };
  book(Msize, contact, {y_large, along(by_size), by_size});
  book(Mcp, contact, {y_large, along(by_contact), by_contact});
  if (assignment_ != Assignment::grain) return book(M, contact, {y_large, y_small, 1});
  book(M, contact, {y_large, y_small, by_size});
  book(M, contact, {y_small, y_large, 1 - by_size});
  book(ML, contact, {y_large, y_small, 1});
  book(MS, contact, {y_small, y_large, 1});
}

void PartialContactStress::add(const Grains& grains, const Frame& frame)
{
  ++frames_;
  count_ = layers_.count(grains, frame);
  sums_.resize(std::max(sums_.size(), count_));
  const auto& list = frame.contacts;
  for (std::size_t k = 0; k < list.size(); ++k) {
    const Vec2& force = list.force[k];
    if (force.x() == 0 && force.y() == 0) continue;
    const auto type = pair_type(grains, frame, k);
    const auto i = static_cast<std::size_t>(list.i[k]);
    const double share_i = share_of_first(grains, list, k);
    const Vec2 &position = frame.position[i], &branch = list.branch[k];
    const Vec2 touch = position - share_i * branch;
    const double y_i = layers_.height(position), y_j = layers_.height(position - branch);
    const double y_contact = layers_.height(touch);
    const Contact contact{layers_.turned(force, touch) * layers_.turned(branch, touch).transpose(),
                          std::min(layers_.at(y_contact), count_ - 1)};
    sums_[contact.layer].contacts[static_cast<std::size_t>(type)] += 1;

    if (type == PairType::SS || type == PairType::LL) {
      add_equal(grains.species[i], contact, y_i, y_j, share_i);
    } else if (type == PairType::LS) {
      const bool i_large = grains.species[i] == Species::large;
      const double r_i = grains.radius[i], r_j = grains.radius[static_cast<std::size_t>(list.j[k])];
      const double r_large = i_large ? r_i : r_j, r_small = i_large ? r_j : r_i;
      const double y_large = i_large ? y_i : y_j, y_small = i_large ? y_j : y_i;
      add_mixed(contact, y_large, y_small, r_large / (r_large + r_small),
                i_large ? share_i : 1 - share_i);
      if (power_)
        book(Mpower, contact, {y_large, y_small, 1 / (1 + std::pow(r_small / r_large, *power_))});
    } else {
      const bool large = type == PairType::Lb;
      book(large ? A_Lb : A_Sb, contact, {y_i, y_contact, share_i});
      book(large ? F_Lb : F_Sb, contact, {y_i, y_j, 1});
    }
  }
}

PartialContactStress::Sums& PartialContactStress::Sums::operator+=(const Sums& others)
{
  accumulate(contacts, others.contacts);
  accumulate(tensor, others.tensor);
  return *this;
}

void PartialContactStress::merge(const PartialContactStress& others)
{
  frames_ += others.frames_;
  accumulate(sums_, others.sums_);
}

PartialContactStress::Mean PartialContactStress::mean(std::size_t layer) const
{
  const auto& sums = sums_[layer];
  const auto frames = static_cast<double>(frames_);
  Mean mean;
  for (std::size_t type = 0; type < pair_types; ++type)
    mean.contacts[type] = sums.contacts[type] / frames;
  mean.sums.ss = sums.tensor[A_SS] / frames;
  mean.sums.ll = sums.tensor[A_LL] / frames;
  mean.sums.mixed = sums.tensor[M] / frames;
  mean.sums.mixed_size = sums.tensor[Msize] / frames;
  mean.sums.mixed_contact = sums.tensor[Mcp] / frames;
  mean.sums.mixed_power = sums.tensor[Mpower] / frames;
  mean.sums.base_small = sums.tensor[A_Sb] / frames;
  mean.sums.base_large = sums.tensor[A_Lb] / frames;
  mean.sums.whole_small = sums.tensor[F_Sb] / frames;
  mean.sums.whole_large = sums.tensor[F_Lb] / frames;
  mean.sums.booked_at_centres = assignment_ == Assignment::grain;
  mean.sums.at_centres = {.ss = sums.tensor[HSS] / frames,
                          .ll = sums.tensor[HLL] / frames,
                          .mixed_large = sums.tensor[ML] / frames,
                          .mixed_small = sums.tensor[MS] / frames};
  return mean;
}

std::vector<std::string> PartialContactStress::columns() const
{
  std::vector<std::string> names;
  names.reserve(pair_types);
  for (const char* type : pair_type_names) names.push_back(fmt::format("n_{}", type));
  for (const auto& column : tensor_columns) append_names(names, column.name);
  if (assignment_ == Assignment::grain)
    for (const auto& column : centre_columns) append_names(names, column.name);
  if (power_) append_names(names, "Mpower");
  return names;
}

std::vector<double> PartialContactStress::row(std::size_t layer) const
{
  const auto mean_here = mean(layer);
  std::vector<double> row(mean_here.contacts.begin(), mean_here.contacts.end());
  for (const auto& column : tensor_columns) append(row, mean_here.sums.*column.member);
  if (mean_here.sums.booked_at_centres)
    for (const auto& column : centre_columns) append(row, mean_here.sums.at_centres.*column.member);
  if (power_) append(row, mean_here.sums.mixed_power);
  return row;
}

}  // namespace grseg
