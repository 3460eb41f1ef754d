# SPDX-License-Identifier: MIT
"""Worlds that Python steps: arrays, copies, interventions, threads, pictures."""

import copy
import gc
import multiprocessing
import subprocess
import sys
import threading
import xml.etree.ElementTree as xml

import numpy as np
import pytest

import banyan


def test_a_world_ends_where_its_run_ends(small):
    result = banyan.run(small)
    world = banyan.World(small, measure=True)
    while not world.finished:
        world.step()
    assert world.hash == result.hash
    assert world.result()["hash"] == result["hash"] and world.result() == result.row
    assert world.metrics["targets_reached"] == 3


@pytest.mark.parametrize("threads", [1, 2, 3])
def test_any_number_of_threads_gives_the_same_bits(threads):
    world = banyan.World("scenarios/paper-large.toml")
    world.step(60, threads=threads)
    alone = banyan.World("scenarios/paper-large.toml")
    for _ in range(60):
        alone.step()
    assert world.hash == alone.hash


def test_a_forked_process_has_threads_of_its_own(small):
    world, alone = banyan.World(small), banyan.World(small)
    env = banyan.BatchEnv(small, 4, threads=2)
    env.reset(seed=1)
    world.step(10, threads=2)
    alone.step(20)

    def child(pipe):
        env.step(np.zeros((4, 18, 2)))
        world.step(10, threads=2)
        pipe.send((world.hash, env.hash(3)))

    fork = multiprocessing.get_context("fork")
    for _ in range(2):  # the parent's threads are its own all the while
        here, there = fork.Pipe()
        process = fork.Process(target=child, args=(there,))
        process.start()
        answer = here.poll(20) and here.recv()
        process.kill() if not answer else process.join(20)
        assert answer and answer[0] == alone.hash and process.exitcode == 0
    env.step(np.zeros((4, 18, 2)))
    world.step(10, threads=2)
    assert (world.hash, env.hash(3)) == answer


@pytest.mark.parametrize("does", ["pass", "world.step(threads=2)", "world.step(threads=3)", "del world"])
def test_a_forked_process_ends(does):
    script = f"""
import os, signal, banyan
world = banyan.World("scenarios/three-targets.toml")
world.step(threads=2)
child = os.fork()
if child == 0:
    signal.alarm(20)
    {does}
    raise SystemExit(3)
print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))
"""
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=60)
    assert done.stdout == "3\n" and done.returncode == 0, done.stderr


def test_arrays_show_the_present_without_copies(small):
    world = banyan.World(small)
    positions, parents, roles = world.positions, world.parents, world.roles
    before = positions.copy()
    world.step(50)
    assert not np.array_equal(before, positions) and np.array_equal(positions, world.positions)
    assert np.shares_memory(positions, world.positions)
    assert roles.dtype == np.uint8 and sorted(set(roles.tolist())) == sorted(
        set(world.frame().columns()["role"].astype(int).tolist())
    )
    assert np.array_equal(parents, world.frame().columns()["parent"].astype(int))
    assert np.allclose(np.hypot(*world.headings.T), 1) and world.alive.all()


def test_arrays_cannot_be_written(small):
    world = banyan.World(small)
    for name in ("positions", "headings", "roles", "parents", "alive", "serves"):
        with pytest.raises(ValueError, match="read-only"):
            getattr(world, name)[0] = 0


def test_arrays_outlive_their_world(small):
    world = banyan.World(small)
    world.step(20)
    kept = [world.positions, world.parents, world.alive]
    copies = [array.copy() for array in kept]
    del world
    gc.collect()
    others = [banyan.World(small, seed=seed) for seed in range(1, 30)]  # would take its place in memory
    for other in others:
        other.step(2)
    for array, was in zip(kept, copies):
        assert np.array_equal(array, was)


def test_links_are_the_pairs_in_range(small):
    world = banyan.World(small)
    world.step(100)
    distance = np.linalg.norm(world.positions[:, None] - world.positions[None], axis=-1)
    expected = np.argwhere(np.triu(distance < 2.0, 1))
    assert np.array_equal(world.links, expected)
    assert np.array_equal(world.neighbours(3), np.flatnonzero((distance[3] < 2.0) & (np.arange(18) != 3)))
    edges = world.edges
    assert np.array_equal(world.parents[edges[:, 0]], edges[:, 1]) and len(edges) > 5
    with pytest.raises(IndexError):
        world.neighbours(18)


