# SPDX-License-Identifier: MIT
"""Worlds in lockstep and the parallel environment: the same robots as everywhere else, by arrays."""

import numpy as np
import pytest

import banyan


def rule(seen):
    """Some policy without a memory."""
    heard = np.where(seen.mask[..., None], seen.message, 0).sum(axis=-2)
    message = np.cos(heard + seen.target)
    return banyan.Actions(np.stack([0.1 * message[..., 0], message[..., 1]], axis=-1), message=message)


class Rule(banyan.Policy):
    message_floats = 2
    max_neighbours = 5

    def step(self, seen):
        return rule(seen)


KEYS = {"targets.radius_m": 2.0, "swarm.robots": 9}


@pytest.mark.parametrize("threads", [1, 2])
def test_the_same_bits_as_a_policy_in_a_world(threads):
    scenario = banyan.Scenario("scenarios/three-targets.toml", set=KEYS)
    env = banyan.BatchEnv(scenario, 5, message_floats=2, max_neighbours=5, threads=threads)
    seen = env.reset(seed=3)
    worlds = [banyan.World(scenario, controller=Rule, seed=3 + e) for e in range(5)]
    for world in worlds:
        world.step(41)
    for _ in range(41 - 1):
        seen, *_ = env.step(rule(seen))
    # A policy has decided within the tick what the environment is told after it.
    for e, world in enumerate(worlds):
        assert np.array_equal(env.positions(e), world.positions)
        assert world.tick == 41
    env.step(rule(seen))
    for e, world in enumerate(worlds):
        world.step()
        assert np.array_equal(env.positions(e), world.positions) and env.positions(e).std() > 0.1


def test_rewards_and_ends():
    env = banyan.BatchEnv(
        "scenarios/three-targets.toml",
        3,
        set={**KEYS, "mission.time_limit_s": 25},
        reward={"progress_m": 1.0, "done": 10.0},
    )
    seen = env.reset(seed=1)
    first = [np.linalg.norm(env.positions(e)[seen.sent[e]], axis=1) for e in range(3)]
    total = np.zeros((3, 9))
    ends = np.zeros(3, bool)
    before = env.metrics["mean_target_distance_m"].copy()
    for tick in range(260):
        speed = np.where(np.arange(3) < 2, 0.5, 0.0)[:, None, None]  # in the last world nobody moves
        way = np.where(seen.has_target[..., None], seen.target, 0.0) * speed
        seen, rewards, terminated, truncated, info = env.step(env.drive(way))
        total += np.where(ends[:, None], 0, rewards)
        assert not (terminated & truncated).any()
        ends |= terminated | truncated
        if ends.all():
            break
    assert terminated.tolist() == [True, True, False] and truncated.tolist() == [False, False, True]
    after = info["metrics"]["mean_target_distance_m"]
    assert total[2] == pytest.approx(np.zeros(9), abs=1e-6)
    assert (total[:2] > 10).all() and len(first) == 3
    assert (before[:2] - after[:2] > 1).all()
    assert env.result(0)["complete"] and not env.result(2)["complete"]


def test_reward_by_a_function_and_wrong_ones():
    def mine(now, before):
        assert now["components"].shape == (2,)
        return np.arange(18.0).reshape(2, 9)

    env = banyan.BatchEnv("scenarios/three-targets.toml", 2, set=KEYS, reward=mine)
    env.reset()
    assert np.array_equal(env.step(np.zeros((2, 9, 2)))[1], np.arange(18).reshape(2, 9))
    with pytest.raises(ValueError, match="did you mean 'components'"):
        banyan.BatchEnv("scenarios/three-targets.toml", 2, set=KEYS, reward={"component": 1})
    env = banyan.BatchEnv("scenarios/three-targets.toml", 2, set=KEYS, reward=lambda now, before: np.zeros(3))
    env.reset()
    with pytest.raises(ValueError, match="reward: has shape"):
        env.step(np.zeros((2, 9, 2)))


