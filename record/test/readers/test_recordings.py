# SPDX-License-Identifier: MIT
"""Recordings and bags read by the libraries of others: MCAP's own, indexed and streamed and with all CRCs, the decoders
of ROS 2's messages by Foxglove and by Ternaris, and a validator of JSON Schema. SAMPLES has what sample_files.cpp
writes."""

import csv
import io
import itertools
import json
import math
import os
import pathlib

import jsonschema
import pytest
from mcap.exceptions import EndOfFile, McapError
from mcap.reader import NonSeekingReader, make_reader
from mcap.records import Channel, DataEnd, Footer, Header, Message, Schema
from mcap.stream_reader import StreamReader
from mcap_ros2.decoder import DecoderFactory
from rosbags.highlevel import AnyReader
from rosbags.rosbag2 import Reader
from rosbags.rosbag2.errors import ReaderError
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

SAMPLES = pathlib.Path(os.environ["SAMPLES"])
RECORDINGS = ["sample.mcap", "world.mcap", "plain.mcap", "empty.mcap"]
BAGS = [f"{name}-bag.mcap" for name in ["sample", "world", "cut", "killed", "early", "empty"]]
TYPES = {"/markers": "visualization_msgs/msg/MarkerArray", "/tf": "tf2_msgs/msg/TFMessage",
         "/rosout": "rcl_interfaces/msg/Log"}
JSON = ["/banyan/frame", "/banyan/setting", "/banyan/targets", "/banyan/metrics", "/banyan/events"]
DELETE_ALL, CYLINDER, LINE_LIST, SPHERE_LIST, TEXT = 3, 3, 5, 7, 9
PICTURE = 0.07 / 64  # m: a body's radius has at least 64 steps


def bytes_of(name):
    return (SAMPLES / name).read_bytes()


def indexed(name):
    return make_reader(io.BytesIO(bytes_of(name)), validate_crcs=True, decoder_factories=[DecoderFactory()])


def streamed(data):
    """Every record in the order of the file, up to where it is cut off."""
    records = []
    try:
        for record in StreamReader(io.BytesIO(data), validate_crcs=True).records:
            records.append(record)
    except EndOfFile:
        pass
    return records


def messages(name, *topics):
    """[(log time, decoded message)]"""
    chosen = indexed(name).iter_messages(topics=topics or None)
    factory, found = DecoderFactory(), []
    for schema, channel, message in chosen:
        if channel.message_encoding == "json":
            found.append((message.log_time, json.loads(message.data)))
        else:
            found.append((message.log_time, factory.decoder_for("cdr", schema)(message.data)))
    return found


def nanoseconds(stamp):
    return stamp.sec * 10**9 + stamp.nanosec


def is_near(a, b, tolerance=1e-4):
    return math.isclose(a, b, rel_tol=1e-6, abs_tol=tolerance)


@pytest.mark.parametrize("name", RECORDINGS + BAGS)
def test_the_file_is_whole(name):
    records = streamed(bytes_of(name))
    assert isinstance(records[0], Header) and isinstance(records[-1], Footer)
    assert records[-1].summary_crc != 0
    assert next(r for r in records if isinstance(r, DataEnd)).data_section_crc != 0


@pytest.mark.parametrize("name", RECORDINGS + BAGS)
def test_the_index_finds_what_is_there(name):
    summary = indexed(name).get_summary()
    counts = dict.fromkeys(summary.channels, 0)
    streamed_messages = NonSeekingReader(io.BytesIO(bytes_of(name)), validate_crcs=True).iter_messages()
    for _, channel, _ in streamed_messages:
        counts[channel.id] += 1
    assert counts == {id: summary.statistics.channel_message_counts.get(id, 0) for id in counts}
    assert summary.statistics.message_count == sum(counts.values())
    assert summary.statistics.chunk_count == len(summary.chunk_indexes)
    assert len(list(indexed(name).iter_messages())) == sum(counts.values())