def test_copies_go_on_alike(small):
    world = banyan.World(small)
    world.step(30)
    twins = [world.copy(), copy.copy(world), copy.deepcopy(world)]
    world.step(30)
    for twin in twins:
        assert isinstance(twin, banyan.World) and twin.hash != world.hash
        twin.step(30)
        assert twin.hash == world.hash


def test_interventions_are_events_of_the_scenario(small):
    world = banyan.World(small)
    world.step(30)
    world.intervene("kill", of="root")
    world.intervene("move_target", target=0, position_m=np.array([2.0, 2.0]))
    world.step(50)
    assert world.alive.sum() == 17 and np.allclose(world.targets[0], [2, 2])
    again = banyan.World(world.scenario)
    again.step(80)
    assert again.hash == world.hash
    world.intervene("add_target", position_m=[0, 3])
    world.step()
    assert len(world.targets) == 4
    for wrong, words in (
        (dict(kind="kil"), "kill"),
        (dict(kind="die", robot=18), "robot"),
        (dict(kind="set_loss", loss=2), "loss"),
        (dict(kind="die", robot=1, time_s=3), "now"),
    ):
        with pytest.raises(banyan.ScenarioError, match=words):
            world.intervene(**wrong)


def test_thousands_of_worlds(small):
    worlds = [banyan.World(small, seed=seed) for seed in range(1, 1001)]
    for world in worlds[::100]:
        world.step(3)
    assert len({world.hash for world in worlds}) == 1000


def test_threads_step_worlds_of_their_own(small):
    expected = [banyan.World(small, seed=seed) for seed in range(1, 9)]
    for world in expected:
        world.step(150)
    worlds = [banyan.World(small, seed=seed) for seed in range(1, 9)]
    threads = [threading.Thread(target=world.step, args=(150,)) for world in worlds]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert [world.hash for world in worlds] == [world.hash for world in expected]


def test_a_world_is_for_one_thread_at_a_time():
    world = banyan.World("scenarios/paper-large.toml")
    thread = threading.Thread(target=world.step, args=(600,))
    thread.start()
    refused = 0
    while thread.is_alive():
        try:
            world.step()
            world.hash
        except RuntimeError as error:
            assert "is being stepped" in str(error)
            refused += 1
        world.positions.sum()  # in motion, but always there
    thread.join()
    assert refused > 0


def test_other_threads_run_meanwhile():
    world = banyan.World("scenarios/paper-large.toml")
    thread = threading.Thread(target=world.step, args=(400,))
    thread.start()
    counted = 0
    while thread.is_alive():
        counted += 1
    thread.join()
    assert counted > 1000


def test_a_message_by_its_fields(small):
    world = banyan.World(small)
    world.step(20)
    message = world.message(4)
    assert message["id"] == 4 and message["role"] in ("spare", "connector", "worker", "root")
    with pytest.raises(IndexError, match="no robot 18"):
        world.message(18)


def test_what_was_not_measured_is_not_told(small):
    with pytest.raises(RuntimeError, match="measure=True"):
        banyan.World(small).metrics
    with pytest.raises(RuntimeError, match="measure=True"):
        banyan.World(small, measure=True).copy().metrics


def test_steps_are_whole_and_forwards(small):
    world = banyan.World(small)
    world.step(0)
    assert world.tick == 0
    for wrong in (dict(ticks=-1), dict(threads=0)):
        with pytest.raises(ValueError, match="at least"):
            world.step(**wrong)
    with pytest.raises(TypeError):
        world.step(1.5)


def test_pictures(small):
    world = banyan.World(small)
    world.step(90)
    for thing in (world, world.frame(), banyan.run(small)):
        root = xml.fromstring(thing._repr_svg_())
        assert root.tag.endswith("svg") and len(list(root.iter())) > 40
    assert 'width="800.00"' in world.svg(width=800, ids=True)
    with pytest.raises(TypeError, match="no option"):
        world.svg(widht=800)
    with pytest.raises(ValueError, match="200 to 20000"):
        world.svg(width=10)
