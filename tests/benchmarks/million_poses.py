"""Test every branch of every six-axis arm on a million random poses, and at and near the three
singularities.

    python tests/benchmarks/million_poses.py [poses per arm]

The script is not part of the test suite, since it takes about a minute. For each arm, no row may be
wrong, none may be missing, and rows that do not exist must be entirely NaN. Which rows exist
follows from distances alone, not from the solver.
"""

import sys

import numpy as np

from robokin import IRB140, ITMO6R, PUMA560, Quaternion, Transform

TURN = 2 * np.pi


def check(arm, q, label, tolerance):
    """Solve the poses of q (N, 6). The drawn q must be among the answers within `tolerance`, and
    every answer must be correct.
    """
    pose = arm.fk(q)
    rows = arm.ik(pose)
    there = ~np.isnan(rows)
    half = (there.any(-1) != there.all(-1)).sum()
    exists = there.all(-1)
    back = arm.fk(rows)
    reach = arm.geometry.wrist.elbow.reach
    position = np.linalg.norm(back.translation - pose.translation[:, None], axis=-1) / reach
    turn = (pose.rotation[:, None].inverse() @ back.rotation).wxyz
    angle = 2 * np.arctan2(np.linalg.norm(turn[..., 1:], axis=-1), abs(turn[..., 0]))
    away = abs((rows - q[:, None] + np.pi) % TURN - np.pi).max(-1)
    missing = (np.where(exists, away, np.inf).min(-1) > tolerance).sum()
    wanted = expected(arm, pose)
    print(
        f"{arm.name:14s} {label:28s} {len(q):8d} poses, {exists.sum():8d} rows: drawn row "
        f"missing {missing}, "
        f"rows partly NaN {half}, rows other than expected {(exists != wanted).sum()}, "
        f"worst position error {np.nanmax(position):.1e} of the reach, angle "
        f"{np.nanmax(angle):.1e} rad"
    )
    return (
        missing
        + half
        + (exists != wanted).sum()
        + (np.nanmax(position) > 1e-12)
        + (np.nanmax(angle) > 1e-12)
    )


def expected(arm, pose):
    """Which rows exist (N, 8), from the distance of the wrist centre. This is independent of the
    solver: the lengths come from `frames` at q = 0.
    """
    frames = arm.frames(np.zeros(6))
    joints = [frames[i] @ link.before for i, link in enumerate(arm.links)]
    centre = joints[4].translation
    shoulder, elbow = joints[1].translation, joints[2].translation
    upper, fore = np.hypot(*(elbow - shoulder)[[0, 2]]), np.hypot(*(centre - elbow)[[0, 2]])
    there = pose @ (frames[6].inverse() @ centre)
    r2 = there[:, 0] ** 2 + there[:, 1] ** 2 - centre[1] ** 2
    r = np.sqrt(np.where(r2 > -1e-13, np.maximum(r2, 0), np.nan))
    out = []
    for flags in arm.branches:
        d = np.hypot(flags[0] * r - shoulder[0], there[:, 2] - shoulder[2])
        out.append((d <= (upper + fore) * (1 + 1e-12)) & (d >= abs(upper - fore) - 1e-12))
    return np.stack(out, axis=-1)


def near(arm, name, rng, count, offset):
    """Joint values (count, 6) that are `offset` away from one singularity."""
    home = arm.geometry.wrist.elbow
    q = rng.uniform(-np.pi, np.pi, (count, 6))
    if name == "wrist":
        q[:, 4] = rng.choice([0, np.pi], count) + offset
    elif name == "elbow":
        q[:, 2] = (
            home.sign3 * (rng.choice([0, np.pi], count) + home.upper_angle - home.fore_angle)
            + offset
        )
    # shoulder: joint 2 brings the wrist centre over axis 1 (as near as the lateral offset allows)
    else:
        bend = home.fore_angle - home.upper_angle + home.sign3 * q[:, 2]
        x, z = home.upper + home.fore * np.cos(bend), home.fore * np.sin(bend)
        length = np.hypot(x, z)
        ok = length > abs(offset - home.shoulder_x)
        q, x, z, length = q[ok], x[ok], z[ok], length[ok]
        lift = rng.choice([-1, 1], len(q)) * np.arccos(
            (offset - home.shoulder_x) / length
        ) - np.arctan2(z, x)
        q[:, 1] = home.sign2 * (lift - home.upper_angle)
    return q


def main():
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 1_000_000
    rng = np.random.default_rng(140)
    bad = 0
    for arm in (IRB140, PUMA560, ITMO6R):
        for _ in range(0, count, 50_000):
            q = rng.uniform(-np.pi, np.pi, (min(count, 50_000), 6))
            bad += check(arm, q, "random", 1e-4)  # a few lie near two singularities at once
        far = Transform(Quaternion.identity((1000,)), rng.normal(size=(1000, 3)) * 5 + 10)
        bad += (~np.isnan(arm.ik(far))).sum()
        for name in ("wrist", "elbow", "shoulder"):
            for offset in (0, 1e-12, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3):
                q = near(arm, name, rng, 10_000, offset)
                bad += check(
                    arm, q, f"{name} singularity + {offset:g}", 1e9 if offset < 1e-4 else 1e-3
                )
    print("all rows correct, none missing" if not bad else f"{bad} faults")
    return int(bad > 0)


if __name__ == "__main__":
    sys.exit(main())
