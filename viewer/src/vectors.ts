import type { Vector } from "./data";

export const length = (v: Vector): number => Math.hypot(v[0], v[1], v[2]);

export const dot = (a: Vector, b: Vector): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

export const sum = (a: Vector, b: Vector): Vector => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
