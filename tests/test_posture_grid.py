"""The search in a grid of postures: its paths have as many steps as SciPy's shortest paths, and a
path that is traced back uses only postures that are free at their tick.
"""

import itertools

import numpy as np
import pytest
from scipy.sparse import coo_array
from scipy.sparse.csgraph import dijkstra

from robokin.jobs.obstacles.posture_grid import (
    INSIDE,
    NEVER,
    at_start,
    blocked,
    breadth_first,
    spread,
    way_back,
)

SIZE = (5, 6, 7)
START = (1, 2, 3)


def shortest(edges, count, start):
    """The least cost from node `start` to each of `count` nodes along edges (from, to, cost)."""
    rows, columns, costs = np.array(edges).T
    graph = coo_array((costs, (rows.astype(int), columns.astype(int))), shape=(count, count))
    return dijkstra(graph.tocsr(), indices=start)


def neighbours():
    """Yield (node, joint, next node) for every step of the grid."""
    for node in np.ndindex(SIZE):
        for joint in range(3):
            other = (*node[:joint], node[joint] + 1, *node[joint + 1 :])
            if other[joint] < SIZE[joint]:
                yield node, joint, other


def number(node, tick=0):
    return tick * np.prod(SIZE) + np.ravel_multi_index(node, SIZE)


def drawn(seed, share=0.6):
    rng = np.random.default_rng(seed)
    free = rng.random(SIZE) < share
    free[START] = True
    moves = []
    for joint in range(3):
        shape = [n - (k == joint) for k, n in enumerate(SIZE)]
        moves.append(rng.random(shape) < 0.8)
    return rng, free, moves


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("with_moves", [False, True])
def test_search_finds_the_fewest_steps(seed, with_moves):
    _, free, moves = drawn(seed)
    edges = []
    for node, joint, other in neighbours():
        if free[node] and free[other] and (moves[joint][node] or not with_moves):
            edges += [(number(node), number(other), 1), (number(other), number(node), 1)]
    wanted = shortest(edges, free.size, number(START)).reshape(SIZE)
    wanted[~free] = np.inf
    steps = breadth_first(free, START, moves if with_moves else None)
    np.testing.assert_array_equal(np.where(steps[INSIDE] < NEVER, steps[INSIDE], np.inf), wanted)
    beyond = np.ones(steps.shape, dtype=bool)
    beyond[INSIDE] = False
    assert (steps[beyond] == NEVER).all() and 40 < np.isfinite(wanted).sum() < free.size


@pytest.mark.parametrize("seed", range(6))
def test_search_ends_at_the_first_goal(seed):
    rng, free, moves = drawn(seed)
    goals = rng.random(SIZE) < 0.03
    every = breadth_first(free, START, moves)[INSIDE]
    first = every[goals].min()
    steps = breadth_first(free, START, moves, goals)[INSIDE]
    np.testing.assert_array_equal(steps, np.where(every <= first, every, NEVER))
    none = breadth_first(free, START, moves, np.zeros(SIZE, dtype=bool))[INSIDE]
    np.testing.assert_array_equal(none, every)


@pytest.mark.parametrize("seed", range(6))
def test_path_traced_back_has_the_fewest_steps_and_most_clearance(seed):
    rng, free, _ = drawn(seed)
    steps, room = breadth_first(free, START), rng.random(SIZE)
    for node in map(tuple, np.argwhere(steps[INSIDE] < NEVER).tolist()):
        fewest = int(steps[node])
        way = way_back([steps] * (fewest + 1), node, room)
        assert tuple(way[0]) == START and tuple(way[-1]) == node and len(way) == fewest + 1
        assert (abs(np.diff(way, axis=0)).sum(axis=-1) == 1).all()
        assert all(free[tuple(each)] for each in way)
        for here, before in itertools.pairwise(way[::-1]):
            around = [
                tuple(here + side * np.eye(3, dtype=int)[joint])
                for joint, side in itertools.product(range(3), (-1, 1))
            ]
            nearer = [
                other
                for other in around
                if min(other) >= 0 and steps[other] == steps[tuple(here)] - 1
            ]
            assert room[tuple(before)] == max(room[other] for other in nearer)


def test_search_can_leave_a_blocked_start():
    free = np.ones(SIZE, dtype=bool)
    free[START] = False
    steps = breadth_first(free, START)
    assert steps[START] == 0 and steps[0, 0, 0] == sum(START)


@pytest.mark.parametrize("seed", range(4))
def test_free_postures_can_change_with_time(seed):
    """The fewest steps by tick t equal the least cost in a graph whose nodes are postures at ticks,
    where waiting costs nothing.
    """
    rng, ticks = np.random.default_rng(seed), 9
    free = rng.random((ticks, *SIZE)) < 0.6
    free[0] = True
    edges = []
    for tick in range(1, ticks):
        for node in np.ndindex(SIZE):
            if free[tick][node]:
                # a cost of 0 would mean no edge
                edges.append((number(node, tick - 1), number(node, tick), 1e-9))
        for node, _, other in neighbours():
            for a, b in ((node, other), (other, node)):
                if free[tick][b]:
                    edges.append((number(a, tick - 1), number(b, tick), 1))
    wanted = shortest(edges, free.size, number(START)).reshape(free.shape)
    steps = [at_start(SIZE, START)]
    for tick in range(1, ticks):
        steps.append(spread(steps[-1], blocked(free[tick], SIZE)))
        got = np.where(steps[-1][INSIDE] < NEVER, steps[-1][INSIDE], np.inf)
        np.testing.assert_allclose(got, wanted[tick], rtol=0, atol=1e-7)
    waited = 0
    for node in map(tuple, np.argwhere(steps[-1][INSIDE] < NEVER).tolist()):
        way = way_back(steps, node)
        turned = abs(np.diff(way, axis=0)).sum(axis=-1)
        assert tuple(way[0]) == START and tuple(way[-1]) == node and len(way) == ticks
        assert turned.max() <= 1 and turned.sum() == steps[-1][node]
        assert all(free[tick][tuple(each)] for tick, each in enumerate(way))
        waited += (turned == 0).sum()
    assert waited > 20
