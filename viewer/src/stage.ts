import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { Actor, arrowPixels, dots, setOpacity, type Visibility } from "./actor";
import type { Impact } from "./data";
import { element } from "./dom";
import * as format from "./format";
import { type Area, kBodyPixels, Labels, type LabelSpec } from "./labels";
import type { Run } from "./motion";
import { Scenery } from "./scenery";
import { colorOf, cssColor } from "./theme";
import { cameraPlace, isSeenAlongX, kViewSize, sceneBox, ViewFrame } from "./view_frame";

/** Impacts beyond so many get no text in the picture; the list has them all. */
const kMostImpactLabels = 60;
/** A ghost is seen through. */
const kGhostOpacity = 0.45;
/** From one body to the next where they stand side by side, in the reach of the largest; how far a point reaches. */
const kBodySpacing = 2.4;
const kPointReach = 0.002 * kViewSize;
const kFieldOfViewDegrees = 35;
/** How much wider the picture is than the whole scene in it. */
const kMargin = 1.12;

/** The picture in space. */
export class Stage {
  readonly shown: Visibility = { trails: true, velocity: true, acceleration: true, axes: true };
  showsImpacts = true;
  showsGhosts = true;
  private isSideBySide = false;
  /** Whether the picture still is as `showAll` has made it. */
  private showsAll = false;
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
    // Asking after errors would make the page wait for every program of the graphics processor.
    this.renderer.debug.checkShaderErrors = false;
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
    this.controls.addEventListener("start", () => (this.showsAll = false));
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
    // All programs of the graphics processor begin to be made here, beside the rest of the page; a frame waits for each.
    this.renderer.compile(this.scene, this.camera);
  }

  private addRun(run: Run, index: number): void {
    const group = new THREE.Group();
    this.actors.push(
      run.bodies.map((body, i) => {
        const color = colorOf(this.runs.length, index, i);
        const actor = new Actor(body, this.frame, color);
        group.add(actor.group);
        return actor;
      }),
    );
    const impacts = run.impacts.map((impact) => this.frame.toView(impact.point));
    if (impacts.length > 0) {
      const markers = dots(impacts, "#dc2626", 10);
      markers.name = "impacts";
      group.add(markers);
    }
    this.scene.add(group);
    this.runGroups.push(group);
    if (index > 0) setOpacity(group, kGhostOpacity);
  }

  /** Runs at one place, the further ones as ghosts, or each at its own beside the one before. */
  setSideBySide(isSideBySide: boolean): void {
    this.isSideBySide = isSideBySide;
    this.runGroups.forEach((group, run) => setOpacity(group, run === 0 || isSideBySide ? 1 : kGhostOpacity));
    this.fit();
  }

  /** From a run to the next, in the drawing: the scene's depth, or, where a body is followed, its width. */
  private get spread(): THREE.Vector3 {
    if (!this.isSideBySide) return new THREE.Vector3();
    const alongX = new THREE.Vector3(1, 0, 0);
    const alongY = new THREE.Vector3(0, 1, 0);
    if (this.followed)
      return (isSeenAlongX(this.frame.box) ? alongY : alongX).multiplyScalar(kBodySpacing * this.followedReach);
    const size = this.frame.box.getSize(new THREE.Vector3());
    const step = 1.15 * Math.min(size.x, size.y) + 0.1 * Math.max(size.x, size.y, size.z);
    return (isSeenAlongX(this.frame.box) ? alongX : alongY).multiplyScalar(step * this.frame.scale);
  }

  /** Of the body that is followed, the largest of all runs. */
  private get followedReach(): number {
    const same = this.actors.flat().filter((each) => each.motion.name === this.followedBody);
    return Math.max(kPointReach, ...same.map((each) => each.widest));
  }

  /** From the first run to the last. */
  private get spreadOfAll(): THREE.Vector3 {
    return this.spread.multiplyScalar(this.runs.length - 1);
  }

  /** Puts the runs where they are to stand. */
  private arrange(): void {
    const { spread } = this;
    this.actors.forEach((actors, run) => {
      const offset = spread.clone().multiplyScalar(run);
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
    if (this.showsAll) this.showAll();
    else this.refreshLabels();
  }

  /** What is shown, the whole scene or a body, in the picture. */
  fit(): void {
    if (this.followed) this.follow(this.followedBody);
    else this.showAll();
  }

  /** Tangents of the half angles that the picture spans. */
  private get halfAngles(): { horizontal: number; vertical: number } {
    const vertical = Math.tan(THREE.MathUtils.degToRad(kFieldOfViewDegrees / 2));
    return { horizontal: vertical * this.camera.aspect, vertical };
  }

  /** The whole scene in the picture, the way going from left to right. */
  showAll(): void {
    this.followed = null;
    this.showsAll = true;
    this.arrange();
    const middle = this.spreadOfAll.multiplyScalar(0.5);
    const half = this.frame.box
      .getSize(new THREE.Vector3())
      .multiplyScalar(0.5 * this.frame.scale)
      .add(middle);
    const away = isSeenAlongX(this.frame.box) ? new THREE.Vector3(1, -0.35, 0.42) : new THREE.Vector3(-0.35, -1, 0.42);
    away.normalize();
    const { horizontal, vertical } = this.halfAngles;
    const inside = { horizontal: horizontal / kMargin, vertical: vertical / kMargin };
    const signs = [-1, 1];
    const corners = signs.flatMap((x) =>
      signs.flatMap((y) => signs.map((z) => new THREE.Vector3(x, y, z).multiply(half).add(middle))),
    );
    // Arrows are as long as the picture lets them be, which the corners alone tell well enough.
    const longest = arrowPixels(this.pictureSize) * this.pixelAt(cameraPlace(corners, middle, away, inside).distance);
    const points = [...corners, ...this.actors.flat().flatMap((actor) => actor.arrowTips(longest))];
    const { target, distance } = cameraPlace(points, middle, away, inside);
    this.controls.target.copy(target);
    this.camera.position.copy(target).addScaledVector(away, distance);
    this.controls.update();
  }

  /** px; the smaller side of the picture. */
  private get pictureSize(): number {
    return Math.min(this.container.clientWidth, this.container.clientHeight);
  }

  /** The size of a pixel of the screen so far from the camera, in the drawing. */
  private pixelAt(distance: number): number {
    return (2 * this.halfAngles.vertical * distance) / this.container.clientHeight;
  }

  /** Keeps a body of the first run, and those that stand beside it, in the middle, near. */
  follow(body: string | null): void {
    const actor = this.actors[0]?.find((each) => each.motion.name === body);
    if (!actor) return;
    this.followed = actor;
    this.showsAll = false;
    this.arrange();
    const { horizontal } = this.halfAngles;
    const reach = this.followedReach;
    const halfWidth = 0.5 * this.spreadOfAll.length() + 1.6 * reach;
    const away = this.camera.position.clone().sub(this.controls.target);
    // Seen at a slant, what stands nearer would look larger.
    if (this.isSideBySide) away.addScaledVector(this.spread, -away.dot(this.spread) / this.spread.lengthSq());
    away.normalize();
    this.followedPlace.copy(this.placeToFollow(actor, this.time));
    this.controls.target.copy(this.followedPlace);
    const distance = this.isSideBySide ? halfWidth / horizontal + reach : 14 * reach;
    this.camera.position.copy(this.followedPlace).addScaledVector(away, distance);
    this.controls.update();
  }

  /** The middle of a body and of those that stand beside it. */
  private placeToFollow(actor: Actor, t: number): THREE.Vector3 {
    return this.frame.toView(actor.motion.position(t)).addScaledVector(this.spreadOfAll, 0.5);
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
      const actors = this.actors[index];
      const named = actors.find((each) => each.motion.name === this.followedBody) ?? actors[0];
      if (named && this.isSideBySide && (index === 0 || this.showsGhosts))
        specs.push({
          at: named.top,
          foot: named.foot,
          text: run.name,
          className: "label-run",
          priority: 5,
          mark: colorOf(this.runs.length, index, 0),
        });
      if (!this.showsImpacts || (index > 0 && !this.showsGhosts)) return;
      const shown = run.impacts.filter((each, i) => i < kMostImpactLabels || each === this.highlighted);
      for (const impact of shown)
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
      const place = this.placeToFollow(this.followed, t);
      const moved = place.clone().sub(this.followedPlace);
      this.controls.target.add(moved);
      this.camera.position.add(moved);
      this.followedPlace.copy(place);
    }
    const forward = this.camera.getWorldDirection(new THREE.Vector3());
    const pixel = (at: THREE.Vector3): number =>
      this.pixelAt(Math.max(0.01, at.clone().sub(this.camera.position).dot(forward)));
    this.actors.forEach((actors, run) => {
      this.runGroups[run].visible = run === 0 || this.showsGhosts;
      const markers = this.runGroups[run].getObjectByName("impacts");
      if (markers) markers.visible = this.showsImpacts;
      for (const actor of actors) actor.update(t, this.shown, pixel, this.pictureSize);
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
