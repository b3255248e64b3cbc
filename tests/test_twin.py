"""The twin: the page's own kinematics in JavaScript, compared with Python in a real browser.

Everything runs twice: with the browser's sines, cosines and arctangents, and with noise in their
last bit, since another browser may round differently. The same rows exist in either case; each test
states the tolerance of the values.
"""

import base64
import importlib
import json
import re
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from machines import UR5

import robokin.show
from robokin import (
    IRB140,
    ITMO6R,
    PUMA560,
    SCARA,
    Arm,
    Quaternion,
    ScaraPose,
    Transform,
    blend,
    deg,
    differentiate,
    distance_from_singularity,
    explain,
    follow,
    itmo_arm,
    lin,
    lin_lin,
    linear,
    loader_arm,
    nearest,
    ptp,
    quintic,
    record,
    representative,
    scara_arm,
    spbu_arm,
    three_lever,
    trapezoidal,
    two_link,
    within,
)
from robokin.arms import dh_links, unwrapped
from robokin.arms.dexterity import velocity_ellipsoid
from robokin.arms.elbow import elbow_arm
from robokin.arms.geometry import ROUNDING
from robokin.jobs.steppers import moves
from robokin.motion import refined_maximum
from robokin.motion.recording import FEW, LEAP
from robokin.show.numbers import scale
from robokin.show.twin import arm_data

SCRIPTS = Path(robokin.show.__file__).parent / "js"
TURN = 2 * np.pi
# axis 1 is not in the plane of the arm, so the end point cannot come near axis 1
BESIDE = elbow_arm(
    "Beside",
    dh_links(a=[0.05, 0.43, 0.38], alpha=np.array([90, 0, 0]) * deg, d=[0.6, 0.15, 0]),
    np.array([(-170, 170), (-100, 200), (-150, 150)]) * deg,
)
ARMS = {
    "IRB140": IRB140,
    "PUMA560": PUMA560,
    "ITMO6R": ITMO6R,
    "wrist, equal levers": itmo_arm(0.1, 0.2, 0.2, 0.1),
    "SCARA": SCARA,
    "SCARA, equal levers": scara_arm("equal", 1, 2.5, 2.5, SCARA.limits),
    "spbu": spbu_arm(0.4, 0.3),
    "loader": loader_arm(3.1, 2.2),
    "elbow, equal levers": spbu_arm(0.3, 0.3),
    "elbow, beside": BESIDE,
    "two links": two_link(0.3, 0.45, base=(0.1, -0.2)),
    "two links, equal": two_link(0.25, 0.25),
}
SHARES = {"postures": 4000, "places": 3000, "singular": 1200, "border": 1200, "far": 600}
every_arm = pytest.mark.parametrize("name", ARMS)

PAGE = """async () => {
  const names = ["angles", "kinematics", "rotations", "dexterity", "geometries", "branches",
                 "levers", "motion", "recorded", "ticks", "target_explorer"];
  for (const name of names)
    Object.assign(window, await import(`/${name}.js`));
  window.f64 = text => new Float64Array(Uint8Array.from(atob(text), c => c.charCodeAt(0)).buffer);
  window.b64 = numbers => {
    const bytes = new Uint8Array(Float64Array.from(numbers).buffer);
    let text = "";
    for (let i = 0; i < bytes.length; i += 32768)
      text += String.fromCharCode(...bytes.subarray(i, i + 32768));
    return btoa(text);
  };
  // a flat array as rows of n, these as blocks of m, and so on
  window.nested = (flat, ...sizes) => sizes.reduce((all, n) =>
    Array.from({length: all.length / n}, (_, i) => all.slice(n * i, n * i + n)), Array.from(flat));
  window.posed = ([x, y, z, ...rest]) => rest.length === 4 ? {place: [x, y, z], rotation: rest}
    : rest.length ? {place: [x, y, z], angle: rest[0]} : {place: [x, y, z]};
  window.unposed = pose => [...pose.place, ...(pose.rotation || []),
                            ...(pose.angle === undefined ? [] : [pose.angle])];
}"""
NOISE = """{
  let seed = 1;
  const noisy = f => (...x) => {
    seed = seed * 48271 % 2147483647;
    return f(...x) * (1 + (seed % 3 - 1) * Number.EPSILON);
  };
  for (const name of ["sin", "cos", "atan2"]) Math[name] = noisy(Math[name]);
}"""


class Twin:
    """The scripts in a page: `twin(body, arm, *arrays, shape=...)` runs the body of a JavaScript
    function of the arm and of flat arrays a, b, c, d, and returns its values as an array of that
    shape.
    """

    def __init__(self, page, noisy):
        self.page, self.noisy = page, noisy

    def __call__(self, body, arm, *arrays, shape):
        given = [
            base64.b64encode(np.ascontiguousarray(a, "<f8").tobytes()).decode() for a in arrays
        ]
        text = self.page.evaluate(
            f"([arm, texts]) => {{ const [a, b, c, d] = texts.map(f64); return b64((() => {{ {body}"
            " })()); }",
            [arm and arm_data(arm), given],
        )
        return np.frombuffer(base64.b64decode(text), "<f8").reshape(shape)


@pytest.fixture(scope="module", params=["exact", "noisy"])
def twin(browser, request):
    page = browser.new_page()
    page.route(
        "http://twin.test/*",
        lambda route: (
            route.fulfill(body="<title>twin</title>", content_type="text/html")
            if route.request.url.endswith("/")
            else route.fulfill(
                body=(SCRIPTS / route.request.url.rsplit("/", 1)[1]).read_text("utf-8"),
                content_type="text/javascript",
            )
        ),
    )
    if request.param == "noisy":
        page.add_init_script(NOISE)
    page.goto("http://twin.test/")
    page.evaluate(PAGE)
    yield Twin(page, request.param == "noisy")
    page.close()


