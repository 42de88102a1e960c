import * as THREE from "three";
import type { DriveData, Vector } from "./data";
import { Track } from "./track";
import type { ViewFrame } from "./view_frame";

/** How an obstacle moves that the scene drives: its pivot, a place of it, goes its way, and it turns about that. */
export class Drive {
  private readonly track: Track;
  private readonly pivot: Vector;

  constructor({ pivot, pieces }: DriveData) {
    this.track = Track.decode(pieces, 7);
    this.pivot = pivot;
  }

  /** Where a place of the obstacle is, m, that was there at the start. */
  place(at: THREE.Vector3, t: number): THREE.Vector3 {
    const [x, y, z] = this.pivot;
    return at.clone().sub(new THREE.Vector3(x, y, z)).applyQuaternion(this.turn(t)).add(this.pivotAt(t));
  }

  /** Puts what is drawn of the obstacle as it was at the start to where it is now. */
  move(drawn: THREE.Object3D, frame: ViewFrame, t: number): void {
    drawn.quaternion.copy(this.turn(t));
    const { x, y, z } = this.pivotAt(t);
    drawn.position.copy(frame.toView([x, y, z])).sub(frame.toView(this.pivot).applyQuaternion(drawn.quaternion));
  }

  private pivotAt(t: number): THREE.Vector3 {
    return new THREE.Vector3(...this.track.vector(this.track.pieceAt(t), 0, t));
  }

  private turn(t: number): THREE.Quaternion {
    const [w, x, y, z] = [3, 4, 5, 6].map((component) => this.track.value(this.track.pieceAt(t), component, t));
    return new THREE.Quaternion(x, y, z, w).normalize();
  }
}
