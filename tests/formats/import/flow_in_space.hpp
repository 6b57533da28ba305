// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "formats/core/frame.hpp"
#include "formats/import/facts/import_settings.hpp"
#include "tests/formats/import/lammps_text.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <string>
#include <vector>

/// A few spheres in the axes of grseg, and archives that contain the same spheres in other axes.
namespace grseg::flow_in_space {

/// Axes of grseg expressed in the axes of an archive: the columns are x, y and z. They are written
/// out, so that the tests do not rely on how the program finds them.
struct View {
  const char* axes;  // value of --axes
  Eigen::Matrix3d turn;
};

inline Eigen::Matrix3d columns(const Vec3& x, const Vec3& y, const Vec3& z)
{
  Eigen::Matrix3d turn;
  turn << x, y, z;
  return turn;
}

/// The second half looks from behind: gravity then has a component against the x axis that --axes names.
inline std::vector<View> views()
{
  const Vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  return {{"xy", columns(x, y, z)},  {"xz", columns(x, z, -y)},  {"yz", columns(y, z, x)},
          {"zx", columns(z, x, y)},  {"yx", columns(y, x, -z)},  {"xy", columns(-x, y, -z)},
          {"xz", columns(-x, z, y)}, {"yz", columns(-y, z, -x)}, {"zy", columns(-z, y, x)}};
}

/// A large sphere (row 1) on a base sphere (row 0), which it touches across both periods; a small
/// one (row 2) on it; and a small one (row 3) without contacts. Nothing is symmetric, and every
/// vector has three components.
struct Flow {
  Grains grains;
  Box box;
  Vec3 gravity{4, -9, 0.5};
  Frame<3> frame;

  Flow()
  {
    box.length_x = 7;
    box.length_y = 10;
    box.dimension = 3;
    box.length_z = 5;
    box.periodic_z = true;
    const auto mass = [](double r) { return 4 * lammps_text::pi / 3 * r * r * r; };
    grains = {{3, 5, 8, 11},
              {Species::boundary, Species::large, Species::small, Species::small},
              {1, 1, 0.5, 0.5},
              {mass(1), mass(1), mass(0.5), mass(0.5)},
              {1, 0, 0, 0}};
    const Vec3 base(6.8, -1, 4.2), up(0.36, 0.8, 0.48), on(0.48, 0.6, 0.64);
    const Vec3 large = base + 1.99 * up;
    frame.position = {base, large - Vec3(7, 0, 5), large - Vec3(7, 0, 5) + 1.495 * on, {3, 8, 2}};
    frame.image = {{0, 0, 0}, {2, 0, -1}, {2, 0, -1}, {0, 0, 3}};
    frame.velocity = {{0, 0, 0}, {1.5, -0.25, 0.75}, {2.5, 0.5, -1.25}, {-0.5, 1, 3}};
    frame.angular_velocity = {{0, 0, 0}, {0.5, -1.5, 2.5}, {-3.5, 0.25, 1}, {1, 2, -4}};
    frame.step = 40;
    frame.time = 40 * 1e-3;
    add_contact(1, 0, {21, 60, 25}, 1.99 * up, -0.01);
    add_contact(2, 1, {2, 7, 1.5}, 1.495 * on, -0.005);
    balance();
  }

  void add_contact(std::int32_t i, std::int32_t j, const Vec3& force, const Vec3& branch,
                   double gap)
  {
    frame.contacts.i.push_back(i);
    frame.contacts.j.push_back(j);
    frame.contacts.force.push_back(force);
    frame.contacts.branch.push_back(branch);
    frame.contacts.gap.push_back(gap);
  }
  /// Adds a wall under the small sphere that has no contacts.
  void add_wall()
  {
    add_contact(3, -2, {0.5, 3, -0.75}, {0.1, 0.48, 0.05}, -0.005);
    balance();
  }
  void balance()
  {
    frame.force.assign(grains.size(), Vec3::Zero());
    for (std::size_t g = 1; g < grains.size(); ++g) frame.force[g] = grains.mass[g] * gravity;
    const auto& contacts = frame.contacts;
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      frame.force[static_cast<std::size_t>(contacts.i[c])] += contacts.force[c];
      if (contacts.j[c] > 0)
        frame.force[static_cast<std::size_t>(contacts.j[c])] -= contacts.force[c];
    }
  }
};

