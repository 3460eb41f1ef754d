# SPDX-License-Identifier: MIT
"""A swarm in ROS 2, and RViz to look at it.

    ros2 launch banyan swarm.launch.py scenario:=rooms.toml speed:=2
    ros2 launch hosts/ros2/launch/swarm.launch.py      (in a clone, without installing anything)

Every argument is an option of `banyan run` or `banyan fleet`; `options` has room for all others.
"""
import pathlib
import shlex

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, EmitEvent, ExecuteProcess, OpaqueFunction, RegisterEventHandler
from launch.conditions import IfCondition
from launch.event_handlers import OnProcessExit
from launch.events import Shutdown
from launch.substitutions import LaunchConfiguration

FOLDER = pathlib.Path(__file__).absolute().parent.parent  # share/banyan, or hosts/ros2 of a clone
INSTALLED = FOLDER.parent.parent / "bin" / "banyan"
PROGRAM = INSTALLED if INSTALLED.exists() else FOLDER.parent.parent / "banyan"
SCENARIOS = FOLDER / "scenarios" if INSTALLED.exists() else FOLDER.parent.parent / "scenarios"

ARGUMENTS = {
    "command": ("run", "run: everything simulated in one process; fleet: a process per robot, over UDP"),
    "scenario": ("khepera-three-targets.toml", "a file, or the name of one that comes with Banyan"),
    "algorithm": ("", "mission.algorithm; empty: the scenario's"),
    "speed": ("1.0", "how many times faster than real time"),
    "options": ("--set mission.stop_when_complete=false --set mission.time_limit_s=3600 --quiet",
                "further options; these go on for an hour, for targets to be added"),
    "program": (str(PROGRAM), "the program"),
    "rviz": ("true", "whether RViz is opened"),
}


def mission(context):
    value = {name: LaunchConfiguration(name).perform(context) for name in ARGUMENTS}
    scenario = pathlib.Path(value["scenario"])
    if not scenario.exists() and (SCENARIOS / scenario).exists():
        scenario = SCENARIOS / scenario
    words = [value["program"], value["command"], str(scenario), "--ros2", "--speed", value["speed"]]
    if value["algorithm"]:
        words += ["--set", "mission.algorithm=" + value["algorithm"]]
    process = ExecuteProcess(cmd=words + shlex.split(value["options"]), output="screen", name="banyan")
    over = RegisterEventHandler(OnProcessExit(target_action=process, on_exit=[EmitEvent(event=Shutdown())]))
    return [over, process]


def generate_launch_description():
    rviz = ExecuteProcess(
        cmd=["rviz2", "-d", str(FOLDER / "rviz" / "swarm.rviz"), "--ros-args", "-p", "use_sim_time:=true"],
        output="log", condition=IfCondition(LaunchConfiguration("rviz")))
    declared = [DeclareLaunchArgument(name, default_value=default, description=meaning)
                for name, (default, meaning) in ARGUMENTS.items()]
    return LaunchDescription([*declared, rviz, OpaqueFunction(function=mission)])
