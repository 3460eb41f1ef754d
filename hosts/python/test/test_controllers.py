# SPDX-License-Identifier: MIT
"""Controllers in Python: what they sense against the truth, what they do, what they are told when it is nonsense."""

import copy
import json

import numpy as np
import pytest

import banyan


def rotated_back(heading, vectors):
    c, s = heading
    return vectors @ np.array([[c, -s], [s, c]])


class Still(banyan.Policy):
    """stands still and says where it is"""

    message_floats = 2

    def reset(self, swarm):
        self.swarm = swarm
        self.seen = []

    def step(self, seen):
        self.seen.append(seen.copy())
        n = self.swarm.robots
        self.said = np.stack([np.arange(n), np.full(n, len(self.seen))], axis=-1)
        return banyan.Actions(np.zeros((n, 2)), message=self.said)


class Wander(banyan.Policy):
    """drives about by a rule that has a memory, and tells it"""

    message_floats = 3
    max_neighbours = 6

    def reset(self, swarm):
        self.memory = np.random.default_rng(1).normal(size=(swarm.robots, 3)).astype(np.float32)

    def step(self, seen):
        heard = np.where(seen.mask[..., None], seen.message, 0).sum(axis=-2)
        self.memory = np.cos(self.memory + 0.1 * heard)
        return banyan.Actions(self.memory[:, :2] * (0.1, 1.0), message=self.memory)


class WanderAlone(banyan.Controller):
    """the same for each robot by itself"""

    message_floats = 3
    max_neighbours = 6

    def reset(self, robot):
        self.memory = np.random.default_rng(1).normal(size=(robot.swarm.robots, 3)).astype(np.float32)[robot.id]

    def step(self, seen):
        heard = np.zeros((6, 3), np.float32)
        heard[: seen.heard] = seen.messages
        self.memory = np.cos(self.memory + 0.1 * heard.sum(axis=0))
        return banyan.Action(self.memory[:2] * np.array((0.1, 1.0)), message=self.memory)


def policy_of(make):
    """The controller that the next world makes, to look into it."""
    made = []
    return (lambda: made.append(make()) or made[-1]), made


def test_what_is_sensed_is_the_truth_in_the_own_frame(small):
    factory, made = policy_of(Still)
    world = banyan.World(banyan.Scenario(small, controller=factory))
    world.step(2)
    policy = made[-1]
    seen = policy.seen[-1]
    n = len(world)
    for i in range(n):
        others = np.delete(np.arange(n), i)
        assert np.array_equal(seen.sender[i, : seen.heard[i]], others)
        truth = rotated_back(world.headings[i], world.positions[others] - world.positions[i])
        assert np.allclose(seen.position[i, : seen.heard[i]], truth, atol=1e-5)
        assert np.array_equal(seen.message[i, : seen.heard[i]], [[j, 1] for j in others])  # of the tick before
        assert (seen.sender[i, seen.heard[i] :] == -1).all() and not seen.position[i, seen.heard[i] :].any()
    workers = np.flatnonzero(seen.sent)
    assert np.array_equal(workers, policy.swarm.workers) and len(workers) == 3
    for i in workers:
        targets = rotated_back(world.headings[i], world.targets - world.positions[i])
        assert np.min(np.linalg.norm(targets - seen.target[i], axis=1)) < 1e-5
    assert policy.swarm.root == np.flatnonzero(seen.root)[0] and policy.swarm.range_m == 2.0
    assert (policy.seen[0].heard == 0).all()  # nothing was sent yet


def test_of_many_neighbours_the_nearest_are_heard(small):
    factory, made = policy_of(type("Few", (Still,), {"max_neighbours": 4}))
    world = banyan.World(banyan.Scenario(small, controller=factory))
    world.step(2)
    seen = made[-1].seen[-1]
    distance = np.linalg.norm(world.positions[:, None] - world.positions[None], axis=-1)
    for i in range(len(world)):
        assert np.array_equal(seen.sender[i], np.sort(np.argsort(distance[i])[1:5]))
    offsets, sender, position, message = seen.ragged()
    assert np.array_equal(np.diff(offsets), seen.heard) and np.array_equal(
        sender[offsets[3] : offsets[4]], seen.sender[3]
    )
    assert position.shape == (18 * 4, 2) and message.shape == (18 * 4, 2)


