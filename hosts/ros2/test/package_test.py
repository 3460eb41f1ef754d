#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Whether what is installed has what ament, `ros2 launch`, RViz and Foxglove look for.

    package_test.py SOURCE BUILD

The launch file is evaluated where ROS' library `launch` can be imported, and otherwise only compiled.
"""
import importlib.util
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

import yaml

SOURCE, BUILD = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
# What the node names in its source, by direction.
NODE = (SOURCE / "hosts/ros2/src/swarm_node.cpp").read_text()
HEARD = set(re.findall(r'node\.read\("(/\w+(?:/\w+)*)"', NODE))
PUBLISHED = set(re.findall(r'"(/\w+)", "\w+::msg::dds_::', NODE))
# What recordings have, in which the layout must find its pictures, too.
RECORDED = set(re.findall(r'_topic = "(/\w+)"', (SOURCE / "record/include/banyan/record/ros2.hpp").read_text()))
LAYERS = set(re.findall(r'(?:layer = |lines\(|edges\()"(\w+)"', (SOURCE / "record/src/ros2.cpp").read_text()))


def check(condition, text):
    if not condition:
        sys.exit("package_test: " + text)


def check_index(prefix):
    """ament: prefix/share/ament_index/resource_index/packages/NAME; ros2 launch: prefix/share/NAME/launch/FILE."""
    share = prefix / "share"
    name = xml.etree.ElementTree.parse(share / "banyan/package.xml").findtext("name")
    check((share / "ament_index/resource_index/packages" / name).is_file(), "no entry in ament's index")
    hooks = json.loads((SOURCE / "colcon.pkg").read_text())["hooks"]
    check(hooks and all((prefix / hook).is_file() for hook in hooks), "a hook of colcon.pkg is not installed")
    said = subprocess.run(
        ["sh", "-c", '_colcon_prepend_unique_value() { echo "$1=$2"; }; COLCON_CURRENT_PREFIX=/some; . "$0"',
         next(prefix / hook for hook in hooks if hook.endswith(".sh"))], capture_output=True, text=True, check=True)
    check(said.stdout == "AMENT_PREFIX_PATH=/some\n", "the hook says " + said.stdout)


def check_rviz(text):
    settings = yaml.safe_load(text)["Visualization Manager"]
    check(settings["Global Options"]["Fixed Frame"] == "map", "RViz: the fixed frame")
    displays = {display["Class"]: display for display in settings["Displays"]}
    check("rviz_default_plugins/TF" in displays, "RViz: no TF")
    swarm = displays["rviz_default_plugins/MarkerArray"]
    check(swarm["Topic"]["Value"] in PUBLISHED, "RViz: nobody publishes " + swarm["Topic"]["Value"])
    check(set(swarm["Namespaces"]) == LAYERS, f"RViz: layers {set(swarm['Namespaces']) ^ LAYERS}")
    tools = {tool["Class"]: tool.get("Topic", {}).get("Value") for tool in settings["Tools"]}
    asked = {tools["rviz_default_plugins/SetGoal"], tools["rviz_default_plugins/PublishPoint"]}
    check(asked < HEARD, f"RViz: nobody hears {asked - HEARD}")


def check_foxglove(text):
    layout = json.loads(text)
    panels = layout["configById"]
    placed = set(re.findall(r'"(\w+!\w+)"', json.dumps(layout["layout"])))
    check(placed == set(panels), f"Foxglove: panels {placed ^ set(panels)}")
    kinds = {name.split("!")[0]: panel for name, panel in panels.items()}
    scene = kinds["3D"]
    shown = set(scene["topics"]) | {kinds["DiagnosticSummary"]["topicToRender"], kinds["RosOut"]["topicToRender"]}
    check(shown < PUBLISHED, f"Foxglove: nobody publishes {shown - PUBLISHED}")
    check(shown - {"/diagnostics"} < RECORDED, f"Foxglove: recordings lack {shown - RECORDED}")
    check(set(scene["topics"]["/markers"]["namespaces"]) == LAYERS, "Foxglove: layers")
    asked = {scene["publish"]["pointTopic"], scene["publish"]["poseTopic"], kinds["Publish"]["topicName"]}
    check(asked == HEARD, f"Foxglove: {asked ^ HEARD}")
    json.loads(kinds["Publish"]["value"])


def play(words, prefix):
    """Half a second of it, in a domain in which nobody is."""
    subprocess.run([*words, "--set", "mission.time_limit_s=0.5", "--set", "mission.stop_when_complete=true", "--quiet",
                    "--force", "--out", prefix / "out"], check=True,
                   env={**os.environ, "ROS_DOMAIN_ID": "89", "ROS_LOCALHOST_ONLY": "1"})


def check_launch(file, prefix):
    compile(file.read_text(), str(file), "exec")
    try:
        import launch
    except ImportError:
        return "compiled"
    spec = importlib.util.spec_from_file_location("swarm_launch", file)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    context = launch.LaunchContext()
    commands = []
    for entity in module.generate_launch_description().entities:
        for action in [entity] + list(entity.visit(context) or [] if "Process" not in type(entity).__name__ else []):
            if hasattr(action, "cmd"):
                commands.append(["".join(part.perform(context) for part in word) for word in action.cmd])
    rviz, mission = sorted(commands, key=lambda words: words[0] != "rviz2")
    check(pathlib.Path(rviz[2]).is_file(), "launch: RViz has no " + rviz[2])
    check(mission[0] == str(prefix / "bin/banyan") and mission[1] == "run", "launch: " + str(mission))
    check(pathlib.Path(mission[2]).is_file(), "launch: no scenario " + mission[2])
    check("--ros2" in mission, "launch: " + str(mission))
    play(mission, prefix)
    return "evaluated"


check(len(HEARD) == 3 and len(PUBLISHED) >= 5 and len(LAYERS) >= 8 and len(RECORDED) == 4, "the sources look otherwise")
with tempfile.TemporaryDirectory() as folder:
    prefix = pathlib.Path(folder)
    for component in ("program", "ros2"):
        subprocess.run(["cmake", "--install", BUILD, "--prefix", prefix, "--component", component], check=True,
                       stdout=subprocess.DEVNULL)
    own = prefix / "share/banyan"
    check_index(prefix)
    check_rviz((own / "rviz/swarm.rviz").read_text())
    check_foxglove((own / "foxglove/swarm.json").read_text())
    play([prefix / "bin/banyan", "run", own / "scenarios/khepera-three-targets.toml", "--ros2"], prefix)
    print("the launch file is " + check_launch(own / "launch/swarm.launch.py", prefix))
