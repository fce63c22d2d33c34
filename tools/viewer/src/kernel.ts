// Distances of node-segment and edge-edge pairs, operation by operation as in
// libdeck/include/deck/contact/closest.hpp (Form::reference). Numbers of this language are IEEE
// doubles and nothing is contracted, so the results are the same bits.

/** Distances and vectors (segment to node) of the four sub-triangles. */
export const sub = { distance: new Float64Array(4), vector: new Float64Array(12) };

const larger = (a: number, b: number) => (a < b ? b : a);
const clamp01 = (a: number) => {
  const s = a < 1 ? a : 1;
  return 0 < s ? s : 0;
};

function subTriangle(
  k: number, px: number, py: number, pz: number, ox: number, oy: number, oz: number,
  cax: number, cay: number, caz: number, cbx: number, cby: number, cbz: number,
): void {
  const ax = cax - ox, ay = cay - oy, az = caz - oz;
  const bx = cbx - ox, by = cby - oy, bz = cbz - oz;
  const rx = px - ox, ry = py - oy, rz = pz - oz;
  const nx = ay * bz - az * by, ny = az * bx - ax * bz, nz = ax * by - ay * bx;
  const s = 1 / larger(1e-30, nx * nx + ny * ny + nz * nz);
  let la = s * (nx * (ry * bz - rz * by) + ny * (rz * bx - rx * bz) + nz * (rx * by - ry * bx));
  let lb = s * (nx * (ay * rz - az * ry) + ny * (az * rx - ax * rz) + nz * (ax * ry - ay * rx));
  let lo = 1 - la - lb;
  const ex = cbx - cax, ey = cby - cay, ez = cbz - caz;
  const ee = larger(1e-20, ex * ex + ey * ey + ez * ez);
  const bb = larger(1e-30, bx * bx + by * by + bz * bz);
  const aa = larger(1e-30, ax * ax + ay * ay + az * az);
  const ho = (lo * Math.abs(lo)) / ee;
  const ha = (la * Math.abs(la)) / bb;
  const hb = (lb * Math.abs(lb)) / aa;
  if (lo < 0 && ho <= ha && ho <= hb) {
    la = clamp01(((cbx - px) * ex + (cby - py) * ey + (cbz - pz) * ez) / ee);
    lb = 1 - la;
    lo = 0;
  } else if (la < 0 && ha <= hb && ha <= ho) {
    la = 0;
    lb = clamp01((rx * bx + ry * by + rz * bz) / bb);
    lo = 1 - lb;
  } else if (lb < 0 && hb <= ho && hb <= ha) {
    lb = 0;
    la = clamp01((rx * ax + ry * ay + rz * az) / aa);
    lo = 1 - la;
  }
  const vx = px - (ox + la * ax + lb * bx);
  const vy = py - (oy + la * ay + lb * by);
  const vz = pz - (oz + la * az + lb * bz);
  sub.vector[3 * k] = vx;
  sub.vector[3 * k + 1] = vy;
  sub.vector[3 * k + 2] = vz;
  sub.distance[k] = Math.sqrt(vx * vx + vy * vy + vz * vz);
}

export interface Points {
  x: Float64Array;
  y: Float64Array;
  z: Float64Array;
}

/** Fills `sub` for node `p` and the segment with corners a, b, c, d (a triangle repeats c). */
export function closestOnSegment(t: Points, p: number, a: number, b: number, c: number, d: number): void {
  const { x, y, z } = t;
  let ox = x[c], oy = y[c], oz = z[c];
  if (c !== d) {
    ox = 0.25 * (x[a] + x[b] + x[c] + x[d]);
    oy = 0.25 * (y[a] + y[b] + y[c] + y[d]);
    oz = 0.25 * (z[a] + z[b] + z[c] + z[d]);
  }
  const px = x[p], py = y[p], pz = z[p];
  subTriangle(0, px, py, pz, ox, oy, oz, x[a], y[a], z[a], x[b], y[b], z[b]);
  subTriangle(1, px, py, pz, ox, oy, oz, x[b], y[b], z[b], x[c], y[c], z[c]);
  subTriangle(2, px, py, pz, ox, oy, oz, x[c], y[c], z[c], x[d], y[d], z[d]);
  subTriangle(3, px, py, pz, ox, oy, oz, x[d], y[d], z[d], x[a], y[a], z[a]);
}

/** Closest points of two edges: weights of the first nodes, vector main to secondary, distance. */
export const edge = { weightS: 0, weightM: 0, vx: 0, vy: 0, vz: 0, distance: 0 };

export function closestBetweenEdges(t: Points, s1: number, s2: number, m1: number, m2: number): void {
  const { x, y, z } = t;
  const sx = x[s2] - x[s1], sy = y[s2] - y[s1], sz = z[s2] - z[s1];
  const mx = x[m2] - x[m1], my = y[m2] - y[m1], mz = z[m2] - z[m1];
  const wx = x[m2] - x[s2], wy = y[m2] - y[s2], wz = z[m2] - z[s2];
  const aa = sx * sx + sy * sy + sz * sz;
  const cc = mx * mx + my * my + mz * mz;
  const q = -(sx * mx + sy * my + sz * mz);
  const xa = sx * wx + sy * wy + sz * wz;
  const xb = -(mx * wx + my * wy + mz * wz);
  const det = larger(1e-20, cc * aa - q * q);
  let hm = clamp01((xa * q - xb * aa) / det);
  const hs = clamp01(-(xa + hm * q) / larger(aa, 1e-20));
  hm = clamp01(-(xb + hs * q) / larger(cc, 1e-20));
  const rs = 1 - hs, rm = 1 - hm;
  edge.vx = hs * x[s1] + rs * x[s2] - hm * x[m1] - rm * x[m2];
  edge.vy = hs * y[s1] + rs * y[s2] - hm * y[m1] - rm * y[m2];
  edge.vz = hs * z[s1] + rs * z[s2] - hm * z[m1] - rm * z[m2];
  edge.weightS = hs;
  edge.weightM = hm;
  edge.distance = Math.sqrt(edge.vx * edge.vx + edge.vy * edge.vy + edge.vz * edge.vz);
}