def test_messages_take_as_long_as_the_radio_says(small):
    factory, made = policy_of(Still)
    world = banyan.World(banyan.Scenario(small, controller=factory, set={"radio.latency_ticks": 3}))
    world.step(6)
    seen = made[-1].seen[-1]
    assert (seen.age[seen.mask] == 3).all() and (seen.message[seen.mask][:, 1] == 3).all()


def test_robots_do_what_was_decided():
    class Turn(banyan.Policy):
        def step(self, seen):
            return np.tile([0.05, 0.4], (len(seen.sent), 1))

    world = banyan.World(
        "scenarios/three-targets.toml",
        controller=Turn,
        set={"swarm.start.pitch_m": 0.9, "swarm.robots": 5, "radio.range_m": 4},
    )
    world.step()
    before = world.positions.copy(), world.headings.copy()
    world.step(10)
    x, y = before[1].T
    turned = np.arctan2(x * world.headings[:, 1] - y * world.headings[:, 0], (before[1] * world.headings).sum(axis=1))
    assert np.allclose(turned, 0.4, atol=1e-3)
    chord = 2 * 0.05 / 0.4 * np.sin(0.2)
    assert np.allclose(np.linalg.norm(world.positions - before[0], axis=1), chord, atol=1e-3)


def test_what_the_wheels_cannot_do_is_shortened():
    class Fast(banyan.Policy):
        def step(self, seen):
            return np.tile([10.0, 0.0], (len(seen.sent), 1))

    world = banyan.World(
        "scenarios/three-targets.toml",
        controller=Fast,
        set={"swarm.start.pitch_m": 0.9, "swarm.robots": 5, "radio.range_m": 4},
    )
    world.step()
    before = world.positions.copy()
    world.step()
    assert np.allclose(np.linalg.norm(world.positions - before, axis=1), 0.02, atol=1e-6)


def test_one_by_one_and_all_at_once_are_the_same(small):
    hashes = {
        banyan.run(small, controller=kind, set={"mission.time_limit_s": 20}).hash for kind in (Wander, WanderAlone)
    }
    assert len(hashes) == 1


def test_threads_do_not_matter(small):
    worlds = [banyan.World(small, controller=Wander) for _ in range(3)]
    for threads, world in enumerate(worlds, 1):
        world.step(40, threads=threads)
    assert len({world.hash for world in worlds}) == 1


@pytest.mark.parametrize("kind", [Wander, WanderAlone])
def test_copies_have_memories_of_their_own(small, kind):
    world = banyan.World(small, controller=kind)
    world.step(15)
    twin = copy.deepcopy(world)
    world.step(25)
    behind = twin.hash
    world.step(5)
    assert twin.hash == behind
    twin.step(30)
    assert twin.hash == world.hash


def test_measures_count_what_robots_report(small):
    class Chain(banyan.Policy):
        def step(self, seen):
            n = len(seen.sent)
            parent = np.arange(n) - 1
            role = np.full(n, banyan.Role.CONNECTOR)
            role[0] = banyan.Role.ROOT
            role[n - 2 :] = banyan.Role.SPARE
            return {"velocity": np.zeros((n, 2)), "parent": parent, "role": role}

    world = banyan.World(small, controller=Chain, measure=True)
    world.step(2)
    assert world.metrics["roots"] == 1 and world.metrics["spares"] == 2 and world.metrics["connectors"] == 15
    assert world.metrics["edges"] == 15
    assert np.array_equal(world.parents, np.arange(18) - 1) and world.scenario.algorithm == "chain"


def test_roles_are_as_the_mission_sent_them_unless_said(small):
    world = banyan.World(small, controller=Still)
    sent = banyan.World(small)
    assert (
        np.array_equal(np.flatnonzero(world.roles == 2), np.flatnonzero(world.serves >= 0))
        and (world.roles == 3).sum() == 1
    )
    world.step(5)
    assert (world.roles == 2).sum() == 3 and (world.roles == 1).sum() == 14 and np.allclose(sent.targets, world.targets)


