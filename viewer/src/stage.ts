import * as THREE from "three";
import { Actor, type Visibility } from "./actor";
import { arrowPixels } from "./arrows";
import { CameraRig } from "./camera_rig";
import { element } from "./dom";
import { setOpacity } from "./drawing";
import * as format from "./format";
import { ImpactMarks } from "./impact_marks";
import { type Area, Labels, type LabelSpec } from "./labels";
import { momentText } from "./moments";
import type { Run } from "./motion";
import { type Target, watchPointer } from "./pointer";
import { Scenery } from "./scenery";
import { shadowedGround, Shadows } from "./shadows";
import { colorOf, cssColor } from "./theme";
import { Triad } from "./triad";
import { isSeenAlongRight, kAxes, kViewSize, sceneBox, ViewFrame } from "./view_frame";

/** A ghost is seen through. */
const kGhostOpacity = 0.45;
/** From one body to the next where they stand side by side, in the reach of the largest; how far a point reaches. */
const kBodySpacing = 2.4;
const kPointReach = 0.002 * kViewSize;
/** How far from a body that is followed the camera is, in its reach, if the whole scene is farther. */
const kFollowReaches = 14;
/** Of more bodies only the chosen one has arrows, axes and a trail, and each is drawn with less detail. */
const kManyBodies = 8;
const kBodiesInDetail = 50;
/** px around the pointer in which something is pointed at. */
const kPointerPixels = 9;

