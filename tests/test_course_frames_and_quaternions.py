"""The exercises of lab 01: correct answers in different styles pass, and mistakes are named."""

import functools
import re

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from robokin import Arm, Quaternion, Transform, deg, dh_links
from robokin.course import book, check, variant
from robokin.course.questions import chosen_option, filled

X, Y, Z = np.eye(3)
LAB = book.lab("frames_and_quaternions")
invert = np.linalg.inv


# --- Exercise 1: a part seen from the flange ------------------------------------------------------


def closed(q, d, a, alpha):
    c, s, ca, sa = np.cos(q), np.sin(q), np.cos(alpha), np.sin(alpha)
    return np.array([[c, -ca * s, sa * s, a * c], [s, ca * c, -sa * c, a * s],
                     [0, sa, ca, d], [0, 0, 0, 1]])  # fmt: skip


def flange(table, q, row=lambda r, x: closed(r[0] + x, *r[1:])):
    return functools.reduce(np.matmul, map(row, table, q))


def solved(table, q, part):
    return np.linalg.solve(flange(table, q), part)


def row_by_row(table, q, part):
    seen = part
    for row, joint in zip(table, q, strict=True):
        seen = invert(closed(row[0] + joint, *row[1:])) @ seen
    return seen.tolist()


def by_the_package(table, q, part):
    class Chain:
        links = dh_links(a=table[:, 2], alpha=table[:, 3], d=table[:, 1], theta=table[:, 0])
        target, reach = Transform, 1.0

    arm = Arm("table", Chain(), [[-7, 7]] * len(q))
    return arm.fk(q).inverse() @ Transform.from_matrix(part)


@pytest.mark.parametrize("answer", [solved, row_by_row, by_the_package])
def test_correct_poses_relative_to_the_flange_pass(answer):
    assert check("frames_and_quaternions.1", answer).holds


def only_turned(table, q, part):
    rotation = flange(table, q)[:3, :3]
    seen = np.eye(4)
    seen[:3, :3], seen[:3, 3] = rotation.T @ part[:3, :3], rotation.T @ part[:3, 3]
    return seen


def joined(table, q, part):
    seen = part
    for row, joint in reversed(list(zip(table, q, strict=True))):
        seen = invert(closed(row[0] + joint, *row[1:])) @ seen
    return seen


def in_a_library_call(table, q, part):
    offset, d, a, alpha = table.T
    arm = Arm("table", dh_links(a, alpha, d, offset), [(-7, 7)] * len(q))
    return arm.fk(q).inverse() @ Transform.from_matrix(part)


@pytest.mark.parametrize(
    ("name", "answer"),
    [
        ("the shift back is left out", only_turned),
        ("chained with Arm and dh_links", in_a_library_call),
        ("the chain from the wrong end", joined),
        ("the inverse of the product", lambda t, q, p: invert(flange(t, q) @ p)),
        ("from both sides", lambda t, q, p: invert(flange(t, q)) @ p @ flange(t, q)),
        ("matrices subtracted", lambda t, q, p: p - flange(t, q)),
        ("element-wise product", lambda t, q, p: invert(flange(t, q)) * p),
        ("degrees for radians", lambda t, q, p: invert(flange(t, np.radians(q))) @ p),
        ("sign", lambda t, q, p: invert(flange(t, -q)) @ p),
        ("another kind or shape", lambda t, q, p: (invert(flange(t, q)) @ p)[:3, 3]),
        ("d and a swapped", lambda t, q, p: invert(flange(t[:, [0, 2, 1, 3]], q)) @ p),
    ],
)
def test_mistakes_in_poses_relative_to_the_flange_are_named(name, answer):
    verdict = check("frames_and_quaternions.1", answer)
    assert not verdict.holds and verdict.mistake == name, verdict


# --- Exercise 2: a camera that looks at a part ----------------------------------------------------


CAMERA = "frames_and_quaternions.2"


def places(who):
    values = np.array(list(variant("frames_and_quaternions", who).values()))
    return values[:3], values[3:6]


def rolling(who):
    """The lamp in the camera's coordinates, and the quaternion of the roll, by SciPy."""
    values = np.array(list(variant("frames_and_quaternions", who).values()))
    return values[6:9], Rotation.from_rotvec([0, 0, values[9]])


def rolled(camera, who):
    """A complete answer with this camera, and with the roll and the lamp by SciPy."""
    lamp, turn = rolling(who)
    made = camera if isinstance(camera, Transform) else Transform.from_matrix(camera)
    whole = Rotation.from_matrix(made.rotation.as_matrix()) * turn
    quaternion = whole.as_quat(scalar_first=True)
    return camera, quaternion, made.translation + whole.apply(lamp)