def test_bytes_as_messages(small, tmp_path):
    class Talk(banyan.Controller):
        message_bytes = 4
        heard_bytes = 0

        def step(self, seen):
            if seen.heard:
                assert seen.messages.dtype == np.uint8 and bytes(seen.messages[0]) == bytes([seen.ids[0], 2, 3, 255])
                Talk.heard_bytes += 1
            return banyan.Action((0, 0), message=bytes([seen.id, 2, 3, 255]))

    result = banyan.run(small, controller=Talk, out=tmp_path / "run", set={"mission.time_limit_s": 1})
    assert Talk.heard_bytes > 18
    assert result["bytes_per_robot_s"] == pytest.approx(9 * 6)  # nothing in the first tick; two are the id
    world = banyan.World(small, controller=Talk)
    world.step(2)
    assert world.message(5) == {"b0": 5, "b1": 2, "b2": 3, "b3": 255}


def test_convoy_with_decisions_of_ones_own(small):
    class AsItIs(banyan.Policy):
        base = "convoy"

        def step(self, seen):
            return None

    class Slower(banyan.Policy):
        base = "convoy"

        def step(self, seen):
            return seen.suggested * np.float32(0.5)

    plain = banyan.run(small)
    same = banyan.run(small, controller=AsItIs)
    slower = banyan.run(small, controller=Slower)
    for column in ("completion_time_s", "insertions", "messages", "driven_m", "hash"):
        assert same[column] == plain[column], column
    assert slower.complete and slower["completion_time_s"] > 1.4 * plain["completion_time_s"]
    world = banyan.World(small, controller=Slower)
    world.step(30)
    assert world.message(4)["id"] == 4  # it is convoy's message that travels
    with pytest.raises(banyan.ScenarioError, match="target_gian"):
        banyan.run(small, controller=Slower, parameters={"target_gian": 1})


class Bad(banyan.Policy):
    message_floats = 2
    value = None

    def step(self, seen):
        return type(self).value


N = 18
GOOD = np.zeros((N, 2), np.float32)
NONSENSE = [
    (np.zeros((N - 1, 2)), r"velocity: has shape \(17, 2\); needed is \(18, 2\) or \(18, 3\)"),
    (np.zeros(N), "velocity: has shape"),
    (np.zeros((N, 2), complex), "velocity: is of type complex128"),
    (np.full((N, 2), "x"), "velocity: is of type <U1"),
    (np.array([None] * N), "velocity: is of type object"),
    ([[0, 0]] * 17 + [[0]], "velocity: is ragged|velocity: is of type object"),
    (np.where(np.arange(2 * N).reshape(N, 2) == 7, np.nan, 0), r"velocity: at \(3, 1\) is nan"),
    (np.full((N, 2), np.inf), r"velocity: at \(0, 0\) is inf"),
    (np.full((N, 2), 1e300), "velocity: at"),
    (np.ones((N, 3)), "two wheels"),
    (None, "returned nothing"),
    (banyan.Actions(GOOD, message=np.zeros((N, 3))), r"message: has shape \(18, 3\); needed is \(18, 2\)"),
    (banyan.Actions(GOOD, message=np.full((N, 2), np.nan)), "message: at"),
    (banyan.Actions(GOOD, role=np.full(N, 4)), "role: 4 is not from -1 to 3"),
    (banyan.Actions(GOOD, role=np.zeros(N)), "role: is of type float64"),
    (banyan.Actions(GOOD, parent=np.full(N, 18)), "parent: 18 is not from -1 to 17"),
    (banyan.Actions(GOOD, parent=np.full((N, 1), 0)), "parent: has shape"),
    (banyan.Actions(GOOD, kept=np.zeros((N, 13), int)), "kept: has shape"),
    (banyan.Actions(None), "velocity: is missing"),
    ({"velocity": GOOD, "massage": 1}, "no 'massage'"),
]


@pytest.mark.parametrize("value,words", NONSENSE)
def test_nonsense_is_refused_in_words(small, value, words):
    Bad.value = value
    world = banyan.World(small, controller=Bad)
    with pytest.raises(banyan.ActionError, match=words):
        world.step()
    with pytest.raises(RuntimeError, match="worthless"):
        world.step()


