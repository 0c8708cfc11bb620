// A robot in URDF, to be said in other formats, and whether two machines move alike.
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "mechanics/model.hpp"
#include "scalars/evaluation/evaluator.hpp"

namespace gamut {

/// Both move alike: enclosures of their rates meet, and are narrow.
inline void expectSameMotion(const Mechanism& one, const Mechanism& other, const std::vector<double>& x) {
  ASSERT_EQ(one.stateNames(), other.stateNames());
  ASSERT_EQ(one.stateNames().size(), x.size());
  for (const Formulation formulation : {Formulation::articulated, Formulation::sparse}) {
    Evaluator<Interval> a(recordMotion(one, {}, formulation)), b(recordMotion(other, {}, formulation));
    const std::vector<Interval> box(x.begin(), x.end()), da = a(0.0, box), db = b(0.0, box);
    for (std::size_t i = 0; i < x.size(); ++i) {
      EXPECT_FALSE(isDisjoint(da[i], db[i])) << one.stateNames()[i] << ' ' << da[i] << ' ' << db[i];
      EXPECT_LE(width(da[i]), 1e-8 * (1 + magnitude(da[i]))) << one.stateNames()[i];
    }
  }
}

inline constexpr const char* armInUrdf = R"(<robot name="arm">
  <link name="world"/>
  <link name="upper"><inertial><origin xyz="0.1 0 -0.2" rpy="0 0 0.5"/><mass value="2.5"/>
    <inertia ixx="0.04" iyy="0.05" izz="0.03" ixy="0" iyz="0" ixz="0"/></inertial></link>
  <link name="lower"><inertial><origin xyz="0 0.02 -0.25"/><mass value="1.5"/>
    <inertia ixx="0.03" iyy="0.031" izz="0.02" ixy="0.001" iyz="0.0003" ixz="-0.0002"/></inertial></link>
  <link name="slide"><inertial><origin xyz="0 0 0.1"/><mass value="0.5"/>
    <inertia ixx="0.001" iyy="0.001" izz="0.001" ixy="0" iyz="0" ixz="0"/></inertial></link>
  <joint name="shoulder" type="continuous"><parent link="world"/><child link="upper"/>
    <origin xyz="0 0 1" rpy="0.2 -0.3 0.4"/><axis xyz="0 1 0"/><dynamics damping="0.4"/></joint>
  <joint name="elbow" type="continuous"><parent link="upper"/><child link="lower"/>
    <origin xyz="0 0 -0.5" rpy="1.25 0 0"/><axis xyz="0.6 0 0.8"/><dynamics damping="0.1" friction="0.05"/></joint>
  <joint name="ram" type="prismatic"><parent link="lower"/><child link="slide"/><origin xyz="0.1 0 0"/>
    <axis xyz="0 0 1"/><dynamics damping="3"/></joint>
</robot>)";

}  // namespace gamut
