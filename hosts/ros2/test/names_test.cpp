// SPDX-License-Identifier: MIT
#include "banyan/hosts/ros2/names.hpp"

#include <gtest/gtest.h>

namespace banyan::ros2 {
namespace {

TEST(Ros2Names, OfRobots) {
  EXPECT_EQ(of_robot("/robot_{}/pose", 12), "/robot_12/pose");
  EXPECT_EQ(of_robot("r{}/{}", 3), "r3/3");
  EXPECT_EQ(of_robot("/pose", 3), "/pose");
  EXPECT_EQ(of_robot("/cf_{:02}/pose_{}", 7), "/cf_07/pose_7");
  EXPECT_EQ(of_robot("{:02}", 123), "123");
  for (const char* other : {"{", "{:", "{:0", "{:02", "{:0x}", "{x}", "a{:2}"}) EXPECT_EQ(of_robot(other, 1), other);
}

// The rules of design.ros2.org, "topic and service names".
TEST(Ros2Names, Topics) {
  for (const char* good : {"/pose", "/robot_3/cmd_vel", "/a/b/C9", "/_hidden"})
    EXPECT_EQ(topic_fault(good), "") << good;
  for (const char* bad :
       {"", "pose", "/", "/robot_3/", "//pose", "/3/pose", "/robot-3", "/a b", "/robot_{}/pose", "/a__b", "/~/pose"})
    EXPECT_NE(topic_fault(bad), "") << bad;
  EXPECT_NE(topic_fault("/" + std::string(300, 'a')), "");
  EXPECT_EQ(dds_topic("/robot_3/cmd_vel"), "rt/robot_3/cmd_vel");
}

TEST(Ros2Names, Nodes) {
  EXPECT_EQ(node_fault("banyan_ros2"), "");
  for (const std::string& bad :
       {std::string(), std::string("2banyan"), std::string("banyan/ros2"), std::string("a b"), std::string(256, 'a')})
    EXPECT_NE(node_fault(bad), "") << bad;
}

}  // namespace
}  // namespace banyan::ros2