def test_reset_one_and_automatically():
    env = banyan.BatchEnv("scenarios/three-targets.toml", 2, set={**KEYS, "mission.time_limit_s": 0.5}, auto_reset=True)
    env.reset(seed=10)
    begin = [env.hash(0), env.hash(1)]
    for _ in range(4):
        *_, info = env.step(np.zeros((2, 9, 2)))
    assert info["ended"].all() and env.seeds.tolist() == [12, 13]
    assert [env.hash(0), env.hash(1)] != begin
    env.reset_at(1, seed=11)
    assert env.hash(1) == begin[1]
    env.reset(seed=10)
    assert [env.hash(0), env.hash(1)] == begin
    with pytest.raises(IndexError):
        env.reset_at(2)


def test_every_episode_is_new_and_a_seed_brings_all_back():
    def episodes(env, count, **begin):
        hashes = []
        for k in range(count):
            env.reset(**(begin if k == 0 else {}))
            hashes.append([env.hash(e) for e in range(env.num_envs)])
        return hashes

    env = banyan.BatchEnv("scenarios/three-targets.toml", 2, set=KEYS)
    first = episodes(env, 10)
    assert len({each for both in first for each in both}) == 20
    sevens = episodes(env, 10, seed=7)
    assert len({each for both in sevens for each in both}) == 20
    assert episodes(env, 10, seed=7) == sevens and env.seeds.tolist() == [25, 26]
    assert episodes(banyan.BatchEnv("scenarios/three-targets.toml", 2, set=KEYS, seed=7), 10) == sevens
    # One world after the other, or many at once: the same worlds.
    assert episodes(banyan.BatchEnv("scenarios/three-targets.toml", 20, set=KEYS), 1, seed=7) == [sum(sevens, [])]
    env.reset_at(0)
    assert env.seeds.tolist() == [27, 26]
    env.reset()
    assert env.seeds.tolist() == [28, 29]
    for wrong in (-1, 2**53):
        with pytest.raises(ValueError, match="seed: is"):
            env.reset(seed=wrong)
        with pytest.raises(ValueError, match="seed: is"):
            env.reset_at(0, seed=wrong)
    env.reset(seed=2**53 - 2)  # the last seeds, behind which the first come
    env.reset()
    assert env.seeds.tolist() == [0, 1]

    single = banyan.ParallelEnv("scenarios/three-targets.toml", set=KEYS)
    for _ in range(2):
        starts = []
        for k in range(20):
            single.reset(**({"seed": 7} if k == 0 else {}))
            starts.append(single._batch.hash())
        assert starts == sum(sevens, [])


def test_worlds_that_end_begin_anew_with_seeds_of_their_own():
    env = banyan.BatchEnv("scenarios/three-targets.toml", 3, set={**KEYS, "mission.time_limit_s": 0.5}, auto_reset=True)

    def seeds():
        met = []
        for _ in range(12):
            met.append(env.seeds.tolist())
            env.step(np.zeros((3, 9, 2)))
        met.append(env.seeds.tolist())
        env.reset()
        return met + [env.seeds.tolist()]

    env.reset(seed=4)
    met = seeds()
    assert {seed for each in met for seed in each} == set(range(4, 4 + 15)) and met[-1] == [16, 17, 18]
    env.reset(seed=4)
    assert seeds() == met


def test_observations_are_kept_or_not():
    env = banyan.BatchEnv("scenarios/three-targets.toml", 2, set=KEYS)
    kept = env.reset()
    was = kept.heard.copy()
    env.step(np.zeros((2, 9, 2)))
    assert np.array_equal(kept.heard, was) and (env.step(np.zeros((2, 9, 2)))[0].heard == 8).all()
    env = banyan.BatchEnv("scenarios/three-targets.toml", 2, set=KEYS, copy=False)
    shared = env.reset()
    del env
    assert shared.target.shape == (2, 9, 2) and np.isfinite(shared.target).all()


def test_flat_observations_hold_what_is_sensed():
    env = banyan.BatchEnv("scenarios/three-targets.toml", 2, set=KEYS, message_floats=2, max_neighbours=4)
    seen = env.reset()
    for _ in range(3):
        seen, *_ = env.step(rule(seen))
    flat = seen.flat()
    assert flat.shape == (2, 9, 9 + 24 + 4 * 5) and flat.dtype == np.float32
    assert np.array_equal(flat[..., 4:6], seen.target) and np.array_equal(flat[..., 0], seen.sent)
    neighbours = flat[..., 33:].reshape(2, 9, 4, 5)
    assert np.array_equal(neighbours[..., 1:3], seen.position) and np.array_equal(neighbours[..., 3:], seen.message)