/// Cell of an archive, in the archive's axes, and positions in it.
class Cell {
 public:
  Cell(const Flow& flow, const View& view) : view_(view)
  {
    const Vec3 length(flow.box.length_x, 40, flow.box.length_z);
    const std::array<bool, 3> periodic_along{flow.box.periodic_x, false, flow.box.periodic_z};
    for (int d = 0; d < 3; ++d) {
      int axis = 0;
      const double most = view.turn.col(d).cwiseAbs().maxCoeff(&axis);
      low[axis] = -3.25 - axis;
      high[axis] = low[axis] + length[d];
      if (most < 1) continue;  // not along an axis of the archive
      periodic[static_cast<std::size_t>(axis)] = periodic_along[static_cast<std::size_t>(d)];
      const bool forward = view.turn(axis, d) > 0;
      // y = 0, the top of the base, is at half the height of the cell.
      offset_[axis] = d == 1 ? low[axis] + 20 : forward ? low[axis] : high[axis];
    }
  }
  Vec3 place(const Vec3& x) const { return view_.turn * x + offset_; }

  Vec3 low, high;
  std::array<bool, 3> periodic{};

 private:
  View view_;
  Vec3 offset_{0.5, -0.25, 0.75};
};

inline std::string text(const Vec3& v, const char* between = " ")
{
  return fmt::format("{:.17g}{}{:.17g}{}{:.17g}", v.x(), between, v.y(), between, v.z());
}

inline std::string lammps_header(const Flow& flow, const Cell& cell, const char* what,
                                 std::size_t rows)
{
  auto header = fmt::format("ITEM: TIMESTEP\n{}\nITEM: NUMBER OF {}\n{}\nITEM: BOX BOUNDS",
                            flow.frame.step, what, rows);
  for (const bool periodic : cell.periodic) header += periodic ? " pp" : " ff";
  for (int axis = 0; axis < 3; ++axis)
    header += fmt::format("\n{:.17g} {:.17g}", cell.low[axis], cell.high[axis]);
  return header + "\n";
}

inline constexpr const char* lammps_columns =
    "id type mass radius x y z ix iy iz vx vy vz omegax omegay omegaz fx fy fz";

/// Dump of grains; types are 1 base, 2 small, 3 large; grains in reverse order.
inline std::string lammps_grains(const Flow& flow, const View& view)
{
  const Cell cell(flow, view);
  auto text_of_all = lammps_header(flow, cell, "ATOMS", flow.grains.size()) + "ITEM: ATOMS " +
                     lammps_columns + "\n";
  for (std::size_t g = flow.grains.size(); g-- > 0;) {
    const auto& f = flow.frame;
    const Vec3 periods(f.image[g][0], f.image[g][1], f.image[g][2]);
    text_of_all += fmt::format(
        "{} {} {:.17g} {} {} {} {} {} {}\n", flow.grains.id[g],
        static_cast<int>(flow.grains.species[g]) + 2, flow.grains.mass[g], flow.grains.radius[g],
        text(cell.place(f.position[g])), text(view.turn * periods), text(view.turn * f.velocity[g]),
        text(view.turn * f.angular_velocity[g]), text(view.turn * f.force[g]));
  }
  return text_of_all;
}