def columns(z, flip=1):
    x = flip * np.cross(z, Z) / np.linalg.norm(np.cross(z, Z))
    return Quaternion.from_matrix(np.transpose([x, np.cross(z, x), z]))


def swung(yaw, tilt):
    return Quaternion.from_angle_axis(yaw, Z) @ Quaternion.from_angle_axis(tilt, X)


def test_camera_can_look_at_the_part_for_every_student():
    for k in range(200):
        who = f"student {k}"
        eye, part = places(who)
        z = (part - eye) / np.linalg.norm(part - eye)
        assert z[2] < 0 and np.hypot(*z[:2]) > 0.2, "the camera looks horizontally or straight down"
        yaw, rise = np.arctan2(z[1], z[0]), np.arcsin(z[2])
        turns = [columns(z), swung(yaw - np.pi / 2, rise - np.pi / 2)]
        answers = [Transform(turn, eye) for turn in turns]
        for answer in [*answers, answers[0].as_matrix()]:
            camera, turned, lamp = rolled(answer, who)
            for quaternion in turned, -turned, Quaternion(turned), turned.tolist():
                assert check(CAMERA, (camera, quaternion, lamp), who=who).holds
        wrong = {
            "looks away": Transform(columns(-z), eye),
            "upside down": Transform(columns(z, -1), eye),
            "the inverse rotation": Transform(turns[0].inverse(), eye),
            "the camera is at the part": Transform(turns[0], part),
            "mm for m": Transform(turns[0], 1000 * eye),
            "seen from the base": Transform(columns(part / np.linalg.norm(part)), eye),
            "the inverse pose": Transform(turns[0], eye).inverse(),
            "not rotated": Transform(Quaternion.identity(), eye),
            "a quarter turn off": Transform(swung(yaw, rise - np.pi / 2), eye),
            "looks up": Transform(swung(yaw - np.pi / 2, -rise - np.pi / 2), eye),
        }
        for name, answer in wrong.items():
            verdict = check(CAMERA, rolled(answer, who), who=who)
            assert not verdict.holds and verdict.mistake == name, (who, name, verdict)


def looking(who):
    """A right camera: its place and its rotation."""
    eye, part = places(who)
    return eye, columns((part - eye) / np.linalg.norm(part - eye))


def test_mistakes_in_the_roll_are_named_for_every_student():
    for who in (f"student {k}" for k in range(0, 200, 4)):
        eye, q = looking(who)
        lamp, turn = rolling(who)
        angle = turn.as_rotvec()[2]
        assert 24 * deg < abs(angle) < 70 * deg and np.hypot(*lamp[:2]) > 0.08
        roll = Quaternion(turn.as_quat(scalar_first=True))

        def about(axis, by, q=q):
            return q @ Quaternion(np.array([np.cos(by / 2), *(np.sin(by / 2) * axis)]))

        full = np.array([np.cos(angle), 0, 0, np.sin(angle)])  # without the half
        wrong = {
            "the roll about the base's z axis": roll @ q,
            "not rolled": q,
            "rolled the other way": q @ roll.inverse(),
            "half the roll": about(Z, angle / 2),
            "twice the roll": q @ Quaternion(full),
            "degrees for radians": about(Z, angle * deg),
            "degrees": about(Z, np.degrees(angle)),
            "the roll alone": roll,
            "the inverse of the roll": (q @ roll).inverse(),
            "rolled about x": about(X, angle),
            "rolled about y": about(Y, angle),
            "x, y, z, w": np.roll((q @ roll).wxyz, -1),
            "the sum of the quaternions": unit(q.wxyz + roll.wxyz),
            "NaN": np.full(4, np.nan),
        }
        for name, found in wrong.items():
            made = found if isinstance(found, Quaternion) else np.asarray(found)
            verdict = check(CAMERA, (Transform(q, eye), made, eye), who=who)
            if name == "NaN":
                assert verdict.mistake == "another kind or shape"
            else:
                assert not verdict.holds and verdict.mistake == name, (who, name, verdict)