@pytest.mark.parametrize("name", RECORDINGS + BAGS)
def test_every_message_is_what_its_schema_says_and_times_rise(name):
    last, validators, decoders = 0, {}, DecoderFactory()
    for schema, channel, message in indexed(name).iter_messages():
        assert message.log_time == message.publish_time >= last
        last = message.log_time
        if channel.message_encoding == "json":
            assert schema.encoding == "jsonschema"
            if schema.id not in validators:
                document = json.loads(schema.data)
                jsonschema.Draft202012Validator.check_schema(document)
                validators[schema.id] = (document, jsonschema.Draft202012Validator(document))
            document, validator = validators[schema.id]
            value = json.loads(message.data)
            validator.validate(value)
            assert set(value) <= set(document["properties"])
        else:
            assert (channel.message_encoding, schema.encoding) == ("cdr", "ros2msg")
            assert schema.name == TYPES[channel.topic]
            decoders.decoder_for("cdr", schema)(message.data)


@pytest.mark.parametrize("store", [Stores.ROS2_HUMBLE, Stores.ROS2_JAZZY, Stores.LATEST])
def test_definitions_are_those_of_ros(store):
    theirs = get_typestore(store).fielddefs
    for schema in indexed("sample.mcap").get_summary().schemas.values():
        if schema.encoding != "ros2msg":
            continue
        for name, (constants, fields) in get_types_from_msg(schema.data.decode(), schema.name).items():
            assert fields == theirs[name][1], name
            assert {c[0]: c[2] for c in constants}.items() <= {c[0]: c[2] for c in theirs[name][0]}.items(), name


@pytest.mark.parametrize("name", BAGS)
def test_rosbags_writes_the_same_bytes(name):
    """Once it has read them with the definitions of ROS that it brings along."""
    store = get_typestore(Stores.ROS2_HUMBLE)
    with Reader(SAMPLES / name) as bag:
        assert {c.topic: c.msgtype for c in bag.connections} == TYPES
        last = 0
        for connection, time, data in bag.messages():
            assert time >= last
            last = time
            message = store.deserialize_cdr(data, connection.msgtype)
            assert bytes(store.serialize_cdr(message, connection.msgtype)) == bytes(data)


def test_a_bag_is_read_by_rosbags_with_the_definitions_inside():
    with AnyReader([SAMPLES / "world-bag.mcap"]) as bag:
        assert bag.message_count == sum(1 for _ in bag.messages())
        connection = next(c for c in bag.connections if c.topic == "/tf")
        transforms = [bag.deserialize(data, connection.msgtype).transforms for _, _, data in bag.messages([connection])]
    assert [len(t) for t in transforms] == [12] * len(messages("world.mcap", "/banyan/frame"))


def test_rosbags_takes_no_recording_because_of_its_other_channels():
    """As ros2 bag play does not; the day that this fails, bags are superfluous."""
    with pytest.raises((ReaderError, KeyError)):
        with Reader(SAMPLES / "sample.mcap") as bag:
            list(bag.messages())


@pytest.mark.parametrize("name,first", [("sample.mcap", 0), ("sample-bag.mcap", 0), ("world.mcap", 10**8)])
def test_it_begins_when_the_run_does(name, first):
    for topic in ["/tf", "/markers"]:
        times = [time for time, _ in messages(name, topic)]
        assert times[0] == first and len(set(times)) == len(times)


@pytest.mark.parametrize("name", ["sample", "world"])
def test_transforms_are_where_frames_have_the_robots(name):
    frames = {time: frame for time, frame in messages(f"{name}.mcap", "/banyan/frame")}
    for file in [f"{name}.mcap", f"{name}-bag.mcap"]:
        found = messages(file, "/tf")
        assert len(found) > 10
        for time, message in found:
            frame = frames[time]
            assert [t.child_frame_id for t in message.transforms] == [
                f"robot_{i}/base_link" for i in range(len(frame["x_m"]))]
            for i, t in enumerate(message.transforms):
                assert nanoseconds(t.header.stamp) == time and t.header.frame_id == "map"
                at, turn = t.transform.translation, t.transform.rotation
                assert is_near(at.x, frame["x_m"][i]) and is_near(at.y, frame["y_m"][i]) and at.z == 0
                assert is_near(math.remainder(2 * math.atan2(turn.z, turn.w) - frame["heading_rad"][i], math.tau), 0)
                assert is_near(math.hypot(turn.x, turn.y, turn.z, turn.w), 1)
    assert len(messages(f"{name}-bag.mcap", "/tf")) == len(frames)


