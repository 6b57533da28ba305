// SPDX-License-Identifier: GPL-3.0-or-later
#include "analysis/stress/partial_contact_stress.hpp"

#include "analysis/frames/contacts.hpp"
#include "analysis/frames/sums.hpp"
#include "formats/cli/words.hpp"
#include "formats/core/errors.hpp"
#include "formats/core/species.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <utility>

namespace grseg {

template <int D>
PartialContactStress<D>::PartialContactStress(const Layers& layers, Assignment assignment,
                                              std::optional<double> power,
                                              std::optional<Kernel> kernel, std::size_t species)
    : layers_(layers),
      assignment_(assignment),
      power_(power),
      rules_(summed_rules(power)),
      kernel_(kernel),
      species_(species)
{
  assert(kernel_ || assignment_ != Assignment::kernel);
}

template <int D>
std::vector<typename PartialContactStress<D>::SummedRule> PartialContactStress<D>::summed_rules(
    std::optional<double> power)
{
  std::vector<SummedRule> rules;
  for (const auto& rule : rule_definitions())
    if (rule.sum && (*rule.number == '\0' || power)) rules.push_back({&rule, power.value_or(0)});
  return rules;
}

template <int D>
void PartialContactStress<D>::grow_to(std::size_t layers)
{
  if (layers <= this->layers()) return;
  sums_.resize(layers * sums_of_layer(), Tensor<D>::Zero());
  contacts_.resize(layers * contacts_of_layer());
}

template <int D>
template <class Sum>
void PartialContactStress<D>::add_stretch(Sum sum, std::size_t index, const Contact& contact,
                                          const Stretch& stretch)
{
  const Tensor<D> stress = stretch.weight * contact.stress;
  Tensor<D>* const first = &sums_[place(sum, index)];
  const std::size_t stride = sums_of_layer();
  const auto share = [first, stride, &stress](std::size_t layer, double of_it) {
    first[layer * stride] += of_it * stress;
  };
  switch (assignment_) {
    case Assignment::contact_point:
      return share(contact.layer, 1);
    case Assignment::branch:
      return layers_.share_segment(stretch.from, stretch.to, count_, share);
    case Assignment::kernel:
      return share_kernel(layers_, *kernel_, stretch.from, stretch.to, count_, share);
    case Assignment::grain:
      return share(stretch.layer, 1);
  }
}

template <int D>
typename PartialContactStress<D>::End PartialContactStress<D>::end(const Vector<D>& position) const
{
  const double y = layers_.height<D>(position);
  if (assignment_ != Assignment::grain) return {y, 0};
  return {y, std::min(layers_.holding<D>(position, y), count_ - 1)};
}

template <int D>
void PartialContactStress<D>::add_equal(std::size_t species, const Contact& contact, const End& i,
                                        const End& j, double share_i)
{
  if (assignment_ != Assignment::grain)
    return add_stretch(OwnSum::inside, species, contact, {i.y, j.y, 1, i.layer});
  add_stretch(OwnSum::inside, species, contact, {i.y, j.y, share_i, i.layer});
  add_stretch(OwnSum::inside, species, contact, {j.y, i.y, 1 - share_i, j.layer});
  add_stretch(OwnSum::halves, species, contact, {i.y, j.y, 0.5, i.layer});
  add_stretch(OwnSum::halves, species, contact, {j.y, i.y, 0.5, j.layer});
}

template <int D>
void PartialContactStress<D>::add_mixed(std::size_t pair, const Contact& contact,
                                        const MixedContact& radii, const End& large,
                                        const End& small)
{
  for (const auto& [rule, number] : rules_) {
    const double share = rule->share(radii, number);
    const double end = rule->along_own_stretch ? large.y + share * (small.y - large.y) : small.y;
    add_stretch(*rule->sum, pair, contact, {large.y, end, share, large.layer});
  }
  if (assignment_ != Assignment::grain)
    return add_stretch(PairSum::whole, pair, contact, {large.y, small.y, 1, large.layer});
  const double by_size = radii.r_large / (radii.r_large + radii.r_small);
  add_stretch(PairSum::whole, pair, contact, {large.y, small.y, by_size, large.layer});
  add_stretch(PairSum::whole, pair, contact, {small.y, large.y, 1 - by_size, small.layer});
  add_stretch(PairSum::at_larger, pair, contact, {large.y, small.y, 1, large.layer});
  add_stretch(PairSum::at_smaller, pair, contact, {small.y, large.y, 1, small.layer});
}

template <int D>
void PartialContactStress<D>::add(const Grains& grains, const Frame<D>& frame)
{
  ++frames_;
  count_ = layers_.count(grains, frame);
  grow_to(count_);
  const auto& list = frame.contacts;
  for (std::size_t k = 0; k < list.size(); ++k) {
    if (!bears_force(list, k)) continue;
    const auto [i, j] = partners(grains, frame, k);
    const double share_i = share_of_first(grains, list, k);
    const Vector<D>&position = frame.position[i], &branch = list.branch[k];
    const Vector<D> touch = position - share_i * branch;
    const End end_i = end(position), end_j = end(position - branch);
    const double y_contact = layers_.height<D>(touch);
    const Contact contact{
        layers_.turned<D>(list.force[k], touch) * layers_.turned<D>(branch, touch).transpose(),
        std::min(layers_.holding<D>(touch, y_contact), count_ - 1)};
    double* const contacts = &contacts_[contact.layer * contacts_of_layer()];
    const auto a = static_cast<std::size_t>(grains.species[i]);

    if (!j) {
      contacts[base_contact_index(a, species_)] += 1;
      add_stretch(OwnSum::base, a, contact, {end_i.y, y_contact, share_i, end_i.layer});
      add_stretch(OwnSum::whole_base, a, contact, {end_i.y, end_j.y, 1, end_i.layer});
      continue;
    }
    const auto b = static_cast<std::size_t>(grains.species[*j]);
    contacts[contact_index(std::min(a, b), std::max(a, b))] += 1;
    if (a == b)
      add_equal(a, contact, end_i, end_j, share_i);
    else
      add_mixed(pair_index(std::min(a, b), std::max(a, b)), contact,
                mixed_contact(grains, i, *j, share_i), a > b ? end_i : end_j,
                a > b ? end_j : end_i);
  }
}

template <int D>
void PartialContactStress<D>::merge(const PartialContactStress& others)
{
  frames_ += others.frames_;
  grow_to(others.layers());
  accumulate(sums_, others.sums_);
  accumulate(contacts_, others.contacts_);
}

template <int D>
typename PartialContactStress<D>::Mean PartialContactStress<D>::mean(std::size_t layer) const
{
  const auto frames = static_cast<double>(frames_);
  Mean mean{std::vector<double>(contacts_of_layer()), ContactSums<D>(species_)};
  for (std::size_t k = 0; k < mean.contacts.size(); ++k)
    mean.contacts[k] = contacts_[layer * contacts_of_layer() + k] / frames;
  const Tensor<D>* const own = &sums_[layer * sums_of_layer()];
  for (std::size_t k = 0; k < species_; ++k)
    for (std::size_t sum = 0; sum < own_sums; ++sum)
      mean.sums.of(static_cast<OwnSum>(sum), k) = own[place(static_cast<OwnSum>(sum), k)] / frames;
  for (std::size_t k = 0; k < number_of_pairs(species_); ++k)
    for (std::size_t sum = 0; sum < pair_sums; ++sum)
      mean.sums.of(static_cast<PairSum>(sum), k) =
          own[place(static_cast<PairSum>(sum), k)] / frames;
  mean.sums.at_centres = assignment_ == Assignment::grain;
  return mean;
}

template <int D>
TableKind PartialContactStress<D>::table_kind() const
{
  return {
      .dimension = D, .at_centres = assignment_ == Assignment::grain, .power = power_.has_value()};
}

template <int D>
std::vector<std::string> PartialContactStress<D>::columns(const SpeciesList& species) const
{
  auto names = contact_number_columns(species);
  return add_all(names, sum_column_names(species, table_kind()));
}

template <int D>
std::vector<double> PartialContactStress<D>::row(std::size_t layer) const
{
  auto [row, sums] = mean(layer);
  return add_all(row, sum_cells(sums, table_kind()));
}

template class PartialContactStress<2>;
template class PartialContactStress<3>;

namespace {

constexpr Choice<Assignment> assignments[] = {
    {"contact-point", Assignment::contact_point},
    {"branch", Assignment::branch, "in proportion to its length in each layer"},
    {"grain", Assignment::grain, "each grain's part in the layer of its centre"},
    {"gauss", Assignment::kernel, "spread along the branch by a Gaussian"},
};

}  // namespace

void ContactAssignmentOptions::add_to(po::options_description& options)
{
  const auto where = "layer to which a contact's stress is added: " + list_of(assignments);
  options.add_options()("assign", word_option(&assign, words_of(assignments)), where.c_str());
  options.add_options()("kernel-width",
                        po::value(&width)->default_value(width)->value_name("LENGTH"),
                        "standard deviation of gauss");
  options.add_options()(
      "composition", word_option(&composition, words_of(grain_areas)),
      "layers to which a grain's area is added: clipped: its part in each layer (default); centre: "
      "all in the layer of its centre (always in maps, and for spheres in annuli); kernel: spread "
      "by the kernel (default with a kernel)");
}

ContactAssignment ContactAssignmentOptions::contact_assignment(const po::variables_map& values,
                                                               const std::string& otherwise)
{
  ContactAssignment chosen{choose(assign, "--assign", assignments), {}};
  const bool by_kernel = chosen.assignment == Assignment::kernel;
  if (composition.empty()) composition = by_kernel ? "kernel" : otherwise;
  chosen.area = choose(composition, "--composition", grain_areas);
  for (const auto& [given, option] :
       {std::pair{chosen.area == GrainArea::kernel, "--composition kernel"},
        {!values["kernel-width"].defaulted(), "--kernel-width"}})
    if (given && !by_kernel)
      throw UsageError(fmt::format("{} needs a kernel: --assign gauss", option));
  return chosen;
}

void ContactAssignmentOptions::require_bins(const ContactAssignment& chosen,
                                            const FrameOptions& frames) const
{
  const bool whole =
      chosen.assignment == Assignment::contact_point || chosen.assignment == Assignment::grain;
  const bool map = frames.map().has_value();
  if ((frames.annuli() || map) && !whole)
    throw UsageError(
        fmt::format("--assign {} spreads contacts over layers, not over {}; with --bins {} use "
                    "contact-point or grain",
                    assign, map ? "the cells of a map" : "annuli", frames.bins));
  if (map && chosen.area != GrainArea::centre)
    throw UsageError(fmt::format(
        "--composition {}: in a map, a grain belongs to the cell of its centre; use centre",
        composition));
}

std::optional<Kernel> ContactAssignmentOptions::kernel(const ContactAssignment& chosen,
                                                       const LengthUnits& units) const
{
  if (chosen.assignment != Assignment::kernel) return {};
  return Kernel(parse_length(width, "--kernel-width", units));
}

}  // namespace grseg