def close(got, want, tolerance, modulo=None):
    """Assert that NaN is in the same places, that the other values agree within the tolerance, and
    that some values are not NaN.
    """
    assert got.shape == want.shape
    missing = np.isnan(want)
    assert (np.isnan(got) == missing).all() and not missing.all()
    off = abs(got - want)[~missing]
    if modulo:
        off = np.minimum(off, abs(modulo - off))
    assert off.max() <= tolerance, f"off by {off.max():.3g}"


# --- Poses of all kinds --------------------------------------------------------------------------


def tiny(rng, n):
    """Zeros and small values of either sign, down to rounding errors; none is a power of ten, where
    the wording of explanations changes.
    """
    size = rng.choice([-3.0, 3.0], n) * 10.0 ** -rng.integers(1, 17, n)
    return np.where(rng.random(n) < 0.25, 0.0, size)


def beyond(rng, n):
    """Distances beyond a limit of the workspace, as fractions of the reach: values of all sizes,
    and values near and at the tolerance of 1e-12, where the last bit of a distance decides.
    """
    size = rng.choice([-1, 1], n) * 10.0 ** -rng.uniform(3, 16, n)
    size = np.where(rng.random(n) < 0.5, size, rng.uniform(-3, 3, n) * 1e-12)
    slack = rng.choice([-1e-12, 0.0, 1e-12], n)
    return np.where(rng.random(n) < 0.4, slack, size)


def rotations(rng, n):
    q = rng.normal(size=(n, 4))
    return Quaternion(q / np.linalg.norm(q, axis=-1, keepdims=True))


def measures(arm):
    """The lengths of both levers, the distance from axis 1 to the shoulder, the shoulder's height,
    and the offset of the arm's plane from axis 1.
    """
    solid = arm.geometry
    if hasattr(solid, "elbow"):
        e = solid.elbow
        return e.upper, e.fore, e.shoulder_x, e.shoulder_z, e.lateral
    if hasattr(solid, "l1"):
        return solid.l1, solid.l2, 0.0, 0.0, 0.0
    return solid.upper, solid.fore, 0.0, solid.height, 0.0