def test_mistakes_in_the_place_of_the_lamp_are_named_for_every_student():
    for who in (f"student {k}" for k in range(0, 200, 4)):
        eye, q = looking(who)
        lamp, turn = rolling(who)
        whole = q @ Quaternion(turn.as_quat(scalar_first=True))
        w, u = whole.wxyz[0], whole.wxyz[1:]
        wrong = {
            "the lamp before the roll": eye + q @ lamp,
            "the camera's place is left out": whole @ lamp,
            "the lamp: the inverse rotation": eye + whole.inverse() @ lamp,
            "the lamp is not rotated": eye + lamp,
            "q v without q*": eye + w * lamp + np.cross(u, lamp),
            "the lamp: the place rotated, too": whole @ (eye + lamp),
            "the lamp: subtracted": whole @ lamp - eye,
            "the lamp: mm for m": 1000 * (eye + whole @ lamp),
            "the camera instead of the lamp": eye,
            "the lamp is elsewhere": eye + whole @ lamp + [0, 0, 0.002],
        }
        for name, found in wrong.items():
            verdict = check(CAMERA, (Transform(q, eye), whole, found), who=who)
            assert not verdict.holds and verdict.mistake == name, (who, name, verdict)
            assert verdict.points == pytest.approx(5 / 6, abs=0.01)


def test_camera_is_judged_before_the_roll_and_the_lamp_are_there():
    eye, q = looking("Ada")
    camera = Transform(q, eye)
    assert not check(CAMERA, (..., ..., ...), who="Ada").answered
    verdict = check(CAMERA, (camera, ..., ...), who="Ada")
    assert verdict.mistake == "the roll is missing" and verdict.points == pytest.approx(0.67)
    turned = rolled(camera, "Ada")[1]
    assert check(CAMERA, (camera, turned, ...), who="Ada").mistake == "the lamp is missing"
    for answer in (camera, (..., turned, eye), (camera, turned), (camera, 2 * turned, eye),
                   (camera, turned[:3], eye), (camera, turned, eye[:2]), (camera, "q", eye),
                   (camera, turned, "lamp"), (camera, turned, eye * np.nan)):  # fmt: skip
        verdict = check(CAMERA, answer, who="Ada")
        assert verdict.answered and verdict.mistake == "another kind or shape", (answer, verdict)


def test_roll_and_lamp_are_compared_with_the_students_own_camera():
    eye, part = places("Ada")
    upside_down = Transform(columns((part - eye) / np.linalg.norm(part - eye), -1), eye)
    verdict = check(CAMERA, rolled(upside_down, "Ada"), who="Ada")
    assert verdict.mistake == "upside down" and "roll" not in " ".join(verdict.says)


# --- Exercise 3: a test for slerp -----------------------------------------------------------------


def unit(row):
    return row / np.linalg.norm(row)


def by_its_properties(lead):
    """A test that checks unit length, equal steps and the whole rotation, without a reference."""
    rng = np.random.default_rng(0)
    for turn in (0, 0.1, 0.4, 1, 2, 3):
        a = unit(rng.normal(size=4))
        b = (Quaternion(a) @ Quaternion.from_angle_axis(turn, unit(rng.normal(size=3)))).wxyz
        for end in (b, -b):
            way = np.array([lead(a, end, s) for s in np.linspace(0, 1, 9)])
            if way.shape != (9, 4) or not np.allclose(np.linalg.norm(way, axis=1), 1, atol=1e-6):
                return False
            frames = Quaternion(way)
            steps = frames[:-1].angle_to(frames[1:])
            ends = [frames[0].angle_to(Quaternion(a)), frames[-1].angle_to(Quaternion(b))]
            if not (np.allclose(steps, turn / 8, atol=1e-6) and np.allclose(ends, 0, atol=1e-6)):
                return False
    return True


def test_property_test_passes_and_the_program_that_a_naive_test_accepts_is_named():
    assert check("frames_and_quaternions.3", by_its_properties).holds
    a, b = (Quaternion.from_angle_axis(x * deg, Z).wxyz for x in (10, 130))

    def half_way(lead):
        middle = Quaternion.from_angle_axis(70 * deg, Z).wxyz
        found = lead(a, b, 0.5)
        return min(abs(found - middle).max(), abs(found + middle).max()) < 1e-6

    verdict = check("frames_and_quaternions.3", half_way)
    assert verdict.mistake.startswith("accepts: ") and verdict.points > 0.4


