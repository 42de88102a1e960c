import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { Actor, dots, type Visibility } from "./actor";
import type { Impact } from "./data";
import { element } from "./dom";
import * as format from "./format";
import { type Area, Labels, type LabelSpec } from "./labels";
import type { Run } from "./motion";
import { Scenery } from "./scenery";
import { cssColor, kPalette } from "./theme";
import { kViewSize, sceneBox, ViewFrame } from "./view_frame";

/** Impacts beyond so many get no text in the picture; the list has them all. */
const kMostImpactLabels = 60;
/** A ghost is seen through. */
const kGhostOpacity = 0.45;
/** px around a body that texts leave free. */
const kBodyPixels = 8;
const kFieldOfViewDegrees = 35;

/** The colour of a body: its own in a single run, its run's where several are compared. */
export const colorOf = (runCount: number, run: number, body: number): string =>
  kPalette[(runCount > 1 ? run : body) % kPalette.length];

/** The picture in space. */
export class Stage {
  readonly shown: Visibility = { trails: true, velocity: true, acceleration: true, axes: true };
  showsImpacts = true;
  showsGhosts = true;
  private readonly renderer: THREE.WebGLRenderer;
  private readonly scene = new THREE.Scene();
  private readonly camera = new THREE.PerspectiveCamera(kFieldOfViewDegrees, 1, 0.01, 1000);
  private readonly controls: OrbitControls;
  private readonly frame: ViewFrame;
  private readonly scenery: Scenery;
  private readonly labels: Labels;
  private readonly scale: HTMLElement;
  private readonly runGroups: THREE.Group[] = [];
  private readonly actors: Actor[][] = [];
  private followed: Actor | null = null;
  private readonly followedPlace = new THREE.Vector3();
  /** px; what lies over the picture beside the texts. */
  private occupied: Area[] = [];
  private highlighted: Impact | null = null;
  private time: number;