def test_markers_show_the_frame():
    frames = dict(messages("sample.mcap", "/banyan/frame"))
    targets = messages("sample.mcap", "/banyan/targets")
    for time, message in messages("sample.mcap", "/markers"):
        frame = frames[time]
        first, *rest = message.markers
        assert first.action == DELETE_ALL
        assert all(m.action == 0 and m.header.frame_id == "map" and nanoseconds(m.header.stamp) == time for m in rest)
        assert len({(m.ns, m.id) for m in rest}) == len(rest)
        layers = {ns: list(markers) for ns, markers in itertools.groupby(rest, lambda m: m.ns)}
        [robots] = layers["robots"]
        assert robots.type == SPHERE_LIST and len(robots.points) == len(robots.colors) == len(frame["x_m"])
        for i, (point, color) in enumerate(zip(robots.points, robots.colors)):
            assert is_near(point.x, frame["x_m"][i], PICTURE) and is_near(point.y, frame["y_m"][i], PICTURE)
            grey = color.r == color.g == color.b
            assert grey == (not frame["alive"][i])
        for layer, parents in [("tree", "parent"), ("old_tree", "old_parent")]:
            edges = [(i, p) for i, p in enumerate(frame[parents]) if p >= 0 and frame["alive"][i]]
            [lines] = layers[layer]
            assert lines.type == LINE_LIST and lines.scale.x > 0 and len(lines.points) == 2 * len(edges)
            for (i, p), a, b in zip(edges, lines.points[::2], lines.points[1::2]):
                assert is_near(a.x, frame["x_m"][i], PICTURE) and is_near(b.y, frame["y_m"][p], PICTURE)
        places = [t for when, t in targets if when <= time][-1]
        names = [m for m in rest if m.ns == "target_names"]
        assert [m.text for m in names] == [f"T{k}" for k, active in enumerate(places["active"]) if active]
        assert all(m.type == TEXT for m in names)
        assert [m.type for m in layers["obstacles"]] == [CYLINDER, 1, 1]
        wall = layers["obstacles"][2]
        assert is_near(wall.scale.x, math.hypot(2.0, 0.5)) and is_near(wall.pose.position.y, -2.25)
        assert is_near(2 * math.atan2(wall.pose.orientation.z, wall.pose.orientation.w), math.atan2(-0.5, 2.0))


def test_a_bag_has_the_radio_links_that_are_open():
    """Every pair in range, where none needs to see the other."""
    setting = messages("world.mcap", "/banyan/setting")[0][1]
    for time, message in messages("world-bag.mcap", "/markers"):
        [links] = [m for m in message.markers if m.ns == "links"]
        [robots] = [m for m in message.markers if m.ns == "robots"]
        places = {(p.x, p.y): i for i, p in enumerate(robots.points)}
        ends = [places[p.x, p.y] for p in links.points]
        pairs = set(zip(ends[::2], ends[1::2]))
        assert len(pairs) == len(links.points) // 2
        distances = {(a, b): math.dist(p, q) for (p, a), (q, b) in itertools.combinations(places.items(), 2)}
        assert all(distances[pair] < setting["range_m"] + 2 * PICTURE for pair in pairs)
        assert not setting["line_of_sight"]
        assert pairs >= {pair for pair, d in distances.items() if d < setting["range_m"] - 2 * PICTURE}
    assert not any(m.ns == "links" for _, message in messages("world.mcap", "/markers") for m in message.markers)


def test_the_log_has_every_event():
    for name in ["sample", "world"]:
        events = messages(f"{name}.mcap", "/banyan/events")
        assert len(events) > 3
        for file in [f"{name}.mcap", f"{name}-bag.mcap"]:
            log = messages(file, "/rosout")
            assert [(time, m.name, m.msg) for time, m in log] == [
                (time, "banyan." + e["kind"], e["text"]) for time, e in events]
            assert {m.level for _, m in log} <= {20, 30}
            assert all(m.level == 30 for _, m in log if m.name == "banyan.split")


