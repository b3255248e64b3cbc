"""The twin: the page's own kinematics in JavaScript against Python, in a real browser.

Everything twice: with the browser's sines, cosines and arctangents as they are, and with noise in
their last bit, since another browser may round them otherwise. What exists is exactly equal all the
same; how near the numbers are says each test.
"""

import base64
import json
from functools import cache
from pathlib import Path

import numpy as np
import pytest

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
    mm,
    nearest,
    ptp,
    quintic,
    representative,
    scara_arm,
    spbu_arm,
    three_lever,
    trapezoidal,
    two_link,
    within,
)
from robokin.arms import dh_links, unwrapped
from robokin.arms.elbow import elbow_arm
from robokin.show.twin import arm_data

SCRIPTS = Path(robokin.show.__file__).parent / "js"
TURN = 2 * np.pi
# axis 1 does not go through the arm's plane, so that the point keeps away from it
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
    "SCARA, equal levers": scara_arm("equal", 0.2, 0.25, 0.25, SCARA.limits),
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
  for (const name of ["kinematics", "inverse", "motion"])
    Object.assign(window, await import(`/${name}.js`));
  window.f64 = text => new Float64Array(Uint8Array.from(atob(text), c => c.charCodeAt(0)).buffer);
  window.b64 = numbers => {
    const bytes = new Uint8Array(Float64Array.from(numbers).buffer);
    let text = "";
    for (let i = 0; i < bytes.length; i += 32768)
      text += String.fromCharCode(...bytes.subarray(i, i + 32768));
    return btoa(text);
  };
  // a flat array as rows of n, again and again: nested([1..12], 3, 2) is [[[1, 2], [3, 4]...
  window.nested = (flat, ...sizes) => sizes.reduceRight((all, n) =>
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
    function of the arm and of flat arrays a, b, c, d; the numbers it returns come back in a shape.
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
    """Missing numbers in the same places, the others within the tolerance, and some there."""
    assert got.shape == want.shape
    missing = np.isnan(want)
    assert (np.isnan(got) == missing).all() and not missing.all()
    off = abs(got - want)[~missing]
    if modulo:
        off = np.minimum(off, abs(modulo - off))
    worst = off.max()
    LARGEST[WHERE[0]] = max(LARGEST.get(WHERE[0], 0), worst)
    assert worst <= tolerance, f"off by {worst:.3g}"


LARGEST, WHERE = {}, [""]


# --- Poses of all kinds --------------------------------------------------------------------------


def tiny(rng, n):
    """Nothing, or a power of ten down to rounding, of either sign."""
    size = rng.choice([-1.0, 1.0], n) * 10.0 ** -rng.integers(1, 17, n)
    return np.where(rng.random(n) < 0.25, 0.0, size)


def beyond(rng, n):
    """How far past a border, in reaches: powers of ten and around the slack of 1e-12."""
    size = rng.choice([-1, 1], n) * 10.0 ** -rng.uniform(3, 16, n)
    size = np.where(rng.random(n) < 0.5, size, rng.uniform(-3, 3, n) * 1e-12)
    return np.where(rng.random(n) < 0.1, 0.0, size)


def rotations(rng, n):
    q = rng.normal(size=(n, 4))
    return Quaternion(q / np.linalg.norm(q, axis=-1, keepdims=True))


def measures(arm):
    """Both levers, the way from axis 1 to the shoulder, its height, how far the plane is beside."""
    solid = arm.geometry
    if hasattr(solid, "elbow"):
        e = solid.elbow
        return e.upper, e.fore, e.shoulder_x, e.shoulder_z, e.lateral
    if hasattr(solid, "l1"):
        return solid.l1, solid.l2, 0.0, 0.0, 0.0
    return solid.upper, solid.fore, 0.0, solid.height, 0.0


def places(arm, rng):
    """Where to bring what the first joints carry: kind -> (n, 3)."""
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
    if lateral:  # a part of them as near to axis 1 as the arm comes
        turn, r = rng.uniform(-np.pi, np.pi, 400), abs(lateral) + beyond(rng, 400) * arm.reach
        some["border"][:400, :2] = np.stack([r * np.cos(turn), r * np.sin(turn)], axis=-1)
        some["border"][:400, 2] = height + rng.uniform(-0.9, 0.9, 400) * upper
    n = SHARES["far"]
    some["far"] = around(n, rng.uniform(1.6, 30, n) * arm.reach)
    some["far"][: n // 4] *= 1000  # millimetres
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
    """Poses of the arm's kind for every kind of trouble: dict of kind -> batch."""
    arm, rng = ARMS[name], np.random.default_rng(5)
    found = {kind: _asked(arm, arm.fk(q), rng) for kind, q in postures(arm, rng).items()}
    for kind, points in places(arm, rng).items():
        turn = rotations(rng, len(points))
        if arm.target is Transform:  # so that the wrist centre comes to these places
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
    """A batch of poses as numbers for `posed`: (n, 7), (n, 4) or (n, 3)."""
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
def test_rows(twin, name):
    """Which rows exist is exactly equal, in order; the joints differ by what an arctangent may."""
    arm = ARMS[name]
    assert sum(len(numbers(pose)) for pose in poses(name).values()) == sum(SHARES.values())
    for kind, pose in poses(name).items():
        want = arm.ik(pose)
        flat = numbers(pose)
        got = twin(ROWS, arm, flat, [flat.shape[-1]], shape=want.shape)
        WHERE[0] = f"rows {twin.noisy}"
        if kind == "far":
            assert np.isnan(got).all() == np.isnan(want).all()
            assert (np.isnan(got) == np.isnan(want)).all()
            continue
        # pi and -pi are one angle; which of them atan2 decides, or its last bit where angles add
        close(got, want, 1e-14 * (1 + 4 * twin.noisy), modulo=TURN)
        turning = abs(got[..., arm.turning])
        assert np.nanmax(turning) <= np.pi * (1 + 1e-15 * (1 + twin.noisy))
        if not twin.noisy and len(arm.links) in (3, 6):
            close(got, want, 1e-14)

        reaches = ~np.isnan(got).any(axis=-1)
        reaches[len(flat) // 8 :] = False
        q = got[reaches]
        tool = twin(TOOLS, arm, q, shape=(len(q), 3, 4))
        WHERE[0] = f"fk twin {twin.noisy}"
        size = np.array([1, 1, 1, arm.reach])
        close(tool / size, matrices(arm.fk(q)) / size, 1e-14 * (1 + 2 * twin.noisy))
        asked = np.broadcast_to(np.arange(len(flat))[:, None], reaches.shape)[reaches]
        tolerance = {"postures": 1e-14, "places": 1e-14, "border": 3e-12}.get(kind, 1e-12)
        WHERE[0] = f"fk of rows {kind} {twin.noisy}"
        if arm.target is np.ndarray:
            close(tool[..., 3] / arm.reach, pose[asked] / arm.reach, tolerance)
        else:
            close(tool / size, matrices(pose[asked]) / size, tolerance)
        some = q[:200]
        WHERE[0] = f"near {twin.noisy}"
        close(
            twin(NEAR, arm, some, shape=len(some)),
            distance_from_singularity(arm, some),
            1e-14,
        )


def test_zz():
    for k, v in sorted(LARGEST.items()):
        print(k, f"{v:.2e}")