/** What the picture tells the page: that it is to be drawn anew, and what the user has chosen in it. */
export interface StageEvents {
  changed: () => void;
  chooseBody: (name: string) => void;
  seek: (t: number) => void;
}

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
  private readonly rig: CameraRig;
  private readonly frame: ViewFrame;
  private readonly scenery: Scenery;
  private readonly shadows: Shadows | null;
  private readonly labels: Labels;
  private readonly triad = new Triad();
  private readonly scale: HTMLElement;
  private readonly runGroups: THREE.Group[] = [];
  private readonly actors: Actor[][] = [];
  private readonly impacts: ImpactMarks[] = [];
  private chosenBody: string | null;
  private followed: Actor | null = null;
  private readonly followedPlace = new THREE.Vector3();
  /** px; what lies over the picture beside the texts. */
  private occupied: Area[] = [];
  private time: number;

  /** Throws where the browser has no WebGL. */
  constructor(
    private readonly container: HTMLElement,
    private readonly runs: readonly Run[],
    private readonly events: StageEvents,
  ) {
    this.renderer = new THREE.WebGLRenderer({ antialias: true, stencil: true });
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    // Asking after errors would make the page wait for every program of the graphics processor.
    this.renderer.debug.checkShaderErrors = false;
    const { domElement } = this.renderer;
    domElement.setAttribute("role", "img");
    domElement.setAttribute("aria-label", "The motion in space. Drag to turn, scroll to zoom.");
    const layer = element("div", { class: "labels", "aria-hidden": "true" });
    this.labels = new Labels(layer);
    this.scale = element("span", { class: "scale" });
    container.append(domElement, layer, this.scale, this.triad.root);

    this.frame = new ViewFrame(sceneBox(runs), kAxes[runs[0].data.up]);
    this.time = runs[0].begin;
    this.chosenBody = runs[0].bodies[0]?.name ?? null;
    this.addLights();
    this.scenery = new Scenery(this.frame, runs[0].data.obstacles);
    this.scene.add(this.scenery.group);
    this.scale.textContent = `squares of ${format.number(this.scenery.spacing)} m`;
    this.rig = new CameraRig(domElement, this.frame, this.scenery.grounds);
    this.rig.controls.addEventListener("change", events.changed);
    this.rig.controls.addEventListener("start", () => (this.showsAll = false));
    runs.forEach((run, index) => this.addRun(run, index));
    const ground = shadowedGround(this.scenery.grounds, this.frame.axes);
    this.shadows =
      ground && new Shadows(this.frame, this.scenery.spacing, ground, this.scenery.solids, this.actors.flat());
    if (this.shadows) this.scene.add(this.shadows.group);
    watchPointer(container, domElement, (x, y) => this.targetAt(x, y));
    this.applyTheme();
    this.resize();
    this.showAll();
    // All programs of the graphics processor begin to be made here, beside the rest of the page; a frame waits for each.
    this.renderer.compile(this.scene, this.rig.camera);
  }

  private addLights(): void {
    this.scene.add(new THREE.HemisphereLight("#ffffff", "#8a8a80", 2.2));
    const sun = new THREE.DirectionalLight("#ffffff", 1.6);
    const { right, away, up } = this.frame.axes;
    sun.position.setScalar(0).addScaledVector(right, -4).addScaledVector(away, -6).addScaledVector(up, 9);
    this.scene.add(sun);
  }

  private addRun(run: Run, index: number): void {
    const group = new THREE.Group();
    const isOneOfMany = run.bodies.length > kBodiesInDetail;
    this.actors.push(
      run.bodies.map((body, i) => {
        const own = this.runs.length > 1 ? undefined : body.data.color;
        const color = own ?? colorOf(this.runs.length, index, i);
        const actor = new Actor(body, this.frame, { color, hasPointColors: this.runs.length === 1, isOneOfMany });
        group.add(actor.group);
        return actor;
      }),
    );
    const marks = new ImpactMarks(run, this.frame);
    this.impacts.push(marks);
    group.add(marks.dots);
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

  /** The body of which the plots are. */
  choose(body: string): void {
    this.chosenBody = body;
  }

  /** From a run to the next, in the drawing: the scene's depth, or, where a body is followed, its width. */
  private get spread(): THREE.Vector3 {
    if (!this.isSideBySide) return new THREE.Vector3();
    const { right, away } = this.frame.axes;
    const [across, along] = isSeenAlongRight(this.frame) ? [right, away] : [away, right];
    if (this.followed) return along.clone().multiplyScalar(kBodySpacing * this.followedReach);
    const size = this.frame.box.getSize(new THREE.Vector3());
    const step = 1.15 * Math.min(size.dot(right), size.dot(away)) + 0.1 * Math.max(size.x, size.y, size.z);
    return across.clone().multiplyScalar(step * this.frame.scale);
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
    if (this.shadows) this.shadows.opacity = Number(cssColor("--shadow"));
  }

  resize(): void {
    const { clientWidth: width, clientHeight: height } = this.container;
    if (width === 0 || height === 0) return;
    this.renderer.setSize(width, height);
    this.rig.resize(width, height);
    if (this.showsAll) this.showAll();
    else this.refreshLabels();
  }

  /** What is shown, the whole scene or a body, in the picture. */
  fit(): void {
    if (this.followed) this.follow(this.followedBody);
    else this.showAll();
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
    const signs = [-1, 1];
    const corners = signs.flatMap((x) =>
      signs.flatMap((y) => signs.map((z) => new THREE.Vector3(x, y, z).multiply(half).add(middle))),
    );
    corners.push(...this.scenery.corners);
    const [right, nearer] = [this.frame.axes.right.clone(), this.frame.axes.away.clone().negate()];
    const [side, end] = isSeenAlongRight(this.frame) ? [right, nearer] : [nearer, right.negate()];
    // of many bodies few have arrows
    const pointing = this.actors.flatMap((actors) => (actors.length > kManyBodies ? actors.slice(0, 1) : actors));
    this.rig.frame(
      (arrow) => (arrow > 0 ? [...corners, ...pointing.flatMap((actor) => actor.arrowTips(arrow))] : corners),
      middle,
      side,
      end,
      arrowPixels(this.pictureSize),
    );
  }

  /** px; the smaller side of the picture. */
  private get pictureSize(): number {
    return Math.min(this.container.clientWidth, this.container.clientHeight);
  }

  /** Keeps a body of the first run, and those that stand beside it, in the middle, near, and its arrows in the picture. */
  follow(body: string | null): void {
    const actor = this.actors[0]?.find((each) => each.motion.name === body);
    if (!actor) return;
    this.followed = actor;
    this.showsAll = false;
    this.arrange();
    const away = this.rig.camera.position.clone().sub(this.rig.controls.target);
    // Seen at a slant, what stands nearer would look larger.
    if (this.isSideBySide) away.addScaledVector(this.spread, -away.dot(this.spread) / this.spread.lengthSq());
    const place = this.placeToFollow(actor, this.time);
    const now = this.rig.camera.position.distanceTo(place);
    this.followedPlace.copy(place);
    this.rig.look(place, away, this.isSideBySide ? this.distanceOfRow() : this.distanceOf(actor, now));
  }

  /** From how far a row of bodies that stand side by side is seen. */
  private distanceOfRow(): number {
    const reach = this.followedReach;
    return (0.5 * this.spreadOfAll.length() + 1.6 * reach) / this.rig.halfAngles.horizontal + reach;
  }

  /** From how far a body is followed: no farther than `now`, unless its arrows would not be in the picture. */
  private distanceOf(actor: Actor, now: number): number {
    const reach = this.followedReach;
    const { horizontal, vertical } = this.rig.halfAngles;
    const tangent = Math.min(horizontal, vertical);
    const wanted = Math.min(now, kFollowReaches * reach);
    const holds = (distance: number): boolean =>
      actor.reachWithArrows(arrowPixels(this.pictureSize) * this.rig.pixelAt(distance)) <= 0.95 * tangent * distance;
    if (holds(wanted)) return wanted;
    // arrows have a size on the screen, the body one in space: from farther away both are seen
    let distance = wanted;
    while (!holds(distance) && distance < 100 * wanted) distance *= 1.05;
    return distance;
  }

  /** The middle of a body and of those that stand beside it. */
  private placeToFollow(actor: Actor, t: number): THREE.Vector3 {
    return this.frame.toView(actor.motion.position(t)).addScaledVector(this.spreadOfAll, 0.5);
  }

  get followedBody(): string | null {
    return this.followed?.motion.name ?? null;
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
      specs.push(...this.impacts[index].labels(this.runGroups[index].position, index === 0));
    });
    this.labels.set(specs);
    this.occupied = [this.scale, ...this.container.querySelectorAll<HTMLElement>(".moment:not([hidden])")].map((each) => ({
      left: each.offsetLeft,
      top: each.offsetTop,
      right: each.offsetLeft + each.offsetWidth,
      bottom: each.offsetTop + each.offsetHeight,
    }));
  }

  /** The body or impact of the first run at a place of the picture, px. */
  private targetAt(x: number, y: number): Target | null {
    const { clientWidth: width, clientHeight: height } = this.container;
    const { camera } = this.rig;
    let [nearest, target] = [Infinity, null as Target | null];
    const consider = (place: THREE.Vector3, radius: number, make: () => Target): void => {
      const point = place.clone().project(camera);
      if (point.z >= 1) return;
      const away = Math.hypot((0.5 + 0.5 * point.x) * width - x, (0.5 - 0.5 * point.y) * height - y);
      if (away > radius || away >= nearest) return;
      [nearest, target] = [away, make()];
    };
    for (const { place, reach, motion } of this.actors[0]) {
      const pixel = this.rig.pixelAt(camera.position.distanceTo(place));
      const choose = (): void => this.events.chooseBody(motion.name);
      consider(place, Math.max(kPointerPixels, reach / pixel), () => ({ text: motion.name, choose }));
    }
    if (this.showsImpacts)
      for (const { impact, place } of this.impacts[0].shown) {
        const text = momentText({ time: impact.time, kind: "impact", impact });
        consider(place, kPointerPixels, () => ({ text, choose: () => this.events.seek(impact.time) }));
      }
    return target;
  }

  render(t: number): void {
    this.time = t;
    // first the camera: how large arrows are depends on it
    if (this.followed) {
      const place = this.placeToFollow(this.followed, t);
      this.rig.move(place.clone().sub(this.followedPlace));
      this.followedPlace.copy(place);
    }
    const { camera } = this.rig;
    const forward = camera.getWorldDirection(new THREE.Vector3());
    const pixel = (at: THREE.Vector3): number =>
      this.rig.pixelAt(Math.max(0.01, at.clone().sub(camera.position).dot(forward)));
    this.actors.forEach((actors, run) => {
      this.runGroups[run].visible = run === 0 || this.showsGhosts;
      for (const actor of actors) actor.update(t, this.visibilityOf(actor, actors.length), pixel, this.pictureSize);
    });
    this.scenery.update(t);
    const isOther = this.impacts.map((marks) => {
      marks.dots.visible = this.showsImpacts;
      return marks.setTime(t);
    });
    if (isOther.some(Boolean)) this.refreshLabels();
    this.shadows?.update();
    this.rig.setRange();
    this.renderer.render(this.scene, camera);
    this.triad.update(camera);
    const { clientWidth: width, clientHeight: height } = this.container;
    this.labels.update(camera, width, height, this.occupied);
  }

  private visibilityOf({ motion: { name } }: Actor, count: number): Visibility {
    const isDetailed = count <= kManyBodies || name === this.chosenBody || name === this.followedBody;
    return isDetailed ? this.shown : { trails: false, velocity: false, acceleration: false, axes: false };
  }
}