def places(arm, rng):
    """Positions of the point that the first joints move: a dict that maps each kind to an array of
    shape (n, 3).
    """
    upper, fore, ahead, height, lateral = measures(arm)
    flat = not hasattr(arm.geometry, "elbow")

    def around(n, distance):
        turn, lift = rng.uniform(-np.pi, np.pi, (2, n)) * [[1], [0 if flat else 1]]
        r, z = ahead + distance * np.cos(lift), height + distance * np.sin(lift)
        x = np.cos(turn) * r - np.sin(turn) * lateral
        return np.stack([x, np.sin(turn) * r + np.cos(turn) * lateral, z], axis=-1)

    n = SHARES["places"]
    some = {"places": around(n, 1.2 * arm.reach * rng.random(n) ** (1 / 3))}
    n = SHARES["border"]
    borders = np.where(rng.random(n) < 0.5, upper + fore, abs(upper - fore))
    some["border"] = around(n, borders + beyond(rng, n) * arm.reach)
    if lateral:  # some positions are as near to axis 1 as the arm can get
        turn, r = rng.uniform(-np.pi, np.pi, 400), abs(lateral) + beyond(rng, 400) * arm.reach
        some["border"][:400, :2] = np.stack([r * np.cos(turn), r * np.sin(turn)], axis=-1)
        some["border"][:400, 2] = height + rng.uniform(-0.9, 0.9, 400) * upper
    n = SHARES["far"]
    some["far"] = around(n, rng.uniform(1.6, 30, n) * arm.reach)
    some["far"][: n // 4] = 1000 * some["places"][: n // 4]  # millimetres taken for metres
    n = SHARES["singular"] // 2
    nearest_to_axis = abs(upper - fore) if flat else abs(lateral)
    turn, r = rng.uniform(-np.pi, np.pi, n), nearest_to_axis + tiny(rng, n) * arm.reach
    level = height + rng.uniform(-0.5, 0.5, n) * (not flat) * arm.reach
    some["on axis"] = np.stack([r * np.cos(turn), r * np.sin(turn), level], axis=-1)
    if hasattr(arm.geometry, "base"):
        for points in some.values():
            points[:, :2] += arm.geometry.base
            points[:, 2] = 0
        off = beyond(rng, 300)
        some["border"][:300, 2] = np.where(rng.random(300) < 0.5, 0, off * arm.reach)
    return some


def postures(arm, rng):
    low, high = arm.limits.T
    n, m = SHARES["postures"], SHARES["singular"] // 2
    q = rng.uniform(low, high, (n + m, len(low)))
    joint = 2 if hasattr(arm.geometry, "elbow") else 1
    straight = 0.0
    if joint == 2:
        e = arm.geometry.elbow
        straight = (e.upper_angle - e.fore_angle) * e.sign3
    half = np.where(rng.random(m) < 0.5, 0, np.pi)
    q[n:, joint] = straight + half + tiny(rng, m)
    if len(low) == 6:
        some = rng.random(m) < 0.5
        q[n:, 4] = np.where(some, half + tiny(rng, m), q[n:, 4])
        q[n:, joint] = np.where(some & (rng.random(m) < 0.8), 0.4, q[n:, joint])
    return {"postures": q[:n], "singular": q[n:]}


@cache
def poses(name):
    """Target poses for every kind of difficulty: a dict that maps each kind to a batch."""
    arm, rng = ARMS[name], np.random.default_rng(5)
    found = {kind: _asked(arm, arm.fk(q), rng) for kind, q in postures(arm, rng).items()}
    for kind, points in places(arm, rng).items():
        turn = rotations(rng, len(points))
        if arm.target is Transform:  # the positions are for the wrist centre
            wrist = arm.geometry.wrist
            back = turn @ Quaternion(wrist.from_flange) @ wrist.centre_from_flange
            found[kind] = Transform(turn, points - back)
        else:
            found[kind] = _asked(arm, Transform(turn, points), rng)
    return found


def _asked(arm, tool, rng):
    if arm.target is ScaraPose:
        return ScaraPose(tool.translation, rng.uniform(-10, 10, len(tool)))
    return tool if arm.target is Transform else tool.translation


def numbers(pose):
    """A batch of poses as an array for `posed`, of shape (n, 7), (n, 4) or (n, 3)."""
    if isinstance(pose, Transform):
        return np.concatenate([pose.translation, pose.rotation.wxyz], axis=-1)
    if isinstance(pose, ScaraPose):
        return np.concatenate([pose.position, pose.angle[..., None]], axis=-1)
    return pose


def matrices(pose):
    tool = pose.as_transform() if isinstance(pose, ScaraPose) else pose
    return tool.as_matrix()[..., :3, :]


# --- The inverse ---------------------------------------------------------------------------------

ROWS = "return nested(a, b[0]).flatMap(pose => ik(arm, posed(pose)).flat());"
TOOLS = "return nested(a, arm.chain.length).flatMap(q => fk(arm.chain, q));"
NEAR = "return nested(a, arm.chain.length).map(q => distance_from_singularity(arm, q));"


@every_arm
def test_page_computes_the_same_rows(twin, name):
    """The same rows exist, in order; the joint values differ only by the error of an arctangent."""
    arm = ARMS[name]
    assert sum(len(numbers(pose)) for pose in poses(name).values()) == sum(SHARES.values())
    for kind, pose in poses(name).items():
        pose = pose[:: 3 if twin.noisy else 1]
        want = arm.ik(pose)
        flat = numbers(pose)
        got = twin(ROWS, arm, flat, [flat.shape[-1]], shape=want.shape)
        if kind == "far":
            assert np.isnan(got).all() == np.isnan(want).all()
            assert (np.isnan(got) == np.isnan(want)).all()
            continue
        # pi and -pi are the same angle, and rounding errors decide which one is returned
        close(got, want, 1e-14 * (1 + 4 * twin.noisy), modulo=TURN)
        turning = abs(got[..., arm.turning])
        assert np.nanmax(turning) <= np.pi * (1 + 1e-15 * (1 + twin.noisy))
        if not twin.noisy and len(arm.links) in (3, 6):
            close(got, want, 1e-14)

        reaches = ~np.isnan(got).any(axis=-1)
        reaches[len(flat) // 8 :] = False
        q = got[reaches]
        tool = twin(TOOLS, arm, q, shape=(len(q), 3, 4))
        size = np.array([1, 1, 1, arm.reach])
        close(tool / size, matrices(arm.fk(q)) / size, 1e-14 * (1 + 2 * twin.noisy))
        asked = np.broadcast_to(np.arange(len(flat))[:, None], reaches.shape)[reaches]
        tolerance = {"singular": 1e-12, "border": 3e-12, "on axis": 3e-12}.get(kind, 1e-14)
        if arm.target is np.ndarray:
            close(tool[..., 3] / arm.reach, pose[asked] / arm.reach, tolerance)
        else:
            close(tool / size, matrices(pose[asked]) / size, tolerance)
        some = q[:200]
        close(
            twin(NEAR, arm, some, shape=len(some)),
            distance_from_singularity(arm, some),
            1e-14,
        )


@pytest.mark.parametrize("name", ["IRB140", "PUMA560"])
def test_page_finds_the_same_usable_rows(twin, name):
    """Compare 1000 targets. In Python, every whole turn of a joint is compared with its limits."""
    arm, rng = ARMS[name], np.random.default_rng(31)
    pose = Transform(rotations(rng, 1000), rng.uniform(-0.8, 0.8, (1000, 3)) + [0, 0, 0.6])
    got = twin(
        "const turning = [0, 1, 2, 3, 4, 5], q = turning.map(() => 0); return nested(a, 7).flatMap("
        "pose => foundAt({arm, turning}, {...posed(pose), q, wanted: -1}).usable.map(Number));",
        arm,
        numbers(pose),
        shape=(1000, 8),
    )
    q = arm.ik(pose)[..., None] + TURN * np.arange(-2, 3)
    low, high = arm.limits[:, :1], arm.limits[:, 1:]
    usable = ((q >= low) & (q <= high)).any(axis=-1).all(axis=-1)
    assert (got == usable).all() and {0, 2, 4, 6, 8} <= set(usable.sum(axis=-1).tolist())


# --- Choice of rows ------------------------------------------------------------------------------


def half_turns(arm, rng, *shape):
    """Rows whose joint values differ by quarter turns, so that half a turn is exactly between two
    values and many rows are equally near. Some rows are missing.
    """
    q = rng.integers(-8, 9, (*shape, len(arm.links))) * (np.pi / 2)
    q[..., arm.prismatic] = rng.integers(-4, 5, q[..., arm.prismatic].shape) * 0.05
    q[rng.random(shape) < 0.15] = np.nan
    return q


def at_limits(arm, rng, n):
    """Joint values at a limit, beyond it by about the tolerance, or whole turns from these."""
    slack = rng.choice([0, 1e-9, -1e-9, 0.9e-9, 1.1e-9, -1.1e-9, 0.1, -0.1], (n, len(arm.links)))
    end = rng.integers(0, 2, slack.shape)
    q = arm.limits[np.arange(len(arm.links)), end] + slack
    return q + np.where(arm.prismatic, 0, TURN) * rng.integers(-2, 3, slack.shape)


@every_arm
def test_page_chooses_the_same_joint_values(twin, name):
    """`within`, `representative`, `unwrapped` and `nearest` agree with Python to the last bit,
    since they use only + - * / and rounding.
    """
    arm, rng = ARMS[name], np.random.default_rng(6)
    n = len(arm.links)
    limits = at_limits(arm, rng, 500)
    limits[:20, 0] = np.nan
    q = np.concatenate([limits, half_turns(arm, rng, 500), rng.uniform(-9, 9, (500, n))])
    near = np.nan_to_num(np.roll(q, 7, axis=0))
    body = "const n = arm.limits.length, q = nested(a, n), near = nested(b, n); return "
    inside = twin(
        body + "q.flatMap(row => within(arm, row).map(Number));", arm, q, near, shape=q.shape
    )
    assert (inside.astype(bool) == within(arm, q)).all()
    assert inside.any()
    got = twin(body + "q.flatMap(row => representative(arm, row));", arm, q, near, shape=q.shape)
    close(got, representative(arm, q), 0)
    got = twin(
        body + "q.flatMap((row, i) => unwrapped(arm, row, near[i]));", arm, q, near, shape=q.shape
    )
    close(got, unwrapped(arm, q, near), 0)

    flat = arm.ik(poses(name)["postures"][:500])
    for rows in (half_turns(arm, rng, 500, 4), flat):
        here = near[: len(rows)]
        got = twin(
            "const n = arm.limits.length, here = nested(b, n);"
            "return nested(a, n, c[0]).flatMap((rows, i) => nearest(arm, rows, here[i]));",
            arm,
            rows,
            here,
            [rows.shape[1]],
            shape=here.shape,
        )
        close(got, nearest(arm, rows, here), 0)


def follows(twin, arm, rows, starts):
    """Run `follow` on rows of shape (motions, samples, rows, n), each motion from its own row."""
    motions, samples, count, n = rows.shape
    body = (
        "const [samples, count, n] = b;"
        "return nested(a, n, count, samples).flatMap((rows, i) => follow(arm, rows, c[i]).flat());"
    )
    return twin(body, arm, rows, [samples, count, n], starts, shape=(motions, samples, n))


@every_arm
def test_page_follows_the_same_rows(twin, name):
    """Motions follow the same rows as in Python: across missing rows, from and through
    singularities, and with half turns.
    """
    arm, rng = ARMS[name], np.random.default_rng(7)
    rows = half_turns(arm, rng, 60, 12, len(arm.branches))
    rows[:10, :4] = np.nan  # motions without a first posture
    starts = rng.integers(0, len(arm.branches), 60)
    want = np.stack([follow(arm, r, k) for r, k in zip(rows, starts.tolist(), strict=True)])
    close(follows(twin, arm, rows, starts), want, 1e-13)

    rows = np.stack([arm.ik(motion(name, i)) for i in range(24)])
    starts = rng.integers(0, len(arm.branches), 24)
    want = np.stack([chained(name, i, row) for i, row in enumerate(starts.tolist())])
    assert np.isnan(want).any()
    close(follows(twin, arm, rows, starts), want, 1e-13)


@cache
def corners(name, i):
    """Three poses of a motion with random joint values; some motions lead through a wrist or
    shoulder singularity, some begin in a posture with round angles, some go out of reach.
    """
    arm, rng = ARMS[name], np.random.default_rng(100 + i)
    low, high = arm.limits.T
    q = rng.uniform(low, high)
    q = q + np.cumsum(rng.normal(size=(3, len(low))) * 0.4 * np.where(arm.prismatic, 0.1, 1), 0)
    if i % 4 == 1 and len(low) == 6:
        q[:2, 4], q[2, 4] = 0, 0.3
    if i % 4 == 2 and len(low) == 6:
        q[1, :4], q[1, 4], q[1, 5] = q[0, :4] + 0.05, -q[0, 4], q[0, 5]
    if i % 4 == 3:
        q[0] = np.round(q[0] / (np.pi / 4)) * (np.pi / 4) * ~arm.prismatic
    tool = arm.fk(q)
    if i % 6 == 5:
        tool = Transform(tool.rotation, tool.translation * [[1], [2.2], [1]])
    if i % 8 == 7:  # over axis 1
        tool = Transform(tool.rotation, tool.translation * [[1, 1, 1], [1e-9, 0, 1], [-1, -1, 1]])
    pose = _asked(arm, tool, rng)
    return pose if arm.target is not np.ndarray else Transform(translation=pose)


@cache
def motion(name, i, samples=61):
    a, b, c = corners(name, i)
    s = quintic(1.0)(np.linspace(0, 1, samples))
    return blend(a, b, c, [0.0, 0.1, 0.25, 0.5][i % 4], s, ["parabola", "quintic"][i % 2])


@cache
def chained(name, i, row):
    return follow(ARMS[name], ARMS[name].ik(motion(name, i)), row)


@every_arm
def test_page_computes_the_same_motions(twin, name):
    """The test compares blend, inverse and `follow` in sequence; near a singularity the inverse
    amplifies rounding errors.
    """
    arm = ARMS[name]
    body = (
        "const poses = nested(a, b[0]).map(posed), law = quintic(1);"
        "const rows = Array.from(c, t => ik(arm, "
        "  blend(...poses, b[1], law(t), b[2] ? 'quintic' : 'parabola')));"
        "return follow(arm, rows, b[3]).flat();"
    )
    t, got, want = np.linspace(0, 1, 61), [], []
    for i in range(16):
        flat = numbers(corners(name, i))
        if arm.target is np.ndarray:
            flat = flat[:, :3]
        row = i % len(arm.branches)
        want.append(chained(name, i, row))
        given = [flat.shape[1], [0.0, 0.1, 0.25, 0.5][i % 4], i % 2, row]
        got.append(twin(body, arm, flat, given, t, shape=want[-1].shape))
    # with noise, a joint that starts half a turn away can start on either side
    close(np.array(got), np.array(want), 1e-6, modulo=TURN if twin.noisy else None)


# --- Rotations, velocities, paths ----------------------------------------------------------------


def test_page_computes_the_same_rotations(twin):
    """The test compares products, conversions to matrices and back, and slerp, also of equal,
    nearly equal and opposite rotations.
    """
    rng = np.random.default_rng(8)
    n = 2000
    a, b = rotations(rng, n), rotations(rng, n)
    wxyz = b.wxyz.copy()
    wxyz[:100] = a.wxyz[:100] * rng.choice([-1, 1], (100, 1))
    axis = rng.normal(size=(400, 3))
    axis /= np.linalg.norm(axis, axis=-1, keepdims=True)
    angle = np.concatenate([10.0 ** -rng.uniform(0, 16, 200), np.full(200, np.pi)])
    wxyz[100:500] = (a[100:500] @ Quaternion.from_angle_axis(angle, axis)).wxyz
    wxyz[500:505] = [(1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1), (0.5, 0.5, 0.5, 0.5)]
    b, s = Quaternion(wxyz), rng.random(n)
    s[::50], s[1::50] = 0, 1
    body = "const p = nested(a, 4), q = nested(b, 4); return p.flatMap((one, i) => "
    given = None, a.wxyz, b.wxyz, s
    close(twin(body + "product(one, q[i]));", *given, shape=(n, 4)), (a @ b).wxyz, 0)
    got = twin(body + "matrix(q[i], one.slice(1)));", *given, shape=(n, 3, 4))
    close(got[..., :3], b.as_matrix(), 0)
    close(got[..., 3], a.wxyz[:, 1:], 0)
    got = twin(body + "quaternion(matrix(q[i])));", *given, shape=(n, 4))
    close(got, Quaternion.from_matrix(b.as_matrix()).wxyz, 1e-15)
    # half a turn has two directions, and the last bit of the product decides which of them is taken
    got = twin(body + "slerp(one, q[i], c[i]));", *given, shape=(n, 4))
    close(got, a.slerp(b, s).wxyz, 1e-14)


@every_arm
def test_page_computes_the_same_velocities(twin, name):
    """The test compares the Jacobian and the pose of a posture."""
    arm, rng = ARMS[name], np.random.default_rng(9)
    n = len(arm.links)
    q = rng.uniform(*arm.limits.T, (200, n))
    q[:40] = np.round(q[:40] / (np.pi / 4)) * (np.pi / 4)
    body = "return nested(a, arm.limits.length).flatMap(q => "
    got = twin(body + "jacobian(arm.chain, q).flat());", arm, q, shape=(200, 6, n))
    close(got, arm.jacobian(q), 1e-14 * max(1, arm.reach))

    size = {Transform: 7, ScaraPose: 4, np.ndarray: 3}[arm.target]
    got = twin(body + "unposed(pose(arm, q)));", arm, q, shape=(200, size))
    tool = arm.fk(q)
    close(got[:, :3] / arm.reach, tool.translation / arm.reach, 1e-14)
    if size == 7:
        close(Quaternion(got[:, 3:]).angle_to(tool.rotation), np.zeros(200), 3e-14)
    if size == 4:
        close(np.cos(got[:, 3] - q[:, :3].sum(axis=-1)), np.ones(200), 1e-14)


@every_arm
def test_page_computes_the_same_ellipsoids(twin, name):
    """The ellipsoid of the free tool has the singular values of J_v, and that of the held tool has
    those of J_v N, where N spans the null space of J_w; this also holds in singular postures.
    """
    arm, rng = ARMS[name], np.random.default_rng(10)
    n = len(arm.links)
    q = rng.uniform(*arm.limits.T, (1000, n))
    q[:100] = np.round(q[:100] / (np.pi / 4)) * (np.pi / 4)
    q[100:200, -2:] = 0  # the singularity of a spherical wrist
    jacobian = arm.jacobian(q) * np.where(arm.prismatic, arm.reach, 1)
    for held in (False, True):
        axes = twin(
            "return nested(a, arm.limits.length).flatMap(q => "
            f"ellipsoid(arm, q, {str(held).lower()}).flat());",
            arm,
            q,
            shape=(1000, 3, 3),
        )
        for k, (move, turn) in enumerate(zip(jacobian[:, :3], jacobian[:, 3:], strict=True)):
            if held and n > 3:
                _, sizes, basis = np.linalg.svd(turn)
                move = move @ basis[(sizes > 1e-9 * sizes.max()).sum() :].T
            close(axes[k].T @ axes[k], move @ move.T, 1e-13 * max(1, arm.reach) ** 2)
            wanted = np.zeros(3)
            values = np.linalg.svd(move, compute_uv=False)
            wanted[: len(values)] = values
            close(np.linalg.norm(axes[k], axis=-1), wanted, 1e-13 * max(1, arm.reach))
        if held:
            lengths = np.linalg.norm(velocity_ellipsoid(arm, q), axis=-2)
            close(np.linalg.norm(axes, axis=-1), lengths, 1e-11 * max(1, arm.reach))


@pytest.mark.parametrize("kind", ["Transform", "ScaraPose", "point"])
def test_page_computes_the_same_paths(twin, kind):
    """The paths are straight, have two straight parts, or are blended with either corner; for s
    outside [0, 1] they stay at an end.
    """
    rng = np.random.default_rng(10)
    n, s = 60, np.array([0, 0.5, 1, 0.25, 0.75, 0.5 - 1e-16, *rng.random(30)])
    place = rng.normal(size=(3, n, 3))
    poses = {
        "Transform": [Transform(rotations(rng, n), p) for p in place],
        "ScaraPose": [ScaraPose(p, rng.uniform(-9, 9, n)) for p in place],
        "point": [Transform(translation=p) for p in place],
    }[kind]
    width = {"Transform": 7, "ScaraPose": 4, "point": 3}[kind]
    fraction = rng.uniform(0, 0.5, n)
    fraction[:6] = [0, 0.5, 0.25, 1e-9, 0, 0.5]
    a, b, c = (pose[:, None] for pose in poses)
    flat = np.stack([numbers(pose)[:, :width] for pose in poses], axis=1)
    body = (
        "return nested(a, c[0], 3).flatMap(([p, q, r], i) => Array.from(d).flatMap(s => unposed("
        "  {})));"
    )
    ways = {
        "lin(posed(p), posed(r), s)": lin(a, c, s),
        "lin_lin(posed(p), posed(q), posed(r), s)": lin_lin(a, b, c, s),
        "blend(posed(p), posed(q), posed(r), b[i], s)": blend(a, b, c, fraction[:, None], s),
        "blend(posed(p), posed(q), posed(r), b[i], s, 'quintic')": blend(
            a, b, c, fraction[:, None], s, corner="quintic"
        ),
    }
    for call, want in ways.items():
        got = twin(
            body.replace("{}", call), None, flat, fraction, [width], s, shape=(n, len(s), width)
        )
        close(got, numbers(want)[..., :width], 1e-14)
    outside = twin(
        body.replace("{}", "lin(posed(p), posed(r), s)"),
        None,
        flat,
        fraction,
        [width],
        [-1e-13, 1 + 1e-13],
        shape=(n, 2, width),
    )
    close(outside, numbers(lin(a, c, [0, 1]))[..., :width], 1e-14)


def test_page_computes_the_same_laws_and_derivatives(twin):
    """The test compares point-to-point motions, the time laws, and speeds and accelerations from
    even and uneven samples.
    """
    rng = np.random.default_rng(11)
    q, s = rng.normal(size=(2, 6)), rng.random(40)
    got = twin(
        "return c.length, Array.from(c).flatMap(s => ptp(Array.from(a), Array.from(b), s));",
        None,
        *q,
        s,
        shape=(40, 6),
    )
    close(got, ptp(*q, s), 0)
    t = np.concatenate([[-1, 0, 3, 4], rng.uniform(0, 3, 200)])
    for law, call in (
        (linear(3), "linear(3)"),
        (trapezoidal(3), "trapezoidal(3)"),
        (trapezoidal(3, 0.5), "trapezoidal(3, 0.5)"),
        (trapezoidal(3, 0.1), "trapezoidal(3, 0.1)"),
        (quintic(3), "quintic(3)"),
    ):
        close(twin(f"return Array.from(a, {call});", None, t, shape=t.shape), law(t), 1e-15)
    for t in (np.linspace(0, 2, 81), np.cumsum(rng.uniform(0.01, 0.05, 81)), np.arange(3) / 4):
        values = np.sin(3 * t[:, None] + np.arange(4))
        for missing in (False, True):
            if missing and len(t) > 9:
                values[[20, 21, 50]] = np.nan
            for order in (1, 2):
                got = twin(
                    "return differentiate(nested(a, 4), Array.from(b), c[0]).flat();",
                    None,
                    values,
                    t,
                    [order],
                    shape=values.shape,
                )
                rounding = 1e-15 / np.diff(t).min() ** order
                close(got, differentiate(values, t, order), 10 * rounding)


def test_page_refines_the_same_maxima(twin):
    """Page and Python refine the maxima of a sine, of a corner and of a partly undefined function
    in the same steps.
    """
    for low, high, decimals in ((0, 3, 1), (0.4, 1.9, 3), (-2, -0.7, 5)):
        got = twin(
            "return [x => Math.sin(3 * x), x => -Math.abs(x - 0.6), x => (x < 1 ? x : NaN)].map("
            "f => Object.values(refinedMaximum(f, ...a))).flat();",
            None,
            [low, high, decimals],
            shape=(3, 2),
        )
        want = [
            refined_maximum(f, low, high, decimals)
            for f in (
                lambda x: np.sin(3 * x),
                lambda x: -abs(x - 0.6),
                lambda x: np.where(x < 1, x, np.nan),
            )
        ]
        value, at = np.transpose(want)
        close(got[:, 0], value, 1e-15)
        # rounding errors may decide which of two equal samples next to the maximum counts
        close(got[:, 1], at, 10.0 ** -(decimals + 1))
    for nothing in ("() => NaN", "x => 1 / Math.abs(x - Math.SQRT1_2)"):
        got = twin(f"return Object.values(refinedMaximum({nothing}, 0, 1, 2));", None, [0], shape=2)
        assert np.isnan(got).all()


def test_page_searches_only_above_what_is_known(twin):
    found = twin(
        "return [0.5, 2].flatMap(known => "
        "Object.values(refinedMaximum(x => Math.sin(3 * x), 0, 1, 3, known)));",
        None,
        [0],
        shape=(2, 2),
    )
    close(found[0], np.array([1, np.pi / 6]), 1e-4)
    assert found[1, 0] == 2 and np.isnan(found[1, 1])


RULES = f"{{least: {LEAP}, few: {FEW}}}"  # the rules for jumps in position


def test_page_finds_the_same_jumps_in_position(twin):
    """The motions are sawteeth of all sizes on ramps, sines and noise, with gaps, evenly and
    unevenly sampled: the page finds the same jumps as `record`, joint by joint.
    """
    rng, found = np.random.default_rng(16), 0
    for k in range(60):
        t = np.cumsum(rng.uniform(0.5 + 0.5 * (k % 2), 1.5 - 0.5 * (k % 2), 90)) * 0.02
        q = rng.normal(size=4) * np.sin(rng.uniform(0, 6, 4) * t[:, None])
        q += (k % 3 == 0) * 10.0 ** rng.uniform(-5, -1) * rng.normal(size=q.shape)
        for _ in range(6):
            q[rng.integers(90) :, rng.integers(4)] += rng.normal() * 10.0 ** rng.uniform(-3, 1)
        q[rng.integers(90), rng.integers(4)] += 0.4  # one outlying sample
        q[rng.integers(90, size=k % 4)] = np.nan
        want = np.zeros((89, 4))
        for leap in record(SCARA, t, q).leaps:
            want[leap.first] = leap.by != 0
        got = twin(
            f"return leaps(nested(a, 4), Array.from(b), arm.prismatic, {RULES}).flat();",
            SCARA,
            np.where(np.isnan(q).any(axis=-1)[:, None], np.nan, q),
            t,
            shape=(89, 4),
        )
        assert np.array_equal(got, want)
        found += want.sum()
    assert found > 150


def test_page_computes_the_same_recordings(twin):
    """For motions with corners, jumps and gaps, the page finds the same speeds, accelerations,
    breaks and jumps in speed as `record`.
    """
    rng, corners, broken = np.random.default_rng(17), 0, 0
    for k in range(60):
        t = np.cumsum(rng.uniform(0.5 + 0.5 * (k % 2), 1.5 - 0.5 * (k % 2), 90)) * 0.02
        q = rng.normal(size=4) * np.sin(rng.uniform(0, 4, 4) * t[:, None])
        for _ in range(k % 4):
            at = rng.uniform(t[8], t[-8])  # between two samples
            at = t[rng.integers(8, 82)] if k % 3 else at  # on a sample
            q += rng.normal(size=4) * (rng.random(4) < 0.5) * np.maximum(t - at, 0)[:, None]
        if k % 5 == 0:
            q[rng.integers(90) :, 1] += 0.8
        if k % 7 == 0:
            q[rng.integers(90, size=3)] = np.nan
        ours = record(SCARA, t, q)
        jumps = np.full((6, 3), np.nan)
        for row, jump in zip(jumps, ours.jumps, strict=False):
            row[:] = jump.first, jump.last, jump.time
        want = np.concatenate([ours.v, ours.a], axis=1)
        got = twin(
            f"const all = record(nested(a, 4), Array.from(b), arm.prismatic, {RULES});"
            "const told = all.jumps.flatMap(({first, last, time}) => [first, last, time]);"
            "return [...all.v.flatMap((row, i) => [...row, ...all.a[i]]), ...all.gaps.map(Number),"
            " ...Array.from({length: 18}, (_, i) => told[i] ?? NaN)];",
            SCARA,
            q,
            t,
            shape=(90 * 8 + 89 + 18,),
        )
        assert np.array_equal(got[720:809], ours.gaps)
        assert np.allclose(got[809:].reshape(6, 3), jumps, rtol=1e-12, atol=0, equal_nan=True)
        greatest = np.nanmax(abs(want), initial=1.0)
        found = got[:720].reshape(90, 8)
        assert np.allclose(found, want, rtol=0, atol=1e-9 * greatest, equal_nan=True)
        corners, broken = corners + len(ours.jumps), broken + ours.gaps.sum()
    assert corners > 40 and broken > 30


def test_page_chooses_the_same_scales(twin):
    """The scales match Python's, which are Matplotlib's, for ranges of all sizes, ranges far from 0
    and empty ranges.
    """
    rng = np.random.default_rng(18)
    low = rng.normal(size=600) * 10.0 ** rng.uniform(-4, 4, 600)
    high = low + rng.uniform(0, 1, 600) * 10.0 ** rng.uniform(-5, 4, 600)
    low[::9], high[::11] = 0, np.maximum(low[::11], 0)
    high = np.maximum(low, high)
    ends = np.concatenate([np.stack([low, high], axis=-1), [(0, 0), (0, 5), (-180, 180), (7, 7)]])
    got = twin(
        "return nested(a, 2).flatMap(([low, high]) => scale(low, high));",
        None,
        ends,
        shape=(len(ends), 4),
    )
    close(got, np.array([scale(*pair) for pair in ends.tolist()]), 1e-12)


# --- Explanations --------------------------------------------------------------------------------

EXPLAIN = """([arm, list]) => list.map(([pose, row]) =>
  [explain(arm, posed(pose), row), Object.entries(singularities(arm, ik(arm, posed(pose))[row]))
    .filter(([, holds]) => holds).map(([name]) => name)])"""


@every_arm
def test_page_gives_the_same_explanations(twin, name):
    """For every reason, the sentences match those of Python's `explain`."""
    arm, rng = ARMS[name], np.random.default_rng(12)
    asked, want = [], []
    for kind, pose in poses(name).items():
        # the noise decides whether half a turn is shown as 180 or -180 degrees
        if twin.noisy and kind not in ("postures", "places", "far"):
            continue
        flat = numbers(pose)
        for i in rng.choice(len(flat), 40, replace=False).tolist():
            row = int(rng.integers(len(arm.branches)))
            words = explain(arm, pose[i], row)
            held = [] if "not exist" in words else arm.geometry.singularities(arm.ik(pose[i])[row])
            asked.append([flat[i].tolist(), row])
            want.append([words, [one for one in held if held[one]]])
    assert twin.page.evaluate(EXPLAIN, [arm_data(arm), asked]) == want
    if twin.noisy:
        return
    for part in ("is usable", "not usable", "not exist", "millimetres", "singularity", "past"):
        assert any(part in words for words, _ in want) or (part, name) in UNHEARD, part


# a range of a whole turn allows every angle, so no joint exceeds its limits
UNHEARD = {
    (part, name)
    for part in ("not usable", "past")
    for name in ARMS
    if np.ptp(ARMS[name].limits[ARMS[name].turning], axis=-1).min() >= TURN
}


def test_ties_are_rounded_to_even_as_in_python(twin):
    """A value exactly between two decimals becomes the even one: in Python 10.25 is
    shown as 10.2.
    """
    arm = two_link(0.5, 0.5)
    asked = [[[1 + gap, 0, 0], 0] for gap in (10.25, 10.75, 11.5, 12.25, 17.125, 25.75)]
    want = [explain(arm, np.array(point), row) for point, row in asked]
    got = twin.page.evaluate(
        EXPLAIN.replace("[explain(", "explain(").split(", Object")[0] + ")", [arm_data(arm), asked]
    )
    assert got == want and "10.2 m" in got[0] and "10.8 m" in got[1]


# --- Three levers --------------------------------------------------------------------------------


@pytest.mark.parametrize("lengths", [0.3, (0.27, 0.33, 0.18), (0.2, 0.15, 0.5), (0.5, 0.4, 0.1)])
def test_page_computes_the_same_postures_of_three_levers(twin, lengths):
    """The test compares the family of a point, its ends, and the least movement. An arctangent
    decides where the family ends, so points within rounding error of a limit of gamma are skipped.
    """
    arm, rng = three_lever(lengths), np.random.default_rng(13)
    L, n, borders = arm.lever, 1500, np.array([arm.geometry.inner, arm.reach]) / arm.lever
    r = np.concatenate([rng.uniform(0, 3.3, 1000), rng.choice(borders, 500) + beyond(rng, 500)])
    phi = rng.uniform(-np.pi, np.pi, n)
    points = L * r[:, None] * np.stack([np.cos(phi), np.sin(phi), 0 * phi], axis=-1)
    points[::97, 2] = beyond(rng, len(points[::97])) * L
    call = "return nested(a, 3).flatMap((point, i) => "
    for limited in (False, True):
        got = twin(
            call + f"alpha_range(arm, posed(point), {str(limited).lower()}));",
            arm,
            points,
            shape=(n, 2),
        )
        ends = np.stack(arm.alpha_range(points, limited), axis=-1)
        # where the range is a single alpha, rounding may exchange its two ends
        sure = np.ones(n, dtype=bool)
        if limited:
            free = np.stack(arm.alpha_range(points, False), axis=-1)
            narrow = free[:, 1] - free[:, 0] < 1e-6
            sure = ~narrow
        close(got[sure], ends[sure], 1e-7)
        inside = sure & (r > borders[0] + 0.001)
        close(got[inside], ends[inside], 1e-11)
    alpha = rng.uniform(0, 3.3, n)
    low = arm.alpha_range(points, False)[0]
    alpha[::3] = np.where(np.isnan(low), 1.0, low)[::3]
    alpha[::9] -= 0.5 * ROUNDING
    alpha[1::30] = np.pi + 0.5 * ROUNDING
    got = twin(call + "family(arm, posed(point), b[i]));", arm, points, alpha, shape=(n, 3))
    # an alpha slightly below the low end is clamped to it; near that end, beta varies as the square
    # root of the distance
    close(got, arm.family(points, alpha), 1e-7 if twin.noisy else 1e-14)
    exists = ~np.isnan(got[:, 0])
    close(arm.fk(got[exists]).translation[:, :2], points[exists, :2], 1e-12)
    for limited in (False, True):
        before = rng.uniform(0, np.pi, (n, 3))
        got = twin(
            f"const q = nested(b, 3); {call}least(arm, posed(point), q[i],"
            f" {str(limited).lower()}));",
            arm,
            points[:500],
            before[:500],
            shape=(500, 3),
        )
        q, S = arm.least(points[:500], before[:500], limited)
        # the sum is flat at its minimum, so half of the digits of alpha are uncertain there
        close(abs(got - before[:500]).sum(axis=-1), S, 1e-12)
        close(got, q, 1e-6)


def test_page_changes_the_lengths_of_levers_like_python(twin):
    """For other lengths the page computes the same data as Python."""
    arm, rng = arm_data(three_lever((0.3, 0.2, 0.4))), np.random.default_rng(15)
    for lengths in rng.uniform(0.1, 2, (20, 3)).tolist():
        got = twin.page.evaluate("([arm, levers]) => withLevers(arm, levers)", [arm, lengths])
        assert got == json.loads(json.dumps(arm_data(three_lever(lengths))))


# --- The data from Python ------------------------------------------------------------------------


LEVERS = three_lever(0.3), three_lever((0.27, 0.33, 0.18))


@pytest.mark.parametrize("arm", [*ARMS.values(), *LEVERS], ids=lambda arm: arm.name)
def test_data_have_full_precision(arm):
    """JSON can represent the data, and every number is preserved to the last bit."""
    data = arm_data(arm)
    assert json.loads(json.dumps(data, allow_nan=False)) == json.loads(json.dumps(data))
    back = json.loads(json.dumps(data))
    assert (np.array(back["limits"]) == arm.limits).all()
    for link, sent in zip(arm.links, back["chain"], strict=True):
        assert np.array(sent["before"]).tobytes() == link.before.as_matrix()[:3].tobytes()
        assert sent["axis"] == link.axis.tolist()
    assert back["geometry"]["kind"] and back["geometry"]["reach"] == arm.reach


class Own:
    links, target, reach = IRB140.links, Transform, 1.0


@pytest.mark.parametrize("arm", [Arm("Own", Own(), IRB140.limits), UR5], ids=lambda arm: arm.name)
def test_arm_with_an_unknown_geometry_has_no_inverse(twin, arm):
    """The page gets the chain and the limits, so it can turn the joints, but it has no inverse."""
    data = arm_data(arm)
    assert data["geometry"] == {"kind": None} and "branches" not in data
    q = np.random.default_rng(14).uniform(-1, 1, (20, 6))
    close(twin(TOOLS, arm, q, shape=(20, 3, 4)), matrices(arm.fk(q)), 1e-14)
    rows = q[:, None]
    got = twin("return follow(arm, nested(a, 6, 1), 0).flat();", arm, rows, shape=(20, 6))
    close(got, follow(arm, rows, 0), 1e-14)


def test_page_has_the_same_joint_and_the_same_tolerance_of_pulses():
    singular = importlib.import_module("robokin.show.singularity_explorer")  # not its function
    for script, name, value in (
        ("singularity_explorer", "JOINT", singular.JOINT),
        ("stepper_moves", "SLACK", moves.SLACK),
    ):
        text = (Path(robokin.show.__file__).parent / "js" / f"{script}.js").read_text()
        (found,) = re.findall(rf"^(?:const|  ) ?{name} = ([\d.e-]+)[,;]", text, re.M)
        assert float(found) == value
