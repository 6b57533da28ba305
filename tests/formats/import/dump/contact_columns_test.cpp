// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/import/dump/contact_columns.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace grseg {
namespace {

/// Reads one row under the header a b fx fy bx wall.
ArchiveContacts row(const std::string& columns, const std::vector<double>& values)
{
  ContactColumns map(columns);
  map.look_up({"a", "b", "fx", "fy", "bx", "wall"}, "here");
  std::vector<std::vector<double>> wanted;
  for (const auto column : map.wanted()) wanted.push_back({values[column]});
  ArchiveContacts contacts;
  map.fill(wanted, "here", contacts);
  return contacts;
}

constexpr const char* all = "i=a,j=b,fx=fx,fy=fy,bx=bx,wall=wall";

TEST(ContactColumns, ANumberOfAWallMakesItThePartner)
{
  EXPECT_EQ(row(all, {7, 7, 1, 2, 0.005, 1}).wall, (std::vector<std::int32_t>{1}));
  EXPECT_EQ(row(all, {7, 8, 1, 2, 0.005, -1}).wall, (std::vector<std::int32_t>{-1}));
  EXPECT_TRUE(row("i=a,j=b,fx=fx,fy=fy", {7, 8, 1, 2, 0.005, 1}).wall.empty());
  EXPECT_THROW(row(all, {7, 7, 1, 2, 0.005, 0.5}), FormatError);
}

// Positions of grains do not determine the position of the wall.
TEST(ContactColumns, AWallNeedsTheBranchToIt)
{
  EXPECT_THROW(ContactColumns("i=a,j=b,fx=fx,wall=wall"), UsageError);
}

TEST(ContactColumns, AZeroKeepsItsSign)
{
  const auto contacts = row(all, {7, 8, -0.0, 0.0, -0.0, -1});
  EXPECT_TRUE(std::signbit(contacts.force[0].x()));
  EXPECT_FALSE(std::signbit(contacts.force[0].y()));
  EXPECT_TRUE(std::signbit(contacts.branch[0].x()));
}

}  // namespace
}  // namespace grseg