/// Dump of contacts with normal and tangential parts; in every second row the grains are exchanged.
inline std::string lammps_contacts(const Flow& flow, const View& view)
{
  const auto& contacts = flow.frame.contacts;
  auto rows = lammps_header(flow, Cell(flow, view), "ENTRIES", contacts.size()) +
              "ITEM: ENTRIES index i j dist fx fy fz tx ty tz\n";
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const auto id = [&](std::int32_t row) { return flow.grains.id[static_cast<std::size_t>(row)]; };
    auto i = id(contacts.i[c]), j = id(contacts.j[c]);
    const double side = c % 2 == 0 ? -1 : 1;
    if (side < 0) std::swap(i, j);
    const Vec3 n = contacts.branch[c].normalized(), force = side * contacts.force[c];
    const Vec3 normal = force.dot(n) * n;
    rows += fmt::format("{} {} {} {:.17g} {} {}\n", c + 1, i, j, contacts.branch[c].norm(),
                        text(view.turn * normal), text(view.turn * (force - normal)));
  }
  return rows;
}

inline std::string csv_grains(const Flow& flow, const View& view)
{
  const Cell cell(flow, view);
  std::string rows;
  for (int axis = 0; axis < 3; ++axis)
    if (cell.periodic[static_cast<std::size_t>(axis)])
      rows += fmt::format("# periodic: {} {:.17g} {:.17g}\n", "xyz"[axis], cell.low[axis],
                          cell.high[axis]);
  rows += "time,id,type,radius,mass,fixed,x,y,z,vx,vy,vz,wx,wy,wz,fx,fy,fz\n";
  for (std::size_t g = 0; g < flow.grains.size(); ++g) {
    const auto& f = flow.frame;
    rows += fmt::format("{},{},{},{},{:.17g},{},{},{},{},{}\n", f.time, flow.grains.id[g],
                        static_cast<int>(flow.grains.species[g]) + 2, flow.grains.radius[g],
                        flow.grains.mass[g], flow.grains.fixed[g],
                        text(cell.place(f.position[g]), ","), text(view.turn * f.velocity[g], ","),
                        text(view.turn * f.angular_velocity[g], ","),
                        text(view.turn * f.force[g], ","));
  }
  return rows;
}

inline std::string csv_contacts(const Flow& flow, const View& view)
{
  std::string rows = "time;i;j;overlap;fx;fy;fz;bx;by;bz\n";
  const auto& contacts = flow.frame.contacts;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const auto id = [&](std::int32_t row) {
      return row < 0 ? row : flow.grains.id[static_cast<std::size_t>(row)];
    };
    rows +=
        fmt::format("{};{};{};{:.17g};{};{}\n", flow.frame.time, id(contacts.i[c]),
                    id(contacts.j[c]), -contacts.gap[c], text(view.turn * contacts.force[c], ";"),
                    text(view.turn * contacts.branch[c], ";"));
  }
  return rows;
}

/// Settings of a user who knows the run.
inline ImportSettings settings_of(const lammps_text::Folder& folder, const std::string& format,
                                  const View& view, const Flow& flow, const std::string& grains,
                                  const std::string& contacts)
{
  ImportSettings s;
  s.format = format;
  s.files.grains = {folder.write("grains", grains)};
  s.files.contacts = {folder.write("contacts", contacts)};
  s.units = "si";
  s.step = 1e-3;
  s.gravity = text(view.turn * flow.gravity, ",");
  s.axes = view.axes;
  s.grains = "spheres";
  s.species.boundary = "1";
  s.output = folder / "run.h5";
  s.overwrite = true;
  return s;
}

inline ImportSettings lammps(const lammps_text::Folder& folder, const View& view,
                             const Flow& flow = {})
{
  return settings_of(folder, "lammps", view, flow, lammps_grains(flow, view),
                     lammps_contacts(flow, view));
}

inline ImportSettings csv(const lammps_text::Folder& folder, const View& view,
                          const Flow& flow = {})
{
  return settings_of(folder, "csv", view, flow, csv_grains(flow, view), csv_contacts(flow, view));
}

}  // namespace grseg::flow_in_space
