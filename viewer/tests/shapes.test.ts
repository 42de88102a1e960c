import { describe, expect, it } from "vitest";
import { soccerBallFaces } from "../src/shapes";

describe("the soccer ball", () => {
  const faces = soccerBallFaces();

  it("has 12 dark pentagons and 20 light hexagons", () => {
    expect(faces.filter((face) => face.corners.length === 5 && face.isDark)).toHaveLength(12);
    expect(faces.filter((face) => face.corners.length === 6 && !face.isDark)).toHaveLength(20);
    expect(faces).toHaveLength(32);
  });

  it("has 60 corners on the unit sphere and edges of one length", () => {
    const corners = new Set(faces.flatMap((face) => face.corners.map((c) => c.toArray().map((x) => x.toFixed(9)).join())));
    expect(corners.size).toBe(60);
    // circumscribed radius R and edge a of a truncated icosahedron: R / a = sqrt(58 + 18 sqrt(5)) / 4
    const edge = 4 / Math.sqrt(58 + 18 * Math.sqrt(5));
    for (const { corners: polygon } of faces)
      polygon.forEach((corner, i) => {
        expect(corner.length()).toBeCloseTo(1, 12);
        expect(corner.distanceTo(polygon[(i + 1) % polygon.length])).toBeCloseTo(edge, 12);
      });
  });

  it("shows its outside", () => {
    for (const { corners: [a, b, c] } of faces) {
      const normal = b.clone().sub(a).cross(c.clone().sub(a));
      expect(normal.dot(a)).toBeGreaterThan(0);
    }
  });
});
