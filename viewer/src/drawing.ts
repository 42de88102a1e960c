import * as THREE from "three";

/** A white disk; made by hand because a canvas for it would be one more thing that the graphics processor sets up. */
const dotTexture = (() => {
  const kSide = 32;
  let texture: THREE.DataTexture | undefined;
  return (): THREE.Texture => {
    if (texture) return texture;
    const isInside = (i: number): boolean =>
      Math.hypot((i % kSide) - (kSide - 1) / 2, Math.floor(i / kSide) - (kSide - 1) / 2) < (kSide - 1) / 2;
    const texels = Array.from({ length: kSide * kSide }, (_, i) => [255, 255, 255, isInside(i) ? 255 : 0]);
    texture = new THREE.DataTexture(new Uint8Array(texels.flat()), kSide, kSide);
    texture.minFilter = texture.magFilter = THREE.LinearFilter;
    texture.needsUpdate = true;
    return texture;
  };
})();

/** Round dots of constant size on the screen. */
export function dots(points: THREE.Vector3[], color: string, pixels: number): THREE.Points<THREE.BufferGeometry, THREE.PointsMaterial> {
  const material = new THREE.PointsMaterial({
    color,
    size: pixels,
    sizeAttenuation: false,
    map: dotTexture(),
    alphaTest: 0.5,
  });
  const result = new THREE.Points(new THREE.BufferGeometry().setFromPoints(points), material);
  result.frustumCulled = false;
  return result;
}

/** Makes all that is drawn of an object as opaque as given, 1: as it was made. */
export function setOpacity(object: THREE.Object3D, opacity: number): void {
  object.traverse((each) => {
    const { material } = each as THREE.Object3D & { material?: THREE.Material };
    if (!material) return;
    material.userData.ownOpacity ??= material.opacity;
    material.opacity = (material.userData.ownOpacity as number) * opacity;
    material.transparent = material.opacity < 1;
    if (material.alphaTest > 0) material.alphaTest = 0.5 * material.opacity;
  });
}
