// Chains: rigid transforms as 12 numbers (the rows of [R | p]), and where a posture brings every joint.

export const IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0];

export function compose(a, b) {
  const c = new Array(12);
  for (let r = 0; r < 12; r += 4)
    for (let k = 0; k < 4; k++)
      c[r + k] = a[r] * b[k] + a[r + 1] * b[4 + k] + a[r + 2] * b[8 + k] + (k === 3 ? a[r + 3] : 0);
  return c;
}

export function motion({axis: [x, y, z], prismatic}, q) {
  if (prismatic) return [1, 0, 0, x * q, 0, 1, 0, y * q, 0, 0, 1, z * q];
  const c = Math.cos(q), s = Math.sin(q), v = 1 - c;
  return [c + x * x * v, x * y * v - z * s, x * z * v + y * s, 0,
          y * x * v + z * s, c + y * y * v, y * z * v - x * s, 0,
          z * x * v - y * s, z * y * v + x * s, c + z * z * v, 0];
}

// The frames of a posture: base, after each link, the last one being the flange; as arm.frames(q) in Python.
// Where given, `joints` and `moved` receive the frame of each joint before and after its own motion.
export function frames(chain, q, joints = [], moved = []) {
  const all = [IDENTITY];
  chain.forEach((link, i) => {
    joints[i] = compose(all[i], link.before);
    moved[i] = compose(joints[i], motion(link, q[i]));
    all.push(compose(moved[i], link.after));
  });
  return all;
}

export const origin = m => [m[3], m[7], m[11]];
export const turned = (m, [x, y, z]) => [m[0] * x + m[1] * y + m[2] * z, m[4] * x + m[5] * y + m[6] * z,
                                  m[8] * x + m[9] * y + m[10] * z];
export const plus = (a, b, k = 1) => [a[0] + k * b[0], a[1] + k * b[1], a[2] + k * b[2]];
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const distance = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
