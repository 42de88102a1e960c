import * as THREE from "three";
import type { BodyData, BodyShape, Vector } from "./data";

/** A polyhedron's faces, corners counterclockwise from outside. */
interface Face {
  corners: THREE.Vector3[];
  isDark: boolean;
}

/**
 * The truncated icosahedron whose corners lie on the unit sphere: each edge of an icosahedron cut at its thirds, so that
 * a pentagon takes the place of each corner and a hexagon that of each triangle.
 */
export function soccerBallFaces(): Face[] {
  const golden = (1 + Math.sqrt(5)) / 2;
  const corners: THREE.Vector3[] = [];
  for (const a of [-1, 1])
    for (const b of [-golden, golden])
      corners.push(new THREE.Vector3(0, a, b), new THREE.Vector3(a, b, 0), new THREE.Vector3(b, 0, a));
  // All edges have the length 2.
  const areNeighbours = (a: THREE.Vector3, b: THREE.Vector3): boolean => Math.abs(a.distanceTo(b) - 2) < 1e-9;
  const third = (a: THREE.Vector3, b: THREE.Vector3): THREE.Vector3 => a.clone().lerp(b, 1 / 3).normalize();

  const faces: Face[] = corners.map((corner) => ({
    corners: around(
      corner,
      corners.filter((other) => areNeighbours(corner, other)).map((other) => third(corner, other)),
    ),
    isDark: true,
  }));
  for (let i = 0; i < corners.length; ++i)
    for (let j = i + 1; j < corners.length; ++j)
      for (let k = j + 1; k < corners.length; ++k) {
        const [a, b, c] = [corners[i], corners[j], corners[k]];
        if (!areNeighbours(a, b) || !areNeighbours(b, c) || !areNeighbours(a, c)) continue;
        const points = [third(a, b), third(b, a), third(b, c), third(c, b), third(c, a), third(a, c)];
        faces.push({ corners: around(a.clone().add(b).add(c), points), isDark: false });
      }
  return faces;
}

/** Points in counterclockwise order, seen from where `axis` points to. */
function around(axis: THREE.Vector3, points: THREE.Vector3[]): THREE.Vector3[] {
  const up = axis.clone().normalize();
  const first = points[0].clone().projectOnPlane(up).normalize();
  const second = up.clone().cross(first);
  return [...points].sort(
    (a, b) => Math.atan2(a.dot(second), a.dot(first)) - Math.atan2(b.dot(second), b.dot(first)),
  );
}

function polyhedron(faces: Face[], light: THREE.Color, dark: THREE.Color): THREE.BufferGeometry {
  const positions: number[] = [];
  const colors: number[] = [];
  for (const { corners, isDark } of faces)
    for (let i = 2; i < corners.length; ++i)
      for (const corner of [corners[0], corners[i - 1], corners[i]]) {
        positions.push(...corner.toArray());
        colors.push(...(isDark ? dark : light).toArray());
      }
  return coloured(positions, colors);
}

function coloured(positions: number[], colors: number[]): THREE.BufferGeometry {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(positions, 3));
  geometry.setAttribute("color", new THREE.Float32BufferAttribute(colors, 3));
  geometry.computeVertexNormals();
  return geometry;
}

/** Of a ball of which there are few, and of one among many. */
const kBallSegments: [number, number] = [48, 32];
const kSmallBallSegments: [number, number] = [20, 14];

/** A ball of unit radius whose octants differ, so that one sees it turn. */
function octantBall(light: THREE.Color, dark: THREE.Color, segments: [number, number]): THREE.BufferGeometry {
  const sphere = new THREE.SphereGeometry(1, ...segments).toNonIndexed();
  const position = sphere.getAttribute("position");
  const colors: number[] = [];
  for (let i = 0; i < position.count; i += 3) {
    const middle = new THREE.Vector3();
    for (let k = 0; k < 3; ++k) middle.add(new THREE.Vector3().fromBufferAttribute(position, i + k));
    const color = middle.x * middle.y * middle.z > 0 ? light : dark;
    for (let k = 0; k < 3; ++k) colors.push(...color.toArray());
  }
  sphere.setAttribute("color", new THREE.Float32BufferAttribute(colors, 3));
  return sphere;
}

export const vector = (v: Vector): THREE.Vector3 => new THREE.Vector3(v[0], v[1], v[2]);

/** How far a body, with its named points, reaches from its centre, m. */
export function reach({ shape, points }: BodyData): number {
  const farthest = (ends: Vector[]): number => ends.reduce((most, end) => Math.max(most, Math.hypot(...end)), 0);
  const ofPoints = farthest(points.map(({ position }) => position));
  switch (shape.kind) {
    case "point":
      return ofPoints;
    case "sphere":
    case "soccer-ball":
      return Math.max(ofPoints, shape.radius);
    case "mesh":
      return Math.max(ofPoints, farthest(shape.vertices));
  }
}

/** The other colour of a pattern: strong on a body that turns, a shade of its own on one that does not. */
function patternColor(own: THREE.Color, turns: boolean): THREE.Color {
  const { l } = own.getHSL({ h: 0, s: 0, l: 0 });
  const other = new THREE.Color(l > 0.75 ? "#3a4048" : "#f4f4f0");
  return turns ? other : own.clone().lerp(other, 0.22);
}

/**
 * The body in its own frame, in metres; null for a point. `color` is its own, `turns` whether its spin shall show,
 * `isOneOfMany` whether it is too small a part of the picture for fine detail.
 */
export function bodyGeometry(
  shape: BodyShape,
  color: string,
  turns: boolean,
  isOneOfMany = false,
): THREE.BufferGeometry | null {
  const own = new THREE.Color(color);
  switch (shape.kind) {
    case "point":
      return null;
    case "sphere": {
      const geometry = octantBall(patternColor(own, turns), own, isOneOfMany ? kSmallBallSegments : kBallSegments);
      return geometry.scale(shape.radius, shape.radius, shape.radius);
    }
    case "soccer-ball": {
      const geometry = polyhedron(soccerBallFaces(), new THREE.Color("#f4f4f0"), new THREE.Color("#1d1d22"));
      return geometry.scale(shape.radius, shape.radius, shape.radius);
    }
    case "mesh": {
      const positions = shape.triangles.flatMap((triangle) => triangle.flatMap((corner) => shape.vertices[corner]));
      return coloured(positions, shape.triangles.flatMap(() => [own, own, own].flatMap((each) => each.toArray())));
    }
  }
}