def compared(turns, shares=(0, 0.1, 0.25, 0.5, 0.9, 1), given=np.array):
    """A test that compares programs with robokin's slerp for rotations by these angles."""
    rng = np.random.default_rng(5)
    pairs = []
    for turn in turns:
        a = unit(rng.normal(size=4))
        b = (Quaternion(a) @ Quaternion.from_angle_axis(turn * deg, unit(rng.normal(size=3)))).wxyz
        pairs += [(a, b), (a, -b)]

    def leads_well(lead):
        for a, b in pairs:
            for s in shares:
                right = Quaternion(a).slerp(Quaternion(b), s).wxyz
                found = np.asarray(lead(given(a), given(b), s))
                error = min(abs(found - right).max(), abs(found + right).max())
                if not error < 1e-6:
                    return False
        return True

    return leads_well


def test_slerp_test_may_pass_lists_and_must_try_large_rotations():
    large = (0, 1e-3, 30, 80, 120, 176)
    assert check("frames_and_quaternions.3", compared(large)).holds
    assert check("frames_and_quaternions.3", compared(large, given=list)).holds
    small = check("frames_and_quaternions.3", compared((0, 1e-3, 30, 60, 90)))
    assert small.mistake == "accepts: the long way beyond 90°"
    less = check("frames_and_quaternions.3", compared((0, 1e-3, 30, 60, 120, 160)))
    assert less.mistake == "accepts: no path beyond 170°"
    assert check("frames_and_quaternions.3", compared(large, (0, 1))).mistake == "accepts: lerp"


def test_rejection_shows_the_last_call_and_asks_about_nan_for_equal_rotations():
    a = unit(np.array([1.0, 2, -1, 3]))
    large = compared((30, 120))

    def by_section_6(lead):  # 0/0 for equal rotations
        beta = np.arccos(np.clip(a @ a, -1, 1))
        with np.errstate(invalid="ignore"):
            right = np.sin([0.75 * beta, 0.25 * beta]) @ [a, a] / np.sin(beta)
        return large(lead) and bool(abs(lead(a, a, 0.25) - right).max() < 1e-6)

    verdict = check("frames_and_quaternions.3", by_section_6)
    told = " ".join(verdict.says)
    assert verdict.mistake == "rejects every program" and "s = 0.25" in told
    assert "a = [0.2582, 0.5164, -0.2582, 0.7746]" in told and "0/0" in told

    def rejects(lead):
        return large(lead) and False

    told = " ".join(check("frames_and_quaternions.3", rejects).says)
    assert "Your test last called it with a = [" in told and "0/0" not in told


def test_test_that_rejects_a_correct_program_hears_of_a_wrong_one_that_it_accepts():
    a, b = (Quaternion.from_angle_axis(x * deg, (0.6, 0, 0.8)).wxyz for x in (10, 130))

    def half_way(lead):  # without the other sign, and only where nlerp is right
        right = Quaternion(a).slerp(Quaternion(b), 0.5).wxyz
        return bool(abs(np.asarray(lead(a, b, 0.5)) - right).max() < 1e-6)

    verdict = check("frames_and_quaternions.3", half_way)
    assert verdict.mistake == "rejects a correct program"
    assert "the result with the other sign" in verdict.case
    assert "It also accepts a wrong program, nlerp: It moves along the chord" in verdict.says[-1]


@pytest.mark.parametrize(
    ("question", "typed", "name"),
    [
        ("p2", 300, "the shift"), ("p2", 301, "the shift"), ("p2", 295, "the height"),
        ("p2", 460, "the chord"), ("p9", -60, "the other way"), ("p9", 303, "the rest of a turn"),
    ],
)  # fmt: skip
def test_typed_number_gets_the_reply_of_the_nearest_answer(question, typed, name):
    found = book.find(f"frames_and_quaternions.{question}", "predictions")
    _, options, right = filled(found)
    assert options[chosen_option(found, options, right, typed)].name == name


def test_different_axes_are_reported_with_different_numbers():
    def little_off(table, q, part):
        return solved(table, q, part) @ np.diag([1, 1 + 1e-5, 1, 1])

    told = check("frames_and_quaternions.1", little_off).case
    axis, is_axis = re.search(r"axis should be \((.*)\), but is \((.*)\)", told).groups()
    assert axis != is_axis


def test_camera_that_looks_straight_up_is_not_called_upside_down():
    eye, _ = places("Ada")
    answer = rolled(Transform(Quaternion.identity(), eye), "Ada")
    verdict = check(CAMERA, answer, who="Ada")
    assert "level" in " ".join(verdict.says) and "points up" not in " ".join(verdict.says)


def test_matrix_of_strings_is_refused():
    text = check("frames_and_quaternions.1", lambda t, q, p: solved(t, q, p).astype(str))
    assert text.mistake == "another kind or shape"
