// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/trajectory/h5md.hpp"

#include "formats/core/errors.hpp"
#include "formats/core/version.hpp"
#include "formats/trajectory/hdf5.hpp"
#include "formats/trajectory/hdf5_attributes.hpp"

#include <fmt/format.h>

namespace grseg::h5md {

using namespace hdf5;

void write_root(hid_t file)
{
  write_attribute(make_group(file, "/h5md"), "version", std::vector<int>{1, 1});
  write_attribute(make_group(file, "/h5md/author"), "name", std::string("unknown"));
  const auto creator = make_group(file, "/h5md/creator");
  write_attribute(creator, "name", std::string("grseg"));
  write_attribute(creator, "version", version_with_hash());
  const auto units = make_group(file, "/h5md/modules/units");
  write_attribute(units, "version", std::vector<int>{1, 0});
  write_attribute(units, "system", std::string("SI"));
}

void write_box(hid_t file, const std::string& particles, const std::vector<std::string>& boundary)
{
  const auto box = make_group(file, fmt::format("/particles/{}/box", particles));
  write_attribute(box, "dimension", std::vector<int>{static_cast<int>(boundary.size())});
  write_attribute(box, "boundary", boundary);
}

void link_times(hid_t file, const std::string& of, const std::string& element)
{
  for (const std::string name : {"step", "time"})
    if (H5Lcreate_hard(file, fmt::format("{}/{}", of, name).c_str(), file,
                       fmt::format("{}/{}", element, name).c_str(), H5P_DEFAULT, H5P_DEFAULT) < 0)
      throw RunError(fmt::format("cannot create {}/{}: {}", element, name, reason_of_failure()));
}

}  // namespace grseg::h5md