@pytest.mark.parametrize("name", RECORDINGS)
def test_metadata_is_found_through_its_index(name):
    metadata = {record.name: record.metadata for record in indexed(name).iter_metadata()}
    json.loads(metadata["banyan.provenance"]["config"])
    assert len(metadata["banyan.result"]["hash"]) == 16
    assert metadata["banyan.result"]["interrupted"] == ("true" if name == "empty.mcap" else "false")


def test_frames_are_all_there_and_a_range_has_its_own():
    frames = messages("sample.mcap", "/banyan/frame")
    assert [f["tick"] for _, f in frames] == list(range(300))
    assert [f["tick"] for _, f in messages("plain.mcap", "/banyan/frame")] == list(range(0, 101, 5))
    assert messages("empty.mcap", "/banyan/frame", "/tf", "/markers") == []
    low, high = frames[100][0], frames[200][0]
    part = indexed("sample.mcap").iter_messages(["/banyan/frame"], starting_at=low, ending_at=high)
    assert [m.log_time for _, _, m in part] == [time for time, _ in frames[100:201]]


def test_the_table_has_what_frames_have():
    roles = ["spare", "connector", "worker", "root"]
    phases = ["init", "start_tree", "select_parent", "grow_tree", "select_root"]
    rows = list(csv.DictReader(io.StringIO(bytes_of("sample.csv").decode())))
    expected = []
    for _, frame in messages("sample.mcap", "/banyan/frame"):
        for i in range(len(frame["x_m"])):
            row = {"tick": frame["tick"], "robot": i}
            row |= {name: frame[name][i] for name in ["x_m", "y_m", "heading_rad", "alive", "connected"]}
            row |= {name: frame[name][i] for name in ["parent", "old_parent", "target"]}
            expected.append(row | {"role": roles[frame["role"][i]], "phase": phases[frame["phase"][i]]})
    assert len(rows) == len(expected)
    for row, wanted in zip(rows, expected):
        for name, value in wanted.items():
            got = row[name] if isinstance(value, str) else float(row[name] or -1)
            assert got == value, name


def test_plots_can_be_read_without_what_is_large():
    summary = indexed("world.mcap").get_summary()
    topics = {"/banyan/frame", "/banyan/messages", "/markers", "/tf"}
    large = {c.id for c in summary.channels.values() if c.topic in topics}
    assert len(large) == 4 and len(summary.chunk_indexes) > 3
    for chunk in summary.chunk_indexes:
        inside = set(chunk.message_index_offsets)
        assert inside <= large or not inside & large
    assert {c.compression for c in summary.chunk_indexes} == {"zstd"}


@pytest.mark.parametrize("name,least,most", [
    ("cut.mcap.part", 50, 50), ("killed.mcap.part", 1, 10), ("early.mcap.part", 0, 0)])
def test_a_recording_that_was_cut_short_is_read_up_to_there(name, least, most):
    with pytest.raises(McapError):
        indexed(name).get_summary()
    records = streamed(bytes_of(name))
    topics = {r.id: r.topic for r in records if isinstance(r, Channel)}
    schemas = {r.id: r for r in records if isinstance(r, Schema)}
    channels = {r.id: schemas[r.schema_id] for r in records if isinstance(r, Channel)}
    count, decoders = dict.fromkeys(topics.values(), 0), DecoderFactory()
    for record in records:
        if not isinstance(record, Message):
            continue
        count[topics[record.channel_id]] += 1
        if topics[record.channel_id] in TYPES:
            decoders.decoder_for("cdr", channels[record.channel_id])(record.data)
        else:
            json.loads(record.data)
    assert least <= count["/banyan/frame"] <= most
    assert count["/tf"] == count["/markers"] == math.ceil(count["/banyan/frame"] / 5)


def test_damage_is_found():
    data = bytearray(bytes_of("plain.mcap"))
    data[data.index(b'"heading_rad":[') + 1] ^= 1
    with pytest.raises(ValueError, match="(?i)crc"):
        streamed(bytes(data))