  /** `changed` is called when the user has turned or moved the picture. Throws where the browser has no WebGL. */
  constructor(
    private readonly container: HTMLElement,
    private readonly runs: readonly Run[],
    changed: () => void,
  ) {
    this.renderer = new THREE.WebGLRenderer({ antialias: true });
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    const { domElement } = this.renderer;
    domElement.setAttribute("role", "img");
    domElement.setAttribute("aria-label", "The motion in space. Drag to turn, scroll to zoom.");
    container.append(domElement);
    const layer = element("div", { class: "labels", "aria-hidden": "true" });
    container.append(layer);
    this.labels = new Labels(layer);
    this.scale = element("span", { class: "scale" });
    container.append(this.scale);

    this.frame = new ViewFrame(sceneBox(runs));
    this.time = runs[0].begin;
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, domElement);
    this.controls.addEventListener("change", changed);
    this.scene.add(new THREE.HemisphereLight("#ffffff", "#8a8a80", 2.2));
    const sun = new THREE.DirectionalLight("#ffffff", 1.6);
    sun.position.set(-4, -6, 9);
    this.scene.add(sun);
    this.scenery = new Scenery(this.frame, runs[0].data.obstacles);
    this.scene.add(this.scenery.group);
    this.scale.textContent = `squares of ${format.number(this.scenery.spacing)} m`;
    runs.forEach((run, index) => this.addRun(run, index));
    this.applyTheme();
    this.resize();
    this.showAll();
  }

  private addRun(run: Run, index: number): void {
    const group = new THREE.Group();
    const opacity = index === 0 ? 1 : kGhostOpacity;
    this.actors.push(
      run.bodies.map((body, i) => {
        const color = colorOf(this.runs.length, index, i);
        const actor = new Actor(body, this.frame, color, opacity);
        group.add(actor.group);
        return actor;
      }),
    );
    const impacts = run.impacts.map((impact) => this.frame.toView(impact.point));
    if (impacts.length > 0) {
      const markers = dots(impacts, "#dc2626", 10, opacity);
      markers.name = "impacts";
      group.add(markers);
    }
    this.scene.add(group);
    this.runGroups.push(group);
  }

  /** Runs at one place, or each at its own beside the one before. */
  setSideBySide(isSideBySide: boolean): void {
    const size = this.frame.box.getSize(new THREE.Vector3());
    const across = size.y <= size.x ? new THREE.Vector3(0, 1, 0) : new THREE.Vector3(1, 0, 0);
    const step = (1.15 * Math.min(size.x, size.y) + 0.1 * Math.max(size.x, size.y, size.z)) * this.frame.scale;
    this.actors.forEach((actors, run) => {
      const offset = across.clone().multiplyScalar(isSideBySide ? run * step : 0);
      this.runGroups[run].position.copy(offset);
      for (const actor of actors) actor.offset.copy(offset);
    });
    this.refreshLabels();
  }

  applyTheme(): void {
    this.scene.background = new THREE.Color(cssColor("--stage"));
    this.scenery.applyTheme();
  }

  resize(): void {
    const { clientWidth: width, clientHeight: height } = this.container;
    if (width === 0 || height === 0) return;
    this.renderer.setSize(width, height);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.refreshLabels();
  }

  /** The whole scene in the picture, the way going from left to right. */
  showAll(): void {
    this.follow(null);
    const half = this.frame.box.getSize(new THREE.Vector3()).multiplyScalar(0.5 * this.frame.scale);
    const away = half.y > half.x ? new THREE.Vector3(1, -0.35, 0.42) : new THREE.Vector3(-0.35, -1, 0.42);
    away.normalize();
    const side = this.camera.up.clone().cross(away).normalize();
    const up = away.clone().cross(side);
    const vertical = Math.tan(THREE.MathUtils.degToRad(kFieldOfViewDegrees / 2));
    const horizontal = vertical * this.camera.aspect;
    // A corner at (x, y, z) of the view is inside where |x| <= (d - z) tan of the half angle.
    let distance = 0;
    for (let corner = 0; corner < 8; ++corner) {
      const p = new THREE.Vector3(
        corner & 1 ? half.x : -half.x,
        corner & 2 ? half.y : -half.y,
        corner & 4 ? half.z : -half.z,
      );
      const depth = p.dot(away);
      distance = Math.max(
        distance,
        depth + Math.abs(p.dot(side)) / horizontal,
        depth + Math.abs(p.dot(up)) / vertical,
      );
    }
    this.controls.target.set(0, 0, 0);
    this.camera.position.copy(away.multiplyScalar(1.12 * distance));
    this.controls.update();
  }

  /** Keeps a body of the first run in the middle, near; null: the camera stands still. */
  follow(body: string | null): void {
    const actor = this.actors[0]?.find((each) => each.motion.name === body) ?? null;
    if (actor && actor !== this.followed) {
      actor.update(this.time, this.shown, () => 0, 0);
      const reach = Math.max(actor.reach, 0.002 * kViewSize);
      const away = this.camera.position.clone().sub(this.controls.target).normalize();
      this.controls.target.copy(actor.place);
      this.camera.position.copy(actor.place).addScaledVector(away, 14 * reach);
      this.followedPlace.copy(actor.place);
      this.controls.update();
    }
    this.followed = actor;
  }

  get followedBody(): string | null {
    return this.followed?.motion.name ?? null;
  }

  /** The impact whose text goes before all others. */
  highlight(impact: Impact | null): void {
    if (impact === this.highlighted) return;
    this.highlighted = impact;
    this.refreshLabels();
  }

  /** The texts as the options are now. */
  refreshLabels(): void {
    const specs: LabelSpec[] = [...this.scenery.labels];
    this.runs.forEach((run, index) => {
      if (!this.showsImpacts || (index > 0 && !this.showsGhosts)) return;
      const named = run.impacts.filter((each, i) => i < kMostImpactLabels || each === this.highlighted);
      for (const impact of named)
        specs.push({
          at: this.frame.toView(impact.point).add(this.runGroups[index].position),
          text: format.impact(impact),
          className: impact === this.highlighted ? "label-impact label-highlighted" : "label-impact",
          priority: impact === this.highlighted ? 4 : index === 0 ? 3 : 2,
        });
    });
    this.labels.set(specs);
    this.occupied = [this.scale, ...this.container.querySelectorAll<HTMLElement>(".panel")].map((each) => ({
      left: each.offsetLeft,
      top: each.offsetTop,
      right: each.offsetLeft + each.offsetWidth,
      bottom: each.offsetTop + each.offsetHeight,
    }));
  }

  /** Where the bodies of the first run are on the screen: texts keep clear of them. */
  private bodyAreas(width: number, height: number): Area[] {
    return this.actors[0].map(({ place }) => {
      const point = place.clone().project(this.camera);
      const x = (0.5 + 0.5 * point.x) * width;
      const y = (0.5 - 0.5 * point.y) * height;
      return { left: x - kBodyPixels, top: y - kBodyPixels, right: x + kBodyPixels, bottom: y + kBodyPixels };
    });
  }

  render(t: number): void {
    this.time = t;
    // first the camera: how large arrows are depends on it
    if (this.followed) {
      const place = this.frame.toView(this.followed.motion.position(t)).add(this.followed.offset);
      const moved = place.clone().sub(this.followedPlace);
      this.controls.target.add(moved);
      this.camera.position.add(moved);
      this.followedPlace.copy(place);
    }
    const worldPixel = (2 * Math.tan(THREE.MathUtils.degToRad(kFieldOfViewDegrees / 2))) / this.container.clientHeight;
    const forward = this.camera.getWorldDirection(new THREE.Vector3());
    const pixel = (at: THREE.Vector3): number =>
      worldPixel * Math.max(0.01, at.clone().sub(this.camera.position).dot(forward));
    this.actors.forEach((actors, run) => {
      this.runGroups[run].visible = run === 0 || this.showsGhosts;
      const markers = this.runGroups[run].getObjectByName("impacts");
      if (markers) markers.visible = this.showsImpacts;
      for (const actor of actors) actor.update(t, this.shown, pixel, this.container.clientHeight);
    });
    // Depth has few digits: the range follows the distance that one looks at.
    const distance = this.camera.position.distanceTo(this.controls.target);
    this.camera.near = distance / 100;
    this.camera.far = distance + 10 * kViewSize;
    this.camera.updateProjectionMatrix();
    this.camera.updateMatrixWorld();
    this.renderer.render(this.scene, this.camera);
    const { clientWidth: width, clientHeight: height } = this.container;
    this.labels.update(this.camera, width, height, [...this.occupied, ...this.bodyAreas(width, height)]);
  }
}