def test_an_error_in_a_controller_comes_out_as_it_is(small):
    class Broken(banyan.Controller):
        def step(self, seen):
            return {}["nothing"]

    with pytest.raises(KeyError, match="nothing"):
        banyan.run(small, controller=Broken)


def test_wrong_controllers_are_refused(small):
    for wrong, error, words in (
        (3, TypeError, "a controller is"),
        (object, TypeError, "no step"),
        (type("M", (banyan.Policy,), {"message_floats": 24}), ValueError, "24 are too many; at most 23"),
        (type("M", (banyan.Policy,), {"message_bytes": 95}), ValueError, "95 are too many; at most 94"),
        (type("M", (banyan.Policy,), {"message_bytes": 1, "message_floats": 1}), ValueError, "not both"),
        (type("M", (banyan.Policy,), {"message_bytes": -1}), ValueError, "message_bytes: is -1"),
        (type("M", (banyan.Policy,), {"max_neighbours": 0}), ValueError, "max_neighbours"),
        (type("M", (banyan.Policy,), {"base": "convey"}), ValueError, "no algorithm 'convey'"),
        (type("M", (banyan.Policy,), {"name": "a b"}), ValueError, "cannot be called"),
        (type("M", (banyan.Policy,), {"name": "convoy"}), banyan.ScenarioError, "one of Banyan's"),
    ):
        with pytest.raises(error, match=words):
            banyan.run(small, controller=wrong)


def test_a_controller_that_steps_its_own_world_is_refused(small):
    class Loop(banyan.Policy):
        def step(self, seen):
            box[0].step()

    box = []
    box.append(banyan.World(small, controller=Loop))
    with pytest.raises(RuntimeError, match="from within a controller"):
        box[0].step()


def test_the_dead_do_nothing(small):
    factory, made = policy_of(Still)
    world = banyan.World(banyan.Scenario(small, controller=factory))
    world.step(2)
    world.intervene("die", robot=4)
    world.step(2)
    seen = made[-1].seen[-1]
    assert not seen.steps[4] and seen.steps.sum() == 17
    assert not (seen.sender[seen.steps] == 4).any()


def test_clocks_of_their_own(small):
    factory, made = policy_of(Wander)
    scenario = banyan.Scenario(small, controller=factory, set={"clocks.asynchronous": True, "clocks.drift": 0.1})
    world, again = banyan.World(scenario), banyan.World(scenario)
    world.step(30)
    again.step(30, threads=2)
    assert world.hash == again.hash


def test_holonomic_robots():
    class Crab(banyan.Policy):
        def reset(self, swarm):
            self.swarm = swarm

        def step(self, seen):
            return self.swarm.drive(np.tile([0.0, 0.1], (len(seen.sent), 1)))

    world = banyan.World("scenarios/three-targets.toml", controller=Crab, set={"robot.body": "linear"})
    world.step(30)
    before = world.positions.copy()
    world.step(10)
    left = np.stack([-world.headings[:, 1], world.headings[:, 0]], axis=-1)
    assert np.allclose(np.einsum("ij,ij->i", world.positions - before, left), 0.1, atol=1e-3)


def test_drive_turns_towards_and_drives_ahead():
    assert np.allclose(banyan.drive([0.1, 0.0]), [0.1, 0.0])
    assert np.allclose(banyan.drive([[9.0, 0.0], [0.0, 0.0]]), [[0.2, 0.0], [0.0, 0.0]])
    forward, turn = banyan.drive([-0.1, 0.1])
    assert forward == 0 and turn > 3
    for v in np.random.default_rng(2).normal(size=(50, 2)):
        forward, turn = banyan.drive(v)
        assert abs(forward) + abs(turn) * 0.1054 / 2 <= 0.2 + 1e-6


def test_recordings_have_the_message_of_a_controller(small, tmp_path):
    banyan.run(small, controller=Still, out=tmp_path / "run", set={"mission.time_limit_s": 2})
    recording = banyan.read(tmp_path / "run" / "run.mcap")
    assert recording.config["mission"]["algorithm"] == "still" and len(recording) == 21
    assert json.dumps(recording.result)
