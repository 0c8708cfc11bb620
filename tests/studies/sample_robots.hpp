// Robots for tests.
#pragma once

#include <string>

namespace gamut {

/// Everything that the reader knows: inertials turned and shifted, oblique axes, a slider, a gripper whose second
/// finger follows the first, damping and friction, limits; links before their parents.
inline constexpr const char* sampleRobot = R"(<?xml version="1.0" encoding="utf-8"?>
<robot name="sample">
  <link name="hand-frame"/>
  <link name="upper">
    <inertial>
      <origin xyz="0.1 -.2 3e-1" rpy="0.3 -0.2 0.5"/>
      <mass value="2.5"/>
      <inertia ixx="0.4" ixy="0.02" ixz="-0.01" iyy="0.5" iyz="0.03" izz="0.3"/>
    </inertial>
    <visual><geometry><mesh filename="package://none/upper.stl"/></geometry></visual>
  </link>
  <link name="ground"><inertial><mass value="10"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <link name="slide">
    <inertial>
      <mass value="+1.25"/>
      <inertia ixx="0.1" ixy="0" ixz="0" iyy="0.2" iyz="0" izz="0.15"/>
    </inertial>
  </link>
  <link name="left"><inertial><origin xyz="0 0.02 0.05"/><mass value="0.2"/><inertia ixx="1e-3" ixy="0" ixz="0" iyy="1e-3" iyz="0" izz="5e-4"/></inertial></link>
  <link name="right"><inertial><origin xyz="0 -0.02 0.05"/><mass value="0.2"/><inertia ixx="1e-3" ixy="0" ixz="0" iyy="1e-3" iyz="0" izz="5e-4"/></inertial></link>
  <joint name="slider" type="prismatic">
    <parent link="upper"/><child link="slide"/>
    <origin xyz="0.2 0 0.4" rpy="0 0.5 0"/>
    <axis xyz="0.6 0 0.8"/>
    <limit lower="-0.5" upper="0.75" effort="50" velocity="1"/>
    <dynamics damping="3"/>
  </joint>
  <joint name="hinge" type="revolute">
    <parent link="ground"/><child link="upper"/>
    <origin xyz="0 0 0.5" rpy="1.5707963267948966 0 0.7"/>
    <axis xyz="0 0 -1"/>
    <limit lower="-2" upper="2" effort="100" velocity="3"/>
    <dynamics damping="0.5" friction="0.25"/>
  </joint>
  <joint name="weld" type="fixed"><parent link="slide"/><child link="hand-frame"/><origin xyz="0 0 0.1" rpy="0 0 -0.25"/></joint>
  <joint name="left-finger" type="continuous"><parent link="hand-frame"/><child link="left"/><axis xyz="1 0 0"/></joint>
  <joint name="right-finger" type="continuous"><parent link="hand-frame"/><child link="right"/><axis xyz="1 0 0"/>
    <mimic joint="left-finger" multiplier="-1.5" offset="0.125"/></joint>
  <transmission name="t"/>
</robot>
)";

/// A trunk of two joints with head, arms and legs: 30 hinges, about axes that change, with turned origins.
inline std::string humanoid() {
  std::string text = "<robot name=\"humanoid\">\n";
  const auto addLink = [&](const std::string& name, int i) {
    const double mass = 1.0 + 0.25 * (i % 5);
    text += "<link name=\"" + name + "\"><inertial><origin xyz=\"0.01 0.02 -0.1\" rpy=\"0 " +
            std::string(i % 3 == 0 ? "0.2" : "0") + " 0\"/><mass value=\"" + std::to_string(mass) +
            "\"/><inertia ixx=\"0.02\" ixy=\"0.001\" ixz=\"0\" iyy=\"0.025\" iyz=\"-0.002\" "
            "izz=\"0.015\"/></inertial></link>\n";
  };
  int count = 0;
  const auto addLimb = [&](const std::string& limb, const std::string& from, int joints, const std::string& start) {
    std::string parent = from;
    for (int i = 0; i < joints; ++i) {
      const std::string child = limb + std::to_string(i);
      addLink(child, ++count);
      const char* axes[] = {"0 0 1", "0 1 0", "1 0 0"};
      text += "<joint name=\"" + child + "_joint\" type=\"revolute\"><parent link=\"" + parent + "\"/><child link=\"" +
              child + "\"/><origin xyz=\"" + (i == 0 ? start : "0.02 0 -0.2") + "\" rpy=\"" +
              (i % 2 == 0 ? "0 0 0" : "1.5707963267948966 0 0") + "\"/><axis xyz=\"" + axes[i % 3] +
              "\"/><limit lower=\"-2\" upper=\"2\" effort=\"100\" velocity=\"5\"/></joint>\n";
      parent = child;
    }
    return parent;
  };
  addLink("pelvis", 0);
  const std::string chest = addLimb("trunk", "pelvis", 2, "0 0 0.2");
  addLimb("head", chest, 2, "0 0 0.4");
  addLimb("left_arm", chest, 7, "0 0.2 0.3");
  addLimb("right_arm", chest, 7, "0 -0.2 0.3");
  addLimb("left_leg", "pelvis", 6, "0 0.1 -0.1");
  addLimb("right_leg", "pelvis", 6, "0 -0.1 -0.1");
  return text + "</robot>\n";
}

}  // namespace gamut