def test_nonsense_is_refused_and_does_no_harm():
    env = banyan.BatchEnv("scenarios/three-targets.toml", 2, set=KEYS)
    with pytest.raises(RuntimeError, match="reset"):
        env.step(np.zeros((2, 9, 2)))
    env.reset()
    before = env.hash(0)
    for wrong, words in (
        (np.zeros((9, 2)), "needed is"),
        (np.full((2, 9, 2), np.nan), r"at \(0, 0, 0\) is nan"),
        (banyan.Actions(np.zeros((2, 9, 2)), message=np.zeros((2, 9, 0))), "there are none"),
    ):
        with pytest.raises(banyan.ActionError, match=words):
            env.step(wrong)
    assert env.hash(0) == before
    for keys, words in (
        (dict(num_envs=0), "num_envs"),
        (dict(max_neighbours=0), "max_neighbours"),
        (dict(threads=0), "threads"),
        (dict(base="convey"), "no algorithm"),
        (dict(set={"clocks.asynchronous": True}), "asynchronous"),
    ):
        with pytest.raises(ValueError, match=words):
            banyan.BatchEnv("scenarios/three-targets.toml", **keys)


def test_convoy_beneath():
    env = banyan.BatchEnv("scenarios/three-targets.toml", 2, base="convoy")
    seen = env.reset(seed=1)
    for _ in range(400):
        seen, rewards, terminated, truncated, info = env.step(seen.suggested)
        if terminated.all():
            break
    for e in range(2):
        run = banyan.run("scenarios/three-targets.toml", algorithm="convoy", seed=1 + e)
        # What convoy suggests is done one call later, but at the same tick: the same run.
        assert env.result(e)["completion_time_s"] == run["completion_time_s"]


def test_parallel_environment():
    env = banyan.ParallelEnv("scenarios/three-targets.toml", set={**KEYS, "mission.time_limit_s": 3}, message_floats=1)
    observations, infos = env.reset(seed=5)
    assert env.agents == env.possible_agents == [f"robot_{i}" for i in range(9)] and set(observations) == set(
        infos
    ) == set(env.agents)
    space = env.action_space("robot_0")
    assert (
        space.shape == (3,) and space.contains(space.sample()) and not space.contains(np.array([9.0, 0, 0], np.float32))
    )
    assert env.observation_space("robot_3").contains(observations["robot_3"])
    steps = 0
    while env.agents:
        for agent in env.agents:
            env.action_space(agent).seed(int(agent[6:]) + 100 * steps)
        results = env.step({agent: env.action_space(agent).sample() for agent in env.agents})
        assert all(set(of) == set(results[0]) for of in results)
        steps += 1
    assert steps == 29 and all(results[3].values()) and not any(results[2].values())
    assert results[4]["robot_0"]["time_s"] == pytest.approx(3.0)
    assert env.state().shape == (9, 4) and env.render().startswith("<svg")
    with pytest.raises(RuntimeError, match="reset"):
        env.step({})
    again, _ = env.reset(seed=5)
    assert all(np.array_equal(again[agent], observations[agent]) for agent in env.agents)
    with pytest.raises(KeyError, match="no agent"):
        env.action_space("robot9")
    with pytest.raises(ValueError, match="'robot_1' is missing"):
        env.step({"robot_0": np.zeros(3)})
    with pytest.raises(ValueError, match="needed are"):
        env.step({agent: np.zeros(2) for agent in env.agents})


def test_agents_die():
    events = [{"kind": "die", "robot": 2, "time_s": 0.5}]
    env = banyan.ParallelEnv("scenarios/three-targets.toml", set={**KEYS, "events": events})
    env.reset()
    for _ in range(8):
        _, _, ended, _, _ = env.step({agent: np.zeros(2) for agent in env.agents})
        if ended.get("robot_2"):
            break
    assert "robot_2" not in env.agents and len(env.agents) == 8


def test_as_many_robots_in_every_world():
    env = banyan.BatchEnv("scenarios/random-targets.toml", 20)
    with pytest.raises(banyan.ScenarioError, match="swarm.robots"):
        env.reset()
    assert banyan.BatchEnv("scenarios/random-targets.toml", 20, set={"swarm.robots": 30}).reset().sent.sum() >= 20
