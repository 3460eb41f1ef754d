#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Whether ros2_messages.idl says what ROS 2 says, by Debian's rosidl and Debian's definitions of messages.

    idl_test.py ros2_messages.idl

Debian has the .msg files of ROS 1 (ros-std-msgs and others) and the translator of ROS 2 (python3-rosidl). Between the
two lie three differences, which REP and design documents of ROS 2 name: a header has no seq, `time` is
builtin_interfaces/Time, and Header is std_msgs/Header wherever it is used. What the translator makes of the definitions
is compared with our file, type by type and member by member.
"""
import pathlib
import re
import sys
import tempfile

from rosidl_adapter.msg import convert_msg_to_idl

SHARE = pathlib.Path("/usr/share")
ORIGINALS = {
    "std_msgs": ["Header", "String"],
    "geometry_msgs": ["Point", "PointStamped", "Quaternion", "Pose", "PoseStamped", "PoseWithCovariance", "Vector3", "Twist",
                      "TwistStamped", "TwistWithCovariance", "Transform", "TransformStamped"],
    "nav_msgs": ["Odometry"],
    "tf2_msgs": ["TFMessage"],
}
# Of ROS 2 alone; from rcl_interfaces and rmw_dds_common.
NEW = {
    "builtin_interfaces": {"Time": "int32 sec\nuint32 nanosec\n"},
    "rmw_dds_common": {
        "Gid": "char[16] data\n",
        "NodeEntitiesInfo": "string<=256 node_namespace\nstring<=256 node_name\n"
                            "Gid[] reader_gid_seq\nGid[] writer_gid_seq\n",
        "ParticipantEntitiesInfo": "Gid gid\nNodeEntitiesInfo[] node_entities_info_seq\n",
    },
}


def as_of_ros2(text):
    text = re.sub(r"(?m)^uint32 seq\b.*\n", "", text)
    text = re.sub(r"(?m)^time ", "builtin_interfaces/Time ", text)
    return re.sub(r"(?m)^Header ", "std_msgs/Header ", text)


def structs(idl):
    """{name of the type: [(type, member)]}"""
    idl = re.sub(r"@verbatim\s*\((?:[^()\"]|\"(?:[^\"\\]|\\.)*\")*\)", "", idl)
    idl = re.sub(r"//.*|#.*|@\w+(\s*\([^)]*\))?", "", idl)
    aliases = {}
    for base, name, size in re.findall(r"typedef\s+([\w:]+)\s+(\w+)(\[\d+\]);", idl):
        aliases[name] = (base, size)
    found, path = {}, []
    for word in re.finditer(r"module\s+(\w+)\s*\{|struct\s+(\w+)\s*\{([^}]*)\}\s*;|\}", idl):
        if word[1]:
            path.append(word[1])
        elif word[2]:
            members = []
            for kind, member, size in re.findall(r"([\w:]+(?:<[^;]*>)?)\s+(\w+)\s*(\[\d+\])?\s*;", word[3]):
                base, extra = aliases.get(kind, (kind, ""))
                members.append((base + (size or extra), member))
            found["::".join(path + [word[2]])] = members
        else:
            path.pop()
    return found


def on_the_wire(found):
    """As ROS 2 names its types for DDS: package::msg::dds_::Name_."""
    def renamed(text):
        return re.sub(r"(\w+)::msg::(\w+)", r"\1::msg::dds_::\2_", text)
    return {renamed(name): [(renamed(kind), member) for kind, member in members] for name, members in found.items()}


def translated():
    found = {}
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        texts = {(package, name): as_of_ros2((SHARE / package / "msg" / (name + ".msg")).read_text())
                 for package, names in ORIGINALS.items() for name in names}
        texts.update({(package, name): text for package, names in NEW.items() for name, text in names.items()})
        for (package, name), text in texts.items():
            source = folder / package / "msg"
            source.mkdir(parents=True, exist_ok=True)
            (source / (name + ".msg")).write_text(text)
            convert_msg_to_idl(folder / package, package, pathlib.Path("msg") / (name + ".msg"), source)
            found.update(structs((source / (name + ".idl")).read_text()))
    return on_the_wire(found)


ours = structs(pathlib.Path(sys.argv[1]).read_text())
humble = {name: members for name, members in ours.items() if name.startswith("humble::")}
ours = {name: members for name, members in ours.items() if name not in humble}
theirs = translated()
faults = [f"{name}:\n  ours   {ours.get(name)}\n  theirs {theirs.get(name)}"
          for name in sorted(ours.keys() | theirs.keys()) if ours.get(name) != theirs.get(name)]
# The same but for the length of an identifier.
for name, members in humble.items():
    of_now = [(re.sub(r"\brmw_dds_common", "humble::rmw_dds_common", kind).replace("[16]", "[24]"), member)
              for kind, member in ours[name.removeprefix("humble::")]]
    if members != of_now:
        faults.append(f"{name}:\n  ours   {members}\n  wanted {of_now}")
print("\n".join(faults) or f"{len(theirs)} types agree with rosidl, {len(humble)} with Humble")
sys.exit(1 if faults or len(theirs) < 15 or len(humble) != 3 else 0)
